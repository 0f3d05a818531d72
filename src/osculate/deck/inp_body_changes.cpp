// What a step of a deck changes of its bodies and equations, and what bodies have in them at first.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>

#include "osculate/core/text.hpp"
#include "osculate/deck/inp_parts.hpp"
#include "osculate/io/inp/element_types.hpp"
#include "osculate/io/inp/loaded_sets.hpp"
#include "osculate/io/inp/thin_sections.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;
using io::inp::SetKind;

/// The set of elements that a field names, or the element of a number.
const std::string& elements_named(const InpModel& m, const Line& line, std::string_view field) {
  return set_of(m, line.at, io::inp::element_set_name(io::inp::name_of(field)),
                {SetKind::elements});
}

SourceNode plain_word(const char* text, int line) {
  SourceNode node = inp_text(text, line);
  node.quoted = false;
  return node;
}

/// The list of a key, made where it is missing.
SourceNode& list_in_step(SourceNode& step, const char* key, int line) {
  if (SourceNode* const there = find(step, key)) return *there;
  return put(step, key, inp_list(line));
}

void change_elements(const InpModel& m, const Card& card, SourceNode& step) {
  const bool removes = io::inp::find_parameter(card, "REMOVE") != nullptr;
  const io::inp::Parameter* const adds = io::inp::find_parameter(card, "ADD");
  if (removes == (adds != nullptr)) io::inp::fail(m.deck, card, "expected ADD or REMOVE");
  const std::string how = option_of(card, "ADD");
  const bool with_strain = how == "WITHSTRAIN" || how == "WITH STRAIN";
  if (!how.empty() && !with_strain && how != "STRAINFREE" && how != "STRAIN FREE")
    io::inp::fail(m.deck, card, "expected ADD, ADD=STRAIN FREE or ADD=WITH STRAIN");
  SourceNode& list = list_in_step(step, removes ? "remove" : "add", line_of(card.at));
  for (const Line& line : io::inp::lines_of(m.deck, card))
    for (Fields fields(m.deck, line); !fields.done();) {
      const auto field = fields.next();
      if (!field || field->empty()) continue;
      SourceNode& entry = list.items.emplace_back(inp_map(line_of(line.at)));
      put(entry, "on", inp_text(elements_named(m, line, *field), entry.line));
      if (with_strain) put(entry, "with_strain", plain_word("true", entry.line));
    }
}

void change_section(const InpModel& m, const Card& card, SourceNode& step) {
  const auto stressed = [](const Card& other) {
    return other.keyword == "INITIALCONDITIONS" && option_of(other, "TYPE") == "STRESS";
  };
  if (std::ranges::any_of(m.deck.cards, stressed))
    io::inp::fail(m.deck, card, "is not supported beside initial stresses");
  if (!option_of(card, "ORIENTATION").empty())
    io::inp::fail(m.deck, card, "ORIENTATION is not supported: axes stay as they are");
  const int line = line_of(card.at);
  SourceNode& entry = list_in_step(step, "materials", line).items.emplace_back(inp_map(line));
  put(entry, "on",
      inp_text(set_of(m, card.at, value_of(m, card, "ELSET"), {SetKind::elements}), line));
  put(entry, "material", inp_text(material_named(m, value_of(m, card, "MATERIAL")), line));
}

void free_equations(const InpModel& m, const Card& card, SourceNode& step) {
  const int at = line_of(card.at);
  if (io::inp::find_parameter(card, "REMOVEALL")) {
    std::erase_if(step.entries, [](const SourceEntry& e) { return e.key == "free_equations"; });
    put(step, "free_equations", plain_word("all", at));
    return;
  }
  if (SourceNode* const there = find(step, "free_equations"); there && there->text == "all") return;
  SourceNode& list = list_in_step(step, "free_equations", at);
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    const std::string& set = node_set_of(m, line, fields.next().value_or(""));
    const std::int32_t first = fields.number("a direction");
    std::int32_t last = first;
    if (const auto field = fields.next(); field && !field->empty())
      last = io::inp::number_of(m.deck, line.at, *field, "the last direction");
    for (std::int32_t k = first; k <= last; ++k) {
      if (k < 1 || k > highest_direction(m, set))
        fields.fail(fmt::format("'{}' has no direction {}", printable(set), k));
      for (const InpPlace& place : inp_places(m, set, k)) {
        SourceNode& entry = list.items.emplace_back(inp_map(line_of(line.at)));
        put(entry, "on", inp_text(place.on, entry.line));
        put(entry, "of", inp_list(entry.line)).items = {
            inp_text(inp_component('u', place.direction), entry.line)};
      }
    }
  }
}

