#pragma once
// The parts of the way from a model file to a deck; for to_inp*.cpp.
#include <fmt/format.h>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "osculate/deck/build_context.hpp"
#include "osculate/deck/pretension.hpp"
#include "osculate/deck/to_inp.hpp"
#include "osculate/deck/to_inp_given.hpp"
#include "osculate/io/inp/element_types.hpp"

namespace osculate::deck {

/// The values of a model file by their keys. What is not taken has no counterpart.
class Leaves {
 public:
  explicit Leaves(const Description& description);
  /// The value of a key; empty: it is not there.
  [[nodiscard]] std::string text(const std::string& path);
  /// The same as a number.
  [[nodiscard]] std::optional<double> number(const std::string& path);
  /// All keys that begin so are said otherwise.
  void take(std::string_view beginning);
  /// Fails at the first key that was not taken.
  void require_none_left() const;
  [[noreturn]] void fail(const std::string& path, const std::string& message) const;

 private:
  struct Leaf {
    SourceLeaf leaf;
    bool taken = false;
  };
  const Description& description_;
  std::vector<Leaf> leaves_;
};

/// The section of a set, whose elements are written as one; none: it is part of one, or of several.
[[nodiscard]] inline std::optional<std::size_t> whole_section(const Description& d,
                                                              const Name& on) {
  for (std::size_t s = 0; s < d.sections.size(); ++s)
    if (d.sections[s].on.value == on.value) return s;
  return std::nullopt;
}
/// A number as short as it is exact.
[[nodiscard]] std::string exact(double value);

/// `, along the normal, along the first axis` of a temperature times a factor; empty: it has none.
[[nodiscard]] inline std::string written_gradients(const Load& load, double factor) {
  const auto at = [&](std::size_t k) {
    return load.values[k] ? factor * load.values[k]->value : 0;
  };
  if (!load.values[1] && !load.values[2]) return {};
  return fmt::format(", {}, {}", exact(at(1)), exact(at(2)));
}

/// The nodes of a rigid body that stand for its displacements and its rotations.
struct ControlNodes {
  std::int64_t reference = 0, rotation = 0;  ///< the same: of knots and couplings
  /// Node and direction of a motion.
  [[nodiscard]] std::pair<std::int64_t, int> of(Component motion) const {
    const int k = static_cast<int>(motion);
    if (reference == rotation) return {reference, k + 1};
    return is_rotation(motion) ? std::pair{rotation, k - 2} : std::pair{reference, k + 1};
  }
};

/// A node of the deck that the mesh has not, and its place.
struct NewNode {
  std::int64_t number = 0;
  Vec3 at = Vec3::Zero();
};

/// The mesh of a deck: nodes, the elements of the sections, and the sets that are asked for.
template <int Dim>
class InpMesh {
 public:
  InpMesh(const Description& description, const model::BasicModel<Dim>& model);
  /// Nodes and elements.
  [[nodiscard]] std::string cells() const;
  /// The sets that were asked for.
  [[nodiscard]] std::string sets() const { return sets_; }
  /// Name of a set of nodes or of a surface, which is written.
  const std::string& nodes(const Name& on);
  const std::string& surface(const Name& on, bool of_nodes = false);
  /// The one of these that was written before.
  [[nodiscard]] const std::string& surface_named(const Name& on) const;
  [[nodiscard]] const mesh::Set& set(const Name& on) const;
  [[nodiscard]] std::int64_t node(Index node) const;
  /// Name of the elements of a section.
  const std::string& elements(std::size_t section) { return elements(d_.sections[section].on); }
  /// The same of a set of cells, which is written where it is not that of a section.
  const std::string& elements(const Name& on);
  /// The same of all layers of a section, where it is one of them.
  std::string whole_elements(std::size_t section);
  /// Numbers of the elements of a set of cells.
  [[nodiscard]] std::vector<std::int64_t> element_numbers(const Name& on) const;
  /// The surface of the elements that an axis points to from a set of facets inside of a body.
  const std::string& surface_ahead(const Name& on, const Vec3& axis);
  /// That of a set of facets, which may lie inside: of the elements that their normals point out
  /// of.
  const std::string& surface_of_cut(const Name& on);
  /// Node of a rigid body or a section under pretension, a new one where the mesh has none.
  std::string write_control(const std::string& name);
  [[nodiscard]] bool has_nodes_of_elements(const Name& on) const;
  /// The sections that have the cells of a set.
  [[nodiscard]] std::set<std::size_t> sections_of(const Name& on) const;
  /// The mesh as its deck has it, where shells, beams or plane elements became solids; else null.
  [[nodiscard]] const GivenMesh* given() const { return given_.get(); }
  /// Fails where the deck that was written is not that of the mesh and its sections.
  void require_same(const std::string& text) const;
  [[nodiscard]] bool is_curved(const Name& surface) const;
  [[nodiscard]] bool share_facets(const Name& one, const Name& other) const;
  /// Of a set of facets, undeformed.
  [[nodiscard]] double area(const Name& surface) const;
  /// Of a rigid body by its name.
  [[nodiscard]] std::optional<ControlNodes> control(const std::string& rigid) const;
  /// The set whose nodes turn by the displacements of those of another one; none: these do not.
  [[nodiscard]] std::optional<Name> turned(const Name& on) const;
  /// Node and direction of a displacement of a rigid body, or of a set of one node.
  [[nodiscard]] std::pair<std::int64_t, int> only_node(const Name& on, Component of);
  /// Set of the nodes of sections that belong to a rigid body, which is written.
  const std::string& nodes_of_body(const SetShape& shape, const Rigid& rigid);
  /// Number of an element that is no cell.
  [[nodiscard]] std::int64_t new_element() { return ++last_element_; }
  /// Whether some section has finite strains (NLGEOM), or is that of rings.
  [[nodiscard]] bool finite() const;
  [[nodiscard]] bool round() const;

