#pragma once
// What every mortar pair must do, as GoogleTest expectations.
#include <string>

#include "mortar_sample.hpp"

namespace osculate::testing {

/// The error of the tangent falls with the square of the step, in one branch of contact and with
/// the same facets over each other.
template <int Dim>
void expect_second_order(const ContactSample<Dim>& s, double h, const std::string& what);

/// The forces of both sides are opposite, in the residual and in every row and column of the
/// tangent.
template <int Dim>
void expect_balance(const ContactSample<Dim>& s);

/// Of the slave's nodes alone.
template <int Dim>
Eigen::VectorXd slave_forces(const ContactSample<Dim>& s);

/// Flat surfaces at the gap -0.05 with the penalty 1000: the pressure is 50 and the nodal forces of
/// the side that is wholly covered are those of a uniform pressure.
template <int Dim>
void expect_uniform_pressure(const ContactSample<Dim>& s, bool master_covered, double area,
                             double tolerance);

}  // namespace osculate::testing
