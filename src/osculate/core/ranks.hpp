#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace osculate::core {

/// Processes that work on one analysis together. All have the same input, take the same way, and
/// call these functions in the same order; each then has the same numbers, to the last bit. One
/// process alone has nobody to ask: a null pointer stands for that.
///
/// Tested by  tests/ranks
class Ranks {
 public:
  Ranks() = default;
  virtual ~Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] virtual int count() const = 0;
  [[nodiscard]] virtual int rank() const = 0;  ///< of this process, from 0
  /// Every number becomes the sum over all processes. Where all but one give `nothing`, its bits
  /// stay.
  virtual void sum(std::span<double> values) const = 0;
  /// Every number becomes the largest one of all processes.
  virtual void largest(std::span<double> values) const = 0;
  /// What process `from` has; sizes are equal.
  virtual void spread(std::span<double> values, int from) const = 0;
  virtual void spread(std::span<int> values, int from) const = 0;
  /// What all have, one process after the other, on process 0; nothing on the others.
  virtual void gather(std::span<const int> mine, std::span<int> all) const = 0;
  /// Numbers for each process, those for one after those for the other; what comes are those that
  /// each has for this one. `to` and `from` say how many there are; all know of each other's.
  virtual void exchange(std::span<const double> values, std::span<const int> to,
                        std::span<double> received, std::span<const int> from) const = 0;
  /// What calls of these functions have taken here: messages, and waiting for the others.
  [[nodiscard]] virtual double seconds() const { return 0; }
  /// This process takes leave, as all others do.
  virtual void finish() const = 0;
  /// Ends all processes.
  [[noreturn]] virtual void end_all(int code) const = 0;

  /// x + nothing = x for every x, zeros of both signs too.
  static constexpr double nothing = -0.0;

  [[nodiscard]] double largest(double value) const {
    largest({&value, 1});
    return value;
  }
  [[nodiscard]] double sum(double value) const {
    sum({&value, 1});
    return value;
  }
  [[nodiscard]] bool all(bool holds) const { return largest(holds ? 0.0 : 1.0) == 0.0; }
  [[nodiscard]] bool any(bool holds) const { return largest(holds ? 1.0 : 0.0) != 0.0; }
  /// Whether all have the same bits.
  [[nodiscard]] bool agree_on(std::span<const double> values) const {
    std::uint64_t mark = 14695981039346656037U;  // FNV-1a by words
    for (const double value : values)
      mark = (mark ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211U;
    constexpr unsigned exact = 11;  // bits of it that a number has not
    const auto as_number = static_cast<double>(mark >> exact);
    std::array<double, 2> bounds{as_number, -as_number};
    largest(bounds);
    return bounds[0] == -bounds[1];
  }
  /// The text of process `from`.
  [[nodiscard]] std::string spread(const std::string& text, int from) const {
    std::string out = text;
    auto size = static_cast<int>(text.size());
    spread({&size, 1}, from);
    out.resize(static_cast<std::size_t>(size));
    for (char& c : out) {
      int code = c;
      spread({&code, 1}, from);
      c = static_cast<char>(code);
    }
    return out;
  }
};

}  // namespace osculate::core
