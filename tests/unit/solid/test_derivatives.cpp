// Derivatives and stiffness of every cell, in the plane, in space and of shells.
#include <Eigen/Eigenvalues>

#include "cell_cases.hpp"
#include "derivative_check.hpp"
#include "osculate/solid/reduced.hpp"

namespace osculate::solid::testing {
namespace {

class EveryCell : public ::testing::TestWithParam<Kind> {};
class DisplacementCell : public EveryCell {};

INSTANTIATE_TEST_SUITE_P(Of, EveryCell, ::testing::Values(Kind::plane, Kind::space, Kind::shell),
                         kind_name);
INSTANTIATE_TEST_SUITE_P(Of, DisplacementCell, ::testing::Values(Kind::plane, Kind::space),
                         kind_name);

using osculate::testing::DerivativeReport;

void expect_derivative(const CellCase& c, const DerivativeReport& r) {
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1)
      << "order " << r.order << " error " << r.error;
  EXPECT_TRUE(c.finite() || r.exact) << r.error;
}

// Each formulation has an energy, so that no section needs an unsymmetric solver.
void expect_symmetric(const CellCase& c, const Eigen::MatrixXd& tangent) {
  const double skew = (tangent - tangent.transpose()).norm();
  EXPECT_LT(skew, 1e-14 * tangent.norm());
  if (c.kind == Kind::space) {
    EXPECT_EQ(skew, 0.0);
  }
}

void expect_tangent_is_derivative(const CellCase& c, const Eigen::MatrixXd& x,
                                  const Eigen::MatrixXd& u) {
  const bool shell = c.kind == Kind::shell;
  const Eigen::VectorXd along = flat(motion(c, shell ? 0.06 : 0.3, 5));
  const CellResult at = evaluated(c, x, u);
  const auto force = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    const CellResult r = answer(c, x, unflat(v, c.dim()), false);
    EXPECT_EQ(r.status, Status::ok);
    return r.force;
  };
  expect_derivative(c, osculate::testing::check_derivative(force, at.tangent * along, flat(u),
                                                           along, shell ? 4e-3 : 1e-3));
}

TEST_P(EveryCell, TangentIsTheDerivativeOfTheForce) {
  for_each_cell(GetParam(),
                [](const CellCase& c) { expect_tangent_is_derivative(c, curved(c), motion(c)); });
}

TEST_P(DisplacementCell, TangentIsTheDerivativeOfTheForceWhenNearlyIncompressible) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    // At 0.02 the modes of an enhanced ring have no stiffness left in compression (enhanced.hpp).
    expect_tangent_is_derivative(c.nearly_incompressible(), curved(c), motion(c, 0.015));
  });
}

TEST_P(EveryCell, TangentIsTheDerivativeOfTheForceAfterALargeRotation) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (!c.finite() || c.axisymmetric()) return;
    const Eigen::MatrixXd x = curved(c);
    const Eigen::MatrixXd u = (x + motion(c)) * rotation(c, 2.5).transpose() - x;
    expect_tangent_is_derivative(c, x, u);
    if (c.kind == Kind::shell) expect_symmetric(c, evaluated(c, x, u).tangent);
  });
}

TEST_P(EveryCell, TangentIsSymmetricAndTheForceDoesNotDependOnIt) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    const Eigen::MatrixXd x = curved(c), u = motion(c);
    const CellResult with = evaluated(c, x, u), without = answer(c, x, u, false);
    expect_symmetric(c, with.tangent);
    EXPECT_EQ(without.force, with.force);
    EXPECT_EQ(without.tangent.norm(), 0.0);
  });
}

TEST_P(DisplacementCell, ForceIsTheDerivativeOfTheStrainEnergy) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    const Eigen::MatrixXd x = curved(c), u = motion(c);
    const Eigen::VectorXd along = flat(motion(c, 0.3, 5));
    const auto potential = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(1, energy(c, x, unflat(v, c.dim())));
    };
    const double work = evaluated(c, x, u).force.dot(along);
    expect_derivative(c, osculate::testing::check_derivative(
                             potential, Eigen::VectorXd::Constant(1, work), flat(u), along));
  });
}

