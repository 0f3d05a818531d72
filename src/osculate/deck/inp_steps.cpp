// The steps of a deck: a walk through its cards, in their order.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/inp_steps.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;

/// What has been read up to a card.
struct History {
  InpModel& m;
  const InpLoadParts& parts;
  InpOverlaps overlaps{};
  InpSteps out{};
  InpTables tables{};
  InpActing acting{}, before{};  ///< the latter: when the step begins
  InpConditions standing{};      ///< of the last step that is no motion along vibrations
  InpVibrations found{};         ///< by the last step with *FREQUENCY, if they are still good
  const Card* step = nullptr;    ///< null: between two of them
  InpProcedure now{}, last{};    ///< procedure of the step, and the last one of the deck
  InpMassScaling scaling{};      ///< that holds
  std::set<std::string> idle{};  ///< sets of nodes without elements that have been told of
  double total_time = 0;         ///< of the steps that have ended
  bool moved = false;            ///< one of them has moved the bodies
};

/// What acts in a step, and would be read over between two of them.
void require_step(const History& h, const Card& card) {
  const std::string& key = card.keyword;
  const bool of_steps = (key == "MODELCHANGE" && option_of(card, "TYPE") == "ELEMENT") ||
                        key == "CHANGESOLIDSECTION" || is_removal_of_equations(card);
  const bool of_model = key == "EQUATION" || key == "MPC" || key == "TIE";
  if (!h.step && (of_steps || (of_model && !h.out.steps.items.empty())))
    io::inp::fail(h.m.deck, card, "stands outside of a step");
  if (h.step && of_model && !is_removal_of_equations(card))
    io::inp::fail(h.m.deck, card, "stands in a step: before the first one is its place");
}

void begin_step(History& h, const Card& card) {
  if (h.step)
    io::inp::fail(h.m.deck, card,
                  fmt::format("the step of line {} has no *END STEP", h.step->at.line));
  h.step = &card;
  h.now = {};
  h.before = h.acting;
}

void begin_procedure(History& h, const Card& card) {
  const auto fail = [&](const std::string& text) { io::inp::fail(h.m.deck, card, text); };
  if (!h.step) fail("stands outside of a step");
  if (h.now.card)
    fail(fmt::format("the step has a procedure already, in line {}", h.now.card->at.line));
  const bool swings = card.keyword == "STEADYSTATEDYNAMICS";
  const bool superposes = card.keyword == "MODALDYNAMIC";
  if (h.last.is("STEADYSTATEDYNAMICS") && !swings)
    fail("only *STEADY STATE DYNAMICS follows *STEADY STATE DYNAMICS here");
  if (h.last.is("MODALDYNAMIC") && !superposes)
    fail("only *MODAL DYNAMIC follows *MODAL DYNAMIC here");
  if (swings || superposes) check_vibrations(h.m, card, h.found);
  h.now = h.last = inp_procedure(h.m, *h.step, card, h.moved);
  h.now.scaling = h.scaling;
}

/// What its cards change of contact, bodies and equations.
void put_changes(const History& h, const Card& end, SourceNode& step) {
  const std::span cards(h.step, &end);
  SourceNode changes = inp_changes(h.m, cards);
  if (!changes.items.empty()) put(step, "contact", std::move(changes));
  put_body_changes(h.m, cards, step);
}

/// What the step says itself.
Conditions said_here(Conditions values) {
  std::erase_if(values, [](const auto& one) { return !one.second.fresh; });
  return values;
}

/// Loads of the step are of no account; supports that it names are.
void end_modes(History& h, const Card& card, const InpWriting& w) {
  const Conditions held = said_here(h.acting.parts[0].prescribed);
  for (const auto& [key, value] : held)
    if (value.size != 0)
      io::inp::fail(h.m.deck, card, "a step with *FREQUENCY moves nothing: *BOUNDARY with 0 only");
  put_search(h.now, w.step);
  put_prescribed(w, held, true);
  put_releases(w, h.acting.parts[0].prescribed);
  put_changes(h, card, w.step);
  h.found = found_vibrations(h.now, h.acting, h.standing);
}

