#include "osculate/deck/model_spec.hpp"

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
