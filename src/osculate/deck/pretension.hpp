#pragma once
#include <array>
#include <vector>

#include "osculate/deck/constraint_description.hpp"
#include "osculate/mesh/mesh.hpp"

namespace osculate::deck {

/// Cuts the mesh at the facets of a section under pretension: the cells on the side that the axis
/// points to get nodes of their own there. The sets `<name>.behind` and `<name>.front` have the
/// nodes of both sides in the same order, the set `<name>` the node that stands for the shortening.
///
/// Errors     core::InputError for a set that is no section of a body
/// Tested by  tests/unit/deck/test_pretension.cpp
void cut(const Pretension& pretension, mesh::Mesh& mesh);

/// What `cut` has left behind.
struct Cut {
  std::vector<std::array<Index, 2>> nodes;  ///< of both sides; the axis points to the second
  Vec3 axis;                                ///< unit
  Index node = -1;                          ///< of the shortening
};
[[nodiscard]] Cut cut_of(const Pretension& pretension, const mesh::Mesh& mesh);

/// Sum of the normals of the facets of a set, as their nodes run: r_1 x r_2, in the plane to the
/// left of a line.
[[nodiscard]] Vec3 mean_normal(const mesh::Mesh& mesh, const mesh::Set& set);

}  // namespace osculate::deck
