#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "osculate/core/text.hpp"
#include "osculate/deck/bind.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

Spec quantity_spec() {
  using Q = Quantity;
  return choice(
             "What to record: displacements and reactions of sets and rigid bodies, a quantity of "
             "a contact pair, or what the material of a set remembers.",
             {word("ux", Q::ux, "average displacement in x"),
              word("uy", Q::uy, "average displacement in y"),
              word("uz", Q::uz, "average displacement in z (models in space)"),
              word("rx", Q::rx, "rotation vector of a rigid body, x (models in space)"),
              word("ry", Q::ry, "rotation vector of a rigid body, y (models in space)"),
              word("rz", Q::rz, "rotation of a rigid body; in space its rotation vector, z"),
              word("vx", Q::vx, "average velocity in x (steps with inertia)"),
              word("vy", Q::vy, "average velocity in y (steps with inertia)"),
              word("vz", Q::vz, "average velocity in z (models in space)"),
              word("wx", Q::wx, "angular velocity of a rigid body, x (models in space)"),
              word("wy", Q::wy, "angular velocity of a rigid body, y (models in space)"),
              word("wz", Q::wz, "angular velocity of a rigid body, positive from x to y"),
              word("rfx", Q::rfx, "sum of the reactions in x"),
              word("rfy", Q::rfy, "sum of the reactions in y"),
              word("rfz", Q::rfz, "sum of the reactions in z (models in space)"),
              word(
                  "rmx", Q::rmx,
                  "reaction moment of a rigid body about its reference point, x (models in space)"),
              word(
                  "rmy", Q::rmy,
                  "reaction moment of a rigid body about its reference point, y (models in space)"),
              word("rmz", Q::rmz,
                   "reaction moment of a rigid body about its reference point, in space z"),
              word("force_x", Q::force_x, "contact force on the slave in x"),
              word("force_y", Q::force_y, "contact force on the slave in y"),
              word("force_z", Q::force_z, "contact force on the slave in z (models in space)"),
              word("normal_force", Q::normal_force,
                   "sum of the normal forces, positive in contact"),
              word("shear_force", Q::shear_force,
                   "sum of the tangential forces on the slave: in the plane positive along the "
                   "master (the body on "
                   "the right), in space its length"),
              word("max_pressure", Q::max_pressure, "largest contact pressure"),
              word("max_penetration", Q::max_penetration, "largest penetration"),
              word("stick", Q::stick, "number of sticking points"),
              word("slipping", Q::slipping, "number of sliding points"),
              word("closed", Q::closed, "number of points in contact, with friction or without"),
              word("slip", Q::slip,
                   "largest distance that a point in contact has slid since it touched the master"),
              word("open", Q::open, "number of open points"),
              word("area", Q::area, "area of the points in contact"),
              word("friction_work", Q::friction_work,
                   "work that sliding has dissipated since the beginning")})
      .such_as("normal_force");
}

/// With what materials remember.
Spec history_quantity_spec() {
  Spec spec = quantity_spec();
  int code = static_cast<int>(Quantity::remembered);
  for (const RememberedNumber& number : remembered_numbers())
    spec.choices.push_back(
        {number.word,
         fmt::format("{}, of largest size at the nodes of a set (field {}; of {})", number.doc,
                     number.name, number.materials),
         code++, true});
  return spec;
}

BoundKeys<Plot> plot_keys() {
  using P = Plot;
  const Spec column =
      text("A column of history.csv: step, increment, time or one of `history`.").such_as("time");
  return {{may(&P::title, "title", text("Title.").such_as("Pull-out force")),
           need(&P::x, "x", column),
           need(&P::y, "y",
                either("Column of the ordinate, or a list of several.",
                       {column, list("Columns.", column).count(1)})
                    .such_as("[top.rfx, top.rfy]"))}};
}

using S = Solver;

BoundKey<S> tolerance_key() {
  Spec spec =
      map("When an increment has converged; giving only one of the two makes that one decide "
          "alone.",
          {optional("energy", number("Energy of the last correction over that of the first.")
                                  .above(0)
                                  .below(1)
                                  .otherwise("1e-12")),
           optional("residual",
                    number("Out-of-balance force over the largest force of the problem.")
                        .above(0)
                        .below(1)
                        .otherwise("1e-9"))})
          .otherwise("{}")
          .such_as("{energy: 1e-12, residual: 1e-9}");
  return {optional("tolerance", std::move(spec)), [](S& s, const Value& v) {
            const Value& energy = v.at("energy");
            const Value& residual = v.at("residual");
            // Giving one of them takes the default of the other away.
            const bool alone = energy.given != residual.given;
            s.energy = {alone && !energy.given ? 0.0 : energy.number, energy.mark};
            s.residual = {alone && !residual.given ? 0.0 : residual.number, residual.mark};
          }};
}

