// Tangent terms of one contact point: the covariant parts and the signs of docs/errata.md.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "osculate/contact/point_terms.hpp"

namespace osculate::contact {
namespace {

// [eq:KS2D:54] [eq:KS2D:56] [eq:KS2D:58] in physical components: T = sqrt(a11) t, rho_xi =
// sqrt(a11) tau.
TEST(CovariantTerms, PartsInPhysicalComponents) {
  geometry::CurveJet<2> jet;
  jet.r1 = {2, 1};
  jet.r2 = {0.3, -0.4};
  const Kinematics<2> k = face_kinematics(jet, Vec2(0.05, -0.1));
  const double kappa = k.curvature(0, 0) / k.metric(0, 0);
  const Vec2 tau = k.frame, nu = k.normal;
  for (const Status status : {Status::stick, Status::slip}) {
    const double shear = 3.0, normal = -10.0;
    Traction<2> t;
    t.normal = {true, normal, 1000.0};
    t.tangential.status = status;
    t.tangential.traction[0] = shear;
    t.tangential.d_predictor(0, 0) = status == Status::stick ? 1.0 : 0.0;
    t.tangential.d_normal[0] = status == Status::stick ? 0.0 : -0.3;
    t.stiffness = 80.0;
    const auto part = [&](bool main, bool rotational, bool curvature) {
      return covariant_terms(k, t, ResidualForm::surface, {false, main, rotational, curvature});
    };
    const double first = status == Status::stick ? 1.0 : 2.0;
    const Mat<2, 2> bend = -normal * kappa * tau * tau.transpose() +
                           shear * kappa * (first * tau * nu.transpose() + nu * tau.transpose());
    EXPECT_LT((part(false, false, true).m[0][0] - bend).norm(), 1e-13);
    const Mat<2, 2> main =
        1000.0 * nu * nu.transpose() + (status == Status::stick
                                            ? Mat<2, 2>(80.0 * tau * tau.transpose())
                                            : Mat<2, 2>(-0.3 * 1000.0 * tau * nu.transpose()));
    EXPECT_LT((part(true, false, false).m[0][0] - main).norm(), 1e-12);
    const Mat<2, 2> turned =
        (normal * nu * tau.transpose() + shear * tau * tau.transpose()) / k.rho1[0].norm();
    EXPECT_LT((part(false, true, false).m[1][0] - turned).norm(), 1e-13);
    const Mat<2, 2> other =
        (normal * tau * nu.transpose() + shear * tau * tau.transpose()) / k.rho1[0].norm();
    EXPECT_LT((part(false, true, false).m[0][1] - other).norm(), 1e-13);
  }
}

/// Point on a straight segment of length 2 (a11 = 1), touching, nothing carried.
Kinematics<2> touching() {
  geometry::CurveJet<2> jet;
  jet.r1 = {1, 0};
  return face_kinematics(jet, Vec2(0, 0));
}

Traction<2> sticking(double penalty) {
  Traction<2> t;
  t.normal = {true, 0.0, penalty};
  t.tangential = stick_response<2>(Vec<1>(0.0));
  t.stiffness = penalty;
  t.d_predictor.add(Vec2(penalty, 0), touching().d_xi[0]);  // a11 = 1
  return t;
}

/// 6 x 6 stiffness for xi = 0: weights 1 of the slave, -1/2 of both master nodes; their
/// derivatives 0, 1/2, -1/2.
Eigen::MatrixXd stiffness(const PointTerms<2>& terms) {
  const std::array<Eigen::Vector3d, 2> w{Eigen::Vector3d(1, -0.5, -0.5),
                                         Eigen::Vector3d(0, 0.5, -0.5)};
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(6, 6);
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t b = 0; b < 2; ++b)
      for (Eigen::Index i = 0; i < 3; ++i)
        for (Eigen::Index j = 0; j < 3; ++j)
          k.block<2, 2>(2 * i, 2 * j) += w[a][i] * w[b][j] * terms.m[a][b];
  return k;
}

// [eq:KS2D:31] [eq:KS2D:56] errata: with T = -eps_T a11 dxi in one sum with N the stick stiffness
// is negative. Both tangents are positive here: eigenvalues eps_N w.w and eps_T w.w, w.w = 3/2.
TEST(StickStiffness, IsPositiveAndAsPrintedItWouldNotBe) {
  const double penalty = 1000.0;
  for (const bool consistent : {true, false}) {
    const Eigen::MatrixXd k = stiffness(point_terms(
        touching(), sticking(penalty), ResidualForm::surface, {.consistent = consistent}));
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
    EXPECT_NEAR(values[0], 0.0, 1e-11);
    EXPECT_NEAR(values[3], 0.0, 1e-11);
    EXPECT_NEAR(values[4], 1.5 * penalty, 1e-10);
    EXPECT_NEAR(values[5], 1.5 * penalty, 1e-10);
    Traction<2> frictionless = sticking(penalty);
    frictionless.stiffness = 0.0;
    frictionless.d_predictor = {};
    const Eigen::MatrixXd normal = stiffness(
        point_terms(touching(), frictionless, ResidualForm::surface, {.consistent = consistent}));
    const Eigen::MatrixXd printed = normal - (k - normal);  // K_N - |K_T|
    EXPECT_NEAR(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(printed).eigenvalues()[0],
                -1.5 * penalty, 1e-10);
  }
}

// [eq:KS2D:31] Table 1 errata: the tangential force acts on the slave (with A'^T as printed its
// weight would be that of the derivative, which is zero there), against the motion that caused it.
TEST(TangentialForce, ActsOnTheSlaveAlongTheSlip) {
  Traction<2> t = sticking(80.0);
  t.tangential = stick_response<2>(Vec<1>(3.0));  // the slave has moved by +3 / 80 along tau
  const PointTerms<2> terms = point_forces(touching(), t, ResidualForm::surface);
  EXPECT_EQ(terms.f[0], Vec2(3, 0));  // added to the internal forces: pulls back
  EXPECT_EQ(terms.f[1], Vec2(0, 0));
}

}  // namespace
}  // namespace osculate::contact
