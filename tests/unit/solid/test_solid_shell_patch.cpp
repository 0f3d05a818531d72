#include <algorithm>
#include <cmath>
#include <vector>

#include "osculate/cell/shape.hpp"
#include "solid_shell_cases.hpp"

namespace osculate::solid::testing {
namespace {

/// Prismatic cell, of thickness 0.2, distorted in its plane with straight edges.
Coordinates3 prismatic(cell::CellType type) {
  Coordinates3 x(cell::info(type).nodes, 3);
  Coordinates3 corners(8, 3);
  for (int k = 0; k < 8; ++k) {
    corners.row(k) = 0.5 * cell::volume_node(cell::CellType::hex8, k);
    corners(k, 2) *= 0.2;
    for (int i = 0; i < 2; ++i) corners(k, i) += 0.15 * volume_noise(k % 4, i);
  }
  for (int k = 0; k < x.rows(); ++k) {
    const cell::VolumeShape s =
        cell::volume_shape(cell::CellType::hex8, cell::volume_node(type, k));
    x.row(k) = s.n.head<8>().transpose() * corners;
  }
  return x;
}

// The plain displacement cell has the exact forces of a linear displacement.
TEST(SolidShellPatch, LinearDisplacementGivesTheForcesOfTheDisplacementCell) {
  Mat<3, 3> shape;
  shape << 0.3, -0.2, 0.4, 0.5, 0.1, -0.3, 0.2, -0.1, 0.25;
  for_each_shell([&](const VolumeCase& c) {
    VolumeCase plain = c;
    plain.section.formulation = VolumeFormulation::full;
    const Mat<3, 3> turn = turn3(0.9);
    const Coordinates3 x = prismatic(c.type) * turn.transpose();
    for (const double size : {1e-9, 1e-3, 0.3}) {
      const Coordinates3 u = size * x * shape.transpose();
      const VolumeVector found = evaluated(c, x, u).force, exact = evaluated(plain, x, u).force;
      EXPECT_LT((found - exact).norm(), 2e-13 * exact.norm()) << size;
    }
  });
}

/// MacNeal & Harder's patch of five quadrilaterals as a plate. Nodes of all cells are listed cell
/// by cell; forces at equal places add up.
struct Plate {
  static constexpr double height = 0.001, length = 0.24, width = 0.12;
  std::vector<Coordinates3> cells;

  explicit Plate(cell::CellType type) {
    constexpr std::array<std::array<int, 4>, 5> nodes{
        {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}}};
    const std::array<Vec2, 8> at{{{0, 0},
                                  {length, 0},
                                  {length, width},
                                  {0, width},
                                  {0.04, 0.02},
                                  {0.18, 0.03},
                                  {0.16, 0.08},
                                  {0.08, 0.08}}};
    for (const auto& cell : nodes) {
      Coordinates3 x(cell::info(type).nodes, 3);
      for (int k = 0; k < x.rows(); ++k) {
        const Vec3 xi = cell::volume_node(type, k);
        const cell::AreaShape s = cell::area_shape(cell::CellType::quad4, xi.head<2>());
        Vec2 place = Vec2::Zero();
        for (std::size_t i = 0; i < 4; ++i)
          place += s.n[static_cast<Eigen::Index>(i)] * at[static_cast<std::size_t>(cell[i])];
        x.row(k) << place.transpose(), 0.5 * height * xi.z();
      }
      cells.push_back(x);
    }
  }
  [[nodiscard]] static bool at_border(const Vec3& x) {
    constexpr double near = 1e-9;
    return x.x() < near || x.x() > length - near || x.y() < near || x.y() > width - near;
  }
};

struct PlateForces {
  double inside, border, work;
};
/// Norms of the forces at the nodes, and force times displacement.
template <class Motion>
PlateForces plate_forces(const VolumeCase& c, const Motion& motion) {
  const Plate plate(c.type);
  std::vector<std::pair<Vec3, Vec3>> nodes;  // place, force
  PlateForces sum{0, 0, 0};
  for (const Coordinates3& x : plate.cells) {
    Coordinates3 u(x.rows(), 3);
    for (Eigen::Index k = 0; k < x.rows(); ++k) u.row(k) = motion(Vec3(x.row(k))).transpose();
    const VolumeVector force = evaluated(c, x, u).force;
    sum.work += force.dot(flat(u));
    for (Eigen::Index k = 0; k < x.rows(); ++k) {
      const Vec3 place = x.row(k);
      auto it = std::find_if(nodes.begin(), nodes.end(),
                             [&](const auto& node) { return (node.first - place).norm() < 1e-9; });
      if (it == nodes.end()) it = nodes.insert(it, {place, Vec3::Zero()});
      it->second += force.segment<3>(3 * k);
    }
  }
  for (const auto& [place, force] : nodes)
    (Plate::at_border(place) ? sum.border : sum.inside) += force.squaredNorm();
  sum.inside = std::sqrt(sum.inside);
  sum.border = std::sqrt(sum.border);
  return sum;
}

VolumeCase plate_case(cell::CellType type, double poisson) {
  return {
      {Kinematics::small, VolumeFormulation::solid_shell, material::LinearElastic{1e6, poisson, 0}},
      type};
}

// Constant membrane strains with the thickness free: plane stress.
TEST(SolidShellPatch, MembraneStateIsInEquilibrium) {
  for (const cell::CellType type : {cell::CellType::hex8, cell::CellType::shell18})
    for (const double nu : {0.0, 0.3}) {
      const double xx = 1e-3, yy = -0.4e-3, xy = 0.5e-3;
      const PlateForces f = plate_forces(plate_case(type, nu), [&](const Vec3& p) {
        return Vec3(xx * p.x() + xy * p.y(), xy * p.x() + yy * p.y(),
                    -nu / (1 - nu) * (xx + yy) * p.z());
      });
      const double energy = 1e6 / (1 - nu * nu) *
                            (xx * xx + yy * yy + 2 * nu * xx * yy + 2 * (1 - nu) * xy * xy) *
                            Plate::length * Plate::width * Plate::height;
      EXPECT_LT(f.inside, 1e-12 * f.border) << nu;
      EXPECT_NEAR(f.work, energy, 1e-12 * energy) << nu;
    }
}

// Constant curvatures: Kirchhoff's plate, whose thickness strain is linear in z.
TEST(SolidShellPatch, BendingStateIsInEquilibriumAndHasKirchhoffsEnergy) {
  for (const cell::CellType type : {cell::CellType::hex8, cell::CellType::shell18})
    for (const double nu : {0.0, 0.3, 0.49}) {
      const double xx = 2e-3, yy = 1e-3, xy = 0.7e-3;  // curvatures
      const PlateForces f = plate_forces(plate_case(type, nu), [&](const Vec3& p) {
        return Vec3(-p.z() * (xx * p.x() + xy * p.y()), -p.z() * (xy * p.x() + yy * p.y()),
                    0.5 * (xx * p.x() * p.x() + yy * p.y() * p.y()) + xy * p.x() * p.y());
      });
      const double energy = 1e6 / (1 - nu * nu) * std::pow(Plate::height, 3) / 12 *
                            (xx * xx + yy * yy + 2 * nu * xx * yy + 2 * (1 - nu) * xy * xy) *
                            Plate::length * Plate::width;
      EXPECT_LT(f.inside, 1e-10 * f.border) << nu;
      EXPECT_NEAR(f.work, energy, 1e-10 * energy) << nu;
    }
}

}  // namespace
}  // namespace osculate::solid::testing
