// `*SHELL SECTION, COMPOSITE` of a deck: a section of each layer.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "osculate/deck/inp_parts.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;

/// A material with axes.
bool has_axes(const InpModel& m, std::string_view material) {
  bool here = false;
  for (const Card& card : m.deck.cards) {
    if (card.keyword == "MATERIAL")
      here = io::inp::capitals(plain_name(value_of(m, card, "NAME"))) == material;
    if (here &&
        ((card.keyword == "ELASTIC" && is_directional(card)) || expands_by_directions(card)))
      return true;
  }
  return false;
}

/// Bending of a layer of C3D8R is held by hourglass control alone, whose size is that of a modulus.
void refuse_hourglass(const InpModel& m, const Card& card, SourceNode& section) {
  const mesh::Mesh& mesh = m.mesh.mesh;
  if (find(section, "formulation")->text != "reduced") return;
  for (const mesh::CellRef& ref : mesh.find_set(find(section, "on")->text)->cells)
    if (mesh.blocks[static_cast<std::size_t>(ref.block)].type == cell::CellType::hex8)
      io::inp::fail(
          m.deck, card,
          "S4R of a material that is not isotropic is not supported: its bending would be "
          "wrong by far; use S4, S8 or S8R");
}

}  // namespace

void put_shell_axes(const InpModel& m, const Card& card, const std::string& orientation,
                    SourceNode& section) {
  refuse_hourglass(m, card, section);
  if (card.keyword != "SHELLSECTION") return;  // axes of beams are x, y and z
  const int line = line_of(card.at);
  SourceNode axes = inp_map(line);
  if (orientation.empty()) {
    SourceNode& in_space = put(axes, "rectangular", inp_map(line));
    put(in_space, "x", inp_point(Vec3::UnitX(), 3, line));
    put(in_space, "xy", inp_point(Vec3::UnitY(), 3, line));
  } else {
    axes = inp_orientation(m, card, orientation);
  }
  put(axes, "shell", inp_text("true", line)).quoted = false;
  put(section, "orientation", std::move(axes));
}

void put_layers(InpModel& m, const Card& card, SourceNode& sections) {
  const std::string& elements = value_of(m, card, "ELSET");
  std::size_t layer = 0;
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    (void)fields.real("the thickness of the layer");
    (void)fields.next();  // points of integration
    const std::string material = material_named(m, io::inp::name_of(fields.next().value_or("")));
    if (material.empty()) fields.fail("expected the material of the layer");
    const std::string orientation = io::inp::name_of(fields.next().value_or(""));
    const std::vector<InpElements> parts =
        elements_of(m, card, io::inp::set_of_layer(elements, ++layer));
    if (parts.size() != 1) fields.fail("shells of layers are of one type: S6, S8 or S8R");
    const int at = line_of(line.at);
    SourceNode& section = sections.items.emplace_back(inp_map(at));
    put(section, "on", inp_text(parts[0].set, at));
    put(section, "material", inp_text(material, at));
    put(section, "element", inp_text("solid", at));
    put(section, "kinematics", inp_text(m.finite ? "finite" : "small", at));
    put(section, "formulation", inp_text(std::string(parts[0].formulation), at));
    if (has_axes(m, io::inp::capitals(material)))
      put_shell_axes(m, card, io::inp::capitals(orientation), section);
  }
}

}  // namespace osculate::deck
