#pragma once
// What a run writes while it goes on; for sources of this layer.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "osculate/api/budget.hpp"
#include "osculate/api/run.hpp"
#include "osculate/io/csv.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/model/diagnosis.hpp"
#include "osculate/pairing/tangent_parts.hpp"
#include "osculate/result/added_mass.hpp"
#include "osculate/result/answer_files.hpp"
#include "osculate/result/checkpoint.hpp"
#include "osculate/result/field_files.hpp"
#include "osculate/result/increment_text.hpp"
#include "osculate/result/iteration_file.hpp"
#include "osculate/result/penetration.hpp"
#include "osculate/result/report_data.hpp"
#include "osculate/result/result_folder.hpp"
#include "osculate/result/summary.hpp"
#include "osculate/result/watch.hpp"

namespace osculate::api {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline std::vector<std::string> column_names(const std::vector<model::HistoryRequest>& requests) {
  std::vector<std::string> names;
  for (const model::HistoryRequest& request : requests) names.push_back(request.name);
  return names;
}

inline std::uint64_t size_of(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return error ? 0 : size;
}

/// Everything a run writes while it goes on.
template <int Dim>
struct Recorder {
  const RunOptions& options;
  const deck::Description& description;
  const deck::BasicBuilt<Dim>& built;
  const nlohmann::json& owner;  ///< whose results these are
  std::string folder;
  std::optional<io::HistoryWriter> history;
  result::FieldFiles<Dim> fields;
  result::ReportCollector<Dim> report;
  io::AppendFile log;
  result::IterationFile iteration_file;
  std::optional<result::CheckpointWriter<Dim>> checkpoints;
  result::JournalEntry entry{};  ///< of the increment that has just converged
  std::string write_error;       ///< why the run had to stop, if a file could not be written
  bool stopping = false;
  bool kept = false;  ///< this run has left something to go on from
  /// Of the last increment, until then.
  std::optional<model::BasicResumePoint<Dim>> not_kept{};
  bool unwanted = false;  ///< who watches wants no more
  Budget budget;
  double resumed = 0;       ///< share of the work that was done before this run
  int converged_count = 0;  ///< increments
  int iterations = 0;
  long time_steps = 0;                   ///< of explicit time integration
  std::string governed_by;               ///< what governed the last of them
  double seconds = 0;                    ///< spent here
  std::vector<double> curvature_shares;  ///< one per converged increment
  std::vector<nlohmann::json> notes;     ///< one per converged increment
  result::PointStates states = result::point_states(built.model);
  std::vector<result::AddedMass> masses{};  ///< of explicit steps that have begun here
  result::Watch<Dim> watch{built.model};
  std::vector<std::string> warned;  ///< of contact in the last increment
  std::optional<result::AnswerFiles<Dim>> answers{};

  Recorder(const RunOptions& o, const deck::Description& d, const deck::BasicBuilt<Dim>& b,
           const nlohmann::json& o_json, std::string dir, Budget limits)
      : options(o),
        description(d),
        built(b),
        owner(o_json),
        folder(std::move(dir)),
        fields(folder, b, d.output),
        report(b, d),
        log(folder + "/log.txt", o.restart ? size_of(folder + "/log.txt") : 0),
        iteration_file(folder, o.restart),
        budget(std::move(limits)) {
    if (o.restart) return;
    history.emplace(folder + "/history.csv", column_names(b.history));
    open_answers({});
  }

  void open_answers(std::span<const std::uint64_t> marks) {
    const auto stem =
        result::answer_stem(description.output, options.model, folder, options.answers);
    if (!stem.empty()) answers.emplace(stem, built, description.output, marks);
  }

  /// Everything as it was when the checkpoint was written. Here the files of the earlier run are
  /// cut, and not before: the analysis stands where it goes on from.
  void resume(const result::Checkpoint<Dim>& from, const model::BasicSystem<Dim>& system,
              const model::BasicState<Dim>& state) {
    result::claim_folder(folder, owner);
    const std::string first = first_report();
    std::vector<io::PvdEntry> files;
    std::vector<io::HistoryRow> rows;
    for (const result::JournalEntry& e : from.entries) {
      rows.push_back(row_of(e.progress, e.row));
      report_row(e.progress, e.row);
      if (!e.frame.empty()) report.add_frame(nlohmann::json::from_cbor(e.frame));
      files.insert(files.end(), e.files.begin(), e.files.end());
      watch.deepest = e.deepest;
      if (!e.record) continue;
      ++converged_count;
      iterations += static_cast<int>(e.record->iterations.size()) + e.record->wasted_iterations;
      curvature_shares.push_back(e.curvature_share);
      notes.push_back(nlohmann::json::parse(e.note));
    }
    watch.resume(from.watch, system, state, converged_count == 0);
    history.emplace(folder + "/history.csv", column_names(built.history), rows);
    begin_report(first);
    const std::vector<char>& touched = from.entries.back().touched;
    fields.resume(std::move(files), {touched.begin(), touched.end()});
    open_answers(from.entries.back().answers);
    if (description.output.checkpoint != 0) checkpoints.emplace(folder, from);
  }

