#include "osculate/model/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>

#include "osculate/core/memory.hpp"
#include "osculate/la/by_itself.hpp"
#include "osculate/la/condensed.hpp"
#include "osculate/la/iterative.hpp"
#include "osculate/model/body_changes.hpp"
#include "osculate/model/cyclic_vibrations.hpp"
#include "osculate/model/harmonic.hpp"
#include "osculate/model/pair_changes.hpp"
#include "osculate/model/superposition.hpp"

namespace osculate::model {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// In the time of the analysis.
double length_of(const Step& step) { return takes_time(step) ? step.duration : 1.0; }

/// One analysis on its way.
template <int Dim>
struct Analysis {
  const BasicModel<Dim>& model;
  const AnalysisOptions& options;
  const BasicAnalysisObserver<Dim>& observer;
  BasicSystem<Dim> system;
  std::unique_ptr<la::LinearSolver> solver = options.linear_solver();
  BasicAnalysisResult<Dim> result{};
  Progress progress{};
  double begun = 0;  ///< time at the beginning of the running step
  solve::StepPosition position{};
  std::optional<BasicSuperposition<Dim>> superposition{};  ///< of the last vibrations that moved
  std::optional<BasicHarmonicSystem<Dim>> swinging{};      ///< of the last ones that swung

  /// Tells the observer; false to stop. Motions along vibrations leave no trace in the state that a
  /// later run goes on from: it repeats them.
  bool tell(const BasicState<Dim>& state, const solve::IncrementRecord* record) {
    const bool go_on = !observer.converged || observer.converged(system, state, progress, record);
    const bool passes = superposition && record;
    position.anew =
        observer.resumable &&
        observer.resumable(system, passes ? superposition->standing : state, progress, position);
    return go_on;
  }
  /// Steps begin where those that are no motions along vibrations have led to.
  void forget_motion(const Step& step) {
    if (superposition) result.state = superposition->standing;
    if (!step.modal) superposition.reset();
    if (!step.harmonic) swinging.reset();
  }

  /// Central differences: the increments of the step are where results are told.
  void run_explicit_step(const Step& step,
                         const solve::IncrementObserver<BasicState<Dim>>& on_increment) {
    if (observer.begins) observer.begins(system, progress);
    for (; position.nominal < step.increments; ++position.nominal) {
      const double end = static_cast<double>(position.nominal + 1) / step.increments;
      if (position.at >= end) continue;  // resumed
      ExplicitIncrement<BasicState<Dim>> done = system.advance(result.state, end);
      result.last_iterate = done.state.u.allFinite() ? done.state : result.state;
      if (done.outcome != solve::TimeStepping::done) {
        result.outcome = solve::Outcome::numerical_failure;
        result.failure = explicit_failure<Dim>(step, done.outcome, done.reason, position.at);
        result.message = result.failure->message;
        return;
      }
      result.state = std::move(done.state);
      position.at = end;
      solve::IncrementRecord record;
      record.fraction = end;
      record.iterations.push_back({.counts = done.counts});
      record.time_steps = done.time_steps;
      result.steps.back().increments.push_back(record);
      if (on_increment(result.state, record)) continue;
      result.outcome = solve::Outcome::stopped;
      result.message = "stopped by the user";
      return;
    }
  }

  void find_vibrations(const Step& step) {
    const BasicState<Dim> about =
        step.frequencies->unloaded ? system.initial_state() : result.state;
    Vibrations modes =
        step.frequencies->diameters.empty()
            ? system.vibrations(about, step.frequencies->modes, *solver)
            : cyclic_vibrations(model, step, about, options.threads, options.linear_solver);
    result.last_iterate = result.state;
    if (!modes.failure.empty()) {
      result.outcome = solve::Outcome::numerical_failure;
      result.message =
          fmt::format("no vibrations were found in step '{}': {}", step.name, modes.failure);
      return;
    }
    if (observer.vibrates) observer.vibrates(system, about, progress, modes);
    const auto next = static_cast<std::size_t>(progress.step) + 1;
    if (next == model.steps.size() || (!model.steps[next].modal && !model.steps[next].harmonic))
      modes.forget_unknowns();
    result.steps.back().vibrations = std::move(modes);
  }

