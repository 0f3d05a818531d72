// Volumes and areas of cells and their sides, pressure on sides, the Jacobian.
#include <numbers>

#include "cell_cases.hpp"
#include "derivative_check.hpp"

namespace osculate::solid::testing {
namespace {

using enum cell::CellType;

class Loads : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Of, Loads, ::testing::Values(Kind::plane, Kind::space), kind_name);

/// Visits every type of side with every assumption and kinematics.
void for_each_side(Kind kind, const std::function<void(const CellCase&)>& visit) {
  using enum Assumption;
  const material::NeoHooke law{7, 0.3, 0};
  const auto with_name = [&](const CellCase& c, const std::string& name) {
    SCOPED_TRACE(name);
    visit(c);
  };
  for (const Kinematics k : {Kinematics::small, Kinematics::finite}) {
    for (const cell::CellType type : {tri3, tri6, quad4, quad8, quad9}) {
      const VolumeCase c{{k, Formulation::full, law}, type};
      if (kind == Kind::space) with_name({kind, c}, c.name());
    }
    for (const cell::CellType type : {line2, line3, line4})
      for (const Assumption a : {plane_strain, plane_stress, axisymmetric}) {
        const SectionCase c{{a, k, Formulation::full, 1.7, law}, type};
        if (kind == Kind::plane) with_name({kind, c}, c.name());
      }
  }
}

/// An edge in the order of a line cell, or a face; bent if asked for.
Eigen::MatrixXd sample_side(const CellCase& c, bool bent) {
  Eigen::MatrixXd x(cell::info(c.type()).nodes, c.dim());
  const Mat<3, 3> q = turn3(0.8);
  for (int k = 0; k < x.rows(); ++k) {
    if (c.kind == Kind::plane) {
      const double t = k < 2 ? 2.0 * k - 1 : -1 + 2.0 * (k - 1) / static_cast<double>(x.rows() - 1);
      x.row(k) << 3 + 0.8 * t, 0.4 - 0.3 * t + (bent ? 0.2 * (1 - t * t) * (1 + 0.3 * t) : 0.0);
      continue;
    }
    const Vec2 xi = cell::area_node(c.type(), k);
    const double out = bent ? 0.2 * xi.x() * xi.x() - 0.3 * xi.x() * xi.y() + 0.1 * xi.y() : 0;
    x.row(k) = q * Vec3(1.2 * xi.x() + 0.3 * xi.y(), 0.8 * xi.y(), out) + Vec3(1, 2, 3);
  }
  return x;
}

/// In the plane that of the polygon of the corners; in space, after Gauss, the flux of x/3 through
/// the faces.
double exact_volume(const CellCase& c, const Eigen::MatrixXd& x) {
  double volume = 0, moment = 0;
  if (c.kind == Kind::space) {
    for (const Side& side : sides(c.as_small())) {
      const Eigen::MatrixXd at = side.of(x);
      volume += pressure_on(side.as, at, 0 * at, -1).force.dot(flat(at)) / 3;
    }
    return volume;
  }
  const int corners = cell::info(c.type()).corners;
  for (int k = 0; k < corners; ++k) {
    const Vec2 p = x.row(k), q = x.row((k + 1) % corners);
    const double cross = p.x() * q.y() - p.y() * q.x();
    volume += 1.7 * cross / 2;
    moment += cross * (p.x() + q.x()) / 6;
  }
  return c.axisymmetric() ? 2 * std::numbers::pi * moment : volume;
}

TEST_P(Loads, VolumeWeightsSumToTheVolume) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (c.type() == shell18) return;
    // the rules of tet10 and wedge15 are exact for straight edges only
    const bool bent = c.kind == Kind::space && c.type() != tet10 && c.type() != wedge15;
    const Eigen::MatrixXd x = bent ? curved(c) : straight(c);
    const double volume = exact_volume(c, x);
    EXPECT_NEAR(weights(c, x).sum(), volume, 1e-14 * volume);
    if (c.axisymmetric()) return;
    const int corners = cell::info(c.type()).corners;
    const double size = c.kind == Kind::plane ? 1.7 * (corners == 3 ? 0.5 : 1.0)
                        : corners == 4        ? 1.0 / 6
                        : corners == 6        ? 0.5
                                              : 1.0;
    EXPECT_NEAR(weights(c, regular(c)).sum(), size, 4e-15);
  });
}

TEST_P(Loads, SideWeightsSumToTheArea) {
  for_each_side(GetParam(), [](const CellCase& c) {
    const Eigen::MatrixXd x = sample_side(c, false);
    const bool plane = c.kind == Kind::plane;
    const double depth = c.axisymmetric() ? std::numbers::pi * (x(0, 0) + x(1, 0)) : 1.7;
    const double area = plane ? depth * (x.row(1) - x.row(0)).norm()
                              : 1.2 * 0.8 * (cell::info(c.type()).corners == 3 ? 0.5 : 4.0);
    const Eigen::VectorXd w = side_weights(c, x);
    EXPECT_NEAR(w.sum(), area, (plane ? 1e-14 : 2e-15) * area);
    if (c.type() == line2 && !c.axisymmetric()) {
      EXPECT_LT((w - Vec2::Constant(area / 2)).norm(), 1e-14 * area);
    }
    if (c.type() == line3 && !c.axisymmetric()) {
      EXPECT_LT((w - area / 6 * Vec3(1, 1, 4)).norm(), 1e-14 * area);
    }
    if (c.type() == tri6) {  // all of it on the middles of the edges
      EXPECT_LT(w.head<3>().norm(), 1e-15);
      EXPECT_LT((w.tail<3>() - Vec3::Constant(area / 3)).norm(), 1e-15);
    }
    if (c.type() == quad9) {
      EXPECT_NEAR(w[8], 4.0 / 9 * area, 1e-15 * area);
    }
  });
}