SourceNode numbers(const std::vector<double>& values, int line) {
  SourceNode node = inp_list(line);
  for (const double v : values) node.items.push_back(inp_number(v, line));
  return node;
}

/// Values of one element or set, or of its points by their numbers.
struct InitialLines {
  int line = 0;
  std::vector<double> value;
  std::map<std::int32_t, std::vector<double>> points;
};

/// The fields of a line: as many as there are.
std::vector<std::string> fields_of(const InpModel& m, const Line& line) {
  std::vector<std::string> out;
  for (Fields fields(m.deck, line); !fields.done();)
    out.push_back(io::inp::name_of(fields.next().value_or("")));
  while (!out.empty() && out.back().empty()) out.pop_back();
  return out;
}

/// CalculiX gives an element, one of its points and six components (xx, yy, zz, xy, xz, yz), Abaqus
/// a set and as many components as there are.
void read_initial_line(const InpModel& m, const Line& line,
                       std::vector<std::pair<std::string, InitialLines>>& all) {
  const std::size_t components = inp_dimension(m) == 3 ? 6 : 4;
  const std::size_t count = fields_of(m, line).size();
  Fields fields(m.deck, line);
  const bool point = count == 8;
  if (!point && count != components + 1)
    fields.fail(
        fmt::format("expected an element, a point and 6 components (CalculiX), or an element or a "
                    "set and {} components",
                    components));
  const std::string set = elements_named(m, line, fields.next().value_or(""));
  auto known = std::find_if(all.begin(), all.end(), [&](const auto& g) { return g.first == set; });
  if (known == all.end()) {
    all.push_back({set, {line_of(line.at), {}, {}}});
    known = std::prev(all.end());
  }
  std::int32_t number = 0;
  if (point) {
    number = fields.number("the number of a point");
    if (number < 1 || number > 27) fields.fail("expected the number of a point, from 1 on");
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < components; ++i) values.push_back(fields.real("a component"));
  if (point && components == 4 &&
      (fields.real("the component xz") != 0 || fields.real("the component yz") != 0))
    fields.fail("plane elements have no components xz and yz");
  InitialLines& given = known->second;
  if (point ? !given.value.empty() : !given.points.empty())
    fields.fail("gives values of points beside values of all points");
  (point ? given.points[number] : given.value) = values;
}

/// Points of a plane element in CalculiX, where it is a solid: in a layer, and layers.
struct PlanePoints {
  std::string_view type;  ///< behind CPE, CPS or CAX
  std::int32_t in_layer, layers;
};
constexpr std::array<PlanePoints, 5> plane_points{
    {{"4", 4, 2}, {"4I", 4, 2}, {"4R", 1, 1}, {"8", 9, 3}, {"8R", 4, 2}}};

/// The one type of the elements of a set; empty: none, or several.
std::string_view type_of(const InpModel& m, const std::string& on) {
  for (const io::inp::DeckSet& set : m.mesh.sets)
    if (set.kind == SetKind::elements && m.mesh.mesh.sets[set.set].name == on) return set.type;
  return {};
}

/// Of plane elements those of the first layer; the others have to be the same.
void keep_one_layer(const InpModel& m, const Card& card, const std::string& on,
                    InitialLines& given) {
  const std::string_view type = type_of(m, on);
  const auto known = std::ranges::find(
      plane_points, type.substr(std::min<std::size_t>(3, type.size())), &PlanePoints::type);
  const auto fail = [&](const std::string& why) {
    io::inp::fail(m.deck, card, fmt::format("'{}': {}", printable(on), why));
  };
  if (known == plane_points.end())
    fail(
        "points are those of elements of one type, CPE, CPS or CAX with 4 or 8 nodes: give one "
        "value");
  const std::vector<double> none(4, 0.0);
  const auto at = [&](std::int32_t p) -> const std::vector<double>& {
    const auto found = given.points.find(p);
    return found == given.points.end() ? none : found->second;
  };
  const std::int32_t all = known->in_layer * known->layers;
  if (given.points.rbegin()->first > all)
    fail(fmt::format("its elements have {} points in CalculiX, not {}", all,
                     given.points.rbegin()->first));
  for (std::int32_t p = known->in_layer + 1; p <= all; ++p)
    if (at(p) != at((p - 1) % known->in_layer + 1))
      fail(
          fmt::format("point {} is at the place of point {} of a plane element, and has other "
                      "values",
                      p, (p - 1) % known->in_layer + 1));
  given.points.erase(given.points.upper_bound(known->in_layer), given.points.end());
}

