#pragma once
// Shared by the build_*.cpp files; not for users.
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include "osculate/deck/build.hpp"
#include "osculate/deck/reduce_equations.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/surface.hpp"
#include "osculate/model/enclosed_volume.hpp"
#include "osculate/model/layers_behind.hpp"

namespace osculate::deck {

/// Boundary facets: edges of area cells in the plane, faces of volume cells in space.
template <int Dim>
using SideTable = std::conditional_t<Dim == 2, mesh::EdgeTable, mesh::FaceTable>;
using model::Side;

/// Throws core::InputError at `mark` for a node off the plane z = 0.
void require_in_plane(const mesh::Mesh& mesh, const core::SourceMark& mark);

/// Steps from one on, up to another one that is not among them.
struct StepRange {
  std::size_t first = 0, end = std::numeric_limits<std::size_t>::max();
};
/// Where something depends on time (`timed`), every step in which it acts says how long it takes.
void check_durations(const Description& description, const std::optional<core::SourceMark>& timed,
                     std::string_view what, const StepRange& acts = {});
/// The same for a material that depends on time, but for steps in which it responds at once.
void check_durations(const Description& description, const Material& material);

/// Axes of a node's displacement components, by columns, and the node that carries them as
/// unknowns; -1: none does.
template <int Dim>
struct NodeAxes {
  Mat<Dim, Dim> axes;
  Index local = -1;
};

/// What the parts of `build` share while a model grows.
template <int Dim>
struct BuildContext {
  const Description& description;
  BasicBuilt<Dim>& built;
  std::vector<std::string> set_names;
  std::unordered_map<std::string, Index> rigid_index;
  std::vector<Index> section_of_node;  ///< first section that uses the node, -1 = none
  std::map<std::pair<Index, Index>, Index> section_of_cell;  ///< by block and cell
  SideTable<Dim> sides;                                      ///< of the cells that have a section
  std::optional<model::CellsOfNodes<Dim>> cells_of_node{};   ///< of sections; made when needed
  std::vector<bool> related{};  ///< displacements that relations of the mesh name; empty: none
  std::unordered_map<Index, NodeAxes<Dim>> axes{};  ///< of nodes that `axes` names
  std::set<Index> control_nodes{};                  ///< of no cell: unknowns that equations name
  std::vector<std::size_t> relations_from{};  ///< by relation of the mesh: the step it begins with
  std::set<std::size_t> relation_changes{};   ///< steps but the first with which some begin
  std::vector<MarkedEquation> tied{};         ///< of `ties`
  /// By step: cells, by block and number, that are not there, and nodes that only those have.
  std::vector<std::set<std::pair<Index, Index>>> removed_cells{};
  std::vector<std::set<Index>> bare_nodes{};

