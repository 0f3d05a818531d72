#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

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

/// The points of a curve, e.g. stress over strain.
using Table = std::vector<std::array<double, 2>>;
/// A curve that holds at one temperature.
struct Curve {
  double temperature = 0;
  Table points{};
};
using Curves = std::vector<Curve>;

/// Where an object of type `T` keeps the value of a parameter.
template <class T>
using Slot = std::variant<double T::*, std::optional<double> T::*, Table T::*, std::string T::*,
                          std::vector<double> T::*>;

/// Sentences of a parameter that may be left to the program by the word `auto`.
struct Automatic {
  std::string_view number, word;  ///< what one that is given is, what the word is
  std::string_view means;         ///< what it stands for
};

/// A map of parameters of which exactly one is given.
struct OneOf {
  std::string_view key, doc, example;
};

/// Sentences of the points of a table, and one of them.
struct PointWords {
  std::string_view point, coordinate, example;
  std::size_t least = 2;  ///< of how many points
};

/// A parameter describes itself; it knows nothing about files or languages. A type `T` with
/// parameters has a static function `params()` that returns an array of them; the reader of model
/// files, the schema, the documentation and the conformance tests walk it. Where a type has one
/// parameter without a key, its value stands under the key of the type itself.
///
/// Tested by  tests/unit/core/test_param.cpp, tests/unit/deck/test_params.cpp
template <class T>
struct Param {
  std::string_view key, unit, doc;
  Slot<T> slot;
  Range range{};         ///< of a number; the coordinates of a table may be any
  bool required = true;  ///< else it has the value of a new object
  std::string_view example = "1";
  std::string_view otherwise{};          ///< value of a new object in words, where it is no number
  const Automatic* automatic = nullptr;  ///< may be left to the program, and is unless it is given
  const OneOf* one_of = nullptr;         ///< the map it stands in
  const PointWords* points = nullptr;    ///< of a table: what its points are
  bool timed = false;                    ///< means something only where increments take time
  Table T::*over = nullptr;  ///< a table over the temperature may be given in place of the number
  /// Points may have a temperature behind them, and then belong to one curve each temperature, the
  /// temperatures rising. In place of a number one curve may be given, too.
  Curves T::*curves = nullptr;
};

/// What is wrong with an object whose parameters are in their ranges: a type with parameters may
/// have a function `fault()` that returns one of these, if there is one.
struct Fault {
  std::string why;                    ///< a sentence that speaks for itself
  std::string_view key{};             ///< of the parameter, or of the map it stands in
  std::optional<std::size_t> item{};  ///< of a table: which of its points
};

/// The range in words, e.g. `-1 < nu < 0.5`, `E > 0`, `density >= 0`, `x is any number`.
[[nodiscard]] std::string describe(const Range& range, std::string_view name);
/// The same after `must be`: `> 0`, `>= 0 and <= 1`, `finite`.
[[nodiscard]] std::string bounds(const Range& range);
/// `nu = 0.5, but -1 < nu < 0.5 is needed`.
[[nodiscard]] std::string out_of_range(std::string_view name, double value, const Range& range);

/// The member that a slot points to, if it is an `M`. An object smaller than an `M` has none: told
/// so, compilers do not warn of reading it.
template <class M, class T>
[[nodiscard]] auto* member_in(T& object, const Slot<std::remove_const_t<T>>& slot) {
  using Member = std::conditional_t<std::is_const_v<T>, const M, M>;
  if constexpr (sizeof(T) >= sizeof(M))
    if (const auto* const member = std::get_if<M std::remove_const_t<T>::*>(&slot))
      return &(object.**member);
  return static_cast<Member*>(nullptr);
}

