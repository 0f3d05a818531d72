// size: one walk through the cards of the steps, whose parts share what it has read
// Steps of a deck: boundary conditions and loads, which persist as they do in a model file.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "osculate/core/text.hpp"
#include "osculate/deck/inp_conditions.hpp"
#include "osculate/deck/inp_parts.hpp"
#include "osculate/io/inp/loaded_sets.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;
using io::inp::SetKind;

class Steps {
 public:
  explicit Steps(InpModel& m) : m_(m) {}

  InpSteps translate() {
    out_.steps = inp_list(1);
    out_.amplitudes = inp_map(1);
    for (const Card& card : m_.deck.cards) take(card);
    if (step_ && step_ != &m_.deck.cards.back())  // CalculiX passes over an empty one, too
      io::inp::fail(m_.deck, *step_, "its *END STEP is missing");
    if (out_.steps.items.empty())
      throw core::InputError({m_.deck.files[0], 0, ""}, "the deck has no *STEP");
    return std::move(out_);
  }

 private:
  /// What acts in a step, and would be read over between two of them. Supports that stand there are
  /// those of the next one.
  void require_step(const Card& card) const {
    const std::string& key = card.keyword;
    const bool of_steps = (key == "MODELCHANGE" && option_of(card, "TYPE") == "ELEMENT") ||
                          key == "CHANGESOLIDSECTION" || is_removal_of_equations(card);
    const bool of_model = key == "EQUATION" || key == "MPC" || key == "TIE";
    if (!step_ && (of_steps || (of_model && !out_.steps.items.empty())))
      io::inp::fail(m_.deck, card, "stands outside of a step");
    if (step_ && of_model && !is_removal_of_equations(card))
      io::inp::fail(m_.deck, card, "stands in a step: before the first one is its place");
  }

  void take(const Card& card) {
    const std::string& key = card.keyword;
    require_step(card);
    if (key == "STEP") begin(card);
    if (key == "ENDSTEP") {
      end(card);
      begin_to_persist();
    }
    if (key == "AMPLITUDE") read_amplitude(card);
    if (key == "STATIC" || key == "VISCO" || key == "DYNAMIC" || key == "MODALDYNAMIC")
      read_time(card);
    if (key == "NOANALYSIS") begin_procedure(card);
    if (key == "STEADYSTATEDYNAMICS") read_swing(card);
    if (key == "FREQUENCY") read_modes(card);
    if (key == "BUCKLE") read_buckling(card);
    if (key == "SELECTCYCLICSYMMETRYMODES") read_diameters(card);
    if (key == "INITIALCONDITIONS") check_initial(card);
    if (key == "BOUNDARY") read_boundary(card);
    if (key == "CLOAD") read_forces(card);
    if (key == "DLOAD") read_distributed(card);
    if (key == "DSLOAD") read_on_surfaces(card);
    if (key == "TEMPERATURE") read_temperatures(card);
  }

  // ---- steps ----------------------------------------------------------------------------------

  void begin(const Card& card) {
    if (step_)
      io::inp::fail(m_.deck, card,
                    fmt::format("the step of line {} has no *END STEP", step_->at.line));
    step_ = &card;
    procedure_ = nullptr;
    at_once_ = option_of(card, "AMPLITUDE") == "STEP";
    modes_ = 0;
    bounds_ = {0, 0};
    factors_ = 0;
    diameters_.reset();
    period_ = 1;
    increments_ = 1;
    before_ = {forces_, pressures_, body_forces_, centrifugal_};
    temperatures_before_ = temperatures_;
  }

  /// What a step has said is what the next ones find.
  void begin_to_persist() {
    released_.clear();
    for (Conditions* const values : all_conditions())
      for (auto& [key, value] : *values) value.fresh = false;
    for (auto& [on, value] : temperatures_) value.fresh = false;
  }

  void begin_procedure(const Card& card) {
    if (!step_) io::inp::fail(m_.deck, card, "stands outside of a step");
    if (procedure_)
      io::inp::fail(
          m_.deck, card,
          fmt::format("the step has a procedure already, in line {}", procedure_->at.line));
    procedure_ = &card;
    const bool swings = card.keyword == "STEADYSTATEDYNAMICS";
    if (swung_ && !swings)
      io::inp::fail(m_.deck, card,
                    "only *STEADY STATE DYNAMICS follows *STEADY STATE DYNAMICS here");
    swung_ = swings;
    if (superposed_ && card.keyword != "MODALDYNAMIC")
      io::inp::fail(m_.deck, card, "only *MODAL DYNAMIC follows *MODAL DYNAMIC here");
    superposed_ = card.keyword == "MODALDYNAMIC";
  }

  /// Vibrations about what the steps before led to with PERTURBATION, else without loads.
  void read_modes(const Card& card) {
    begin_procedure(card);
    about_start_ = moved_ && !io::inp::find_parameter(*step_, "PERTURBATION");
    Fields fields(m_.deck, only_line(m_, card, "the number of vibrations"));
    modes_ = fields.number("the number of vibrations");
    for (double& bound : bounds_) bound = fields.real_or_zero("a frequency");
  }

