#include "osculate/mesh/generate_bricks.hpp"

#include <cmath>
#include <numbers>

#include "osculate/cell/volume_shape.hpp"

namespace osculate::mesh {

using cell::CellType;

namespace {

/// The linear cells that fill a brick, by their corners.
Pattern linear_pattern(CellType type) {
  switch (cell::info(type).corners) {
    case 4: {
      // Six paths along the edges from corner 000 to corner 111.
      return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}},
              {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {1, 1, 1}},
              {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}},
              {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1, 1}},
              {{0, 0, 0}, {0, 1, 1}, {0, 0, 1}, {1, 1, 1}},
              {{0, 0, 0}, {1, 0, 1}, {1, 0, 0}, {1, 1, 1}}};
    }
    case 6:
      return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}},
              {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    default:
      return {
          {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  }
}

CellType linear_type(CellType type) {
  switch (cell::info(type).corners) {
    case 4:
      return CellType::tet4;
    case 6:
      return CellType::wedge6;
    default:
      return CellType::hex8;
  }
}

}  // namespace

Place steps_of(CellType type) {
  if (type == CellType::shell18) return {2, 2, 1};
  const int order = cell::info(type).order;
  return {order, order, order};
}

Pattern pattern_of(CellType type) {
  const Place steps = steps_of(type);
  Pattern pattern;
  for (const std::vector<Place>& corners : linear_pattern(type)) {
    std::vector<Place> nodes;
    for (int k = 0; k < cell::info(type).nodes; ++k) {
      const cell::VolumeShape shape =
          cell::volume_shape(linear_type(type), cell::volume_node(type, k));
      Vec3 x = Vec3::Zero();
      for (std::size_t c = 0; c < corners.size(); ++c)
        for (std::size_t i = 0; i < 3; ++i)
          x[static_cast<Eigen::Index>(i)] +=
              shape.n[static_cast<Eigen::Index>(c)] * corners[c][i] * steps[i];
      nodes.push_back({static_cast<int>(std::lround(x.x())), static_cast<int>(std::lround(x.y())),
                       static_cast<int>(std::lround(x.z()))});
    }
    pattern.push_back(std::move(nodes));
  }
  return pattern;
}

Vec3 round_place(const Vec3& cube, double out) {
  Vec3 ray;
  for (Eigen::Index k = 0; k < 3; ++k)
    ray[k] = cube[k] == 1.0 ? 1.0 : std::tan(0.25 * std::numbers::pi * cube[k]);
  const double size = cube.maxCoeff();
  const Vec3 on_sphere = size > 0 ? Vec3(ray / ray.norm()) : Vec3(Vec3::Zero());
  if (out == 1) return on_sphere;
  // Half way between a cube and a ball, so that no corner gets flat.
  const Vec3 inner = 0.25 * (cube + on_sphere * size);
  return inner + (on_sphere - inner) * out;
}

}  // namespace osculate::mesh
