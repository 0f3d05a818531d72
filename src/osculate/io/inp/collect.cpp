#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "osculate/core/text.hpp"
#include "osculate/io/inp/loaded_sets.hpp"
#include "osculate/io/inp/parts.hpp"
#include "osculate/io/inp/scope.hpp"
#include "osculate/io/utf8.hpp"

namespace osculate::io::inp {
namespace {

constexpr double degree = std::numbers::pi / 180;

void place(std::vector<Vec3>& nodes, const Placement& placement) {
  const Mat<3, 3> turn = placement.turn();
  for (Vec3& x : nodes) {
    const Vec3 arm = x + placement.move - placement.about;
    x = placement.about + turn * arm;
  }
}

/// Adds a number, to the last range where it follows that.
void add_number(RawSet& set, std::int32_t number, std::uint32_t scope, Place at) {
  if (!set.ranges.empty()) {
    Range& last = set.ranges.back();
    if (last.step == 1 && last.scope == scope && last.at.line == at.line && !last.generated &&
        last.last + 1 == number) {
      last.last = number;
      return;
    }
  }
  set.ranges.push_back({number, number, 1, scope, at, false});
}

class Collector {
 public:
  explicit Collector(const Deck& deck) : deck_(deck) { mesh_.scopes.emplace_back(); }

  RawMesh collect() {
    for (const Card& card : deck_.cards) take(card);
    if (inside_) fail(deck_, *inside_, "'*END " + inside_->keyword + "' is missing");
    if (!parts_.empty() && mesh_.instances.empty())
      fail(deck_, parts_.begin()->second.at, "no *INSTANCE places the parts");
    return std::move(mesh_);
  }

 private:
  struct Part {
    Scope scope;
    Place at;
  };

  void take(const Card& card) {
    struct Reading {
      std::string_view keyword;
      void (Collector::*read)(const Card&);
    };
    static constexpr std::array<Reading, 16> readings{{{"NODE", &Collector::read_nodes},
                                                       {"ELEMENT", &Collector::read_elements},
                                                       {"NSET", &Collector::read_node_set},
                                                       {"ELSET", &Collector::read_element_set},
                                                       {"SURFACE", &Collector::read_surface},
                                                       {"PART", &Collector::begin_part},
                                                       {"ENDPART", &Collector::end_part},
                                                       {"INSTANCE", &Collector::begin_instance},
                                                       {"ENDINSTANCE", &Collector::end_instance},
                                                       {"NGEN", &Collector::refuse},
                                                       {"NFILL", &Collector::refuse},
                                                       {"NCOPY", &Collector::refuse},
                                                       {"NMAP", &Collector::refuse},
                                                       {"ELGEN", &Collector::refuse},
                                                       {"ELCOPY", &Collector::refuse},
                                                       {"SYSTEM", &Collector::refuse}}};
    for (const Reading& reading : readings)
      if (reading.keyword == card.keyword) return (this->*reading.read)(card);
  }

  void refuse(const Card& card) {
    fail(deck_, card,
         "makes or moves nodes and elements, which is not read; write all of them "
         "with *NODE and *ELEMENT");
  }

  [[nodiscard]] Scope& here() { return part_ ? part_->scope : mesh_.scopes[instance_]; }

  /// The name that a parameter gives.
  std::string name_in(const Card& card, std::string_view parameter) const {
    const Parameter* const found = find_parameter(card, parameter);
    if (!found || found->value.empty())
      fail(deck_, card, fmt::format("expected '{}=' with a name", parameter));
    return plain(card, found->value);
  }
  std::string plain(const Card& card, const std::string& name) const {
    constexpr std::size_t longest = 200;
    if (name.size() > longest)
      fail(deck_, card, fmt::format("a name has more than {} characters", longest));
    if (!is_plain_text(name)) fail(deck_, card, "the name has control characters or is not UTF-8");
    return name;
  }

  // ---- sets -----------------------------------------------------------------------------------

  template <class Set>
  static Set& set_in(Named<Set>& sets, const Card& card, const std::string& name) {
    const auto [found, is_new] = sets.try_emplace(capitals(name));
    if (is_new) {
      found->second.name = name;
      found->second.at = card.at;
    }
    return found->second;
  }