  /// Factors of the loads of the step alone: with PERTURBATION on top of what the steps before led
  /// to, else of a body without loads.
  void read_buckling(const Card& card) {
    begin_procedure(card);
    about_start_ = moved_ && !io::inp::find_parameter(*step_, "PERTURBATION");
    factors_ = Fields(m_.deck, only_line(m_, card, "the number of buckling factors"))
                   .number("the number of buckling factors");
  }
  /// The range of frequencies.
  void read_swing(const Card& card) {
    begin_procedure(card);
    check_vibrations(card);
    if (option_of(card, "HARMONIC") == "NO")
      io::inp::fail(m_.deck, card,
                    "HARMONIC=NO is not supported: *MODAL DYNAMIC over some periods of the loads");
    Fields fields(m_.deck, only_line(m_, card, "the first and the last frequency"));
    range_.from = fields.real("the first frequency");
    range_.to = fields.real("the last frequency");
    constexpr int usual_points = 20;
    constexpr double usual_bias = 3;
    const auto next = fields.next();
    range_.points = usual_points;
    if (next && !next->empty())
      range_.points = io::inp::number_of(m_.deck, io::inp::lines_of(m_.deck, card)[0].at, *next,
                                         "the number of points");
    const double bias = fields.real_or_zero("the bias");
    range_.bias = bias > 0 ? bias : usual_bias;
    if (!(range_.to >= range_.from) || range_.from < 0)
      fields.fail(
          fmt::format("expected two frequencies, the second not below the first, found {:g} "
                      "and {:g}",
                      range_.from, range_.to));
    if (range_.points < 2) range_.points = usual_points;
    if (range_.bias < 1) fields.fail("a bias below 1 is not supported");
  }
  void read_diameters(const Card& card) {
    if (modes_ == 0) io::inp::fail(m_.deck, card, "belongs behind *FREQUENCY");
    const auto number = [&](const char* key) {
      const std::string given = option_of(card, key);
      return given.empty() || given == "0" ? 0 : io::inp::number_of(m_.deck, card.at, given, key);
    };
    const int first = number("NMIN"), last = number("NMAX");
    if (first < 0 || last < first)
      io::inp::fail(m_.deck, card,
                    fmt::format("expected 0 <= NMIN <= NMAX, found {} and {}", first, last));
    diameters_ = {first, last};
  }

  void read_time(const Card& card) {
    begin_procedure(card);
    const bool modal = card.keyword == "MODALDYNAMIC";
    if (modal) check_vibrations(card);
    if (!modal && io::inp::find_parameter(*step_, "PERTURBATION"))
      io::inp::fail(m_.deck, *step_,
                    "PERTURBATION is not supported: steps go on from the last one");
    if (io::inp::find_parameter(card, "RIKS"))
      io::inp::fail(m_.deck, card, "RIKS is not supported; `solver: arc_length` of a model file");
    if (card.keyword == "DYNAMIC" || modal) at_once_ = true;
    const bool direct = modal ? option_of(card, "DIRECT") != "NO"
                              : io::inp::find_parameter(card, "DIRECT") != nullptr;
    const auto lines = io::inp::lines_of(m_.deck, card);
    if (lines.empty()) return;
    Fields fields(m_.deck, lines[0]);
    const double given = fields.real_or_zero("the first increment");
    const double period = fields.real_or_zero("the time of the step");
    period_ = period > 0 ? period : 1;
    const double first = given > 0 ? std::min(given, period_) : period_;
    constexpr double slack = 1e-9, most = 1e6;
    const double count = std::ceil(period_ / first * (1 - slack));
    if (!(count <= most)) fields.fail("more than a million increments");
    // They are cut where they must be, those in time also for their errors.
    const int of_automatic = card.keyword == "STATIC" || card.keyword == "VISCO" ? 10 : 100;
    increments_ = static_cast<int>(count);
    if (direct) return;
    if (io::inp::find_parameter(card, "EXPLICIT")) {
      increments_ = std::min(increments_, of_automatic);
      return;
    }
    (void)fields.real_or_zero("the smallest increment");
    const double longest = fields.real_or_zero("the largest increment");
    const double least = longest > 0 ? std::ceil(period_ / longest * (1 - slack)) : 1;
    if (!(least <= most)) fields.fail("more than a million increments");
    increments_ = std::max(std::min(increments_, of_automatic), static_cast<int>(least));
  }

  /// `*STATIC` is the response at once of what relaxes.
  double duration(std::size_t number) {
    if (procedure_->keyword != "STATIC") return period_;
    const std::optional<double> shortest = shortest_relaxation(m_);
    if (!shortest) return period_;
    constexpr double next_to_none = 1e-9;
    m_.notes.push_back(
        fmt::format("step {} (*STATIC) is the response at once of *VISCOELASTIC: it has the "
                    "duration {:g}, 1e-9 of the shortest relaxation time",
                    number, next_to_none * *shortest));
    return next_to_none * *shortest;
  }

  void end(const Card& card) {
    if (!step_) io::inp::fail(m_.deck, card, "there is no *STEP that it could end");
    if (!procedure_) io::inp::fail(m_.deck, *step_, "the step has no procedure such as *STATIC");
    const int line = line_of(step_->at);
    const std::size_t number = out_.steps.items.size() + 1;
    SourceNode& step = out_.steps.items.emplace_back(inp_map(line));
    put(step, "name", inp_text(fmt::format("step_{}", number), line));
    if (modes_ > 0) {
      SourceNode count = inp_number(modes_, line_of(procedure_->at));
      if (about_start_ || diameters_ || bounds_[0] > 0 || bounds_[1] > 0) {
        const int at = count.line;
        SourceNode& modes = put(step, "modes", inp_map(at));
        put(modes, "count", std::move(count));
        if (about_start_) put(modes, "about", inp_text("start", at));
        if (bounds_[0] > 0) put(modes, "from", inp_number(bounds_[0], at));
        if (bounds_[1] > 0) put(modes, "to", inp_number(bounds_[1], at));
        if (diameters_) {
          SourceNode& list = put(modes, "diameters", inp_list(at));
          for (int k = (*diameters_)[0]; k <= (*diameters_)[1]; ++k)
            list.items.push_back(inp_number(k, at));
        }
      } else {
        put(step, "modes", std::move(count));
      }
      end_of_modes(card, step);
      return;
    }
    if (factors_ > 0) {
      put_search(step, "buckling", factors_);
      end_of_buckling(card, step);
      return;
    }
    if (procedure_->keyword == "STEADYSTATEDYNAMICS") return end_of_swing(card, step);
    const bool modal = procedure_->keyword == "MODALDYNAMIC";
    moved_ = moved_ || !modal;
    if (!modal) stand();
    if (!modal) vibrations_ = 0;
    put(step, "increments", inp_number(increments_, line_of(procedure_->at)));
    put(step, "duration", inp_number(duration(number), line_of(procedure_->at)));
    if (procedure_->keyword == "DYNAMIC") put(step, "dynamics", inp_dynamics(m_, *procedure_));
    if (modal) {
      put(step, "modal",
          inp_modal(m_, std::span(m_.deck.cards.data(), &card), line_of(procedure_->at),
                    vibrations_));
      check_supports();
      check_loads();
      Conditions moved = prescribed_;
      std::erase_if(moved,
                    [](const auto& one) { return !one.second.fresh || one.second.size == 0; });
      put_directions(step, "prescribe", 'u', moved);
    } else {
      put_directions(step, "prescribe", 'u', prescribed_);
      put_releases(step);
      put_holds(step);
    }
    check_loads_of_later_steps(m_, *step_, forces_, "CLOAD");
    check_loads_of_later_steps(m_, *step_, pressures_, "DLOAD");
    put_directions(step, "forces", 'f', forces_);
    check_weights();
    put_directions(step, "forces", 'f', weights_);
    put_pressures(step, pressures_);
    put_directions(step, "body_force", 'f', body_forces_);
    put_centrifugal(step);
    put_changes(card, step);
    if (!modal) put_temperatures(step);
    forget_removed();
    total_time_ += period_;
    step_ = nullptr;
  }