  [[nodiscard]] static io::HistoryRow row_of(const model::Progress& p,
                                             const std::vector<double>& values) {
    return {std::to_string(p.step + 1), p.increment, p.time, values};
  }

  void report_row(const model::Progress& p, std::vector<double> values) {
    values.insert(values.begin(),
                  {static_cast<double>(p.step + 1), static_cast<double>(p.increment), p.time});
    report.add_history(values);
  }

  /// What there is of the report before the first increment, for who watches the run.
  [[nodiscard]] std::string first_report() const {
    return description.output.report ? report.first_json() : std::string{};
  }

  /// Where it cannot be written the run ends after this increment.
  void begin_report(const std::string& first) {
    if (first.empty()) return;
    try {
      result::write_text(folder + "/report.json", first);
    } catch (const io::WriteError& error) {
      if (write_error.empty()) write_error = error.what();
    }
  }

  /// A step with central differences, of which nothing was written before or some increments were.
  void begins(const model::BasicSystem<Dim>& system, const model::Progress& p) {
    const model::MassScaling& wanted =
        built.model.steps[static_cast<std::size_t>(p.step)].dynamics->mass_scaling;
    if (!(wanted.stable_step > 0) && wanted.factor == 1.0) return;
    masses.push_back(
        {static_cast<std::size_t>(p.step), step_name(p), wanted, system.scaled_masses()});
    if (p.increment > 0) return;
    say_all(result::added_mass_text(masses.back()));
    for (const std::string& warning : result::added_mass_warnings(masses.back()))
      say("warning: " + warning);
  }

  /// An iteration that has just been done.
  void iterated(const model::Progress& aim, int number, const solve::IterationRecord& iteration) {
    try {
      iteration_file.add(aim, number, iteration);
    } catch (const io::WriteError& error) {
      if (write_error.empty()) write_error = error.what();
    }
  }

  /// A line of log.txt; one that cannot be written ends the run after this increment.
  void log_line(const std::string& text) {
    try {
      log.append(text + "\n");
    } catch (const io::WriteError& error) {
      if (write_error.empty()) write_error = error.what();
    }
  }

  void say(const std::string& text) {
    log_line(text);
    if (options.say) options.say(text);
  }

  void say_all(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) say(text);
  }

  [[nodiscard]] std::string step_name(const model::Progress& p) const {
    return built.model.steps.empty() ? std::string{}
                                     : built.model.steps[static_cast<std::size_t>(p.step)].name;
  }

  [[nodiscard]] bool wants_fields(const model::Progress& p) {
    if (description.output.fields == deck::FieldTimes::none) return false;
    const bool end_of_step = p.fraction >= 1.0;
    if (description.output.fields == deck::FieldTimes::last) return end_of_step;
    if (p.increment == 0 || end_of_step) return true;
    const model::Step& step = built.model.steps[static_cast<std::size_t>(p.step)];
    if (!step.dynamics || !step.dynamics->time_steps)
      return p.increment % description.output.every == 0;
    const long nominal = std::lround(p.fraction * step.increments);
    return p.fraction == static_cast<double>(nominal) / step.increments &&
           nominal % description.output.every == 0;
  }

  [[nodiscard]] double done(const model::Progress& p) const {
    return share_done(built.model.steps, options.until, p);
  }
  void show_progress(const model::Progress& p, const std::string& line) {
    if (!options.progress) return;
    const std::string left = outlook(done(p), resumed, budget.seconds());
    options.progress((options.with_outlook ? left : "") + line);
    if (!options.with_outlook && !left.empty() && budget.passed(options.outlook_after))
      options.progress(left);
  }

  /// Writes what an increment has given; false: the run ends here.
  template <class Write>
  bool written(const Write& write) {
    const auto start = std::chrono::steady_clock::now();
    try {
      write();
    } catch (const io::WriteError& error) {
      write_error = error.what();
    }
    seconds += seconds_since(start);
    stopping = !write_error.empty() || unwanted || (options.interrupted && options.interrupted()) ||
               budget.too_late();
    return !stopping;
  }

