#pragma once
// The mesh of a deck as its own cards have it; for to_inp*.cpp.
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/deck/description.hpp"
#include "osculate/io/inp/deck_mesh.hpp"
#include "osculate/io/inp/scope.hpp"

namespace osculate::deck {

/// Shells, beams, trusses and plane elements beside solids, that became solids when the deck was
/// read which is the mesh of a model file: what of its cards makes them is written as it was.
///
/// Errors     core::InputError: the mesh is not one deck as it is, or has instances
/// Tested by  tests/unit/deck/test_to_inp_decks.cpp, tests/system/test_decks.py
class GivenMesh {
 public:
  explicit GivenMesh(const Description& description);
  GivenMesh(const GivenMesh&) = delete;
  GivenMesh& operator=(const GivenMesh&) = delete;

  /// Nodes, elements, their sets and surfaces, thickness and normals of nodes.
  [[nodiscard]] std::string cards() const;
  /// The sections, whose materials and axes are those of the model file; `axes` of each section are
  /// the parameter that names them, or nothing.
  [[nodiscard]] std::string sections(const std::vector<std::string>& axes) const;

  /// What the deck calls a set of the mesh: its name, or the number of its only node; none: no card
  /// of the deck has it.
  [[nodiscard]] std::optional<std::string> name(io::inp::SetKind kind,
                                                const std::string& set) const;
  /// Names of the deck of a kind, in capitals.
  [[nodiscard]] std::set<std::string> names(io::inp::SetKind kind) const;
  /// The deck's elements of which a section has layers, or those of one type; else its own set.
  [[nodiscard]] std::string whole(const std::string& section) const;
  /// Of a set of nodes whose displacements are rotations: the set of the nodes that turn.
  [[nodiscard]] std::optional<std::string> turned(const std::string& set) const;
  /// The node of a rigid body that stands for a knot.
  [[nodiscard]] std::optional<std::int64_t> knot(const std::string& set) const;
  /// Null: the deck has no such element, since it is a further solid of one.
  [[nodiscard]] const io::inp::ElementType* element(std::int64_t number) const;
  [[nodiscard]] bool has_node(std::int64_t number) const { return nodes_.contains(number); }
  /// Axisymmetric elements are sectors, beside which a 180th of the deck's forces acts.
  [[nodiscard]] bool sectors() const { return mesh_.sectors; }

  /// The sections of a deck that was written.
  ///
  /// Errors     core::InputError: its elements become other solids, or these move otherwise, by
  ///            other supports and moments than the deck's
  [[nodiscard]] std::vector<Section> read_again(const std::string& text) const;

 private:
  void require_same(const io::inp::DeckMesh& other) const;
  [[nodiscard]] std::vector<std::size_t> sections_of(const io::inp::Card& card) const;

  const Description& d_;
  std::string text_;
  io::inp::Deck deck_;
  io::inp::DeckMesh mesh_;
  io::inp::RawMesh raw_;
  std::map<std::int64_t, const io::inp::ElementType*> elements_;
  std::set<std::int64_t> nodes_;
};

}  // namespace osculate::deck
