#pragma once
// The steps of an Abaqus or CalculiX deck: what their cards say, and what is written of it. For
// inp_*.cpp.
#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "osculate/deck/inp_parts.hpp"

namespace osculate::deck {

// ---- amplitudes: inp_amplitudes.cpp -----------------------------------------------------------

/// An `*AMPLITUDE`.
struct InpTable {
  /// Waves about a mean from a time on, in place of points.
  struct Waves {
    double frequency = 0, start = 0, mean = 0;  ///< frequency: circular
    std::vector<std::array<double, 2>> terms;   ///< factors of cosines and sines
  };
  std::string name;
  bool of_total_time = false;
  std::vector<std::array<double, 2>> points;  ///< time and factor, by time
  std::optional<Waves> waves;
  int line = 0;
  io::inp::Place at{};
};
using InpTables = std::map<std::string, InpTable>;  ///< by name in capitals

void read_amplitude(const InpModel& m, const io::inp::Card& card, InpTables& tables);
/// The table that a load or support names, in capitals; with TIME DELAY one that begins so much
/// later. Empty: none.
[[nodiscard]] std::string amplitude_of(const InpModel& m, const io::inp::Card& card,
                                       InpTables& tables);
/// Names of amplitudes of the model file, added where they are missing: what a table is within a
/// step that begins at a time and has a width, and of loads that act at once.
[[nodiscard]] std::string amplitude_within(const InpModel& m, const InpTable& table, double from,
                                           double width, std::size_t step, SourceNode& amplitudes);
[[nodiscard]] std::string amplitude_at_once(SourceNode& amplitudes);

// ---- what a step does: inp_procedure.cpp ------------------------------------------------------

/// `*FIXED MASS SCALING`: holds in the steps after it, too.
struct InpMassScaling {
  const io::inp::Card* card = nullptr;  ///< null: there is none
  double stable_step = 0, factor = 1;   ///< 0: none is asked for
};

/// The card of a procedure such as `*STATIC`.
struct InpProcedure {
  const io::inp::Card* card = nullptr;  ///< null: the step has none yet
  double period = 1;
  int increments = 1;
  int modes = 0, factors = 0;                   ///< how many vibrations or buckling factors
  std::array<double, 2> bounds{};               ///< of the frequencies that are listed; 0: none
  std::optional<std::array<int, 2>> diameters;  ///< of a sector of a ring: first and last
  struct Range {
    double from = 0, to = 0, bias = 3;
    int points = 20;
  } range{};                 ///< of frequencies of `*STEADY STATE DYNAMICS`
  InpMassScaling scaling{};  ///< of `*DYNAMIC, EXPLICIT`
  bool about_start = false;  ///< its state is that before the first step

