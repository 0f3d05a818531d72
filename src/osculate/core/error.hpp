#pragma once
#include <stdexcept>
#include <string>

namespace osculate::core {

/// Where a value of the user's input stands. Every value read by `deck` carries one.
struct SourceMark {
  std::string file;  ///< as the user named it
  int line = 0;      ///< 1-based; 0 = unknown
  std::string key;   ///< path of the key, e.g. `contact[0].friction.coulomb.mu`
};

/// `file:line: key: ` with the parts that are known.
[[nodiscard]] std::string to_string(const SourceMark& mark);

/// Bad input of the user: one clear message naming file, line, key and what was expected.
/// The program ends with exit code 2 and has written nothing.
class InputError : public std::runtime_error {
 public:
  InputError(const SourceMark& mark, const std::string& message)
      : std::runtime_error(to_string(mark) + message), mark_(mark) {}
  [[nodiscard]] const SourceMark& mark() const { return mark_; }

 private:
  SourceMark mark_;
};

/// A broken invariant inside a geometric kernel (a degenerate facet, say).
class GeometryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace osculate::core
