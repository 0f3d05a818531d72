// Axes, equations and rigid bodies of a deck.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "osculate/deck/inp_parts.hpp"
#include "osculate/io/inp/loaded_sets.hpp"
#include "osculate/material/orientation.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;
using io::inp::SetKind;

/// A rigid body of the nodes of sets and its reference node.
void put_rigid(InpModel& m, const Card& card, const std::vector<std::string>& nodes,
               SourceNode& rigid) {
  const int line = line_of(card.at);
  const std::string name = reference_body(m, card);
  const std::string reference = node_parameter(m, card, "REFNODE");
  const Index node = only_node(m, reference);
  if (!m.body_nodes.try_emplace(node, InpBodyNode{name}).second)
    io::inp::fail(m.deck, card, "its reference node belongs to another body already");
  const std::string turning = node_parameter(m, card, "ROTNODE");
  if (!turning.empty()) m.body_nodes[only_node(m, turning)] = {name, 4, true};
  SourceNode& body = put(rigid, name, inp_map(line));
  put(body, "reference_node", inp_text(reference, line));
  if (!turning.empty()) put(body, "rotation_node", inp_text(turning, line));
  SourceNode& sets = put(body, "set", inp_list(line));
  for (const std::string& set : nodes) sets.items.push_back(inp_text(set, line));
  sets.items.push_back(inp_text(reference, line));
  if (!m.finite) put(body, "kinematics", inp_text("small", line));
  put(body, "reference",
      inp_point(m.mesh.mesh.nodes[static_cast<std::size_t>(node)], inp_dimension(m), line));
}

}  // namespace

Mat<3, 3> axes_of_node(const InpModel& m, Index node) {
  Mat<3, 3> axes = Mat<3, 3>::Identity();
  if (!m.transformed.contains(node)) return axes;
  for (const Card& card : m.deck.cards) {
    if (card.keyword != "TRANSFORM") continue;
    const std::string& on = set_of(m, card.at, value_of(m, card, "NSET"), {SetKind::nodes});
    const std::vector<Index>& nodes = m.mesh.mesh.find_set(on)->nodes;
    if (std::ranges::find(nodes, node) == nodes.end()) continue;
    using Kind = material::Orientation::Kind;
    Fields fields(m.deck, only_line(m, card, "two points"));
    material::Orientation along;
    along.kind = option_of(card, "TYPE") == "C" ? Kind::cylindrical : Kind::rectangular;
    along.a = point_of(fields);
    along.b = point_of(fields);
    if (inp_dimension(m) == 2 && along.kind == Kind::cylindrical) along.b = along.a + Vec3::UnitZ();
    if (material::gives_axes(along))
      axes = material::axes_at(along, m.mesh.mesh.nodes[static_cast<std::size_t>(node)]);
  }
  return axes;
}

SourceNode inp_axes(InpModel& m) {
  SourceNode axes = inp_list(1);
  for (const Card& card : m.deck.cards) {
    if (card.keyword != "TRANSFORM") continue;
    const std::string type = option_of(card, "TYPE");
    if (!type.empty() && type != "R" && type != "C")
      io::inp::fail(m.deck, card, fmt::format("expected TYPE=R or C, found {}", printable(type)));
    const int line = line_of(card.at), dimension = inp_dimension(m);
    Fields fields(m.deck, only_line(m, card, "two points"));
    const Vec3 a = point_of(fields), b = point_of(fields);
    SourceNode& entry = axes.items.emplace_back(inp_map(line));
    const std::string& on = set_of(m, card.at, value_of(m, card, "NSET"), {SetKind::nodes});
    put(entry, "on", inp_text(on, line));
    const std::vector<Index>& nodes = m.mesh.mesh.find_set(on)->nodes;
    m.transformed.insert(nodes.begin(), nodes.end());
    if (type == "C") {
      SourceNode& cylinder = put(entry, "cylindrical", inp_map(line));
      put(cylinder, "from", inp_point(a, dimension, line));
      if (dimension == 3) put(cylinder, "to", inp_point(b, 3, line));
    } else {
      SourceNode& directions = put(entry, "rectangular", inp_map(line));
      put(directions, "x", inp_point(a, dimension, line));
      put(directions, "xy", inp_point(b, dimension, line));
    }
  }
  return axes;
}

