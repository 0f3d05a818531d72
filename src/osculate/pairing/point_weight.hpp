#pragma once
#include <vector>

#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// Of the traction at a slave point: on its own surface the other side of the contact carries half.
template <int Dim>
[[nodiscard]] double side_share(const PairDefinition<Dim>& pair) {
  return pair.scope.own ? 0.5 : pair.share;
}

/// What the traction of point i is multiplied by: 1 or its area.
template <int Dim>
[[nodiscard]] double point_weight(const PairDefinition<Dim>& pair, const PairEvaluation<Dim>& work,
                                  std::size_t i) {
  const double share = side_share(pair);
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

/// The same for a place with this normal. With a scope only the facets that face the master count.
template <int Dim>
[[nodiscard]] double facing_weight(const PairDefinition<Dim>& pair, const PairEvaluation<Dim>& work,
                                   std::size_t i, const Vec<Dim>& normal) {
  if (!pair.scope.limited() || pair.weight == Weight::node) return point_weight(pair, work, i);
  const std::vector<double>& areas =
      pair.weight == Weight::reference_area ? pair.scope.areas : work.scope.areas;
  double sum = 0;
  for_each_facing(pair.scope, work.scope, i, normal, [&](std::size_t part) { sum += areas[part]; });
  return side_share(pair) * sum;
}

/// Derivatives of the area in it.
template <int Dim>
void add_area_gradient(const PairDefinition<Dim>& pair, const PairEvaluation<Dim>& work,
                       std::size_t i, const Vec<Dim>& normal,
                       std::vector<NodeGradient<Dim>>& gradient) {
  if (!pair.scope.limited()) {
    gradient = work.area_gradients[i];
    return;
  }
  for_each_facing(pair.scope, work.scope, i, normal, [&](std::size_t part) {
    const auto& more = work.scope.area_gradients[part];
    gradient.insert(gradient.end(), more.begin(), more.end());
  });
}

}  // namespace osculate::pairing
