// Laws of contact of a deck: *SURFACE BEHAVIOR, *FRICTION, *CONTACT DAMPING.
#include <fmt/format.h>

#include "osculate/deck/inp_parts.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;

void put_table(const InpModel& m, const Card& card, SourceNode& normal) {
  const int at = line_of(card.at);
  SourceNode& table = put(normal, "table", inp_list(at));
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    const double pressure = fields.real("the pressure");
    const double overclosure = fields.real("the overclosure");
    SourceNode& row = table.items.emplace_back(inp_list(line_of(line.at)));
    row.items = {inp_number(overclosure, line_of(line.at)), inp_number(pressure, line_of(line.at))};
  }
}

/// As ccx has it; Abaqus' law is `exponential`, with the same numbers.
void put_decaying(const Line& line, Fields& fields, SourceNode& normal) {
  const int at = line_of(line.at);
  const double clearance = fields.real("the clearance");
  SourceNode& law = put(normal, "decaying", inp_map(at));
  put(law, "pressure", inp_number(fields.real("the pressure"), at));
  put(law, "clearance", inp_number(clearance, at));
}

/// The law of node-to-face contact.
void put_tensile(int at, double stiffness, double tension, double clearance, SourceNode& normal) {
  SourceNode& law = put(normal, "tensile", inp_map(at));
  put(law, "stiffness", inp_number(stiffness, at));
  put(law, "tension", inp_number(tension, at));
  put(law, "clearance", inp_number(clearance, at));
}

/// The damping along the surface, as a share of that across it.
double film_of(const InpModel& m, const Card& damping) {
  const io::inp::Parameter* const fraction = io::inp::find_parameter(damping, "TANGENTFRACTION");
  if (!fraction) return 0;
  const double share = Fields(m.deck, {fraction->value, damping.at}).real("TANGENT FRACTION");
  const Line& line = only_line(m, damping, "the damping coefficient");
  return share * Fields(m.deck, line).real("the damping coefficient");
}

SourceNode film_alone(double film, int at) {
  SourceNode friction = inp_map(at);
  put(put(friction, "viscous", inp_map(at)), "coefficient", inp_number(film, at));
  return friction;
}

/// Abaqus: mu = mu_k + (mu_s - mu_k) exp(-d V), V the sliding speed.
SourceNode decaying_friction(const InpModel& m, const Card& card, double film) {
  const Line& line = only_line(m, card, "both coefficients and the decay");
  Fields fields(m.deck, line);
  const int at = line_of(line.at);
  SourceNode friction = inp_map(line_of(card.at));
  SourceNode& coulomb = put(friction, "coulomb", inp_map(at));
  put(coulomb, "mu", inp_number(fields.real("the static coefficient"), at));
  const double kinetic = fields.real("the kinetic coefficient");
  const double decay = fields.real_or_zero("the decay");
  if (decay > 0) {
    put(coulomb, "kinetic", inp_number(kinetic, at));
    put(put(coulomb, "decay", inp_map(at)), "speed", inp_number(1 / decay, at));
  }
  if (film > 0) put(coulomb, "viscous", inp_number(film, at));
  return friction;
}

SourceNode friction_of(const InpModel& m, const Card& card, double film) {
  if (io::inp::find_parameter(card, "ROUGH")) {
    SourceNode friction = inp_map(line_of(card.at));
    put(friction, "rough", inp_map(line_of(card.at)));
    return friction;
  }
  if (io::inp::find_parameter(card, "EXPONENTIALDECAY")) return decaying_friction(m, card, film);
  const Line& line = only_line(m, card, "the coefficient and the stick slope");
  Fields fields(m.deck, line);
  const int at = line_of(line.at);
  const double mu = fields.real("the coefficient of friction");
  if (mu == 0) return film > 0 ? film_alone(film, at) : inp_text("none", at);
  SourceNode friction = inp_map(line_of(card.at));
  SourceNode& coulomb = put(friction, "coulomb", inp_map(at));
  put(coulomb, "mu", inp_number(mu, at));
  if (const double slope = fields.real_or_zero("the stick slope"); slope > 0)
    put(coulomb, "penalty", inp_number(slope, at));
  if (film > 0) put(coulomb, "viscous", inp_number(film, at));
  return friction;
}

