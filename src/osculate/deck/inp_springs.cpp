// Springs, dampers, gaps and masses of a deck.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/inp_parts.hpp"
#include "osculate/io/inp/loaded_sets.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;
using io::inp::SetKind;

/// An element that is no cell: the sets of its nodes.
struct Discrete {
  std::int32_t number = 0;
  std::string type;
  std::vector<std::string> nodes;
};

/// The elements that a property card is about, which `*ELEMENT` puts into its set.
std::vector<Discrete> elements_with(const InpModel& m, const Card& property) {
  const std::string set = io::inp::capitals(value_of(m, property, "ELSET"));
  std::vector<Discrete> found;
  for (const Card& card : m.deck.cards) {
    if (card.keyword != "ELEMENT" || option_of(card, "ELSET") != set) continue;
    const int count = io::inp::discrete_nodes(card);
    for (const Line& line : io::inp::lines_of(m.deck, card)) {
      if (count == 0) break;
      Fields fields(m.deck, line);
      const std::int32_t number = fields.number("the number of an element");
      Discrete& one = found.emplace_back(Discrete{number, option_of(card, "TYPE"), {}});
      for (int k = 0; k < count; ++k)
        one.nodes.push_back(node_set_of(m, line, fields.next().value_or("")));
      fields.expect_end();
    }
  }
  if (found.empty())
    io::inp::fail(m.deck, property, "there is no *ELEMENT of its kind with this ELSET");
  return found;
}

/// Fails for elements of other kinds.
void require_kind(const InpModel& m, const Card& property, const Discrete& element,
                  std::string_view kind) {
  if (!element.type.starts_with(kind))
    io::inp::fail(m.deck, property,
                  fmt::format("its ELSET has elements of type {}", printable(element.type)));
}

/// factor times a direction of a node as a term.
void put_term(const InpModel& m, const Line& line, const std::string& node, int direction,
              double factor, SourceNode& terms) {
  const std::vector<InpPlace> places =
      direction >= 1 && direction <= 6 ? inp_places(m, node, direction) : std::vector<InpPlace>{};
  if (places.size() != 1)
    io::inp::fail(m.deck, line.at, fmt::format("'{}' has no direction {}", node, direction));
  if (m.transformed.contains(only_node(m, node)))
    io::inp::fail(m.deck, line.at,
                  fmt::format("'{}' has a *TRANSFORM, whose axes are not those of springs: not "
                              "supported",
                              node));
  const int at = line_of(line.at);
  SourceNode& term = terms.items.emplace_back(inp_map(at));
  put(term, "on", inp_text(places[0].on, at));
  put(term, "of", inp_text(inp_component('u', places[0].direction), at));
  put(term, "factor", inp_number(places[0].sign * factor, at));
}

/// Springs of nodes of rings act on a sector of 2 degrees in CalculiX.
double sectors(const InpModel& m, const Discrete& element) {
  constexpr double in_a_circle = 180;
  for (const io::inp::DeckSet& set : m.mesh.sets) {
    if (set.kind != SetKind::elements || !set.type.starts_with("CAX")) continue;
    const std::vector<Index>& ring = m.mesh.mesh.sets[set.set].nodes;
    for (const std::string& node : element.nodes)
      if (std::binary_search(ring.begin(), ring.end(), only_node(m, node))) return in_a_circle;
  }
  return 1;
}

/// Along which line or of which displacements it acts. `directions`: the first line of data.
void put_motion(const InpModel& m, const Card& card, const Discrete& element,
                const Line* directions, SourceNode& spring) {
  const int line = line_of(card.at);
  if (element.type.ends_with('A')) {
    SourceNode& between = put(spring, "between", inp_list(line));
    for (const std::string& node : element.nodes) between.items.push_back(inp_text(node, line));
    put(spring, "kinematics", inp_text(m.finite ? "finite" : "small", line));
    return;
  }
  if (!directions) io::inp::fail(m.deck, card, "expected a line with the direction");
  Fields fields(m.deck, *directions);
  SourceNode& terms = put(spring, "terms", inp_list(line));
  for (std::size_t k = 0; k < element.nodes.size(); ++k)
    put_term(m, *directions, element.nodes[k], fields.number("a direction"), k == 0 ? 1.0 : -1.0,
             terms);
  fields.expect_end();
}

