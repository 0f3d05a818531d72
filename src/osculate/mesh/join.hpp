#pragma once
#include <string>

#include "osculate/core/error.hpp"
#include "osculate/mesh/mesh.hpp"

namespace osculate::mesh {

/// Where a mesh is put: scaled about the origin, then turned, then moved.
struct Placement {
  double scale = 1;
  double angle = 0;     ///< degrees, right-handed about the axis through `about`
  Vec3 about{0, 0, 0};  ///< a point of that axis
  Vec3 axis{0, 0, 1};   ///< its direction, of any length
  Vec3 move{0, 0, 0};
};

void place(Mesh& mesh, const Placement& placement);

/// Adds another mesh: its nodes and cells behind those that are there, each of its sets as
/// `name.SET`, and before them a set `name` of all its cells of the highest dimension.
///
/// Errors     core::InputError at `mark`: there is a set of such a name; more than max_nodes
/// Tested by  tests/unit/mesh/test_join.cpp
void append_mesh(Mesh& mesh, const Mesh& part, const std::string& name,
                 const core::SourceMark& mark = {});

}  // namespace osculate::mesh