  /// What its cards change of contact, bodies and equations.
  void put_changes(const Card& end, SourceNode& step) {
    const std::span cards(step_, &end);
    SourceNode changes = inp_changes(m_, cards);
    if (!changes.items.empty()) put(step, "contact", std::move(changes));
    put_body_changes(m_, cards, step);
  }

  /// How many, and about which state.
  void put_search(SourceNode& step, const char* key, int number) {
    const int line = line_of(procedure_->at);
    if (!about_start_) {
      put(step, key, inp_number(number, line));
      return;
    }
    SourceNode& search = put(step, key, inp_map(line));
    put(search, "count", inp_number(number, line));
    put(search, "about", inp_text("start", line));
  }

  /// What the step says, and nothing of what stood before, which stands again after it.
  void end_of_buckling(const Card& card, SourceNode& step) {
    const auto only_here = [&](auto& values) {
      std::erase_if(values, [](const auto& one) { return !one.second.fresh; });
      for (const auto& [key, value] : values)
        if (!value.amplitude.empty())
          io::inp::fail(
              m_.deck, card,
              fmt::format("loads of a step with *BUCKLE have no amplitude (line {})", value.line));
    };
    Conditions moved = prescribed_;
    only_here(moved);
    for (auto& [key, value] : moved)
      if (value.fixed) value.size = 0, value.fixed = false;
    put_directions(step, "prescribe", 'u', moved);
    put_releases(step);
    for (Conditions* const loads : {&forces_, &pressures_, &body_forces_, &centrifugal_})
      only_here(*loads);
    only_here(temperatures_);
    at_once_ = false;
    put_directions(step, "forces", 'f', forces_);
    put_pressures(step, pressures_);
    put_directions(step, "body_force", 'f', body_forces_);
    put_centrifugal(step);
    put_temperatures(step);
    put_changes(card, step);
    std::tie(forces_, pressures_, body_forces_, centrifugal_) = before_;
    temperatures_ = temperatures_before_;
    std::erase_if(released_, [&](const auto& one) { return one.first != &prescribed_; });
    forget_removed();
    vibrations_ = 0;
    step_ = nullptr;
  }

  /// Loads that the state of later vibrations has.
  void stand() {
    standing_.clear();
    for (Conditions* const loads : {&forces_, &pressures_, &body_forces_, &centrifugal_})
      for (const auto& [key, value] : *loads) standing_[{loads, key}] = value.size;
  }

  /// Loads of the step are of no account; supports that it names are.
  void end_of_modes(const Card& card, SourceNode& step) {
    Conditions held = prescribed_;
    std::erase_if(held, [](const auto& one) { return !one.second.fresh; });
    for (const auto& [key, value] : held)
      if (value.size != 0)
        io::inp::fail(m_.deck, card, "a step with *FREQUENCY moves nothing: *BOUNDARY with 0 only");
    put_directions(step, "prescribe", 'u', held);
    put_releases(step);
    put_changes(card, step);
    forget_removed();
    vibrations_ = modes_;
    forgotten_ = 0;
    for (const Conditions* const loads : {&forces_, &pressures_, &body_forces_, &centrifugal_})
      for (const auto& [key, value] : *loads)
        if (value.fresh) forgotten_ = std::max(value.line, 1);
    held_.clear();
    for (const auto& [key, value] : prescribed_) held_.insert(key);
    step_ = nullptr;
  }

  /// Loads and supports of this step and of those like it before.
  void end_of_swing(const Card& card, SourceNode& step) {
    const int line = line_of(procedure_->at);
    const auto fail = [&](const std::string& text) { io::inp::fail(m_.deck, *procedure_, text); };
    if (moved_ && (io::inp::find_parameter(*step_, "PERTURBATION") != nullptr) == about_start_)
      fail("PERTURBATION must be said of this step and of that with *FREQUENCY, or of none");
    SourceNode& harmonic = put(step, "harmonic", inp_map(line));
    put(harmonic, "from", inp_number(range_.from, line));
    put(harmonic, "to", inp_number(range_.to, line));
    put(harmonic, "points", inp_number(range_.points, line));
    put(harmonic, "bias", inp_number(range_.bias, line));
    for (SourceEntry& entry :
         inp_modal(m_, std::span(m_.deck.cards.data(), &card), line, vibrations_).entries)
      put(harmonic, entry.key.c_str(), std::move(entry.value));
    check_supports();
    for (Conditions* const values : all_conditions())
      for (const auto& [key, value] : *values)
        if (value.size != 0 && !value.swings && !released_.contains({values, key}))
          fail(
              fmt::format("what line {} says of a step before would go on in this one: write it "
                          "again, or OP=NEW",
                          value.line));
    for (const bool imaginary : {false, true}) {
      imaginary_ = imaginary;
      put_directions(step, "prescribe", 'u', imaginary ? prescribed_2_ : prescribed_);
      put_directions(step, "forces", 'f', imaginary ? forces_2_ : forces_);
      put_pressures(step, imaginary ? pressures_2_ : pressures_);
      put_directions(step, "body_force", 'f', imaginary ? body_forces_2_ : body_forces_);
    }
    imaginary_ = false;
    put_centrifugal(step);
    forget_removed();
    step_ = nullptr;
  }

  std::array<Conditions*, 10> all_conditions() {
    return {&weights_,     &prescribed_,   &forces_,   &pressures_,   &body_forces_,
            &centrifugal_, &prescribed_2_, &forces_2_, &pressures_2_, &body_forces_2_};
  }

