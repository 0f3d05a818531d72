#include "osculate/api/run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>

#include "osculate/api/agree.hpp"
#include "osculate/api/recorder.hpp"
#include "osculate/api/threads.hpp"
#include "osculate/core/error.hpp"
#include "osculate/core/memory.hpp"
#include "osculate/core/text.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/io/report.hpp"

namespace osculate::api {
namespace {

template <int Dim>
void write_results(Recorder<Dim>& recorder, const nlohmann::json& summary) {
  result::write_text(recorder.folder + "/summary.json", result::json_text(summary, 1) + "\n");
  if (!recorder.description.output.report) return;
  const std::string data = recorder.report.json(summary);
  result::write_text(recorder.folder + "/report.json", data);
  result::write_text(recorder.folder + "/report.html",
                     io::report_html(data, recorder.built.model.title));
}

template <int Dim>
RunOutcome finish(Recorder<Dim>& recorder, const model::BasicAnalysisResult<Dim>& result,
                  double seconds_input) {
  RunOutcome outcome;
  outcome.folder = recorder.folder;
  const bool done = result.outcome == solve::Outcome::converged && recorder.write_error.empty();
  outcome.status = done ? RunStatus::done : RunStatus::stopped;
  outcome.message = recorder.write_error.empty()
                        ? result.message
                        : recorder.write_error + "; what was written before is kept";
  if (result.outcome == solve::Outcome::stopped && !recorder.budget.used_up().empty())
    outcome.message = recorder.budget.used_up() + "; everything that converged is kept";
  nlohmann::json summary = result::summary_json(
      recorder.owner.at("model"), result, done ? "done" : "stopped",
      {seconds_input, recorder.seconds}, recorder.curvature_shares, recorder.notes);
  for (const deck::Setting& parameter : recorder.description.parameters)
    summary["parameters"][parameter.name] = parameter.value;
  summary["contact"] = recorder.penetration_reached();
  for (const result::AddedMass& added : recorder.masses)
    if (added.step < result.steps.size())
      summary["steps"][added.step]["mass_scaling"] = result::added_mass_json(added);
  const std::string& until = recorder.options.until;
  const std::vector<model::Step>& steps = recorder.built.model.steps;
  const bool all = done && (until.empty() || steps.empty() || until == steps.back().name);
  const bool free_to_move =
      result.failure && result.failure->cause == model::FailureCause::free_motion;
  recorder.say_all(recorder.watch.end(all || free_to_move));
  recorder.say_all(result::chosen_time_steps_text(result.steps, steps));
  recorder.say_all(result::linear_systems_text(result.linear));
  recorder.say_all(result::processes_text(result.processes));
  summary["message"] = outcome.message;
  summary.update(recorder.owner);
  if (result.failure) summary["diagnosis"] = result::diagnosis_json(recorder.built.model, result);
  try {
    write_results(recorder, summary);
  } catch (const io::WriteError& error) {
    if (recorder.write_error.empty()) throw;  // otherwise it has been said already
  }
  outcome.summary_json = result::json_text(summary, 1);
  const std::string work = recorder.time_steps > 0 && recorder.iterations == 0
                               ? fmt::format("{} time steps", recorder.time_steps)
                               : fmt::format("{} iterations", recorder.iterations);
  recorder.say(fmt::format("{}: {}, {:.1f} s, {} unknowns; results in {}",
                           done ? "done" : "stopped", work, result.seconds, result.unknowns,
                           recorder.folder));
  if (!done) recorder.say(outcome.message);
  if (done && !recorder.write_error.empty()) {  // the last lines of the log
    outcome.status = RunStatus::stopped;
    outcome.message = recorder.write_error;
  }
  return outcome;
}

template <int Dim>
model::BasicAnalysisObserver<Dim> observe(Recorder<Dim>& recorder) {
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&recorder](auto& system, const auto& state, const auto& p, auto* record) {
    return recorder.converged(system, state, p, record);
  };
  observer.interrupted = [&recorder] {
    const std::function<bool()>& abandoned = recorder.options.abandoned;
    return (abandoned && abandoned()) || !recorder.budget.begin_iteration();
  };
  observer.cutback = [&recorder](const std::string& reason, const model::Progress& p, double to,
                                 const std::vector<solve::IterationRecord>& iterations) {
    recorder.log_iterations(iterations);
    if (recorder.answers) recorder.answers->dropped(p, to, iterations);
    recorder.say(fmt::format("{}: no convergence from {:.5g} to {:.5g} of the step: {}; halving",
                             recorder.step_name(p), p.fraction, to, reason));
  };
  observer.begins = [&recorder](const auto& system, const auto& p) { recorder.begins(system, p); };
  observer.iterated = [&recorder](const auto& aim, int number, const auto& iteration) {
    recorder.iterated(aim, number, iteration);
  };
  observer.vibrates = [&recorder](const auto&, const auto& state, const auto& p,
                                  const auto& modes) {
    recorder.say_all(result::vibrations_text(recorder.step_name(p), modes));
    recorder.fields.write_modes(recorder.step_name(p), state, modes);
    if (recorder.answers) recorder.answers->vibrations(p, modes);
  };
  observer.buckles = [&recorder](const auto&, const auto& state, const auto& p, const auto& found) {
    recorder.say_all(result::buckling_text(recorder.step_name(p), found));
    recorder.fields.write_buckling(recorder.step_name(p), state, found);
    if (recorder.answers) recorder.answers->buckling(p, found);
  };
  observer.harmonic = [&recorder](auto& system, const auto& state, const auto& p,
                                  const auto& part) {
    return recorder.swings(system, state, p, part);
  };
  observer.resumable = [&recorder](const auto& system, const auto& state, const auto& p,
                                   const solve::StepPosition& position) {
    return recorder.save(system, state, p, position);
  };
  return observer;
}

/// An observer whose answers are those of the first process: of the others none has one.
template <int Dim>
model::BasicAnalysisObserver<Dim> answering_alike(const core::Ranks* ranks,
                                                  model::BasicAnalysisObserver<Dim> observer) {
  if (!ranks) return observer;
  model::BasicAnalysisObserver<Dim> alike = observer;
  alike.converged = [ranks, ask = observer.converged](auto& system, const auto& state,
                                                      const auto& p, auto* record) {
    return ranks->all(!ask || ask(system, state, p, record));
  };
  alike.resumable = [ranks, ask = observer.resumable](const auto& system, const auto& state,
                                                      const auto& p, const auto& position) {
    return ranks->any(ask && ask(system, state, p, position));
  };
  alike.interrupted = [ranks, ask = observer.interrupted] { return ranks->any(ask && ask()); };
  alike.harmonic = [ranks, ask = observer.harmonic](auto& system, const auto& state, const auto& p,
                                                    const auto& part) {
    return ranks->all(!ask || ask(system, state, p, part));
  };
  return alike;
}

template <int Dim>
void say_threads(Recorder<Dim>& recorder) {
  if (const int threads = recorder.built.options.threads; threads > 1)
    recorder.say(fmt::format("{:<13} {}", "Threads", threads));
}

/// What a run says and writes at its beginning.
template <int Dim>
void introduce(Recorder<Dim>& recorder, const result::RunIdentity& id) {
  for (const result::ModelFact& fact : result::model_facts(recorder.built))
    recorder.say(fmt::format("{:<13} {:<16} {}", fact.heading, fact.name, fact.text));
  say_threads(recorder);
  for (const std::string& warning : recorder.built.warnings) recorder.say("warning: " + warning);
  if (recorder.description.output.checkpoint != 0)
    recorder.checkpoints.emplace(recorder.folder, id);
  recorder.begin_report(recorder.first_report());
}

template <int Dim>
void introduce_restart(Recorder<Dim>& recorder, const result::Checkpoint<Dim>& from) {
  if (!from.warning.empty()) recorder.say("warning: " + from.warning);
  if (!from.note.empty()) recorder.say(from.note);
  recorder.resumed = recorder.done(from.point.progress);
  say_threads(recorder);
  recorder.say(fmt::format("restart after increment {} of step '{}', time {:.5g}",
                           from.point.progress.increment, recorder.step_name(from.point.progress),
                           from.point.progress.time));
}

/// Memory that the linear solver is short of is missed by all processes, with a reason of its own.
template <int Dim>
bool is_short_of_memory_alone(const model::BasicAnalysisResult<Dim>& result) {
  return result.outcome == solve::Outcome::out_of_memory &&
         result.message == core::out_of_memory_text(std::bad_alloc{});
}

/// What processes beside the first one do: the same analysis, and no files.
template <int Dim>
RunOutcome follow(const RunOptions& options, const deck::BasicBuilt<Dim>& built,
                  const result::Checkpoint<Dim>* from) {
  model::BasicAnalysisObserver<Dim> observer;
  observer.interrupted = options.abandoned;
  model::BasicAnalysisResult<Dim> result;
  try {
    result = model::run(built.model, built.options, answering_alike(built.options.ranks, observer),
                        from ? &from->point : nullptr);
  } catch (const la::NotEnoughMemory&) {  // of all
    result.outcome = solve::Outcome::out_of_memory;
  }
  if (options.abandoned) (void)options.abandoned();  // what has interrupted is to interrupt no more
  RunOutcome outcome;
  const bool done = result.outcome == solve::Outcome::converged;
  outcome.status = done ? RunStatus::done : RunStatus::stopped;
  return outcome;
}

/// What the process does that writes.
template <int Dim>
RunOutcome lead(const RunOptions& options, Recorder<Dim>& recorder,
                const deck::BasicBuilt<Dim>& built, const result::Checkpoint<Dim>* from,
                double seconds_input) {
  const core::Ranks* const ranks = options.together.ranks;
  model::BasicAnalysisObserver<Dim> observer = observe(recorder);
  if (from)
    observer.resumed = [&](const auto& system, const auto& state) {
      recorder.resume(*from, system, state);
    };
  model::BasicAnalysisResult<Dim> result;
  try {
    result = model::run(built.model, built.options, answering_alike(ranks, observer),
                        from ? &from->point : nullptr);
  } catch (const std::bad_alloc& error) {
    if (!recorder.history) throw;  // of the earlier run nothing has been touched
    result.outcome = solve::Outcome::out_of_memory;
    result.message = core::out_of_memory_text(error);
  } catch (const io::WriteError& error) {
    if (!ranks) throw;
    throw OneAlone(error.what());
  }
  if (result.failure) {
    recorder.fields.write_last_iterate(result.last_iterate, *result.failure);
    recorder.report.add_failure(result.last_iterate, *result.failure);
  }
  if (options.restart && result.outcome != solve::Outcome::converged) recorder.keep_last();
  RunOutcome outcome = finish(recorder, result, seconds_input);
  if (ranks && is_short_of_memory_alone(result)) throw OneAlone(result.message);
  return outcome;
}

template <int Dim>
RunOutcome run_built(const RunOptions& options, const deck::Description& description,
                     deck::BasicBuilt<Dim>& built, const nlohmann::json& owner,
                     std::chrono::steady_clock::time_point start) {
  built.options.threads = options.threads > 0      ? options.threads
                          : options.together.ranks ? 1
                                                   : threads_that_pay(built.model);
  built.options.until = options.until;
  const core::Ranks* const ranks = options.together.ranks;
  model::share(options.together, built.options);
  const bool leads = !ranks || ranks->rank() == 0;
  const result::RunIdentity id = result::identity(description, built.model.mesh, built.history);
  std::string folder;
  std::optional<result::FolderLock> lock;
  std::optional<result::Checkpoint<Dim>> from;
  agree(ranks, [&] {
    check_until(options.until, built.model.steps);
    folder = leads ? result::choose_folder(options.model, options.folder)
                   : result::result_folder(options.model, options.folder);
    if (leads) lock.emplace(folder, !options.restart);  // others may see what this writes, or not
    if (options.restart)
      from = result::read_checkpoint<Dim>(folder, id, built.model, options.model);
  });
  std::optional<Recorder<Dim>> recorder;
  double seconds_input = 0;
  agree(ranks, [&] {
    if (!leads) return;
    if (!from) result::claim_folder(folder, owner);
    result::open_folder(folder, options.restart);
    seconds_input = seconds_since(start);
    const Budget budget{options.max_iterations, options.max_minutes, start};
    recorder.emplace(options, description, built, owner, folder, budget);
    if (from)
      introduce_restart(*recorder, *from);
    else
      introduce(*recorder, id);
  });
  const result::Checkpoint<Dim>* const at = from ? &*from : nullptr;
  return leads ? lead(options, *recorder, built, at, seconds_input) : follow(options, built, at);
}

/// Of a deck with `*NO ANALYSIS`: what was understood, and nothing else.
template <int Dim>
RunOutcome check_alone(const RunOptions& options, const deck::BasicBuilt<Dim>& built) {
  const auto say = [&](const std::string& text) {
    if (options.say) options.say(text);
  };
  for (const result::ModelFact& fact : result::model_facts(built))
    say(fmt::format("{:<13} {:<16} {}", fact.heading, fact.name, fact.text));
  for (const std::string& warning : built.warnings) say("warning: " + warning);
  RunOutcome outcome;
  outcome.message = "*NO ANALYSIS: the deck is read and checked, nothing is solved";
  outcome.summary_json =
      result::json_text({{"status", "checked"}, {"message", outcome.message}}, 1);
  say(outcome.message);
  return outcome;
}

/// What goes on before the first increment, where that takes seconds.
void tell_of_reading(const RunOptions& options) {
  constexpr double large = 10, megabyte = 1e6;
  std::error_code ignored;
  const double size =
      static_cast<double>(std::filesystem::file_size(options.model, ignored)) / megabyte;
  if (options.progress && !ignored && size >= large)
    options.progress(fmt::format("reading {} ({:.0f} MB)", options.model, size));
}
void tell_of_building(const RunOptions& options, const mesh::Mesh& mesh) {
  constexpr std::size_t large = 200'000;
  if (options.progress && mesh.nodes.size() >= large)
    options.progress(fmt::format("preparing the model of {} nodes", mesh.nodes.size()));
}

}  // namespace

