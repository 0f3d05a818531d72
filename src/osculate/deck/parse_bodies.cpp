#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/text.hpp"
#include "osculate/deck/parse_parts.hpp"

namespace osculate::deck {
namespace {

struct LawName {
  const char* key;
  MaterialLaw law;
};
constexpr std::array<LawName, 3> laws{{{"linear_elastic", MaterialLaw::linear_elastic},
                                       {"st_venant_kirchhoff", MaterialLaw::st_venant_kirchhoff},
                                       {"neo_hooke", MaterialLaw::neo_hooke}}};

Kinematics usual_kinematics(MaterialLaw law) {
  return law == MaterialLaw::linear_elastic ? Kinematics::small : Kinematics::finite;
}

void require_kinematics(const Section& section, const Material& material) {
  const MaterialLaw law = material.law.value;
  if (section.kinematics.value == usual_kinematics(law)) return;
  const bool linear = law == MaterialLaw::linear_elastic;
  throw core::InputError(
      section.kinematics.mark,
      fmt::format("material '{}' is {}, which needs kinematics: {}", material.name.value,
                  linear ? "linear_elastic" : "hyperelastic", linear ? "small" : "finite"));
}

Section section_of(const Value& v, const std::vector<Material>& materials) {
  Section s;
  s.on = name_of(v.at("on"));
  s.material = name_of(v.at("material"));
  const auto material = std::find_if(materials.begin(), materials.end(), [&](const Material& m) {
    return m.name.value == s.material.value;
  });
  if (material == materials.end()) {
    std::vector<std::string> known;
    for (const Material& m : materials) known.push_back(m.name.value);
    throw core::InputError(s.material.mark, core::unknown_name_message(
                                                "material", printable(s.material.value), known));
  }
  s.element = word_of<SectionElement>(v, "element");
  s.thickness = number_of(v.at("thickness"));
  if (s.element.value == SectionElement::axisymmetric && v.at("thickness").given)
    throw core::InputError(s.thickness.mark, "an axisymmetric body has no thickness");
  if (is_space(s.element.value) && v.at("thickness").given)
    throw core::InputError(s.thickness.mark, "is for plane bodies; a body in space has its own");
  const Value* const kinematics = v.find("kinematics");
  s.kinematics = kinematics ? word_of<Kinematics>(*kinematics)
                            : Marked<Kinematics>{usual_kinematics(material->law.value), v.mark};
  s.formulation = word_of<Formulation>(v, "formulation");
  if (s.element.value == SectionElement::solid_shell && v.at("formulation").given)
    throw core::InputError(s.formulation.mark,
                           "solid_shell elements have a formulation of their own");
  require_kinematics(s, *material);
  return s;
}

ArcShape arc_of(const Value& v) {
  ArcShape arc{point_of(v.at("center")), number_of(v.at("radius")), number_of(v.at("from")),
               number_of(v.at("to")), flag(v, "inside")};
  if (!(arc.to.value > arc.from.value && arc.to.value <= arc.from.value + 360))
    throw core::InputError(
        arc.to.mark, fmt::format("must be above `from` ({}) by at most 360, got {}", arc.from.value,
                                 arc.to.value));
  return arc;
}

PolylineShape polyline_of(const Value& v) {
  PolylineShape line{points_of(v.at("points")), flag(v, "closed")};
  const std::vector<Vec2>& points = line.points.value;
  if (line.closed && points.size() < 3)
    throw core::InputError(line.points.mark, "a closed polyline needs at least 3 points");
  if (line.closed && points.front() == points.back())
    throw core::InputError(line.points.mark,
                           "a closed polyline must not repeat its first point at the end");
  return line;
}

HalfPlaneShape half_plane_of(const Value& v) {
  const Vec2 normal = point_of(v.at("normal"));
  const double length = normal.stableNorm();
  if (!(length > 0)) throw core::InputError(v.at("normal").mark, "must not be zero");
  return {point_of(v.at("point")), normal / length};
}

PlaneShape plane_of(const Value& v) {
  const Vec3 normal = place_of(v.at("normal"));
  const double length = normal.stableNorm();
  if (!(length > 0)) throw core::InputError(v.at("normal").mark, "must not be zero");
  return {place_of(v.at("point")), normal / length};
}

NurbsShape nurbs_of(const Value& v) {
  NurbsShape n;
  n.degree = integer_of(v.at("degree"));
  n.knots = numbers_of(v.at("knots"));
  n.control.mark = v.at("control").mark;
  for (const Value& item : v.at("control").items) {
    if (!(item.items[2].number > 0))
      throw core::InputError(item.items[2].mark, "a weight must be > 0, got " + item.items[2].text);
    n.control.value.emplace_back(item.items[0].number, item.items[1].number, item.items[2].number);
  }
  const std::size_t expected =
      n.control.value.size() + static_cast<std::size_t>(n.degree.value) + 1;
  if (n.control.value.size() <= static_cast<std::size_t>(n.degree.value))
    throw core::InputError(n.control.mark,
                           fmt::format("degree {} needs at least {} control points, "
                                       "got {}",
                                       n.degree.value, n.degree.value + 1, n.control.value.size()));
  if (n.knots.value.size() != expected)
    throw core::InputError(n.knots.mark,
                           fmt::format("expected {} knots (control points + degree + 1), got {}",
                                       expected, n.knots.value.size()));
  const std::vector<Value>& knots = v.at("knots").items;
  for (std::size_t i = 1; i < knots.size(); ++i)
    if (knots[i].number < knots[i - 1].number)
      throw core::InputError(knots[i].mark, fmt::format("knots must not decrease, got {} after {}",
                                                        knots[i].text, knots[i - 1].text));
  return n;
}

RigidShape shape_of(const Value& v) {
  if (const Value* const set = v.find("set")) return SetShape{name_of(*set)};
  if (const Value* const circle = v.find("circle"))
    return CircleShape{point_of(circle->at("center")), number_of(circle->at("radius")),
                       flag(*circle, "inside")};
  if (const Value* const arc = v.find("arc")) return arc_of(*arc);
  if (const Value* const polyline = v.find("polyline")) return polyline_of(*polyline);
  if (const Value* const line = v.find("line")) return half_plane_of(*line);
  if (const Value* const plane = v.find("plane")) return plane_of(*plane);
  return nurbs_of(v.at("nurbs"));
}

/// The key of the shape: the first one; exactly one of them is given.
std::string kind_of(const Value& v) {
  for (const ValueEntry& entry : v.entries)
    if (entry.key != "reference" && entry.key != "flip") return entry.key;
  return {};
}

}  // namespace

std::vector<Material> parse_materials(const Value& v) {
  std::vector<Material> out;
  for (const ValueEntry& entry : v.entries) {
    for (const LawName& law : laws) {
      const Value* const constants = entry.value.find(law.key);
      if (!constants) continue;
      out.push_back({{entry.key, entry.key_mark},
                     {law.law, constants->mark},
                     number_of(constants->at("E")),
                     number_of(constants->at("nu")),
                     number_of(constants->at("density"))});
    }
  }
  return out;
}

std::vector<Section> parse_sections(const Value& v, const std::vector<Material>& materials) {
  std::vector<Section> out;
  for (const Value& item : v.items) out.push_back(section_of(item, materials));
  return out;
}

std::vector<Rigid> parse_rigid(const Value& v) {
  std::vector<Rigid> out;
  for (const ValueEntry& entry : v.entries) {
    Rigid rigid;
    rigid.name = {entry.key, entry.key_mark};
    rigid.shape = shape_of(entry.value);
    rigid.kind = kind_of(entry.value);
    if (const Value* const reference = entry.value.find("reference"))
      rigid.reference = numbers_of(*reference);
    rigid.flip = flag(entry.value, "flip");
    out.push_back(std::move(rigid));
  }
  return out;
}

}  // namespace osculate::deck
