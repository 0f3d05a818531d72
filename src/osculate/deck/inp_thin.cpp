// Shells and beams of a deck: knots as rigid bodies, and what supports and loads of nodes act on.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/inp_parts.hpp"

namespace osculate::deck {
namespace {

using io::inp::DeckKnot;
using io::inp::SetKind;

std::string knot_name(const InpModel& m, const DeckKnot& knot) {
  return fmt::format("knot_{}", mesh::node_number(m.mesh.mesh, knot.node));
}

const std::string* find_nodes(const InpModel& m, const std::string& set) {
  const auto found = m.sets.find({SetKind::nodes, io::inp::capitals(set)});
  return found == m.sets.end() ? nullptr : &m.mesh.mesh.sets[found->second].name;
}

}  // namespace

int inp_dimension(const InpModel& m) {
  for (const mesh::Block& block : m.mesh.mesh.blocks)
    if (cell::info(block.type).dimension == 3 && block.size() > 0) return 3;
  return 2;
}

int highest_direction(const InpModel& m) {
  return m.mesh.mesh.relations.empty() && m.mesh.knots.empty() ? inp_dimension(m) : 6;
}

SourceNode inp_knots(const InpModel& m) {
  SourceNode bodies = inp_map(1);
  for (const DeckKnot& knot : m.mesh.knots) {
    SourceNode& body = put(bodies, knot_name(m, knot), inp_map(1));
    put(body, "set", inp_text(knot.set, 1));
    SourceNode& reference = put(body, "reference", inp_list(1));
    for (const double x : m.mesh.mesh.nodes[static_cast<std::size_t>(knot.node)])
      reference.items.push_back(inp_number(x, 1));
  }
  return bodies;
}

SourceNode released_knots(const InpModel& m, const std::set<InpTarget>& prescribed, int line) {
  SourceNode list = inp_list(line);
  for (const DeckKnot& knot : m.mesh.knots) {
    SourceNode entry = inp_map(line);
    const std::string name = knot_name(m, knot);
    put(entry, "on", inp_text(name, line));
    SourceNode& of = put(entry, "of", inp_list(line));
    for (int k = 1; k <= 6; ++k)
      if (!prescribed.contains({name, k})) of.items.push_back(inp_text(component_of('u', k), line));
    if (!of.items.empty()) list.items.push_back(std::move(entry));
  }
  return list;
}

std::string component_of(char kind, int direction) {
  const char turned = kind == 'u' ? 'r' : 'm';
  return {direction > 3 ? turned : kind, "xyz"[(direction - 1) % 3]};
}

std::vector<InpTarget> targets_of(const InpModel& m, const std::string& set, int direction) {
  std::vector<InpTarget> targets;
  const std::vector<Index>& nodes = m.mesh.mesh.find_set(set)->nodes;
  bool in_knots = false;
  for (const DeckKnot& knot : m.mesh.knots)
    if (std::binary_search(nodes.begin(), nodes.end(), knot.node)) {
      targets.emplace_back(knot_name(m, knot), direction);
      in_knots = true;
    }
  if (direction > 3) {
    if (const std::string* const turns = find_nodes(m, io::inp::set_of_rotations(set)))
      targets.emplace_back(*turns, direction - 3);
    return targets;
  }
  if (!in_knots) return {{set, direction}};
  if (const std::string* const others = find_nodes(m, io::inp::set_without_knots(set)))
    targets.emplace_back(*others, direction);
  return targets;
}

}  // namespace osculate::deck