  /// What CalculiX does to loads of steps before: they go on in a step without PERTURBATION, unless
  /// they have an amplitude, and are the state in one with it.
  void check_loads() {
    const auto fail = [&](const std::string& text) { io::inp::fail(m_.deck, *procedure_, text); };
    if (forgotten_ > 0)
      fail(fmt::format("the load of the step with *FREQUENCY (line {}) belongs into this one",
                       forgotten_));
    const bool on_top = io::inp::find_parameter(*step_, "PERTURBATION") != nullptr;
    if (moved_ && on_top == about_start_)
      fail("PERTURBATION must be said of this step and of that with *FREQUENCY, or of none");
    for (Conditions* const loads : {&forces_, &pressures_, &body_forces_, &centrifugal_})
      for (auto& [key, value] : *loads) {
        const auto before = standing_.find({loads, key});
        if (!value.fresh && !value.amplitude.empty() && value.size != 0)
          fail(
              fmt::format("the load of line {} has an amplitude and ends with its step: say it "
                          "again, or OP=NEW",
                          value.line));
        if (!on_top || before == standing_.end() || !value.fresh) continue;
        if (!value.amplitude.empty())
          fail(
              fmt::format("the load of line {} has an amplitude, and stands on top of one of the "
                          "same set in a step before: give it another set",
                          value.line));
        value.size += before->second;
      }
  }

  void check_vibrations(const Card& card) const {
    if (vibrations_ == 0)
      io::inp::fail(
          m_.deck, card,
          "the step before it must have a *FREQUENCY: vibrations are not read from files");
    if (io::inp::find_parameter(card, "STEADYSTATE"))
      io::inp::fail(m_.deck, card,
                    "STEADY STATE is not supported: give a period that is long enough");
    for (const char* const other : {"CYCLICSYMMETRY", "NSET"})
      if (io::inp::find_parameter(card, other))
        io::inp::fail(m_.deck, card, fmt::format("the parameter {} is not supported", other));
  }

  /// Supports are those that the step which has found the vibrations knows.
  void check_supports() const {
    for (const Conditions* const supports : {&prescribed_, &prescribed_2_})
      for (const auto& [key, value] : *supports)
        if (!held_.contains(key))
          io::inp::fail(
              m_.deck, *procedure_,
              fmt::format("supports must be those of the step with *FREQUENCY (*BOUNDARY of "
                          "line {})",
                          value.line));
    for (const auto& [values, key] : released_)
      if (values == &prescribed_)
        io::inp::fail(
            m_.deck, *procedure_,
            fmt::format("supports must be those of the step with *FREQUENCY ('{}' is free "
                        "here)",
                        key.first));
    for (const auto& [on, value] : temperatures_)
      if (value.fresh)
        io::inp::fail(
            m_.deck, *procedure_,
            fmt::format("no temperatures change in it (*TEMPERATURE of line {})", value.line));
  }

  // ---- amplitudes -----------------------------------------------------------------------------

  void read_amplitude(const Card& card) {
    Table table;
    table.name = value_of(m_, card, "NAME");
    table.line = line_of(card.at);
    const std::string time = option_of(card, "TIME");
    if (!time.empty() && time != "STEPTIME" && time != "TOTALTIME")
      io::inp::fail(m_.deck, card, fmt::format("expected TIME=TOTAL TIME, found {}", time));
    table.of_total_time = time == "TOTALTIME";
    for (const char* const other : {"DEFINITION", "VALUE", "USER"})
      if (io::inp::find_parameter(card, other) && option_of(card, other) != "TABULAR" &&
          option_of(card, other) != "RELATIVE")
        io::inp::fail(m_.deck, card, fmt::format("{} is not supported", other));
    const auto shift = [&](const char* key) {
      const io::inp::Parameter* const given = io::inp::find_parameter(card, key);
      return given ? Fields(m_.deck, {given->value, card.at}).real(key) : 0.0;
    };
    const double later = shift("SHIFTX"), more = shift("SHIFTY");
    for (const Line& line : io::inp::lines_of(m_.deck, card)) {
      Fields fields(m_.deck, line);
      while (!fields.done()) {
        const double t = fields.real("a time") + later;
        const double factor = fields.real("a factor") + more;
        if (!table.points.empty() && !(t > table.points.back()[0]))
          fields.fail("expected a later time than the one before");
        table.points.push_back({t, factor});
      }
    }
    if (table.points.empty()) io::inp::fail(m_.deck, card, "expected pairs of time and factor");
    tables_[io::inp::capitals(table.name)] = std::move(table);
  }

  const Table& table_of(const Card& card, const std::string& name) const {
    const auto found = tables_.find(name);
    if (found != tables_.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [key, table] : tables_) names.push_back(table.name);
    io::inp::fail(m_.deck, card, core::unknown_name_message("amplitude", printable(name), names));
  }

  /// Name of the part of a table that is this step, over its fraction.
  std::string amplitude_here(const std::string& name) {
    const Table& table = tables_.at(name);
    const double start = swung_ ? range_.from : table.of_total_time ? total_time_ : 0;
    const double width = !swung_ ? period_ : range_.to > range_.from ? range_.to - range_.from : 1;
    const std::string here = plain_name(fmt::format("{}_{}", table.name, out_.steps.items.size()));
    if (find(out_.amplitudes, here)) return here;
    SourceNode& points = put(out_.amplitudes, here, inp_list(table.line));
    const auto add = [&](double fraction, double factor) {
      SourceNode& row = points.items.emplace_back(inp_list(table.line));
      row.items = {inp_number(fraction, table.line), inp_number(factor, table.line)};
    };
    add(0, at(table, start));
    for (const auto& [time, factor] : table.points) {
      const double fraction = (time - start) / width;
      constexpr double near = 1e-9;
      if (fraction > near && fraction < 1 - near) add(fraction, factor);
    }
    add(1, at(table, start + width));
    return here;
  }

  // ---- conditions and loads -------------------------------------------------------------------