 private:
  /// The cards of a set of nodes.
  void write_nodes(const Name& on, const std::string& name, const std::vector<Index>& nodes);
  /// A name of the deck for one of the model file, always the same, and of no other set.
  const std::string& plain(const std::string& name, char kind);
  [[nodiscard]] static std::string plain_text(const std::string& name);
  void take_controls();
  void take_control(const Rigid& rigid, std::int64_t& last);
  void require_place(const Rigid& rigid, const Vec3& at) const;
  /// What the deck whose mesh this is calls it.
  [[nodiscard]] std::optional<std::string> given_name(io::inp::SetKind kind, const Name& on) const;
  [[nodiscard]] std::vector<Side<Dim>> facets(const Name& on) const;
  [[nodiscard]] std::string type_of(const model::BasicBulkSection<Dim>& section,
                                    cell::CellType type) const;
  /// The sides of elements at facets: of those that the axis points to, else as surface_of_cut.
  [[nodiscard]] std::string sides_at(const Name& on, const std::optional<Vec3>& axis) const;
  [[nodiscard]] std::string side_of(const mesh::CellRef& parent, std::span<const Index> corners,
                                    const Name& on) const;

  const Description& d_;
  const model::BasicModel<Dim>& m_;
  SideTable<Dim> table_;
  std::map<std::pair<Index, Index>, std::int64_t> number_;     ///< of a cell, by block and place
  std::vector<bool> used_;                                     ///< nodes that are written
  bool own_numbers_ = true;                                    ///< nodes have those of the mesh
  std::map<std::pair<char, std::string>, std::string> names_;  ///< of nodes 'n', surfaces 's', 'p'
  std::set<std::pair<char, std::string>> taken_;               ///< these, in capitals
  std::map<std::string, ControlNodes> controls_;               ///< by rigid body
  std::map<std::string, std::vector<NewNode>> new_nodes_;      ///< likewise
  std::map<std::pair<Index, Index>, std::size_t> section_of_;  ///< likewise, of a cell
  std::unique_ptr<GivenMesh> given_;
  std::int64_t last_element_ = 0, last_node_ = 0;  ///< numbers of the mesh, later of more
  std::string sets_;
};

// ---- the keys of a model file, as cards -------------------------------------------------------

/// With `*DAMPING` of all materials.
void write_material(const Material& material, const std::string& damping, Leaves& leaves,
                    std::string& out);
/// `*DAMPING` by the steps with inertia; empty: there is none.
[[nodiscard]] std::string damping_cards(const Description& d);
/// `*ORIENTATION` with its lines.
[[nodiscard]] std::string orientation_cards(const std::string& name,
                                            const material::Orientation& axes);
/// Adds the `*ORIENTATION` of a section; returns the parameter that names it, or nothing.
[[nodiscard]] std::string write_orientation(const Section& section, std::size_t number,
                                            Leaves& leaves, std::string& out);
template <int Dim>
void write_springs(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out);
template <int Dim>
void write_masses(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out);
/// Name of the elements of the k-th of `masses`.
[[nodiscard]] inline std::string mass_name(std::size_t k) { return fmt::format("mass_{}", k + 1); }
template <int Dim>
void write_axes(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out);
/// Nodes that stay in one plane, on one line, at their distance.
template <int Dim>
void write_node_conditions(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves,
                           std::string& out);
template <int Dim>
void write_cyclic_symmetry(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves,
                           std::string& out);
/// Bodies that are sets of nodes; other shapes have no counterpart.
template <int Dim>
void write_rigid(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out);

/// The cards of a step up to its loads.
struct ProcedureCards {
  std::string text;
  bool at_once = false;  ///< loads without an amplitude act at once there
  bool search = false;   ///< it looks for vibrations or buckling loads, and moves nothing
};
/// `moved`: a step before it has moved the bodies.
[[nodiscard]] ProcedureCards procedure_of(const Description& d, std::size_t step, bool finite,
                                          bool moved);
/// Results that the model file asks for in the files of CalculiX; empty: for none.
template <int Dim>
[[nodiscard]] std::string requests_of(const Description& d, const Step& step, InpMesh<Dim>& mesh);

template <int Dim>
void write_contact(const Description& d, const model::BasicModel<Dim>& m, InpMesh<Dim>& mesh,
                   Leaves& leaves, std::string& out);
template <int Dim>
void write_ties(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out);
/// What a step changes of contact pairs; of `all` it has no counterpart.
template <int Dim>
[[nodiscard]] std::string contact_changes(const Description& d, std::size_t step,
                                          InpMesh<Dim>& mesh, Leaves& leaves);
/// The mean motion of sets, or some displacements of each node, that are those of a body which is a
/// node alone.
template <int Dim>
void write_couplings(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out);
/// `cuts` of the mesh that has them.
template <int Dim>
void write_pretension(const Description& d, const std::vector<Cut>& cuts, InpMesh<Dim>& mesh,
                      Leaves& leaves, std::string& out);
/// Adds materials, sections, equations, contact and what there is at first. The mesh of the model
/// has no cuts.
template <int Dim>
void write_model(const Description& d, const model::BasicModel<Dim>& m,
                 const std::vector<Cut>& cuts, InpMesh<Dim>& mesh, Leaves& leaves,
                 std::string& out);
/// The amplitudes, then the steps.
template <int Dim>
void write_steps(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out);

}  // namespace osculate::deck