/// The number of a parameter; none: it is optional and not there, or none.
template <class T>
[[nodiscard]] std::optional<double> number_in(const T& object, const Slot<T>& slot) {
  if (const double* const number = member_in<double>(object, slot)) return *number;
  const auto* const maybe = member_in<std::optional<double>>(object, slot);
  return maybe ? *maybe : std::nullopt;
}
/// The points of a parameter, if it is a table.
template <class T>
[[nodiscard]] const Table* table_in(const T& object, const Slot<T>& slot) {
  return member_in<Table>(object, slot);
}
template <class T>
[[nodiscard]] bool is_text(const T& object, const Slot<T>& slot) {
  return member_in<std::string>(object, slot) != nullptr;
}
template <class T>
[[nodiscard]] bool is_list(const T& object, const Slot<T>& slot) {
  return member_in<std::vector<double>>(object, slot) != nullptr;
}
/// The table over the temperature of a parameter that may have one.
template <class T>
[[nodiscard]] auto* table_over(T& object, const Param<std::remove_const_t<T>>& param) {
  using Member = std::conditional_t<std::is_const_v<T>, const Table, Table>;
  if constexpr (sizeof(T) >= sizeof(Table))
    if (param.over) return &(object.*param.over);
  return static_cast<Member*>(nullptr);
}
/// The curves over the temperature of a parameter that may have some.
template <class T>
[[nodiscard]] auto* curves_over(T& object, const Param<std::remove_const_t<T>>& param) {
  using Member = std::conditional_t<std::is_const_v<T>, const Curves, Curves>;
  if constexpr (sizeof(T) >= sizeof(Curves))
    if (param.curves) return &(object.*param.curves);
  return static_cast<Member*>(nullptr);
}
template <class T>
void set(T& object, const Slot<T>& slot, double value) {
  if (double* const number = member_in<double>(object, slot)) *number = value;
  if (auto* const maybe = member_in<std::optional<double>>(object, slot)) *maybe = value;
}
template <class T>
void set(T& object, const Slot<T>& slot, Table points) {
  if (Table* const table = member_in<Table>(object, slot)) *table = std::move(points);
}

template <class T>
void set(T& object, const Slot<T>& slot, std::string text) {
  if (auto* const own = member_in<std::string>(object, slot)) *own = std::move(text);
}
template <class T>
void set(T& object, const Slot<T>& slot, std::vector<double> numbers) {
  if (auto* const own = member_in<std::vector<double>>(object, slot)) *own = std::move(numbers);
}

/// A parameter with a number that it may not have.
struct OutOfRange {
  std::string_view key;
  double value = 0;
  Range range{};
};
/// The first one of an object. What is not required may always have the value of a new object.
template <class T>
[[nodiscard]] std::optional<OutOfRange> first_out_of_range(const T& object) {
  for (const Param<T>& param : T::params()) {
    if (const Table* const table = table_in(object, param.slot))
      for (const std::array<double, 2>& point : *table)
        for (const double value : point)
          if (!std::isfinite(value)) return OutOfRange{param.key, value};
    if (const Table* const table = table_over(object, param))
      for (const auto& [temperature, value] : *table)
        if (!std::isfinite(temperature) || !param.range.contains(value))
          return OutOfRange{param.key, value, param.range};
    if (const Curves* const curves = curves_over(object, param))
      for (const Curve& curve : *curves)
        for (const auto& [ordinate, abscissa] : curve.points)
          if (!std::isfinite(curve.temperature + ordinate + abscissa))
            return OutOfRange{param.key, curve.temperature + ordinate + abscissa};
    const std::optional<double> value = number_in(object, param.slot);
    if (!value || param.range.contains(*value)) continue;
    if (!param.required && !param.automatic && value == number_in(T{}, param.slot)) continue;
    return OutOfRange{param.key, *value, param.range};
  }
  return std::nullopt;
}

/// The fault that the object itself knows, if its type knows any.
template <class T>
[[nodiscard]] std::optional<Fault> own_fault(const T& object) {
  if constexpr (requires { object.fault(); }) return object.fault();
  return std::nullopt;
}

/// Empty if every parameter of `object` is in its range and they go together, else which one is not
/// and what is needed.
template <class T>
[[nodiscard]] std::string range_problem(const T& object) {
  if (const auto wrong = first_out_of_range(object))
    return out_of_range(wrong->key, wrong->value, wrong->range);
  if (auto fault = own_fault(object)) return std::move(fault->why);
  return {};
}

}  // namespace osculate::core