BoundKey<S> arc_length_key() {
  return may(
      &S::arc_length, "arc_length",
      choice(
          "Follow the path of equilibria where it turns back (snap-through, buckling): the "
          "fraction of the step is an unknown too, and may fall. In steps without inertia.",
          {word("auto", ArcLength::automatic,
                "where an increment fails for good and bodies do not come to rest behind a snap, "
                "until its end is reached"),
           word("always", ArcLength::always, "after the first increment of each step, to its end"),
           word("off", ArcLength::off,
                "never, nor are snaps passed: load control ends at a limit point")})
          .otherwise("auto"));
}

BoundKey<S> linear_key() {
  return may(&S::linear, "linear",
             choice("How the linear systems of the iterations are solved.",
                    {word("auto", Linear::automatic,
                          "direct; multigrid for compact bodies from some 4 000 unknowns on (where "
                          "factors would have more than 450 entries for each; 900 of bodies that "
                          "are not compact, have contact on much of them, or are linear and change "
                          "little; never of "
                          "nearly incompressible ones), and where factors would have 3e8 entries "
                          "or take more than the memory of the machine"),
                     word("direct", Linear::direct, "by factors (MUMPS)"),
                     word("multigrid", Linear::multigrid,
                          "by GMRES with a multigrid cycle for the bodies and factors of what is "
                          "in contact: for large bodies, in a fraction of the memory. Matrices "
                          "that it does not solve are factored")})
                 .otherwise("auto"));
}

