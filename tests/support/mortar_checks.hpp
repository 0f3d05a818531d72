#pragma once
// What every mortar pair must do, as GoogleTest expectations.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "expect_derivative.hpp"
#include "mortar_sample.hpp"

namespace osculate::testing {

/// The error of the tangent falls with the square of the step, in one branch of contact and with
/// the same facets over each other.
template <int Dim>
void expect_second_order(const MortarSample<Dim>& s, double h, const std::string& what) {
  SCOPED_TRACE(what);
  const Eigen::VectorXd v = flat<Dim>(s.x);
  const std::vector<contact::Status> status = mortar_status(s, v);
  ASSERT_TRUE(std::any_of(status.begin(), status.end(),
                          [](contact::Status at) { return at != contact::Status::open; }));
  const auto branch = [&](const Eigen::VectorXd& y) {
    return std::pair(mortar_status(s, y), mortar_overlaps(s, y));
  };
  expect_derivative([&](const Eigen::VectorXd& y) { return mortar_residual(s, y); },
                    mortar_tangent(s, v), branch, v, h, 2);
}

/// The forces of both sides are opposite, in the residual and in every row and column of the
/// tangent.
template <int Dim>
void expect_balance(const MortarSample<Dim>& s) {
  const Eigen::VectorXd r = mortar_residual(s, flat<Dim>(s.x));
  const Eigen::MatrixXd k = mortar_tangent(s, flat<Dim>(s.x));
  for (int i = 0; i < Dim; ++i) {
    Eigen::VectorXd along = Eigen::VectorXd::Zero(r.size());
    for (Eigen::Index n = 0; n < r.size() / Dim; ++n) along[Dim * n + i] = 1;
    EXPECT_LT(std::abs(along.dot(r)), 1e-13 * r.norm());
    EXPECT_LT((k * along).norm(), 1e-11 * k.norm());
    EXPECT_LT((along.transpose() * k).norm(), 1e-11 * k.norm());
  }
}

/// Flat surfaces at the gap -0.05 with the penalty 1000: the pressure is 50 and the nodal forces of
/// the side that is wholly covered are those of a uniform pressure.
template <int Dim>
void expect_uniform_pressure(const MortarSample<Dim>& s, bool master_covered, double area,
                             double tolerance) {
  constexpr double pressure = 50;
  const pairing::PairEvaluation<Dim> e = mortar_evaluation(s, flat<Dim>(s.x));
  double total = 0;
  for (const pairing::PointResult<Dim>& p : e.points) {
    if (p.status == contact::Status::open) continue;
    EXPECT_NEAR(p.normal_traction, -pressure, tolerance * pressure);
    total += p.weight;
  }
  EXPECT_NEAR(total, area, tolerance * area);
  const Eigen::VectorXd r = mortar_residual(s, flat<Dim>(s.x));
  const pairing::Boundary<Dim>& side = master_covered ? s.pair.master : s.pair.slave.boundary;
  const Eigen::VectorXd expected = pressure * uniform_shares(s, side);
  for (Eigen::Index n = 0; n < expected.size(); ++n) {
    if (expected[n] == 0) continue;
    EXPECT_NEAR(r.segment<Dim>(Dim * n).norm(), std::abs(expected[n]), tolerance * pressure * area);
  }
}

}  // namespace osculate::testing
