#include "cell_cases.hpp"

// Patch tests: under a linear displacement the stress is constant, and the nodal forces are those
// of the constant traction on the sides, none inside. A patch of cells then is in equilibrium
// whatever its mesh.

namespace osculate::solid::testing {
namespace {

class Patch : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Of, Patch, ::testing::Values(Kind::plane, Kind::space), kind_name);

/// f_k = int N_k P n dA over the undeformed boundary. The quadrature of the sides is exact for the
/// normal times the area element, so that faces may be warped.
Eigen::VectorXd boundary_forces(const CellCase& c, const Eigen::MatrixXd& x,
                                const Eigen::MatrixXd& stress) {
  const int dim = c.dim();
  Eigen::VectorXd force = Eigen::VectorXd::Zero(dim * x.rows());
  for (const Side& side : sides(c.as_small())) {
    const Eigen::MatrixXd at = side.of(x);
    const Eigen::VectorXd areas = pressure_on(side.as, at, 0 * at, -1).force;
    for (std::size_t k = 0; k < side.nodes.size(); ++k)
      force.segment(dim * side.nodes[k], dim) +=
          stress * areas.segment(dim * static_cast<Eigen::Index>(k), dim);
  }
  return force;
}

Eigen::VectorXd law_stress(const SectionCase& c, const Eigen::MatrixXd& e) {
  const material::Strain strain(e(0, 0), e(1, 1), 0, 2 * e(0, 1));
  return c.section.assumption == Assumption::plane_stress
             ? material::plane_stress_response(c.section.law, strain).stress
             : material::response(c.section.law, strain).stress;
}
Eigen::VectorXd law_stress(const VolumeCase& c, const Eigen::MatrixXd& e) {
  material::Strain3 strain;
  strain << e(0, 0), e(1, 1), e(2, 2), 2 * e(0, 1), 2 * e(1, 2), 2 * e(0, 2);
  return material::response(c.section.law, strain).stress;
}

/// First Piola-Kirchhoff stress of the displacement u = H X, from the law alone.
Eigen::MatrixXd exact_stress(const CellCase& c, const Eigen::MatrixXd& h) {
  Eigen::MatrixXd e = 0.5 * (h + h.transpose());
  if (c.finite()) e += 0.5 * h.transpose() * h;
  const Eigen::MatrixXd s =
      tensor(c, std::visit([&](const auto& of) { return law_stress(of, e); }, c.of));
  return c.finite() ? Eigen::MatrixXd(s + h * s) : s;
}

Eigen::MatrixXd gradient(int dim) {
  Mat<3, 3> h;
  h << 0.3, -0.2, 0.1, 0.5, 0.1, -0.3, 0.2, -0.1, 0.25;
  return h.topLeftCorner(dim, dim);
}

TEST_P(Patch, LinearDisplacementGivesTheForcesOfAConstantStress) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (c.axisymmetric() || c.type() == cell::CellType::shell18) return;
    const Eigen::MatrixXd x = straight(c);
    for (const double size : {1e-9, 1e-6, 1e-3, 0.1, 0.6}) {
      const Eigen::MatrixXd h = size * gradient(c.dim());
      const Eigen::VectorXd exact = boundary_forces(c, x, exact_stress(c, h));
      const Eigen::VectorXd found = evaluated(c, x, x * h.transpose()).force;
      EXPECT_LT((found - exact).norm(), 2e-14 * size * stiffness_scale(c, x)) << size;
      if (c.type() == cell::CellType::quad9 || c.type() == cell::CellType::hex27) {
        EXPECT_LT(found.tail(c.dim()).norm(), 1e-14 * size * stiffness_scale(c, x)) << size;
      }
    }
  });
}

// The classical patches: nodes inside are free of forces in any linear displacement.
TEST_P(Patch, OfMacNealAndHarderIsInEquilibrium) {
  const CellPatch patch = macneal_harder(GetParam());
  const Eigen::Index dim = patch.nodes.cols(), border = patch.nodes.rows() / 2;
  const Eigen::MatrixXd h =
      0.5e-3 * (Eigen::MatrixXd::Ones(dim, dim) + Eigen::MatrixXd::Identity(dim, dim));
  for_each_cell(GetParam(), [&](const CellCase& c) {
    if (c.axisymmetric() || c.type() != patch.type) return;
    Eigen::VectorXd force = Eigen::VectorXd::Zero(patch.nodes.size());
    double volume = 0;
    for (const auto& nodes : patch.cells) {
      const Eigen::MatrixXd at = patch.nodes(nodes, Eigen::all);
      for (const PointValues& p : point_values(c, at, 0 * at).at) EXPECT_GT(p.volume, 0);
      volume += weights(c, at).sum();
      const Eigen::VectorXd f = evaluated(c, at, at * h.transpose()).force;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        force.segment(dim * nodes[k], dim) += f.segment(dim * static_cast<Eigen::Index>(k), dim);
    }
    const double exact = dim == 2 ? 1.7 * 0.24 * 0.12 : 1;
    EXPECT_NEAR(volume, exact, 4e-15 * exact);
    EXPECT_LT(force.tail(dim * border).norm(), 1e-14 * force.head(dim * border).norm());
  });
}

// Hydrostatic expansion u = c (x, y) is the linear displacement of a ring: the forces are those of
// a pressure on its edges, hoop terms included.
TEST(PlanePatch, RingUnderUniformExpansionGivesTheForcesOfAPressure) {
  for_each_cell(Kind::plane, [](const CellCase& c) {
    if (!c.axisymmetric()) return;
    const Eigen::MatrixXd x = straight(c);
    const material::Law& law = std::get<SectionCase>(c.of).section.law;
    for (const double size : {1e-9, 1e-3, 0.3}) {
      const Eigen::MatrixXd u = size * x;
      const double e = c.finite() ? size + 0.5 * size * size : size;
      const double stress = material::response(law, material::Strain(e, e, e, 0)).stress[0];
      const double pressure = c.finite() ? -stress / (1 + size) : -stress;  // sigma = F S F^T / J
      Eigen::VectorXd exact = Eigen::VectorXd::Zero(2 * x.rows());
      for (const Side& side : sides(c)) {
        const Eigen::VectorXd f = pressure_on(side.as, side.of(x), side.of(u), pressure).force;
        for (std::size_t k = 0; k < side.nodes.size(); ++k)
          exact.segment<2>(2 * side.nodes[k]) += f.segment<2>(2 * static_cast<Eigen::Index>(k));
      }
      EXPECT_LT((evaluated(c, x, u).force - exact).norm(), 1e-14 * size * stiffness_scale(c, x))
          << size;
    }
  });
}

// The sides of shell18 are listed through their corners only: its forces are compared in total.
TEST(SpacePatch, ShellHasTheResultantsOfAConstantStress) {
  for_each_cell(Kind::space, [](const CellCase& c) {
    if (c.type() != cell::CellType::shell18) return;
    const Eigen::MatrixXd x = straight(c), h = 0.1 * gradient(3), stress = exact_stress(c, h);
    const Eigen::MatrixXd f = unflat(evaluated(c, x, x * h.transpose()).force, 3);
    const Eigen::MatrixXd virial = f.transpose() * x;  // int P dV
    const double volume = weights(c, x).sum();
    EXPECT_LT((virial - volume * stress).norm(), 1e-13 * volume * stress.norm());
  });
}

}  // namespace
}  // namespace osculate::solid::testing
