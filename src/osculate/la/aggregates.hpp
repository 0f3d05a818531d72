#pragma once
#include <span>
#include <vector>

#include "osculate/la/grouped_rows.hpp"

namespace osculate::la {

struct Aggregates {
  Index count = 0;
  std::vector<Index> of_group;  ///< -1: left out
};

/// Neighbouring groups taken together: first whole neighbourhoods that are free, then what touches
/// one of them, then the rest.
///
/// Formula    g and h are neighbours where |A_gh|_F^2 > strength^2 |A_gg|_F |A_hh|_F
/// Shapes     left_out: one per group of rows; columns beyond the rows of `a`, of other processes,
///            do not count
/// Source     P. Vanek, J. Mandel, M. Brezina, Computing 56 (1996) 179-196, section 5.1
/// Tested by  tests/unit/la/test_multigrid.cpp
[[nodiscard]] Aggregates aggregate(const GroupedRows& a, std::span<const char> left_out,
                                   double strength, core::Crew& crew);

}  // namespace osculate::la
