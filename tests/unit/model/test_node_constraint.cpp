#include "osculate/model/node_constraint.hpp"

#include <gtest/gtest.h>

#include <random>

#include "derivative_check.hpp"

namespace osculate::model {
namespace {

using Kind = NodeConstraint::Kind;

/// A constraint at a state far from the undeformed one; variables: places, then the body's motion.
template <int Dim>
struct Setting {
  static constexpr int turns = body::rotations<Dim>;
  NodeConstraint constraint;
  std::vector<Vec<Dim>> reference;
  Eigen::VectorXd at, lambda;
  body::BasicRigidMotion<Dim> rest;

  Setting(Kind kind, std::size_t count) {
    std::mt19937 generator{5};
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto random = [&] { return uniform(generator); };
    constraint.kind = kind;
    constraint.stiffness = 3;
    for (std::size_t n = 0; n < count; ++n) {
      constraint.nodes.push_back(static_cast<Index>(n));
      reference.push_back(Vec<Dim>::NullaryExpr(random));
    }
    Eigen::Index variables = Dim * static_cast<Eigen::Index>(count);
    if (kind == Kind::mean_motion) {
      constraint.body = 0;
      double sum = 0;
      for (std::size_t n = 0; n < count; ++n) {
        constraint.weights.push_back(1.5 + random());
        sum += constraint.weights.back();
      }
      for (double& w : constraint.weights) w /= sum;
      rest.reference = Vec<Dim>::NullaryExpr(random);
      variables += body::motions<Dim>;
    }
    at = Eigen::VectorXd::NullaryExpr(variables, random);
    lambda = Eigen::VectorXd::NullaryExpr(rows<Dim>(constraint), random);
  }
  [[nodiscard]] NodeConstraintValue<Dim> evaluate(const Eigen::VectorXd& v) const {
    std::vector<Vec<Dim>> x;
    for (std::size_t n = 0; n < reference.size(); ++n)
      x.emplace_back(v.segment<Dim>(Dim * static_cast<Eigen::Index>(n)));
    body::BasicRigidMotion<Dim> motion = rest;
    if (constraint.body >= 0)
      for (int i = 0; i < body::motions<Dim>; ++i)
        motion.component(i) = v[Dim * static_cast<Eigen::Index>(x.size()) + i];
    return model::evaluate<Dim>(constraint, reference, x, &motion, lambda);
  }
  /// lambda . dG
  [[nodiscard]] Eigen::VectorXd force(const Eigen::VectorXd& v) const {
    const NodeConstraintValue<Dim> g = evaluate(v);
    Eigen::VectorXd f(v.size());
    f << g.gradient.transpose() * lambda,
        g.of_body.size() > 0 ? Eigen::VectorXd(g.of_body.transpose() * lambda) : Eigen::VectorXd();
    return f;
  }
  [[nodiscard]] Eigen::MatrixXd curvature(const Eigen::VectorXd& v) const {
    const NodeConstraintValue<Dim> g = evaluate(v);
    if (g.mixed.size() == 0) return g.curvature;
    Eigen::MatrixXd h = Eigen::MatrixXd::Zero(v.size(), v.size());
    h.topRightCorner(g.mixed.rows(), turns) = g.mixed;
    h.bottomLeftCorner(turns, g.mixed.rows()) = g.mixed.transpose();
    h.bottomRightCorner(turns, turns) = g.body_curvature;
    return h;
  }
};

void expect_order_two(const testing::DerivativeReport& report) {
  EXPECT_TRUE(report.exact || std::abs(report.order - 2.0) < 0.05)
      << "order " << report.order << ", error " << report.error;
}

template <int Dim>
void expect_derivatives(Kind kind, std::size_t count) {
  const Setting<Dim> s(kind, count);
  std::mt19937 generator{7};
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Eigen::VectorXd d =
      Eigen::VectorXd::NullaryExpr(s.at.size(), [&] { return uniform(generator); });
  const auto value = [&](const Eigen::VectorXd& v) { return s.evaluate(v).value; };
  const NodeConstraintValue<Dim> g = s.evaluate(s.at);
  Eigen::VectorXd dg = g.gradient * d.head(g.gradient.cols());
  if (g.of_body.size() > 0) dg += g.of_body * d.tail(g.of_body.cols());
  expect_order_two(testing::check_derivative(value, dg, s.at, d, 1e-2));
  const auto force = [&](const Eigen::VectorXd& v) { return s.force(v); };
  const Eigen::VectorXd df = s.curvature(s.at) * d;
  EXPECT_GT(df.norm(), 0.1);
  expect_order_two(testing::check_derivative(force, df, s.at, d, 1e-2));
}

TEST(NodeConstraint, DerivativesHaveOrderTwo) {
  expect_derivatives<3>(Kind::plane, 4);
  expect_derivatives<3>(Kind::line, 3);
  expect_derivatives<2>(Kind::line, 3);
  expect_derivatives<3>(Kind::distance, 2);
  expect_derivatives<2>(Kind::distance, 2);
  expect_derivatives<3>(Kind::mean_motion, 5);
  expect_derivatives<2>(Kind::mean_motion, 4);
}

/// Rigid motions of any size fulfil all of them.
TEST(NodeConstraint, VanishesForRigidMotions) {
  for (const auto& [kind, count] : std::vector<std::pair<Kind, std::size_t>>{
           {Kind::plane, 4}, {Kind::line, 3}, {Kind::distance, 2}, {Kind::mean_motion, 6}}) {
    Setting<3> s(kind, count);
    if (kind == Kind::plane)
      s.reference[3] = 0.3 * s.reference[0] + 0.9 * s.reference[1] - 0.2 * s.reference[2];
    if (kind == Kind::line) s.reference[2] = 1.7 * s.reference[0] - 0.7 * s.reference[1];
    body::RigidMotion3 motion = s.rest;
    motion.translation = Vec3(0.4, -2, 1);
    motion.rotation = Vec3(1.1, -0.7, 1.9);
    for (std::size_t n = 0; n < count; ++n)
      s.at.segment<3>(3 * static_cast<Eigen::Index>(n)) = motion.position(s.reference[n]);
    for (int i = 0; kind == Kind::mean_motion && i < 6; ++i)
      s.at[3 * static_cast<Eigen::Index>(count) + i] = motion.component(i);
    EXPECT_LT(s.evaluate(s.at).value.norm(), 1e-14);
  }
}

/// With a small rotation the mean motion is linear, and linearised rigid motions fulfil it.
template <int Dim>
void expect_linear(std::size_t count) {
  Setting<Dim> s(Kind::mean_motion, count);
  s.rest.small = true;
  const NodeConstraintValue<Dim> g = s.evaluate(s.at);
  EXPECT_EQ(g.curvature.size() + g.mixed.size() + g.body_curvature.size(), 0);
  const Eigen::VectorXd d = Eigen::VectorXd::LinSpaced(s.at.size(), -1, 2);
  const Eigen::VectorXd dg =
      g.gradient * d.head(g.gradient.cols()) + g.of_body * d.tail(g.of_body.cols());
  EXPECT_LT((s.evaluate(s.at + d).value - g.value - dg).norm(), 1e-13 * dg.norm());
  body::BasicRigidMotion<Dim> motion = s.rest;
  const auto nodes = Dim * static_cast<Eigen::Index>(count);
  for (int i = 0; i < body::motions<Dim>; ++i) motion.component(i) = s.at[nodes + i];
  for (std::size_t n = 0; n < count; ++n)
    s.at.template segment<Dim>(Dim * static_cast<Eigen::Index>(n)) =
        motion.position(s.reference[n]);
  EXPECT_LT(s.evaluate(s.at).value.norm(), 1e-14);
  EXPECT_GT(g.value.norm(), 0.1);
}
TEST(NodeConstraint, MeanMotionOfASmallRotationIsLinear) {
  expect_linear<2>(4);
  expect_linear<3>(6);
}

/// What acts on the body reaches the nodes as the same force and the same moment.
TEST(NodeConstraint, MeanMotionPassesForcesAndMomentsOn) {
  Setting<3> s(Kind::mean_motion, 6);
  body::RigidMotion3 motion = s.rest;
  motion.rotation = Vec3(0.3, 0.8, -0.5);
  for (std::size_t n = 0; n < 6; ++n)
    s.at.segment<3>(3 * static_cast<Eigen::Index>(n)) = motion.position(s.reference[n]);
  for (int i = 0; i < 6; ++i) s.at[18 + i] = motion.component(i);
  const Eigen::VectorXd f = s.force(s.at);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  for (Eigen::Index n = 0; n < 6; ++n) {
    const Vec3 arm = s.at.segment<3>(3 * n) - motion.center();
    sum += f.segment<3>(3 * n);
    moment += arm.cross(Vec3(f.segment<3>(3 * n)));
  }
  EXPECT_LT((sum + f.segment<3>(18)).norm(), 1e-14);
  const Vec3 of_body = body::rotation_tangent(motion.rotation).transpose() * moment;
  EXPECT_LT((of_body + f.segment<3>(21)).norm(), 1e-13);
}

}  // namespace
}  // namespace osculate::model