  /// The instance that a card names, else its own scope.
  std::uint32_t scope_of(const Card& card) const {
    const Parameter* const found = find_parameter(card, "INSTANCE");
    if (!found) return own_scope;
    const std::string name = plain(card, found->value);
    const auto instance = mesh_.instances.find(capitals(name));
    if (instance != mesh_.instances.end()) return instance->second;
    std::vector<std::string> names;
    for (const auto& [key, scope] : mesh_.instances) names.push_back(mesh_.scopes[scope].name);
    fail(deck_, card, core::unknown_name_message("instance", name, names));
  }

  /// Takes `instance.` off a name where there is such an instance.
  std::uint32_t take_instance(std::string& name) const {
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos) return own_scope;
    const auto instance = mesh_.instances.find(capitals(std::string_view(name).substr(0, dot)));
    if (instance == mesh_.instances.end()) return own_scope;
    name.erase(0, dot + 1);
    return instance->second;
  }

  /// A number or a name of a set.
  void add_member(RawSet& set, std::string_view field, std::uint32_t scope, Place at) const {
    if (field.empty()) return;
    std::string name = name_of(field);
    if (scope == own_scope && !is_number(name)) scope = take_instance(name);
    if (!is_number(name)) return set.names.push_back({std::move(name), scope, at, false});
    add_number(set, number_of(deck_, at, name, "a number"), scope, at);
    set.ranges.back().listed = true;
  }

  void add_range(RawSet& set, const Line& line, std::uint32_t scope) const {
    Fields fields(deck_, line);
    Range range{0, 0, 1, scope, line.at, true};
    range.first = fields.number("the first number");
    range.last = fields.number("the last number");
    if (!fields.done()) range.step = fields.number("the step of the numbers");
    fields.expect_end();
    if (range.first > range.last)
      fields.fail(
          fmt::format("the last number, {}, is below the first one, {}", range.last, range.first));
    set.ranges.push_back(range);
  }

  void read_set(const Card& card, RawSet& set) const {
    const std::uint32_t scope = scope_of(card);
    const bool generate = find_parameter(card, "GENERATE") != nullptr;
    for (const Line& line : lines_of(deck_, card)) {
      if (generate) {
        add_range(set, line, scope);
        continue;
      }
      Fields fields(deck_, line);
      while (const std::optional<std::string_view> field = fields.next())
        add_member(set, *field, scope, line.at);
    }
  }

  void read_node_set(const Card& card) {
    RawSet& set = set_in(here().node_sets, card, name_in(card, "NSET"));
    read_set(card, set);
    if (const Parameter* const elements = find_parameter(card, "ELSET"))
      set.names.push_back({plain(card, elements->value), scope_of(card), card.at, true});
  }
  void read_element_set(const Card& card) {
    read_set(card, set_in(here().element_sets, card, name_in(card, "ELSET")));
  }

  // ---- surfaces -------------------------------------------------------------------------------

  void read_surface(const Card& card) {
    const Parameter* const type = find_parameter(card, "TYPE");
    const std::string kind = type ? capitals(type->value) : "ELEMENT";
    if (kind != "ELEMENT" && kind != "NODE") return;  // of a shape, not of the mesh
    if (const Parameter* const combine = find_parameter(card, "COMBINE"))
      return read_combined(card, capitals(combine->value));
    const std::string name = name_in(card, "NAME");
    if (kind == "NODE") {
      RawSet& set = set_in(here().node_surfaces, card, name);
      for (const Line& line : lines_of(deck_, card)) {
        Fields fields(deck_, line);  // behind the first one stands an area
        add_member(set, fields.next().value_or(""), own_scope, line.at);
      }
      return;
    }
    RawSurface& surface = set_in(here().surfaces, card, name);
    if (surface.combination != Combination::none) twice(card, name);
    for (const Line& line : lines_of(deck_, card)) add_entry(surface, line);
  }

  [[noreturn]] void twice(const Card& card, const std::string& name) const {
    fail(deck_, card,
         fmt::format("the surface {} is there already: one that is made of others "
                     "has one card",
                     shown(name)));
  }

