#pragma once
// The branch of the friction law that a contact point is linearised in; for sources of this layer.
#include <algorithm>
#include <cmath>

#include "osculate/pairing/point_evaluation.hpp"

namespace osculate::pairing {

/// The part in contact of a point that was open at the start of the increment (`history`).
template <int Dim>
[[nodiscard]] ContactShare contact_share(const contact::PointHistory<Dim>& history, double gap) {
  if (history.active || history.facet < 0 || !(history.gap > 0)) return {};
  const double range = history.gap - gap;
  return {-gap / range, -history.gap / (range * range)};
}

/// The law's answer, or the branch that the hint keeps it in.
template <int Dim>
[[nodiscard]] contact::TangentialResponse<Dim> linearised_branch(
    const contact::Coulomb& law, const contact::TangentialResponse<Dim>& response,
    const Vec<Dim - 1>& trial, double normal, const Mat<Dim, Dim - 1>& frame,
    const BranchHint<Dim>& hint) {
  if (hint.predict && hint.assumed.branch == contact::Branch::stick)
    return contact::Coulomb::stick<Dim>(trial);  // also on the limit, whatever round-off says
  if (hint.assumed.branch != contact::Branch::slip) return response;
  const Vec<Dim - 1> before = frame.transpose() * hint.assumed.direction;
  const double size = before.norm();
  if (!(size > 0)) return response;
  if (hint.predict) {
    const double limit = law.mu * std::abs(normal);
    const double turning = limit > 0 ? limit / std::max(limit, trial.norm()) : 0.0;
    return law.template slip<Dim>(before / size, normal, turning);
  }
  const bool reversed = response.status == contact::Status::slip && before.dot(trial) < 0;
  return reversed ? contact::Coulomb::stick<Dim>(trial) : response;
}

template <int Dim>
[[nodiscard]] AssumedBranch<Dim> branch_of(const contact::TangentialResponse<Dim>& response,
                                           const Mat<Dim, Dim - 1>& frame) {
  if (response.status == contact::Status::stick) return {contact::Branch::stick, Vec<Dim>::Zero()};
  const double size = response.traction.norm();
  if (!(size > 0)) return {contact::Branch::slip, Vec<Dim>::Zero()};
  return {contact::Branch::slip, frame * (response.traction / size)};
}

}  // namespace osculate::pairing