  /// What a card adds to what stood before; with OP=NEW that is gone.
  std::string start(const Card& card, Conditions& values, bool may_stand_before_steps = false) {
    if (!step_ && !may_stand_before_steps) io::inp::fail(m_.deck, card, "stands outside of a step");
    for (const char* const other : {"USER", "SUBMODEL", "SECTOR", "OMEGA0"})
      if (io::inp::find_parameter(card, other))
        io::inp::fail(m_.deck, card, fmt::format("the parameter {} is not supported", other));
    const std::string part = option_of(card, "LOADCASE");
    if (!part.empty() && part != "1" && part != "2")
      io::inp::fail(m_.deck, card,
                    fmt::format("expected LOAD CASE=1 or 2, found {}", printable(part)));
    if (!part.empty() && !swung_)
      io::inp::fail(m_.deck, card, "LOAD CASE belongs to *STEADY STATE DYNAMICS");
    const std::string op = option_of(card, "OP");
    if (!op.empty() && op != "NEW" && op != "MOD")
      io::inp::fail(m_.deck, card, fmt::format("expected OP=NEW or MOD, found {}", printable(op)));
    if (op == "NEW") {
      for (auto& [key, value] : values)
        if (!value.fresh) {
          value.size = 0;
          value.amplitude.clear();
          released_.insert({&values, key});
        }
    }
    std::string amplitude = option_of(card, "AMPLITUDE");
    if (!amplitude.empty()) (void)table_of(card, amplitude);
    return delayed(card, std::move(amplitude));
  }

  /// With TIME DELAY a table begins so much later.
  std::string delayed(const Card& card, std::string amplitude) {
    const io::inp::Parameter* const given = io::inp::find_parameter(card, "TIMEDELAY");
    if (!given) return amplitude;
    if (amplitude.empty()) io::inp::fail(m_.deck, card, "TIME DELAY needs an AMPLITUDE");
    Table table = tables_.at(amplitude);
    const double delay = Fields(m_.deck, {given->value, card.at}).real("TIME DELAY as a time");
    for (auto& point : table.points) point[0] += delay;
    table.name += fmt::format("_after_{}", delay);
    const std::string name = io::inp::capitals(table.name);
    tables_[name] = std::move(table);
    return name;
  }

  /// Real or imaginary ones.
  static Conditions& part_of(const Card& card, Conditions& real, Conditions& imaginary) {
    return option_of(card, "LOADCASE") == "2" ? imaginary : real;
  }

  /// Of one step the sizes add up where `adds`.
  void set(Conditions& values, const std::string& on, int direction, double size,
           const std::string& amplitude, const Line& line, bool adds) {
    const std::pair<std::string, int> key{on, direction};
    const bool removed = released_.erase({&values, key}) > 0;
    const auto [found, is_new] = values.try_emplace(key);
    Condition& value = found->second;
    const bool sum = adds && !is_new && !removed && value.fresh;
    if (sum && value.amplitude != amplitude)
      io::inp::fail(m_.deck, line.at,
                    fmt::format("'{}' has this load with another amplitude in the same step", on));
    value = {
        sum ? value.size + size : size, amplitude, line_of(line.at), true, false, step_ && swung_};
  }

  void check_initial(const Card& card) const {
    const std::string type = option_of(card, "TYPE");
    for (const char* const other : {"USER", "FILE", "GEOSTATIC", "SECTIONPOINTS"})
      if (io::inp::find_parameter(card, other))
        io::inp::fail(m_.deck, card, fmt::format("the parameter {} is not supported", other));
    for (const char* const known : {"TEMPERATURE", "VELOCITY", "STRESS", "PLASTICSTRAIN"})
      if (type == known) return;
    io::inp::fail(m_.deck, card,
                  fmt::format("TYPE={} is not supported: TEMPERATURE, VELOCITY, STRESS or PLASTIC "
                              "STRAIN",
                              printable(type)));
  }

  /// Nodes without elements have no displacements: as in CalculiX nothing acts on them.
  bool is_idle(const std::string& set, const Line& line) {
    const std::vector<Index>& nodes = m_.mesh.mesh.find_set(set)->nodes;
    const bool used = std::ranges::any_of(
        nodes, [&](Index n) { return m_.used_nodes[static_cast<std::size_t>(n)]; });
    if (used || nodes.empty()) return false;
    if (idle_.insert(set).second)
      m_.notes.push_back(fmt::format(
          "line {}: '{}' has no nodes of elements: what acts on them is left out, as in CalculiX",
          line.at.line, set));
    return true;
  }

  /// The directions of a line of `*BOUNDARY`, and the displacement. As in CalculiX, nodes without
  /// rotations are not held in them.
  std::vector<int> held_here(Fields& fields, const Line& line, const std::string& set_name,
                             double& size) const {
    const std::string_view word = fields.next().value_or("");
    std::vector<int> directions = io::inp::held_directions(word);
    const int highest = highest_direction(m_, set_name);
    const bool of_body = m_.body_nodes.contains(only_node(m_, set_name));
    if (directions.empty()) {
      const std::int32_t first = io::inp::number_of(m_.deck, line.at, word, "the first direction");
      std::int32_t last = first;
      if (const auto field = fields.next(); field && !field->empty())
        last = io::inp::number_of(m_.deck, line.at, *field, "the last direction");
      size = fields.real_or_zero("the displacement");
      if (const int most = of_body ? highest : 6; last > most || last < first)
        fields.fail(fmt::format("expected directions 1 to {}, found {} to {}", most, first, last));
      for (std::int32_t k = first; k <= last; ++k) directions.push_back(k);
    }
    std::erase_if(directions, [&](int k) { return k > highest; });
    return directions;
  }

  void read_boundary(const Card& card) {
    Conditions& prescribed = part_of(card, prescribed_, prescribed_2_);
    const std::string amplitude = start(card, prescribed, true);
    const bool fixed = io::inp::find_parameter(card, "FIXED") != nullptr;
    for (const Line& line : io::inp::lines_of(m_.deck, card)) {
      Fields fields(m_.deck, line);
      const std::string& set_name = node_set_of(m_, line, fields.next().value_or(""));
      double size = 0;
      if (is_idle(set_name, line)) continue;
      for (const int k : held_here(fields, line, set_name, size))
        for (const InpPlace& place : places(fields, set_name, k)) {
          if (!exists(place.direction)) continue;
          set(prescribed, place.on, place.direction, place.sign * size, amplitude, line, false);
          prescribed.at({place.on, place.direction}).fixed = fixed;
        }
    }
  }

