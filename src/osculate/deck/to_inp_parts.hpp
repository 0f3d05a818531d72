#pragma once
// The parts of the way from a model file to a deck; for to_inp*.cpp.
#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "osculate/deck/build_context.hpp"
#include "osculate/deck/to_inp.hpp"
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

/// The nodes of a rigid body that stand for its displacements and its rotations.
struct ControlNodes {
  std::int64_t reference = 0, rotation = 0;
  /// Node and direction of a motion.
  [[nodiscard]] std::pair<std::int64_t, int> of(Component motion) const {
    const int k = static_cast<int>(motion);
    return is_rotation(motion) ? std::pair{rotation, k - 2} : std::pair{reference, k + 1};
  }
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
  [[nodiscard]] std::string elements(std::size_t section) const;
  /// The same of a set of cells, which is written where it is not that of a section.
  const std::string& elements(const Name& on);
  [[nodiscard]] bool is_curved(const Name& surface) const;
  /// Of a rigid body by its name.
  [[nodiscard]] std::optional<ControlNodes> control(const std::string& rigid) const;
  /// Set of the nodes of sections that belong to a rigid body, which is written.
  const std::string& nodes_of_body(const SetShape& shape, const Rigid& rigid);
  /// Number of an element that is no cell.
  [[nodiscard]] std::int64_t new_element() { return ++last_element_; }
  /// Whether some section has finite strains (NLGEOM), or is that of rings.
  [[nodiscard]] bool finite() const;
  [[nodiscard]] bool round() const;

 private:
  /// The cards of a set of nodes.
  void write_nodes(const std::string& name, const std::vector<Index>& nodes);
  /// A name of the deck for one of the model file, always the same, and of no other set.
  const std::string& plain(const std::string& name, char kind);
  [[nodiscard]] static std::string plain_text(const std::string& name);
  [[nodiscard]] std::vector<Side<Dim>> facets(const Name& on) const;
  [[nodiscard]] std::string type_of(const model::BasicBulkSection<Dim>& section,
                                    cell::CellType type) const;
  [[nodiscard]] std::string side_of(const Side<Dim>& facet, const Name& on) const;

  const Description& d_;
  const model::BasicModel<Dim>& m_;
  SideTable<Dim> table_;
  std::map<std::pair<Index, Index>, std::int64_t> number_;     ///< of a cell, by block and place
  std::vector<bool> used_;                                     ///< nodes that are written
  bool own_numbers_ = true;                                    ///< nodes have those of the mesh
  std::map<std::pair<char, std::string>, std::string> names_;  ///< of nodes 'n', surfaces 's', 'p'
  std::set<std::pair<char, std::string>> taken_;               ///< these, in capitals
  std::map<std::string, ControlNodes> controls_;               ///< by rigid body
  std::int64_t last_element_ = 0, last_node_ = 0;  ///< numbers of the mesh, later of more
  std::string sets_;
};

// ---- the keys of a model file, as cards -------------------------------------------------------

/// With `*DAMPING` of all materials.
void write_material(const Material& material, const std::string& damping, Leaves& leaves,
                    std::string& out);
/// `*DAMPING` by the steps with inertia; empty: there is none.
[[nodiscard]] std::string damping_cards(const Description& d);
/// Adds the `*ORIENTATION` of a section; returns the parameter that names it, or nothing.
[[nodiscard]] std::string write_orientation(const Section& section, std::size_t number,
                                            Leaves& leaves, std::string& out);
template <int Dim>
void write_springs(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out);
template <int Dim>
void write_masses(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out);
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
/// Adds materials, sections, equations, contact and what there is at first.
template <int Dim>
void write_model(const Description& d, const model::BasicModel<Dim>& m, InpMesh<Dim>& mesh,
                 Leaves& leaves, std::string& out);
/// The amplitudes, then the steps.
template <int Dim>
void write_steps(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out);

}  // namespace osculate::deck
