// Multi-point constraints, couplings, sections under pretension, cyclic symmetry and ties of a
// deck.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/inp_parts.hpp"
#include "osculate/deck/pretension.hpp"
#include "osculate/io/inp/loaded_sets.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;
using io::inp::SetKind;

/// The list of a key, made when it is first needed.
SourceNode& list_of(SourceNode& root, const char* key, int line) {
  if (SourceNode* const found = find(root, key)) return *found;
  return put(root, key, inp_list(line));
}

const char* key_of_mpc(const InpModel& m, const Line& line, const std::string& kind) {
  if (kind == "PLANE") return "coplanar";
  if (kind == "STRAIGHT") return "collinear";
  if (kind == "BEAM") return "fixed_distance";
  if (kind == "MEANROT") return nullptr;  // in inp_meanrot.cpp
  io::inp::fail(
      m.deck, line.at,
      fmt::format("*MPC: {} is not supported: PLANE, STRAIGHT, BEAM or MEANROT", printable(kind)));
}

/// A line begins with the kind; one that begins with a node goes on with the last one.
void put_mpcs(const InpModel& m, const Card& card, SourceNode& root) {
  SourceNode* nodes = nullptr;
  bool known = false;
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    const std::string first = io::inp::capitals(io::inp::name_of(fields.next().value_or("")));
    const int at = line_of(line.at);
    if (!first.empty() && !io::inp::is_number(first)) {
      const char* const key = key_of_mpc(m, line, first);
      known = true;
      nodes = nullptr;
      if (!key) continue;
      SourceNode& entry = list_of(root, key, at).items.emplace_back(inp_map(at));
      nodes = &put(entry, "on", inp_list(at));
    } else if (!known) {
      fields.fail("expected PLANE, STRAIGHT, BEAM or MEANROT");
    } else if (!nodes) {
      continue;
    } else if (first != "0" && !first.empty()) {
      nodes->items.push_back(inp_text(node_set_of(m, line, first), at));
    }
    while (!fields.done())
      if (const auto field = fields.next(); field && !field->empty())
        nodes->items.push_back(inp_text(node_set_of(m, line, *field), at));
  }
}

/// The mean motion of the nodes of a surface is that of the reference node.
void put_coupling(const InpModel& m, const Card& card, SourceNode& root) {
  if (kind_of_coupling(m, card).keyword != "DISTRIBUTING") return;
  const int line = line_of(card.at);
  SourceNode& entry = list_of(root, "coupling", line).items.emplace_back(inp_map(line));
  put(entry, "on",
      inp_text(set_of(m, card.at, value_of(m, card, "SURFACE"),
                      {SetKind::surface, SetKind::node_surface}),
               line));
  put(entry, "rigid", inp_text(reference_body(m, card), line));
}

void put_pretension(InpModel& m, const Card& card, SourceNode& root) {
  const int line = line_of(card.at);
  const std::string node = node_parameter(m, card, "NODE");
  if (node.empty()) io::inp::fail(m.deck, card, "expected 'NODE=' with a number");
  const std::string name = plain_name(fmt::format("pretension of {}", node));
  if (!find(root, "pretension")) put(root, "pretension", inp_map(line));
  SourceNode& entry = put(*find(root, "pretension"), name, inp_map(line));
  put(entry, "on",
      inp_text(set_of(m, card.at, value_of(m, card, "SURFACE"), {SetKind::surface}), line));
  put(entry, "node", inp_text(node, line));
  const std::string surface = find(entry, "on")->text;
  Vec3 axis = Vec3::Zero();
  if (const auto lines = io::inp::lines_of(m.deck, card); !lines.empty()) {
    Fields fields(m.deck, lines[0]);
    axis = point_of(fields);
  }
  // CalculiX measures how far the surface's elements move along the normal: out of them they close.
  const Vec3 outwards = mean_normal(m.mesh.mesh, *m.mesh.mesh.find_set(surface));
  const bool inwards = axis.dot(outwards) < 0;
  // The side that the axis points to has nodes of its own: that of the elements, as in CalculiX.
  // Both sides meet along it whichever way it points.
  if (!(axis.norm() > 0)) axis = outwards;
  put(entry, "axis", inp_point(inwards ? axis : Vec3(Vec3::Zero() - axis), inp_dimension(m), line));
  m.body_nodes[only_node(m, node)] = {name, 1, false, inwards ? -1.0 : 1.0};
}

