#include "section_cases.hpp"

// Patch tests of single cells: under a linear displacement the stress is constant, and the nodal
// forces are those of the constant traction on the edges, none inside. A patch of cells then is in
// equilibrium whatever its mesh.

namespace osculate::solid::testing {
namespace {

/// Nodal forces of the tractions of a constant first Piola-Kirchhoff stress P on the edges, times
/// the thickness: f_k = int N_k P n dA over the undeformed boundary (cells are on the left of their
/// edges, so that the outward normal is on the right of travel).
ElementVector boundary_forces(const SectionCase& c, const Coordinates& x, const Mat<2, 2>& stress) {
  const cell::CellInfo& info = cell::info(c.type);
  ElementVector force = ElementVector::Zero(2 * x.rows());
  for (int e = 0; e < info.edge_count; ++e) {
    const Coordinates edge = edge_of(info, e, x);
    const ElementVector weights = edge_weights(c.section, edge);
    const Vec2 normal = -turn(edge.row(1) - edge.row(0)).normalized();
    for (Eigen::Index k = 0; k < edge.rows(); ++k)
      force.segment<2>(2 * info.edges[static_cast<std::size_t>(e)][static_cast<std::size_t>(k)]) +=
          weights[k] * (stress * normal);
  }
  return force;
}

/// First Piola-Kirchhoff stress of the displacement u = H X, from the law alone.
Mat<2, 2> exact_stress(const SectionCase& c, const Mat<2, 2>& h) {
  const Mat<2, 2> f = Mat<2, 2>::Identity() + h;
  material::Strain e(h(0, 0), h(1, 1), 0, h(0, 1) + h(1, 0));
  if (c.finite()) {
    const Mat<2, 2> green = 0.5 * (h + h.transpose() + h.transpose() * h);
    e << green(0, 0), green(1, 1), 0, 2 * green(0, 1);
  }
  const material::Stress s = c.section.assumption == Assumption::plane_stress
                                 ? material::plane_stress_response(c.section.law, e).stress
                                 : material::response(c.section.law, e).stress;
  Mat<2, 2> stress;
  stress << s[0], s[3], s[3], s[1];
  return c.finite() ? Mat<2, 2>(f * stress) : stress;
}

TEST(Patch, LinearDisplacementGivesTheForcesOfAConstantStress) {
  Mat<2, 2> shape;
  shape << 0.3, -0.2, 0.5, 0.1;
  for_each_section([&](const SectionCase& c) {
    if (c.axisymmetric()) return;
    const Coordinates x = sample_cell(c.type, 0.15, false);
    for (const double size : {1e-9, 1e-6, 1e-3, 0.1, 0.6}) {
      const Mat<2, 2> h = size * shape;
      const ElementVector exact = boundary_forces(c, x, exact_stress(c, h));
      const ElementVector found = evaluated(c, x, x * h.transpose()).force;
      EXPECT_LT((found - exact).norm(), 2e-14 * size * stiffness_scale(c, x)) << size;
      if (c.type == cell::CellType::quad9) {
        EXPECT_LT(found.tail<2>().norm(), 1e-14 * size * stiffness_scale(c, x)) << size;
      }
    }
  });
}

TEST(Patch, ClassicalPatchOfFiveQuadrilaterals) {
  // the inner nodes 4..7 are free of forces in any linear displacement
  constexpr std::array<std::array<int, 4>, 5> cells{
      {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}}};
  Coordinates x(8, 2);
  x << 0, 0, 0.24, 0, 0.24, 0.12, 0, 0.12, 0.04, 0.02, 0.18, 0.03, 0.16, 0.08, 0.08, 0.08;
  Mat<2, 2> h;
  h << 1e-3, 0.5e-3, 0.5e-3, 1e-3;
  for_each_section([&](const SectionCase& c) {
    if (c.axisymmetric() || c.type != cell::CellType::quad4) return;
    Eigen::VectorXd force = Eigen::VectorXd::Zero(16);
    for (const auto& nodes : cells) {
      Coordinates at(4, 2);
      for (std::size_t k = 0; k < 4; ++k) at.row(static_cast<Eigen::Index>(k)) = x.row(nodes[k]);
      const ElementVector f = evaluated(c, at, at * h.transpose()).force;
      for (std::size_t k = 0; k < 4; ++k)
        force.segment<2>(2 * nodes[k]) += f.segment<2>(2 * static_cast<Eigen::Index>(k));
    }
    EXPECT_LT(force.tail<8>().norm(), 1e-14 * force.head<8>().norm());
  });
}

// Hydrostatic expansion u = c (x, y) is the linear displacement of a ring: the forces are those of
// a pressure on its edges, hoop terms included.
TEST(Patch, RingUnderUniformExpansionGivesTheForcesOfAPressure) {
  for_each_section([](const SectionCase& c) {
    if (!c.axisymmetric()) return;
    const Coordinates x = sample_cell(c.type, 0.15, false);
    const cell::CellInfo& info = cell::info(c.type);
    for (const double size : {1e-9, 1e-3, 0.3}) {
      const Coordinates u = size * x;
      const double e = c.finite() ? size + 0.5 * size * size : size;
      const double stress = material::response(c.section.law, {e, e, e, 0}).stress[0];
      const double pressure = c.finite() ? -stress / (1 + size) : -stress;  // sigma = F S F^T / J
      ElementVector exact = ElementVector::Zero(2 * x.rows());
      for (int k = 0; k < info.edge_count; ++k) {
        const auto& nodes = info.edges[static_cast<std::size_t>(k)];
        // walked backwards: pressure loads have the body on the right of travel
        Coordinates edge = edge_of(info, k, x), moved = edge_of(info, k, u);
        edge.row(0).swap(edge.row(1));
        moved.row(0).swap(moved.row(1));
        const ElementVector f = edge_pressure(c.section, edge, moved, pressure).force;
        for (Eigen::Index i = 0; i < edge.rows(); ++i) {
          const Eigen::Index from = i < 2 ? 1 - i : i;
          exact.segment<2>(2 * nodes[static_cast<std::size_t>(i)]) += f.segment<2>(2 * from);
        }
      }
      EXPECT_LT((evaluated(c, x, u).force - exact).norm(), 1e-14 * size * stiffness_scale(c, x))
          << size;
    }
  });
}

}  // namespace
}  // namespace osculate::solid::testing