RunOutcome run(const RunOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  nlohmann::json owner = result::owner_json(options.model);
  tell_of_reading(options);
  deck::Description description;
  std::optional<deck::AnyBuilt> any;
  agree(options.together.ranks, [&] {
    description = options.document
                      ? deck::parse_model(*options.document, options.model, options.settings)
                      : deck::read_model(options.model, options.settings);
    if (!description.mesh.files.empty())
      owner["mesh_contents"] = result::mesh_contents(description.mesh);
    mesh::Mesh nodes_and_cells = deck::load_mesh(description);
    tell_of_building(options, nodes_and_cells);
    any = deck::build_any(description, std::move(nodes_and_cells));
  });
  if (description.check_only)
    return std::visit([&](const auto& built) { return check_alone(options, built); }, *any);
  return std::visit(
      [&](auto& built) { return run_built(options, description, built, owner, start); }, *any);
}

void rewrite_report(const std::string& folder) {
  const std::string data = result::read_text(folder + "/report.json");
  const auto outer = [](int depth, nlohmann::json::parse_event_t, const nlohmann::json&) {
    return depth <= 1;
  };
  const nlohmann::json report = nlohmann::json::parse(data, outer, false);
  if (const auto status = report.find("status"); status != report.end() && *status == "running")
    throw core::InputError({}, fmt::format("the run of folder '{}' has not ended, or was killed: "
                                           "it has left no report yet; 'osculate view {}' shows "
                                           "what there is",
                                           folder, folder));
  result::write_text(folder + "/report.html", io::report_html(data));
}

}  // namespace osculate::api