BoundKeys<S> solver_keys() {
  return {
      {tolerance_key(),
       may(&S::max_iterations, "max_iterations",
           integer("Iterations before an increment is cut; up to four times as many while what is "
                   "out of balance halves every ten.")
               .at_least(1)
               .at_most(100'000)
               .otherwise("25")),
       may(&S::line_search, "line_search",
           choice("Shorten corrections that overshoot.",
                  {word("auto", LineSearch::automatic, "when it helps"),
                   word("off", LineSearch::off, "never")})
               .otherwise("auto")),
       may(&S::cutbacks, "cutbacks",
           integer("How often in a row an increment may be cut.")
               .at_least(0)
               .at_most(60)
               .otherwise("8")),
       may(&S::minimum_fraction, "minimum_fraction",
           number("Smallest part of a step that is still tried.")
               .above(0)
               .at_most(1)
               .otherwise_as("decided by cutbacks")
               .such_as("1e-6")),
       may(&S::predictor, "predictor",
           choice(
               "First guess of an increment.",
               {word("auto", Predictor::automatic,
                     "tangent, or where increments follow each other smoothly the extrapolation of "
                     "the last ones"),
                word("tangent", Predictor::tangent, "prescribed motions act through the tangent")})
               .otherwise("auto")),
       unread<S>(optional("stabilisation",
                          map("Viscous help until contact closes.", {}).not_available())),
       arc_length_key(), linear_key()}};
}

BoundKeys<HistoryRequest> request_keys() {
  using R = HistoryRequest;
  return {{need(&R::on, "on", text("Contact pair, rigid body or set.").such_as("floor")),
           need(&R::of, "of", history_quantity_spec()),
           may(&R::column, "name",
               text("Heading of the column.")
                   .as(TextRule::column)
                   .otherwise_as("`on` and `of` joined by a dot")
                   .such_as("pull"))}};
}

std::optional<int> checkpoint_times(const Value& v) {
  if (v.alternative == 0) return v.code;
  return v.code == static_cast<int>(FieldTimes::none) ? std::optional(0) : std::nullopt;
}

BoundKeys<Output> output_keys() {
  using O = Output;
  Spec fields =
      either("When ParaView fields are written.",
             {integer("Every n-th increment.").at_least(1),
              choice("A word.", {word("every", FieldTimes::every, "after every increment"),
                                 word("last", FieldTimes::last,
                                      "at the end of every step that comes to its end"),
                                 word("none", FieldTimes::none, "never")})})
          .otherwise("every")
          .such_as("10");
  Spec checkpoint =
      either(
          "When a checkpoint is written, from which `osculate run --restart` goes on.",
          {integer("Every n-th increment, and at the end of every step.").at_least(1),
           choice("A word.", {word("auto", FieldTimes::every,
                                   "after every increment, every tenth of a model of fewer than "
                                   "20 000 unknowns, every fifth below 200 000; and at the end of "
                                   "every step"),
                              word("none", FieldTimes::none, "never")})})
          .otherwise("auto")
          .such_as("10");
  return {
      {{optional("fields", std::move(fields)),
        [](O& o, const Value& v) { v.alternative == 0 ? store(o.every, v) : store(o.fields, v); }},
       {optional("history", list("Columns of history.csv, one row per increment.",
                                 request_keys().spec("One column of history.csv."))
                                .otherwise("[]")
                                .such_as("[{on: floor, of: normal_force}]")),
        [](O& o, const Value& v) { o.history = request_keys().read_all(v); }},
       may(&O::report, "report", boolean("Write report.html.").otherwise("true")),
       may(&O::compress, "compress", boolean("Compress field files.").otherwise("true")),
       may(&O::contact_points, "contact_points",
           boolean("Write the contact points of every field file as a table too, "
                   "contact0_00012.csv: node, place and all contact fields.")
               .otherwise("false")),
       {optional("checkpoint", std::move(checkpoint)),
        [](O& o, const Value& v) { o.checkpoint = checkpoint_times(v); }},
       {optional("plots", list("Diagrams of the report.", plot_keys().spec("One diagram."))
                              .otherwise("[]")
                              .such_as("[{x: time, y: floor.normal_force}]")),
        [](O& o, const Value& v) { o.plots = plot_keys().read_all(v); }},
       frd_key(),
       dat_key(),
       may(&O::as_given, "shells_as_given",
           boolean("MODEL.frd has shells, beams and plane elements beside solids of a deck by its "
                   "own elements and nodes, with means over their sections, as OUTPUT=2D of "
                   "CalculiX; else, and where sections are hollow or of layers, the solids that "
                   "they become.")
               .otherwise("false"))}};
}

bool needs_rigid(Quantity q) {
  return (q >= Quantity::rx && q <= Quantity::rz) || (q >= Quantity::rmx && q <= Quantity::rmz) ||
         (q >= Quantity::wx && q <= Quantity::wz);
}

/// What materials remember has to be of a set, and some material has to remember it.
void require_remembered(const HistoryRequest& request, const std::string& word,
                        const Description& d) {
  if (request.of.value < Quantity::remembered) return;
  if (request.target != HistoryTarget::set)
    throw core::InputError(
        request.of.mark,
        fmt::format("'{}' belongs to sets, and {} is a {}", word, quoted(request.on.value),
                    request.target == HistoryTarget::rigid ? "rigid body" : "contact pair"));
  const RememberedNumber number = remembered_number(request.of.value);
  for (const Material& material : d.materials)
    for (const material::Remembered& of : material::memory_of(material.law.value))
      if (of.name == number.name) return;
  throw core::InputError(request.of.mark,
                         fmt::format("'{}' is remembered by materials of the kind {}, and the "
                                     "model has none",
                                     word, number.materials));
}

void require_quantity(const HistoryRequest& request, const std::string& word,
                      const Description& d) {
  require_remembered(request, word, d);
  if (is_spatial(request.of.value) && dimension(d) == 2) throw only_in_space(request.of.mark, word);
  const bool contact = request.target == HistoryTarget::contact;
  if (contact && !is_contact_quantity(request.of.value))
    throw core::InputError(
        request.of.mark,
        fmt::format("'{}' belongs to sets and rigid bodies, but '{}' is a contact pair", word,
                    request.on.value));
  if (!contact && is_contact_quantity(request.of.value)) {
    std::vector<std::string> pairs;
    for (const Contact& c : d.contact) pairs.push_back(c.name.value);
    throw core::InputError(
        request.of.mark,
        fmt::format("'{}' belongs to contact pairs: {}", word,
                    core::unknown_name_message("pair", printable(request.on.value), pairs)));
  }
  if (request.target == HistoryTarget::set && needs_rigid(request.of.value))
    throw core::InputError(
        request.of.mark,
        fmt::format("'{}' needs a rigid body, and {} is not one", word, quoted(request.on.value)));
}

/// What a request is of, and how its column is called.
void complete(HistoryRequest& request, const Description& d) {
  const std::string& on = request.on.value;
  request.target = d.find_contact(on) ? HistoryTarget::contact
                   : d.find_rigid(on) ? HistoryTarget::rigid
                                      : HistoryTarget::set;
  const std::string word(request.of.value < Quantity::remembered
                             ? quantity_names[static_cast<std::size_t>(request.of.value)]
                             : remembered_number(request.of.value).word);
  if (request.column.empty()) {
    if (on.find_first_of(",\"\r\n") != std::string::npos)
      throw core::InputError(request.on.mark, quoted(on) + " cannot head a column; give a `name`");
    request.column = on + "." + word;
  }
  require_quantity(request, word, d);
}

void require_unique_columns(const std::vector<HistoryRequest>& requests,
                            const std::vector<std::string>& always) {
  std::map<std::string, int> lines;
  for (const HistoryRequest& request : requests) {
    const std::string& column = request.column;
    if (std::find(always.begin(), always.end(), column) != always.end())
      throw core::InputError(
          request.mark, fmt::format("column '{}' is always there; choose another name", column));
    const auto [at, fresh] = lines.emplace(column, request.mark.line);
    if (!fresh)
      throw core::InputError(request.mark, fmt::format("column {} is given twice, first on line {}",
                                                       quoted(column), at->second));
  }
}

void require_column(const Name& name, const std::vector<std::string>& columns) {
  if (std::ranges::find(columns, name.value) == columns.end())
    throw core::InputError(name.mark,
                           core::unknown_name_message("column", printable(name.value), columns));
}

}  // namespace