  [[nodiscard]] model::BasicModel<Dim>& model() const { return built.model; }
  /// The set, or the error with the nearest name.
  [[nodiscard]] const mesh::Set& set(const Name& on) const;
  /// A node that moves with the solution: of a section or of a rigid body.
  [[nodiscard]] bool takes_part(Index node) const;
  /// So does a displacement that a relation of the mesh names.
  [[nodiscard]] bool takes_part(Index node, int direction) const;
  /// The error for a set with nodes that do not take part.
  [[nodiscard]] core::InputError idle_node(const Name& on, Index node) const;
};

/// Place of a component among the motions of a node or a rigid body.
template <int Dim>
[[nodiscard]] constexpr int motion_of(Component component) {
  if constexpr (Dim == 2) return component == Component::rz ? 2 : static_cast<int>(component);
  return static_cast<int>(component);
}

/// Directed facets of the surface that a set names (in the plane lines, free edges of areas or of
/// nodes; in space areas, free faces of volumes or of nodes).
template <int Dim>
[[nodiscard]] std::vector<Side<Dim>> oriented_facets(const BuildContext<Dim>& context,
                                                     const Name& on);
/// What a word for a formulation says; `automatic` says nothing, and is as `full`.
[[nodiscard]] solid::Formulation formulation_named(Formulation word);
/// The element formulation of a section with its material.
template <int Dim>
[[nodiscard]] solid::Section<Dim> make_solid_section(const Section& section,
                                                     const Material& material);

/// In the plane nothing may shear across it: neither strain of the plane makes such a stress, nor
/// the other way. `named`: the material, where it is told.
void check_plane(const BuildContext<2>& context, const Section& description,
                 const solid::Section<2>& section, const Name& named, const mesh::CellRef& cell);

template <int Dim>
void build_sections(BuildContext<Dim>& context);
template <int Dim>
void build_rigid(BuildContext<Dim>& context);
template <int Dim>
void build_contact(BuildContext<Dim>& context);
/// Masses and moments of inertia of rigid bodies.
template <int Dim>
void build_masses(BuildContext<Dim>& context);
/// Inertia, gravity of one step; `gravity` is that at the end of the steps before, and then of it.
template <int Dim>
void build_dynamics(const BuildContext<Dim>& context, const Step& step,
                    std::vector<double>& gravity, model::Step& out);
/// The damping of vibrations that move.
void build_modal(const ModalDescription& description, model::ModalDamping& out);
/// A harmonic step without its loads; `about_start`: its vibrations are about the start.
template <int Dim>
void begin_harmonic(const BuildContext<Dim>& context, const Step& step,
                    const std::vector<double>& temperatures, bool about_start, model::Step& out);
/// What a step that looks for buckling loads needs; `temperatures` are those before it.
///
/// Tested by  tests/unit/deck/test_buckling.cpp
template <int Dim>
void build_buckling(const BuildContext<Dim>& context, const Step& step,
                    std::vector<double>& temperatures, model::Step& out);
/// Its loads, once they are built, are what is added to those that stand (of the start: to none).
void add_to_standing(const Step& step, model::Step& out);
template <int Dim>
void build_initial_velocity(BuildContext<Dim>& context);
template <int Dim>
void build_initial_temperature(BuildContext<Dim>& context);
/// Temperatures of one step; `now` are those at the end of the steps before, and then of it.
template <int Dim>
void build_temperatures(const BuildContext<Dim>& context, const Step& step,
                        std::vector<double>& now, model::Step& out);
/// Of steps without inertia that follow others with it.
template <int Dim>
void warn_of_rest(BuildContext<Dim>& context);
template <int Dim>
void build_equations(BuildContext<Dim>& context);
/// Conditions of nodes that have multipliers, and couplings.
template <int Dim>
void build_node_constraints(BuildContext<Dim>& context);
/// Springs, dampers and masses at nodes.
///
/// Tested by  tests/unit/deck/test_springs.cpp
template <int Dim>
void build_springs(BuildContext<Dim>& context);
/// Stresses and strains before the first step, as strains of the points of cells.
///
/// Formula    E_0 = D^-1 S_0 - E_free , D of the undeformed material in its axes
/// Tested by  tests/unit/deck/test_initial_state.cpp
template <int Dim>
void build_initial_state(BuildContext<Dim>& context);
/// What changes of bodies and equations from step to step; before the steps, whose loads need it.
///
/// Tested by  tests/unit/deck/test_body_changes.cpp
template <int Dim>
void build_body_changes(BuildContext<Dim>& context);
/// The equations of the model with those that the steps up to this one have brought, without those
/// that they have freed; nothing where none begins or ends with the step itself.
template <int Dim>
[[nodiscard]] std::optional<std::vector<model::Equation>> equations_from(BuildContext<Dim>& context,
                                                                         std::size_t step);
template <int Dim>
void build_steps(BuildContext<Dim>& context);
/// What changes of pairs from step to step.
///
/// Tested by  tests/unit/deck/test_pair_changes.cpp
template <int Dim>
void build_pair_changes(BuildContext<Dim>& context);
/// Fails where a pair acts in a step that lacks cells behind its facets, or all of a slave node.
///
/// Tested by  tests/unit/deck/test_pair_changes.cpp
template <int Dim>
void check_removed(const BuildContext<Dim>& context);
template <int Dim>
void build_history(BuildContext<Dim>& context);
/// What the files of CalculiX need of the model: facets that forces go through, and the nodes that
/// stand for rigid bodies.
///
/// Tested by  tests/unit/api/test_answers.cpp
template <int Dim>
void build_answers(BuildContext<Dim>& context);
/// Whole-model checks: unconnected bodies, contradictory prescriptions, nothing to solve.
template <int Dim>
void check_model(BuildContext<Dim>& context);

/// Fails where two points give no axes.
void require_axes(const material::Orientation& axes, const core::SourceMark& mark);

}  // namespace osculate::deck
