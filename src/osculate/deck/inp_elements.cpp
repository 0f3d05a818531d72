// Types of elements of a deck: which `element` and `formulation` of a section they are.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/text.hpp"
#include "osculate/deck/inp_parts.hpp"
#include "osculate/io/inp/element_types.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::SetKind;

/// C3D8 and CPE4 are fully integrated as in CalculiX; of the variants R is reduced integration, I
/// are incompatible modes, H is for incompressible materials, of second order with R, too. C3D6 has
/// two points.
const char* formulation_of(std::string_view type, const io::inp::ElementType& known) {
  using enum cell::CellType;
  const std::string_view letters = type.substr(known.name.size());
  const bool first = known.cell == quad4 || known.cell == hex8;
  const bool second = known.cell == quad8 || known.cell == hex20;
  const bool hybrid = letters.find('H') != std::string_view::npos && !type.starts_with("CPS");
  if (type == io::inp::beam_brick) return "beam";
  if (known.cell == wedge6) return "reduced";
  if (hybrid && cell::info(known.cell).order == 2) return "bbar";
  if (letters.find('R') != std::string_view::npos && (first || second)) return "reduced";
  if (letters.find('I') != std::string_view::npos && first) return "enhanced";
  if (hybrid && first) return "bbar";
  return "full";
}

const char* element_of(std::string_view type) {
  if (type.starts_with("CPE")) return "plane_strain";
  if (type.starts_with("CPS")) return "plane_stress";
  return type.starts_with("CAX") ? "axisymmetric" : "solid";
}

}  // namespace

std::vector<InpElements> elements_of(const InpModel& m, const Card& section) {
  return elements_of(m, section, value_of(m, section, "ELSET"));
}

std::vector<InpElements> elements_of(const InpModel& m, const Card& section,
                                     const std::string& name) {
  const std::string& whole = set_of(m, section.at, name, {SetKind::elements});
  const std::string key = io::inp::capitals(name);
  std::vector<InpElements> parts;
  for (const io::inp::DeckSet& set : m.mesh.sets) {
    const std::string typed = io::inp::capitals(io::inp::typed_set_name(name, set.type));
    const std::string own = io::inp::capitals(set.name);
    if (set.kind != SetKind::elements || set.type.empty() || (own != key && own != typed)) continue;
    const io::inp::ElementType* const known = io::inp::find_element_type(set.type);
    parts.push_back(
        {m.mesh.mesh.sets[set.set].name, element_of(set.type), formulation_of(set.type, *known)});
  }
  const auto same = [&](const InpElements& part) {
    return part.element == parts[0].element && part.formulation == parts[0].formulation;
  };
  if (parts.empty())
    io::inp::fail(m.deck, section,
                  fmt::format("'{}' has no solid or plane elements", printable(name)));
  if (std::all_of(parts.begin(), parts.end(), same)) {
    parts.resize(1);
    parts[0].set = whole;
  }
  return parts;
}

}  // namespace osculate::deck
