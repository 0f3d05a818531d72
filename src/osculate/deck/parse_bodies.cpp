#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/text.hpp"
#include "osculate/deck/parse_parts.hpp"

namespace osculate::deck {
namespace {

Kinematics usual_kinematics(const material::Law& law) {
  return material::finite_strain(law) ? Kinematics::finite : Kinematics::small;
}

void require_kinematics(const Section& section, const Material& material) {
  const material::Law& law = material.law.value;
  if (section.kinematics.value == usual_kinematics(law) || material::has_logarithmic_form(law))
    return;
  const bool finite = material::finite_strain(law);
  throw core::InputError(
      section.kinematics.mark,
      fmt::format("material '{}' is {}, which needs kinematics: {}", material.name.value,
                  finite ? "hyperelastic" : material::key_of(law), finite ? "finite" : "small"));
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

/// The key of the shape: the first one; exactly one of them is given.
std::string kind_of(const Value& v) {
  for (const ValueEntry& entry : v.entries)
    if (entry.key != "reference" && entry.key != "flip" && entry.key != "mass" &&
        entry.key != "density" && entry.key != "inertia")
      return entry.key;
  return {};
}

}  // namespace

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
    rigid.shape = parse_shape(entry.value);
    rigid.kind = kind_of(entry.value);
    if (const Value* const reference = entry.value.find("reference"))
      rigid.reference = numbers_of(*reference);
    if (const Value* const flip = entry.value.find("flip")) rigid.flip = flip->code != 0;
    rigid.mass = number_if(entry.value, "mass");
    rigid.density = number_if(entry.value, "density");
    if (const Value* const inertia = entry.value.find("inertia"))
      rigid.inertia = inertia->alternative == 0
                          ? Marked<std::vector<double>>{{inertia->number}, inertia->mark}
                          : numbers_of(*inertia);
    if (rigid.mass && rigid.density)
      throw core::InputError(rigid.density->mark, "give the mass or the density, not both");
    if (rigid.inertia && !rigid.mass && !rigid.density)
      throw core::InputError(rigid.inertia->mark, "inertia goes with a mass, which is missing");
    out.push_back(std::move(rigid));
  }
  return out;
}

}  // namespace osculate::deck
