#include <fmt/format.h>

#include "osculate/deck/bind.hpp"
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

std::vector<Release> releases_of(const Value& v) {
  std::vector<Release> out;
  for (const Value& item : v.items) {
    Release release{item.mark, name_of(item.at("on")), {}};
    for (const Value& component : item.at("of").items) {
      bool& slot = release.of[static_cast<std::size_t>(component.code)];
      if (slot) throw core::InputError(component.mark, quoted(component.text) + " is given twice");
      slot = true;
    }
    out.push_back(std::move(release));
  }
  return out;
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

/// A list of loads on sets: `on`, at least one component, `amplitude`; and where it goes.
BoundKey<Step> loads(std::vector<Load> Step::*member, const char* name, const char* example,
                     std::string doc, const std::string& one, Key on,
                     const std::vector<Part>& parts) {
  std::vector<Key> keys{std::move(on)};
  std::vector<std::string> components;
  for (const Part& part : parts) {
    keys.push_back(optional(part.name, number(part.doc).in(part.unit).such_as("-0.5")));
    keys.back().former = part.former;
    components.emplace_back(part.name);
  }
  keys.push_back(amplitude_key());
  Spec spec =
      list(std::move(doc), map(one, std::move(keys)).with(Group::Rule::at_least_one, components))
          .otherwise("[]")
          .such_as(example);
  return {optional(name, std::move(spec)),
          [member, components](Step& s, const Value& v) { s.*member = loads_of(v, components); }};
}

BoundKey<Step> prescribe_key() {
  return loads(
      &Step::prescribe, "prescribe", "[{on: top, ux: 0, uy: -0.007}]",
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
        "radians"}});
}

BoundKey<Step> release_key() {
  Spec spec =
      list("Prescribed displacements to set free.",
           map("One release.",
               {on_key("Set of nodes, or rigid body.", "top"),
                required("of", list("Which displacements.", component_spec("One displacement."))
                                   .count(1, component_count)
                                   .such_as("[ux]"))}))
          .otherwise("[]")
          .such_as("[{on: top, of: [ux]}]");
  return {optional("release", std::move(spec)),
          [](Step& s, const Value& v) { s.release = releases_of(v); }};
}

BoundKey<Step> forces_key() {
  return loads(
      &Step::forces, "forces", "[{on: corner, fy: -3}]",
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
        "force*length"}});
}

BoundKey<Step> total_force_key() {
  return loads(&Step::total_force, "total_force", "[{on: top, fy: -3000}]",
               "Forces in total, each shared out over a set: over boundary facets by their area, "
               "over "
               "bulk cells by their volume, over the nodes of any other set equally. Of constant "
               "direction; `osculate check` shows forces and moments of all loads.",
               "One force on a whole set.",
               on_key("Set of boundary facets, bulk cells, or nodes.", "top"),
               {{"fx", "Force in x at the end of the step.", "force"},
                {"fy", "Force in y at the end of the step.", "force"},
                {"fz", "Force in z at the end of the step (models in space).", "force"}});
}

BoundKey<Step> pressure_key() {
  Spec spec =
      list("Pressures on boundary facets; they follow the deformation of finite sections.",
           map("One pressure.",
               {on_key("Set of boundary facets.", "top"),
                required("value", number("Pressure at the end of the step, positive into the "
                                         "body.")
                                      .in("force/length^2")
                                      .such_as("12")),
                amplitude_key()}))
          .otherwise("[]")
          .such_as("[{on: top, value: 12}]");
  return {optional("pressure", std::move(spec)),
          [](Step& s, const Value& v) { s.pressure = loads_of(v, {"value"}); }};
}

BoundKey<Step> traction_key() {
  return loads(
      &Step::traction, "traction", "[{on: top, tx: 3}]",
      "Tractions on boundary facets, per undeformed area, of constant direction.", "One traction.",
      on_key("Set of boundary facets.", "top"),
      {{"tx", "Traction in x at the end of the step.", "force/length^2"},
       {"ty", "Traction in y at the end of the step.", "force/length^2"},
       {"tz", "Traction in z at the end of the step (models in space).", "force/length^2"}});
}

BoundKey<Step> body_force_key() {
  return loads(&Step::body_force, "body_force", "[{on: block, fy: -7.7e-5}]",
               "Forces per undeformed volume.", "One body force.",
               on_key("Set of bulk cells.", "block"),
               {{"fx", "Force per volume in x at the end of the step.", "force/length^3", "bx"},
                {"fy", "Force per volume in y at the end of the step.", "force/length^3", "by"},
                {"fz", "Force per volume in z at the end of the step (models in space).",
                 "force/length^3", "bz"}});
}

