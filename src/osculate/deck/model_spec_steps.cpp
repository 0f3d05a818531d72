#include <fmt/format.h>

#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
Spec component_spec(std::string doc) {
  return choice(std::move(doc),
                {word("ux", Component::ux, "displacement in x"),
                 word("uy", Component::uy, "displacement in y"),
                 word("uz", Component::uz, "displacement in z (models in space)"),
                 word("rx", Component::rx, "rotation vector of a rigid body (models in space)"),
                 word("ry", Component::ry, "rotation vector of a rigid body (models in space)"),
                 word("rz", Component::rz, "rotation of a rigid body, positive from x to y")});
}

namespace {

BoundKey<Load> amplitude_key() {
  return may(&Load::amplitude, "amplitude",
             text("Name of an amplitude that the values are multiplied with.")
                 .otherwise_as("a linear ramp over the step")
                 .such_as("there_and_back"));
}

BoundKey<Load> phase_key() {
  return may(&Load::phase, "phase",
             number("By how much it goes ahead, in steps with `harmonic`: 90 is an imaginary one.")
                 .in("degrees")
                 .otherwise_as("0")
                 .such_as("90"));
}

struct Part {
  const char* name;
  const char* doc;
  const char* unit;
  const char* former = "";
};

/// `on`, and components in the order of the values.
std::vector<BoundKey<Load>> load_keys(BoundKey<Load> on, const std::vector<Part>& parts,
                                      const char* example) {
  std::vector<BoundKey<Load>> keys{std::move(on)};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    keys.push_back({optional(part.name, number(part.doc).in(part.unit).such_as(example)),
                    [i](Load& load, const Value& v) { store(load.values[i], v); }});
    keys.back().key.former = part.former;
  }
  return keys;
}

/// A list of them with at least one component each.
Spec loads_spec(std::string doc, std::string one, const BoundKeys<Load>& keys,
                const std::vector<Part>& parts) {
  std::vector<std::string> components;
  for (const Part& part : parts) components.emplace_back(part.name);
  return list(std::move(doc), keys.spec(std::move(one)).with(Group::Rule::at_least_one, components))
      .otherwise("[]");
}

/// A list of loads that may have an amplitude, and where it goes.
BoundKey<Step> loads(std::vector<Load> Step::*member, const char* name, const char* example,
                     std::string doc, std::string one, BoundKey<Load> on,
                     const std::vector<Part>& parts) {
  std::vector<BoundKey<Load>> all = load_keys(std::move(on), parts, "-0.5");
  all.push_back(amplitude_key());
  all.push_back(phase_key());
  const BoundKeys<Load> keys(std::move(all));
  return {optional(name, loads_spec(std::move(doc), std::move(one), keys, parts).such_as(example)),
          [member, keys](Step& s, const Value& v) { s.*member = keys.read_all(v); }};
}

