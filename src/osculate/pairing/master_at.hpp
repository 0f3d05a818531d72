#pragma once
// Where a master is; included by pair.cpp.
#include <vector>

#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// Whether master and slave are farther from each other than the candidate filter reaches; `boxes`
/// are those of the master's facets.
template <int Dim>
bool beyond_search(const PairDefinition<Dim>& pair, Points<Dim> x,
                   const std::vector<search::Box<Dim>>& boxes) {
  if (!pair.filter.limited() || pair.filter.own) return false;
  search::Box<Dim> master, slave;
  for (const search::Box<Dim>& box : boxes) master.extend(box);
  for (const Index node : pair.slave.nodes) slave.extend(x[static_cast<std::size_t>(node)]);
  return master.squared_distance(slave) > pair.filter.distance * pair.filter.distance;
}

/// Whether the master is where it was in the evaluation before, of which `at` has its nodes; then
/// those of this one.
template <int Dim>
bool rests(const Boundary<Dim>& master, Points<Dim> x, std::vector<Vec<Dim>>& at) {
  bool same = true;
  std::size_t k = 0;
  for (const auto& facet : master.facets)
    for (int i = 0; i < facet.count; ++i, ++k) {
      const Vec<Dim>& now = x[static_cast<std::size_t>(facet.nodes[static_cast<std::size_t>(i)])];
      if (k == at.size()) {
        at.push_back(now);
        same = false;
      } else if (!(at[k] == now)) {
        at[k] = now;
        same = false;
      }
    }
  same = same && k == at.size();
  at.resize(k);
  return same;
}

}  // namespace osculate::pairing