namespace {

/// The set of the one node of a coupling's element.
std::string coupled_node(const InpModel& m, const Card& coupling) {
  const std::string elements = io::inp::capitals(value_of(m, coupling, "ELSET"));
  for (const Card& card : m.deck.cards) {
    if (card.keyword != "ELEMENT" || option_of(card, "ELSET") != elements) continue;
    const Line& line = only_line(m, card, "an element and its node");
    Fields fields(m.deck, line);
    (void)fields.next();
    return node_set_of(m, line, fields.next().value_or(""));
  }
  io::inp::fail(m.deck, coupling, "there is no *ELEMENT with this ELSET");
}

/// The displacement of a node is the weighted mean of others.
void put_distributing(const InpModel& m, const Card& card, SourceNode& equations) {
  const std::string node = coupled_node(m, card);
  for (int k = 1; k <= inp_dimension(m); ++k) {
    const int line = line_of(card.at);
    SourceNode& terms = put(equations.items.emplace_back(inp_map(line)), "terms", inp_list(line));
    const auto add = [&](const std::string& on, double factor) {
      SourceNode& term = terms.items.emplace_back(inp_map(line));
      put(term, "on", inp_text(on, line));
      put(term, "of", inp_text(inp_component('u', k), line));
      put(term, "factor", inp_number(factor, line));
    };
    double sum = 0;
    for (const Line& data : io::inp::lines_of(m.deck, card)) {
      Fields fields(m.deck, data);
      const std::string& set = node_set_of(m, data, fields.next().value_or(""));
      const double weight = fields.real("the weight");
      sum += weight * static_cast<double>(m.mesh.mesh.find_set(set)->nodes.size());
      add(set, -weight);
    }
    add(node, sum);
    std::rotate(terms.items.rbegin(), terms.items.rbegin() + 1, terms.items.rend());
  }
}

}  // namespace

namespace {

/// A set whose nodes are not in the order of their numbers: others here.
void require_sorted(const InpModel& m, const Line& line, const std::string& set) {
  for (const Card& card : m.deck.cards)
    if (card.keyword == "NSET" && io::inp::find_parameter(card, "UNSORTED") &&
        option_of(card, "NSET") == io::inp::capitals(set))
      io::inp::fail(m.deck, line.at,
                    fmt::format("*EQUATION: '{}' is UNSORTED, which is not supported: nodes are in "
                                "the order of their numbers",
                                set));
}

/// The terms of one equation, which has one for each node of its sets, as in Abaqus.
class EquationReader {
 public:
  EquationReader(const InpModel& m, SourceNode& equation, int line)
      : m_(m), equation_(equation), terms_(inp_list(line)) {}

  /// `node or set, direction, factor`
  void read(Fields& fields, const Line& line) {
    const std::string& set = node_set_of(m_, line, fields.next().value_or(""));
    const std::int32_t dof = fields.number("the number of a direction");
    if (dof < 1 || dof > highest_direction(m_, set))
      fields.fail(fmt::format("'{}' has no direction {}", set, dof));
    const std::vector<InpPlace> places = inp_places(m_, set, dof);
    if (places.size() != 1) fields.fail("expected one node here, or nodes that are no knots");
    const double factor = fields.real("the factor");
    add(fields, line, set, places[0], factor);
  }

  /// What a direction of a set acts on, as a term.
  void add(Fields& fields, const Line& line, const std::string& set, const InpPlace& place,
           double factor) {
    count(fields, line, set);
    const int at = line_of(line.at);
    SourceNode& term = terms_.items.emplace_back(inp_map(at));
    put(term, "on", inp_text(place.on, at));
    put(term, "of", inp_text(inp_component('u', place.direction), at));
    put(term, "factor", inp_number(place.sign * factor, at));
  }

