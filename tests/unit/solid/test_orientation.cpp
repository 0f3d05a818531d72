// Cells of materials whose axes the section gives.
#include <Eigen/Geometry>

#include "cell_cases.hpp"
#include "derivative_check.hpp"
#include "osculate/solid/point_axes.hpp"
#include "osculate/solid/points.hpp"

namespace osculate::solid::testing {
namespace {

class OrientedCell : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Of, OrientedCell, ::testing::Values(Kind::plane, Kind::space, Kind::shell),
                         kind_name);

constexpr material::Orthotropic wood{12, 1.1, 0.6, 0.35, 0.4, 0.5, 0.8, 0.7, 0.2, 0};
using Axes = material::Orientation;

/// All formulations once, of small strains and of finite ones, with the material and its axes.
void for_each_oriented(Kind kind, const Axes& axes, const std::function<void(CellCase)>& visit) {
  for_each_cell(kind, [&](const CellCase& given) {
    CellCase c = given;
    const bool once = std::visit(
        [&](auto& s) {
          const auto key = material::key_of(s.section.law);
          const bool finite = key == material::StVenantKirchhoff::key;
          if (!finite && key != material::LinearElastic::key) return false;
          s.section.law = finite ? material::in_finite_strain(wood) : material::Law{wood};
          s.section.orientation = axes;
          return true;
        },
        c.of);
    if (once) visit(c);
  });
}

/// Axes that differ from point to point; in the plane one of them stays across it.
Axes around(Kind kind) {
  if (kind == Kind::plane) return {Axes::Kind::cylindrical, {-1, -2, 0}, {-1, -2, 1}, 2, 0.4};
  return {Axes::Kind::cylindrical, {-2, -1, 0.5}, {-1, -3, 2}, 0, 0.4};
}

TEST_P(OrientedCell, HasTheDerivativeOfItsForceAsTangent) {
  for_each_oriented(GetParam(), around(GetParam()), [](const CellCase& c) {
    const Eigen::MatrixXd x = curved(c), u = motion(c);
    const Eigen::VectorXd along = flat(motion(c, c.kind == Kind::shell ? 0.06 : 0.3, 5));
    const CellResult here = evaluated(c, x, u);
    const auto force = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
      return answer(c, x, unflat(v, c.dim()), false).force;
    };
    const auto r =
        osculate::testing::check_derivative(force, here.tangent * along, flat(u), along, 4e-3);
    EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << r.order << " " << r.error;
    EXPECT_LT((here.tangent - here.tangent.transpose()).norm(), 1e-13 * here.tangent.norm());
  });
}

TEST_P(OrientedCell, HasAForceThatIsTheDerivativeOfItsEnergy) {
  for_each_oriented(GetParam(), around(GetParam()), [](const CellCase& c) {
    if (c.kind == Kind::shell) return;
    const Eigen::MatrixXd x = curved(c), u = motion(c);
    const Eigen::VectorXd along = flat(motion(c, 0.3, 5));
    const auto potential = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(1, energy(c, x, unflat(v, c.dim())));
    };
    const double work = answer(c, x, u, false).force.dot(along);
    const double step = c.finite() ? 4e-3 : 0.05;  // of small strain it is quadratic
    const auto r = osculate::testing::check_derivative(
        potential, Eigen::VectorXd::Constant(1, work), flat(u), along, step);
    EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << r.order << " " << r.error;
  });
}

