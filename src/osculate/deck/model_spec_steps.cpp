#include "osculate/deck/description.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

Spec component_spec(std::string doc) {
  return choice(std::move(doc),
                {word("ux", Component::ux, "displacement in x"),
                 word("uy", Component::uy, "displacement in y"),
                 word("uz", Component::uz, "displacement in z (models in space)"),
                 word("rx", Component::rx, "rotation vector of a rigid body (models in space)"),
                 word("ry", Component::ry, "rotation vector of a rigid body (models in space)"),
                 word("rz", Component::rz, "rotation of a rigid body, positive from x to y")});
}

Key amplitude_key() {
  return optional("amplitude", text("Name of an amplitude that the values are multiplied with.")
                                   .otherwise_as("a linear ramp over the step")
                                   .such_as("there_and_back"));
}

Key on_key(std::string doc, const std::string& example) {
  return required("on", set_or_sets(std::move(doc), example));
}

struct Part {
  const char* name;
  const char* doc;
  const char* unit;
  const char* former = "";
};

/// A list of loads on sets: `on`, at least one component, `amplitude`.
Spec loads(std::string doc, const std::string& one, Key on, const std::vector<Part>& parts) {
  std::vector<Key> keys{std::move(on)};
  std::vector<std::string> components;
  for (const Part& part : parts) {
    keys.push_back(optional(part.name, number(part.doc).in(part.unit).such_as("-0.5")));
    keys.back().former = part.former;
    components.emplace_back(part.name);
  }
  keys.push_back(amplitude_key());
  return list(std::move(doc),
              map(one, std::move(keys)).with(Group::Rule::at_least_one, std::move(components)))
      .otherwise("[]");
}

Spec prescribe_spec() {
  return loads(
             "Displacements to prescribe; they persist until released or prescribed again.",
             "One prescription.", on_key("Set of nodes, or rigid body.", "top"),
             {{"ux", "Displacement in x at the end of the step.", "length"},
              {"uy", "Displacement in y at the end of the step.", "length"},
              {"uz", "Displacement in z at the end of the step (models in space).", "length"},
              {"rx",
               "First component of a rigid body's rotation vector at the end of the step (models "
               "in space).",
               "radians"},
              {"ry",
               "Second component of a rigid body's rotation vector at the end of the step (models "
               "in space).",
               "radians"},
              {"rz",
               "Rotation of a rigid body at the end of the step, positive from x to y; in space "
               "the third component of its rotation vector.",
               "radians"}})
      .such_as("[{on: top, ux: 0, uy: -0.007}]");
}

Spec release_spec() {
  return list("Prescribed displacements to set free.",
              map("One release.",
                  {on_key("Set of nodes, or rigid body.", "top"),
                   required("of", list("Which displacements.", component_spec("One displacement."))
                                      .count(1, component_count)
                                      .such_as("[ux]"))}))
      .otherwise("[]")
      .such_as("[{on: top, of: [ux]}]");
}

Spec forces_spec() {
  return loads(
             "Forces on every node of a set (n nodes carry n times as much: `total_force` is one "
             "force on all of them), or on a rigid body, whose motion they set free.",
             "One force.", on_key("Set of nodes, or rigid body.", "corner"),
             {{"fx", "Force in x at the end of the step.", "force"},
              {"fy", "Force in y at the end of the step.", "force"},
              {"fz", "Force in z at the end of the step (models in space).", "force"},
              {"mx",
               "Moment on a rigid body about an axis along x that is fixed in space, at the end of "
               "the step (models in space).",
               "force*length"},
              {"my",
               "Moment on a rigid body about an axis along y that is fixed in space, at the end of "
               "the step (models in space).",
               "force*length"},
              {"mz", "Moment on a rigid body at the end of the step, positive from x to y.",
               "force*length"}})
      .such_as("[{on: corner, fy: -3}]");
}

Spec total_force_spec() {
  return loads(
             "Forces in total, each shared out over a set: over boundary facets by their area, "
             "over "
             "bulk cells by their volume, over the nodes of any other set equally. Of constant "
             "direction; `osculate check` shows forces and moments of all loads.",
             "One force on a whole set.",
             on_key("Set of boundary facets, bulk cells, or nodes.", "top"),
             {{"fx", "Force in x at the end of the step.", "force"},
              {"fy", "Force in y at the end of the step.", "force"},
              {"fz", "Force in z at the end of the step (models in space).", "force"}})
      .such_as("[{on: top, fy: -3000}]");
}

