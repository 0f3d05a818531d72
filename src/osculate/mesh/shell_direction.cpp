#include "osculate/mesh/shell_direction.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/cell/volume_shape.hpp"

namespace osculate::mesh {
namespace {

using Nodes = std::array<Index, 8>;

/// The node of hex8 at these signs of its coordinates.
std::size_t node_at(const Vec3& corner) {
  std::size_t at = 0;
  for (int k = 0; k < 8; ++k)
    if ((cell::volume_node(cell::CellType::hex8, k) - corner).squaredNorm() < 1)
      at = static_cast<std::size_t>(k);
  return at;
}

/// The four corners with coordinate `direction` at `side`, in no particular order.
std::array<Index, 4> face(const Nodes& nodes, int direction, double side) {
  std::array<Index, 4> out{};
  std::size_t count = 0;
  for (int k = 0; k < 8; ++k)
    if (cell::volume_node(cell::CellType::hex8, k)[direction] * side > 0)
      out[count++] = nodes[static_cast<std::size_t>(k)];
  return out;
}

bool is_free(const FaceTable& table, const Nodes& nodes, int direction) {
  return table.find(face(nodes, direction, -1)).size() == 1 &&
         table.find(face(nodes, direction, 1)).size() == 1;
}

/// Distance of the middles of two opposite faces.
double length(const Mesh& mesh, const Nodes& nodes, int direction) {
  Vec3 sum = Vec3::Zero();
  for (const double side : {-1.0, 1.0})
    for (const Index n : face(nodes, direction, side))
      sum += side / 4 * mesh.nodes[static_cast<std::size_t>(n)];
  return sum.norm();
}

/// Direction through the thickness.
int thickness(const Mesh& mesh, const FaceTable& table, const Nodes& nodes) {
  int best = is_free(table, nodes, 2) ? 2 : -1;
  for (const int d : {0, 1}) {
    if (!is_free(table, nodes, d)) continue;
    const double factor = best == 2 ? 0.5 : 1.0;
    if (best < 0 || length(mesh, nodes, d) < factor * length(mesh, nodes, best)) best = d;
  }
  return best < 0 ? 2 : best;
}

/// The same cell with `direction` as its third: the directions go round, so that it stays
/// right-handed.
Nodes turned(const Nodes& nodes, int direction) {
  Nodes out{};
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner = cell::volume_node(cell::CellType::hex8, k);
    Vec3 old;
    for (int i = 0; i < 3; ++i) old[(i + direction + 1) % 3] = corner[i];
    out[static_cast<std::size_t>(k)] = nodes[node_at(old)];
  }
  return out;
}

}  // namespace

Index align_shells(Mesh& mesh, std::span<const CellRef> cells) {
  const FaceTable table = face_table(mesh, cells);
  Index count = 0;
  for (const CellRef& ref : cells) {
    Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
    if (block.type != cell::CellType::hex8) continue;
    const auto first = block.connectivity.begin() + 8 * static_cast<std::ptrdiff_t>(ref.cell);
    Nodes nodes{};
    std::copy_n(first, 8, nodes.begin());
    const int direction = thickness(mesh, table, nodes);
    if (direction == 2) continue;
    const Nodes now = turned(nodes, direction);
    std::copy(now.begin(), now.end(), first);
    ++count;
  }
  return count;
}

}  // namespace osculate::mesh
