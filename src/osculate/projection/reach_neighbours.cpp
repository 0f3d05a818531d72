// Which parts of a surface hang together, for the bound of its reach.
#include "osculate/projection/reach_features.hpp"

namespace osculate::projection {
namespace {

constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

template <int Dim>
bool meet(const CellComplex<Dim>& all, const Owner<Dim>& a, const Owner<Dim>& b) {
  const bool same = a.cell == b.cell;
  if (same && a.range.overlaps(b.range)) return true;
  const Cell &p = all.cell(a.cell), &q = all.cell(b.cell);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      if (same && i == j) continue;  // the ranges know better
      const auto m = at(i), n = at(j);
      if ((a.corners >> i & 1U) != 0 && (b.corners >> j & 1U) != 0 && p.vertex[m] == q.vertex[n])
        return true;
      if ((a.edges >> i & 1U) != 0 && (b.edges >> j & 1U) != 0 && p.group[m] == q.group[n])
        return true;
    }
  return false;
}

}  // namespace

template <int Dim>
bool meet(const CellComplex<Dim>& all, const ReachFeature<Dim>& a, const ReachFeature<Dim>& b) {
  for (const Owner<Dim>& o : a.owners)
    for (const Owner<Dim>& p : b.owners)
      if (meet(all, o, p)) return true;
  return false;
}

template <int Dim>
bool one_graph(const CellComplex<Dim>& all, const ReachFeature<Dim>& a,
               const ReachFeature<Dim>& b) {
  constexpr double narrow = 0.7;  // below 45 degrees
  for (const Owner<Dim>& o : a.owners)
    for (const Owner<Dim>& p : b.owners)
      if (join<Dim>(o.normal, p.normal).angle <= narrow && meet(all, o, p)) return true;
  return false;
}

template bool meet(const CellComplex<2>&, const ReachFeature<2>&, const ReachFeature<2>&);
template bool meet(const CellComplex<3>&, const ReachFeature<3>&, const ReachFeature<3>&);
template bool one_graph(const CellComplex<2>&, const ReachFeature<2>&, const ReachFeature<2>&);
template bool one_graph(const CellComplex<3>&, const ReachFeature<3>&, const ReachFeature<3>&);

}  // namespace osculate::projection
