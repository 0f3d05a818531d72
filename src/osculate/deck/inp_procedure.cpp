// What a step of a deck does: statics, motions in time, vibrations, buckling.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "osculate/deck/inp_steps.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;

void read_modes(const InpModel& m, InpProcedure& procedure) {
  Fields fields(m.deck, only_line(m, *procedure.card, "the number of vibrations"));
  procedure.modes = fields.number("the number of vibrations");
  for (double& bound : procedure.bounds) bound = fields.real_or_zero("a frequency");
}

void read_range(const InpModel& m, InpProcedure& procedure) {
  const Card& card = *procedure.card;
  if (option_of(card, "HARMONIC") == "NO")
    io::inp::fail(m.deck, card,
                  "HARMONIC=NO is not supported: *MODAL DYNAMIC over some periods of the loads");
  Fields fields(m.deck, only_line(m, card, "the first and the last frequency"));
  const InpProcedure::Range usual;
  InpProcedure::Range& range = procedure.range;
  range.from = fields.real("the first frequency");
  range.to = fields.real("the last frequency");
  const auto next = fields.next();
  if (next && !next->empty())
    range.points = io::inp::number_of(m.deck, io::inp::lines_of(m.deck, card)[0].at, *next,
                                      "the number of points");
  const double bias = fields.real_or_zero("the bias");
  range.bias = bias > 0 ? bias : usual.bias;
  if (!(range.to >= range.from) || range.from < 0)
    fields.fail(
        fmt::format("expected two frequencies, the second not below the first, found {:g} "
                    "and {:g}",
                    range.from, range.to));
  if (range.points < 2) range.points = usual.points;
  if (range.bias < 1) fields.fail("a bias below 1 is not supported");
}

/// Increments of the deck with DIRECT, else so many that none is longer than the largest one.
void read_increments(const InpModel& m, InpProcedure& procedure) {
  const Card& card = *procedure.card;
  const bool direct = procedure.is("MODALDYNAMIC")
                          ? option_of(card, "DIRECT") != "NO"
                          : io::inp::find_parameter(card, "DIRECT") != nullptr;
  const auto lines = io::inp::lines_of(m.deck, card);
  if (lines.empty()) return;
  Fields fields(m.deck, lines[0]);
  const double given = fields.real_or_zero("the first increment");
  const double period = fields.real_or_zero("the time of the step");
  procedure.period = period > 0 ? period : 1;
  const double first = given > 0 ? std::min(given, procedure.period) : procedure.period;
  const auto count = [&](double length) {
    constexpr double slack = 1e-9, most = 1e6;
    const double number = std::ceil(procedure.period / length * (1 - slack));
    if (!(number <= most)) fields.fail("more than a million increments");
    return static_cast<int>(number);
  };
  procedure.increments = count(first);
  if (direct) return;
  // They are cut where they must be, those of *DYNAMIC also for their errors; what creeps within an
  // increment has an error in proportion to it, and nothing cuts it.
  const int of_automatic = procedure.is("STATIC") ? 10 : procedure.is("VISCO") ? 200 : 100;
  procedure.increments = std::min(procedure.increments, of_automatic);
  if (io::inp::find_parameter(card, "EXPLICIT")) return;
  (void)fields.real_or_zero("the smallest increment");
  const double longest = fields.real_or_zero("the largest increment");
  if (longest > 0) procedure.increments = std::max(procedure.increments, count(longest));
}

void read_time(const InpModel& m, const Card& step, InpProcedure& procedure) {
  if (!procedure.is("MODALDYNAMIC") && io::inp::find_parameter(step, "PERTURBATION"))
    io::inp::fail(m.deck, step, "PERTURBATION is not supported: steps go on from the last one");
  if (io::inp::find_parameter(*procedure.card, "RIKS"))
    io::inp::fail(m.deck, *procedure.card,
                  "RIKS is not supported; `solver: arc_length` of a model file");
  read_increments(m, procedure);
}

}  // namespace

bool is_procedure(const Card& card) {
  constexpr std::array<std::string_view, 8> all{
      "STATIC",    "VISCO",  "DYNAMIC",    "MODALDYNAMIC",
      "FREQUENCY", "BUCKLE", "NOANALYSIS", "STEADYSTATEDYNAMICS"};
  return std::ranges::find(all, card.keyword) != all.end();
}

