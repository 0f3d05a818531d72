#pragma once
#include <vector>

#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// Of the traction at a slave point: on its own surface the other side of the contact carries half.
template <int Dim>
[[nodiscard]] double pass_factor(const PairDefinition<Dim>& pair) {
  return pair.filter.own ? 0.5 : pair.pass_factor;
}

/// What the traction of point i is multiplied by: 1 or its area.
template <int Dim>
[[nodiscard]] double point_weight(const PairDefinition<Dim>& pair, const PairEvaluation<Dim>& work,
                                  std::size_t i) {
  const double share = pass_factor(pair);
  switch (pair.weight) {
    case Weight::node:
      return share;
    case Weight::reference_area:
      return share * pair.reference_areas[i];
    case Weight::current_area:
      return share * work.areas[i];
  }
  return share;
}

/// The same for a place with this normal. With a candidate filter only the facets that face the
/// master count.
template <int Dim>
[[nodiscard]] double facing_weight(const PairDefinition<Dim>& pair, const PairEvaluation<Dim>& work,
                                   std::size_t i, const Vec<Dim>& normal) {
  if (!pair.filter.limited() || pair.weight == Weight::node) return point_weight(pair, work, i);
  const std::vector<double>& areas =
      pair.weight == Weight::reference_area ? pair.filter.areas : work.filter.areas;
  double sum = 0;
  for_each_facing(pair.filter, work.filter, i, normal,
                  [&](std::size_t part) { sum += areas[part]; });
  return pass_factor(pair) * sum;
}

/// Derivatives of the area in it.
template <int Dim>
void add_area_gradient(const PairDefinition<Dim>& pair, const PairEvaluation<Dim>& work,
                       std::size_t i, const Vec<Dim>& normal,
                       std::vector<NodeGradient<Dim>>& gradient) {
  if (!pair.filter.limited()) {
    gradient = work.area_gradients[i];
    return;
  }
  for_each_facing(pair.filter, work.filter, i, normal, [&](std::size_t part) {
    const auto& more = work.filter.area_gradients[part];
    gradient.insert(gradient.end(), more.begin(), more.end());
  });
}

}  // namespace osculate::pairing
