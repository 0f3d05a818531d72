#include <numbers>

#include "block_model.hpp"
#include "section_cases.hpp"

namespace osculate::solid::testing {
namespace {

Section<2> plane(Assumption assumption, Formulation formulation, double young, double poisson) {
  return {assumption, Kinematics::small, formulation, 1,
          material::LinearElastic{young, poisson, 0}};
}

/// Bending moment of one a x b cell whose corners have the displacements u = k x y of bending with
/// curvature k.
double moment_of_one_cell(const Section<2>& s, double a, double b, double curvature) {
  Coordinates<2> x(4, 2), u(4, 2);
  x << -a / 2, -b / 2, a / 2, -b / 2, a / 2, b / 2, -a / 2, b / 2;
  u.setZero();
  u.col(0) = curvature * x.col(0).cwiseProduct(x.col(1));
  ElementResult<2> r;
  evaluate(s, cell::CellType::quad4, x, u, false, r);
  EXPECT_EQ(r.status, Status::ok);
  return (r.force[2] * x(1, 1) + r.force[4] * x(2, 1));
}

// A rectangle with the incompatible modes, or with one point and hourglass control, bends exactly,
// however long it is; without them it is stiffer by a factor that is known in closed form (shear
// that bending does not have).
TEST(Locking, OneEnhancedOrReducedCellBendsExactly) {
  const double young = 5, nu = 0.3, height = 0.7, curvature = 1e-3;
  for (const double aspect : {0.5, 1.0, 10.0, 100.0}) {
    const double length = aspect * height, inertia = height * height * height / 12;
    const double exact = young * inertia * curvature;
    const auto moment = [&](Assumption a, Formulation f) {
      return moment_of_one_cell(plane(a, f, young, nu), length, height, curvature);
    };
    for (const Formulation f : {Formulation::enhanced, Formulation::reduced}) {
      EXPECT_NEAR(moment(Assumption::plane_stress, f), exact, 1e-14 * aspect * aspect * exact);
      EXPECT_NEAR(moment(Assumption::plane_strain, f), exact / (1 - nu * nu),
                  1e-14 * aspect * aspect * exact);
    }
    const double locked = 1 / (1 - nu * nu) + aspect * aspect / (2 * (1 + nu));
    EXPECT_NEAR(moment(Assumption::plane_stress, Formulation::full), locked * exact,
                1e-14 * locked * exact);
  }
}

// Of a cell a million times as long as high all but a trillionth of the strain is taken away.
TEST(Locking, ModesOfVeryLongCellsAreFound) {
  for (const Assumption a :
       {Assumption::plane_strain, Assumption::plane_stress, Assumption::axisymmetric})
    for (const double aspect : {1e3, 1e6}) {
      Coordinates<2> x(4, 2), u(4, 2);
      x << 1, 0, 1 + aspect, 0, 1 + aspect, 1, 1, 1;
      u = Coordinates<2>::NullaryExpr(
          4, 2, [](Eigen::Index k, Eigen::Index i) { return 1e-3 * noise(k, i); });
      ElementResult<2> r;
      evaluate(plane(a, Formulation::enhanced, 5, 0.25), cell::CellType::quad4, x, u, true, r);
      EXPECT_EQ(r.status, Status::ok) << aspect;
    }
}

/// Deflection of a cantilever of one row of cells over that of Timoshenko's beam.
double cantilever(Section<2> s, int cells, double slant) {
  const double length = 10, height = 1, young = 1000, nu = 0.3, load = 1e-3;
  const BlockModel m(s, cells, 1, [&](double x, double y) {
    return Vec2(length * x + (x > 0 && x < 1 ? slant * (y - 0.5) : 0.0), height * (y - 0.5));
  });
  Eigen::VectorXd f = Eigen::VectorXd::Zero(m.dofs());
  f[2 * m.node(cells, 0) + 1] = f[2 * m.node(cells, 1) + 1] = load / 2;
  const Eigen::VectorXd u =
      m.solve(f, {{2 * m.node(0, 0), 0.0}, {2 * m.node(0, 0) + 1, 0.0}, {2 * m.node(0, 1), 0.0}});
  const double inertia = height * height * height / 12;
  const double exact = load * length * length * length / (3 * young * inertia) +
                       load * length * 6 / 5 * 2 * (1 + nu) / (young * height);
  return u[2 * m.node(cells, 1) + 1] / exact;
}

TEST(Locking, CantileverOfOneRowOfCells) {
  const Section<2> full = plane(Assumption::plane_stress, Formulation::full, 1000, 0.3);
  const Section<2> enhanced = plane(Assumption::plane_stress, Formulation::enhanced, 1000, 0.3);
  EXPECT_LT(cantilever(full, 10, 0), 0.7);
  EXPECT_NEAR(cantilever(enhanced, 10, 0), 1, 4e-3);
  EXPECT_NEAR(cantilever(enhanced, 40, 0), 1, 1e-3);
  const Section<2> reduced = plane(Assumption::plane_stress, Formulation::reduced, 1000, 0.3);
  EXPECT_NEAR(cantilever(reduced, 10, 0), 1, 4e-3);
  EXPECT_NEAR(cantilever(reduced, 40, 0), 1, 1e-3);
  Section<2> finite = enhanced;  // at a small load the same
  finite.kinematics = Kinematics::finite;
  for (const material::Law& law : {material::Law{material::StVenantKirchhoff{1000, 0.3, 0}},
                                   material::Law{material::NeoHooke{1000, 0.3, 0}}}) {
    finite.law = law;
    EXPECT_NEAR(cantilever(finite, 10, 0), cantilever(enhanced, 10, 0), 1e-4);
  }
}

/// End moment of a clamped strip whose end section is put where bending into a circular arc would
/// bring it, over that of the beam.
double moment_of_arc(Formulation formulation, int cells, double angle) {
  const double length = 10, height = 0.1, young = 1000, radius = length / angle;
  Section<2> s = plane(Assumption::plane_stress, formulation, young, 0);
  s.kinematics = Kinematics::finite;
  s.law = material::StVenantKirchhoff{young, 0, 0};
  const BlockModel m(s, cells, 1,
                     [&](double x, double y) { return Vec2(length * x, height * (y - 0.5)); });
  Eigen::VectorXd arc(m.dofs());
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j < 2; ++j) {
      const double at = angle * i / cells, inwards = height * (j - 0.5);
      const Vec2 place((radius - inwards) * std::sin(at),
                       radius - (radius - inwards) * std::cos(at));
      arc.segment<2>(2 * m.node(i, j)) = place - m.nodes[static_cast<std::size_t>(m.node(i, j))];
    }
  std::map<Eigen::Index, double> fixed;
  for (const int i : {0, cells})
    for (int j = 0; j < 2; ++j)
      for (int d = 0; d < 2; ++d) {
        const Eigen::Index at = 2 * m.node(i, j) + d;
        fixed[at] = arc[at];
      }
  const Eigen::VectorXd u = m.solve(Eigen::VectorXd::Zero(m.dofs()), fixed, 1, arc);
  Eigen::VectorXd force;
  Eigen::MatrixXd tangent;
  m.assemble(u, force, tangent);
  const double moment = height / 2 * (force[2 * m.node(0, 0)] - force[2 * m.node(0, 1)]);
  return -moment / (young * height * height * height / 12 / radius);
}

// Large rotations, cells twenty times as long as they are high.
TEST(Locking, EnhancedStripBendsIntoACircularArc) {
  const double angle = std::numbers::pi / 2;
  EXPECT_NEAR(moment_of_arc(Formulation::enhanced, 20, angle), 1, 1e-3);
  EXPECT_NEAR(moment_of_arc(Formulation::enhanced, 40, angle), 1, 1e-3);
  EXPECT_NEAR(moment_of_arc(Formulation::reduced, 40, angle), 1, 1e-3);
  EXPECT_GT(moment_of_arc(Formulation::full, 20, angle), 10);
}

/// Radial displacement of the bore of a thick cylinder under inner pressure over Lame's solution.
double cylinder(const Section<2>& s, int cells) {
  const double inner = 1, outer = 2, pressure = 1e-6;
  const bool ring = s.assumption == Assumption::axisymmetric;
  const double height = 1;
  const BlockModel m(s, cells, ring ? 1 : 2 * cells, [&](double x, double y) {
    const double r = inner + (outer - inner) * x, angle = y * std::numbers::pi / 2;
    return ring ? Vec2(r, height * y) : Vec2(r * std::cos(angle), r * std::sin(angle));
  });
  Eigen::VectorXd f = Eigen::VectorXd::Zero(m.dofs());
  for (int j = 0; j < m.ny; ++j) {
    Coordinates<2> edge(2,
                        2);  // downwards: the body, at larger radius, is on the left, so -pressure
    edge.row(0) = m.nodes[static_cast<std::size_t>(m.node(0, j))];
    edge.row(1) = m.nodes[static_cast<std::size_t>(m.node(0, j + 1))];
    const ElementVector<2, max_side_nodes> load =
        side_pressure(s, cell::CellType::line2, edge, Coordinates<2>::Zero(2, 2), pressure)
            .force;  // body on the right
    f.segment<2>(2 * m.node(0, j)) += load.segment<2>(0);
    f.segment<2>(2 * m.node(0, j + 1)) += load.segment<2>(2);
  }
  std::map<Eigen::Index, double> fixed;
  for (int i = 0; i <= cells; ++i) {
    fixed[2 * m.node(i, 0) + 1] = 0;
    fixed[2 * m.node(i, m.ny) + (ring ? 1 : 0)] = 0;
  }
  const Eigen::VectorXd u = m.solve(f, fixed);
  const auto [young, nu] = material::unloaded(s.law);
  // plane strain, Lame
  const double exact = pressure * inner * (1 + nu) / young *
                       ((1 - 2 * nu) * inner * inner + outer * outer) /
                       (outer * outer - inner * inner);
  return u[2 * m.node(0, 0)] / exact;
}

TEST(Locking, ThickCylinderIsNoStifferWhenIncompressible) {
  for (const Assumption a : {Assumption::plane_strain, Assumption::axisymmetric}) {
    for (const double nu : {0.3, 0.4999, 0.499999}) {
      for (const Formulation f : {Formulation::bbar, Formulation::reduced}) {
        const double coarse = 1 - cylinder(plane(a, f, 1, nu), 8);
        const double fine = 1 - cylinder(plane(a, f, 1, nu), 16);
        EXPECT_LT(std::abs(fine), 6e-3) << nu;
        EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1) << nu << " " << coarse << " " << fine;
      }
    }
    EXPECT_LT(cylinder(plane(a, Formulation::full, 1, 0.499999), 8), 0.1);
  }
  for (const Assumption a : {Assumption::plane_strain, Assumption::axisymmetric}) {
    const Section<2> enhanced = plane(a, Formulation::enhanced, 1, 0.499999);
    const double coarse = 1 - cylinder(enhanced, 8), fine = 1 - cylinder(enhanced, 16);
    EXPECT_LT(std::abs(fine), 6e-3);
    EXPECT_NEAR(std::log2(std::abs(coarse / fine)), 2, 0.2) << coarse << " " << fine;
  }
}

