#include "osculate/io/inp/thin_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "osculate/io/inp/loaded_sets.hpp"

namespace osculate::io::inp {
namespace {

using Shape = ThinSection::Shape;

std::string option(const Card& card, std::string_view name) {
  const Parameter* const found = find_parameter(card, name);
  return found ? capitals(found->value) : std::string();
}

bool is_shell(const ElementType& type) {
  return type.family == Family::surface && type.name[0] == 'S' && type.name[1] != 'F';
}
bool is_truss(const ElementType& type) { return type.name.starts_with("T3D"); }
bool is_beam(const ElementType& type) { return type.name.starts_with("B3"); }
bool is_solid(const ElementType& type) { return type.family == Family::solid; }
bool is_axisymmetric(const ElementType& type) { return type.name.starts_with("CAX"); }

ThinSection::Plane plane_of(const ElementType& type) {
  if (is_axisymmetric(type)) return ThinSection::Plane::axisymmetric;
  return type.name.starts_with("CPS") ? ThinSection::Plane::stress : ThinSection::Plane::strain;
}

/// PIPE and others as they are called; a plate is none of them.
Shape shape_of(const Card& card) {
  const std::string name = option(card, "SECTION");
  if (name.starts_with("RECT")) return Shape::rectangle;
  if (name.starts_with("CIRC")) return Shape::ellipse;
  if (name == "PIPE") return Shape::pipe;
  return name == "BOX" ? Shape::box : Shape::plate;
}
bool is_beam_section(const Card& card) {
  return card.keyword == "BEAMSECTION" || card.keyword == "BEAMGENERALSECTION";
}

double number_or(const Card& card, std::string_view name, double fallback, const Deck& deck) {
  const Parameter* const found = find_parameter(card, name);
  if (!found) return fallback;
  return Fields(deck, {found->value, card.at}).real("a number");
}

class Reader {
 public:
  Reader(const Deck& deck, const RawMesh& raw, const Numbering& numbering, Members& members)
      : deck_(deck), raw_(raw), numbering_(numbering), members_(members) {}

  ThinCards read() {
    out_.finite = has_finite_step(deck_);
    out_.section_of.assign(numbering_.elements.size(), -1);
    for (const Card& card : deck_.cards) {
      if (card.keyword == "SHELLSECTION" || is_beam_section(card)) read_section(card);
      if (card.keyword == "SOLIDSECTION") read_trusses(card);
    }
    if (!out_.sections.empty() || section_has(is_solid)) {
      out_.sectors = section_has(is_axisymmetric);
      for (const Card& card : deck_.cards)
        if (card.keyword == "SOLIDSECTION") read_plane(card);
    }
    if (out_.sections.empty()) return std::move(out_);
    for (const Card& card : deck_.cards) {
      if (card.keyword == "NODALTHICKNESS") read_thickness(card);
      if (card.keyword == "NORMAL") read_normals(card);
      if (card.keyword == "BOUNDARY") read_directions(card, true);
      if (card.keyword == "CLOAD") read_directions(card, false);
      if (card.keyword == "TRANSFORM") add_named(option(card, "NSET"), transformed_);
      read_joined(card);
    }
    for (const auto& [node, directions] : out_.held)
      if (transformed_.contains(node)) out_.held_along_axes.insert(node);
    return std::move(out_);
  }

 private:
  /// The elements of a section; none where the set is that of a part.
  [[nodiscard]] std::vector<Index> elements_of(const Card& card) {
    std::string set = option(card, "ELSET");
    const std::uint32_t scope = take_instance(set);
    if (!raw_.scopes[scope].element_sets.contains(set)) return {};
    return members_.of(Kind::elements, scope, set, card.at);
  }

  /// Takes `instance.` off a name, and says which scope that is; else what stands outside of them.
  std::uint32_t take_instance(std::string& name) const {
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos) return 0;
    const auto instance = raw_.instances.find(capitals(std::string_view(name).substr(0, dot)));
    if (instance == raw_.instances.end()) return 0;
    name.erase(0, dot + 1);
    return instance->second;
  }