/// Without what resists the modes that points do not see, of which finite kinematics have more.
Eigen::MatrixXd tangent_of_points(const CellCase& c, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd k = evaluated(c, x, 0 * x).tangent;
  const auto* const of = std::get_if<VolumeCase>(&c.of);
  if (!of || !has_faint_stiffness(of->section, of->type)) return k;
  const Eigen::MatrixXd faint = faint_stiffness(of->section, of->type, Coordinates<3>(x));
  for (Eigen::Index i = 0; i < faint.rows(); ++i)
    for (Eigen::Index j = 0; j < faint.cols(); ++j)
      k.block<3, 3>(3 * i, 3 * j).diagonal().array() -= faint(i, j);
  return k;
}

// The limit of finite kinematics at no displacement is small kinematics, formulation by
// formulation: two codes, one stiffness.
TEST_P(EveryCell, FiniteKinematicsStartAsSmallOnes) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (!c.finite()) return;
    const Eigen::MatrixXd x = curved(c);
    const Eigen::MatrixXd a = tangent_of_points(c, x), b = tangent_of_points(c.as_small(), x);
    EXPECT_LT((a - b).norm(), 1e-14 * b.norm());
    EXPECT_EQ(evaluated(c, x, 0 * x).force.norm(), 0.0);
  });
}

/// Modes that one cell with two points along each axis deforms in without energy; in a ring they
/// have that of the hoop strain. Those of one cell with a single volume ratio: displacements of
/// second order that have the same strain in all directions, (a.x) x - (x.x) a / 2.
int lone_modes(const CellCase& c) {
  if (c.bbar() && c.type() == cell::CellType::tet10) return 3;
  return c.reduced() && !c.axisymmetric() && c.type() == cell::CellType::quad8 ? 1 : 0;
}
/// Those that have little: of cells with a single volume ratio and curved sides the same modes.
int faint_modes(const CellCase& c) {
  if (c.bbar() && c.type() == cell::CellType::wedge15) return 3;
  if (c.bbar() && c.type() == cell::CellType::tri6 && c.axisymmetric()) return 1;
  if (!c.reduced()) return 0;
  return c.type() == cell::CellType::hex20 ? 6 : c.type() == cell::CellType::wedge6 ? 1 : 0;
}

// Stiffness without rigid motions is positive: no mode of zero energy (hourglass) is left.
TEST_P(DisplacementCell, HasNoZeroEnergyModesButRigidMotions) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    const Eigen::MatrixXd x = curved(c), k = evaluated(c, x, 0 * x).tangent;
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
    const bool plane = c.kind == Kind::plane;
    const int rigid = (c.axisymmetric() ? 1 : plane ? 3 : 6) + lone_modes(c);
    const bool hoop_only = c.reduced() && c.axisymmetric() && c.type() == cell::CellType::quad8;
    const bool soft = plane || (c.bbar() && c.type() == cell::CellType::wedge15);
    const double largest = values[values.size() - 1], least = (hoop_only ? 1e-6
                                                               : soft    ? 1e-4
                                                                         : 1e-3) *
                                                              largest;
    for (int i = 0; i < values.size(); ++i) {
      if (i >= rigid && i < rigid + faint_modes(c)) {
        EXPECT_GT(values[i], 1e-9 * largest);
        continue;
      }
      EXPECT_TRUE(i < rigid ? std::abs(values[i]) < 1e-14 * largest : values[i] > least)
          << i << ": " << values[i] / largest;
    }
  });
}

TEST(StrainEnergy, OfAnInvertedCellIsInfinite) {
  const CellCase c{Kind::plane, SectionCase{{Assumption::plane_strain, Kinematics::finite,
                                             Formulation::full, 1, material::NeoHooke{1, 0.3, 0}},
                                            cell::CellType::quad4}};
  const Eigen::MatrixXd x = sample_cell(cell::CellType::quad4, 0, false);
  Eigen::MatrixXd folded = -2 * x;
  folded.col(1).setZero();  // mirrored in one direction
  EXPECT_TRUE(std::isinf(energy(c, x, folded)));
}

}  // namespace
}  // namespace osculate::solid::testing
