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

/// Whether a set is that of a section, whose elements are written as one.
[[nodiscard]] inline bool is_section(const Description& d, const Name& on) {
  for (const Section& section : d.sections)
    if (section.on.value == on.value) return true;
  return false;
}
/// A number as short as it is exact.
[[nodiscard]] std::string exact(double value);

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
  const std::string& surface(const Name& on);
  [[nodiscard]] const mesh::Set& set(const Name& on) const;
  [[nodiscard]] std::int64_t node(Index node) const;
  /// Name of the elements of a section.
  [[nodiscard]] std::string elements(std::size_t section) const;
  [[nodiscard]] bool is_curved(const Name& surface) const;

 private:
  void require_plain(const Name& on, std::set<std::string>& known);
  [[nodiscard]] std::vector<Side<Dim>> facets(const Name& on) const;
  [[nodiscard]] std::string type_of(const model::BasicBulkSection<Dim>& section,
                                    cell::CellType type) const;
  [[nodiscard]] std::string side_of(const Side<Dim>& facet, const Name& on) const;

  const Description& d_;
  const model::BasicModel<Dim>& m_;
  SideTable<Dim> table_;
  std::map<std::pair<Index, Index>, std::int64_t> number_;  ///< of a cell, by block and place
  std::vector<bool> used_;                                  ///< nodes of sections
  bool own_numbers_ = true;                                 ///< nodes have those of the mesh
  std::set<std::string> node_sets_, surfaces_;              ///< in capitals
  std::string sets_;
};

/// Adds materials, sections, equations, contact and what there is at first.
template <int Dim>
void write_model(const Description& d, const model::BasicModel<Dim>& m, InpMesh<Dim>& mesh,
                 Leaves& leaves, std::string& out);
/// The amplitudes, then the steps.
template <int Dim>
void write_steps(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, bool finite,
                 std::string& out);

}  // namespace osculate::deck
