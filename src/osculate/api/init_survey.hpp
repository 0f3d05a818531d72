#pragma once
// What `osculate init` finds in a mesh; shared by the sources of this layer, not for users.
#include <string>
#include <vector>

#include "osculate/mesh/mesh.hpp"

namespace osculate::api {

struct Bounds {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  void add(const Vec3& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  [[nodiscard]] double size() const { return (high - low).norm(); }
  /// Whether they come nearer to each other than that.
  [[nodiscard]] bool near(const Bounds& other, double distance) const {
    return ((low - other.high).array() <= distance).all() &&
           ((other.low - high).array() <= distance).all();
  }
};

[[nodiscard]] Bounds bounds_of(const mesh::Mesh& mesh, const mesh::Set& set);

/// A set of facets that may touch something.
struct Touchable {
  const mesh::Set* set = nullptr;
  std::vector<Index> parts;  ///< bodies it is a surface of; none: a rigid surface of its own
  Bounds bounds;
  double facet = 0;  ///< size of its largest facet
  Vec3 normal =
      Vec3::Zero();  ///< outward, where it is all but flat and has cells behind it; else 0
  [[nodiscard]] bool rigid() const { return parts.empty(); }
};

struct MeshSurvey {
  int dimension = 2;                       ///< of the model: 3 where there are volume cells
  std::vector<const mesh::Set*> sections;  ///< disjoint sets of bulk cells
  std::size_t left_out = 0;                ///< bulk cells of sets that are in no section
  /// Bodies: of each node of the mesh the number of the part of the sections' cells that hang
  /// together, -1 for none.
  std::vector<Index> part_of_node;
  Index parts = 0;
  std::vector<Touchable> touchables;
  Bounds bounds;
  /// The part that all nodes of a set are of; -1: none, or several.
  [[nodiscard]] Index part_of(const mesh::Set& set) const;
};

/// Sections are as few sets as cover the cells of the highest dimension without having one twice;
/// of sets that are made of others, these are taken (a set of everything beside one a body).
///
/// Tested by  tests/unit/api/test_init.cpp
[[nodiscard]] MeshSurvey survey(const mesh::Mesh& mesh);

}  // namespace osculate::api