TEST(PlaneLoads, PressurePushesIntoTheBodyOnTheRightOfTravel) {
  const Section<2> s{Assumption::plane_strain, Kinematics::small, Formulation::full, 1.7,
                     material::NeoHooke{7, 0.3, 0}};
  Coordinates<2> x(2, 2);
  x << 0, 1, 2, 1;  // to the right: the body is below
  const PressureResult<2> r = side_pressure(s, line2, x, x * 0, 5);
  EXPECT_LT((r.force - Vec<4>(0, -5 * 1.7, 0, -5 * 1.7)).norm(), 1e-14);
  EXPECT_EQ(r.tangent.norm(), 0.0);
}

TEST_P(Loads, PressurePushesIntoTheBody) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    const Eigen::MatrixXd x = regular(c);
    for (const Side& side : sides(c.as_small())) {
      const Eigen::MatrixXd at = side.of(x);
      const CellResult r = pressure_on(side.as, at, 0 * at, 5);
      const Vec3 sum = resultant(r.force, at).first;
      const double exact = 5 * side_weights(side.as, at).sum();
      EXPECT_GT(sum.dot(in_space(x.colwise().mean() - at.colwise().mean())), 0);
      EXPECT_NEAR(sum.norm(), exact, 1e-14 * std::max(1.0, exact / 5));
      EXPECT_EQ(r.tangent.norm(), 0.0);
    }
  });
}

TEST_P(Loads, TangentOfPressureIsTheDerivative) {
  for_each_side(GetParam(), [](const CellCase& c) {
    const Eigen::MatrixXd x = sample_side(c, true), u = motion(c, 0.1, 3);
    const Eigen::VectorXd d = flat(motion(c, 1, 4));
    const CellResult r = pressure_on(c, x, u, 2.5);
    if (!c.finite()) {
      EXPECT_EQ(r.tangent.norm(), 0.0);
      EXPECT_EQ(r.force, pressure_on(c, x, 0 * x, 2.5).force);
      return;
    }
    const auto force = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
      return pressure_on(c, x, unflat(v, c.dim()), 2.5).force;
    };
    const auto report = osculate::testing::check_derivative(force, r.tangent * d, flat(u), d);
    // quadratic in the displacements but for the radius of a ring: central differences are exact
    EXPECT_TRUE(report.exact || (c.kind == Kind::plane && std::abs(report.order - 2) < 0.1))
        << "order " << report.order << " error " << report.error;
  });
}

// A pressure all around a body has no resultant and no moment, however it is deformed.
TEST_P(Loads, PressureAllAroundBalances) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (!c.finite() || c.axisymmetric()) return;
    const Eigen::MatrixXd x = curved(c), u = motion(c, 0.06);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    for (const Side& side : sides(c)) {
      const Eigen::VectorXd f = pressure_on(side.as, side.of(x), side.of(u), 3).force;
      const auto [force, turning] = resultant(f, side.of(x + u));
      sum += force;
      moment += turning;
    }
    EXPECT_LT(sum.norm(), 1e-14);
    EXPECT_LT(moment.norm(), c.kind == Kind::plane ? 9e-14 : 1e-13);
  });
}

TEST_P(Loads, JacobianIsThatOfTheWorstPlace) {
  const bool plane = GetParam() == Kind::plane;
  const double size = plane ? 0.25 : 0.125;
  CellCase c{GetParam(), VolumeCase{{}, hex8}};
  if (plane) c.of = SectionCase{{}, quad4};
  Eigen::MatrixXd x = regular(c);
  EXPECT_NEAR(least_jacobian(c, x), size, 1e-15);
  x.rowwise() -= Eigen::RowVectorXd(x.row(0));
  x.col(0) *= 2;
  const double rounding = plane ? 1e-16 : 1e-15;
  EXPECT_NEAR(least_jacobian(c, x), 2 * size, rounding);
  Eigen::MatrixXd pushed = x, turned = x;
  const Eigen::Index far = plane ? 2 : 6;  // pushed beyond the line or plane of its neighbours
  pushed.row(far) = 0.75 * x.row(0) + 0.25 * x.row(far);
  EXPECT_LT(least_jacobian(c, pushed), 0);
  for (Eigen::Index k = 1; k < x.rows(); k += 4) turned.row(k).swap(turned.row(k + 2));
  EXPECT_NEAR(least_jacobian(c, turned), -2 * size, rounding);
  // the middle of an edge pushed in so far that only there the cell overlaps
  std::visit([&](auto& of) { of.type = plane ? quad8 : hex20; }, c.of);
  Eigen::MatrixXd q = regular(c);
  EXPECT_NEAR(least_jacobian(c, q), size, plane ? 1e-15 : 1e-14);
  q(plane ? 4 : 8, c.dim() - 1) += plane ? 1.02 : 1.2;
  EXPECT_LT(least_jacobian(c, q), 0);
}

}  // namespace
}  // namespace osculate::solid::testing
