#pragma once
// Shared by the build_*.cpp files; not for users.
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "osculate/deck/build.hpp"
#include "osculate/mesh/boundary.hpp"

namespace osculate::deck {

/// What the parts of `build` share while a model grows.
struct BuildContext {
  const Description& description;
  Built& built;
  std::vector<std::string> set_names;
  std::unordered_map<std::string, Index> rigid_index;
  std::vector<Index> section_of_node;  ///< first section that uses the node, -1 = none
  std::map<std::pair<Index, Index>, Index> section_of_cell;  ///< by block and cell

  [[nodiscard]] model::Model& model() const { return built.model; }
  /// The set, or the error with the nearest name.
  [[nodiscard]] const mesh::Set& set(const Name& on) const;
  /// A node that moves with the solution: of a section or of a rigid body.
  [[nodiscard]] bool takes_part(Index node) const;
  /// The error for a set with nodes that do not take part.
  [[nodiscard]] core::InputError idle_node(const Name& on, Index node) const;
  mesh::EdgeTable edges;  ///< of the cells that have a section
};

/// Directed facets of the surface that a set names (lines, free edges of areas or of nodes).
[[nodiscard]] std::vector<mesh::BoundaryFacet> oriented_facets(const BuildContext& context,
                                                               const Name& on);
/// The element formulation of a section with its material.
[[nodiscard]] solid::Section make_solid_section(const Section& section, const Material& material);

void build_sections(BuildContext& context);
void build_rigid(BuildContext& context);
void build_contact(BuildContext& context);
void build_equations(BuildContext& context);
void build_steps(BuildContext& context);
void build_history(BuildContext& context);
/// Whole-model checks: unconnected bodies, contradictory prescriptions, nothing to solve.
void check_model(BuildContext& context);

}  // namespace osculate::deck