InpProcedure inp_procedure(const InpModel& m, const Card& step, const Card& card, bool moved) {
  InpProcedure procedure;
  procedure.card = &card;
  const bool searches = procedure.is("FREQUENCY") || procedure.is("BUCKLE");
  // With PERTURBATION on top of what the steps before led to, else of a body without loads.
  procedure.about_start = searches && moved && !io::inp::find_parameter(step, "PERTURBATION");
  if (procedure.is("FREQUENCY"))
    read_modes(m, procedure);
  else if (procedure.is("BUCKLE"))
    procedure.factors = Fields(m.deck, only_line(m, card, "the number of buckling factors"))
                            .number("the number of buckling factors");
  else if (procedure.is("STEADYSTATEDYNAMICS"))
    read_range(m, procedure);
  else if (!procedure.is("NOANALYSIS"))
    read_time(m, step, procedure);
  return procedure;
}

void read_diameters(const InpModel& m, const Card& card, InpProcedure& procedure) {
  if (procedure.modes == 0) io::inp::fail(m.deck, card, "belongs behind *FREQUENCY");
  const auto number = [&](const char* key) {
    const std::string given = option_of(card, key);
    return given.empty() || given == "0" ? 0 : io::inp::number_of(m.deck, card.at, given, key);
  };
  const int first = number("NMIN"), last = number("NMAX");
  if (first < 0 || last < first)
    io::inp::fail(m.deck, card,
                  fmt::format("expected 0 <= NMIN <= NMAX, found {} and {}", first, last));
  procedure.diameters = {first, last};
}

void put_search(const InpProcedure& procedure, SourceNode& step) {
  const int line = line_of(procedure.card->at);
  const char* const key = procedure.modes > 0 ? "modes" : "buckling";
  SourceNode count = inp_number(std::max(procedure.modes, procedure.factors), line);
  const auto& [least, most] = procedure.bounds;
  if (!procedure.about_start && !procedure.diameters && !(least > 0) && !(most > 0)) {
    put(step, key, std::move(count));
    return;
  }
  SourceNode& search = put(step, key, inp_map(line));
  put(search, "count", std::move(count));
  if (procedure.about_start) put(search, "about", inp_text("start", line));
  if (least > 0) put(search, "from", inp_number(least, line));
  if (most > 0) put(search, "to", inp_number(most, line));
  if (!procedure.diameters) return;
  SourceNode& list = put(search, "diameters", inp_list(line));
  for (int k = (*procedure.diameters)[0]; k <= (*procedure.diameters)[1]; ++k)
    list.items.push_back(inp_number(k, line));
}

namespace {

/// `*STATIC` is the response at once of what relaxes, and nothing creeps in it, as in CalculiX.
bool is_at_once(const InpModel& m, const InpProcedure& procedure) {
  return procedure.is("STATIC") && std::ranges::any_of(m.deck.cards, [](const Card& card) {
           return card.keyword == "CREEP" || card.keyword == "VISCOELASTIC";
         });
}

}  // namespace

void put_time(InpModel& m, const InpProcedure& procedure, SourceNode& step) {
  const int line = line_of(procedure.card->at);
  if (io::inp::find_parameter(*procedure.card, "STABILIZE"))
    m.notes.push_back(fmt::format(
        "line {}: without the viscous forces of STABILIZE: what converges is the answer that they "
        "leave where they do little work; what snaps through needs *DYNAMIC, or `solver: "
        "arc_length` of a model file",
        procedure.card->at.line));
  put(step, "increments", inp_number(procedure.increments, line));
  put(step, "duration", inp_number(procedure.period, line));
  if (is_at_once(m, procedure)) put(step, "at_once", inp_text("true", line)).quoted = false;
  if (procedure.is("DYNAMIC")) put(step, "dynamics", inp_dynamics(m, procedure));
}

SourceNode& put_range(const InpProcedure& procedure, SourceNode& step) {
  const int line = line_of(procedure.card->at);
  SourceNode& harmonic = put(step, "harmonic", inp_map(line));
  put(harmonic, "from", inp_number(procedure.range.from, line));
  put(harmonic, "to", inp_number(procedure.range.to, line));
  put(harmonic, "points", inp_number(procedure.range.points, line));
  put(harmonic, "bias", inp_number(procedure.range.bias, line));
  return harmonic;
}

}  // namespace osculate::deck