  void find_buckling(const Step& step) {
    const bool unloaded = step.buckling->unloaded;
    const BasicState<Dim> of = unloaded ? system.initial_state() : result.state;
    if (unloaded) system.begin_step(step, of);
    Buckling found = system.buckling(of, step.buckling->factors, *solver);
    result.last_iterate = result.state;
    if (!found.failure.empty()) {
      result.outcome = solve::Outcome::numerical_failure;
      result.message =
          fmt::format("no buckling load was found in step '{}': {}", step.name, found.failure);
      return;
    }
    if (observer.buckles) observer.buckles(system, of, progress, found);
    result.steps.back().buckling = std::move(found);
  }

  /// The last step before that has looked for vibrations. False: there is none.
  bool find_step_of_vibrations(std::size_t s, std::size_t& of) {
    of = s;
    while (of > 0 && !model.steps[of].frequencies) --of;
    if (model.steps[of].frequencies) return true;
    result.outcome = solve::Outcome::numerical_failure;
    result.message =
        fmt::format("step '{}': no step before it has found vibrations", model.steps[s].name);
    return false;
  }

  /// Those that a step has found, again where they have been forgotten; that step is begun.
  std::optional<Vibrations>& known_vibrations(std::size_t of) {
    system.begin_step(model.steps[of], result.state);
    std::optional<Vibrations>& known = result.steps[of].vibrations;
    const bool unloaded = model.steps[of].frequencies->unloaded;
    if (!known || known->vectors.size() == 0)
      known = system.vibrations(unloaded ? system.initial_state() : result.state,
                                model.steps[of].frequencies->modes, *solver);
    return known;
  }

  /// Vibrations that swing in the running step, and its supports. False: they cannot.
  bool begin_harmonic(std::size_t s) {
    const Step& step = model.steps[s];
    std::string failure;
    if (!swinging) {
      std::size_t of = s;
      if (!find_step_of_vibrations(s, of)) return false;
      std::optional<Vibrations>& known = known_vibrations(of);
      failure = known->failure;
      if (failure.empty())
        swinging = harmonic_system(system, model.steps[of], result.state, *known, failure);
      known->forget_unknowns();
    }
    if (failure.empty())
      begin_harmonic_step(system, step, options.linear_solver, *swinging, failure);
    if (failure.empty()) return true;
    result.outcome = solve::Outcome::numerical_failure;
    result.message = fmt::format("step '{}': {}", step.name, failure);
    return false;
  }

  /// One frequency of a harmonic step. Empty: it is done; else why it is not.
  std::string swing(double frequency, const solve::IncrementRecord& record, bool& go_on) {
    std::string failure;
    const HarmonicMotion motion = harmonic_response(system, *swinging, frequency, failure);
    for (const bool imaginary : {false, true}) {
      if (!failure.empty()) return failure;
      const Superposed<Dim> now = harmonic_part(system, *swinging, motion, imaginary);
      failure = now.failure;
      if (failure.empty() && observer.harmonic)
        go_on = observer.harmonic(system, now.state, progress,
                                  {motion, swinging->modes.omega_squared, imaginary, record}) &&
                go_on;
    }
    return failure;
  }

