// Cells whose change of volume is a polynomial of few terms (formulation bbar).
#include <Eigen/Eigenvalues>
#include <cmath>

#include "cell_cases.hpp"
#include "osculate/solid/mean_dilatation.hpp"

namespace osculate::solid::testing {
namespace {

class MeanDilatation : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Of, MeanDilatation, ::testing::Values(Kind::plane, Kind::space),
                         kind_name);

void for_each_bbar(Kind kind, const std::function<void(const CellCase&)>& visit) {
  for_each_cell(kind, [&](const CellCase& c) {
    if (c.bbar()) visit(c);
  });
}

// Of an affine displacement the change of volume is constant: nothing is averaged away.
TEST_P(MeanDilatation, OfAnAffineDisplacementIsThatOfPlainCells) {
  for_each_bbar(GetParam(), [](const CellCase& c) {
    const Eigen::MatrixXd x = curved(c);
    Eigen::MatrixXd h(3, 3);
    h << 0.1, -0.07, 0.04, 0.12, 0.06, -0.08, 0.03, -0.05, 0.09;
    if (c.axisymmetric()) h(1, 0) = 0;  // u_r is proportional to the radius
    const Eigen::MatrixXd u = x * h.topLeftCorner(c.dim(), c.dim());
    const double scale = stiffness_scale(c, x);
    EXPECT_LT((evaluated(c, x, u).force - evaluated(c.as_full(), x, u).force).norm(),
              1e-13 * scale);
    EXPECT_NEAR(energy(c, x, u), energy(c.as_full(), x, u), 1e-13 * scale);
  });
}

// A dilatation that is linear, as that of bending, is kept where there are linear terms.
TEST_P(MeanDilatation, OfBendingIsThatOfPlainCellsWhereItIsLinear) {
  for_each_bbar(GetParam(), [](const CellCase& c) {
    if (c.finite()) return;
    const Eigen::MatrixXd x = regular(c);
    Eigen::MatrixXd u = 0 * x;  // bending: u = x y, v = -x^2 / 2, whose dilatation is y
    const Eigen::VectorXd a = x.col(0).array() - 3, b = x.col(1);
    u.col(0) = 0.01 * a.cwiseProduct(b);
    u.col(1) = -0.005 * a.cwiseProduct(a);
    const int terms = c.dim() == 2 ? volume_terms<2>(c.type()) : volume_terms<3>(c.type());
    if (terms == 1 || c.axisymmetric()) return;
    const double scale = 0.01 * stiffness_scale(c, x);
    EXPECT_LT((evaluated(c, x, u).force - evaluated(c.as_full(), x, u).force).norm(),
              1e-13 * scale);
  });
}

// J = (1 + a X)(1 + b Y) is positive at all points of a square, but what of it is linear is not.
TEST(MeanDilatationStatus, SaysInvertedWhereTheMeanIsNotPositive) {
  const Section<2> bbar{Assumption::plane_strain, Kinematics::finite, Formulation::bbar, 1,
                        material::NeoHooke{7, 0.3, 0}};
  Section<2> full = bbar;
  full.formulation = Formulation::full;
  for (const cell::CellType type : {cell::CellType::quad8, cell::CellType::quad9}) {
    Coordinates<2> x(cell::info(type).nodes, 2);
    for (int k = 0; k < x.rows(); ++k) x.row(k) = cell::area_node(type, k);
    const auto stretched = [&](double a) {
      Coordinates<2> u = x;
      for (Eigen::Index k = 0; k < x.size(); ++k)
        u.reshaped()[k] = 0.5 * a * x.reshaped()[k] * x.reshaped()[k];
      return u;
    };
    const double point = std::sqrt(0.6);
    ElementResult<2> r;
    for (const bool tangent : {false, true}) {
      evaluate(bbar, type, x, stretched(0.4 / point), tangent, r);
      EXPECT_EQ(r.status, Status::ok);
      evaluate(bbar, type, x, stretched(0.6 / point), tangent, r);
      EXPECT_EQ(r.status, Status::inverted);
      evaluate(full, type, x, stretched(0.6 / point), tangent, r);
      EXPECT_EQ(r.status, Status::ok);
    }
    EXPECT_EQ(stress_at_points(bbar, type, x, stretched(0.6 / point)).status, Status::inverted);
  }
}

// Near nu = 1/2 the largest stiffnesses are those of the volume ratio's terms, and no others: the
// rest of the modes does not lock.
TEST_P(MeanDilatation, AsManyModesAreStiffAsThereAreTerms) {
  for_each_bbar(GetParam(), [](const CellCase& given) {
    if (given.finite()) return;
    CellCase c = given;
    std::visit(
        [](auto& of) {
          std::visit([](auto& law) { osculate::testing::set_elastic(law, 7, 0.4999999); },
                     of.section.law);
        },
        c.of);
    const Eigen::MatrixXd x = curved(c);
    const auto stiff_modes = [&](const CellCase& of) {
      const Eigen::VectorXd values =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(evaluated(of, x, 0 * x).tangent)
              .eigenvalues();
      return (values.array() > 1e-4 * values[values.size() - 1]).count();
    };
    const int terms = c.dim() == 2 ? volume_terms<2>(c.type()) : volume_terms<3>(c.type());
    EXPECT_EQ(stiff_modes(c), terms);
    EXPECT_GT(stiff_modes(c.as_full()), terms);
  });
}

}  // namespace
}  // namespace osculate::solid::testing
