#include "osculate/deck/model_spec.hpp"

#include <fmt/format.h>

#include "osculate/core/text.hpp"
#include "osculate/deck/description.hpp"

namespace osculate::deck {
Spec point_spec(std::string doc) {
  return list(std::move(doc), number("One coordinate.").in("length")).count(2, 2).such_as("[0, 1]");
}

Spec place_spec(std::string doc) {
  return list(std::move(doc), number("One coordinate.").in("length")).count(3, 3);
}

Spec points_spec(std::string doc, std::size_t least) {
  return list(std::move(doc), point_spec("One point [x, y]."))
      .count(least)
      .such_as("[[0, 0], [4, 0], [4, 1]]");
}

Spec set_or_sets(std::string doc, const std::string& example) {
  return either(std::move(doc), {text("Its name.").such_as(example),
                                 list("Names of several, which count as one set.",
                                      text("One name.").such_as(example))
                                     .count(1)})
      .such_as(example);
}

Spec parameters_spec() {
  return names(
             "Numbers and texts, by name. A value anywhere else that begins with = is computed "
             "from them (=2*length + 1, with + - * / and brackets; =name for a text), ${name} "
             "stands for one within a text. `--set NAME=VALUE` of a command replaces a value.",
             text("A number, a text, or = and how it follows from those above.").such_as("12.5"))
      .otherwise("{}")
      .such_as("{length: 20, radius: =length/4}");
}

Spec sets_spec() {
  const Spec one =
      map("A set made of others, of the mesh or defined above it. Sets of cells of one kind give "
          "such a set; in other cases the result is a set of nodes.",
          {optional("union", list("Sets of which it has all.", text("One set.").such_as("left"))
                                 .count(1)
                                 .such_as("[left, right]")),
           optional("of", text("The set that it is a part of.").such_as("top")),
           optional("within",
                    set_or_sets("Set, or list of sets: only what is in it, too.", "left")),
           optional("without",
                    set_or_sets("Set, or list of sets: what is in it is left out.", "rim"))})
          .with(Group::Rule::exactly_one, {"union", "of"})
          .such_as("{union: [left, right]}");
  return names("Sets made of sets, by name, used as those of the mesh.", one)
      .otherwise("{}")
      .such_as("{sides: {union: [left, right]}, rest: {of: top, without: rim}}");
}

Spec sections_spec() {
  const Spec element =
      choice(
          "Which plane the body lives in, or that it is one in space. All sections of a model are "
          "plane, all axisymmetric, or all in space.",
          {word("plane_strain", SectionElement::plane_strain, "no strain out of the plane"),
           word("plane_stress", SectionElement::plane_stress, "no stress out of the plane"),
           word("axisymmetric", SectionElement::axisymmetric,
                "x is the radius, y the axis; forces are those of the whole circumference"),
           word("solid", SectionElement::solid, "a body in space, of volume cells"),
           word("solid_shell", SectionElement::solid_shell,
                "a thin body in space, of hex8 or shell18 cells; the thickness goes from the first "
                "half of their nodes to the second, and hex8 cells in one layer are turned so. "
                "hex27 cells (of a second-order Gmsh mesh) become shell18: their nodes halfway "
                "through the thickness are left out")})
          .or_else("; shells, beams and others are not available (osculate doc limits)")
          .such_as("plane_strain");
  const Spec kinematics =
      choice("How strains are measured.",
             {word("small", Kinematics::small, "linear in the displacements"),
              word("finite", Kinematics::finite, "exact for any displacement and rotation")})
          .otherwise_as("small for " + small_strain_materials() +
                        ", finite for the other materials")
          .such_as("finite");
  const Spec formulation =
      choice(
          "How first-order quadrilaterals and hexahedra avoid locking; all other cells are plain "
          "displacement elements.",
          {word("auto", Formulation::automatic,
                "enhanced; of neo_hooke, where enhanced strains are unstable in large compression, "
                "and of " +
                    remembering_materials() +
                    ", where they hardly converge without hardening, bbar, in plane stress full"),
           word("full", Formulation::full,
                "plain displacement element, full integration: too stiff in bending and near "
                "nu = 0.5 (CalculiX' C3D8, Abaqus' CPS4; Abaqus' C3D8 is bbar)"),
           word("bbar", Formulation::bbar,
                "averaged volume change, for nearly incompressible (Abaqus' CPE4, CAX4 and "
                "C3D8)"),
           word("enhanced", Formulation::enhanced,
                "enhanced strains, for bending and nearly incompressible (CalculiX' C3D8I, "
                "Abaqus' CPS4I, CPE4I, CAX4I and C3D8I)")})
          .otherwise("auto")
          .such_as("bbar");
  return list("Which cells of the mesh are bulk material, and of what kind.",
              map("One section.",
                  {required("on",
                            set_or_sets("Set of area cells, in space of volume cells.", "block")),
                   required("material", text("Name of a material.").such_as("steel")),
                   required("element", element),
                   optional("thickness", number("Thickness of a plane body.")
                                             .in("length")
                                             .above(0)
                                             .otherwise("1")
                                             .such_as("2.5")),
                   optional("kinematics", kinematics), optional("formulation", formulation)}))
      .otherwise("[]")
      .such_as("[{on: block, material: steel, element: plane_strain}]");
}

Spec model_spec() {
  return map(
      "A model of Osculate. All quantities are in one consistent system of units.",
      {required("osculate",
                integer("Version of the model file's format.").at_least(1).at_most(1).such_as("1")),
       optional(
           "title",
           text("What is computed; heads the report.").such_as("Block pressed on a rigid base")),
       optional("parameters", parameters_spec()), required("mesh", mesh_spec()),
       optional("sets", sets_spec()), optional("materials", materials_spec()),
       optional("sections", sections_spec()), optional("rigid", rigid_spec()),
       optional("contact", contact_spec()), optional("amplitudes", amplitudes_spec()),
       optional("equations", equations_spec()), optional("equal", equal_spec()),
       optional("initial_velocity", initial_velocity_spec()), required("steps", steps_spec()),
       optional("solver", solver_spec()), optional("output", output_spec())});
}

}  // namespace osculate::deck