  /// One frequency after the other; those that a resumed run has behind it are left out. The state
  /// of the steps before stays.
  void run_harmonic(const Step& step) {
    result.last_iterate = result.state;
    if (!begin_harmonic(static_cast<std::size_t>(progress.step))) return;
    const std::vector<double> frequencies = sweep(*step.harmonic, swinging->modes.omega_squared);
    const auto count = static_cast<int>(frequencies.size());
    for (int i = position.nominal; i < count; ++i) {
      solve::IncrementRecord record;
      record.fraction = static_cast<double>(i + 1) / count;
      progress.increment = i + 1;
      progress.fraction = record.fraction;
      progress.time = frequencies[static_cast<std::size_t>(i)];
      bool go_on = true;
      const std::string failure = swing(progress.time, record, go_on);
      if (!failure.empty()) {
        result.outcome = solve::Outcome::numerical_failure;
        result.message = fmt::format("step '{}': {}", step.name, failure);
        return;
      }
      position.at = record.fraction;
      position.nominal = i + 1;
      result.steps.back().increments.push_back(record);
      system.begin_step(step, result.state);
      if (observer.resumable) observer.resumable(system, result.state, progress, position);
      if (go_on) continue;
      result.outcome = solve::Outcome::stopped;
      result.message = "stopped by the user";
      return;
    }
  }

  /// What vibrations move in the running step, which may have been resumed: at rest, or as the step
  /// before left them. False: they cannot.
  bool begin_superposition(std::size_t s) {
    if (superposition) return true;
    std::size_t of = s;
    if (!find_step_of_vibrations(s, of)) return false;
    const BasicState<Dim> standing = result.state;
    std::optional<Vibrations>& known = known_vibrations(of);
    std::string failure = known->failure;
    if (failure.empty())
      superposition =
          model::superposition(model, system, model.steps[of], standing, *known, failure);
    known->forget_unknowns();
    for (std::size_t before = of + 1; before < s && failure.empty(); ++before) {
      system.begin_step(model.steps[before], standing);
      for (int i = 0; i < model.steps[before].increments; ++i)
        advance(system, model.steps[before], i, *superposition);
    }
    if (failure.empty() && s == of + 1)
      carry(system, model.steps[s], *options.linear_solver(), *superposition, failure);
    system.begin_step(model.steps[s], standing);
    if (failure.empty()) return true;
    result.outcome = solve::Outcome::numerical_failure;
    result.message = fmt::format("step '{}': {}", model.steps[s].name, failure);
    return false;
  }

  /// Motion along vibrations. Increments that a resumed run has behind it are repeated.
  void run_superposition(const Step& step,
                         const solve::IncrementObserver<BasicState<Dim>>& on_increment) {
    if (!begin_superposition(static_cast<std::size_t>(progress.step))) return;
    for (int i = 0; i < step.increments; ++i) {
      advance(system, step, i, *superposition);
      if (i < position.nominal) continue;
      const double end = static_cast<double>(i + 1) / step.increments;
      Superposed<Dim> now = superposed(system, end, *superposition);
      if (!now.failure.empty()) {
        result.outcome = solve::Outcome::numerical_failure;
        result.message =
            fmt::format("increment {} of step '{}': {}", i + 1, step.name, now.failure);
        return;
      }
      result.last_iterate = result.state = std::move(now.state);
      position.at = end;
      position.nominal = i + 1;
      solve::IncrementRecord record;
      record.fraction = end;
      result.steps.back().increments.push_back(record);
      if (on_increment(result.state, record)) continue;
      result.outcome = solve::Outcome::stopped;
      result.message = "stopped by the user";
      return;
    }
  }

  /// What the linear solver is told of the unknowns of a step.
  void introduce(bool iterates) {
    solver->may_change(iterates ? system.changing_unknowns() : std::vector<Index>{});
    if (!solver->asks_for_places()) return;
    la::Places places = iterates ? system.unknown_places() : la::Places{};
    places.threads = options.threads;
    solver->place(std::move(places));
  }
  /// The solver is done with.
  void take_leave() {
    result.seconds_solver += solver->seconds();
    const la::IterativeWork work = solver->work();
    result.linear.solutions += work.solutions;
    result.linear.iterations += work.iterations;
    result.linear.given_up += work.given_up;
  }

  std::function<void(const solve::IterationDone&)> told_of_iterations(const Step& step) {
    return [this, length = length_of(step)](const solve::IterationDone& done) {
      const Progress aim{progress.step, progress.increment + 1, done.to, begun + done.to * length};
      observer.iterated(aim, done.number, done.record);
    };
  }

