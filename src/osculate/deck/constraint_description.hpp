#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "osculate/core/types.hpp"
#include "osculate/deck/body_description.hpp"
#include "osculate/material/orientation.hpp"

// What ties displacements to each other, springs and masses of a model file; a part of Description.
namespace osculate::deck {

enum class Component { ux, uy, uz, rx, ry, rz };
inline constexpr std::size_t component_count = 6;
inline constexpr std::array<const char*, component_count> component_names{"ux", "uy", "uz",
                                                                          "rx", "ry", "rz"};
/// True for the motions that only rigid bodies have.
[[nodiscard]] constexpr bool is_rotation(Component c) { return c >= Component::rx; }
/// True for the motions of a model in the plane.
[[nodiscard]] constexpr bool is_planar(Component c) {
  return c == Component::ux || c == Component::uy || c == Component::rz;
}

/// Axes of the displacement components of a set's nodes: of a cylinder through two points of its
/// axis, or rectangular ones by the first axis and a direction in the plane of the first two.
struct LocalAxes {
  core::SourceMark mark;
  Name on;
  material::Orientation along;
};

struct EquationTerm {
  Name on;
  Component of = Component::ux;
  Number factor;
};
/// sum factor * u = value, term by term over the nodes of the sets; or for each node of the first
/// set one such equation, with the nodes of the same place in the others.
struct Equation {
  core::SourceMark mark;
  std::vector<EquationTerm> terms;
  Number value;
  bool for_each_node = false;
};
/// All nodes of the set share one displacement.
struct Equal {
  core::SourceMark mark;
  Name on;
  Component of = Component::ux;
};

/// The nodes of a set stay in one plane, on one line, or (two of them) at their distance.
struct NodeCondition {
  core::SourceMark mark;
  Name on;
};
/// The mean motion of a set's nodes is that of a rigid body; or these displacements of each are.
struct Coupling {
  core::SourceMark mark;
  Name on, rigid;
  std::array<bool, 3> of{};
  std::optional<Marked<material::Orientation>> along{};  ///< axes of `of`; absent: x, y and z

  [[nodiscard]] bool is_mean() const { return of == std::array<bool, 3>{}; }
};
/// A force that depends on one elongation: of the line between two nodes, or of a sum of
/// displacements as in equations.
struct Spring {
  core::SourceMark mark;
  std::vector<Name> between;  ///< sets of one node; none: it has terms
  std::vector<EquationTerm> terms;
  std::optional<Number> stiffness;
  Marked<std::vector<Vec2>> table;  ///< elongation, force
  struct Gap {
    core::SourceMark mark;
    double clearance = 0, stiffness = 0, tension = 0;
  };
  std::optional<Gap> gap;
  double damping = 0;
  Kinematics kinematics = Kinematics::finite;
};
struct PointMass {
  core::SourceMark mark;
  Name on;
  Number mass;  ///< of each node
};
/// A cut through a body, at a set of facets inside of it: its name is that of a set of one node
/// whose ux is by how much the cut shortens the body.
struct Pretension {
  Name name;
  Name on;
  std::optional<Name> node;  ///< set of the one node, where the mesh has it
  std::optional<Marked<Vec3>> axis;
};
/// One of `sectors` equal parts round an axis: its dependent face moves as the independent one of
/// its neighbour.
struct CyclicSymmetry {
  core::SourceMark mark;
  Name dependent, independent;
  Marked<int> sectors;
  Vec3 from{0, 0, 0}, to{0, 0, 1};
};

/// Nodes of the slave follow the master's facets.
struct Tie {
  core::SourceMark mark;
  Name slave, master;
  std::optional<Number> tolerance;
  bool adjust = true;
};

}  // namespace osculate::deck