  [[nodiscard]] double thickness(Fields& fields, bool needed) const {
    const double size = fields.real_or_zero("a thickness");
    if (size < 0 || (size == 0 && needed))
      fields.fail(fmt::format("expected a thickness above 0, found {}", size));
    return size;
  }

  void read_section(const Card& card) {
    if (!is_thin_section(card)) return;
    const std::vector<Index> elements = elements_of(card);
    if (elements.empty()) return;
    const std::span<const Line> lines = lines_of(deck_, card);
    const bool plate = card.keyword == "SHELLSECTION";
    const bool of_nodes = !is_layered(card) && find_parameter(card, "NODALTHICKNESS") != nullptr;
    ThinSection section;
    if (!plate) section.shape = shape_of(card);
    if (lines.empty() && !of_nodes) fail(deck_, card, "expected a line with the thickness");
    if (section.is_hollow()) {
      if (lines.empty()) fail(deck_, card, "expected a line with the sizes of the section");
      read_walls(lines[0], section);
    } else if (is_layered(card)) {
      for (const Line& line : lines) {
        Fields fields(deck_, line);
        section.layers.push_back(thickness(fields, true));
        section.thickness[0] += section.layers.back();
      }
    } else if (!lines.empty() && !of_nodes) {
      Fields fields(deck_, lines[0]);
      section.thickness[0] = thickness(fields, true);
      if (!plate) section.thickness[1] = thickness(fields, false);
      if (!plate && section.thickness[1] == 0) section.thickness[1] = section.thickness[0];
    }
    if (plate) {
      section.offset[0] = number_or(card, "OFFSET", 0, deck_);
    } else {
      section.offset = {number_or(card, "OFFSET1", 0, deck_), number_or(card, "OFFSET2", 0, deck_)};
      if (lines.size() > 1) read_axis(lines[1], section.axis);
    }
    for (const Index element : elements) {
      const ElementType& type = *numbering_.elements[static_cast<std::size_t>(element)].type;
      if (plate ? !is_shell(type) : !is_beam(type))
        fail(deck_, card,
             fmt::format("its elements are of type {}, which is no {}", type.name,
                         plate ? "shell" : "beam in space"));
      if (!section.layers.empty() && type.name != "S8" && type.name != "S6")
        fail(deck_, card,
             fmt::format("its elements are of type {}; shells of layers are S6, S8 or S8R",
                         type.name));
      if (section.shape == Shape::ellipse && type.name != "B32")
        fail(deck_, card,
             fmt::format("its elements are of type {}; round beams are B32 or B32R", type.name));
      if (section.is_hollow() && type.name != "B32")
        fail(
            deck_, card,
            fmt::format("its elements are of type {}; pipes and boxes are B32 or B32R", type.name));
      out_.section_of[static_cast<std::size_t>(element)] = static_cast<int>(out_.sections.size());
    }
    out_.sections.push_back(section);
  }

  /// PIPE: outer radius, wall. BOX: sizes along both axes, then four walls.
  void read_walls(const Line& line, ThinSection& section) const {
    Fields fields(deck_, line);
    const bool pipe = section.shape == Shape::pipe;
    section.thickness[0] = thickness(fields, true) * (pipe ? 2 : 1);
    section.thickness[1] = pipe ? section.thickness[0] : thickness(fields, true);
    for (std::size_t k = 0; k < (pipe ? 1U : 4U); ++k) section.wall[k] = thickness(fields, true);
    if (pipe && !(section.wall[0] < section.thickness[0] / 2))
      fields.fail("expected a wall thinner than the radius");
    for (const std::size_t k : {0, 1})
      if (!pipe && !(section.wall[k] + section.wall[k + 2] < section.thickness[k]))
        fields.fail("expected walls that are thinner than the box");
  }

  void read_axis(const Line& line, Vec3& axis) const {
    Fields fields(deck_, line);
    for (Eigen::Index k = 0; k < 3; ++k) axis[k] = fields.real_or_zero("a direction");
    if (!(axis.norm() > 0)) fields.fail("expected the first axis of the section");
  }