  void run_step(const Step& step) {
    introduce(finds_balance(step));
    if (finds_balance(step)) return carry_out(step);
    la::by_itself(options.ranks, [&] { carry_out(step); });
  }

  void carry_out(const Step& step) {
    if (step.frequencies) return find_vibrations(step);
    if (step.buckling) return find_buckling(step);
    if (step.harmonic) return run_harmonic(step);
    const auto on_increment = [&](const BasicState<Dim>& state,
                                  const solve::IncrementRecord& record) {
      ++progress.increment;
      progress.fraction = record.fraction;
      progress.time = begun + record.fraction * length_of(step);
      const bool go_on = tell(state, &record);
      if (go_on && record.fraction < 1 && system.share_anew(state)) {
        solver->begin_anew();
        position.anew = true;
      }
      return go_on;
    };
    const auto on_cutback = [&](const std::string& reason, double from, double to,
                                const std::vector<solve::IterationRecord>& iterations) {
      progress.fraction = from;
      if (observer.cutback) observer.cutback(reason, progress, to, iterations);
    };
    if (step.modal) return run_superposition(step, on_increment);
    if (step.dynamics && step.dynamics->explicit_steps) {
      run_explicit_step(step, on_increment);
      return;
    }
    solve::IncrementOptions increments = options.increments;
    if (observer.iterated) increments.newton.iterated = told_of_iterations(step);
    if (step.dynamics) increments.arc_length.use = solve::PathControl::off;  // time does not turn
    if (step.dynamics && step.dynamics->time_steps)
      increments.time_steps =
          solve::TimeAccuracy{step.dynamics->time_steps->error,
                              step.dynamics->time_steps->smallest / step.duration, corners(step)};
    solve::StepResult<BasicState<Dim>, BasicTrial<Dim>> done =
        solve::run_step(system, result.state, step.increments, increments, *solver, on_increment,
                        on_cutback, position);
    // Memory that one process alone is short of: the others wait, and nothing may be ended
    // together.
    if (options.ranks && done.outcome == solve::Outcome::out_of_memory &&
        done.reason == core::out_of_memory_text(std::bad_alloc{}))
      throw std::bad_alloc{};
    result.state = done.state;
    result.last_iterate = done.state;
    result.outcome = done.outcome;
    const bool ended =
        done.outcome == solve::Outcome::stopped || done.outcome == solve::Outcome::out_of_memory;
    if (ended) result.message = done.reason;
    if (done.outcome != solve::Outcome::converged && !ended) {
      system.share_no_more();
      result.failure = diagnose(system, model, step, done);
      result.message = result.failure->message;
      result.last_iterate = done.last_attempt.trial.state;
    }
    std::vector<solve::IncrementRecord>& records = result.steps.back().increments;
    records.insert(records.end(), std::make_move_iterator(done.increments.begin()),
                   std::make_move_iterator(done.increments.end()));
  }
};

/// The first state and its evaluation, which gives the search trees their shape.
template <int Dim>
BasicState<Dim> first_state(Analysis<Dim>& a) {
  BasicState<Dim> state = a.system.initial_state();
  if (!a.model.steps.empty()) a.system.begin_step(a.model.steps.front(), state);
  solve::Evaluation initial;
  a.system.evaluate(state, 0.0, false, initial);
  return state;
}

/// Pairs, bodies and equations as they are in a step that begins; `now` is what the system sees.
template <int Dim>
void change(const BasicModel<Dim>& model, std::size_t step, BasicModel<Dim>& now,
            Analysis<Dim>& a) {
  change_pairs(model, step, now);
  a.result.state = begin_anew(model, step, now, std::move(a.result.state));
  if (step == 0 || !bodies_change(model, step)) return;
  change_bodies(model, step, now);
  a.result.state = begin_bodies(model, step, std::move(a.result.state));
  a.system.build_anew();
  a.result.unknowns = std::max(a.result.unknowns, a.system.dofs().unknowns());
  a.take_leave();
  a.solver = a.options.linear_solver();
  (void)first_state(a);
}

/// False to stop.
template <int Dim>
bool begin(Analysis<Dim>& a, const BasicResumePoint<Dim>* from) {
  a.result.state = first_state(a);
  if (!from && !a.model.steps.empty()) a.result.state = a.system.begin_motion(a.result.state);
  if (!from) return a.tell(a.result.state, nullptr);
  a.result.state = from->state;
  a.result.steps = from->steps;
  a.progress = from->progress;
  a.position = from->position;
  return true;
}

}  // namespace