  bool converged(model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                 const model::Progress& p, const solve::IncrementRecord* record) {
    return written([&] { record_increment(system, state, p, record); });
  }

  /// Real and imaginary part are one increment.
  bool swings(model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
              const model::Progress& p, const model::HarmonicPart& part) {
    return written([&] { record_part(system, state, p, part); });
  }

  void record_part(model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                   const model::Progress& p, const model::HarmonicPart& part) {
    if (!part.imaginary) {
      entry = {};
      entry.progress = p;
      entry.row.resize(built.history.size());
    }
    for (std::size_t i = 0; i < built.history.size(); ++i)
      if (built.history[i].imaginary == part.imaginary)
        entry.row[i] = model::history_value(system, built.model, state, built.history[i]);
    const model::BasicReached<Dim> reached(system, built.model, state);
    if (answers) answers->swings(reached, p, part);
    const bool shown = wants_fields(p);
    const std::size_t before = fields.written().size();
    if (shown) fields.swings(reached, p.time, part.imaginary);
    if (!part.imaginary) return;
    entry.record = part.record;
    entry.note =
        nlohmann::json{{"outside_domain", nlohmann::json::array()}, {"time", p.time}}.dump();
    curvature_shares.push_back(0);
    notes.push_back(nlohmann::json::parse(entry.note));
    entry.deepest = watch.deepest;
    const std::string line = result::swing_text(step_name(p), p, part.motion.place);
    log_line(line);
    show_progress(p, line);
    ++converged_count;
    history->row(row_of(p, entry.row));
    report_row(p, entry.row);
    if (shown)
      entry.files.assign(fields.written().begin() + static_cast<std::ptrdiff_t>(before),
                         fields.written().end());
  }

  void record_increment(model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                        const model::Progress& p, const solve::IncrementRecord* record) {
    const model::BasicReached<Dim> reached(system, built.model, state);
    record_numbers(system, reached, p, record);
    if (wants_fields(p)) record_fields(reached, p);
    if (record && options.converged)
      unwanted = !options.converged({step_name(p), p, static_cast<int>(record->iterations.size()),
                                     column_names(built.history), entry.row,
                                     [&] { return fields.data_sets(reached); }});
  }

  void record_numbers(model::BasicSystem<Dim>& system, const model::BasicReached<Dim>& reached,
                      const model::Progress& p, const solve::IncrementRecord* record) {
    const model::BasicState<Dim>& state = reached.state;
    entry = {};
    entry.progress = p;
    for (const model::HistoryRequest& request : built.history)
      entry.row.push_back(
          request.imaginary ? 0 : model::history_value(system, built.model, state, request));
    if (!record) {
      report_memory(system);
      say_all(watch.begin(system, state));
    } else {
      say_all(watch.take(system, state, p, *record));
      entry.record = *record;
      entry.curvature_share = curvature_share(system, state);
      const nlohmann::json note = {{"outside_domain", report_outside_domain(system)},
                                   {"time", p.time}};
      entry.note = note.dump();
      curvature_shares.push_back(entry.curvature_share);
      notes.push_back(note);
      report_increment(p, *record);
      if (answers) answers->converged(reached, p, *record);
      ++converged_count;
    }
    entry.deepest = watch.deepest;
    history->row(row_of(p, entry.row));
    report_row(p, entry.row);
  }

  void record_fields(const model::BasicReached<Dim>& reached, const model::Progress& p) {
    const std::size_t before = fields.written().size();
    fields.write(reached, p.time);
    entry.files.assign(fields.written().begin() + static_cast<std::ptrdiff_t>(before),
                       fields.written().end());
    if (!description.output.report) return;
    report.add_frame(reached, p);
    if (checkpoints && !report.newest().is_null())
      nlohmann::json::to_cbor(report.newest(), entry.frame);
  }

  /// Where nothing is said, all but large models do without most: their increments are soon done
  /// again, and what the linear solver has passes from one to the next.
  [[nodiscard]] bool is_due(const model::BasicSystem<Dim>& system, const model::Progress& p) const {
    constexpr Index small = 20'000, large = 200'000;
    const int every_so_often = system.unknowns() < small ? 10 : 5;
    if (p.fraction >= 1.0) return true;
    if (const std::optional<int>& every = description.output.checkpoint)
      return converged_count % *every == 0 || stopping;
    const std::vector<model::Step>& steps = built.model.steps;
    const bool by_increments =
        steps.empty() || model::iterates(steps[static_cast<std::size_t>(p.step)]);
    return system.unknowns() >= large || !by_increments || converged_count % every_so_often == 0;
  }

