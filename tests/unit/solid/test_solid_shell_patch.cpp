#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "cell_cases.hpp"
#include "osculate/cell/shape.hpp"
#include "osculate/solid/solid_shell.hpp"

namespace osculate::solid::testing {
namespace {

/// Prismatic cell, of thickness 0.2, distorted in its plane with straight edges.
Coordinates<3> prismatic(cell::CellType type) {
  Coordinates<3> x(cell::info(type).nodes, 3);
  Coordinates<3> corners(8, 3);
  for (int k = 0; k < 8; ++k) {
    corners.row(k) = 0.5 * cell::volume_node(cell::CellType::hex8, k);
    corners(k, 2) *= 0.2;
    for (int i = 0; i < 2; ++i) corners(k, i) += 0.15 * noise(k % 4, i);
  }
  for (int k = 0; k < x.rows(); ++k) {
    const cell::VolumeShape s =
        cell::volume_shape(cell::CellType::hex8, cell::volume_node(type, k));
    x.row(k) = s.n.head<8>().transpose() * corners;
  }
  return x;
}

/// The plain displacement cell has the exact forces of a linear displacement.
void expect_forces_of_displacement_cell(const VolumeCase& c, const Coordinates<3>& x,
                                        const Mat<3, 3>& h) {
  VolumeCase plain = c;
  plain.section.formulation = Formulation::full;
  const Coordinates<3> u = x * h.transpose();
  const ElementVector<3> found = evaluated(c, x, u).force, exact = evaluated(plain, x, u).force;
  EXPECT_LT((found - exact).norm(), 1e-15 * stiffness_scale(c, x) * x.norm());
}

TEST(SolidShellPatch, AnyLinearDisplacementIsExactInAnAffineCell) {
  Mat<3, 3> shape, affine;
  shape << 0.3, -0.2, 0.4, 0.5, 0.1, -0.3, 0.2, -0.1, 0.25;
  affine << 1.2, 0.4, 0.3, -0.3, 0.9, 0.5, 0.1, 0.2, 0.7;
  for_each_shell([&](const VolumeCase& c) {
    const Coordinates<3> x = sample_shell(c.type, 0.2, 0) * affine.transpose();
    for (const double size : {1e-3, 0.3}) expect_forces_of_displacement_cell(c, x, size * shape);
  });
}

// Constant stress does no work on what the sampled and fitted strains leave out, whatever the
// outline.
TEST(SolidShellPatch, LinearDisplacementWithoutTransverseShearIsExactInADistortedCell) {
  Mat<3, 3> strain, spin;
  strain << 0.3, -0.2, 0, -0.2, 0.1, 0, 0, 0, 0.25;
  spin << 0, -0.5, 0.3, 0.5, 0, -0.2, -0.3, 0.2, 0;
  const Mat<3, 3> one = Mat<3, 3>::Identity(), to = turn3(0.9);
  for_each_shell([&](const VolumeCase& c) {
    const Coordinates<3> x = prismatic(c.type) * to.transpose();
    for (const double size : {1e-3, 0.3}) {
      const Mat<3, 3> stretched = one + size * strain;
      const Mat<3, 3> h =
          c.finite() ? Mat<3, 3>(turn3(size) * stretched - one) : Mat<3, 3>(size * (strain + spin));
      expect_forces_of_displacement_cell(c, x, to * h * to.transpose());
    }
  });
}

/// MacNeal & Harder's patch of five quadrilaterals as a plate. Nodes of all cells are listed cell
/// by cell; forces at equal places add up.
struct Plate {
  static constexpr double height = 0.01, length = 0.24, width = 0.12;
  std::vector<Coordinates<3>> cells;

