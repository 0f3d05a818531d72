#pragma once
#include <limits>
#include <span>
#include <vector>

#include "osculate/types.hpp"

namespace osculate {

/// How far the sides may move from where they are.
struct Reach {
  double motion = 0;  ///< of every node, at most [length]
  /// A promise of the host's, where there is no search distance: points in contact are not farther
  /// than this from their place on the master.
  double distance = std::numeric_limits<double>::infinity();
};

/// A slave point and a facet of the master that it may press on.
struct Coupling {
  Index point, facet;
};

/// Where entries of a tangent may be, before it is evaluated (Evaluator::pattern).
///
/// Holds      for all evaluations at coordinates of which no node is farther than `reach.motion`
///            from those of the pattern, from its history or, but for contact of a surface with
///            itself or by a search distance, one that such evaluations have committed; with active
///            sets of such evaluations, or none
/// Tested by  tests/unit/embed/test_pattern.cpp (in random trials)
struct Pattern {
  int dimension = 0;
  std::vector<Coupling> couplings;  ///< ascending
  /// In compressed rows the nodes whose coordinates the forces of a node may depend on, ascending:
  /// entries of Result::tangent lie in these blocks of dimension x dimension.
  std::vector<Index> row_start, columns;
  /// Likewise of each slave point: nodes that its constraints may be entries of
  /// (Constraints::rows and columns).
  std::vector<Index> point_start, point_nodes;
};

/// Rows and ascending columns of a matrix.
template <class Number>
struct CsrPattern {
  std::vector<Number> row_start, columns;
};

/// The places of a pattern in a matrix of `rows` rows of a host's, with maps of coordinates as
/// those of CsrMatrix: what a map has below `base` is left out.
///
/// Errors     Refused for maps that are too short, and for rows that the matrix does not have
template <class Number>
[[nodiscard]] CsrPattern<Number> csr_pattern(const Pattern& pattern, std::span<const Number> row_of,
                                             std::span<const Number> column_of, Number rows,
                                             Number base = 0);

extern template CsrPattern<std::int32_t> csr_pattern(const Pattern&, std::span<const std::int32_t>,
                                                     std::span<const std::int32_t>, std::int32_t,
                                                     std::int32_t);
extern template CsrPattern<std::int64_t> csr_pattern(const Pattern&, std::span<const std::int64_t>,
                                                     std::span<const std::int64_t>, std::int64_t,
                                                     std::int64_t);

}  // namespace osculate