  /// A surface that is made of others.
  void read_combined(const Card& card, const std::string& how) {
    if (const Parameter* const type = find_parameter(card, "TYPE");
        type && capitals(type->value) == "NODE")
      fail(deck_, card, "COMBINE is read of surfaces of elements, not of nodes");
    const std::string name = name_in(card, "NAME");
    RawSurface& surface = set_in(here().surfaces, card, name);
    if (!surface.entries.empty() || surface.combination != Combination::none) twice(card, name);
    if (how == "UNION") surface.combination = Combination::unite;
    if (how == "DIFFERENCE") surface.combination = Combination::difference;
    if (how == "INTERSECTION") surface.combination = Combination::intersection;
    if (surface.combination == Combination::none)
      fail(deck_, card,
           fmt::format("expected COMBINE=UNION, DIFFERENCE or INTERSECTION, found {}", shown(how)));
    for (const Line& line : lines_of(deck_, card)) {
      Fields fields(deck_, line);
      while (!fields.done()) {
        const std::string_view field = fields.next().value_or("");
        if (field.empty()) continue;
        SetName part{name_of(field), own_scope, line.at, true};
        part.scope = take_instance(part.name);
        surface.parts.push_back(std::move(part));
      }
    }
    const bool two = surface.combination != Combination::unite;
    if (surface.parts.empty() || (two && surface.parts.size() != 2))
      fail(deck_, card, fmt::format("expected {} of surfaces", two ? "two names" : "names"));
  }

  void add_entry(RawSurface& surface, const Line& line) const {
    Fields fields(deck_, line);
    const std::string_view first = fields.next().value_or("");
    if (first.empty()) fields.fail("expected a number or the name of a set");
    SurfaceEntry entry;
    entry.set = {name_of(first), own_scope, line.at, true};
    if (!is_number(entry.set.name)) entry.set.scope = take_instance(entry.set.name);
    if (is_number(entry.set.name))
      entry.number = number_of(deck_, line.at, entry.set.name, "the number of an element");
    if (const std::optional<std::string_view> side = fields.next())
      entry.side = capitals(name_of(*side));
    fields.expect_end();
    surface.entries.push_back(std::move(entry));
  }

  // ---- nodes and elements ---------------------------------------------------------------------

  void read_nodes(const Card& card) {
    const Parameter* const system = find_parameter(card, "SYSTEM");
    const std::string kind = system ? capitals(system->value) : "R";
    if (kind != "R" && kind != "C")
      fail(deck_, card, fmt::format("expected SYSTEM=R or C, found {}", shown(kind)));
    Scope& scope = here();
    RawSet* const set = find_parameter(card, "NSET")
                            ? &set_in(scope.node_sets, card, name_in(card, "NSET"))
                            : nullptr;
    for (const Line& line : lines_of(deck_, card)) {
      Fields fields(deck_, line);
      const std::int32_t number = fields.number("the number of a node");
      Vec3 x = Vec3::Zero();
      for (Eigen::Index k = 0; k < 3; ++k) x[k] = fields.real_or_zero("a coordinate");
      for (int k = 0; k < 3; ++k) (void)fields.real_or_zero("a direction");
      fields.expect_end();
      if (kind == "C") x = {x[0] * std::cos(x[1] * degree), x[0] * std::sin(x[1] * degree), x[2]};
      scope.node_numbers.push_back(number);
      scope.nodes.push_back(x);
      scope.node_at.push_back(line.at);
      if (set) add_number(*set, number, own_scope, card.at);
    }
  }

  const ElementType& type_of(const Card& card) const {
    const Parameter* const type = find_parameter(card, "TYPE");
    if (!type) fail(deck_, card, "expected 'TYPE=' with a type of element");
    const std::string name = capitals(type->value);
    const ElementType* const found = name == beam_brick ? nullptr : find_element_type(name);
    if (found) return *found;
    fail(deck_, card,
         fmt::format("elements of type {} are not supported; supported are {} and their variants",
                     shown(type->value), element_type_names()));
  }

  void read_discrete(const Card& card) {
    const Parameter* const set = find_parameter(card, "ELSET");
    std::vector<std::int32_t>& numbers = here().discrete[set ? capitals(set->value) : ""];
    for (const Line& line : lines_of(deck_, card))
      if (const auto number = number_of(Fields(deck_, line).next().value_or("")))
        numbers.push_back(*number);
  }

