#pragma once
#include <limits>
#include <string>
#include <string_view>

namespace osculate::core {

/// Numbers a parameter may have. Bounds are excluded unless said otherwise.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool with_lower = false, with_upper = false;

  [[nodiscard]] bool contains(double value) const {
    return (value > lower || (with_lower && value == lower)) &&
           (value < upper || (with_upper && value == upper));
  }
};

/// A parameter describes itself; it knows nothing about files or languages. A type `T` with
/// parameters has a static function `params()` that returns an array of them; the reader of model
/// files, the schema, the documentation and the conformance tests walk it.
template <class T>
struct Param {
  std::string_view key, unit, doc;
  double T::*slot;
  Range range;
  bool required = true;  ///< else it has the value of a new object
  std::string_view example = "1";
};

/// The range in words, e.g. `-1 < nu < 0.5`, `E > 0`, `density >= 0`, `x is any number`.
[[nodiscard]] std::string describe(const Range& range, std::string_view name);
/// `nu = 0.5, but -1 < nu < 0.5 is needed`.
[[nodiscard]] std::string out_of_range(std::string_view name, double value, const Range& range);

/// Empty if every parameter of `object` is in its range, else which one is not and what is needed.
template <class T>
[[nodiscard]] std::string range_problem(const T& object) {
  for (const Param<T>& param : T::params()) {
    const double value = object.*param.slot;
    if (!param.range.contains(value)) return out_of_range(param.key, value, param.range);
  }
  return {};
}

}  // namespace osculate::core
