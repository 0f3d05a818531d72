#pragma once
#include <algorithm>
#include <iterator>

namespace osculate::material {

/// The rows around a value of what they are ordered by.
///
/// Formula    below + weight (above - below) is linear between rows; beyond the ends both are the
///            last row, and the weight is 0
template <class Row>
struct Between {
  const Row& below;
  const Row& above;
  double weight = 0;
};

/// `of`: what a row stands for.
///
/// Requires   the rows are not empty, what they stand for increases
/// Tested by  tests/unit/material/test_over_temperature.cpp, test_curves.cpp, test_expansion.cpp
template <class Rows, class Of>
[[nodiscard]] auto between(const Rows& rows, double value, const Of& of) {
  using Row = typename Rows::value_type;
  const auto above = std::find_if(std::begin(rows), std::end(rows),
                                  [&](const Row& row) { return of(row) > value; });
  if (above == std::begin(rows)) return Between<Row>{rows.front(), rows.front()};
  if (above == std::end(rows)) return Between<Row>{rows.back(), rows.back()};
  const Row& below = *std::prev(above);
  return Between<Row>{below, *above, (value - of(below)) / (of(*above) - of(below))};
}

}  // namespace osculate::material