/// What is tied has the stick slope along the surface, and no limit of friction.
SourceNode tied_shear(const InpModel& m, const Card& card) {
  SourceNode friction = inp_map(line_of(card.at));
  SourceNode& rough = put(friction, "rough", inp_map(line_of(card.at)));
  const auto lines = io::inp::lines_of(m.deck, card);
  if (lines.empty()) return friction;
  Fields fields(m.deck, lines[0]);
  (void)fields.real_or_zero("the coefficient of friction");
  if (const double slope = fields.real_or_zero("the stick slope"); slope > 0)
    put(rough, "penalty", inp_number(slope, line_of(lines[0].at)));
  return friction;
}

}  // namespace

bool inp_is_tied(const Card* behavior) {
  return behavior && option_of(*behavior, "PRESSURE-OVERCLOSURE") == "TIED";
}

SourceNode inp_normal(const InpModel& m, const Card* behavior, int line, double clearance) {
  SourceNode normal = inp_map(line);
  if (!behavior) return normal;  // hard
  const std::string kind = option_of(*behavior, "PRESSURE-OVERCLOSURE");
  if (io::inp::find_parameter(*behavior, "NOSEPARATION")) {
    if (kind == "TABULAR" || kind == "EXPONENTIAL")
      io::inp::fail(m.deck, *behavior, "NO SEPARATION goes with HARD and LINEAR, found " + kind);
    put(normal, "separation", inp_text("no_separation", line_of(behavior->at)));
    clearance = 0;  // what holds needs no tension
  }
  if (kind.empty() || kind == "HARD") return normal;
  if (kind == "TABULAR") {
    put_table(m, *behavior, normal);
    return normal;
  }
  if (kind != "LINEAR" && kind != "TIED" && kind != "EXPONENTIAL")
    io::inp::fail(
        m.deck, *behavior,
        fmt::format("PRESSURE-OVERCLOSURE={} is not supported: HARD, LINEAR, EXPONENTIAL, "
                    "TABULAR or TIED",
                    printable(kind)));
  const auto lines = io::inp::lines_of(m.deck, *behavior);
  if (lines.empty()) io::inp::fail(m.deck, *behavior, "expected a line of numbers");
  Fields fields(m.deck, lines[0]);
  if (kind == "EXPONENTIAL") {
    put_decaying(lines[0], fields, normal);
    return normal;
  }
  const double stiffness = fields.real("the stiffness");
  const double tension = kind == "LINEAR" ? fields.real_or_zero("the tension") : 0;
  if (tension > 0 && clearance > 0) {
    put_tensile(line_of(lines[0].at), stiffness, tension,
                fields.done() ? clearance : fields.real("the clearance"), normal);
    return normal;
  }
  put(normal, "penalty", inp_number(stiffness, line_of(lines[0].at)));
  if (kind == "TIED") {
    if (find(normal, "separation"))
      io::inp::fail(m.deck, *behavior, "NO SEPARATION does not go with TIED, which holds already");
    const int at = line_of(behavior->at);
    put(normal, "separation", inp_text("tied", at));
    put(normal, "tolerance", inp_text("any", at));
    put(normal, "initial_gap", inp_text("close", at));
  }
  return normal;
}

bool inp_is_hard(const Card* behavior) {
  const std::string kind = behavior ? option_of(*behavior, "PRESSURE-OVERCLOSURE") : std::string();
  return kind.empty() || kind == "HARD";
}

SourceNode inp_shear(const InpModel& m, const Card* behavior, const Card* friction,
                     const Card* damping) {
  if (inp_is_tied(behavior)) return friction ? tied_shear(m, *friction) : inp_map(0);
  const double film = damping ? film_of(m, *damping) : 0;
  if (friction) return friction_of(m, *friction, film);
  return film > 0 ? film_alone(film, line_of(damping->at)) : inp_map(0);
}

void put_damping(const InpModel& m, const Card& card, SourceNode& normal) {
  const Line& line = only_line(m, card, "the damping coefficient");
  const int at = line_of(line.at);
  SourceNode& damping = put(normal, "damping", inp_map(at));
  put(damping, "viscous", inp_number(Fields(m.deck, line).real("the damping coefficient"), at));
}

}  // namespace osculate::deck
