// Variations of the kinematics on edges and at corners in space by convergence order: outside a
// convex edge and on the penetrated side of a re-entrant vertex, straight and curved, near and far.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <string>

#include "derivative_check.hpp"
#include "osculate/cell/line_shape.hpp"
#include "osculate/contact/kinematics.hpp"

namespace osculate::contact {
namespace {

using osculate::testing::check_derivative;
using osculate::testing::DerivativeReport;

geometry::CurveJet<3> jet_of(int count, const Eigen::VectorXd& x, double xi) {
  const cell::LineShape shape = cell::lagrange_line(count, xi);
  geometry::CurveJet<3> jet;
  for (int k = 0; k < count; ++k) {
    const Vec3 node = x.segment<3>(3 * k);
    const auto i = static_cast<std::size_t>(k);
    jet.r += shape.n[0][i] * node;
    jet.r1 += shape.n[1][i] * node;
    jet.r2 += shape.n[2][i] * node;
    jet.r3 += shape.n[3][i] * node;
  }
  return jet;
}

constexpr double foot_at = 0.3;
const Vec3 outward(0.1, -0.2, 1.0);

/// Nodes of an edge, then the slave point at the signed distance `gap` of the foot point, in a
/// direction `lean` away from the averaged normal of the faces.
Eigen::VectorXd coordinates(int count, double gap, double lean) {
  Eigen::VectorXd x(3 * count + 3);
  x.setZero();
  x.segment<3>(0) = Vec3(0, 0, 0);
  x.segment<3>(3) = Vec3(3, 1, 0.4);
  if (count == 3) x.segment<3>(6) = Vec3(1.4, 0.9, -0.1);
  const geometry::CurveJet<3> jet = jet_of(count, x, foot_at);
  const Vec3 along = jet.r1.normalized();
  const Vec3 up = (outward - along * along.dot(outward)).normalized();
  x.tail<3>() = jet.r + gap * (std::cos(lean) * up + std::sin(lean) * along.cross(up));
  return x;
}

double foot(int count, const Eigen::VectorXd& x) {
  double xi = foot_at;
  for (int i = 0; i < 20; ++i) {
    const geometry::CurveJet<3> jet = jet_of(count, x, xi);
    const Vec3 offset = x.tail<3>() - jet.r;
    xi += offset.dot(jet.r1) / (jet.r1.squaredNorm() - offset.dot(jet.r2));
  }
  return xi;
}

Kinematics<3> on_edge(int count, const Eigen::VectorXd& x) {
  return edge_kinematics(jet_of(count, x, foot(count, x)), x.tail<3>(), outward);
}

/// What a Form makes of the direction `d`: the slave's weights are 1, the edge's -N and -N'.
struct Relative {
  std::array<Vec3, 3> v;  // slots 0, first, second (no form here depends on the last)
  [[nodiscard]] double of(const Form<3>& f) const {
    return f[0].dot(v[0]) + f[first_slot(0)].dot(v[1]);
  }
  [[nodiscard]] Vec3 of(const VectorForm<3>& f) const {
    return f[0] * v[0] + f[first_slot(0)] * v[1];
  }
};

Relative relative(int count, const Eigen::VectorXd& d) {
  const cell::LineShape shape = cell::lagrange_line(count, foot_at);
  Relative r{{Vec3(d.tail<3>()), Vec3::Zero(), Vec3::Zero()}};
  for (int k = 0; k < count; ++k)
    for (std::size_t s = 0; s < 3; ++s)
      r.v[s] -= shape.n[s][static_cast<std::size_t>(k)] * Vec3(d.segment<3>(3 * k));
  return r;
}

Eigen::VectorXd direction(Eigen::Index size, int seed) {
  Eigen::VectorXd d(size);
  for (Eigen::Index i = 0; i < size; ++i) d[i] = std::sin(1.7 * static_cast<double>(i) + seed);
  return d;
}

void expect_second_order(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f,
                         const Eigen::VectorXd& derivative, const Eigen::VectorXd& x,
                         const Eigen::VectorXd& d, double h, const std::string& what) {
  const DerivativeReport r = check_derivative(f, derivative, x, d, h);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1)
      << what << ": order " << r.order << " error " << r.error;
}

Eigen::VectorXd single(double value) { return Eigen::VectorXd::Constant(1, value); }

TEST(EdgeKinematics, VariationsAreDerivativesOnBothSides) {
  for (const int count : {2, 3})
    for (const double gap : {0.5, 0.01, -0.01, -0.5})
      for (int seed = 1; seed <= 3; ++seed) {
        const std::string what = std::to_string(count) + " nodes, gap " + std::to_string(gap);
        const Eigen::VectorXd x = coordinates(count, gap, 0.4), d = direction(x.size(), seed);
        const Kinematics<3> k = on_edge(count, x);
        const Relative v = relative(count, d);
        const double h = 0.02 * std::abs(gap);
        ASSERT_NEAR(foot(count, x), foot_at, 1e-14) << what;
        ASSERT_NEAR(k.gap, gap, 1e-14) << what;
        EXPECT_NEAR(k.offset_metric(0, 0), k.rho1[0].squaredNorm() - gap * k.normal.dot(k.rho2[0]),
                    1e-13);
        expect_second_order([&](const Eigen::VectorXd& y) { return single(foot(count, y)); },
                            single(v.of(k.d_xi[0])), x, d, h, what + " xi");
        expect_second_order([&](const Eigen::VectorXd& y) { return single(on_edge(count, y).gap); },
                            single(v.of(k.d_gap)), x, d, h, what + " gap");
        expect_second_order(
            [&](const Eigen::VectorXd& y) { return Eigen::VectorXd(on_edge(count, y).normal); },
            Eigen::VectorXd(v.of(k.d_normal)), x, d, h, what + " normal");
        expect_second_order(
            [&](const Eigen::VectorXd& y) { return Eigen::VectorXd(on_edge(count, y).rho1[0]); },
            Eigen::VectorXd(v.of(k.d_rho1[0])), x, d, h, what + " base vector");
      }
}

TEST(EdgeKinematics, NormalPointsOutOfTheMasterOnBothSides) {
  for (const int count : {2, 3}) {
    const Kinematics<3> above = on_edge(count, coordinates(count, 0.2, 0.4)),
                        below = on_edge(count, coordinates(count, -0.2, 0.4));
    EXPECT_GT(above.normal.dot(outward), 0);
    EXPECT_LT((above.normal - below.normal).norm(), 1e-14);
    EXPECT_NEAR(above.normal.dot(above.rho1[0]), 0.0, 1e-14);
  }
}

TEST(CornerKinematicsInSpace, VariationsAreDerivativesOnBothSides) {
  for (const double gap : {0.5, 0.01, -0.01, -0.5})
    for (int seed = 1; seed <= 3; ++seed) {
      Eigen::VectorXd x(6);
      x << 1, 2, 3, 0, 0, 0;
      x.tail<3>() = x.head<3>() + gap * Vec3(0.3, -0.1, 0.9).normalized();
      const Eigen::VectorXd d = direction(6, seed);
      const auto at = [&](const Eigen::VectorXd& y) {
        return corner_kinematics<3>(y.head<3>(), y.tail<3>(), outward);
      };
      const Kinematics<3> k = at(x);
      const Vec3 v = d.tail<3>() - d.head<3>();
      EXPECT_NEAR(k.gap, gap, 1e-14);
      EXPECT_EQ(k.moving, 0u);
      const double h = 0.02 * std::abs(gap);
      expect_second_order([&](const Eigen::VectorXd& y) { return single(at(y).gap); },
                          single(k.d_gap[0].dot(v)), x, d, h, "gap");
      expect_second_order([&](const Eigen::VectorXd& y) { return Eigen::VectorXd(at(y).normal); },
                          Eigen::VectorXd(k.d_normal[0] * v), x, d, h, "normal");
    }
}

}  // namespace
}  // namespace osculate::contact