BoundKey<Description> solver_key() {
  return {optional("solver", solver_keys()
                                 .spec("How increments are solved.")
                                 .otherwise("{}")
                                 .such_as("{max_iterations: 40, line_search: off}")),
          [](Description& d, const Value& v) { d.solver = solver_keys().read(v); }};
}

BoundKey<Description> output_key() {
  return {
      optional("output", output_keys()
                             .spec("What is written.")
                             .otherwise("{}")
                             .such_as("{fields: last, history: [{on: floor, of: normal_force}]}")),
      [](Description& d, const Value& v) { d.output = output_keys().read(v); }};
}

std::vector<std::string> energy_columns(const Description& description) {
  const auto has_inertia = [](const Step& step) { return step.dynamics.has_value(); };
  const std::vector<Step>& steps = description.steps;
  if (std::none_of(steps.begin(), steps.end(), has_inertia)) return {};
  std::vector<std::string> columns{std::string(model::fraction_quantity)};
  const bool dissipates = std::ranges::any_of(description.materials, [](const Material& material) {
    return !material::memory_of(material.law.value).empty();
  });
  for (const std::string_view name : model::energy_quantities)
    if (name != model::plastic_quantity || dissipates)
      columns.push_back(name == "elapsed" ? std::string(name) : fmt::format("energy.{}", name));
  if (std::any_of(steps.begin(), steps.end(),
                  [](const Step& step) { return step.dynamics && step.dynamics->time_steps; }))
    columns.emplace_back(model::time_step_quantity);
  return columns;
}

bool has_imaginary_column(const HistoryRequest& request, const Description& description) {
  return request.target != HistoryTarget::contact && request.of.value < Quantity::remembered &&
         std::ranges::any_of(description.steps,
                             [](const Step& step) { return step.harmonic.has_value(); });
}

void complete_output(Description& description) {
  Output& output = description.output;
  for (HistoryRequest& request : output.history) complete(request, description);
  std::vector<std::string> columns{"step", "increment", "time"};
  for (std::string& column : energy_columns(description)) columns.push_back(std::move(column));
  require_unique_columns(output.history, columns);
  for (const HistoryRequest& request : output.history) {
    columns.push_back(request.column);
    if (has_imaginary_column(request, description))
      columns.push_back(request.column + std::string(model::imaginary_suffix));
  }
  check_answers(description);
  for (const Plot& plot : output.plots) {
    require_column(plot.x, columns);
    for (const Name& y : plot.y) require_column(y, columns);
  }
}

}  // namespace osculate::deck
