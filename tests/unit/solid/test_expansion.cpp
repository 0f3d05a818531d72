// Strains by the temperature, in every cell and formulation.
#include "cell_cases.hpp"
#include "derivative_check.hpp"

namespace osculate::solid::testing {
namespace {

class ExpandingCell : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Of, ExpandingCell,
                         ::testing::Values(Kind::plane, Kind::space, Kind::shell), kind_name);

bool plane_strain(const CellCase& c) {
  return c.kind == Kind::plane && !c.plane_stress() && !c.axisymmetric();
}

using Strains = std::array<double, static_cast<std::size_t>(max_points<3>)>;

material::Memory heated(const Strains& strains) {
  material::Memory memory;
  memory.expansion = strains.data();
  return memory;
}
Strains uneven(double size) {
  Strains strains{};
  for (std::size_t q = 0; q < strains.size(); ++q)
    strains[q] = size * (1 + 0.5 * noise(static_cast<Eigen::Index>(q), 0));
  return strains;
}

// A cell that grows in all directions alike by its expansion is free of stress. Solid-shells are so
// where they are flat.
TEST_P(ExpandingCell, IsFreeOfStressWhenFreeToExpand) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (plane_strain(c)) return;
    const Eigen::MatrixXd x = c.kind == Kind::shell ? regular(c) : curved(c);
    for (const double strain : {1e-6, 0.01, -0.1}) {
      Strains strains{};
      strains.fill(strain);
      const Eigen::MatrixXd u = strain * x;
      const CellResult r = answer(c, x, u, true, heated(strains));
      EXPECT_EQ(r.status, Status::ok);
      EXPECT_LT(r.force.norm(), 4e-14 * std::abs(strain) * stiffness_scale(c, x)) << strain;
      for (const PointValues& p : point_values(c, x, u, heated(strains)).at)
        EXPECT_LT(p.stress.norm(), 1e-13 * std::abs(strain) * 7) << strain;
    }
  });
}

// Held in all directions it has the stress of the opposite strain.
TEST_P(ExpandingCell, HasTheOppositeStrainsStressWhenHeld) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (c.finite() || c.plane_stress() || c.kind == Kind::shell) return;
    const Eigen::MatrixXd x = curved(c), none = 0 * x;
    Strains strains{};
    strains.fill(1e-3);
    const double pressure = 7 / (1 - 2 * 0.3) * 1e-3;
    for (const PointValues& p : point_values(c, x, none, heated(strains)).at)
      for (Eigen::Index i = 0; i < p.stress.size(); ++i)
        EXPECT_NEAR(p.stress[i], i < 3 ? -pressure : 0, 1e-16);
  });
}

TEST_P(ExpandingCell, HasTheDerivativeOfItsForceAsTangent) {
  const Strains strains = uneven(0.03);
  for_each_cell(GetParam(), [&](const CellCase& c) {
    const Eigen::MatrixXd x = curved(c), u = motion(c);
    const Eigen::VectorXd along = flat(motion(c, c.kind == Kind::shell ? 0.06 : 0.3, 5));
    const CellResult here = answer(c, x, u, true, heated(strains));
    EXPECT_EQ(here.status, Status::ok);
    const auto force = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
      return answer(c, x, unflat(v, c.dim()), false, heated(strains)).force;
    };
    const auto r = osculate::testing::check_derivative(force, here.tangent * along, flat(u), along);
    EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << r.order << " " << r.error;
    EXPECT_LT((here.tangent - here.tangent.transpose()).norm(), 1e-13 * here.tangent.norm());
  });
}

TEST_P(ExpandingCell, HasAForceThatIsTheDerivativeOfItsEnergy) {
  const Strains strains = uneven(0.03);
  for_each_cell(GetParam(), [&](const CellCase& c) {
    if (c.kind == Kind::shell) return;
    const Eigen::MatrixXd x = curved(c), u = motion(c);
    const Eigen::VectorXd along = flat(motion(c, 0.3, 5));
    const auto potential = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
      const Eigen::MatrixXd at = unflat(v, c.dim());
      return Eigen::VectorXd::Constant(1, energy(c, x, at, heated(strains)));
    };
    const double work = answer(c, x, u, false, heated(strains)).force.dot(along);
    // Energies that are quadratic leave nothing but rounding, which goes with 1/h.
    const auto r = osculate::testing::check_derivative(
        potential, Eigen::VectorXd::Constant(1, work), flat(u), along, 4e-3);
    EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << r.order << " " << r.error;
  });
}

