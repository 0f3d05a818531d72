#include "mortar_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "expect_derivative.hpp"

namespace osculate::testing {

template <int Dim>
void expect_second_order(const ContactSample<Dim>& s, double h, const std::string& what) {
  SCOPED_TRACE(what);
  const Eigen::VectorXd v = flatten(s.x);
  const std::vector<contact::Status> status = pair_status(s, v);
  ASSERT_TRUE(std::any_of(status.begin(), status.end(),
                          [](contact::Status at) { return at != contact::Status::open; }));
  const auto branch = [&](const Eigen::VectorXd& y) {
    return std::pair(pair_status(s, y), mortar_overlaps(s, y));
  };
  expect_derivative([&](const Eigen::VectorXd& y) { return pair_residual(s, y); },
                    pair_tangent(s, v), branch, v, h, 2);
}

template <int Dim>
void expect_balance(const ContactSample<Dim>& s) {
  const Eigen::VectorXd r = pair_residual(s, flatten(s.x));
  const Eigen::MatrixXd k = pair_tangent(s, flatten(s.x));
  for (int i = 0; i < Dim; ++i) {
    Eigen::VectorXd along = Eigen::VectorXd::Zero(r.size());
    for (Eigen::Index n = 0; n < r.size() / Dim; ++n) along[Dim * n + i] = 1;
    EXPECT_LT(std::abs(along.dot(r)), 1e-13 * r.norm());
    EXPECT_LT((k * along).norm(), 1e-11 * k.norm());
    EXPECT_LT((along.transpose() * k).norm(), 1e-11 * k.norm());
  }
}

template <int Dim>
Eigen::VectorXd slave_forces(const ContactSample<Dim>& s) {
  const Eigen::MatrixXd all = pair_residual(s, flatten(s.x)).reshaped(Dim, s.x.size());
  return all(Eigen::all, s.pair.slave.nodes).reshaped();
}

template <int Dim>
void expect_uniform_pressure(const ContactSample<Dim>& s, bool master_covered, double area,
                             double tolerance) {
  constexpr double pressure = 50;
  const pairing::PairEvaluation<Dim> e = pair_evaluation(s, flatten(s.x));
  double total = 0;
  for (const pairing::PointResult<Dim>& p : e.points) {
    if (p.status == contact::Status::open) continue;
    EXPECT_NEAR(p.normal_traction, -pressure, tolerance * pressure);
    total += p.weight;
  }
  EXPECT_NEAR(total, area, tolerance * area);
  const Eigen::VectorXd r = pair_residual(s, flatten(s.x));
  const pairing::Boundary<Dim>& side = master_covered ? s.pair.master : s.pair.slave.boundary;
  const Eigen::VectorXd expected = pressure * uniform_shares(s, side);
  for (Eigen::Index n = 0; n < expected.size(); ++n) {
    if (expected[n] == 0) continue;
    EXPECT_NEAR(r.segment<Dim>(Dim * n).norm(), std::abs(expected[n]), tolerance * pressure * area);
  }
}

template void expect_second_order(const ContactSample<2>&, double, const std::string&);
template void expect_second_order(const ContactSample<3>&, double, const std::string&);
template void expect_balance(const ContactSample<2>&);
template void expect_balance(const ContactSample<3>&);
template Eigen::VectorXd slave_forces(const ContactSample<2>&);
template Eigen::VectorXd slave_forces(const ContactSample<3>&);
template void expect_uniform_pressure(const ContactSample<2>&, bool, double, double);
template void expect_uniform_pressure(const ContactSample<3>&, bool, double, double);

}  // namespace osculate::testing
