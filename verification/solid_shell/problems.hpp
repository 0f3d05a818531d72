#pragma once
// Classical thin shells of one cell through the thickness: geometry, supports and loads. Shared by
// the verification case, which solves them with the product, and by the tests of the element.
#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "osculate/cell/quadrature.hpp"
#include "osculate/solid/solid_shell.hpp"

namespace osculate::verification::shell {

/// The node (i, j) of the bottom (side 0) or top (side 1) face is at map(u, v, z) with
/// u, v = 0..1 and z = -1 or 1; (u, v, z) must be right-handed.
struct ShellMesh {
  cell::CellType type;
  Index count_u, count_v;  ///< nodes
  std::vector<Vec3> nodes;
  std::vector<std::vector<Index>> cells;

  [[nodiscard]] Index node(Index i, Index j, Index side) const {
    return (side * count_v + j) * count_u + i;
  }
  [[nodiscard]] Index end_u() const { return count_u - 1; }
  [[nodiscard]] Index end_v() const { return count_v - 1; }
};

inline ShellMesh shell_mesh(cell::CellType type, Index cells_u, Index cells_v,
                            const std::function<Vec3(double, double, double)>& map) {
  const Index order = type == cell::CellType::hex8 ? 1 : 2;
  ShellMesh m{type, order * cells_u + 1, order * cells_v + 1, {}, {}};
  for (const double z : {-1.0, 1.0})
    for (Index j = 0; j < m.count_v; ++j)
      for (Index i = 0; i < m.count_u; ++i)
        m.nodes.push_back(map(double(i) / (m.count_u - 1), double(j) / (m.count_v - 1), z));
  for (Index j = 0; j < cells_v; ++j)
    for (Index i = 0; i < cells_u; ++i) {
      std::vector<Index> cell;
      for (int k = 0; k < cell::info(type).nodes; ++k) {
        const Vec3 at = 0.5 * order * (cell::volume_node(type, k) + Vec3::Ones());
        cell.push_back(
            m.node(order * i + Index(at.x()), order * j + Index(at.y()), at.z() > 0 ? 1 : 0));
      }
      m.cells.push_back(cell);
    }
  return m;
}

/// A moment about the y axis at the node pairs (bottom, top) of one edge: on each pair a couple
/// that follows its rotation, or all together on the edge as a rigid body. Its energy is
/// -moment * angle.
struct EndMoment {
  struct Pair {
    Index bottom, top;
    double moment;
  };
  std::vector<Pair> pairs;
};

struct ShellProblem {
  ShellMesh mesh;
  solid::Section<3> section;
  std::vector<char> fixed;  ///< a flag per unknown
  Eigen::VectorXd load;     ///< dead loads
  EndMoment moment;

  ShellProblem(ShellMesh m, solid::Section<3> s)
      : mesh(std::move(m)),
        section(std::move(s)),
        fixed(3 * mesh.nodes.size(), 0),
        load(Eigen::VectorXd::Zero(Eigen::Index(3 * mesh.nodes.size()))) {}
  void fix(Index node, int component) { fixed[std::size_t(3 * node + component)] = 1; }