TEST(Locking, FiniteKinematicsDoNotLockEither) {
  for (const Assumption a : {Assumption::plane_strain, Assumption::axisymmetric}) {
    const Section<2> small = plane(a, Formulation::bbar, 1, 0.4999);
    Section<2> finite = small;
    finite.kinematics = Kinematics::finite;
    finite.law = material::NeoHooke{1, 0.4999, 0};
    EXPECT_NEAR(cylinder(finite, 4), cylinder(small, 4), 1e-4);
    finite.formulation = Formulation::full;
    EXPECT_LT(cylinder(finite, 4), 0.2);
  }
}

// Rubber squeezed by 30 % between rough plates: it gives way to the sides.
TEST(Locking, RubberBlockKeepsItsVolumeAtLargeStrain) {
  Section<2> s{Assumption::plane_strain, Kinematics::finite, Formulation::bbar, 1,
               material::NeoHooke{1, 0.499, 0}};
  const int n = 6;
  const BlockModel m(s, n, n, [](double x, double y) { return Vec2(x, y); });
  std::map<Eigen::Index, double> fixed;
  for (int i = 0; i <= n; ++i)
    for (const int j : {0, n}) {
      fixed[2 * m.node(i, j)] = 0;
      fixed[2 * m.node(i, j) + 1] = j == 0 ? 0.0 : -0.3;
    }
  const auto solution = [&](Formulation f) {
    BlockModel model = m;
    model.section.formulation = f;
    const Eigen::VectorXd u = model.solve(Eigen::VectorXd::Zero(m.dofs()), fixed, 30);
    Eigen::VectorXd force;
    Eigen::MatrixXd tangent;
    model.assemble(u, force, tangent);
    double reaction = 0, area = 0;
    for (int i = 0; i <= n; ++i) reaction += force[2 * m.node(i, n) + 1];
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const auto c = m.cell(i, j);
        const Coordinates<2> x = m.reference(c) + BlockModel::gather(u, c);
        const Vec2 d1 = (x.row(2) - x.row(0)).transpose(), d2 = (x.row(3) - x.row(1)).transpose();
        area += 0.5 * (d1.x() * d2.y() - d1.y() * d2.x());
      }
    return std::pair{reaction, area};
  };
  const auto [bbar, area] = solution(Formulation::bbar);
  EXPECT_NEAR(area, 1, 4e-3);  // the pressure over the bulk modulus is 3e-3
  EXPECT_LT(bbar, 0);
  EXPECT_GT(solution(Formulation::full).first / bbar, 3);
}

}  // namespace
}  // namespace osculate::solid::testing
