#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "osculate/io/inp/numbering.hpp"

namespace osculate::io::inp {

/// What a set holds.
enum class Kind : std::uint8_t { nodes, elements };

/// Follows numbers and names of sets to nodes and elements of the mesh, each set once.
///
/// Errors     core::InputError: sets and numbers that do not exist, sets that contain themselves
/// Tested by  tests/unit/io/test_inp.cpp, test_inp_parts.cpp, test_inp_broken.cpp
class Members {
 public:
  Members(const Deck& deck, const RawMesh& raw, const Numbering& numbering, const mesh::Mesh& mesh)
      : deck_(deck), raw_(raw), numbering_(numbering), mesh_(mesh), known_(raw.scopes.size()) {}

  /// Of the set of that name in a scope: indices of nodes, or places in Numbering::elements;
  /// sorted, each once.
  [[nodiscard]] const std::vector<Index>& of(Kind kind, std::uint32_t scope,
                                             const std::string& name, Place asked);
  /// Of a set that is described here and has no name.
  [[nodiscard]] std::vector<Index> of(Kind kind, std::uint32_t scope, const RawSet& set);
  /// Masses and others of a set of elements that are no cells, by number; `of` passes over them.
  [[nodiscard]] std::set<std::int32_t> discrete(std::uint32_t scope, const RawSet& set) const;
  /// Numbers of nodes that sets list and that do not exist, with the line of the last one's set;
  /// they are left out, as in CalculiX.
  [[nodiscard]] const std::map<std::int64_t, std::uint32_t>& missing() const { return missing_; }
  /// The element of that number.
  [[nodiscard]] Index element(std::uint32_t scope, std::int32_t number, Place asked) const;

 private:
  struct Known {
    bool done = false;
    std::vector<Index> members;
  };

  void add_range(Kind kind, std::uint32_t scope, const Range& range, std::vector<Index>& members);
  [[nodiscard]] bool is_discrete(std::uint32_t scope, const std::string& set) const;
  void add_nodes_of(Index element, std::vector<Index>& members) const;
  [[noreturn]] void fail_unknown(Kind kind, std::uint32_t scope, const std::string& name,
                                 Place asked) const;

  const Deck& deck_;
  const RawMesh& raw_;
  const Numbering& numbering_;
  const mesh::Mesh& mesh_;
  std::vector<std::array<Named<Known>, 2>> known_;  ///< by scope and kind
  std::map<std::int64_t, std::uint32_t> missing_;
  std::size_t depth_ = 0;
};

}  // namespace osculate::io::inp