SourceNode& new_spring(SourceNode& root, int line) {
  if (!find(root, "springs")) put(root, "springs", inp_list(line));
  return find(root, "springs")->items.emplace_back(inp_map(line));
}

/// Behind the line with directions, which springs along their nodes do not have: blank lines are
/// none.
std::span<const Line> numbers_of(const InpModel& m, const Card& card, const Discrete& element,
                                 const Line*& directions) {
  std::span<const Line> lines = io::inp::lines_of(m.deck, card);
  directions = nullptr;
  if (!element.type.ends_with('A') && !lines.empty()) {
    directions = &lines.front();
    lines = lines.subspan(1);
  }
  if (lines.empty()) io::inp::fail(m.deck, card, "expected a line with numbers");
  return lines;
}

void put_spring(const InpModel& m, const Card& card, SourceNode& root) {
  if (!option_of(card, "ORIENTATION").empty())
    io::inp::fail(m.deck, card, "ORIENTATION is not supported");
  const bool curve = io::inp::find_parameter(card, "NONLINEAR") != nullptr;
  for (const Discrete& element : elements_with(m, card)) {
    require_kind(m, card, element, "SPRING");
    const Line* directions = nullptr;
    const std::span<const Line> lines = numbers_of(m, card, element, directions);
    const int line = line_of(card.at);
    SourceNode& spring = new_spring(root, line);
    put_motion(m, card, element, directions, spring);
    if (!curve) {
      if (lines.size() > 1)
        io::inp::fail(m.deck, lines[1].at,
                      "*SPRING: a stiffness that depends on the temperature "
                      "is not supported");
      Fields fields(m.deck, lines[0]);
      put(spring, "stiffness",
          inp_number(sectors(m, element) * fields.real("the stiffness"), line_of(lines[0].at)));
      continue;
    }
    SourceNode& table = put(spring, "table", inp_list(line));
    for (const Line& data : lines) {
      Fields fields(m.deck, data);
      const double force = sectors(m, element) * fields.real("the force"),
                   elongation = fields.real("the elongation");
      if (fields.real_or_zero("a temperature") != 0)
        fields.fail("*SPRING: a table that depends on the temperature is not supported");
      SourceNode& point = table.items.emplace_back(inp_list(line_of(data.at)));
      point.items = {inp_number(elongation, line_of(data.at)), inp_number(force, line_of(data.at))};
    }
  }
}

void put_dashpot(const InpModel& m, const Card& card, SourceNode& root) {
  if (!option_of(card, "ORIENTATION").empty())
    io::inp::fail(m.deck, card, "ORIENTATION is not supported");
  for (const Discrete& element : elements_with(m, card)) {
    require_kind(m, card, element, "DASHPOT");
    const Line* directions = nullptr;
    const std::span<const Line> lines = numbers_of(m, card, element, directions);
    if (lines.size() > 1)
      io::inp::fail(m.deck, lines[1].at, "*DASHPOT: one coefficient is read, no second one");
    SourceNode& spring = new_spring(root, line_of(card.at));
    put_motion(m, card, element, directions, spring);
    put(spring, "damping",
        inp_number(sectors(m, element) * Fields(m.deck, lines[0]).real("the coefficient"),
                   line_of(lines[0].at)));
  }
}