  /// Trusses are squares of the area that the section gives.
  void read_trusses(const Card& card) {
    std::vector<Index> trusses;
    for (const Index element : elements_of(card))
      if (is_truss(*numbering_.elements[static_cast<std::size_t>(element)].type))
        trusses.push_back(element);
    if (trusses.empty()) return;
    const std::span<const Line> lines = lines_of(deck_, card);
    if (lines.empty()) fail(deck_, card, "expected a line with the area of the trusses");
    Fields fields(deck_, lines[0]);
    ThinSection section;
    section.shape = Shape::rectangle;
    section.hinged = true;
    section.thickness.fill(std::sqrt(thickness(fields, true)));
    for (const Index element : trusses)
      out_.section_of[static_cast<std::size_t>(element)] = static_cast<int>(out_.sections.size());
    out_.sections.push_back(section);
  }

  /// Whether some `*SOLID SECTION` has elements of a kind.
  [[nodiscard]] bool section_has(bool (*is)(const ElementType&)) {
    for (const Card& card : deck_.cards) {
      if (card.keyword != "SOLIDSECTION") continue;
      for (const Index element : elements_of(card))
        if (is(*numbering_.elements[static_cast<std::size_t>(element)].type)) return true;
    }
    return false;
  }

  /// Plane elements beside solids: one section of each kind.
  void read_plane(const Card& card) {
    std::map<ThinSection::Plane, int> known;
    for (const Index element : elements_of(card)) {
      const ElementType& type = *numbering_.elements[static_cast<std::size_t>(element)].type;
      if (type.family != Family::plane) continue;
      const auto [found, is_new] =
          known.try_emplace(plane_of(type), static_cast<int>(out_.sections.size()));
      out_.section_of[static_cast<std::size_t>(element)] = found->second;
      if (!is_new) continue;
      ThinSection& section = out_.sections.emplace_back();
      section.plane = found->first;
      section.at = card.at;
      section.thickness[0] = 1;
      if (section.plane == ThinSection::Plane::axisymmetric) continue;
      if (const auto lines = lines_of(deck_, card); !lines.empty()) {
        Fields fields(deck_, lines[0]);
        if (const double size = thickness(fields, false); size > 0) section.thickness[0] = size;
      }
      if (out_.sectors) section.thickness[0] /= sectors_of_ring;
    }
  }

  [[nodiscard]] std::vector<Index> nodes_of(std::string_view field, Place at) {
    std::string name = name_of(field);
    const std::uint32_t scope = take_instance(name);
    if (const std::optional<std::int32_t> number = number_of(name)) {
      const ScopeNumbers& numbers = numbering_.scopes[scope];
      const Index place = numbers.nodes.find(*number);
      if (place < 0) fail(deck_, at, fmt::format("node {} does not exist", *number));
      return {numbers.first_node + place};
    }
    return members_.of(Kind::nodes, scope, name, at);
  }

  void read_thickness(const Card& card) {
    for (const Line& line : lines_of(deck_, card)) {
      Fields fields(deck_, line);
      const std::vector<Index> nodes = nodes_of(fields.next().value_or(""), line.at);
      const double first = thickness(fields, true), second = thickness(fields, false);
      for (const Index node : nodes) out_.thickness[node] = {first, second > 0 ? second : first};
    }
  }

  void read_normals(const Card& card) {
    for (const Line& line : lines_of(deck_, card)) {
      Fields fields(deck_, line);
      const Index element = members_.element(0, fields.number("the number of an element"), line.at);
      const std::vector<Index> nodes = nodes_of(fields.next().value_or(""), line.at);
      Vec3 normal = Vec3::Zero();
      for (Eigen::Index k = 0; k < 3; ++k) normal[k] = fields.real_or_zero("a direction");
      if (!(normal.norm() > 0)) fields.fail("expected a normal that is not zero");
      for (const Index node : nodes) out_.normals[{element, node}] = normal.normalized();
    }
  }