  void finish() {
    put(equation_, "terms", std::move(terms_));
    if (nodes_ > 1)
      put(equation_, "for_each_node", inp_text("true", equation_.line)).quoted = false;
  }

 private:
  /// Sets have as many nodes as the first one.
  void count(Fields& fields, const Line& line, const std::string& set) {
    const std::size_t nodes = m_.mesh.mesh.find_set(set)->nodes.size();
    if (terms_.items.empty()) nodes_ = nodes;
    if (nodes > 1) require_sorted(m_, line, set);
    if (nodes != 1 && nodes != nodes_)
      fields.fail(
          fmt::format("*EQUATION: there is one equation for each node of the first set, "
                      "which has {}: '{}' has {}",
                      nodes_, set, nodes));
  }

  const InpModel& m_;
  SourceNode& equation_;
  SourceNode terms_;
  std::size_t nodes_ = 0;
};

void put_equations(const InpModel& m, const Card& card, SourceNode& equations) {
  std::int32_t missing = 0;
  std::optional<EquationReader> reader;
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    const int at = line_of(line.at);
    if (missing == 0) {
      missing = fields.number("the number of terms");
      fields.expect_end();
      reader.emplace(m, equations.items.emplace_back(inp_map(at)), at);
      continue;
    }
    for (; !fields.done() && missing > 0; --missing) reader->read(fields, line);
    if (missing == 0) reader->finish();
  }
  if (missing > 0) io::inp::fail(m.deck, card, fmt::format("{} terms are missing", missing));
}

/// `*MPC` of Abaqus: the nodes of the first set move as the second node; with TIE they turn as it.
void put_joints(const InpModel& m, const Card& card, SourceNode& equations) {
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    const std::string kind = io::inp::capitals(io::inp::name_of(fields.next().value_or("")));
    if (kind != "PIN" && kind != "TIE") continue;
    const std::array<std::string, 2> sets{node_set_of(m, line, fields.next().value_or("")),
                                          node_set_of(m, line, fields.next().value_or(""))};
    fields.expect_end();
    if (only_node(m, sets[1]) < 0)
      fields.fail(fmt::format("*MPC: expected one node, '{}' has several", sets[1]));
    const int highest = std::min(highest_direction(m, sets[0]), highest_direction(m, sets[1]));
    for (int k = 1; k <= (kind == "PIN" ? 3 : highest); ++k) {
      if (!inp_has_direction(m, k)) continue;
      const std::vector<InpPlace> follows = inp_places(m, sets[0], k),
                                  leads = inp_places(m, sets[1], k);
      if (k > 3 && (follows.empty() || leads.empty())) continue;
      if (follows.size() != 1 || leads.size() != 1)
        fields.fail("*MPC: expected one node, or nodes without rotations");
      SourceNode equation = inp_map(line_of(line.at));
      EquationReader reader(m, equation, equation.line);
      reader.add(fields, line, sets[0], follows[0], 1);
      reader.add(fields, line, sets[1], leads[0], -1);
      reader.finish();
      equations.items.push_back(std::move(equation));
    }
  }
}

}  // namespace

SourceNode inp_equations(const InpModel& m) {
  SourceNode equations = inp_list(1);
  for (const Card& card : m.deck.cards) {
    if (card.keyword == "DISTRIBUTINGCOUPLING") put_distributing(m, card, equations);
    if (card.keyword == "MPC") put_joints(m, card, equations);
    if (card.keyword == "EQUATION" && !is_removal_of_equations(card))
      put_equations(m, card, equations);
  }
  put_small_rotations(m, equations);
  return equations;
}

