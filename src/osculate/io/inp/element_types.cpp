#include "osculate/io/inp/element_types.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace osculate::io::inp {
namespace {

using enum cell::CellType;
using enum Family;

constexpr std::string_view continuum = "RIHMTS", shell = "RST5W", beam = "RHST";
constexpr std::array<ElementType, 48> types{{
    {"C3D4", continuum, tet4, solid},
    {"C3D6", continuum, wedge6, solid},
    {"C3D8", continuum, hex8, solid},
    {"C3D10", continuum, tet10, solid},
    {"C3D15", continuum, wedge15, solid},
    {"C3D20", continuum, hex20, solid},
    {"CPE3", continuum, tri3, plane},
    {"CPE4", continuum, quad4, plane},
    {"CPE6", continuum, tri6, plane},
    {"CPE8", continuum, quad8, plane},
    {"CPS3", continuum, tri3, plane},
    {"CPS4", continuum, quad4, plane},
    {"CPS6", continuum, tri6, plane},
    {"CPS8", continuum, quad8, plane},
    {"CAX3", continuum, tri3, plane},
    {"CAX4", continuum, quad4, plane},
    {"CAX6", continuum, tri6, plane},
    {"CAX8", continuum, quad8, plane},
    {"S3", shell, tri3, surface},
    {"S4", shell, quad4, surface},
    {"S6", shell, tri6, surface},
    {"S8", shell, quad8, surface},
    {"STRI3", "", tri3, surface},
    {"STRI65", "", tri6, surface},
    {"M3D3", "", tri3, surface},
    {"M3D4", "R", quad4, surface},
    {"M3D6", "", tri6, surface},
    {"M3D8", "R", quad8, surface},
    {"SFM3D3", "", tri3, surface},
    {"SFM3D4", "R", quad4, surface},
    {"SFM3D6", "", tri6, surface},
    {"SFM3D8", "R", quad8, surface},
    {"R3D3", "", tri3, surface},
    {"R3D4", "", quad4, surface},
    {"R2D2", "", line2, line},
    {"RAX2", "", line2, line},
    {"RB2D2", "", line2, line},
    {"RB3D2", "", line2, line},
    {"T2D2", "HT", line2, line},
    {"T3D2", "HT", line2, line},
    {"B21", beam, line2, line},
    {"B31", beam, line2, line},
    {"B22", beam, line3, line},
    {"B32", beam, line3, line},
    {"M3D9", "R", quad9, surface},
    {"T2D3", "HT", line3, line},
    {"T3D3", "HT", line3, line},
    {beam_brick, "", hex20, solid},
}};

constexpr std::array<std::int8_t, 9> same{0, 1, 2, 3, 4, 5, 6, 7, 8};
/// Ends and middle of a line: the deck has the middle between the ends.
constexpr std::array<std::int8_t, 3> line_places{0, 2, 1};
// Solids of second order: middles of the edges of the first face, of the second one, of the edges
// that join them; in tetrahedra of the edges that lead to the fourth corner. So does VTK.
constexpr std::array<std::int8_t, 10> tet_places{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
constexpr std::array<std::int8_t, 15> wedge_places{0, 1,  2,  3,  4, 5,  6, 9,
                                                   7, 12, 14, 13, 8, 10, 11};
constexpr std::array<std::int8_t, 20> hex_places{0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                                 13, 9, 16, 18, 19, 17, 10, 12, 14, 15};

// The faces S1, S2, ... among those of the cell.
constexpr std::array<std::int8_t, 4> tet_faces{0, 1, 3, 2};
constexpr std::array<std::int8_t, 5> wedge_faces{0, 1, 2, 4, 3};
constexpr std::array<std::int8_t, 6> hex_faces{0, 5, 1, 3, 4, 2};

std::span<const std::int8_t> cell_faces(cell::CellType type) {
  const cell::CellInfo& info = cell::info(type);
  if (info.corners == 4) return tet_faces;
  if (info.corners == 6) return wedge_faces;
  return hex_faces;
}

Side shell_side(std::string_view label, int edges) {
  if (label == "SPOS" || label == "S2") return {Side::Kind::whole, 0};
  if (label == "SNEG" || label == "S1") return {Side::Kind::reversed, 0};
  const int number = label.size() == 2 ? label[1] - '0' : 0;
  const int local = label[0] == 'E' ? number - 1 : number - 3;
  if (local < 0 || local >= edges) return {};
  return {Side::Kind::edge, local};
}

}  // namespace

const ElementType* find_element_type(std::string_view name) {
  const ElementType* found = nullptr;
  for (const ElementType& type : types) {
    if (!name.starts_with(type.name) || (found && found->name.size() > type.name.size())) continue;
    const std::string_view rest = name.substr(type.name.size());
    const auto once = [&](char c) {
      return type.variants.find(c) != std::string_view::npos &&
             std::count(rest.begin(), rest.end(), c) == 1;
    };
    if (std::all_of(rest.begin(), rest.end(), once)) found = &type;
  }
  return found;
}

std::string element_type_names() {
  std::string all;
  for (const ElementType& type : types)
    if (type.name != beam_brick) all += fmt::format("{}{}", all.empty() ? "" : ", ", type.name);
  return all;
}

std::span<const std::int8_t> cell_places(const ElementType& type) {
  switch (type.cell) {
    case line3:
      return line_places;
    case tet10:
      return tet_places;
    case wedge15:
      return wedge_places;
    case hex20:
      return hex_places;
    default:
      return std::span(same).first(static_cast<std::size_t>(cell::info(type.cell).nodes));
  }
}

Side find_side(const ElementType& type, std::string_view label) {
  const cell::CellInfo& info = cell::info(type.cell);
  const bool known = !label.empty() && (label[0] == 'S' || label[0] == 'E');
  if (!known || type.family == line) return {};
  if (type.family == surface) return shell_side(label, info.edge_count);
  const bool in_space = type.family == solid;
  const int number = label.size() == 2 ? label[1] - '0' : 0;
  if (number < 1 || number > (in_space ? info.face_count : info.edge_count)) return {};
  if (!in_space) return {Side::Kind::edge, number - 1};
  if (label[0] == 'E') return {};
  return {Side::Kind::face, cell_faces(type.cell)[static_cast<std::size_t>(number - 1)]};
}

std::string solid_side(std::string_view label, bool of_load, Family family) {
  if (family == plane && label.size() == 2) return {'S', static_cast<char>(label[1] + 2)};
  if (of_load) {
    if (family == surface && label.size() == 6) return {'S', static_cast<char>(label[5] + 2)};
    if (family == surface) return "S1";
    if (family == line && label == "P2") return "S5";
    return "S" + std::string(label.substr(1));
  }
  if (label == "SNEG") return "S1";
  if (label == "SPOS") return "S2";
  if (label.size() == 2 && label[0] == 'E') return {'S', static_cast<char>(label[1] + 2)};
  return std::string(label);
}

std::string side_names(const ElementType& type) {
  const cell::CellInfo& info = cell::info(type.cell);
  if (type.family == line) return "none";
  if (type.family == solid) return fmt::format("S1 to S{}", info.face_count);
  if (type.family == plane) return fmt::format("S1 to S{}", info.edge_count);
  return fmt::format("SPOS, SNEG or E1 to E{}", info.edge_count);
}

}  // namespace osculate::io::inp
