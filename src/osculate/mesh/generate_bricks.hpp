#pragma once
// Shared by the generators of volume cells; not for users.
#include <array>
#include <vector>

#include "osculate/mesh/generate_support.hpp"

namespace osculate::mesh {

using Place = std::array<int, 3>;  ///< of a node in a lattice of bricks

[[nodiscard]] inline Place operator+(const Place& a, const Place& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// Cells that fill a brick of the lattice, each by the places of its nodes.
using Pattern = std::vector<std::vector<Place>>;

/// Steps of the lattice along one brick in x, y and z.
[[nodiscard]] Place steps_of(cell::CellType type);
/// The cells that fill a brick: every node lies where the linear shape functions put it.
[[nodiscard]] Pattern pattern_of(cell::CellType type);

/// Calls `visit` with the lowest corner of every brick of a lattice whose last node is `last`.
template <class Visit>
void for_each_brick(const Place& last, const Place& steps, const Visit& visit) {
  Place p{};
  for (p[2] = 0; p[2] < last[2]; p[2] += steps[2])
    for (p[1] = 0; p[1] < last[1]; p[1] += steps[1])
      for (p[0] = 0; p[0] < last[0]; p[0] += steps[0]) visit(p);
}

/// Adds the cells of a right-handed lattice to the mesh and to `volume`; `node` gives the node of a
/// place.
template <class Node>
void fill_bricks(Mesh& mesh, Set& volume, cell::CellType type, const Place& last,
                 const Node& node) {
  const Index block = block_index(mesh, type);
  const Pattern pattern = pattern_of(type);
  std::vector<Index> nodes;
  for_each_brick(last, steps_of(type), [&](const Place& origin) {
    for (const std::vector<Place>& cell : pattern) {
      nodes.clear();
      for (const Place& p : cell) nodes.push_back(node(origin + p));
      add_cell(mesh, block, volume, nodes);
    }
  });
}

/// Where a node of the first octant (for a disc: quadrant, z = 0) of a unit ball lies, by its place
/// 0..1 in the cube in the middle and how far `out`, 0..1, it is from that cube to the sphere.
[[nodiscard]] Vec3 round_place(const Vec3& cube, double out);

}  // namespace osculate::mesh
