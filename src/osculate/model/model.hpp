#pragma once
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "osculate/geometry/surface_catalogue.hpp"
#include "osculate/mesh/mesh.hpp"
#include "osculate/model/dof_space.hpp"
#include "osculate/model/loads.hpp"
#include "osculate/model/node_constraint.hpp"
#include "osculate/model/spring.hpp"
#include "osculate/pairing/pair.hpp"
#include "osculate/solid/element.hpp"

namespace osculate::model {

/// Cells of one section: element formulation, material, thickness.
template <int Dim>
struct BasicBulkSection {
  std::string name;  ///< set it was given on
  solid::Section<Dim> section;
  std::vector<mesh::CellRef> cells;
  std::string material{};   ///< its name
  bool by_default = false;  ///< nobody asked for the formulation
  /// By cell: strains of its points in the undeformed body, six numbers a point; none of a cell, or
  /// of all, where it has none.
  std::vector<std::vector<double>> initial{};
  std::vector<char> removed{};  ///< by cell: it is not there now; empty: all are
  std::vector<char> returns{};  ///< by cell: it may come back without strain; empty: none does
};

/// Whether a cell of a section is not there now.
template <int Dim>
[[nodiscard]] bool is_removed(const BasicBulkSection<Dim>& section, std::size_t cell) {
  return !section.removed.empty() && section.removed[cell] != 0;
}

/// What becomes of bodies and equations when a step begins, and until they change again.
template <int Dim>
struct BasicBodyChange {
  struct Material {
    std::size_t section = 0;
    solid::Section<Dim> now;
    std::string name{};
  };
  struct Cells {
    std::size_t section = 0;
    std::vector<std::size_t> cells;  ///< of the section
  };
  std::size_t step = 0;
  std::vector<Material> materials{};
  std::vector<Cells> removed{};
  std::vector<Cells> renewed{};   ///< back, free of strain where they are
  std::vector<Cells> restored{};  ///< back, with the strain that they would have had
  std::optional<std::vector<Equation>> equations{};  ///< all that hold from now on
};

/// Analytic shape of a rigid body.
template <int Dim>
using RigidShape = std::conditional_t<Dim == 2, geometry::Curve, geometry::Surface>;

/// A rigid body: its reference point and the nodes that follow it.
template <int Dim>
struct BasicRigidBody {
  std::string name;
  Vec<Dim> reference = Vec<Dim>::Zero();
  std::vector<Index> nodes;              ///< mesh nodes and frame nodes
  std::optional<RigidShape<Dim>> shape;  ///< analytic shape in reference coordinates
  std::vector<RigidShape<Dim>> parts;    ///< curves of a composite, each begins where one ends
  bool closed = false;                   ///< the first part begins where the last one ends
  std::vector<Vec<Dim>> polyline;        ///< for pictures of analytic polylines
  bool small = false;                    ///< rotation: of nodes whose displacements are small
  double mass = 0;                       ///< its centre is the reference point; 0: none
  /// About the reference point, in reference coordinates.
  Mat<body::rotations<Dim>, body::rotations<Dim>> inertia =
      Mat<body::rotations<Dim>, body::rotations<Dim>>::Zero();
};

/// A penetration above this share of the cells' height is one to be told of.
inline constexpr double penetration_target = 0.01;

template <int Dim>
struct BasicContactPair {
  std::string name;
  std::string group{};  ///< name of the `all`, or of the first pass; empty: the user's own pair
  std::string note{};   ///< who is master, and why
  double height = 0;    ///< of the thinner cells behind it; 0: unknown
  std::vector<double> heights{};  ///< of the thinnest cell behind each slave point; empty: `height`
  bool automatic = false;         ///< the penalty is from the stiffness of the bodies
  bool reversed = false;  ///< second pass: forces on the pair's slave are those on its master
  pairing::PairDefinition<Dim> definition;
};

/// What becomes of a pair when a step begins, until it changes again: its laws, and whether its
/// sides see each other.
template <int Dim>
struct BasicPairChange {
  std::size_t step = 0, pair = 0;
  bool active = true;
  contact::NormalLaw normal;
  std::optional<contact::FrictionLaw> friction;
  pairing::Separation<Dim> separation{};
  std::optional<contact::DampingLaw> damping{};
};

/// A node of the dependent face of a sector of a ring.
///
/// Formula    row by row  here + there = 0 , where all sectors move alike
struct CyclicJoint {
  std::vector<Equation> here;   ///< terms of the node
  std::vector<Equation> there;  ///< of the other face, turned
  bool back = false;            ///< the other face leads to the next sector the other way round
};
/// A sector of a ring: how its faces belong together, and the equations of the model without that.
struct RingSector {
  int sectors = 1;
  std::vector<CyclicJoint> joints{};
  std::vector<Equation> others{};
};

/// A mass at a node.
struct PointMass {
  Index node;
  double mass;
};

/// A whole analysis, ready to assemble; built by `deck`, or by hand. Plain data, const during the
/// analysis. Nodes: the mesh's, then the frame nodes of analytic rigid bodies.
template <int Dim>
struct BasicModel {
  std::string title;
  mesh::Mesh mesh;
  std::vector<Vec<Dim>> reference;  ///< all nodes
  std::vector<BasicBulkSection<Dim>> sections;
  std::vector<BasicRigidBody<Dim>> rigid;
  std::vector<Index> body_of_node;  ///< rigid body of each node, -1 = deformable
  std::vector<BasicContactPair<Dim>> pairs;
  std::vector<BasicPairChange<Dim>> pair_changes{};  ///< in the order of the steps
  std::vector<BasicBodyChange<Dim>> body_changes{};  ///< likewise, one a step at most
  std::vector<Equation> equations;
  std::optional<RingSector> sector{};  ///< of a ring, where its vibrations are looked for
  std::vector<NodeConstraint> node_constraints{};
  std::vector<Spring> springs{};
  std::vector<PointMass> masses{};
  std::vector<Step> steps;
  std::vector<std::pair<Dof, double>> initial_velocity;  ///< of primary dofs; zero elsewhere
  std::vector<double> initial_temperature;               ///< of all nodes; empty: none is known
};

using BulkSection = BasicBulkSection<2>;
using BulkSection3 = BasicBulkSection<3>;
using RigidBody = BasicRigidBody<2>;
using RigidBody3 = BasicRigidBody<3>;
using ContactPair = BasicContactPair<2>;
using ContactPair3 = BasicContactPair<3>;
using Model = BasicModel<2>;
using Model3 = BasicModel<3>;

}  // namespace osculate::model