  /// Both faces of an edge: u = const (along_v), or v = const.
  void fix_edge(bool along_v, Index at, std::initializer_list<int> components) {
    for (Index k = 0; k < (along_v ? mesh.count_v : mesh.count_u); ++k)
      for (Index side = 0; side < 2; ++side)
        for (const int c : components)
          fix(along_v ? mesh.node(at, k, side) : mesh.node(k, at, side), c);
  }
  /// Half of `force` on each face.
  void push(Index i, Index j, const Vec3& force) {
    for (Index side = 0; side < 2; ++side)
      load.segment<3>(3 * mesh.node(i, j, side)) += 0.5 * force;
  }
};

/// Mean displacement of the two nodes at (i, j).
inline Vec3 mid_displacement(const ShellMesh& m, const Eigen::VectorXd& u, Index i, Index j) {
  return 0.5 * (u.segment<3>(3 * m.node(i, j, 0)) + u.segment<3>(3 * m.node(i, j, 1)));
}

/// Share of each node in a load spread evenly along an edge of n nodes (sum 1).
inline std::vector<double> edge_shares(cell::CellType type, Index n) {
  std::vector<double> share(std::size_t(n), 0.0);
  if (type == cell::CellType::hex8) {
    for (Index i = 0; i + 1 < n; ++i)
      for (const Index k : {i, i + 1}) share[std::size_t(k)] += 0.5 / (n - 1);
    return share;
  }
  for (Index i = 0; i + 2 < n; i += 2) {
    const double length = 2.0 / (n - 1);
    share[std::size_t(i)] += length / 6;
    share[std::size_t(i + 1)] += length * 4 / 6;
    share[std::size_t(i + 2)] += length / 6;
  }
  return share;
}

/// Adds a constant body force per reference volume.
inline void add_body_force(ShellProblem& p, const Vec3& force) {
  const cell::Quadrature1D rule = cell::gauss_legendre(4);
  for (const std::vector<Index>& nodes : p.mesh.cells)
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b)
        for (std::size_t c = 0; c < 4; ++c) {
          const cell::VolumeShape shape =
              cell::volume_shape(p.mesh.type, {rule.points[a], rule.points[b], rule.points[c]});
          Mat<3, 3> jacobian = Mat<3, 3>::Zero();
          for (std::size_t k = 0; k < nodes.size(); ++k)
            jacobian += p.mesh.nodes[std::size_t(nodes[k])] * shape.d.row(Eigen::Index(k));
          const double volume =
              rule.weights[a] * rule.weights[b] * rule.weights[c] * jacobian.determinant();
          for (std::size_t k = 0; k < nodes.size(); ++k)
            p.load.segment<3>(3 * nodes[k]) += volume * shape.n[Eigen::Index(k)] * force;
        }
}

inline solid::Section<3> linear(double young, double poisson) {
  return {solid::Kinematics::small, solid::Formulation::solid_shell,
          material::LinearElastic{young, poisson, 0}};
}
inline solid::Section<3> finite(double young, double poisson) {
  return {solid::Kinematics::finite, solid::Formulation::solid_shell,
          material::StVenantKirchhoff{young, poisson, 0}};
}

/// A strip of width 1 along x in the plane z = 0, clamped at x = 0; E 1.2e6, nu 0.
inline ShellProblem strip(cell::CellType type, Index cells, double length, double height) {
  ShellProblem p(shell_mesh(type, cells, 1,
                            [&](double u, double v, double z) {
                              return Vec3(length * u, v, 0.5 * height * z);
                            }),
                 finite(1.2e6, 0));
  p.fix_edge(true, 0, {0, 1, 2});
  return p;
}

/// Length 10, height 0.1, dead force 4 at the end.
inline ShellProblem cantilever(cell::CellType type, Index cells) {
  ShellProblem p = strip(type, cells, 10, 0.1);
  const std::vector<double> share = edge_shares(type, p.mesh.count_v);
  for (Index j = 0; j < p.mesh.count_v; ++j)
    p.push(p.mesh.end_u(), j, {0, 0, 4 * share[std::size_t(j)]});
  return p;
}

/// Length 12, height 0.1, the end moment 2 pi EI / L that winds the strip to a full circle.
inline ShellProblem roll_up(cell::CellType type, Index cells) {
  ShellProblem p = strip(type, cells, 12, 0.1);
  const std::vector<double> share = edge_shares(type, p.mesh.count_v);
  const Index end = p.mesh.end_u();
  for (Index j = 0; j < p.mesh.count_v; ++j)
    p.moment.pairs.push_back({p.mesh.node(end, j, 0), p.mesh.node(end, j, 1),
                              -50 * std::numbers::pi / 3 * share[std::size_t(j)]});
  return p;
}

