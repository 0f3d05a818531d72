// Shells and beams of a deck: knots as rigid bodies, and what supports and loads of nodes act on.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/inp_parts.hpp"
#include "osculate/mesh/boundary.hpp"

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
  if (m.mesh.mesh.blocks.empty()) return 3;  // springs alone
  for (const mesh::Block& block : m.mesh.mesh.blocks)
    if (cell::info(block.type).dimension == 3 && block.size() > 0) return 3;
  return 2;
}

bool has_layers_of_plane(const InpModel& m) {
  return std::ranges::any_of(m.mesh.mesh.expanded, &mesh::Expanded::follows);
}

void refuse_layers_of_plane(const InpModel& m, io::inp::Place at, const std::string& set,
                            PlaneNodes which, std::string_view what) {
  std::set<Index> plane;
  for (const mesh::Expanded& one : m.mesh.mesh.expanded)
    if (one.follows)
      plane.insert({which == PlaneNodes::of_deck ? one.of : one.node,
                    which == PlaneNodes::of_solids ? one.node : one.of});
  const std::vector<Index>& nodes = m.mesh.mesh.find_set(set)->nodes;
  if (std::ranges::any_of(nodes, [&](Index node) { return plane.contains(node); }))
    io::inp::fail(
        m.deck, at,
        fmt::format("'{}' is on plane elements, which become solids beside others: {}", set, what));
}

int highest_direction(const InpModel& m, const std::string& set) {
  const auto body = m.body_nodes.find(only_node(m, set));
  if (body == m.body_nodes.end()) {
    const auto turns = [&](Index node) {
      const auto one = m.body_nodes.find(node);
      return one != m.body_nodes.end() && one->second.rigid;
    };
    const bool turning =
        !m.mesh.mesh.relations.empty() || !m.mesh.knots.empty() ||
        (!m.body_nodes.empty() && std::ranges::any_of(m.mesh.mesh.find_set(set)->nodes, turns));
    return turning ? 6 : 3;
  }
  if (!body->second.rigid) return 1;
  return 7 - body->second.first;
}

void put_knots(InpModel& m, SourceNode& bodies) {
  for (const DeckKnot& knot : m.mesh.knots) {
    const std::string name = knot_name(m, knot);
    if (!m.body_nodes.try_emplace(knot.node, InpBodyNode{name}).second)
      throw core::InputError(
          {m.deck.files[0], 0, ""},
          fmt::format("{} stands for a rigid body and is one of shells or beams, too",
                      mesh::describe_node(m.mesh.mesh, knot.node)));
    SourceNode& body = put(bodies, name, inp_map(1));
    put(body, "set", inp_text(knot.set, 1));
    if (!m.finite) put(body, "kinematics", inp_text("small", 1));
    put(body, "reference", inp_point(m.mesh.mesh.nodes[static_cast<std::size_t>(knot.node)], 3, 1));
  }
}

std::vector<InpPlace> inp_places(const InpModel& m, const std::string& set, int direction) {
  const std::vector<Index>& nodes = m.mesh.mesh.find_set(set)->nodes;
  std::vector<InpPlace> places;
  bool in_bodies = false;
  for (const Index node : nodes) {
    const auto body = m.body_nodes.find(node);
    if (body == m.body_nodes.end()) continue;
    in_bodies = true;
    int motion = direction + body->second.first - 1;
    if (motion > 6) continue;  // of a node for rotations, which has three directions
    if (inp_dimension(m) == 2 && motion == 3) motion = 4;  // a displacement that is none in a plane
    places.push_back({body->second.body, motion, body->second.sign});
  }
  if (direction > 3) {
    if (const std::string* const turns = find_nodes(m, io::inp::set_of_rotations(set)))
      places.push_back({*turns, direction - 3});
  } else if (!in_bodies) {
    return {{set, direction}};
  } else if (const std::string* const others = find_nodes(m, io::inp::set_without_knots(set))) {
    places.push_back({*others, direction});
  }
  for (const Index node : nodes)
    if (!places.empty() && m.transformed.contains(node))
      throw core::InputError(
          {m.deck.files[0], 0, ""},
          fmt::format("{} has a *TRANSFORM: not supported for nodes of rigid bodies and for "
                      "rotations of shells and beams",
                      mesh::describe_node(m.mesh.mesh, node)));
  return places;
}

}  // namespace osculate::deck
