#include "osculate/mesh/quality.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "osculate/mesh/support.hpp"

namespace osculate::mesh {
namespace {

using cell::CellType;

/// A corner and the corners at the other ends of its edges, so that a good cell has a positive
/// determinant; `third` is -1 in areas.
struct Corner {
  int at, first, second, third = -1;
};

struct Corners {
  std::vector<Corner> corners;
  double regular = 1;  ///< determinant at the corners of the regular cell
};

std::vector<Corner> area_corners(const cell::CellInfo& info) {
  std::vector<Corner> out;
  for (int k = 0; k < info.corners; ++k)
    out.push_back({k, (k + 1) % info.corners, (k + info.corners - 1) % info.corners});
  return out;
}

/// Three faces meet at each corner; seen from outside, each runs from one neighbour to the next.
std::vector<Corner> volume_corners(const cell::CellInfo& info) {
  std::vector<Corner> out;
  const auto find = [&out](int at) {
    return std::find_if(out.begin(), out.end(), [at](const Corner& c) { return c.at == at; });
  };
  for (int f = 0; f < info.face_count; ++f) {
    const cell::CellFace& face = info.faces[static_cast<std::size_t>(f)];
    const auto n = static_cast<std::size_t>(cell::info(face.type).corners);
    for (std::size_t k = 0; k < n; ++k) {
      const int at = face.nodes[k], next = face.nodes[(k + 1) % n];
      const int before = face.nodes[(k + n - 1) % n];
      const auto found = find(at);
      if (found == out.end()) {
        out.push_back({at, before, next});
      } else if (found->third < 0) {
        const bool known = next == found->first || next == found->second;
        found->third = known ? before : next;
      }
    }
  }
  return out;
}

Corners corners_of(CellType type) {
  const cell::CellInfo& info = cell::info(type);
  Corners out{info.dimension == 2 ? area_corners(info) : volume_corners(info)};
  const bool tetrahedron = info.dimension == 3 && info.corners == 4;
  const bool triangles = info.corners == 3 || (info.dimension == 3 && info.corners == 6);
  if (tetrahedron) out.regular = std::sqrt(0.5);
  if (triangles) out.regular = std::sqrt(0.75);
  return out;
}

struct CellShape {
  double shape = std::numeric_limits<double>::infinity();
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
};

CellShape shape_of(const Mesh& mesh, const Index* nodes, const Corners& corners) {
  CellShape out;
  for (const Corner& c : corners.corners) {
    const Vec3& x = point(mesh, nodes[c.at]);
    const Vec3 a = point(mesh, nodes[c.first]) - x, b = point(mesh, nodes[c.second]) - x;
    const Vec3 d = c.third < 0 ? Vec3(0, 0, 1) : Vec3(point(mesh, nodes[c.third]) - x);
    const double length = a.norm() * b.norm() * d.norm();
    const double determinant = length > 0 ? a.cross(b).dot(d) / length : 0.0;
    out.shape = std::min(out.shape, determinant / corners.regular);
    out.shortest = std::min({out.shortest, a.norm(), b.norm()});
    out.longest = std::max({out.longest, a.norm(), b.norm()});
    if (c.third < 0) continue;
    out.shortest = std::min(out.shortest, d.norm());
    out.longest = std::max(out.longest, d.norm());
  }
  return out;
}

}  // namespace

Quality quality(const Mesh& mesh, std::span<const CellRef> cells) {
  std::vector<Corners> table(cell::cell_type_count);
  Quality out;
  for (const CellRef ref : cells) {
    const Block& block = block_of(mesh, ref);
    Corners& corners = table[static_cast<std::size_t>(block.type)];
    if (corners.corners.empty()) corners = corners_of(block.type);
    const CellShape found = shape_of(mesh, block.cell(ref.cell), corners);
    const double ratio = found.shortest > 0 ? found.longest / found.shortest
                                            : std::numeric_limits<double>::infinity();
    if (found.shape < poor_shape) ++out.poor;
    if (out.worst == CellRef{-1, -1} || found.shape < out.worst_shape) {
      out.worst_shape = found.shape;
      out.worst = ref;
    }
    if (out.longest == CellRef{-1, -1} || ratio > out.largest_ratio) {
      out.largest_ratio = ratio;
      out.longest = ref;
    }
  }
  return out;
}

}  // namespace osculate::mesh
