// Multi-point constraints, couplings, sections under pretension, cyclic symmetry and ties of a
// deck.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "osculate/deck/inp_parts.hpp"
#include "osculate/deck/pretension.hpp"
#include "osculate/io/inp/loaded_sets.hpp"
#include "osculate/io/inp/thin_sections.hpp"

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
  if (kind == "MEANROT") return nullptr;               // in inp_meanrot.cpp
  if (kind == "PIN" || kind == "TIE") return nullptr;  // equations
  io::inp::fail(m.deck, line.at,
                fmt::format("*MPC: {} is not supported: PLANE, STRAIGHT, BEAM, MEANROT, PIN or TIE",
                            printable(kind)));
}

bool says_nlgeom(const InpModel& m) {
  return std::ranges::any_of(m.deck.cards, [](const Card& card) {
    return card.keyword == "STEP" && io::inp::find_parameter(card, "NLGEOM");
  });
}

/// A line begins with the kind; one that begins with a node goes on with the last one.
void put_mpcs(InpModel& m, const Card& card, SourceNode& root) {
  SourceNode* nodes = nullptr;
  bool known = false;
  if (io::inp::moves_far(m.deck, card) && !says_nlgeom(m) && !io::inp::has_finite_law(m.deck))
    m.notes.push_back(
        fmt::format("line {}: *MPC with PLANE, STRAIGHT or BEAM makes displacements and strains "
                    "those of NLGEOM, as in CalculiX; *STEP, NLGEOM=NO keeps strains small",
                    card.at.line));
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
      fields.fail("expected PLANE, STRAIGHT, BEAM, MEANROT, PIN or TIE");
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

/// The directions that the lines of a `*KINEMATIC` or `*DISTRIBUTING` name; without lines all.
std::array<bool, 6> coupled_directions(const InpModel& m, const Card& kind) {
  std::array<bool, 6> coupled{};
  const auto lines = io::inp::lines_of(m.deck, kind);
  if (lines.empty()) coupled.fill(true);
  for (const Line& line : lines) {
    Fields fields(m.deck, line);
    const std::int32_t first = fields.number("the first direction");
    std::int32_t last = first;
    if (const auto field = fields.next(); field && !field->empty())
      last = io::inp::number_of(m.deck, line.at, *field, "the last direction");
    for (std::int32_t k = first; k <= std::min<std::int32_t>(last, 6); ++k)
      coupled[static_cast<std::size_t>(k - 1)] = true;
  }
  return coupled;
}

/// The mean motion of the nodes of a surface is that of the reference node, or some displacements
/// of each are. As in CalculiX, the directions of a `*DISTRIBUTING` are of no account.
void put_coupling(const InpModel& m, const Card& card, SourceNode& root) {
  const Card& kind = kind_of_coupling(m, card);
  if (moves_surface(m, kind)) return;
  const int line = line_of(card.at);
  SourceNode& entry = list_of(root, "coupling", line).items.emplace_back(inp_map(line));
  put(entry, "on",
      inp_text(set_of(m, card.at, value_of(m, card, "SURFACE"),
                      {SetKind::surface, SetKind::node_surface}),
               line));
  put(entry, "rigid", inp_text(reference_body(m, card), line));
  if (kind.keyword == "DISTRIBUTING") {
    if (!option_of(card, "ORIENTATION").empty())
      io::inp::fail(m.deck, card,
                    "ORIENTATION is not supported with *DISTRIBUTING, where it turns the forces at "
                    "the reference node: give these along x, y and z");
    return;
  }
  const std::array<bool, 6> coupled = coupled_directions(m, kind);
  SourceNode of = inp_list(line);
  for (int k = 1; k <= inp_dimension(m); ++k)
    if (coupled[static_cast<std::size_t>(k - 1)])
      of.items.push_back(inp_text(inp_component('u', k), line));
  if (of.items.empty()) io::inp::fail(m.deck, kind, "couples no displacement");
  if (m.finite)
    io::inp::fail(m.deck, kind,
                  "some directions alone are not supported with NLGEOM: all displacements");
  put(entry, "of", std::move(of));
  if (!option_of(card, "ORIENTATION").empty()) put(entry, "axes", inp_orientation(m, card));
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
  refuse_layers_of_plane(m, card.at, surface, PlaneNodes::of_solids,
                         "*PRE-TENSION SECTION through them is not supported");
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
  if (has_layers_of_plane(m))
    io::inp::fail(m.deck, card, "plane elements become solids beside others: not supported here");
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
    const std::string& on = set_of(m, line.at, slave, {SetKind::surface, SetKind::node_surface});
    refuse_layers_of_plane(m, line.at, on, PlaneNodes::both,
                           "they follow the nodes of the deck and cannot be the slave of a *TIE "
                           "(CalculiX does not tie them): make them the master");
    put(tie, "slave", inp_text(on, at));
    put(tie, "master", inp_text(set_of(m, line.at, master, {SetKind::surface}), at));
    if (const auto* const given = io::inp::find_parameter(card, "POSITIONTOLERANCE")) {
      const double tolerance = Fields(m.deck, {given->value, card.at}).real("POSITION TOLERANCE");
      if (tolerance >= no_tolerance) put(tie, "tolerance", inp_number(tolerance, at));
    }
    if (adjust == "NO") put(tie, "adjust", inp_text("false", at)).quoted = false;
  }
}

}  // namespace

bool moves_surface(const InpModel& m, const Card& kind) {
  if (kind.keyword != "KINEMATIC") return false;
  const std::array<bool, 6> coupled = coupled_directions(m, kind);
  return std::all_of(coupled.begin(), coupled.begin() + inp_dimension(m),
                     [](bool one) { return one; });
}

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