/// R 300, L 600, h 3, E 3e6, nu 0.3, two opposite unit forces in the middle, ends held by
/// diaphragms: an eighth. u: angle from the loaded generatrix (x direction), v: along the axis from
/// the middle.
inline ShellProblem pinched_cylinder(cell::CellType type, Index cells) {
  ShellProblem p(shell_mesh(type, cells, cells,
                            [](double u, double v, double z) {
                              const double r = 300 + 1.5 * z, a = 0.5 * std::numbers::pi * u;
                              return Vec3(r * std::cos(a), r * std::sin(a), 300 * v);
                            }),
                 linear(3e6, 0.3));
  p.fix_edge(true, 0, {1});
  p.fix_edge(true, p.mesh.end_u(), {0});
  p.fix_edge(false, 0, {2});
  p.fix_edge(false, p.mesh.end_v(), {0, 1});
  p.push(0, 0, {-0.25, 0, 0});
  return p;
}

/// R 25, L 50, 80 degrees, h 0.25, E 4.32e8, nu 0, weight 90 per area, ends held by diaphragms: a
/// quarter. u: angle from the top, v: along the axis from the middle.
inline ShellProblem scordelis_lo(cell::CellType type, Index cells) {
  ShellProblem p(shell_mesh(type, cells, cells,
                            [](double u, double v, double z) {
                              const double r = 25 + 0.125 * z, a = 40 * std::numbers::pi / 180 * u;
                              return Vec3(r * std::sin(a), 25 * v, r * std::cos(a));
                            }),
                 linear(4.32e8, 0));
  p.fix_edge(true, 0, {0});
  p.fix_edge(false, 0, {1});
  p.fix_edge(false, p.mesh.end_v(), {0, 2});
  add_body_force(p, {0, 0, -90 / 0.25});
  return p;
}

/// R 10, h 0.04, a hole of 18 degrees at the pole, two pairs of opposite forces at the equator,
/// inwards along y and outwards along x: a quarter, half the forces. u: angle from the x axis, v:
/// from the equator. Material E 6.825e7, nu 0.3.
inline ShellProblem hemisphere(cell::CellType type, Index cells, const solid::Section<3>& section,
                               double force) {
  using std::numbers::pi;
  ShellProblem p(shell_mesh(type, cells, cells,
                            [](double u, double v, double z) {
                              const double r = 10 + 0.02 * z, a = 0.5 * pi * u,
                                           b = 72 * pi / 180 * v;
                              return Vec3(r * std::cos(a) * std::cos(b),
                                          r * std::sin(a) * std::cos(b), r * std::sin(b));
                            }),
                 section);
  p.fix_edge(true, 0, {1});
  p.fix_edge(true, p.mesh.end_u(), {0});
  p.fix(p.mesh.node(0, 0, 0), 2);
  p.push(0, 0, {0.5 * force, 0, 0});
  p.push(p.mesh.end_u(), 0, {0, -0.5 * force, 0});
  return p;
}

/// Radii 6 and 10, h 0.03, E 21e6, nu 0, a slit with one side clamped and a dead load of 0.8 per
/// length along the other. u: from the inner edge, v: around.
inline ShellProblem slit_plate(cell::CellType type, Index around, Index across) {
  ShellProblem p(shell_mesh(type, across, around,
                            [](double u, double v, double z) {
                              const double r = 6 + 4 * u, a = 2 * std::numbers::pi * v;
                              return Vec3(r * std::cos(a), r * std::sin(a), 0.015 * z);
                            }),
                 finite(21e6, 0));
  p.fix_edge(false, 0, {0, 1, 2});
  const std::vector<double> share = edge_shares(type, p.mesh.count_u);
  for (Index i = 0; i < p.mesh.count_u; ++i)
    p.push(i, p.mesh.end_v(), {0, 0, 0.8 * 4 * share[std::size_t(i)]});
  return p;
}

}  // namespace osculate::verification::shell