void share(const Together& together, AnalysisOptions& options) {
  if (!together.ranks) return;
  options.ranks = together.ranks;
  options.by_multigrid = together.ranks->any(options.by_multigrid);  // machines differ in memory
  options.linear_solver = [together, iterates = options.by_multigrid] {
    const la::MumpsOptions direct{.shared = together.solvers.mumps};
    std::unique_ptr<la::LinearSolver> solver;
    if (iterates)
      solver = std::make_unique<la::Iterative>(direct);
    else
      solver = std::make_unique<la::Condensed>(direct);
    return solver;
  };
}

template <int Dim>
BasicAnalysisResult<Dim> run(const BasicModel<Dim>& model, const AnalysisOptions& options,
                             const BasicAnalysisObserver<Dim>& observer,
                             const BasicResumePoint<Dim>* from) {
  const auto start = std::chrono::steady_clock::now();
  const double in_calls = options.ranks ? options.ranks->seconds() : 0;
  std::optional<BasicModel<Dim>> changing;  // where it changes from step to step
  if (!model.pair_changes.empty() || !model.body_changes.empty()) changing = model;
  if (changing) {
    const std::size_t running = from ? static_cast<std::size_t>(from->progress.step) : 0;
    change_pairs(model, running, *changing);
    if (!model.body_changes.empty()) change_bodies(model, running, *changing);
  }
  const BasicModel<Dim>& now = changing ? *changing : model;
  Analysis<Dim> a{now, options, observer, {now, options.threads, options.ranks}};
  BasicAnalysisResult<Dim>& result = a.result;
  result.unknowns = a.system.dofs().unknowns();
  a.system.interrupt_by(observer.interrupted);
  if (!begin(a, from)) {
    result.outcome = solve::Outcome::stopped;
    result.message = "stopped by the user";
    result.last_iterate = result.state;
    result.seconds = seconds_since(start);
    return result;
  }
  const auto first = static_cast<std::size_t>(a.progress.step);
  if (from && !model.steps.empty())
    a.system.resume_step(model.steps[first], result.state, from->memory);
  if (from && observer.resumed) observer.resumed(a.system, result.state);
  for (std::size_t s = first; s < model.steps.size(); ++s) {
    const Step& step = model.steps[s];
    a.begun = 0;
    for (std::size_t before = 0; before < s; ++before) a.begun += length_of(model.steps[before]);
    if (!from || s != first) {
      a.progress.step = static_cast<Index>(s);
      a.progress.increment = 0;
      a.position = {};
      a.forget_motion(step);
      if (changing) change(model, s, *changing, a);
      a.system.begin_step(step, result.state);
      result.state = a.system.begin_motion(result.state);
    }
    if (result.steps.size() == s) result.steps.push_back({step.name, {}});
    a.run_step(step);
    if (result.outcome != solve::Outcome::converged || step.name == options.until) break;
  }
  result.seconds_system = a.system.seconds();
  a.take_leave();
  result.seconds = seconds_since(start);
  if (options.ranks)
    result.processes =
        records_of(options.ranks, result.seconds, options.ranks->seconds() - in_calls);
  return result;
}

template AnalysisResult run(const Model&, const AnalysisOptions&, const AnalysisObserver&,
                            const ResumePoint*);
template AnalysisResult3 run(const Model3&, const AnalysisOptions&, const AnalysisObserver3&,
                             const ResumePoint3*);

}  // namespace osculate::model
