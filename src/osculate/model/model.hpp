#pragma once
#include <optional>
#include <string>
#include <vector>

#include "osculate/mesh/mesh.hpp"
#include "osculate/model/dof_space.hpp"
#include "osculate/model/loads.hpp"
#include "osculate/pairing/pair.hpp"
#include "osculate/solid/element.hpp"

namespace osculate::model {

/// Cells of one section: element formulation, material, thickness.
struct BulkSection {
  std::string name;  ///< set it was given on
  solid::Section section;
  std::vector<mesh::CellRef> cells;
};

/// A rigid body: its reference point and the nodes that follow it.
struct RigidBody {
  std::string name;
  Vec2 reference{0, 0};
  std::vector<Index> nodes;              ///< mesh nodes and frame nodes
  std::optional<geometry::Curve> shape;  ///< analytic shape in reference coordinates
  std::vector<Vec2> polyline;            ///< for pictures of analytic polylines
};

struct ContactPair {
  std::string name;
  pairing::PairDefinition<2> definition;
};

/// A whole analysis, ready to assemble; built by `deck`, or by hand. Plain data, const during the
/// analysis. Nodes: the mesh's, then the frame nodes of analytic rigid bodies.
struct Model {
  std::string title;
  mesh::Mesh mesh;
  std::vector<Vec2> reference;  ///< all nodes
  std::vector<BulkSection> sections;
  std::vector<RigidBody> rigid;
  std::vector<Index> body_of_node;  ///< rigid body of each node, -1 = deformable
  std::vector<ContactPair> pairs;
  std::vector<Equation> equations;
  std::vector<Step> steps;
};

}  // namespace osculate::model
