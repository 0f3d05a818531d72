#pragma once
#include <span>
#include <string>
#include <vector>

#include "osculate/deck/parameters.hpp"

namespace osculate::app {

/// A parameter of the model file with the values that a study gives it.
struct Range {
  std::string name;
  std::vector<std::string> values;
  std::vector<double> numbers;  ///< the same; empty: one of them is a text
  bool logarithmic = false;     ///< they were asked for so
};

/// A value is a number, a text, or `from:to:count`, and with `:log` the same in equal ratios;
/// several stand behind commas.
///
/// Errors     core::InputError for what is no range, and for a value that is there twice
[[nodiscard]] std::vector<Range> ranges_of(std::span<const deck::Setting> given);

/// One value of each parameter: what a run is given.
using Point = std::vector<deck::Setting>;

/// All combinations, the last parameter fastest; `together`: the first of all, the second of all,
/// ..., where a parameter with one value keeps it.
///
/// Errors     core::InputError for more runs than anybody waits for, and for parameters that cannot
///            go together
[[nodiscard]] std::vector<Point> points_of(std::span<const Range> ranges, bool together);

/// `mu=0.2,side=0.1`, as a folder may be called.
[[nodiscard]] std::string name_of(const Point& point);
/// A text without what folders and files cannot be called by.
[[nodiscard]] std::string file_name(std::string text);

}  // namespace osculate::app
