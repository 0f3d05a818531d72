#include <Eigen/Eigenvalues>

#include "derivative_check.hpp"
#include "section_cases.hpp"

namespace osculate::solid::testing {
namespace {

using osculate::testing::check_derivative;

void expect_tangent_is_derivative(const SectionCase& c, const Coordinates& x,
                                  const Coordinates& u) {
  const Eigen::VectorXd along = flat(sample_displacement(c.type, 0.3, 5));
  const ElementResult at = evaluated(c, x, u);
  const auto force = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    ElementResult r;
    evaluate(c.section, c.type, x, unflat(v), false, r);
    EXPECT_EQ(r.status, Status::ok);
    return r.force;
  };
  const auto r = check_derivative(force, at.tangent * along, flat(u), along);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1)
      << "order " << r.order << " error " << r.error;
  EXPECT_TRUE(c.finite() || r.exact) << r.error;
}

TEST(Evaluate, TangentIsTheDerivativeOfTheForce) {
  for_each_section([](const SectionCase& c) {
    expect_tangent_is_derivative(c, sample_cell(c.type, 0.12, true),
                                 sample_displacement(c.type, 0.06));
  });
}

TEST(Evaluate, TangentIsTheDerivativeOfTheForceWhenNearlyIncompressible) {
  for_each_section([](SectionCase c) {
    std::visit([](auto& law) { law.poisson = 0.49; }, c.section.law);
    expect_tangent_is_derivative(c, sample_cell(c.type, 0.12, true),
                                 sample_displacement(c.type, 0.02));
  });
}

TEST(Evaluate, TangentIsTheDerivativeOfTheForceAfterALargeRotation) {
  for_each_section([](const SectionCase& c) {
    if (!c.finite() || c.axisymmetric()) return;
    const Coordinates x = sample_cell(c.type, 0.12, true);
    Mat<2, 2> turn;
    turn << std::cos(2.5), -std::sin(2.5), std::sin(2.5), std::cos(2.5);
    const Coordinates u = (x + sample_displacement(c.type, 0.06)) * turn.transpose() - x;
    expect_tangent_is_derivative(c, x, u);
  });
}

// Each formulation has an energy, so that no section needs an unsymmetric solver.
TEST(Evaluate, TangentIsSymmetric) {
  for_each_section([](const SectionCase& c) {
    const Coordinates x = sample_cell(c.type, 0.12, true);
    const ElementMatrix k = evaluated(c, x, sample_displacement(c.type, 0.06)).tangent;
    EXPECT_LT((k - k.transpose()).norm(), 1e-14 * k.norm());
  });
}

TEST(Evaluate, ForceDoesNotDependOnWhetherTheTangentIsAskedFor) {
  for_each_section([](const SectionCase& c) {
    const Coordinates x = sample_cell(c.type, 0.12, true), u = sample_displacement(c.type, 0.06);
    ElementResult r;
    evaluate(c.section, c.type, x, u, false, r);
    EXPECT_EQ(r.force, evaluated(c, x, u).force);
    EXPECT_EQ(r.tangent.norm(), 0.0);
  });
}

// The limit of finite kinematics at no displacement is small kinematics, formulation by
// formulation: two codes, one stiffness.
TEST(Evaluate, FiniteKinematicsStartAsSmallOnes) {
  for_each_section([](const SectionCase& c) {
    if (!c.finite()) return;
    SectionCase small = c;
    small.section.kinematics = Kinematics::small;
    small.section.law = material::LinearElastic{7, 0.3, 0};
    const Coordinates x = sample_cell(c.type, 0.12, true);
    const Coordinates none = Coordinates::Zero(x.rows(), 2);
    const ElementResult a = evaluated(c, x, none), b = evaluated(small, x, none);
    EXPECT_LT((a.tangent - b.tangent).norm(), 1e-14 * b.tangent.norm());
    EXPECT_EQ(a.force.norm(), 0.0);
  });
}

// Stiffness without rigid motions is positive: no mode of zero energy (hourglass) is left.
TEST(Evaluate, HasNoZeroEnergyModesButRigidMotions) {
  for_each_section([](const SectionCase& c) {
    const Coordinates x = sample_cell(c.type, 0.12, true);
    const Eigen::MatrixXd k = evaluated(c, x, Coordinates::Zero(x.rows(), 2)).tangent;
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
    const int rigid = c.axisymmetric() ? 1 : 3;
    const double largest = values[values.size() - 1];
    for (int i = 0; i < values.size(); ++i) {
      EXPECT_TRUE(i < rigid ? std::abs(values[i]) < 1e-14 * largest : values[i] > 1e-4 * largest)
          << i << ": " << values[i] / largest;
    }
  });
}

}  // namespace
}  // namespace osculate::solid::testing