  [[nodiscard]] bool is(std::string_view keyword) const { return card && card->keyword == keyword; }
};

[[nodiscard]] bool is_procedure(const io::inp::Card& card);
/// `moved`: a step before has moved the bodies.
[[nodiscard]] InpProcedure inp_procedure(const InpModel& m, const io::inp::Card& step,
                                         const io::inp::Card& card, bool moved);
/// `*SELECT CYCLIC SYMMETRY MODES`.
void read_diameters(const InpModel& m, const io::inp::Card& card, InpProcedure& procedure);
/// Adds `modes` or `buckling`; increments and duration; the range of frequencies as a new map.
void put_search(const InpProcedure& procedure, SourceNode& step);
void put_time(InpModel& m, const InpProcedure& procedure, SourceNode& step);
SourceNode& put_range(const InpProcedure& procedure, SourceNode& step);
/// Time integration of a `*DYNAMIC`. In inp_dynamics.cpp.
[[nodiscard]] SourceNode inp_dynamics(const InpModel& m, const InpProcedure& procedure);
/// `*FIXED MASS SCALING` in a step with this procedure.
[[nodiscard]] InpMassScaling read_mass_scaling(const InpModel& m, const io::inp::Card& card,
                                               const InpProcedure& procedure);
/// `modal` of a step that ends with the last of these cards, with so many vibrations: the last
/// damping of the deck holds, as in CalculiX. In inp_modal.cpp.
[[nodiscard]] SourceNode inp_modal(const InpModel& m, std::span<const io::inp::Card> until,
                                   int line, int vibrations);

// ---- what acts in a step: inp_conditions.cpp, inp_loads.cpp -----------------------------------

struct Condition {
  double size = 0;
  std::string amplitude;  ///< name in the deck, in capitals; empty: a ramp
  int line = 0;
  bool fresh = true;                 ///< said in this step, or since the last one
  bool stands = false;               ///< the steps before have one here
  bool between = false;              ///< said before the step, not in it
  bool fixed = false;                ///< a displacement that stays where it is
  bool swings = false;               ///< said in a step of *STEADY STATE DYNAMICS
  std::array<double, 2> gradient{};  ///< of temperatures
  bool released = false;             ///< ends with this step, which says OP=NEW
};
/// By set or rigid body and direction 1 to 6; of pressures always 1, of centrifugal loads the
/// number of the axis.
using Conditions = std::map<std::pair<std::string, int>, Condition>;

struct InpConditions {
  Conditions prescribed, forces, pressures, tractions, body_forces, centrifugal;
  Conditions weights;  ///< of point masses, which act with body forces
};
[[nodiscard]] inline std::array<Conditions*, 6> loads_of(InpConditions& all) {
  return {&all.forces,      &all.pressures,   &all.tractions,
          &all.body_forces, &all.centrifugal, &all.weights};
}

/// A GRAV of a part of the bodies: by which set, along which direction.
struct InpGravity {
  std::string set;
  Vec3 direction;
};
/// What acts, step by step.
struct InpActing {
  std::array<InpConditions, 2> parts;  ///< real and imaginary
  std::vector<std::pair<std::string, Condition>> temperatures;
  std::map<std::string, std::vector<InpGravity>> gravity;  ///< by part of the bodies
  std::vector<std::array<double, 6>> axes;  ///< of centrifugal loads: two points of each
};

/// Sets, each with those that overlap it and have been loaded by a step before or after, or held.
using InpOverlaps = std::map<std::string, std::set<std::string>>;
/// The parts that such a set is loaded by, one by one: CalculiX has one load in a direction of a
/// node or on a facet, which that of a later step replaces, and one support, that of the last line.
using InpLoadParts = std::map<std::string, std::vector<std::string>>;

/// Where a card of supports or loads stands.
struct InpReading {
  InpModel& m;
  InpTables& tables;
  InpActing& acting;
  std::set<std::string>& idle;  ///< sets of nodes without elements that have been told of
  const InpLoadParts& parts;
  const InpProcedure& procedure;  ///< of the step, as far as it is read
  bool in_step = false;
  bool swings = false;  ///< the last procedure is *STEADY STATE DYNAMICS
};
/// What the lines of such a card have in common.
struct InpSaid {
  std::string amplitude;
  bool swings = false;
  bool between = false;
  bool fixed = false;
};

/// Reads `*BOUNDARY`, `*CLOAD`, `*TEMPERATURE`; `*DLOAD` and `*DSLOAD`.
void read_condition(const InpReading& r, const io::inp::Card& card);
void read_load(const InpReading& r, const io::inp::Card& card);
/// Ends with this step.
void release(Condition& value);
/// Checks the parameters of a card that adds to what stood before; with OP=NEW that is gone.
InpSaid begin_card(const InpReading& r, const io::inp::Card& card, Conditions& values);
/// Of one step the sizes of loads add up.
void set_condition(const InpModel& m, Conditions& values, const std::pair<std::string, int>& place,
                   double size, const InpSaid& said, const io::inp::Line& line, bool adds);
/// The same on a set, or on its parts.
void set_on_parts(const InpReading& r, Conditions& values, const std::pair<std::string, int>& place,
                  double size, const InpSaid& said, const io::inp::Line& line, bool adds);
/// Real or imaginary ones.
[[nodiscard]] InpConditions& part_of(const InpReading& r, const io::inp::Card& card);
/// What a step has said is what the next ones find.
void end_conditions(InpActing& acting);
/// Notes sets of loads of a step that overlap others, which a step before has loaded in the same
/// direction, and sets of supports that hold nodes of each other in another way, or are released
/// together; the parts of all of them, which become new sets. In inp_load_parts.cpp.
void note_overlaps(const InpModel& m, const Conditions& loads, InpOverlaps& overlaps);
void note_overlaps_of_supports(const InpModel& m, const Conditions& prescribed,
                               InpOverlaps& overlaps);
[[nodiscard]] InpLoadParts load_parts(InpModel& m, const InpOverlaps& overlaps);

// ---- motions along vibrations: inp_vibrations.cpp ---------------------------------------------

/// What a step with `*FREQUENCY` has found for those behind it.
struct InpVibrations {
  int count = 0;
  bool about_start = false;
  int forgotten = 0;                    ///< line of a load of that step, which is of no account
  std::set<Conditions::key_type> held;  ///< supports
  InpConditions standing;               ///< loads of their state
};
[[nodiscard]] InpVibrations found_vibrations(const InpProcedure& procedure, InpActing& acting,
                                             InpConditions standing);
/// Refuses a card that needs vibrations of a step before, and what cannot be done with them.
void check_vibrations(const InpModel& m, const io::inp::Card& card, const InpVibrations& found);
/// PERTURBATION must be said of both steps.
void check_perturbation(const InpModel& m, const io::inp::Card& step, const io::inp::Card& card,
                        const InpVibrations& found, bool moved);
/// Supports are those that the step which has found the vibrations knows.
void check_supports(const InpModel& m, const io::inp::Card& card, const InpVibrations& found,
                    const InpActing& acting);
/// What CalculiX does to loads of steps before: they go on in a step without PERTURBATION, unless
/// they have an amplitude, and are the state in one with it.
void put_on_top(const InpModel& m, const io::inp::Card& step, const io::inp::Card& card,
                const InpVibrations& found, InpConditions& acting);
/// Refuses what of a step before would swing along.
void check_swinging(const InpModel& m, const io::inp::Card& card, InpActing& acting);

// ---- the step of the model file: inp_step.cpp -------------------------------------------------

/// A step that is written.
struct InpWriting {
  const InpModel& m;
  const InpTables& tables;
  SourceNode& amplitudes;
  SourceNode& step;
  const InpProcedure& procedure;
  std::size_t number = 1;  ///< of the step
  int line = 0;            ///< of the step
  double total_time = 0;   ///< before it
  bool at_once = false;    ///< loads without amplitude are no ramps
};
/// Forces at nodes and rigid bodies, those of `*CLOAD` and weights of masses: the sum where both
/// act.
[[nodiscard]] Conditions with_weights(const InpWriting& w, const InpConditions& part);
/// Steps in time with loads that act at once where they name no amplitude.
[[nodiscard]] bool is_at_once(const io::inp::Card& step, const InpProcedure& procedure);
/// Adds the displacements that are prescribed; `sudden`: they act at once, as loads do.
void put_prescribed(const InpWriting& w, const Conditions& prescribed, bool sudden = false,
                    bool imaginary = false);
/// Adds what is no longer prescribed, and what stays where it is.
void put_releases(const InpWriting& w, const Conditions& prescribed);
void put_holds(const InpWriting& w, const Conditions& prescribed);
void put_loads(const InpWriting& w, InpActing& acting, bool imaginary = false);
/// In the order of the deck: of a node in several sets the last counts.
void put_temperatures(const InpWriting& w, const InpActing& acting);

}  // namespace osculate::deck