  /// Directions of nodes that are held, rotations that are held or loaded; what is wrong in the
  /// lines the translation tells.
  void read_directions(const Card& card, bool of_boundary) {
    for (const Line& line : lines_of(deck_, card)) {
      Fields fields(deck_, line);
      const std::string_view nodes = fields.next().value_or("");
      const std::string_view word = fields.next().value_or("");
      std::vector<int> directions = of_boundary ? held_directions(word) : std::vector<int>{};
      const auto first = number_of(word);
      const auto last = of_boundary ? number_of(fields.next().value_or("")) : first;
      if (first)
        for (int k = *first; k <= std::min(last.value_or(*first), 6); ++k) directions.push_back(k);
      for (const int k : directions) {
        if (k < 1 || (k < 4 && !of_boundary)) continue;
        for (const Index node : nodes_of(nodes, line.at)) {
          if (of_boundary) out_.held[node][static_cast<std::size_t>(k - 1)] = true;
          if (k >= 4) out_.rotations[node][static_cast<std::size_t>(k - 4)] = true;
        }
      }
    }
  }

  /// Nodes that a field names, if there are some.
  void add_named(std::string_view field, std::set<Index>& to) {
    std::string name = name_of(field);
    const std::uint32_t scope = take_instance(name);
    if (const std::optional<std::int32_t> number = number_of(name)) {
      const ScopeNumbers& numbers = numbering_.scopes[scope];
      if (const Index place = numbers.nodes.find(*number); place >= 0)
        to.insert(numbers.first_node + place);
    } else if (raw_.scopes[scope].node_sets.contains(capitals(name))) {
      for (const Index node : members_.of(Kind::nodes, scope, name, {})) to.insert(node);
    }
  }

  /// Nodes of conditions between nodes. Terms of equations are a node, a direction and a factor.
  void read_joined(const Card& card) {
    if (card.keyword == "RIGIDBODY")
      for (const char* const set : {"NSET", "PINNSET", "TIENSET"})
        add_named(option(card, set), out_.joined);
    if (card.keyword != "EQUATION" && card.keyword != "MPC") return;
    std::int32_t left = 0;  // fields of the equation
    for (const Line& line : lines_of(deck_, card)) {
      Fields fields(deck_, line);
      if (card.keyword == "MPC") (void)fields.next();
      while (!fields.done()) {
        const std::string_view field = fields.next().value_or("");
        if (card.keyword == "MPC") {
          add_named(field, out_.joined);
        } else if (left == 0) {
          left = 3 * std::max(0, number_of(field).value_or(0));
          break;
        } else if (left-- % 3 == 0) {
          add_named(field, out_.joined);
        }
      }
    }
  }

  const Deck& deck_;
  const RawMesh& raw_;
  const Numbering& numbering_;
  Members& members_;
  std::set<Index> transformed_;
  ThinCards out_;
};

}  // namespace

bool moves_far(const Deck& deck, const Card& mpc) {
  if (mpc.keyword != "MPC") return false;
  return std::ranges::any_of(lines_of(deck, mpc), [&](const Line& line) {
    const std::string kind = capitals(name_of(Fields(deck, line).next().value_or("")));
    return kind == "PLANE" || kind == "STRAIGHT" || kind == "BEAM";
  });
}

bool has_finite_law(const Deck& deck) {
  return std::ranges::any_of(deck.cards, [](const Card& card) {
    return card.keyword == "HYPERELASTIC" || card.keyword == "HYPERFOAM" ||
           card.keyword == "DEFORMATIONPLASTICITY";
  });
}

bool has_finite_step(const Deck& deck) {
  if (has_finite_law(deck)) return true;
  bool far = false;
  for (const Card& card : deck.cards) {
    far = far || moves_far(deck, card);
    if (card.keyword != "STEP") continue;
    if (find_parameter(card, "NLGEOM")) far = option(card, "NLGEOM") != "NO";
    if (far) return true;
  }
  return false;
}

bool is_layered(const Card& card) {
  return card.keyword == "SHELLSECTION" && find_parameter(card, "COMPOSITE");
}

bool is_thin_section(const Card& card) {
  if (card.keyword == "SHELLSECTION") return true;
  return is_beam_section(card) && shape_of(card) != Shape::plate;
}

ThinCards thin_cards(const Deck& deck, const RawMesh& raw, const Numbering& numbering,
                     Members& members) {
  return Reader(deck, raw, numbering, members).read();
}

}  // namespace osculate::io::inp
