#pragma once
// What a contact sample reports and remembers; for sources of this layer.
#include "osculate/pairing/response.hpp"

namespace osculate::pairing {

/// A point that is not in contact, and what it remembers whatever becomes of it.
template <int Dim>
[[nodiscard]] PointResult<Dim> open_result(const contact::PointHistory<Dim>& history,
                                           double weight) {
  PointResult<Dim> result;
  result.weight = weight;
  result.gap = std::numeric_limits<double>::infinity();
  result.history.friction_work = history.friction_work;
  result.history.damping_work = history.damping_work;
  result.history.held = history.held;
  result.history.rest = history.rest;
  return result;
}

/// Where the sample is. `apart`: half thicknesses, and what else of the gap does not count.
template <int Dim>
void report_sample(const ContactSample<Dim>& sample, double apart, PointResult<Dim>& result) {
  result.gap = sample.gap - apart;
  result.foot = sample.foot;
  result.normal = sample.normal;
  result.frame = sample.frame;
  result.history.facet = sample.facet;
  result.history.feature = sample.feature;
  result.history.xi = sample.xi;
  result.history.gap = sample.gap;
}

/// What is reported of the normal direction, whether the point is in contact or was let go.
template <int Dim>
void report_normal(const contact::NormalResponse& normal, double work_before,
                   PointResult<Dim>& result) {
  result.stored = normal.stored;
  result.history.deepest = normal.deepest;
  result.history.damping_work = work_before + result.weight * normal.dissipated;
}

template <int Dim>
[[nodiscard]] ActiveBranch<Dim> branch_of(const contact::TangentialResponse<Dim>& response,
                                          const Mat<Dim, Dim - 1>& frame) {
  if (response.status == contact::Status::stick) return {contact::Branch::stick, Vec<Dim>::Zero()};
  const double size = response.traction.norm();
  if (!(size > 0)) return {contact::Branch::slip, Vec<Dim>::Zero()};
  return {contact::Branch::slip, frame * (response.traction / size)};
}

/// What a sample in contact reports and remembers. `carried` are the components of its shear as
/// they are stored, `before` is its history.
template <int Dim>
void report_contact(const Response<Dim>& r, const Vec<Dim - 1>& carried,
                    const contact::PointHistory<Dim>& before, PointResult<Dim>& result) {
  const contact::TangentialResponse<Dim>& linearised = r.traction.tangential;
  result.status = r.has_shear ? r.law.status : contact::Status::slip;
  result.branch.branch = contact::Branch::slip;
  if (r.has_shear) result.branch = branch_of<Dim>(linearised, result.frame);
  result.stored += r.stored;
  result.normal_traction = r.traction.normal.traction;
  result.shear_traction = r.law.traction;
  result.slip_increment = r.slip;
  contact::PointHistory<Dim>& h = result.history;
  h.active = true;
  h.traction = carried;
  h.slipping = r.law.status == contact::Status::slip;
  h.slip = before.active ? Vec<Dim - 1>(before.slip + r.slip) : r.slip;
  h.slid = before.active ? before.slid + r.slid : r.slid;
  h.memory = r.memory;
  h.friction_work += result.weight * r.dissipated;
}

/// What is remembered of an open sample that is linearised in contact.
template <int Dim>
void report_kept(const Response<Dim>& r, const PointContext<Dim>& context,
                 PointResult<Dim>& result) {
  result.branch.branch = contact::Branch::slip;
  if (r.has_shear) result.branch = branch_of<Dim>(r.traction.tangential, result.frame);
  result.branch.closed = true;
  result.branch.kept_on = context.active.kept_on + 1;
}

}  // namespace osculate::pairing
