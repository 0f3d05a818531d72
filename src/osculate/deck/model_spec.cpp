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

namespace {

Spec parameters_spec() {
  return names(
             "Numbers and texts, by name. A value anywhere else that begins with = is computed "
             "from them (=2*length + 1, with + - * / and brackets; =name for a text), ${name} "
             "stands for one within a text. `--set NAME=VALUE` of a command replaces a value.",
             text("A number, a text, or = and how it follows from those above.").such_as("12.5"))
      .otherwise("{}")
      .such_as("{length: 20, radius: =length/4}");
}

}  // namespace

BoundKeys<Description> model_keys() {
  using D = Description;
  std::vector<BoundKey<D>> keys{
      unread<D>(required(
          "osculate",
          integer("Version of the model file's format.").at_least(1).at_most(1).such_as("1"))),
      may(&D::title, "title",
          text("What is computed; heads the report.").such_as("Block pressed on a rigid base")),
      unread<D>(optional("parameters", parameters_spec())),
      mesh_key(),
      sets_key(),
      materials_key(),
      sections_key(),
      rigid_key(),
      contact_key(),
      amplitudes_key(),
      axes_key(),
      equations_key(),
      equal_key()};
  for (BoundKey<D>& key : constraint_keys()) keys.push_back(std::move(key));
  for (BoundKey<D>& key : spring_keys()) keys.push_back(std::move(key));
  for (BoundKey<D> key : {initial_velocity_key(), initial_temperature_key()})
    keys.push_back(std::move(key));
  for (BoundKey<D>& key : initial_state_keys()) keys.push_back(std::move(key));
  for (BoundKey<D> key : {steps_key(), solver_key(), output_key()}) keys.push_back(std::move(key));
  return {std::move(keys)};
}

Spec model_spec(const BoundKeys<Description>& keys) {
  return keys.spec("A model of Osculate. All quantities are in one consistent system of units.");
}
Spec model_spec() { return model_spec(model_keys()); }

}  // namespace osculate::deck