/// The tie of a cyclic symmetry: the one that is named, or the only one.
const Card& cyclic_tie(const InpModel& m, const Card& card) {
  const std::string name = option_of(card, "TIE");
  const Card* found = nullptr;
  for (const Card& tie : m.deck.cards) {
    if (tie.keyword != "TIE" || !is_cyclic_tie(tie)) continue;
    if (!name.empty() && option_of(tie, "NAME") != name) continue;
    if (found) io::inp::fail(m.deck, card, "expected 'TIE=': there are several");
    found = &tie;
  }
  if (!found) io::inp::fail(m.deck, card, "there is no such *TIE with CYCLIC SYMMETRY");
  return *found;
}

void put_cyclic_symmetry(const InpModel& m, const Card& card, SourceNode& root) {
  const int line = line_of(card.at);
  const Card& tie = cyclic_tie(m, card);
  const Line& sides = only_line(m, tie, "two surfaces");
  Fields surfaces(m.deck, sides);
  SourceNode& entry = list_of(root, "cyclic_symmetry", line).items.emplace_back(inp_map(line));
  for (const char* const key : {"dependent", "independent"})
    put(entry, key,
        inp_text(set_of(m, sides.at, io::inp::name_of(surfaces.next().value_or("")),
                        {SetKind::surface, SetKind::node_surface}),
                 line));
  const std::string& count = value_of(m, card, "N");
  put(entry, "sectors",
      inp_number(io::inp::number_of(m.deck, card.at, count, "the number of sectors"), line));
  Fields fields(m.deck, only_line(m, card, "two points of the axis"));
  const Vec3 from = point_of(fields), to = point_of(fields);
  put(entry, "from", inp_point(from, inp_dimension(m), line));
  put(entry, "to", inp_point(to, inp_dimension(m), line));
}

void put_ties(const InpModel& m, const Card& card, SourceNode& root) {
  constexpr double no_tolerance = 1e-10;  // smaller ones are none there
  for (const char* const other : {"MULTISTAGE", "FLUIDPERIODIC", "FLUIDCYCLIC"})
    if (io::inp::find_parameter(card, other))
      io::inp::fail(m.deck, card, fmt::format("{} is not supported", other));
  const std::string adjust = option_of(card, "ADJUST");
  if (!adjust.empty() && adjust != "YES" && adjust != "NO")
    io::inp::fail(m.deck, card,
                  fmt::format("expected ADJUST=YES or NO, found {}", printable(adjust)));
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    const int at = line_of(line.at);
    Fields fields(m.deck, line);
    const std::string slave = io::inp::name_of(fields.next().value_or(""));
    const std::string master = io::inp::name_of(fields.next().value_or(""));
    if (slave.empty() || master.empty())
      fields.fail("*TIE: expected two surfaces, slave and master");
    SourceNode& tie = list_of(root, "ties", at).items.emplace_back(inp_map(at));
    put(tie, "slave",
        inp_text(set_of(m, line.at, slave, {SetKind::surface, SetKind::node_surface}), at));
    put(tie, "master", inp_text(set_of(m, line.at, master, {SetKind::surface}), at));
    if (const auto* const given = io::inp::find_parameter(card, "POSITIONTOLERANCE")) {
      const double tolerance = Fields(m.deck, {given->value, card.at}).real("POSITION TOLERANCE");
      if (tolerance >= no_tolerance) put(tie, "tolerance", inp_number(tolerance, at));
    }
    if (adjust == "NO") put(tie, "adjust", inp_text("false", at)).quoted = false;
  }
}

}  // namespace

bool is_explicit(const InpModel& m) {
  return std::any_of(m.deck.cards.begin(), m.deck.cards.end(), [](const Card& card) {
    return card.keyword == "DYNAMIC" && io::inp::find_parameter(card, "EXPLICIT");
  });
}

bool is_cyclic_tie(const Card& card) {
  return io::inp::find_parameter(card, "CYCLICSYMMETRY") != nullptr;
}

void put_constraints(InpModel& m, SourceNode& root) {
  put_mean_rotations(m, root);
  for (const Card& card : m.deck.cards) {
    if (card.keyword == "MPC") put_mpcs(m, card, root);
    if (card.keyword == "COUPLING") put_coupling(m, card, root);
    if (card.keyword == "PRE-TENSIONSECTION") put_pretension(m, card, root);
    if (card.keyword == "CYCLICSYMMETRYMODEL") put_cyclic_symmetry(m, card, root);
    if (card.keyword == "TIE" && !is_cyclic_tie(card) && !is_explicit(m)) put_ties(m, card, root);
  }
}

}  // namespace osculate::deck
