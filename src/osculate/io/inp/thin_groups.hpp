#pragma once
#include <map>
#include <vector>

#include "osculate/io/inp/thin_sections.hpp"

namespace osculate::io::inp {

/// Elements that continue each other at a node: one normal (of beams the second axis of the
/// section), one tangent (of beams), one thickness.
struct ThinGroup {
  std::vector<std::pair<Index, int>> members;  ///< elements, and which of their nodes it is
  Vec3 normal = Vec3::Zero(), tangent = Vec3::Zero();
  std::array<double, 2> thickness{};
  const ThinSection* section = nullptr;
  bool has_middle = false;  ///< second-order cells have a corner here
};

/// The groups at each node, of the elements that `cards` gives a section. A normal that the deck
/// gives begins a group with those within 0.5 degrees, then the lowest element left with those
/// within 20 degrees: their mean is the normal. A group has one thickness, offset and shape; of
/// trusses each is alone.
///
/// Source     CalculiX CrunchiX User's Manual, "Eight-node shell element", "Three-node beam
/// element" Errors     core::InputError: elements without a normal or thickness Tested by
/// tests/unit/io/test_inp_expand.cpp
[[nodiscard]] std::map<Index, std::vector<ThinGroup>> thin_groups(const Deck& deck,
                                                                  const ThinCards& cards,
                                                                  const Numbering& numbering,
                                                                  const mesh::Mesh& mesh);

}  // namespace osculate::io::inp