  void read_forces(const Card& card) {
    Conditions& forces = part_of(card, forces_, forces_2_);
    const std::string amplitude = start(card, forces);
    for (const Line& line : io::inp::lines_of(m_.deck, card)) {
      Fields fields(m_.deck, line);
      const std::string& set_name = node_set_of(m_, line, fields.next().value_or(""));
      if (is_idle(set_name, line)) continue;
      const std::int32_t direction = fields.number("the direction");
      const std::vector<InpPlace> on = places(fields, set_name, direction);
      if (on.empty()) fields.fail("no shell or beam can take a moment here");
      const double size = fields.real("the force");
      for (const InpPlace& place : on) {
        if (!exists(place.direction))
          fields.fail(
              fmt::format("expected a direction 1 to {}, found {}", inp_dimension(m_), direction));
        set(forces, place.on, place.direction, place.sign * size, amplitude, line, true);
      }
    }
  }

  /// Directions above 3 are rotations, which nodes of rigid bodies, shells and beams stand for.
  std::vector<InpPlace> places(const Fields& fields, const std::string& set_name,
                               int direction) const {
    const int highest = highest_direction(m_, set_name);
    if (direction < 1 || direction > highest)
      fields.fail(fmt::format("expected a direction 1 to {}, found {}", highest, direction));
    return inp_places(m_, set_name, direction);
  }
  /// In the plane there are the directions 1, 2 and 6.
  [[nodiscard]] bool exists(int direction) const {
    return inp_dimension(m_) == 3 || direction <= 2 || direction == 6;
  }

  /// Pressures follow the surface, with NLGEOM.
  void check_follower(const Card& card) const {
    if (m_.finite && option_of(card, "FOLLOWER") == "NO")
      io::inp::fail(m_.deck, card,
                    "FOLLOWER=NO is not supported with NLGEOM: pressures turn with their surface");
  }

  void read_distributed(const Card& card) {
    check_follower(card);
    // one card of OP=NEW removes pressures and body forces
    Conditions& pressures = part_of(card, pressures_, pressures_2_);
    const std::string amplitude = start(card, pressures);
    (void)start(card, part_of(card, body_forces_, body_forces_2_));
    if (option_of(card, "OP") == "NEW") gravity_.clear();
    (void)start(card, weights_);
    (void)start(card, centrifugal_);
    for (const Line& line : io::inp::lines_of(m_.deck, card)) {
      Fields fields(m_.deck, line);
      const std::string elements = io::inp::name_of(fields.next().value_or(""));
      const std::string load = io::inp::capitals(io::inp::name_of(fields.next().value_or("")));
      if (io::inp::is_side_load(load)) {
        const std::string& on =
            set_of(m_, line.at, io::inp::side_set_name(load, elements), {SetKind::surface});
        set(pressures, on, 1, fields.real("the pressure"), amplitude, line, true);
      } else if (load == "GRAV") {
        read_gravity(fields, elements, amplitude, line,
                     part_of(card, body_forces_, body_forces_2_));
      } else if (load == "CENTRIF") {
        if (option_of(card, "LOADCASE") == "2")
          fields.fail("CENTRIF with LOAD CASE=2 is not supported");
        read_centrifugal(fields, elements, amplitude, line);
      } else {
        fields.fail(fmt::format("load {} is not supported: P1 to P6, GRAV or CENTRIF",
                                io::inp::shown(load)));
      }
    }
  }

  /// Of a part of the bodies: by which set, along which direction and in which step.
  struct Gravity {
    std::string set;
    Vec3 direction;
    std::size_t step;
  };
  /// In a later step the same load is replaced, but others would add to what is there.
  void note_gravity(const Fields& fields, const std::string& part, const Gravity& now) {
    std::vector<Gravity>& all = gravity_[part];
    const bool before = std::any_of(all.begin(), all.end(),
                                    [&](const Gravity& one) { return one.step < now.step; });
    if (before && (all.size() > 1 || all[0].set != now.set || all[0].direction != now.direction))
      fields.fail(
          "GRAV of another set or direction than in a step before is not supported: write "
          "OP=NEW and all of it");
    if (before) all.clear();
    all.push_back(now);
  }

  /// The weight of a point mass, which acts with body forces, not with the forces of `*CLOAD`.
  void weigh(const std::string& node, const Vec3& weight, const std::string& amplitude,
             const Line& line) {
    if (procedure_ && (factors_ > 0 || modes_ > 0 || swung_ || superposed_))
      io::inp::fail(m_.deck, line.at,
                    fmt::format("GRAV on masses is not supported with *{}", procedure_->keyword));
    if (m_.transformed.contains(only_node(m_, node)))
      io::inp::fail(m_.deck, line.at,
                    fmt::format("GRAV on a mass at '{}', which has a *TRANSFORM, is not supported",
                                printable(node)));
    for (int k = 0; k < inp_dimension(m_); ++k)
      for (const InpPlace& place : inp_places(m_, node, k + 1))
        if (weight[k] != 0)
          set(weights_, place.on, place.direction, place.sign * weight[k], amplitude, line, true);
  }

  /// Forces of a model file on the same set replace each other.
  void check_weights() const {
    for (const auto& [place, weight] : weights_)
      if (forces_.contains(place))
        io::inp::fail(m_.deck, *step_,
                      fmt::format("'{}' has GRAV on a mass and a force of *CLOAD in the same "
                                  "direction, which is not supported",
                                  printable(place.first)));
  }