/// What the step says, and nothing of what stood before, which stands again after it.
void end_buckling(History& h, const Card& card, const InpWriting& w) {
  InpActing here;
  here.axes = h.acting.axes;
  here.temperatures = h.acting.temperatures;
  std::erase_if(here.temperatures, [](const auto& one) { return !one.second.fresh; });
  here.parts[0] = h.acting.parts[0];
  InpConditions& part = here.parts[0];
  const auto check = [&](const Condition& value) {
    if (!value.amplitude.empty())
      io::inp::fail(
          h.m.deck, card,
          fmt::format("loads of a step with *BUCKLE have no amplitude (line {})", value.line));
  };
  part.prescribed = said_here(part.prescribed);
  for (auto& [key, value] : part.prescribed) {
    check(value);
    if (value.fixed) value.size = 0, value.fixed = false;
  }
  for (Conditions* const loads : loads_of(part)) {
    *loads = said_here(*loads);
    for (const auto& [key, value] : *loads) check(value);
  }
  for (const auto& [on, value] : here.temperatures) check(value);
  put_search(h.now, w.step);
  put_prescribed(w, part.prescribed);
  put_releases(w, h.acting.parts[0].prescribed);
  put_loads(w, here);
  put_temperatures(w, here);
  put_changes(h, card, w.step);
  Conditions supports = std::move(h.acting.parts[0].prescribed);
  h.acting = std::move(h.before);
  h.acting.parts[0].prescribed = std::move(supports);
  h.found = {};
}

void note_loads(History& h, const InpConditions& part) {
  note_overlaps(h.m, part.forces, h.overlaps);
  note_overlaps(h.m, part.pressures, h.overlaps);
  note_overlaps(h.m, part.tractions, h.overlaps);
}

/// Loads and supports of this step and of those like it before.
void end_swing(History& h, const Card& card, const InpWriting& w) {
  check_perturbation(h.m, *h.step, *h.now.card, h.found, h.moved);
  SourceNode& harmonic = put_range(h.now, w.step);
  const int line = line_of(h.now.card->at);
  for (SourceEntry& entry :
       inp_modal(h.m, std::span(h.m.deck.cards.data(), &card), line, h.found.count).entries)
    put(harmonic, entry.key.c_str(), std::move(entry.value));
  check_supports(h.m, *h.now.card, h.found, h.acting);
  check_swinging(h.m, *h.now.card, h.acting);
  for (const bool imaginary : {false, true}) {
    note_loads(h, h.acting.parts[imaginary ? 1 : 0]);
    put_prescribed(w, h.acting.parts[imaginary ? 1 : 0].prescribed, true, imaginary);
    put_loads(w, h.acting, imaginary);
  }
}

void end_modal(History& h, const Card& card, const InpWriting& w) {
  InpConditions& real = h.acting.parts[0];
  put_time(h.m, h.now, w.step);
  put(w.step, "modal",
      inp_modal(h.m, std::span(h.m.deck.cards.data(), &card), line_of(h.now.card->at),
                h.found.count));
  check_supports(h.m, *h.now.card, h.found, h.acting);
  if (h.found.forgotten > 0)
    io::inp::fail(h.m.deck, *h.now.card,
                  fmt::format("the load of the step with *FREQUENCY (line {}) belongs into this "
                              "one",
                              h.found.forgotten));
  check_perturbation(h.m, *h.step, *h.now.card, h.found, h.moved);
  put_on_top(h.m, *h.step, *h.now.card, h.found, real);
  Conditions moved = said_here(real.prescribed);
  std::erase_if(moved, [](const auto& one) { return one.second.size == 0; });
  put_prescribed(w, moved, true);
}