namespace {

/// Sets of a `*RIGID BODY`: of nodes also those of Abaqus, which differ for shells and beams alone.
std::vector<std::string> sets_of_body(const InpModel& m, const Card& card) {
  std::vector<std::string> sets;
  for (const char* const key : {"NSET", "ELSET", "PINNSET", "TIENSET"})
    if (const io::inp::Parameter* const given = io::inp::find_parameter(card, key))
      sets.push_back(
          set_of(m, card.at, given->value,
                 {key == std::string_view("ELSET") ? SetKind::elements : SetKind::nodes}));
  for (const std::string& set : sets)
    refuse_layers_of_plane(m, card.at, set, PlaneNodes::both, "no part of a rigid body");
  if (sets.empty()) io::inp::fail(m.deck, card, "expected NSET= or ELSET=");
  return sets;
}

}  // namespace

SourceNode inp_rigid(InpModel& m) {
  SourceNode rigid = inp_map(1);
  for (const Card& card : m.deck.cards) {
    if (card.keyword == "RIGIDBODY") put_rigid(m, card, sets_of_body(m, card), rigid);
    if (card.keyword != "COUPLING") continue;
    std::vector<std::string> moved;
    if (moves_surface(m, kind_of_coupling(m, card)))
      moved.push_back(set_of(m, card.at, value_of(m, card, "SURFACE"),
                             {SetKind::surface, SetKind::node_surface}));
    for (const std::string& set : moved)
      refuse_layers_of_plane(m, card.at, set, PlaneNodes::both,
                             "*KINEMATIC is not supported there");
    put_rigid(m, card, moved, rigid);
  }
  put_rotating_bodies(m, rigid);
  put_knots(m, rigid);
  return rigid;
}

SourceNode inp_point(const Vec3& place, int dimension, int line) {
  SourceNode node = inp_list(line);
  for (int i = 0; i < dimension; ++i) node.items.push_back(inp_number(place[i], line));
  return node;
}

Vec3 point_of(Fields& fields) {
  Vec3 place;
  for (double& c : place) c = fields.real_or_zero("a coordinate");
  return place;
}

Index only_node(const InpModel& m, std::string_view set) {
  const mesh::Set* const found = m.mesh.mesh.find_set(set);
  return found && found->nodes.size() == 1 ? found->nodes[0] : -1;
}

std::string node_parameter(const InpModel& m, const Card& card, std::string_view name) {
  const io::inp::Parameter* const given = io::inp::find_parameter(card, name);
  if (!given) return {};
  const auto number = io::inp::number_of(io::inp::name_of(given->value));
  const std::string& set =
      set_of(m, card.at, number ? io::inp::node_set_name(*number) : given->value, {SetKind::nodes});
  if (only_node(m, set) < 0)
    io::inp::fail(m.deck, card,
                  fmt::format("expected a node in '{}=', and '{}' has several", name, set));
  return set;
}

const Card& kind_of_coupling(const InpModel& m, const Card& coupling) {
  const Card* const next = &coupling + 1;
  if (next == m.deck.cards.data() + m.deck.cards.size() ||
      (next->keyword != "KINEMATIC" && next->keyword != "DISTRIBUTING"))
    io::inp::fail(m.deck, coupling, "expected *KINEMATIC or *DISTRIBUTING after it");
  return *next;
}

std::string reference_body(const InpModel& m, const Card& card) {
  const std::string reference = node_parameter(m, card, "REFNODE");
  if (reference.empty()) io::inp::fail(m.deck, card, "expected 'REF NODE=' with a node");
  return plain_name(fmt::format("body of {}", reference));
}

const std::string& node_set_of(const InpModel& m, const Line& line, std::string_view field) {
  const std::string name = io::inp::name_of(field);
  const auto number = io::inp::number_of(name);
  return set_of(m, line.at, number ? io::inp::node_set_name(*number) : name, {SetKind::nodes});
}

std::string inp_component(char kind, int direction) {
  if (direction > 3) kind = kind == 'u' ? 'r' : kind == 'v' ? 'w' : 'm';
  return {kind, "xyz"[(direction - 1) % 3]};
}

}  // namespace osculate::deck