BoundKeys<Step> step_keys() {
  using S = Step;
  return {{need(&S::name, "name", text("Name of the step.").as(TextRule::name).such_as("press")),
           need(&S::increments, "increments",
                integer("Number of equal increments to begin with.")
                    .at_least(1)
                    .at_most(1'000'000)
                    .such_as("10")),
           may(&S::duration, "duration",
               number("Time from the beginning of the step to its end; "
                      "inertia and friction that depends on speed ask for "
                      "it.")
                   .in("time")
                   .above(0)
                   .otherwise_as("no time")
                   .such_as("0.5")),
           prescribe_key(),
           release_key(),
           forces_key(),
           total_force_key(),
           pressure_key(),
           traction_key(),
           body_force_key(),
           may(&S::gravity, "gravity", gravity_spec()),
           {optional("dynamics", dynamics_spec()),
            [](S& s, const Value& v) { s.dynamics = parse_dynamics(v); }}}};
}

void check_times(const Step& s) {
  if (s.dynamics && !s.duration)
    throw core::InputError(s.dynamics->mark, "a step with inertia needs a duration");
  if (!s.dynamics || !s.dynamics->time_steps || !s.dynamics->time_steps->smallest) return;
  const Number& smallest = *s.dynamics->time_steps->smallest;
  const double nominal = s.duration->value / s.increments.value;
  if (smallest.value > nominal)
    throw core::InputError(
        smallest.mark,
        fmt::format("must be at most a nominal increment, duration / increments = {:g}, got {:g}",
                    nominal, smallest.value));
}

BoundKeys<EquationTerm> term_keys() {
  using T = EquationTerm;
  return {{{on_key("Set of nodes, of which each gets the factor, or rigid body.", "corner"),
            [](T& t, const Value& v) { store(t.on, v); }},
           need(&T::of, "of", component_spec("Which displacement.").such_as("ux")),
           {required("factor", number("Factor of the displacement.").such_as("-1")),
            [](T& t, const Value& v) {
              if (v.number == 0) throw core::InputError(v.mark, "must not be zero");
              store(t.factor, v);
            }}}};
}

BoundKeys<Equation> equation_keys() {
  using E = Equation;
  const BoundKeys<EquationTerm> term = term_keys();
  return {
      {{required("terms",
                 list("Terms that are summed up.", term.spec("One term of an equation.")).count(1)),
        [term](E& e, const Value& v) {
          for (const Value& item : v.items) e.terms.push_back(term.read(item));
        }},
       may(&E::value, "value",
           number("Value of the sum, reached at the end of the first step.")
               .in("length")
               .otherwise("0")
               .such_as("0.1"))}};
}

Amplitude amplitude_of(const ValueEntry& entry) {
  Amplitude amplitude;
  amplitude.name = {entry.key, entry.key_mark};
  for (const Value& point : entry.value.items) {
    const Value& t = point.items[0];
    if (!(t.number >= 0 && t.number <= 1))
      throw core::InputError(t.mark,
                             "the fraction of the step must be >= 0 and <= 1, got " + t.text);
    if (!amplitude.points.empty() && !(t.number > amplitude.points.back().first))
      throw core::InputError(t.mark, fmt::format("fractions must increase, got {} after {}", t.text,
                                                 amplitude.points.back().first));
    amplitude.points.emplace_back(t.number, point.items[1].number);
  }
  return amplitude;
}

}  // namespace

std::vector<Load> loads_of(const Value& v, const std::vector<std::string>& names) {
  std::vector<Load> out;
  for (const Value& item : v.items) {
    Load load;
    load.mark = item.mark;
    load.on = name_of(item.at("on"));
    for (std::size_t i = 0; i < names.size(); ++i) load.values[i] = number_if(item, names[i]);
    load.amplitude = name_if(item, "amplitude");
    out.push_back(std::move(load));
  }
  return out;
}

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
  return list("Linear equations between displacements.",
              equation_keys().spec("One equation: the terms sum up to the value."))
      .otherwise("[]")
      .such_as("[{terms: [{on: A, of: ux, factor: 1}, {on: B, of: ux, factor: -1}]}]");
}

std::vector<Equation> parse_equations(const Value& v) {
  const BoundKeys<Equation> keys = equation_keys();
  std::vector<Equation> out;
  for (const Value& item : v.items) {
    out.push_back(keys.read(item));
    out.back().mark = item.mark;
  }
  return out;
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
             step_keys().spec("One step."))
      .count(1)
      .such_as("[{name: press, increments: 10, prescribe: [{on: top, uy: -0.007}]}]");
}

std::vector<Step> parse_steps(const Value& v) {
  const BoundKeys<Step> keys = step_keys();
  std::vector<Step> out;
  for (const Value& item : v.items) {
    out.push_back(keys.read(item));
    check_times(out.back());
  }
  return out;
}

std::vector<Amplitude> parse_amplitudes(const Value& v) {
  std::vector<Amplitude> out;
  for (const ValueEntry& entry : v.entries) out.push_back(amplitude_of(entry));
  return out;
}

std::vector<Equal> parse_equal(const Value& v) {
  std::vector<Equal> out;
  for (const Value& item : v.items)
    out.push_back({item.mark, name_of(item.at("on")), word_of<Component>(item, "of").value});
  return out;
}

}  // namespace osculate::deck
