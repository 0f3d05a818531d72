#pragma once
// What every contact pair must do, as GoogleTest expectations.
#include "pair_sample.hpp"

namespace osculate::testing {

/// The first point is in the branch; the error of the tangent falls with the square of the step,
/// while all points keep their status, feature and facet.
template <int Dim>
void expect_pair_tangent(const ContactSample<Dim>& s, contact::Status status,
                         projection::Feature feature, double h);

/// A potential: the tangent is symmetric.
template <int Dim>
void expect_symmetric_tangent(const ContactSample<Dim>& s);

template <int Dim>
Vec<Dim> net_force(const Eigen::VectorXd& r);

/// Moment about the origin; in the plane its one component is the last.
template <int Dim>
Vec3 net_moment(const ContactSample<Dim>& s, const Eigen::VectorXd& r);

}  // namespace osculate::testing