// Body, axes and displacements that turn together turn the forces with them.
TEST_P(OrientedCell, TurnsWithItsAxes) {
  const Kind kind = GetParam();
  const Mat<3, 3> turn =
      Eigen::AngleAxisd(0.7, kind == Kind::plane ? Vec3(0, 0, 1) : Vec3(1, -2, 0.5).normalized())
          .toRotationMatrix();
  for_each_oriented(kind, around(kind), [&](const CellCase& c) {
    if (c.axisymmetric()) return;
    const Eigen::MatrixXd r = turn.topLeftCorner(c.dim(), c.dim());
    CellCase turned = c;
    std::visit(
        [&](auto& s) {
          s.section.orientation.a = turn * s.section.orientation.a;
          s.section.orientation.b = turn * s.section.orientation.b;
        },
        turned.of);
    const Eigen::MatrixXd x = curved(c), u = motion(c);
    const Eigen::MatrixXd f = unflat(answer(c, x, u, false).force, c.dim());
    const Eigen::MatrixXd there =
        unflat(answer(turned, x * r.transpose(), u * r.transpose(), false).force, c.dim());
    EXPECT_LT((there - f * r.transpose()).norm(), 1e-13 * stiffness_scale(c, x));
    // and the axes matter
    const Eigen::MatrixXd not_turned =
        unflat(answer(c, x * r.transpose(), u * r.transpose(), false).force, c.dim());
    EXPECT_GT((not_turned - f * r.transpose()).norm(), 1e-3 * f.norm());
  });
}

// Small strain or finite: a body that turns as a whole has no forces, and then those that turn.
TEST_P(OrientedCell, CarriesItsAxesInLargeRotations) {
  const Kind kind = GetParam();
  const Mat<3, 3> turn =
      Eigen::AngleAxisd(2.1, kind == Kind::plane ? Vec3(0, 0, 1) : Vec3(1, 0.4, 0.5).normalized())
          .toRotationMatrix();
  for_each_oriented(kind, around(kind), [&](const CellCase& c) {
    if (!c.finite() || c.axisymmetric()) return;
    const Eigen::MatrixXd r = turn.topLeftCorner(c.dim(), c.dim());
    const Eigen::MatrixXd x = curved(c), u = motion(c);
    const Eigen::MatrixXd f = unflat(answer(c, x, u, false).force, c.dim());
    const Eigen::MatrixXd moved = (x + u) * r.transpose() - x;
    const Eigen::MatrixXd there = unflat(answer(c, x, moved, false).force, c.dim());
    EXPECT_LT((there - f * r.transpose()).norm(), 1e-12 * stiffness_scale(c, x));
  });
}

TEST(Orientation, IsThatOfThePlaceOfEachPoint) {
  Section<3> s{Kinematics::small, Formulation::full, wood};
  s.orientation = around(Kind::space);
  const Coordinates<3> x = sample_volume(cell::CellType::hex20, 0.08, true);
  const PointAxes<3> axes(s, cell::CellType::hex20, x);
  const material::Memory memory = axes.in({});
  const CellStress<3> at = stress_at_points(s, cell::CellType::hex20, x, Coordinates<3>(0 * x));
  for (std::size_t q = 0; q < static_cast<std::size_t>(at.count); ++q) {
    const Eigen::Map<const Mat<3, 3>> here(memory.at(q).axes);
    EXPECT_LT((here - material::axes_at(s.orientation, at.point[q].position)).norm(), 1e-14);
  }
  s.orientation.on_shell = true;
  const PointAxes<3> laid(s, cell::CellType::hex20, x);
  for (std::size_t q = 0; q < static_cast<std::size_t>(at.count); ++q) {
    const Eigen::Map<const Mat<3, 3>> here(laid.in({}).at(q).axes);
    const auto& shape = rule_of<3>(cell::CellType::hex20).shape[q];
    const Mat<3, 3> along = x.transpose() * shape.d.topRows(shape.count);
    EXPECT_NEAR(here.col(2).dot(along.col(0)), 0, 1e-14);
    EXPECT_NEAR(here.col(2).dot(along.col(1)), 0, 1e-14);
    EXPECT_GT(here.col(2).dot(along.col(2)), 0);
    EXPECT_GT(here.col(0).dot(material::axes_at(s.orientation, at.point[q].position).col(0)), 0);
  }
  s.law = material::LinearElastic{7, 0.3, 0};
  EXPECT_EQ(PointAxes<3>(s, cell::CellType::hex20, x).in({}).axes, nullptr);  // needs none
}

}  // namespace
}  // namespace osculate::solid::testing
