#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/core/types.hpp"
#include "osculate/io/inp/cards.hpp"
#include "osculate/io/inp/element_types.hpp"

namespace osculate::io::inp {

inline constexpr std::uint32_t own_scope = 0xFFFFFFFF;

/// Numbers `first`, `first + step`, ... up to `last` of nodes or elements.
struct Range {
  std::int32_t first = 0, last = 0, step = 1;
  std::uint32_t scope = own_scope;  ///< the instance meant; own_scope: where the set stands
  Place at{};
  bool generated = false;  ///< numbers that do not exist are left out
  bool listed = false;     ///< by a card of a set: such nodes are told of and left out, too
};

/// A set that another one names.
struct SetName {
  std::string name;
  std::uint32_t scope = own_scope;
  Place at{};
  bool of_elements = false;  ///< the nodes of a set of elements
};

/// What the deck says of a set of nodes or elements; all cards of one name add up.
struct RawSet {
  std::string name;  ///< as first written
  Place at{};
  std::vector<Range> ranges;
  std::vector<SetName> names;
};

/// One line of a surface: a set of elements or a number, and a side of them.
struct SurfaceEntry {
  SetName set;
  std::int32_t number = 0;  ///< instead of a set
  std::string side;         ///< in capitals; empty: all free ones
  bool of_load = false;     ///< `side` is what a pressure is called: P1
};

/// Of what a surface that is made of surfaces has the facets.
enum class Combination { none, unite, difference, intersection };

struct RawSurface {
  std::string name;
  Place at{};
  std::vector<SurfaceEntry> entries;
  Combination combination = Combination::none;
  std::vector<SetName> parts;  ///< the surfaces that it is made of
};

/// Elements of one card.
struct RawElements {
  const ElementType* type = nullptr;
  std::string variant;                       ///< the type as the card names it, in capitals
  std::vector<std::int32_t> numbers, nodes;  ///< nodes in the deck's order, by number
  std::vector<Place> at;
};

/// By name in capitals.
template <class T>
using Named = std::map<std::string, T, std::less<>>;

/// Numbers and names of their own: a part, an instance of one, or what stands outside of them.
struct Scope {
  std::string name;  ///< of the part or instance; empty: outside
  std::vector<std::int32_t> node_numbers;
  std::vector<Vec3> nodes;
  std::vector<Place> node_at;
  std::vector<RawElements> elements;
  Named<RawSet> node_sets, element_sets, node_surfaces;
  Named<RawSurface> surfaces;                 ///< of elements
  Named<std::vector<std::int32_t>> discrete;  ///< masses and others that are no cells, by set
};

/// What the cards of a deck say of its mesh.
struct RawMesh {
  std::vector<Scope> scopes;       ///< the outside, then instances in their order
  Named<std::uint32_t> instances;  ///< their places in `scopes`
};

/// Reads the cards that make the mesh. Parts count only as far as instances place them.
///
/// Errors     core::InputError with file and line for what a mesh cannot be made of
/// Tested by  tests/unit/io/test_inp.cpp, test_inp_parts.cpp, test_inp_broken.cpp
[[nodiscard]] RawMesh collect(const Deck& deck);

}  // namespace osculate::io::inp
