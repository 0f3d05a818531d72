#include "patch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "../model3.hpp"
#include "osculate/cell/shape.hpp"
#include "problems.hpp"

namespace osculate::verification::shell {
namespace {

constexpr double length = 0.24, width = 0.12, height = 0.01;

/// Displacements with constant membrane strains, the thickness free.
Vec3 membrane(const Vec3& p, double nu) {
  constexpr double xx = 1e-3, yy = -0.4e-3, xy = 0.5e-3;
  return {xx * p.x() + xy * p.y(), xy * p.x() + yy * p.y(), -nu / (1 - nu) * (xx + yy) * p.z()};
}

/// Displacements with constant curvatures. The thickness strain is linear in z: it moves both faces
/// alike against the middle surface, and everywhere by the same, so it does not appear here.
Vec3 bending(const Vec3& p) {
  constexpr double xx = 2e-3, yy = 1e-3, xy = 0.7e-3;
  return {-p.z() * (xx * p.x() + xy * p.y()), -p.z() * (xy * p.x() + yy * p.y()),
          0.5 * (xx * p.x() * p.x() + yy * p.y() * p.y()) + xy * p.x() * p.y()};
}

bool at_border(const PatchMesh& m, const Vec3& x) {
  constexpr double near = 1e-9;
  return x.x() < near || x.x() > m.length - near || x.y() < near || x.y() > m.width - near;
}

Vec2 bent_by(const PatchMesh& m, const Vec2& x) {
  const double by = m.bend * m.width * std::sin(std::numbers::pi * x.x() / m.length) *
                    std::sin(std::numbers::pi * x.y() / m.width);
  return {by, -by};
}

void add_cells(Builder3& b, const PatchMesh& m, cell::CellType type) {
  for (const auto& quad : m.quads) {
    std::vector<Index> nodes;
    for (int k = 0; k < cell::info(type).nodes; ++k) {
      const Vec3 xi = cell::volume_node(type, k);
      const cell::AreaShape s = cell::area_shape(cell::CellType::quad4, xi.head<2>());
      Vec3 place(0, 0, 0.5 * m.height * xi.z());
      for (std::size_t i = 0; i < 4; ++i)
        place.head<2>() += s.n[static_cast<Eigen::Index>(i)] * m.at[quad[i]];
      place.head<2>() += bent_by(m, place.head<2>());
      nodes.push_back(b.node(place));
    }
    b.cell(type, nodes, 0);
  }
}

}  // namespace

PatchMesh five_cells() {
  return {{{0, 0},
           {length, 0},
           {length, width},
           {0, width},
           {0.04, 0.02},
           {0.18, 0.03},
           {0.16, 0.08},
           {0.08, 0.08}},
          {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}},
          length,
          width,
          height};
}

PatchMesh four_cells(double shift) {
  PatchMesh m{{}, {}, length, width, height};
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < 3; ++i) {
      const double by = i == 1 && j == 1 ? shift : 0;
      m.at.emplace_back(0.5 * length * (double(i) + by), 0.5 * width * (double(j) + by));
    }
  for (std::size_t j = 0; j < 2; ++j)
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t n = 3 * j + i;
      m.quads.push_back({n, n + 1, n + 4, n + 3});
    }
  return m;
}

PatchMesh refined(const PatchMesh& mesh, int n) {
  PatchMesh m{{}, {}, mesh.length, mesh.width, mesh.height, mesh.bend};
  for (const auto& quad : mesh.quads)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        std::array<std::size_t, 4> corners{};
        for (int k = 0; k < 4; ++k) {
          const Vec2 xi = cell::area_node(cell::CellType::quad4, k);
          const Vec2 at((2 * i + 1 + xi.x()) / n - 1, (2 * j + 1 + xi.y()) / n - 1);
          const cell::AreaShape shape = cell::area_shape(cell::CellType::quad4, at);
          Vec2 place = Vec2::Zero();
          for (std::size_t c = 0; c < 4; ++c)
            place += shape.n[static_cast<Eigen::Index>(c)] * mesh.at[quad[c]];
          corners[static_cast<std::size_t>(k)] = m.at.size();
          m.at.push_back(place);  // shared corners become one node later
        }
        m.quads.push_back(corners);
      }
  return m;
}

PatchMesh bent(PatchMesh mesh, double bend) {
  mesh.bend = bend;
  return mesh;
}

double patch_error(const PatchMesh& mesh, cell::CellType type, PlateState state, double poisson,
                   const Workers& workers) {
  Builder3 b;
  model::BulkSection3 section;
  section.name = "plate";
  section.section = linear(1e6, poisson);
  b.model.sections.push_back(section);
  add_cells(b, mesh, type);
  model::Step step;
  step.name = "border";
  std::vector<Vec3> exact;
  for (std::size_t n = 0; n < b.model.reference.size(); ++n) {
    const Vec3& x = b.model.reference[n];
    exact.push_back(state == PlateState::membrane ? membrane(x, poisson) : bending(x));
    for (int i = 0; i < 3 && at_border(mesh, x); ++i)
      step.prescribed.push_back(
          {3 * static_cast<model::Dof>(n) + i, {0, exact.back()[i], {}}, false});
  }
  b.model.steps.push_back(step);
  model::AnalysisOptions options;
  workers.work_on(options);
  const model::AnalysisResult3 result = model::run(b.model, options, {});
  if (result.outcome != solve::Outcome::converged) throw std::runtime_error(result.message);
  double error = 0, largest = 0;
  for (std::size_t n = 0; n < exact.size(); ++n) {
    const Vec3 u = result.state.u.segment<3>(3 * static_cast<Eigen::Index>(n));
    error = std::max(error, (u - exact[n]).norm());
    largest = std::max(largest, exact[n].norm());
  }
  return error / largest;
}

}  // namespace osculate::verification::shell