  void read_gravity(Fields& fields, const std::string& elements, const std::string& amplitude,
                    const Line& line, Conditions& body_forces) {
    const double size = fields.real("the acceleration");
    Vec3 direction = Vec3::Zero();
    for (Eigen::Index k = 0; k < 3; ++k) direction[k] = fields.real_or_zero("a direction");
    if (!(direction.norm() > 0)) fields.fail("expected the direction of gravity");
    const std::string name = io::inp::element_set_name(elements);
    const std::vector<InpMass> masses = inp_masses(m_, name);
    for (const InpMass& one : masses)
      weigh(one.node, Vec3(one.mass * size * direction.normalized()), amplitude, line);
    if (!masses.empty() && !m_.sets.contains({SetKind::elements, io::inp::capitals(name)})) return;
    const std::string& on = set_of(m_, line.at, name, {SetKind::elements});
    const std::vector<InpDensity> parts = densities_on(m_, on);
    if (parts.empty())
      fields.fail(fmt::format("GRAV acts on elements that have a section, not on {}",
                              io::inp::shown(elements)));
    direction.normalize();
    for (const InpDensity& part : parts) {
      if (!(part.density > 0))
        fields.fail(fmt::format("the material of {} has no *DENSITY", io::inp::shown(part.on)));
      note_gravity(fields, part.on, {on, direction, out_.steps.items.size()});
      for (int k = 0; k < inp_dimension(m_); ++k)
        if (direction[k] != 0)
          set(body_forces, part.on, k + 1, part.density * size * direction[k], amplitude, line,
              true);
    }
  }

  /// By set and number of the axis.
  void read_centrifugal(Fields& fields, const std::string& elements, const std::string& amplitude,
                        const Line& line) {
    const double speed = fields.real("the square of the angular velocity");
    std::array<double, 6> axis{};
    for (double& c : axis) c = fields.real_or_zero("a point or direction of the axis");
    for (std::size_t k = 3; k < 6; ++k) axis[k] += axis[k - 3];
    auto known = std::find(axes_.begin(), axes_.end(), axis);
    if (known == axes_.end()) known = axes_.insert(axes_.end(), axis);
    const std::string& on =
        set_of(m_, line.at, io::inp::element_set_name(elements), {SetKind::elements});
    set(centrifugal_, on, static_cast<int>(known - axes_.begin()), speed, amplitude, line, true);
  }

  void read_on_surfaces(const Card& card) {
    check_follower(card);
    Conditions& pressures = part_of(card, pressures_, pressures_2_);
    const std::string amplitude = start(card, pressures);
    for (const Line& line : io::inp::lines_of(m_.deck, card)) {
      Fields fields(m_.deck, line);
      const std::string surface = io::inp::name_of(fields.next().value_or(""));
      const std::string& on = set_of(m_, line.at, surface, {SetKind::surface});
      const std::string load = io::inp::capitals(io::inp::name_of(fields.next().value_or("")));
      if (load != "P")
        fields.fail(fmt::format("load {} is not supported: P", io::inp::shown(load)));
      set(pressures, on, 1, fields.real("the pressure"), amplitude, line, true);
    }
  }

  void read_temperatures(const Card& card) {
    for (const char* const other : {"FILE", "USER", "BSTEP"})
      if (io::inp::find_parameter(card, other))
        io::inp::fail(m_.deck, card, fmt::format("the parameter {} is not supported", other));
    Conditions none;
    const std::string amplitude = start(card, none);
    if (option_of(card, "OP") == "NEW") go_back(line_of(card.at));
    for (const Line& line : io::inp::lines_of(m_.deck, card)) {
      NodeValue of = temperature_of(m_, line);
      std::erase_if(temperatures_, [&](const auto& one) { return one.first == of.on; });
      temperatures_.emplace_back(std::move(of.on), Condition{of.value, amplitude, line_of(line.at),
                                                             true, false, false, of.gradient});
    }
  }

  /// Nodes with temperatures of steps before go back to those at first, or to 0 without.
  void go_back(int line) {
    const auto old = [](const auto& one) { return !one.second.fresh; };
    std::vector<std::pair<std::string, Condition>> back;
    for (const auto& [on, value] : temperatures_)
      if (!value.fresh) back.emplace_back(on, Condition{0, {}, line, true, false});
    if (back.empty()) return;
    const auto number = [](SourceNode& of, const char* key) {
      const SourceNode* const value = find(of, key);
      return value ? std::stod(value->text) : 0.0;
    };
    for (SourceNode& one : inp_initial_temperature(m_).items)
      back.emplace_back(find(one, "on")->text,
                        Condition{number(one, "value"),
                                  {},
                                  line,
                                  true,
                                  false,
                                  false,
                                  {number(one, "gradient"), number(one, "gradient_1")}});
    std::erase_if(temperatures_, old);
    temperatures_.insert(temperatures_.begin(), back.begin(), back.end());
  }

  // ---- the step -------------------------------------------------------------------------------

  /// Said now, or with an amplitude that goes on.
  bool is_active(Conditions& values, const Conditions::value_type& one) const {
    const bool released = released_.contains({&values, one.first});
    if (swung_) return !released && one.second.swings && one.second.size != 0;
    if (&values == &prescribed_ && released) return false;
    return one.second.fresh || released || !one.second.amplitude.empty();
  }

  void put_directions(SourceNode& step, const char* key, char kind, Conditions& values) {
    SourceNode& list = list_of(step, key);
    for (const auto& one : values) {
      if (!is_active(values, one) || one.second.fixed) continue;
      const auto& [set_and_direction, value] = one;
      SourceNode& entry = list.items.emplace_back(inp_map(value.line));
      put(entry, "on", inp_text(set_and_direction.first, value.line));
      put(entry, inp_component(kind, set_and_direction.second), inp_number(value.size, value.line));
      put_amplitude(entry, value, &values != &prescribed_);
    }
    drop_empty(step, key);
  }

  /// The list of a step, which may be there from the real parts.
  SourceNode& list_of(SourceNode& step, const char* key) const {
    for (SourceEntry& entry : step.entries)
      if (entry.key == key) return entry.value;
    return put(step, key, inp_list(line_of(step_->at)));
  }
  static void drop_empty(SourceNode& step, const std::string& key) {
    std::erase_if(step.entries, [&](const SourceEntry& entry) {
      return entry.key == key && entry.value.items.empty();
    });
  }

  void put_pressures(SourceNode& step, Conditions& pressures) {
    SourceNode& list = list_of(step, "pressure");
    for (const auto& one : pressures) {
      if (!is_active(pressures, one)) continue;
      SourceNode& entry = list.items.emplace_back(inp_map(one.second.line));
      put(entry, "on", inp_text(one.first.first, one.second.line));
      put(entry, "value", inp_number(one.second.size, one.second.line));
      put_amplitude(entry, one.second);
    }
    drop_empty(step, "pressure");
  }

