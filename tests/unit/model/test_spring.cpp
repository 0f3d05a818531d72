#include "osculate/model/spring.hpp"

#include <gtest/gtest.h>

#include "derivative_check.hpp"

namespace osculate::model {
namespace {

const core::Table curve{{-1, -4}, {0, 1}, {0.5, 2}, {2, 11}};

TEST(Spring, TableIsConstantBeyondItsEnds) {
  Spring spring;
  spring.table = curve;
  EXPECT_EQ(response(spring, -3).force, -4);
  EXPECT_EQ(response(spring, -3).slope, 0);
  EXPECT_EQ(response(spring, 7).force, 11);
  EXPECT_DOUBLE_EQ(response(spring, 1).force, 5);
  EXPECT_DOUBLE_EQ(response(spring, 1).slope, 6);
  EXPECT_EQ(response(spring, 0.5).slope, 6) << "at a corner the slope behind it";
}

/// The force is the derivative of the stored energy, which is 0 without elongation.
TEST(Spring, StoredEnergyIsTheAreaBelowTheForce) {
  Spring linear, table;
  linear.stiffness = 7;
  table.table = curve;
  for (const Spring& spring : {linear, table}) {
    EXPECT_EQ(response(spring, 0).stored, 0);
    for (const double q : {-2.5, -0.4, 0.3, 1.1, 4.0}) {
      constexpr double h = 1e-3;  // within one straight line: exact
      const double slope =
          (response(spring, q + h).stored - response(spring, q - h).stored) / (2 * h);
      EXPECT_NEAR(slope, response(spring, q).force, 1e-11) << q;
    }
  }
  EXPECT_DOUBLE_EQ(response(table, 2).stored, 0.5 * 1.5 + 1.5 * 6.5);
  EXPECT_DOUBLE_EQ(response(table, -2).stored, 4 + 1.5);
}

/// Forces of one GAPUNI in ccx 2.20, which prints seven digits.
TEST(Spring, GapsPushAndHardlyPull) {
  const auto force = [](double clearance, double stiffness, double tension, double q) {
    Spring spring;
    spring.gap = SpringGap{clearance, stiffness, tension};
    return response(spring, q).force;
  };
  EXPECT_NEAR(force(0, 100, 0.1, -0.3), -29.9, 5e-6);
  EXPECT_NEAR(force(0, 100, 0.1, -0.01), -0.9031078, 5e-8);
  EXPECT_NEAR(force(0, 100, 0.1, -0.0001), -0.005101287, 5e-10);
  EXPECT_NEAR(force(0, 100, 0.1, 0.001), 0.04019067, 5e-9);
  EXPECT_NEAR(force(0, 100, 0.1, 0.5), 0.09999868, 5e-9);
  EXPECT_NEAR(force(0.05, 100, 0.1, -0.3), -24.90001, 5e-6);
  EXPECT_NEAR(force(0.05, 100, 0.1, -0.01), 0.09979514, 5e-9);
  EXPECT_NEAR(force(0, 1e12, 1e-3, 0.5), 1e-3, 1e-15) << "no digits are lost far outside";
}

TEST(Spring, GapsHaveASlopeAndAnEnergy) {
  Spring spring;
  spring.gap = SpringGap{0.3, 7, 0.2};
  EXPECT_NEAR(response(spring, 0).stored, 0, 1e-15);
  for (const double q : {-2.0, -0.4, -0.3, -0.1, 1.5}) {
    const Eigen::VectorXd at = Eigen::VectorXd::Constant(1, q), d = Eigen::VectorXd::Ones(1);
    const auto of = [&](double SpringResponse::*what) {
      return [&, what](const Eigen::VectorXd& v) {
        return Eigen::VectorXd(Eigen::VectorXd::Constant(1, response(spring, v[0]).*what));
      };
    };
    const auto expect_order = [&](const testing::DerivativeReport& r) {
      EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << q << ' ' << r.order << ' ' << r.error;
    };
    expect_order(testing::check_derivative(of(&SpringResponse::force),
                                           Eigen::VectorXd::Constant(1, response(spring, q).slope),
                                           at, d, 1e-3));
    expect_order(testing::check_derivative(of(&SpringResponse::stored),
                                           Eigen::VectorXd::Constant(1, response(spring, q).force),
                                           at, d, 1e-3));
  }
}

template <int Dim>
SpringMotion motion(const Spring& spring, const Eigen::VectorXd& u) {
  std::vector<Vec<Dim>> reference{Vec<Dim>::Constant(0.5), Vec<Dim>::LinSpaced(-1, 2)}, x;
  for (std::size_t n = 0; n < 2; ++n)
    x.push_back(reference[n] + u.segment<Dim>(Dim * static_cast<Eigen::Index>(n)));
  return motion_of<Dim>(spring, reference, x, [&](Dof d) { return u[d]; });
}

template <int Dim>
void expect_derivatives(const Spring& spring) {
  const Eigen::VectorXd u = 0.5 * testing::random_direction(2 * Dim, 3),
                        d = testing::random_direction(2 * Dim, 4);
  const SpringMotion m = motion<Dim>(spring, u);
  const auto value = [&](const Eigen::VectorXd& v) {
    return Eigen::VectorXd::Constant(1, motion<Dim>(spring, v).elongation);
  };
  const auto gradient = [&](const Eigen::VectorXd& v) {
    return Eigen::VectorXd(motion<Dim>(spring, v).gradient);
  };
  const auto expect_order = [](const testing::DerivativeReport& r) {
    EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.05) << r.order << ' ' << r.error;
  };
  expect_order(testing::check_derivative(value, Eigen::VectorXd::Constant(1, m.gradient.dot(d)), u,
                                         d, 1e-2));
  const Eigen::VectorXd turned =
      m.curvature.size() > 0 ? Eigen::VectorXd(m.curvature * d) : Eigen::VectorXd::Zero(2 * Dim);
  if (spring.turns)
    expect_order(testing::check_derivative(gradient, turned, u, d, 1e-2));
  else
    EXPECT_EQ(gradient(u), gradient(Eigen::VectorXd(u + d)));
}

TEST(Spring, DerivativesHaveOrderTwo) {
  Spring spring;
  spring.ends = {0, 1};
  expect_derivatives<2>(spring);
  expect_derivatives<3>(spring);
  spring.turns = false;
  expect_derivatives<3>(spring);
}

/// Rigid motions do not stretch it, and its forces balance with their moments.
TEST(Spring, KnowsNoRigidMotion) {
  Spring spring;
  spring.ends = {0, 1};
  const Vec2 a = Vec2::Constant(0.5), b(-1, 2);
  const auto turned = [](const Vec2& x) {
    return Vec2(0.6 * x.x() - 0.8 * x.y() + 4, 0.8 * x.x() + 0.6 * x.y() - 1);
  };
  Eigen::VectorXd u(4);
  u << turned(a) - a, turned(b) - b;
  const SpringMotion m = motion<2>(spring, u);
  EXPECT_NEAR(m.elongation, 0, 1e-15);
  EXPECT_LT((m.gradient.head<2>() + m.gradient.tail<2>()).norm(), 1e-15);
  const Vec2 arm = turned(b) - turned(a), force = m.gradient.tail<2>();
  EXPECT_NEAR(arm.x() * force.y() - arm.y() * force.x(), 0, 1e-14);
}

TEST(Spring, NodesAtOnePlaceHaveTheFirstDirection) {
  Spring spring;
  spring.ends = {0, 1};
  Eigen::VectorXd u(4);
  u << 0, 0, 1.5, -1.5;
  const SpringMotion m = motion<2>(spring, u);
  EXPECT_NEAR(m.elongation, -Vec2(1.5, -1.5).norm(), 1e-15);
  EXPECT_TRUE(m.gradient.allFinite());
  EXPECT_EQ(m.curvature.size(), 0);
}

}  // namespace
}  // namespace osculate::model
