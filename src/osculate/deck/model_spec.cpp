#include "osculate/deck/model_spec.hpp"

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

Spec materials_spec() {
  const auto constants = [](std::string doc) {
    return map(std::move(doc), {required("E", number("Young's modulus of the unloaded material.")
                                                  .in("force/length^2")
                                                  .above(0)
                                                  .such_as("2.1e5")),
                                required("nu", number("Poisson's ratio of the unloaded material.")
                                                   .above(-1)
                                                   .below(0.5)
                                                   .such_as("0.3")),
                                optional("density", number("Mass per reference volume.")
                                                        .in("mass/length^3")
                                                        .at_least(0)
                                                        .otherwise("0")
                                                        .such_as("7.85e-9"))});
  };
  const Spec law =
      map("A material: exactly one law.",
          {optional("linear_elastic", constants("Hooke's law between stress and small strain.")),
           optional(
               "st_venant_kirchhoff",
               constants("Hooke's law between second Piola-Kirchhoff stress and Green-Lagrange "
                         "strain, for large rotations.")),
           optional("neo_hooke", constants("Compressible neo-Hookean solid, for large strains."))})
          .with(Group::Rule::exactly_one, {"linear_elastic", "st_venant_kirchhoff", "neo_hooke"})
          .such_as("{linear_elastic: {E: 2.1e5, nu: 0.3}}");
  return names("The materials, by name.", law)
      .otherwise("{}")
      .such_as("{steel: {linear_elastic: {E: 2.1e5, nu: 0.3}}}");
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
                "half of their nodes to the second, and hex8 cells in one layer are turned so")})
          .such_as("plane_strain");
  const Spec kinematics =
      choice("How strains are measured.",
             {word("small", Kinematics::small, "linear in the displacements"),
              word("finite", Kinematics::finite, "exact for any displacement and rotation")})
          .otherwise_as("small for linear_elastic, finite for the other materials")
          .such_as("finite");
  const Spec formulation =
      choice("How the element avoids locking.",
             {word("full", Formulation::full, "plain displacement element, full integration"),
              word("bbar", Formulation::bbar, "averaged volume change, for nearly incompressible"),
              word("enhanced", Formulation::enhanced, "enhanced strains, for bending")})
          .otherwise("full")
          .such_as("bbar");
  return list("Which cells of the mesh are bulk material, and of what kind.",
              map("One section.",
                  {required("on",
                            text("Set of area cells, in space of volume cells.").such_as("block")),
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
       required("mesh", mesh_spec()), optional("materials", materials_spec()),
       optional("sections", sections_spec()), optional("rigid", rigid_spec()),
       optional("contact", contact_spec()), optional("amplitudes", amplitudes_spec()),
       optional("equations", equations_spec()), optional("equal", equal_spec()),
       optional("initial_velocity", initial_velocity_spec()), required("steps", steps_spec()),
       optional("solver", solver_spec()), optional("output", output_spec())});
}

}  // namespace osculate::deck