BoundKey<Step> prescribe_key() {
  return loads(
      &Step::prescribe, "prescribe", "[{on: top, ux: 0, uy: -0.007}]",
      "Displacements to prescribe; they persist until released or prescribed again.",
      "One prescription.", on_key<Load>("Set of nodes, or rigid body.", "top"),
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

}  // namespace

BoundKeys<Release> displacements_of(std::string doc) {
  using R = Release;
  return {{on_key<R>(std::move(doc), "top"),
           {required("of", list("Which displacements.", component_spec("One displacement."))
                               .count(1, component_count)
                               .such_as("[ux]")),
            [](R& release, const Value& v) {
              for (const Value& item : v.items) {
                bool& slot = release.of[static_cast<std::size_t>(item.code)];
                if (slot) throw core::InputError(item.mark, quoted(item.text) + " is given twice");
                slot = true;
              }
            }}}};
}

namespace {

BoundKey<Step> release_key() {
  const BoundKeys<Release> keys = displacements_of("Set of nodes, or rigid body.");
  return {
      optional("release", list("Prescribed displacements to set free.", keys.spec("One release."))
                              .otherwise("[]")
                              .such_as("[{on: top, of: [ux]}]")),
      [keys](Step& s, const Value& v) { s.release = keys.read_all(v); }};
}

BoundKey<Step> hold_key() {
  const BoundKeys<Release> keys = displacements_of("Set of nodes, or rigid body.");
  return {optional("hold", list("Displacements that stay, until they are released or prescribed, "
                                "where they are when the step begins.",
                                keys.spec("What is held."))
                               .otherwise("[]")
                               .such_as("[{on: top, of: [ux]}]")),
          [keys](Step& s, const Value& v) { s.hold = keys.read_all(v); }};
}

BoundKey<Step> forces_key() {
  return loads(
      &Step::forces, "forces", "[{on: corner, fy: -3}]",
      "Forces on every node of a set (n nodes carry n times as much: `total_force` is one "
      "force on all of them), or on a rigid body, whose motion they set free (forces on its nodes "
      "do not).",
      "One force.", on_key<Load>("Set of nodes, or rigid body.", "corner"),
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
               on_key<Load>("Set of boundary facets, bulk cells, or nodes.", "top"),
               {{"fx", "Force in x at the end of the step.", "force"},
                {"fy", "Force in y at the end of the step.", "force"},
                {"fz", "Force in z at the end of the step (models in space).", "force"}});
}

BoundKey<Step> pressure_key() {
  const BoundKeys<Load> keys(
      {on_key<Load>("Set of boundary facets.", "top"),
       {required("value", number("Pressure at the end of the step, positive into the "
                                 "body.")
                              .in("force/length^2")
                              .such_as("12")),
        [](Load& load, const Value& v) { store(load.values[0], v); }},
       amplitude_key(),
       phase_key()});
  return {
      optional("pressure",
               list("Pressures on boundary facets; they follow the deformation of finite sections.",
                    keys.spec("One pressure."))
                   .otherwise("[]")
                   .such_as("[{on: top, value: 12}]")),
      [keys](Step& s, const Value& v) { s.pressure = keys.read_all(v); }};
}

/// `on`, `value` and gradients: temperatures, of a step with an amplitude.
BoundKeys<Load> temperature_keys(bool of_step) {
  std::vector<BoundKey<Load>> keys{
      on_key<Load>("Set, of whose nodes it is.", "block"),
      {required("value", number(of_step ? "Temperature at the end of the step."
                                        : "Temperature at the beginning, free of strain.")
                             .in("temperature")
                             .such_as("80")),
       [](Load& load, const Value& v) { store(load.values[0], v); }},
      {optional("gradient", number("Of shells and beams of an input file: how the temperature "
                                   "rises along the normal, of beams along their second axis.")
                                .in("temperature/length")
                                .otherwise("0")
                                .such_as("5")),
       [](Load& load, const Value& v) { store(load.values[1], v); }},
      {optional("gradient_1", number("Of beams of an input file: how the temperature rises along "
                                     "their first axis.")
                                  .in("temperature/length")
                                  .otherwise("0")
                                  .such_as("5")),
       [](Load& load, const Value& v) { store(load.values[2], v); }}};
  if (of_step) keys.push_back(amplitude_key());
  return keys;
}
BoundKey<Step> temperature_key() {
  return {optional("temperature",
                   list("Temperatures of nodes, for materials with an `expansion`; of a node in "
                        "several sets the last counts.",
                        temperature_keys(true).spec("One temperature."))
                       .otherwise("[]")
                       .such_as("[{on: block, value: 80}]")),
          [](Step& s, const Value& v) { s.temperature = temperature_keys(true).read_all(v); }};
}

BoundKey<Step> traction_key() {
  return loads(
      &Step::traction, "traction", "[{on: top, tx: 3}]",
      "Tractions on boundary facets, per undeformed area, of constant direction.", "One traction.",
      on_key<Load>("Set of boundary facets.", "top"),
      {{"tx", "Traction in x at the end of the step.", "force/length^2"},
       {"ty", "Traction in y at the end of the step.", "force/length^2"},
       {"tz", "Traction in z at the end of the step (models in space).", "force/length^2"}});
}

BoundKey<Step> body_force_key() {
  return loads(&Step::body_force, "body_force", "[{on: block, fy: -7.7e-5}]",
               "Forces per undeformed volume.", "One body force.",
               on_key<Load>("Set of bulk cells.", "block"),
               {{"fx", "Force per volume in x at the end of the step.", "force/length^3", "bx"},
                {"fy", "Force per volume in y at the end of the step.", "force/length^3", "by"},
                {"fz", "Force per volume in z at the end of the step (models in space).",
                 "force/length^3", "bz"}});
}

BoundKey<Step> centrifugal_key() {
  const auto place = [](std::string doc, std::string otherwise) {
    return list(std::move(doc), number("One coordinate.").in("length"))
        .count(2, 3)
        .otherwise(std::move(otherwise));
  };
  const BoundKeys<Load> keys(
      {on_key<Load>("Set of bulk cells, whose material has a density, or of nodes with `masses`.",
                    "disc"),
       {required("speed_squared", number("Square of the angular velocity at the end of the step.")
                                      .in("radians^2/time^2")
                                      .at_least(0)
                                      .such_as("1e6")),
        [](Load& load, const Value& v) { store(load.values[0], v); }},
       may(&Load::from, "from", place("A point of the axis.", "[0, 0, 0]")),
       {optional("to", place("Another one.", "[0, 0, 1]")),
        [](Load& load, const Value& v) { load.to = place_of(v); }},
       may(&Load::places, "places",
           choice("Where they act.",
                  {word("automatic", LoadPlacesWord::automatic,
                        "where bodies of finite strain are, at the undeformed places of others; "
                        "where all are in vibrations about a state"),
                   word("deformed", LoadPlacesWord::deformed, "where bodies are"),
                   word("undeformed", LoadPlacesWord::undeformed, "where they were at first")})
               .otherwise("automatic")
               .such_as("deformed")),
       amplitude_key(),
       phase_key()});
  return {optional("centrifugal", list("Centrifugal forces of bodies that turn about an axis.",
                                       keys.spec("One centrifugal load."))
                                      .otherwise("[]")
                                      .such_as("[{on: disc, speed_squared: 1e6}]")),
          [keys](Step& s, const Value& v) { s.centrifugal = keys.read_all(v); }};
}

BoundKey<Step> modes_key() {
  using S = Step;
  const auto count = [](std::string doc) {
    return integer(std::move(doc)).at_least(1).at_most(10'000).such_as("10");
  };
  const BoundKeys<S> keys(
      {need(&S::modes, "count", count("So many.")),
       may(&S::about, "about",
           choice(
               "The state they are about.",
               {word("last", ModesAbout::last, "the one that the steps before led to"),
                word("start", ModesAbout::start, "the one before the first step, without loads")})
               .otherwise("last")
               .such_as("start")),
       may(&S::lowest, "from",
           number("Lowest frequency that MODEL.dat and MODEL.frd list (not of sectors of rings), "
                  "with the "
                  "numbers that the vibrations have; so many are found all the same.")
               .in("1/time")
               .at_least(0)
               .otherwise_as("all")
               .such_as("0.01")),
       may(&S::highest, "to",
           number("Highest one.").in("1/time").above(0).otherwise_as("all").such_as("1e6")),
       {optional("diameters",
                 list("Of a sector of a ring with `cyclic_symmetry`: nodal diameters, for each of "
                      "which so many vibrations are looked for. From 0, all sectors alike, to half "
                      "of the sectors; between these they come in pairs, cosine and sine.",
                      integer("One number of them.").at_least(0).at_most(10'000))
                     .count(1)
                     .such_as("[0, 1, 2]")),
        [](S& s, const Value& v) {
          for (const Value& item : v.items)
            s.diameters.push_back(Marked<int>{item.code, item.mark});
        }}});
  Spec spec = either(
                  "So many free vibrations, the slowest first, about the state that the steps "
                  "before led to; nothing else happens in the step. Closed contacts stay "
                  "closed, and stick if they have friction.",
                  {count("So many."), keys.spec("How many, and about which state.")})
                  .such_as("10");
  return {optional("modes", std::move(spec)), [keys](S& s, const Value& v) {
            if (v.alternative == 1) return keys.read(v, s);
            s.modes = Marked<int>{v.code, v.mark};
          }};
}

BoundKeys<Step> step_keys() {
  using S = Step;
  std::vector<BoundKey<S>> keys{
      need(&S::name, "name", text("Name of the step.").as(TextRule::name).such_as("press")),
      may(&S::increments, "increments",
          integer("Number of equal increments to begin with, which are cut where they must be "
                  "and grow again; 1 where none is given, but steps with `dynamics` or "
                  "`modal` need it.")
              .at_least(1)
              .at_most(1'000'000)
              .such_as("10")),
      modes_key(),
      buckling_key(),
      prescribe_key(),
      release_key(),
      hold_key(),
      forces_key(),
      total_force_key(),
      pressure_key(),
      traction_key(),
      body_force_key(),
      temperature_key(),
      centrifugal_key(),
      may(&S::gravity, "gravity", gravity_spec()),
      contact_changes_key(),
      {optional("dynamics", dynamics_spec()),
       [](S& s, const Value& v) { s.dynamics = parse_dynamics(v); }},
      modal_key(),
      harmonic_key()};
  for (auto* const more : {time_keys, body_change_keys})
    for (BoundKey<S>& key : more()) keys.push_back(std::move(key));
  return {std::move(keys)};
}

/// Either increments, or modes and nothing that moves.
void check_modes(const Value& v, Step& s) {
  if (s.modes) {
    for (const ValueEntry& entry : v.entries)
      if (entry.value.given && entry.key != "name" && entry.key != "modes" &&
          entry.key != "contact" && entry.key != "release" && entry.key != "prescribe")
        throw core::InputError(entry.key_mark,
                               "a step with `modes` moves nothing: only its name, `prescribe` "
                               "(where it is held), `release` and `contact` go with it");
    for (const Prescription& p : s.prescribe)
      for (const std::optional<Number>& value : p.values)
        if (value && value->value != 0)
          throw core::InputError(value->mark,
                                 "a step with `modes` moves nothing: what it holds is prescribed "
                                 "as 0 and stays where it is");
    s.increments = {1, s.modes->mark};
  } else if (s.harmonic) {
    s.increments = {1, s.harmonic->mark};
  } else if (s.increments.value == 0) {
    if (s.dynamics || s.modal)
      throw core::InputError(v.mark, "required key 'increments' is missing");
    s.increments = {1, v.mark};
  }
}

void check_times(const Value&, const Step& s) {
  if ((s.dynamics || s.modal) && !s.duration)
    throw core::InputError(s.dynamics ? s.dynamics->mark : s.modal->mark,
                           "a step with inertia needs a duration");
  if (!s.dynamics || !s.dynamics->time_steps || !s.dynamics->time_steps->smallest) return;
  const Number& smallest = *s.dynamics->time_steps->smallest;
  const double nominal = s.duration->value / s.increments.value;
  if (smallest.value > nominal)
    throw core::InputError(
        smallest.mark,
        fmt::format("must be at most a nominal increment, duration / increments = {:g}, got {:g}",
                    nominal, smallest.value));
}

/// Velocities at the beginning: `on`, and components.
const std::vector<Part>& velocity_parts() {
  static const std::vector<Part> parts{
      {"vx", "Velocity in x.", "length/time"},
      {"vy", "Velocity in y.", "length/time"},
      {"vz", "Velocity in z (models in space).", "length/time"},
      {"wx", "Angular velocity of a rigid body, x (models in space).", "radians/time"},
      {"wy", "Angular velocity of a rigid body, y (models in space).", "radians/time"},
      {"wz", "Angular velocity of a rigid body, positive from x to y.", "radians/time"}};
  return parts;
}
BoundKeys<Load> velocity_keys() {
  return load_keys(
      need(&Load::on, "on", text("Set of nodes or cells, or rigid body.").such_as("ball")),
      velocity_parts(), "-2");
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

BoundKey<Description> amplitudes_key() {
  const Spec point = list("One point [t, factor].", number("Fraction of the step, or factor."))
                         .count(2, 2)
                         .such_as("[0.5, 1]");
  return {
      optional("amplitudes",
               names("Factors over the fraction t of a step, by name; straight between the points.",
                     list("Points [t, factor], t increasing from 0 to 1.", point)
                         .count(1)
                         .such_as("[[0, 0], [0.5, 1], [1, 0]]"))
                   .otherwise("{}")
                   .such_as("{there_and_back: [[0, 0], [0.5, 1], [1, 0]]}")),
      [](Description& d, const Value& v) {
        for (const ValueEntry& entry : v.entries) d.amplitudes.push_back(amplitude_of(entry));
      }};
}

BoundKey<Description> initial_velocity_key() {
  return {
      optional(
          "initial_velocity",
          loads_spec(
              "Velocities at the beginning of the first step with inertia, and of motions along "
              "vibrations.",
              "One velocity.", velocity_keys(), velocity_parts())
              .such_as("[{on: ball, vy: -2}]")),
      [](Description& d, const Value& v) { d.initial_velocity = velocity_keys().read_all(v); }};
}

BoundKey<Description> initial_temperature_key() {
  return {optional("initial_temperature",
                   list("Temperatures of nodes before the first step, at which bodies are free of "
                        "strain; 0 where none is given.",
                        temperature_keys(false).spec("One temperature."))
                       .otherwise("[]")
                       .such_as("[{on: block, value: 20}]")),
          [](Description& d, const Value& v) {
            d.initial_temperature = temperature_keys(false).read_all(v);
          }};
}

BoundKey<Description> steps_key() {
  return {
      required("steps",
               list("What happens, in order. Values are totals at the end of a step, ramped from "
                    "those of "
                    "the last step; everything persists until it is released or changed.",
                    step_keys().spec("One step."))
                   .count(1)
                   .such_as("[{name: press, increments: 10, prescribe: [{on: top, uy: -0.007}]}]")),
      [](Description& d, const Value& v) {
        d.steps = step_keys().read_all(v, [](const Value& item, Step& s) {
          check_buckling(item, s);
          check_modes(item, s);
          check_modal(item, s);
          check_times(item, s);
        });
      }};
}

}  // namespace osculate::deck
