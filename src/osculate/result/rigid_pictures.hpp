#pragma once
// Shared by the sources of this layer; not for users.
#include <array>
#include <vector>

#include "osculate/mesh/surface.hpp"
#include "osculate/model/system.hpp"

namespace osculate::result {

/// What is drawn of the rigid bodies of a plane model, in reference coordinates: curves in pieces,
/// meshed ones and sets of nodes by their facets (lines, free edges, contact facets), of a line
/// without ends what is beside the nodes, wherever they have moved.
///
/// Tested by  tests/unit/result/test_report_view.cpp
class RigidLines {
 public:
  explicit RigidLines(const model::Model& model);
  using Polyline = std::vector<Vec2>;
  /// As many polylines in every state.
  [[nodiscard]] std::vector<Polyline> of(const model::State& state, std::size_t body) const;

 private:
  const model::Model& model_;
  std::vector<std::vector<std::vector<Index>>> chains_;  ///< by body; nodes
};

/// The same in space: facets of meshed bodies and sets of nodes, quadrilaterals of analytic ones.
///
/// Tested by  tests/unit/result/test_report_view.cpp
class RigidFaces {
 public:
  explicit RigidFaces(const model::Model3& model);
  using Quad = std::array<Vec3, 4>;
  [[nodiscard]] const std::vector<mesh::SurfaceFacet>& facets(std::size_t body) const {
    return facets_[body];
  }
  /// All of the surface; of an endless one what is near the undeformed model.
  [[nodiscard]] std::vector<Quad> quads(std::size_t body) const;
  [[nodiscard]] bool endless(std::size_t body) const;

 private:
  const model::Model3& model_;
  std::vector<std::vector<mesh::SurfaceFacet>> facets_;
};

}  // namespace osculate::result