/// Bricks of B32R, whose 50 points come in another order in CalculiX.
bool has_beam_bricks(const InpModel& m, const std::string& on) {
  const mesh::Mesh& mesh = m.mesh.mesh;
  const mesh::Set* const set = mesh.find_set(on);
  return set != nullptr && std::ranges::any_of(m.mesh.sets, [&](const io::inp::DeckSet& typed) {
           return typed.kind == SetKind::elements && typed.type == io::inp::beam_brick &&
                  std::ranges::any_of(mesh.sets[typed.set].cells, [&](const mesh::CellRef& cell) {
                    return std::ranges::find(set->cells, cell) != set->cells.end();
                  });
         });
}

}  // namespace

void put_initial_state(const InpModel& m, SourceNode& root) {
  for (const auto& [type, key] :
       {std::pair{"STRESS", "initial_stress"}, std::pair{"PLASTICSTRAIN", "initial_strain"}}) {
    SourceNode list = inp_list(1);
    for (const Card& card : m.deck.cards) {
      if (card.keyword != "INITIALCONDITIONS" || option_of(card, "TYPE") != type) continue;
      for (const char* const other : {"USER", "GEOSTATIC", "SECTIONPOINTS", "FILE"})
        if (io::inp::find_parameter(card, other))
          io::inp::fail(m.deck, card, fmt::format("the parameter {} is not supported", other));
      std::vector<std::pair<std::string, InitialLines>> all;
      for (const Line& line : io::inp::lines_of(m.deck, card)) read_initial_line(m, line, all);
      const bool by_points =
          std::ranges::any_of(all, [](const auto& one) { return !one.second.points.empty(); });
      if (by_points && std::ranges::any_of(m.deck.cards, io::inp::is_layered))
        io::inp::fail(m.deck, card, "points of shells of layers are not supported: give one value");
      for (auto& [set, given] : all) {
        if (!given.points.empty() && inp_dimension(m) == 2) keep_one_layer(m, card, set, given);
        if (!given.points.empty() && has_beam_bricks(m, set))
          io::inp::fail(m.deck, card,
                        "points of B32R are not supported, which have another order here: give one "
                        "value");
        SourceNode& entry = list.items.emplace_back(inp_map(given.line));
        put(entry, "on", inp_text(set, given.line));
        if (given.points.empty()) {
          put(entry, "value", numbers(given.value, given.line));
          continue;
        }
        SourceNode& points = put(entry, "points", inp_list(given.line));
        const std::vector<double> none(inp_dimension(m) == 3 ? 6 : 4, 0.0);
        for (std::int32_t p = 1; p <= given.points.rbegin()->first; ++p) {
          const auto found = given.points.find(p);
          points.items.push_back(
              numbers(found == given.points.end() ? none : found->second, given.line));
        }
      }
    }
    if (!list.items.empty()) put(root, key, std::move(list));
  }
}

void put_body_changes(const InpModel& m, std::span<const Card> cards, SourceNode& step) {
  for (const Card& card : cards) {
    if (card.keyword == "MODELCHANGE" && option_of(card, "TYPE") == "ELEMENT")
      change_elements(m, card, step);
    if (card.keyword == "CHANGESOLIDSECTION") change_section(m, card, step);
    if (is_removal_of_equations(card)) free_equations(m, card, step);
  }
}

bool is_removal_of_equations(const Card& card) {
  return card.keyword == "EQUATION" && (io::inp::find_parameter(card, "REMOVE") != nullptr ||
                                        io::inp::find_parameter(card, "REMOVEALL") != nullptr);
}

}  // namespace osculate::deck
