#include <numbers>

#include "derivative_check.hpp"
#include "section_cases.hpp"

namespace osculate::solid::testing {
namespace {

constexpr std::array assumptions{Assumption::plane_strain, Assumption::plane_stress,
                                 Assumption::axisymmetric};

Section with(Assumption a, Kinematics k) {
  Section s{a, k, Formulation::full, 1.7, material::NeoHooke{7, 0.3, 0}};
  return s;
}

/// An edge of 2, 3 or 4 nodes in the order of a line cell; curved unless straight.
Coordinates sample_edge(int nodes, bool straight) {
  Coordinates x(nodes, 2);
  for (int k = 0; k < nodes; ++k) {
    const double t = k < 2 ? 2.0 * k - 1 : -1 + 2.0 * (k - 1) / (nodes - 1);
    x.row(k) << 3 + 0.8 * t, 0.4 - 0.3 * t + (straight ? 0.0 : 0.2 * (1 - t * t) * (1 + 0.3 * t));
  }
  return x;
}

TEST(Loads, VolumeWeightsSumToTheVolume) {
  for (const cell::CellType type : area_types)
    for (const Assumption a : assumptions) {
      const Coordinates x = sample_cell(type, 0.15, false);
      const cell::CellInfo& info = cell::info(type);
      double area = 0, moment = 0;  // of the polygon of the corners
      for (int k = 0; k < info.corners; ++k) {
        const Vec2 p = x.row(k), q = x.row((k + 1) % info.corners);
        const double cross = p.x() * q.y() - p.y() * q.x();
        area += cross / 2;
        moment += cross * (p.x() + q.x()) / 6;
      }
      const double volume =
          a == Assumption::axisymmetric ? 2 * std::numbers::pi * moment : 1.7 * area;
      EXPECT_NEAR(volume_weights(with(a, Kinematics::small), type, x).sum(), volume, 1e-14 * volume)
          << info.name;
    }
}

TEST(Loads, EdgeWeightsSumToTheArea) {
  for (const int nodes : {2, 3, 4})
    for (const Assumption a : assumptions) {
      const Coordinates x = sample_edge(nodes, true);
      const Vec2 p = x.row(0), q = x.row(1);
      const double depth = a == Assumption::axisymmetric ? std::numbers::pi * (p.x() + q.x()) : 1.7;
      const double area = depth * (q - p).norm();
      const ElementVector w = edge_weights(with(a, Kinematics::small), x);
      EXPECT_NEAR(w.sum(), area, 1e-14 * area);
      if (a == Assumption::axisymmetric) continue;
      if (nodes == 3) {
        EXPECT_LT((w - area / 6 * Vec3(1, 1, 4)).norm(), 1e-14 * area);
      }
    }
}

TEST(Loads, PressurePushesIntoTheBodyOnTheRightOfTravel) {
  Coordinates x(2, 2);
  x << 0, 1, 2, 1;  // to the right: the body is below
  const PressureResult r =
      edge_pressure(with(Assumption::plane_strain, Kinematics::small), x, x * 0, 5);
  EXPECT_LT((r.force - Vec<4>(0, -5 * 1.7, 0, -5 * 1.7)).norm(), 1e-14);
  EXPECT_EQ(r.tangent.norm(), 0.0);
}

TEST(Loads, TangentOfPressureIsTheDerivative) {
  for (const int nodes : {2, 3, 4})
    for (const Assumption a : assumptions)
      for (const Kinematics k : {Kinematics::small, Kinematics::finite}) {
        const Coordinates x = sample_edge(nodes, false);
        Coordinates u(nodes, 2), d(nodes, 2);
        for (int n = 0; n < nodes; ++n)
          for (int i = 0; i < 2; ++i) {
            u(n, i) = 0.1 * noise(n, i, 3);
            d(n, i) = noise(n, i, 4);
          }
        const Section s = with(a, k);
        const PressureResult r = edge_pressure(s, x, u, 2.5);
        if (k == Kinematics::small) {
          EXPECT_EQ(r.tangent.norm(), 0.0);
          EXPECT_EQ(r.force, edge_pressure(s, x, x * 0, 2.5).force);
          continue;
        }
        const auto force = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
          return edge_pressure(s, x, unflat(v, 2), 2.5).force;
        };
        const auto report =
            osculate::testing::check_derivative(force, r.tangent * flat(d), flat(u), flat(d));
        EXPECT_TRUE(report.exact || std::abs(report.order - 2) < 0.1)
            << nodes << " order " << report.order << " error " << report.error;
      }
}

// A pressure all around a body that keeps its shape has no resultant, wherever the body is turned.
TEST(Loads, PressureAllAroundBalances) {
  for (const cell::CellType type : area_types) {
    const Coordinates x = sample_cell(type, 0.12, true), u = sample_displacement(type, 0.06);
    const cell::CellInfo& info = cell::info(type);
    Vec3 sum = Vec3::Zero();
    for (int e = 0; e < info.edge_count; ++e) {
      const Coordinates edge = edge_of(info, e, x), moved = edge_of(info, e, u);
      const ElementVector f =
          edge_pressure(with(Assumption::plane_strain, Kinematics::finite), edge, moved, 3).force;
      for (Eigen::Index k = 0; k < edge.rows(); ++k) {
        const Vec2 p = (edge + moved).row(k), g = f.segment<2>(2 * k);
        sum += Vec3(g.x(), g.y(), p.x() * g.y() - p.y() * g.x());
      }
    }
    EXPECT_LT(sum.norm(), 1e-13) << info.name;
  }
}

TEST(Jacobian, FindsTheWorstPlace) {
  Coordinates x(4, 2);
  x << 0, 0, 2, 0, 2, 1, 0, 1;
  EXPECT_NEAR(smallest_jacobian(cell::CellType::quad4, x), 0.5, 1e-16);
  x.row(2) << 0.5, 0.25;  // a corner pushed beyond the diagonal
  EXPECT_LT(smallest_jacobian(cell::CellType::quad4, x), 0);
  x << 0, 0, 2, 0, 2, 1, 0, 1;
  x.row(1).swap(x.row(3));  // numbered clockwise
  EXPECT_NEAR(smallest_jacobian(cell::CellType::quad4, x), -0.5, 1e-16);
  // the middle of an edge pushed in so far that only there the cell overlaps
  Coordinates q = sample_cell(cell::CellType::quad8, 0, false);
  EXPECT_NEAR(smallest_jacobian(cell::CellType::quad8, q), 0.25, 1e-15);
  q(4, 1) += 1.02;
  EXPECT_LT(smallest_jacobian(cell::CellType::quad8, q), 0);
}

}  // namespace
}  // namespace osculate::solid::testing