/// Nodes that are free to part, and pushed apart as soon as they are nearer than the clearance.
///
/// Formula    q = n . (u2 - u1) , F(q) that of model::SpringGap, whose tension is there in any case
void put_gap(const InpModel& m, const Card& card, SourceNode& root) {
  constexpr double usual_stiffness = 1e12, usual_tension = 1e-3;  // of CalculiX
  for (const Discrete& element : elements_with(m, card)) {
    require_kind(m, card, element, "GAP");
    const Line& data = only_line(m, card, "clearance and direction");
    Fields fields(m.deck, data);
    const double clearance = fields.real("the clearance");
    const Vec3 direction = point_of(fields);
    if (!(direction.norm() > 0)) fields.fail("expected the direction of the gap");
    (void)fields.next();
    const double stiffness = fields.real_or_zero("the stiffness"),
                 tension = fields.real_or_zero("the force in tension");
    const int line = line_of(data.at);
    SourceNode& spring = new_spring(root, line);
    SourceNode& terms = put(spring, "terms", inp_list(line));
    for (int k = 0; k < inp_dimension(m); ++k)
      if (const double n = direction.normalized()[k]; n != 0) {
        put_term(m, data, element.nodes[0], k + 1, -n, terms);
        put_term(m, data, element.nodes[1], k + 1, n, terms);
      }
    SourceNode& gap = put(spring, "gap", inp_map(line));
    const double parts = sectors(m, element);
    put(gap, "clearance", inp_number(clearance, line));
    put(gap, "stiffness", inp_number(parts * (stiffness > 0 ? stiffness : usual_stiffness), line));
    put(gap, "tension", inp_number(parts * (tension > 0 ? tension : usual_tension), line));
  }
}

void put_mass(const InpModel& m, const Card& card, SourceNode& root) {
  const Line& data = only_line(m, card, "the mass");
  for (const Discrete& element : elements_with(m, card)) {
    require_kind(m, card, element, "MASS");
    const int line = line_of(data.at);
    if (!find(root, "masses")) put(root, "masses", inp_list(line));
    SourceNode& mass = find(root, "masses")->items.emplace_back(inp_map(line));
    put(mass, "on", inp_text(element.nodes[0], line));
    put(mass, "mass", inp_number(Fields(m.deck, data).real("the mass"), line));
  }
}

/// Whether a card says what the springs, dampers, ... of an `*ELEMENT` are.
bool has_properties(const InpModel& m, const Card& element) {
  const std::string set = option_of(element, "ELSET");
  return !set.empty() &&
         std::any_of(m.deck.cards.begin(), m.deck.cards.end(), [&](const Card& card) {
           for (const char* const keyword : {"SPRING", "DASHPOT", "GAP", "MASS"})
             if (card.keyword == keyword && option_of(card, "ELSET") == set) return true;
           return false;
         });
}

}  // namespace

std::vector<InpMass> inp_masses(const InpModel& m, std::string_view elements) {
  const std::string key = io::inp::capitals(elements);
  const auto others = m.mesh.discrete.find(key);
  std::vector<InpMass> masses;
  for (const Card& card : m.deck.cards) {
    if (card.keyword != "MASS") continue;
    const bool all = elements == io::inp::every_element || option_of(card, "ELSET") == key;
    if (!all && others == m.mesh.discrete.end()) continue;
    const double mass = Fields(m.deck, only_line(m, card, "the mass")).real("the mass");
    for (const Discrete& element : elements_with(m, card))
      if (all || others->second.contains(element.number))
        masses.push_back({element.nodes[0], mass});
  }
  return masses;
}

void put_springs(const InpModel& m, SourceNode& root) {
  for (const Card& card : m.deck.cards)
    if (card.keyword == "ELEMENT" && io::inp::discrete_nodes(card) > 0 &&
        option_of(card, "TYPE") != "DCOUP3D" && !has_properties(m, card))
      io::inp::fail(m.deck, card, "no *SPRING, *DASHPOT, *GAP or *MASS names its ELSET");
  for (const Card& card : m.deck.cards) {
    if (card.keyword == "SPRING") put_spring(m, card, root);
    if (card.keyword == "DASHPOT") put_dashpot(m, card, root);
    if (card.keyword == "GAP") put_gap(m, card, root);
    if (card.keyword == "MASS") put_mass(m, card, root);
  }
}

}  // namespace osculate::deck