  /// The increment that `converged` has recorded. True if its state is in a checkpoint.
  bool save(const model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
            const model::Progress& p, const solve::StepPosition& position) {
    if (!checkpoints || !write_error.empty()) return false;
    const auto start = std::chrono::steady_clock::now();
    const model::SystemMemory memory = system.memory();
    entry.touched.assign(fields.touched().begin(), fields.touched().end());
    if (answers) entry.answers = answers->marks();
    const bool due = is_due(system, p);
    kept = kept || (due && p.increment > 0);
    not_kept.reset();
    if (!kept && !due) not_kept = {state, p, position, memory, {}};
    try {
      checkpoints->add(entry, memory);
      if (due) checkpoints->save(state, p, position, memory, watch.memory);
    } catch (const io::WriteError& error) {
      write_error = error.what();
    }
    seconds += seconds_since(start);
    return due;
  }

  /// A run that went on ends early: one that goes on from it must not begin where it has.
  void keep_last() {
    if (!checkpoints || !not_kept || !write_error.empty()) return;
    try {
      checkpoints->save(not_kept->state, not_kept->progress, not_kept->position, not_kept->memory,
                        watch.memory);
    } catch (const io::WriteError& error) {
      write_error = error.what();
    }
  }

  /// Penalties used and penetrations reached.
  nlohmann::json penetration_reached() {
    nlohmann::json list = nlohmann::json::array();
    watch.deepest.resize(built.model.pairs.size());
    for (std::size_t p = 0; p < watch.deepest.size(); ++p)
      list.push_back(result::penetration_json(built.model.pairs[p], watch.deepest[p]));
    return list;
  }

  void report_memory(const model::BasicSystem<Dim>& system) {
    if (!built.linear_note.empty())
      return say(fmt::format("{:<13} {}", "Linear", built.linear_note));
    const bool unsymmetric = system.symmetry() == la::Symmetry::unsymmetric;
    const std::string notice = result::memory_need(built.model, unsymmetric).notice();
    if (!notice.empty()) say(notice);
  }

  /// Names points without contact normal, on the screen when they are others than before.
  nlohmann::json report_outside_domain(const model::BasicSystem<Dim>& system) {
    nlohmann::json list = nlohmann::json::array();
    std::vector<std::string> now;
    for (const model::OutsideDomain& found : model::outside_domain(system, built.model)) {
      nlohmann::json names = nlohmann::json::array();
      for (const Index node : found.nodes)
        names.push_back(mesh::describe_node(built.model.mesh, node));
      list.push_back({{"pair", found.pair}, {"points", found.nodes.size()}, {"nodes", names}});
      now.push_back("warning: " + model::outside_domain_message(built.model, found));
      if (std::find(warned.begin(), warned.end(), now.back()) == warned.end())
        say(now.back());
      else
        log_line(now.back());
    }
    warned = std::move(now);
    return list;
  }

  /// Largest of all pairs.
  [[nodiscard]] double curvature_share(const model::BasicSystem<Dim>& system,
                                       const model::BasicState<Dim>& state) const {
    if (built.model.pairs.empty()) return 0;
    const std::vector<Vec<Dim>> x = system.positions(state);
    double largest = 0;
    for (std::size_t k = 0; k < built.model.pairs.size(); ++k)
      largest = std::max(largest, pairing::curvature_share<Dim>(
                                      built.model.pairs[k].definition, x, system.contact()[k],
                                      {false, true, true, true}, built.options.threads));
    return largest;
  }

  /// What a dropped attempt did, for log.txt only.
  void log_iterations(const std::vector<solve::IterationRecord>& records) {
    int number = 0;
    for (const solve::IterationRecord& it : records)
      log_line(result::iteration_text(++number, it, states));
  }

  /// An increment of explicit time integration.
  void report_time_steps(const model::Progress& p, const solve::IncrementRecord& record) {
    const solve::TimeSteps& steps = record.time_steps;
    const std::string line = result::time_steps_text(step_name(p), p, record, states);
    log_line(line);
    show_progress(p, line);
    time_steps += steps.count;
    if (steps.governed != governed_by)
      say(fmt::format("the longest stable time step of {:.4g} is estimated from {}", steps.stable,
                      steps.governed));
    governed_by = steps.governed;
  }

  void report_increment(const model::Progress& p, const solve::IncrementRecord& record) {
    if (record.time_steps.count > 0) return report_time_steps(p, record);
    iterations += static_cast<int>(record.iterations.size()) + record.wasted_iterations;
    const std::string line = result::increment_text(step_name(p), p, record, states);
    log_line(line);
    show_progress(p, line);
  }
};

}  // namespace osculate::api