  explicit Plate(cell::CellType type) {
    const CellPatch patch = macneal_harder(Kind::plane);
    for (const auto& nodes : patch.cells) {
      const Eigen::MatrixXd corners = patch.nodes(nodes, Eigen::all);
      Coordinates<3> x(cell::info(type).nodes, 3);
      for (int k = 0; k < x.rows(); ++k) {
        const Vec3 xi = cell::volume_node(type, k);
        const cell::AreaShape s = cell::area_shape(patch.type, xi.head<2>());
        x.row(k) << s.n.head<4>().transpose() * corners, 0.5 * height * xi.z();
      }
      cells.push_back(x);
    }
  }
  [[nodiscard]] static bool at_border(const Vec3& x) {
    constexpr double near = 1e-9;
    return x.x() < near || x.x() > length - near || x.y() < near || x.y() > width - near;
  }
};

struct PlateResult {
  double error;   ///< of the displacements inside, relative to all displacements
  double energy;  ///< of the given displacements, relative to the exact one
};
/// Finds the displacements inside from those of `motion` at the border.
template <class Motion>
PlateResult solve_plate(const VolumeCase& c, double energy, const Motion& motion) {
  const Plate plate(c.type);
  std::vector<Vec3> nodes;
  std::vector<std::vector<Eigen::Index>> numbers;
  for (const Coordinates<3>& x : plate.cells) {
    numbers.emplace_back();
    for (Eigen::Index k = 0; k < x.rows(); ++k) {
      const Vec3 place = x.row(k);
      const auto it = std::find_if(nodes.begin(), nodes.end(),
                                   [&](const Vec3& n) { return (n - place).norm() < 1e-9; });
      numbers.back().push_back(it - nodes.begin());
      if (it == nodes.end()) nodes.push_back(place);
    }
  }
  const auto size = static_cast<Eigen::Index>(3 * nodes.size());
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd exact(size), force = Eigen::VectorXd::Zero(size);
  double work = 0;
  std::vector<Eigen::Index> inside;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const auto at = static_cast<Eigen::Index>(3 * n);
    exact.segment<3>(at) = motion(nodes[n]);
    for (Eigen::Index i = 0; i < 3 && !Plate::at_border(nodes[n]); ++i) inside.push_back(at + i);
  }
  for (std::size_t e = 0; e < plate.cells.size(); ++e) {
    const Coordinates<3>& x = plate.cells[e];
    Coordinates<3> u(x.rows(), 3);
    for (Eigen::Index i = 0; i < x.rows(); ++i) u.row(i) = motion(Vec3(x.row(i)));
    const ElementResult<3> cell = evaluated(c, x, u);
    work += cell.force.dot(flat(u));
    for (Eigen::Index a = 0; a < x.rows(); ++a)
      force.segment<3>(3 * numbers[e][static_cast<std::size_t>(a)]) += cell.force.segment<3>(3 * a);
    for (Eigen::Index a = 0; a < x.rows(); ++a)
      for (Eigen::Index b = 0; b < x.rows(); ++b)
        k.block<3, 3>(3 * numbers[e][static_cast<std::size_t>(a)],
                      3 * numbers[e][static_cast<std::size_t>(b)]) +=
            cell.tangent.block<3, 3>(3 * a, 3 * b);
  }
  const Eigen::MatrixXd free = k(inside, inside);
  const Eigen::VectorXd rest = -force(inside), correction = free.ldlt().solve(rest);
  return {correction.norm() / exact.norm(), work / energy};
}

VolumeCase plate_case(cell::CellType type, double poisson) {
  return {{Kinematics::small, Formulation::solid_shell, material::LinearElastic{1e6, poisson, 0}},
          type};
}

constexpr double area = Plate::length * Plate::width;

// Constant membrane strains with the thickness free: plane stress.
TEST(SolidShellPatch, MembraneStateOfAPlate) {
  for (const cell::CellType type : {cell::CellType::hex8, cell::CellType::shell18})
    for (const double nu : {0.0, 0.3}) {
      const double xx = 1e-3, yy = -0.4e-3, xy = 0.5e-3;
      const double squares = xx * xx + yy * yy + 2 * nu * xx * yy + 2 * (1 - nu) * xy * xy;
      const PlateResult r =
          solve_plate(plate_case(type, nu), 1e6 / (1 - nu * nu) * squares * area * Plate::height,
                      [&](const Vec3& p) {
                        return Vec3(xx * p.x() + xy * p.y(), xy * p.x() + yy * p.y(),
                                    -nu / (1 - nu) * (xx + yy) * p.z());
                      });
      std::printf("    membrane, nu %g: %.1e\n", nu, r.error);
      EXPECT_LT(r.error, 1e-13) << nu;
      EXPECT_NEAR(r.energy, 1, 1e-12) << nu;
    }
}

// Constant curvatures: Kirchhoff's plate, whose thickness strain is linear in z.
TEST(SolidShellPatch, BendingStateOfAPlate) {
  for (const cell::CellType type : {cell::CellType::hex8, cell::CellType::shell18})
    for (const double nu : {0.0, 0.3, 0.49}) {
      const double xx = 2e-3, yy = 1e-3, xy = 0.7e-3;  // curvatures
      const double squares = xx * xx + yy * yy + 2 * nu * xx * yy + 2 * (1 - nu) * xy * xy;
      const PlateResult r = solve_plate(
          plate_case(type, nu),
          1e6 / (1 - nu * nu) * std::pow(Plate::height, 3) / 12 * squares * area,
          [&](const Vec3& p) {
            return Vec3(-p.z() * (xx * p.x() + xy * p.y()), -p.z() * (xy * p.x() + yy * p.y()),
                        0.5 * (xx * p.x() * p.x() + yy * p.y() * p.y()) + xy * p.x() * p.y());
          });
      std::printf("    bending, nu %g: %.1e\n", nu, r.error);
      EXPECT_LT(r.error, 1e-13) << nu;
      EXPECT_NEAR(r.energy, 1, 1e-10) << nu;
    }
}

}  // namespace
}  // namespace osculate::solid::testing