  /// In the order of the deck: of a node in several sets the last counts.
  void put_temperatures(SourceNode& step) {
    SourceNode list = inp_list(line_of(step_->at));
    for (const auto& [on, value] : temperatures_) {
      if (!value.fresh && value.amplitude.empty()) continue;
      SourceNode& entry = list.items.emplace_back(inp_map(value.line));
      put(entry, "on", inp_text(on, value.line));
      put(entry, "value", inp_number(value.size, value.line));
      put_gradients(entry, value.gradient);
      put_amplitude(entry, value);
    }
    if (!list.items.empty()) put(step, "temperature", std::move(list));
  }

  void put_centrifugal(SourceNode& step) {
    SourceNode list = inp_list(line_of(step_->at));
    for (const auto& one : centrifugal_) {
      if (!is_active(centrifugal_, one)) continue;
      const int line = one.second.line;
      const std::array<double, 6>& axis = axes_[static_cast<std::size_t>(one.first.second)];
      SourceNode& entry = list.items.emplace_back(inp_map(line));
      put(entry, "on", inp_text(one.first.first, line));
      put(entry, "speed_squared", inp_number(one.second.size, line));
      for (const std::size_t k : {0, 3}) {
        SourceNode& point = put(entry, k == 0 ? "from" : "to", inp_list(line));
        for (std::size_t i = 0; i < 3; ++i) point.items.push_back(inp_number(axis[k + i], line));
      }
      put_amplitude(entry, one.second);
    }
    if (!list.items.empty()) put(step, "centrifugal", std::move(list));
  }

  /// Loads of steps in time act at once and displacements are ramped, where they name no amplitude.
  void put_amplitude(SourceNode& entry, const Condition& value, bool is_load = true) {
    if (imaginary_) put(entry, "phase", inp_number(90, value.line));
    if (!value.amplitude.empty())
      put(entry, "amplitude", inp_text(amplitude_here(value.amplitude), value.line));
    else if (at_once_ && is_load && !swung_)
      put(entry, "amplitude", inp_text(amplitude_at_once(), value.line));
  }

  std::string amplitude_at_once() {
    const std::string name = "at_once";
    if (find(out_.amplitudes, name)) return name;
    SourceNode& points = put(out_.amplitudes, name, inp_list(1));
    for (const double fraction : {0.0, 1.0}) {
      SourceNode& row = points.items.emplace_back(inp_list(1));
      row.items = {inp_number(fraction, 1), inp_number(1, 1)};
    }
    return name;
  }

  void put_of(SourceNode& list, const std::string& on, const std::vector<int>& directions) const {
    if (directions.empty()) return;
    const int line = line_of(step_->at);
    SourceNode& entry = list.items.emplace_back(inp_map(line));
    put(entry, "on", inp_text(on, line));
    SourceNode& of = put(entry, "of", inp_list(line));
    for (const int k : directions) of.items.push_back(inp_text(inp_component('u', k), line));
  }

  /// Nodes of a deck's rigid bodies are free at first, bodies of a model file are held.
  void put_releases(SourceNode& step) {
    SourceNode list = inp_list(line_of(step_->at));
    std::set<std::string> bodies;
    if (out_.steps.items.size() == 1)
      for (const auto& [node, body] : m_.body_nodes)
        if (body.rigid) bodies.insert(body.body);
    for (const std::string& body : bodies) {
      std::vector<int> free;
      for (int k = 1; k <= 6; ++k)
        if (exists(k) && !prescribed_.contains({body, k})) free.push_back(k);
      put_of(list, body, free);
    }
    for (const auto& [values, key] : released_)
      if (values == &prescribed_) put_of(list, key.first, {key.second});
    if (!list.items.empty()) put(step, "release", std::move(list));
  }

  void put_holds(SourceNode& step) {
    SourceNode list = inp_list(line_of(step_->at));
    for (const auto& [key, value] : prescribed_)
      if (value.fixed && value.fresh && !released_.contains({&prescribed_, key}))
        put_of(list, key.first, {key.second});
    if (!list.items.empty()) put(step, "hold", std::move(list));
  }

  void forget_removed() {
    for (const auto& [values, key] : released_) values->erase(key);
  }

  InpModel& m_;
  InpSteps out_;
  const Card *step_ = nullptr, *procedure_ = nullptr;
  double period_ = 1, total_time_ = 0;
  int increments_ = 1, modes_ = 0, factors_ = 0;
  std::array<double, 2> bounds_{};               ///< of the frequencies that are listed; 0: none
  std::optional<std::array<int, 2>> diameters_;  ///< of a sector of a ring: first and last
  std::tuple<Conditions, Conditions, Conditions, Conditions> before_;  ///< loads, of the last steps
  int vibrations_ = 0;  ///< that a step has found for those behind it
  int forgotten_ = 0;   ///< line of a load of that step
  std::map<std::pair<Conditions*, Conditions::key_type>, double> standing_;
  std::set<Conditions::key_type> held_;  ///< then
  bool superposed_ = false;              ///< a step has moved vibrations
  bool at_once_ = false, moved_ = false, about_start_ = false;
  std::map<std::string, Table> tables_;
  Conditions prescribed_, forces_, pressures_, body_forces_, centrifugal_;
  Conditions weights_;                                                ///< of point masses
  Conditions prescribed_2_, forces_2_, pressures_2_, body_forces_2_;  ///< imaginary parts
  bool swung_ = false;      ///< the last procedure is *STEADY STATE DYNAMICS
  bool imaginary_ = false;  ///< what is being put
  struct {
    double from = 0, to = 0, bias = 3;
    int points = 20;
  } range_;                                              ///< of it
  std::map<std::string, std::vector<Gravity>> gravity_;  ///< by part
  std::vector<std::array<double, 6>> axes_;              ///< of centrifugal loads: points of them
  std::set<std::pair<Conditions*, Conditions::key_type>> released_;
  std::vector<std::pair<std::string, Condition>> temperatures_, temperatures_before_;
  std::set<std::string> idle_;  ///< sets of nodes without elements that have been told of
};

}  // namespace

InpSteps inp_steps(InpModel& m) { return Steps(m).translate(); }

}  // namespace osculate::deck