  void read_elements(const Card& card) {
    if (discrete_nodes(card) > 0) return read_discrete(card);
    Scope& scope = here();
    RawElements& elements = scope.elements.emplace_back();
    elements.type = &type_of(card);
    elements.variant = capitals(find_parameter(card, "TYPE")->value);
    RawSet* const set = find_parameter(card, "ELSET")
                            ? &set_in(scope.element_sets, card, name_in(card, "ELSET"))
                            : nullptr;
    const std::span<const Line> lines = lines_of(deck_, card);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      i = read_element(lines, i, elements);
      if (set) add_number(*set, elements.numbers.back(), own_scope, card.at);
    }
  }

  /// From the line `i` on; returns its last line.
  std::size_t read_element(std::span<const Line> lines, std::size_t i,
                           RawElements& elements) const {
    Fields fields(deck_, lines[i]);
    elements.at.push_back(lines[i].at);
    elements.numbers.push_back(fields.number("the number of an element"));
    const int count = cell::info(elements.type->cell).nodes;
    for (int k = 0; k < count; ++k) {
      while (fields.done()) {
        if (++i == lines.size())
          fail(deck_, elements.at.back(),
               fmt::format("element {} has {} nodes where {} needs {}", elements.numbers.back(), k,
                           elements.type->name, count));
        fields = Fields(deck_, lines[i]);
      }
      elements.nodes.push_back(fields.number("the number of a node"));
    }
    // CalculiX once had three nodes more in it, for its incompatible modes
    if (elements.variant.starts_with("C3D8I"))
      for (int k = 0; k < 3 && !fields.done(); ++k) (void)fields.number("the number of a node");
    if (!fields.done())
      fields.fail(fmt::format("element {} has more than the {} nodes of {}",
                              elements.numbers.back(), count, elements.type->name));
    return i;
  }

  // ---- parts and instances --------------------------------------------------------------------

  void enter(const Card& card) {
    if (inside_)
      fail(deck_, card,
           fmt::format("stands inside of *{} of line {}, whose end is missing", inside_->keyword,
                       inside_->at.line));
    inside_ = &card;
  }
  void leave(const Card& card, std::string_view keyword) {
    if (!inside_ || inside_->keyword != keyword)
      fail(deck_, card, fmt::format("there is no *{} that it could end", keyword));
    inside_ = nullptr;
  }

  void begin_part(const Card& card) {
    enter(card);
    const std::string name = name_in(card, "NAME");
    const auto [found, is_new] = parts_.try_emplace(capitals(name));
    if (!is_new)
      fail(deck_, card,
           fmt::format("the part '{}' is there twice (see line {})", name, found->second.at.line));
    found->second.scope.name = name;
    found->second.at = card.at;
    part_ = &found->second;
  }
  void end_part(const Card& card) {
    leave(card, "PART");
    part_ = nullptr;
  }

  void begin_instance(const Card& card) {
    enter(card);
    const std::string name = name_in(card, "NAME");
    if (find_parameter(card, "LIBRARY") || find_parameter(card, "INSTANCE"))
      fail(deck_, card, "instances of other analyses are not read");
    const std::string part = name_in(card, "PART");
    const auto found = parts_.find(capitals(part));
    if (found == parts_.end()) {
      std::vector<std::string> names;
      for (const auto& [key, one] : parts_) names.push_back(one.scope.name);
      fail(deck_, card, core::unknown_name_message("part", part, names));
    }
    instance_ = static_cast<std::uint32_t>(mesh_.scopes.size());
    if (!mesh_.instances.try_emplace(capitals(name), instance_).second)
      fail(deck_, card, fmt::format("the instance '{}' is there twice", name));
    mesh_.scopes.push_back(found->second.scope);
    mesh_.scopes.back().name = name;
    placement_ = placement_of(deck_, card);
  }
  void end_instance(const Card& card) {
    leave(card, "INSTANCE");
    std::vector<Vec3>& nodes = here().nodes;
    place(nodes, placement_);
    for (const Vec3& x : nodes)
      if (!x.allFinite()) fail(deck_, card, "its place is too far away for a number");
    instance_ = 0;
  }

  const Deck& deck_;
  RawMesh mesh_;
  Named<Part> parts_;
  const Card* inside_ = nullptr;  ///< the part or instance that is being read
  Part* part_ = nullptr;
  std::uint32_t instance_ = 0;  ///< place in the scopes
  Placement placement_;
};

}  // namespace

RawMesh collect(const Deck& deck) { return Collector(deck).collect(); }

}  // namespace osculate::io::inp