Spec pressure_spec() {
  return list("Pressures on boundary facets; they follow the deformation of finite sections.",
              map("One pressure.",
                  {on_key("Set of boundary facets.", "top"),
                   required("value", number("Pressure at the end of the step, positive into the "
                                            "body.")
                                         .in("force/length^2")
                                         .such_as("12")),
                   amplitude_key()}))
      .otherwise("[]")
      .such_as("[{on: top, value: 12}]");
}

Spec traction_spec() {
  return loads(
             "Tractions on boundary facets, per undeformed area, of constant direction.",
             "One traction.", on_key("Set of boundary facets.", "top"),
             {{"tx", "Traction in x at the end of the step.", "force/length^2"},
              {"ty", "Traction in y at the end of the step.", "force/length^2"},
              {"tz", "Traction in z at the end of the step (models in space).", "force/length^2"}})
      .such_as("[{on: top, tx: 3}]");
}

Spec body_force_spec() {
  return loads("Forces per undeformed volume.", "One body force.",
               on_key("Set of bulk cells.", "block"),
               {{"fx", "Force per volume in x at the end of the step.", "force/length^3", "bx"},
                {"fy", "Force per volume in y at the end of the step.", "force/length^3", "by"},
                {"fz", "Force per volume in z at the end of the step (models in space).",
                 "force/length^3", "bz"}})
      .such_as("[{on: block, fy: -7.7e-5}]");
}

}  // namespace

Spec amplitudes_spec() {
  const Spec point = list("One point [t, factor].", number("Fraction of the step, or factor."))
                         .count(2, 2)
                         .such_as("[0.5, 1]");
  return names("Factors over the fraction t of a step, by name; straight between the points.",
               list("Points [t, factor], t increasing from 0 to 1.", point)
                   .count(1)
                   .such_as("[[0, 0], [0.5, 1], [1, 0]]"))
      .otherwise("{}")
      .such_as("{there_and_back: [[0, 0], [0.5, 1], [1, 0]]}");
}

Spec equations_spec() {
  const Spec term =
      map("One term of an equation.",
          {on_key("Set of nodes, of which each gets the factor, or rigid body.", "corner"),
           required("of", component_spec("Which displacement.").such_as("ux")),
           required("factor", number("Factor of the displacement.").such_as("-1"))});
  return list("Linear equations between displacements.",
              map("One equation: the terms sum up to the value.",
                  {required("terms", list("Terms that are summed up.", term).count(1)),
                   optional("value",
                            number("Value of the sum, reached at the end of the first step.")
                                .in("length")
                                .otherwise("0")
                                .such_as("0.1"))}))
      .otherwise("[]")
      .such_as("[{terms: [{on: A, of: ux, factor: 1}, {on: B, of: ux, factor: -1}]}]");
}

Spec equal_spec() {
  const Spec of = choice("Which displacement.",
                         {word("ux", Component::ux, "displacement in x"),
                          word("uy", Component::uy, "displacement in y"),
                          word("uz", Component::uz, "displacement in z (models in space)")})
                      .such_as("uy");
  return list("Sets whose nodes all share one displacement.",
              map("One shared displacement.", {on_key("Set of nodes.", "top"), required("of", of)}))
      .otherwise("[]")
      .such_as("[{on: top, of: uy}]");
}

Spec steps_spec() {
  return list(
             "What happens, in order. Values are totals at the end of a step, ramped from those of "
             "the last step; everything persists until it is released or changed.",
             map("One step.",
                 {required("name", text("Name of the step.").as(TextRule::name).such_as("press")),
                  required("increments", integer("Number of equal increments to begin with.")
                                             .at_least(1)
                                             .at_most(1'000'000)
                                             .such_as("10")),
                  optional("duration", number("Time from the beginning of the step to its end; "
                                              "inertia and friction that depends on speed ask for "
                                              "it.")
                                           .in("time")
                                           .above(0)
                                           .otherwise_as("no time")
                                           .such_as("0.5")),
                  optional("prescribe", prescribe_spec()), optional("release", release_spec()),
                  optional("forces", forces_spec()), optional("total_force", total_force_spec()),
                  optional("pressure", pressure_spec()), optional("traction", traction_spec()),
                  optional("body_force", body_force_spec()), optional("gravity", gravity_spec()),
                  optional("dynamics", dynamics_spec())}))
      .count(1)
      .such_as("[{name: press, increments: 10, prescribe: [{on: top, uy: -0.007}]}]");
}

}  // namespace osculate::deck
