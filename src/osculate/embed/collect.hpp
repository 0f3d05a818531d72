#pragma once
// Inside of the public library; included by its sources only.
#include "osculate/embed/values.hpp"

namespace osculate::embed {

/// Forces, tangent, points and constraints of the host out of the blocks of an evaluation.
template <int Dim>
void collect(bool with_tangent, Evaluation<Dim>& e);

/// The tangent of a block by rectangles: `take` is called with the number of nodes of the columns,
/// their k-th node, and the value in row i and direction d of the k-th of them.
template <int Dim, class Take>
void for_rectangles(const pairing::ContactBlock<Dim>& block, const Take& take) {
  const auto at = [](int k) { return static_cast<std::size_t>(k); };
  if (block.has_tangent())
    take(
        block.count, [&](int k) { return block.nodes[at(k)]; },
        [&](int i, int k, int d) { return block.tangent(i, Dim * k + d); });
  const std::vector<pairing::NodeMatrix<Dim>>& path = block.path();
  if (!path.empty())
    take(
        static_cast<int>(path.size()), [&](int k) { return path[at(k)].node; },
        [&](int i, int k, int d) { return block.path_rows.row(i).dot(path[at(k)].value.col(d)); });
  if (!block.area.empty())
    take(
        static_cast<int>(block.area.size()), [&](int k) { return block.area[at(k)].node; },
        [&](int i, int k, int d) { return block.area_rows[i] * block.area[at(k)].value[d]; });
}

/// Unknowns of one point with unknown tractions.
template <int Dim>
[[nodiscard]] Index unknowns_per_point(const pairing::PairDefinition<Dim>& pair) {
  return pairing::has_shear(pair) ? Dim + 1 : 1;
}

}  // namespace osculate::embed
