#pragma once
// Penalties of single points.
#include <algorithm>

#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// What the pair's penalties are multiplied by at slave point i; 1 at what is no slave point.
template <int Dim>
[[nodiscard]] RelativeStiffness relative_stiffness(const PairDefinition<Dim>& pair, std::size_t i) {
  return i < pair.relative_stiffness.size() ? pair.relative_stiffness[i] : RelativeStiffness{};
}

/// eps_N and eps_T of a point, as they are without the stiffening of an augmented Lagrangian.
struct PointPenalty {
  double normal = 0;  ///< 0: the law has none
  double shear = 0;   ///< 0: no shear traction
};

/// Penalties of slave point i: everything that asks for the penalty of a point asks here.
///
/// Formula    eps_N,i = f_N,i eps_N ,  eps_T,i = f_T,i eps_T ; without friction eps_T,i = eps_N,i
///            where re-entrant vertices ask for an unknown shear
/// Tested by  tests/unit/pairing/test_point_penalty.cpp
template <int Dim>
[[nodiscard]] PointPenalty point_penalty(const PairDefinition<Dim>& pair, std::size_t i) {
  const RelativeStiffness own = relative_stiffness(pair, i);
  const double normal = own.normal * contact::penalty_of(pair.normal);
  if (pair.friction) return {normal, own.shear * contact::stiffness(*pair.friction)};
  return {normal, has_reentrant_vertices(pair) ? normal : 0.0};
}

/// Penalties of the slave's points.
struct PenaltyRange {
  PointPenalty smallest, mean, largest;
};

/// Over all points; the mean by their areas where they have some.
///
/// Tested by  tests/unit/pairing/test_point_penalty.cpp
template <int Dim>
[[nodiscard]] PenaltyRange penalty_range(const PairDefinition<Dim>& pair) {
  PenaltyRange r;
  double sum = 0;
  for (std::size_t i = 0; i < pair.slave.points.size(); ++i) {
    const PointPenalty own = point_penalty(pair, i);
    const double area = pair.weight == Weight::node ? 1.0 : pair.reference_areas[i];
    if (i == 0) r.smallest = r.largest = own;
    r.smallest = {std::min(r.smallest.normal, own.normal), std::min(r.smallest.shear, own.shear)};
    r.largest = {std::max(r.largest.normal, own.normal), std::max(r.largest.shear, own.shear)};
    r.mean = {r.mean.normal + area * own.normal, r.mean.shear + area * own.shear};
    sum += area;
  }
  if (sum > 0) r.mean = {r.mean.normal / sum, r.mean.shear / sum};
  return r;
}

}  // namespace osculate::pairing
