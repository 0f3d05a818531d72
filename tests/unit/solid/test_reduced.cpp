// One point with hourglass control, and two along each axis.
#include <Eigen/Eigenvalues>

#include "cell_cases.hpp"
#include "osculate/solid/reduced.hpp"

namespace osculate::solid::testing {
namespace {

Section<3> space(double poisson = 0.3) {
  return {Kinematics::small, Formulation::reduced, material::LinearElastic{5, poisson, 0}};
}

// One brick bends as a beam about each axis, however long it is, and nearly incompressible too.
TEST(Reduced, OneBrickBendsExactly) {
  for (const double nu : {0.3, 0.4999})
    for (const double aspect : {1.0, 10.0, 100.0})
      for (Eigen::Index along = 0; along < 3; ++along) {
        const Eigen::Index across = (along + 1) % 3;
        Coordinates<3> x = sample_volume(cell::CellType::hex8, 0, false), u = 0 * x;
        x.rowwise() -= x.colwise().mean().eval();
        x.col(along) *= aspect;
        u.col(along) = 1e-3 * x.col(along).cwiseProduct(x.col(across));
        ElementResult<3> r;
        evaluate(space(nu), cell::CellType::hex8, x, u, false, r);
        double moment = 0;  // of the end
        for (Eigen::Index k = 0; k < 8; ++k)
          if (x(k, along) > 0) moment += r.force[3 * k + along] * x(k, across);
        EXPECT_NEAR(moment, 5 * 1e-3 / 12, 1e-14 * aspect * aspect) << nu << along;
      }
}

// A bar of one brick whose ends turn about it and warp freely: the moment of a bar that does not
// bulge, mu theta J with J = 1/6 of the square of Saint-Venant's 0.1406 at most.
TEST(Reduced, OneBrickResistsTorsion) {
  Coordinates<3> x = sample_volume(cell::CellType::hex8, 0, false), u = 0 * x;
  x.rowwise() -= x.colwise().mean().eval();
  u.col(0) = -1e-3 * x.col(2).cwiseProduct(x.col(1));
  u.col(1) = 1e-3 * x.col(2).cwiseProduct(x.col(0));
  ElementResult<3> r;
  evaluate(space(), cell::CellType::hex8, x, u, false, r);
  double moment = 0;
  for (Eigen::Index k = 4; k < 8; ++k)
    moment += x(k, 0) * r.force[3 * k + 1] - x(k, 1) * r.force[3 * k];
  EXPECT_NEAR(moment, 5 / 2.6 * 1e-3 / 6, 1e-15);
}

/// Displacements that are quadratic along the axes, as of bending.
template <class Places>
Places bent(const Places& x) {
  Places u = 0 * x;
  u.col(0) = 1e-3 * x.col(0).cwiseProduct(x.col(1));
  u.col(1) = -5e-4 * x.col(0).cwiseAbs2();
  return u;
}

// Cells of second order answer a quadratic displacement as fully integrated ones do.
TEST(Reduced, SecondOrderCellsBendAsFullyIntegratedOnes) {
  for (const double distortion : {0.0, 0.1}) {
    const Coordinates<3> x = sample_volume(cell::CellType::hex20, distortion, false);
    Section<3> s = space(0);
    ElementResult<3> reduced, full;
    evaluate(s, cell::CellType::hex20, x, Coordinates<3>(x * 0.01), false, reduced);
    s.formulation = Formulation::full;
    evaluate(s, cell::CellType::hex20, x, Coordinates<3>(x * 0.01), false, full);
    EXPECT_LT((reduced.force - full.force).norm(), 1e-14);
  }
  const Coordinates<3> x = sample_volume(cell::CellType::hex20, 0, false);
  Section<3> s = space(0);
  const auto energy_in = [&](Formulation f) {
    s.formulation = f;
    ElementResult<3> r;
    const Coordinates<3> u = bent(x);
    evaluate(s, cell::CellType::hex20, x, u, false, r);
    return r.force.dot(flat(u));
  };
  EXPECT_NEAR(energy_in(Formulation::reduced), energy_in(Formulation::full), 1e-18);
}

// Stresses that are linear are found again at the nodes.
TEST(Reduced, LinearStressIsExtrapolatedExactly) {
  const Coordinates<2> x = sample_cell(cell::CellType::quad8, 0, false);
  const Section<2> s{Assumption::plane_stress, Kinematics::small, Formulation::reduced, 1,
                     material::LinearElastic{7, 0, 0}};
  const NodalStress<2> at = nodal_stress(s, cell::CellType::quad8, x, bent(x));
  for (std::size_t k = 0; k < 8; ++k)
    EXPECT_NEAR(at.stress[k][0], 7e-3 * x(static_cast<Eigen::Index>(k), 1), 1e-15);
}

TEST(Reduced, HasFewerPoints) {
  using enum cell::CellType;
  const Section<2> plane{Assumption::plane_strain, Kinematics::small, Formulation::reduced, 1,
                         material::LinearElastic{7, 0.3, 0}};
  EXPECT_EQ(point_count(plane, quad4), 1u);
  EXPECT_EQ(point_count(plane, quad8), 4u);
  EXPECT_EQ(point_count(space(), hex8), 1u);
  EXPECT_EQ(point_count(space(), hex20), 8u);
  EXPECT_EQ(point_count(space(), wedge6), 2u);
  for (const cell::CellType type : {tri3, tri6, quad9}) EXPECT_NE(unsupported(plane, type), "");
  for (const cell::CellType type : {tet4, tet10, wedge15, hex27, shell18})
    EXPECT_NE(unsupported(space(), type), "");
}

double energy_of(const Section<3>& s, const Coordinates<3>& x, const Coordinates<3>& u) {
  ElementResult<3> r;
  evaluate(s, cell::CellType::hex20, x, u, false, r);
  return r.force.dot(flat(u));
}

/// Spectrum of the stiffness of one cell.
Eigen::VectorXd spectrum_of(const Section<3>& s, cell::CellType type, const Coordinates<3>& x) {
  ElementResult<3> r;
  evaluate(s, type, x, Coordinates<3>(0 * x), true, r);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(r.tangent)).eigenvalues();
}

// The modes that eight points do not see have a stiffness of about 1e-6, no quadratic displacement
// has any of it, and a flat cell has less of it than of bending.
TEST(Reduced, SecondOrderCellsHaveAFaintStiffness) {
  const Coordinates<3> x = sample_volume(cell::CellType::hex20, 0.08, true);
  const Eigen::VectorXd values = spectrum_of(space(), cell::CellType::hex20, x);
  EXPECT_LT(values.head(6).cwiseAbs().maxCoeff(), 1e-14 * values[59]);
  EXPECT_GT(values[6], 1e-8 * values[59]);
  EXPECT_LT(values[11], 1e-5 * values[59]);
  EXPECT_GT(values[12], 1e-4 * values[59]);
  const NodeMatrix3 faint = faint_stiffness(space(), cell::CellType::hex20, x);
  EXPECT_LT((faint * bent(x)).norm(), 1e-16 * faint.norm());
  Coordinates<3> flat_one = x;
  flat_one.col(2) *= 0.01;
  EXPECT_NEAR(faint_stiffness(space(), cell::CellType::hex20, flat_one).norm() / faint.norm(), 1e-6,
              3e-7);
}

// Along a beam: what bends in its section is integrated as fully, and no mode is without energy.
TEST(Reduced, BeamHasAllModesAndBends) {
  const Coordinates<3> x = sample_volume(cell::CellType::hex20, 0, false);
  Section<3> s = space(0);
  s.formulation = Formulation::beam;
  EXPECT_EQ(point_count(s, cell::CellType::hex20), 50u);
  EXPECT_NE(unsupported(s, cell::CellType::hex8), "");
  const Eigen::VectorXd values = spectrum_of(s, cell::CellType::hex20, x);
  EXPECT_LT(values.head(6).cwiseAbs().maxCoeff(), 1e-14 * values[59]);
  EXPECT_GT(values[6], 1e-3 * values[59]);
  const double here = energy_of(s, x, bent(x));
  s.formulation = Formulation::full;
  EXPECT_NEAR(here, energy_of(s, x, bent(x)), 1e-17);
}

// Two points leave a wedge one mode, whose ends turn against each other.
TEST(Reduced, WedgesHaveAFaintStiffness) {
  const Coordinates<3> x = sample_volume(cell::CellType::wedge6, 0.08, true);
  const Eigen::VectorXd values = spectrum_of(space(), cell::CellType::wedge6, x);
  EXPECT_LT(values.head(6).cwiseAbs().maxCoeff(), 1e-14 * values[17]);
  EXPECT_GT(values[6], 1e-9 * values[17]);
  EXPECT_LT(values[6], 1e-5 * values[17]);
  EXPECT_GT(values[7], 1e-3 * values[17]);
}

}  // namespace
}  // namespace osculate::solid::testing
