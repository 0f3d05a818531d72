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

/// Of rectangular axes the third one; none where they are others.
std::optional<Vec3> third_axis(SourceNode& axes) {
  SourceNode* const points = find(axes, "rectangular");
  SourceNode* const turn = find(axes, "turn");
  if (!points || (turn && find(*turn, "about")->text != "3")) return {};
  const auto point = [&](const char* key) {
    Vec3 place = Vec3::Zero();
    const SourceNode& list = *find(*points, key);
    for (std::size_t k = 0; k < 3; ++k)
      place[static_cast<Eigen::Index>(k)] = std::stod(list.items[k].text);
    return place;
  };
  return point("x").cross(point("xy")).normalized();
}

/// Axes of a shell's material are those of a solid only where the third one is the normal.
void require_flat(const InpModel& m, io::inp::Place place, const std::string& set,
                  const Vec3& axis) {
  const mesh::Mesh& mesh = m.mesh.mesh;
  for (const mesh::CellRef& ref : mesh.find_set(set)->cells) {
    const Index* const nodes = mesh.blocks[static_cast<std::size_t>(ref.block)].cell(ref.cell);
    const auto at = [&](int k) { return mesh.nodes[static_cast<std::size_t>(nodes[k])]; };
    const Vec3 normal = (at(1) - at(0)).cross(Vec3(at(2) - at(0))).normalized();
    constexpr double same = 1 - 1e-6;
    if (!(normal.dot(axis) > same))
      io::inp::fail(m.deck, place,
                    fmt::format("shells that are not isotropic need an *ORIENTATION, SYSTEM="
                                "RECTANGULAR whose third axis is the normal of their elements; "
                                "element {} has another",
                                mesh::cell_number(mesh, ref)));
  }
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

void put_shell_axes(const InpModel& m, const Card& card, io::inp::Place place,
                    const std::string& orientation, SourceNode& section) {
  refuse_hourglass(m, card, section);
  std::optional<Vec3> axis = Vec3::UnitZ();
  if (!orientation.empty()) {
    SourceNode axes = inp_orientation(m, card, orientation);
    axis = third_axis(axes);
    put(section, "orientation", std::move(axes));
  }
  require_flat(m, place, find(section, "on")->text, axis.value_or(Vec3::Zero()));
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
      put_shell_axes(m, card, line.at, io::inp::capitals(orientation), section);
  }
}

}  // namespace osculate::deck
