#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/text.hpp"
#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

Kinematics usual_kinematics(const material::Law& law) {
  return material::finite_strain(law) ? Kinematics::finite : Kinematics::small;
}

void require_kinematics(const Section& section, const Material& material) {
  const material::Law& law = material.law.value;
  if (section.kinematics.value == usual_kinematics(law) || material::has_finite_form(law)) return;
  const bool finite = material::finite_strain(law);
  throw core::InputError(
      section.kinematics.mark,
      fmt::format("material '{}' is {}, which needs kinematics: {}", material.name.value,
                  finite ? "hyperelastic" : material::key_of(law), finite ? "finite" : "small"));
}

Spec section_element_spec() {
  return choice(
             "Which plane the body lives in, or that it is one in space. All sections of a model "
             "are in space, or none is; plane ones beside axisymmetric ones stand for all that is "
             "spread round the circumference.",
             {word("plane_strain", SectionElement::plane_strain, "no strain out of the plane"),
              word("plane_stress", SectionElement::plane_stress, "no stress out of the plane"),
              word("axisymmetric", SectionElement::axisymmetric,
                   "x is the radius, y the axis; forces are those of the whole circumference"),
              word("solid", SectionElement::solid, "a body in space, of volume cells"),
              word("solid_shell", SectionElement::solid_shell,
                   "a thin body in space, of hex8 or shell18 cells; the thickness goes from the "
                   "first half of their nodes to the second, and hex8 cells in one layer are "
                   "turned so. hex27 cells (of a second-order Gmsh mesh) become shell18: their "
                   "nodes halfway through the thickness are left out")})
      .or_else("; shells, beams and others are not available (osculate doc limits)")
      .such_as("plane_strain");
}

Spec formulation_spec() {
  return choice(
             "How cells avoid locking. First-order triangles, tetrahedra and wedges are plain "
             "displacement elements.",
             {word("auto", Formulation::automatic,
                   "first-order quadrilaterals and hexahedra enhanced, cells of second order full; "
                   "of neo_hooke, where enhanced strains are unstable in large compression, and "
                   "of " +
                       remembering_materials() +
                       ", where they hardly converge without hardening, both bbar but for "
                       "triangles, tetrahedra and wedges, in plane stress full"),
              word("full", Formulation::full,
                   "plain displacement element, full integration: too stiff in bending and near nu "
                   "= 0.5 (CalculiX' C3D8, Abaqus' CPS4; Abaqus' C3D8 is bbar)"),
              word("bbar", Formulation::bbar,
                   "averaged volume change, for nearly incompressible (Abaqus' CPE4, CAX4 and "
                   "C3D8): constant in quad4, hex8, tri6, tet10 and wedge15, linear in quad8, "
                   "quad9, hex20 and hex27 (Abaqus' elements whose names end in H)"),
              word("enhanced", Formulation::enhanced,
                   "enhanced strains, for bending and nearly incompressible (CalculiX' C3D8I, "
                   "Abaqus' CPS4I, CPE4I, CAX4I and C3D8I)"),
              word("reduced", Formulation::reduced,
                   "fewer points: of quad4 and hex8 one, with hourglass control, of quad8 and "
                   "hex20 two along each axis (Abaqus' and CalculiX' elements whose names end in "
                   "R), of wedge6 two along its height (CalculiX' C3D6)"),
              word("beam", Formulation::beam,
                   "of hex20, whose first axis lies along a beam: two points along it, five by "
                   "five across (CalculiX' B32R)")})
      .otherwise("auto")
      .such_as("bbar");
}

BoundKeys<Section> section_keys() {
  using S = Section;
  const Spec kinematics =
      choice("How strains are measured.",
             {word("small", Kinematics::small, "linear in the displacements"),
              word("finite", Kinematics::finite, "exact for any displacement and rotation")})
          .otherwise_as("small for " + small_strain_materials() +
                        ", finite for the other materials")
          .such_as("finite");
  return {{need(&S::on, "on", set_or_sets("Set of area cells, in space of volume cells.", "block")),
           need(&S::material, "material", text("Name of a material.").such_as("steel")),
           need(&S::element, "element", section_element_spec()),
           may(&S::thickness, "thickness",
               number("Thickness of a plane body.")
                   .in("length")
                   .above(0)
                   .otherwise("1")
                   .such_as("2.5")),
           may(&S::kinematics, "kinematics", kinematics),
           may(&S::formulation, "formulation", formulation_spec()), orientation_key()}};
}

Section section_of(const Value& v, const std::vector<Material>& materials) {
  Section s = section_keys().read(v);
  const auto material = std::find_if(materials.begin(), materials.end(), [&](const Material& m) {
    return m.name.value == s.material.value;
  });
  if (material == materials.end()) {
    std::vector<std::string> known;
    for (const Material& m : materials) known.push_back(m.name.value);
    throw core::InputError(s.material.mark, core::unknown_name_message(
                                                "material", printable(s.material.value), known));
  }
  if (s.element.value == SectionElement::axisymmetric && v.at("thickness").given)
    throw core::InputError(s.thickness.mark, "an axisymmetric body has no thickness");
  if (is_space(s.element.value) && v.at("thickness").given)
    throw core::InputError(s.thickness.mark, "is for plane bodies; a body in space has its own");
  if (!v.find("kinematics")) s.kinematics = {usual_kinematics(material->law.value), v.mark};
  if (s.element.value == SectionElement::solid_shell && v.at("formulation").given)
    throw core::InputError(s.formulation.mark,
                           "solid_shell elements have a formulation of their own");
  require_kinematics(s, *material);
  return s;
}

}  // namespace

BoundKey<Description> sections_key() {
  return {
      optional("sections", list("Which cells of the mesh are bulk material, and of what kind.",
                                section_keys().spec("One section."))
                               .otherwise("[]")
                               .such_as("[{on: block, material: steel, element: plane_strain}]")),
      [](Description& d, const Value& v) {
        for (const Value& item : v.items) d.sections.push_back(section_of(item, d.materials));
      }};
}

}  // namespace osculate::deck