// The points have the temperature that the shape functions say.
TEST(Expansion, IsThatOfTheTemperatureAtThePoints) {
  Section<2> s{Assumption::plane_stress, Kinematics::small, Formulation::full, 1,
               material::LinearElastic{7, 0.3, 0}};
  s.expansion.table = {{0, 2e-5}};
  for (const Formulation f : {Formulation::full, Formulation::reduced}) {
    s.formulation = f;
    const Coordinates<2> x = sample_cell(cell::CellType::quad8, 0.1, true);
    std::vector<double> now, before(8, 20.0);
    for (Eigen::Index k = 0; k < 8; ++k) now.push_back(50 + 3 * x(k, 0) - 7 * x(k, 1));
    const auto strains = expansion_at_points(s, cell::CellType::quad8, x, now, before);
    const CellStress<2> at = stress_at_points(s, cell::CellType::quad8, x, Coordinates<2>(0 * x));
    for (std::size_t q = 0; q < static_cast<std::size_t>(at.count); ++q) {
      const Vec2& place = at.point[q].position;
      EXPECT_NEAR(strains[q], 2e-5 * (30 + 3 * place.x() - 7 * place.y()), 1e-17);
    }
  }
}

// By directions they are those of the axes at the place of the point.
TEST(Expansion, ByDirectionsIsAlongTheAxesAtThePoints) {
  Section<3> s;
  s.law = material::LinearElastic{7, 0.3, 0};
  s.expansion.directions = {{0, material::Strain3(1e-5, 2e-5, 3e-5, 0, 0, 0)}};
  s.orientation.kind = material::Orientation::Kind::cylindrical;
  s.orientation.b = Vec3::UnitZ();
  Coordinates<3> x = sample_volume(cell::CellType::hex8, 0.1, false);
  for (Eigen::Index k = 0; k < 8; ++k) x.row(k) += Vec3(3, 1, 0).transpose();
  const std::vector<double> now(8, 50.0), before(8, 20.0);
  const auto strains = expansion_at_points(s, cell::CellType::hex8, x, now, before);
  const CellStress<3> at = stress_at_points(s, cell::CellType::hex8, x, Coordinates<3>(0 * x));
  for (std::size_t q = 0; q < static_cast<std::size_t>(at.count); ++q) {
    const Vec3& place = at.point[q].position;
    const double c = place.x() / place.head<2>().norm(), n = place.y() / place.head<2>().norm();
    EXPECT_NEAR(strains[6 * q], 30e-5 * (c * c + 2 * n * n), 1e-18);
    EXPECT_NEAR(strains[6 * q + 1], 30e-5 * (n * n + 2 * c * c), 1e-18);
    EXPECT_NEAR(strains[6 * q + 2], 90e-5, 1e-18);
    EXPECT_NEAR(strains[6 * q + 3], 2 * 30e-5 * c * n * (1 - 2), 1e-18);
    EXPECT_NEAR(strains[6 * q + 4], 0, 1e-18);
  }
}

// A cell that is free to expand by directions is free of stress.
TEST_P(ExpandingCell, IsFreeOfStressWhenItExpandsByDirections) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (c.kind != Kind::space) return;
    const Eigen::MatrixXd x = curved(c);
    Mat<3, 3> e;
    e << 0.02, 0.005, 0.003, 0.005, -0.01, 0.004, 0.003, 0.004, 0.03;
    std::vector<double> strains;
    for (int q = 0; q < max_points<3>; ++q)
      for (const double v : {e(0, 0), e(1, 1), e(2, 2), 2 * e(0, 1), 2 * e(1, 2), 2 * e(0, 2)})
        strains.push_back(v);
    material::Memory memory;
    memory.expansion = strains.data();
    memory.strains = 6;
    const Eigen::MatrixXd u = x * e;
    const CellResult r = answer(c, x, u, true, memory);
    EXPECT_EQ(r.status, Status::ok);
    EXPECT_LT(r.force.norm(), 1e-14 * stiffness_scale(c, x));
  });
}

}  // namespace
}  // namespace osculate::solid::testing