void end_motion(History& h, const Card& card, const InpWriting& w) {
  InpConditions& real = h.acting.parts[0];
  const bool modal = h.now.is("MODALDYNAMIC");
  if (modal) {
    end_modal(h, card, w);
  } else {
    h.moved = true;
    h.standing = real;
    h.found = {};
    put_time(h.m, h.now, w.step);
    put_prescribed(w, real.prescribed, h.now.is("VISCO"));
    put_releases(w, real.prescribed);
    put_holds(w, real.prescribed);
  }
  note_loads(h, real);
  put_loads(w, h.acting);
  put_changes(h, card, w.step);
  if (!modal) put_temperatures(w, h.acting);
  h.total_time += h.now.period;
}

void end_step(History& h, const Card& card) {
  if (!h.step) io::inp::fail(h.m.deck, card, "there is no *STEP that it could end");
  if (!h.now.card) io::inp::fail(h.m.deck, *h.step, "the step has no procedure such as *STATIC");
  const int line = line_of(h.step->at);
  const std::size_t number = h.out.steps.items.size() + 1;
  SourceNode& step = h.out.steps.items.emplace_back(inp_map(line));
  put(step, "name", inp_text(fmt::format("step_{}", number), line));
  const InpWriting w{h.m,  h.tables,     h.out.amplitudes,          step, h.now, number,
                     line, h.total_time, is_at_once(*h.step, h.now)};
  if (h.now.modes > 0)
    end_modes(h, card, w);
  else if (h.now.factors > 0)
    end_buckling(h, card, w);
  else if (h.now.is("STEADYSTATEDYNAMICS"))
    end_swing(h, card, w);
  else
    end_motion(h, card, w);
  for (const InpConditions& part : h.acting.parts)
    note_overlaps_of_supports(h.m, part.prescribed, h.overlaps);
  end_conditions(h.acting);
  h.step = nullptr;
}

void take_card(History& h, const Card& card) {
  const std::string& key = card.keyword;
  require_step(h, card);
  if (key == "STEP") begin_step(h, card);
  if (key == "ENDSTEP") end_step(h, card);
  if (key == "AMPLITUDE") read_amplitude(h.m, card, h.tables);
  if (is_procedure(card)) begin_procedure(h, card);
  if (key == "SELECTCYCLICSYMMETRYMODES") read_diameters(h.m, card, h.now);
  if (key == "FIXEDMASSSCALING") h.now.scaling = h.scaling = read_mass_scaling(h.m, card, h.now);
  if (key == "INITIALCONDITIONS") check_initial_conditions(h.m, card);
  const InpReading reading{h.m,     h.tables, h.acting,          h.idle,
                           h.parts, h.now,    h.step != nullptr, h.last.is("STEADYSTATEDYNAMICS")};
  read_condition(reading, card);
  read_load(reading, card);
}

History walk_steps(InpModel& m, const InpLoadParts& parts) {
  History h{m, parts};
  h.out.steps = inp_list(1);
  h.out.amplitudes = inp_map(1);
  for (const Card& card : m.deck.cards) take_card(h, card);
  if (h.step && h.step != &m.deck.cards.back())  // CalculiX passes over an empty one, too
    io::inp::fail(m.deck, *h.step, "its *END STEP is missing");
  if (h.out.steps.items.empty())
    throw core::InputError({m.deck.files[0], 0, ""}, "the deck has no *STEP");
  return h;
}

}  // namespace

InpSteps inp_steps(InpModel& m) {
  const std::vector<std::string> notes = m.notes;
  const SourceNode sets = m.new_sets;
  const InpLoadParts whole;
  History h = walk_steps(m, whole);
  if (h.overlaps.empty()) return std::move(h.out);
  m.notes = notes;
  m.new_sets = sets;
  const InpLoadParts parts = load_parts(m, h.overlaps);
  return walk_steps(m, parts).out;
}

}  // namespace osculate::deck
