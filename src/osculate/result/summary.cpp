#include "osculate/result/summary.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>

#include "osculate/core/memory.hpp"
#include "osculate/core/version.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/model/factor_estimate.hpp"
#include "osculate/pairing/point_penalty.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::result {
namespace {

nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

}  // namespace

nlohmann::json increment_json(double step_time, const solve::IncrementRecord& record) {
  nlohmann::json residuals = nlohmann::json::array(), energies = nlohmann::json::array();
  for (const solve::IterationRecord& it : record.iterations) {
    residuals.push_back(number(it.residual));
    energies.push_back(number(it.energy));
  }
  const solve::IterationRecord last =
      record.iterations.empty() ? solve::IterationRecord{} : record.iterations.back();
  nlohmann::json time_steps = nullptr;
  if (record.time_steps.count > 0)
    time_steps = {{"count", record.time_steps.count},
                  {"longest", number(record.time_steps.longest)},
                  {"stable", number(record.time_steps.stable)},
                  {"governed_by", record.time_steps.governed}};
  nlohmann::json time_step = nullptr;
  if (record.time_step.length > 0)
    time_step = {{"length", number(record.time_step.length)},
                 {"error", number(record.time_step.error)},
                 {"refused", record.time_step.refused}};
  const solve::Factorisations factorisations = solve::count_factorisations(record.iterations);
  nlohmann::json condition = nullptr;
  if (record.precision.condition > 0) condition = number(record.precision.condition);
  return {{"time", step_time + record.fraction},
          {"iterations", record.iterations.size()},
          {"factorisations", factorisations.whole},
          {"factorisations_of_contact", factorisations.of_contact},
          {"residual", number(last.residual)},
          {"energy", number(last.energy)},
          {"cutbacks", record.cutbacks},
          {"wasted_iterations", record.wasted_iterations},
          {"resisted", record.resisted},
          {"on_path", record.on_path},
          {"condition", condition},
          {"round_off", record.precision.round_off},
          {"unstable", record.precision.unstable},
          {"open", last.counts.open},
          {"stick", last.counts.stick},
          {"slipping", last.counts.slipping},
          {"closed", last.counts.closed},
          {"friction_work", number(last.counts.friction_work)},
          {"time_steps", time_steps},
          {"time_step", time_step},
          {"residuals", residuals},
          {"energies", energies}};
}

namespace {

/// Of a step whose time steps were chosen by their errors; null for others.
nlohmann::json chosen_json(const ChosenTimeSteps& chosen) {
  if (chosen.count == 0) return nullptr;
  return {{"count", chosen.count},
          {"smallest", number(chosen.smallest)},
          {"largest", number(chosen.largest)},
          {"refused", chosen.refused},
          {"largest_error", number(chosen.largest_error)}};
}

/// Of a step that looks for vibrations; null for others.
nlohmann::json modes_json(const std::optional<model::Vibrations>& modes) {
  if (!modes) return nullptr;
  nlohmann::json list = nlohmann::json::array();
  for (const double value : modes->omega_squared) {
    const std::size_t i = list.size();
    list.push_back(
        {{"omega_squared", number(value)}, {"frequency", number(model::frequency(value))}});
    if (!modes->diameters.empty()) list.back()["diameters"] = modes->diameters[i];
  }
  return {{"found", list}, {"missing", modes->missing}, {"residual", number(modes->residual)}};
}

/// Of a step that looks for buckling loads; null for others.
nlohmann::json buckling_json(const std::optional<model::Buckling>& found) {
  if (!found) return nullptr;
  nlohmann::json list = nlohmann::json::array();
  for (const double value : found->factors) list.push_back(number(value));
  return {{"factors", list},
          {"reversed", found->reversed ? number(*found->reversed) : nullptr},
          {"missing", found->missing},
          {"residual", number(found->residual)}};
}

template <class Vector>
nlohmann::json components(const Vector& v) {
  nlohmann::json list = nlohmann::json::array();
  for (const double c : v) list.push_back(number(c));
  return list;
}

/// Why an analysis stopped before its end.
template <int Dim>
nlohmann::json failure_json(const model::BasicModel<Dim>& model,
                            const model::BasicFailure<Dim>& failure) {
  nlohmann::json flips = nlohmann::json::array(), motions = nlohmann::json::array();
  for (const model::FlippingPoint& point : failure.flips)
    flips.push_back({{"pair", point.pair},
                     {"node", point.node >= 0 ? mesh::describe_node(model.mesh, point.node) : ""},
                     {"states", point.states}});
  for (const model::BasicFreeMotion<Dim>& motion : failure.motions)
    motions.push_back({{"body", motion.body},
                       {"direction", components(motion.direction)},
                       {"rotation", number(motion.rotation)},
                       {"axis", components(motion.axis)},
                       {"center", components(motion.center)},
                       {"resistance", number(motion.stiffness_ratio)},
                       {"along", motion.along}});
  return {{"cause", model::cause_name(failure.cause)},
          {"reason", failure.reason},
          {"proposal", failure.proposal},
          {"flips", flips},
          {"free_motions", motions},
          {"stiffness_ratio", number(failure.stiffness_ratio)},
          {"negative_pivots", failure.negative_pivots},
          {"last_step", number(failure.last_step)}};
}

const char* weight_name(pairing::Weight weight) {
  switch (weight) {
    case pairing::Weight::node:
      return "penalty is a force per length and node";
    case pairing::Weight::reference_area:
      return "penalty acts on the reference area";
    case pairing::Weight::current_area:
      return "penalty acts on the current area";
  }
  return "";
}

const char* assumption_name(solid::Assumption assumption) {
  switch (assumption) {
    case solid::Assumption::plane_strain:
      return "plane strain, ";
    case solid::Assumption::plane_stress:
      return "plane stress, ";
    case solid::Assumption::axisymmetric:
      return "axisymmetric, ";
  }
  return "";
}

const char* formulation_name(solid::Formulation formulation) {
  switch (formulation) {
    case solid::Formulation::full:
      return "full integration";
    case solid::Formulation::bbar:
      return "mean dilatation";
    case solid::Formulation::enhanced:
      return "enhanced strains";
    case solid::Formulation::solid_shell:
      return "solid shell";
    case solid::Formulation::reduced:
      return "reduced integration";
    case solid::Formulation::beam:
      return "reduced integration along the beam";
  }
  return "";
}

/// Cells with their formulations, assumption and kinematics.
template <int Dim>
std::string section_text(const model::BasicModel<Dim>& m,
                         const model::BasicBulkSection<Dim>& section) {
  std::map<std::string, int> counts;
  for (const mesh::CellRef& ref : section.cells) {
    const cell::CellType type = m.mesh.blocks[static_cast<std::size_t>(ref.block)].type;
    ++counts[fmt::format("{}, {}", cell::info(type).name,
                         formulation_name(model::section_on(section, type).formulation))];
  }
  std::string text;
  for (const auto& entry : counts) text += fmt::format("{} {}, ", entry.second, entry.first);
  if constexpr (Dim == 2) text += assumption_name(section.section.assumption);
  const bool small = section.section.kinematics == solid::Kinematics::small;
  return fmt::format("{}{} strain", text, small ? "small" : "finite");
}

template <int Dim>
std::string place_text(const Vec<Dim>& x) {
  std::string text;
  for (int i = 0; i < Dim; ++i) text += fmt::format("{}{:g}", i ? ", " : "", x[i]);
  return text;
}

template <int Dim>
std::string rigid_text(const model::BasicRigidBody<Dim>& body) {
  const std::string what =
      body.shape ? std::visit([](const auto& shape) { return std::string(shape.key); }, *body.shape)
      : body.parts.empty() ? fmt::format("{} nodes", body.nodes.size())
                           : fmt::format("composite of {} curves", body.parts.size());
  return fmt::format("{}, reference point ({})", what, place_text<Dim>(body.reference));
}

template <int Dim>
std::string hold_text(const pairing::PairDefinition<Dim>& d) {
  std::string text;
  if (pairing::is<pairing::NeverPart>(d.separation)) text += ", no separation";
  if (pairing::is<pairing::TiedNormal>(d.separation)) text += ", tied in the normal direction";
  if (const auto* const tied = std::get_if<pairing::Tied<Dim>>(&d.separation))
    text += fmt::format(", {} of them tied", tied->ties.size());
  if (d.offset > 0) text += fmt::format(", offset {:g}", d.offset);
  return text;
}

/// Penalties of the points, where they are not all the pair's.
template <int Dim>
std::string range_text(const pairing::PairDefinition<Dim>& d) {
  if (d.relative_stiffness.empty()) return {};
  const pairing::PenaltyRange r = pairing::penalty_range(d);
  std::string text;
  if (r.smallest.normal < r.largest.normal)
    text += fmt::format(", of its points {:g} to {:g} (mean {:g})", r.smallest.normal,
                        r.largest.normal, r.mean.normal);
  if (r.smallest.shear < r.largest.shear)
    text += fmt::format(", of their friction {:g} to {:g} (mean {:g})", r.smallest.shear,
                        r.largest.shear, r.mean.shear);
  return text;
}

template <int Dim>
std::string pair_text(const model::BasicContactPair<Dim>& pair) {
  const pairing::PairDefinition<Dim>& d = pair.definition;
  const std::string friction =
      d.friction ? contact::text(*d.friction) : std::string("frictionless");
  std::string edges;
  if (const pairing::EdgeContact* const sharp = pairing::edges_of(d))
    edges = fmt::format(", {} sharp edges on {}", sharp->slave.size(), sharp->master.size());
  return fmt::format("{} slave {} on {} facets{}, {}{}{}, {}, {}{}{}", d.slave.points.size(),
                     pairing::by_mortar(d)                ? "nodes by mortar"
                     : pairing::sampled_at_nodes(d.slave) ? "nodes"
                                                          : "points",
                     d.master.facets.size(), edges, contact::text(d.normal) + hold_text(d),
                     pair.automatic ? " (automatic)" : "", range_text(d), friction,
                     weight_name(d.weight), pair.note.empty() ? "" : "; ", pair.note);
}

constexpr int most_listed_pairs = 20;

/// Sizes of the groups of generated pairs that are too many to be listed one by one.
template <int Dim>
std::map<std::string, int> long_groups(const model::BasicModel<Dim>& m) {
  std::map<std::string, int> sizes;
  for (const model::BasicContactPair<Dim>& pair : m.pairs)
    if (!pair.group.empty()) ++sizes[pair.group];
  for (auto entry = sizes.begin(); entry != sizes.end();)
    entry = entry->second <= most_listed_pairs ? sizes.erase(entry) : std::next(entry);
  return sizes;
}

/// The total is the caller's; what is not named is spent between the phases.
template <int Dim>
nlohmann::json seconds_json(const model::BasicAnalysisResult<Dim>& result, const RunSeconds& run) {
  const model::SystemSeconds& s = result.seconds_system;
  return {{"input", run.input},     {"analysis", result.seconds},
          {"contact", s.contact},   {"bulk", s.bulk},
          {"assembly", s.assembly}, {"solver", result.seconds_solver},
          {"output", run.output},   {"total", run.input + result.seconds}};
}

}  // namespace

ChosenTimeSteps chosen_time_steps(const model::StepRecord& step) {
  ChosenTimeSteps chosen;
  for (const solve::IncrementRecord& record : step.increments) {
    const solve::TimeStepTaken& taken = record.time_step;
    if (!(taken.length > 0)) continue;
    chosen.smallest = chosen.count == 0 ? taken.length : std::min(chosen.smallest, taken.length);
    chosen.largest = std::max(chosen.largest, taken.length);
    chosen.largest_error = std::max(chosen.largest_error, taken.error);
    chosen.refused += taken.refused;
    ++chosen.count;
  }
  return chosen;
}

std::vector<std::string> chosen_time_steps_text(const std::vector<model::StepRecord>& records,
                                                const std::vector<model::Step>& steps) {
  std::vector<std::string> lines;
  for (std::size_t s = 0; s < records.size(); ++s) {
    const ChosenTimeSteps chosen = chosen_time_steps(records[s]);
    if (chosen.count == 0) continue;
    lines.push_back(fmt::format("step '{}': {} time steps from {:.3g} to {:.3g}, {} refused",
                                records[s].name, chosen.count, chosen.smallest, chosen.largest,
                                chosen.refused));
    const double wanted = steps[s].dynamics->time_steps->error;
    if (chosen.largest_error > 2 * wanted)
      lines.push_back(
          fmt::format("warning: step '{}': errors up to {:.2g} instead of {:g}, in time steps of "
                      "the smallest length that is allowed",
                      records[s].name, chosen.largest_error, wanted));
  }
  return lines;
}

double in_mb(double bytes) { return bytes / (1 << 20); }

/// Of each process; `imbalance`: the longest work over the mean of all.
nlohmann::json processes_json(const std::vector<model::ProcessRecord>& processes) {
  nlohmann::json working = nlohmann::json::array(), memory = working;
  for (const model::ProcessRecord& p : processes) {
    working.push_back(p.working);
    memory.push_back(in_mb(p.memory));
  }
  return {{"working", working},
          {"peak_memory_mb", memory},
          {"slowest", model::slowest(processes)},
          {"imbalance", model::imbalance(processes)}};
}

template <int Dim>
nlohmann::json summary_json(const std::string& model_file,
                            const model::BasicAnalysisResult<Dim>& result,
                            const std::string& status, const RunSeconds& seconds,
                            const std::vector<double>& curvature_shares,
                            const std::vector<nlohmann::json>& notes) {
  nlohmann::json steps = nlohmann::json::array();
  int iterations = 0, increments = 0, cutbacks = 0;
  for (std::size_t s = 0; s < result.steps.size(); ++s) {
    nlohmann::json list = nlohmann::json::array();
    for (const solve::IncrementRecord& record : result.steps[s].increments) {
      list.push_back(increment_json(static_cast<double>(s), record));
      const auto number_of = static_cast<std::size_t>(increments);
      if (number_of < curvature_shares.size())
        list.back()["curvature_share"] = number(curvature_shares[number_of]);
      if (number_of < notes.size() && !notes[number_of].is_null())
        list.back().update(notes[number_of]);
      iterations += static_cast<int>(record.iterations.size()) + record.wasted_iterations;
      cutbacks += record.cutbacks;
      ++increments;
    }
    steps.push_back({{"name", result.steps[s].name},
                     {"chosen_time_steps", chosen_json(chosen_time_steps(result.steps[s]))},
                     {"modes", modes_json(result.steps[s].vibrations)},
                     {"buckling", buckling_json(result.steps[s].buckling)},
                     {"increments", list}});
  }
  const pairing::PairSeconds& parts = result.seconds_system.contact_parts;
  nlohmann::json summary = {
      {"osculate", core::version},
      {"model", model_file},
      {"status", status},
      {"message", result.message},
      {"steps", steps},
      {"total", {{"increments", increments}, {"iterations", iterations}, {"cutbacks", cutbacks}}},
      {"seconds", seconds_json(result, seconds)},
      {"contact_seconds",
       {{"search", parts.search},
        {"projection", parts.projection},
        {"evaluation", parts.evaluation}}},
      {"peak_memory_mb", in_mb(core::most_resident())},
      {"unknowns", result.unknowns}};
  if (result.linear.solutions + result.linear.given_up > 0)
    summary["multigrid"] = {{"solutions", result.linear.solutions},
                            {"iterations", result.linear.iterations},
                            {"given_up", result.linear.given_up}};
  if (!result.processes.empty()) summary["processes"] = processes_json(result.processes);
  return summary;
}

std::vector<std::string> processes_text(const std::vector<model::ProcessRecord>& processes) {
  if (processes.empty()) return {};
  const std::size_t slowest = model::slowest(processes);
  double mean = 0, memory = 0;
  for (const model::ProcessRecord& p : processes) {
    mean += p.working / static_cast<double>(processes.size());
    memory = std::max(memory, p.memory);
  }
  return {fmt::format(
      "processes: {}, at work for {:.3g} s each, the slowest ({}) for {:.3g} s: imbalance {:.2f}; "
      "up to {}",
      processes.size(), mean, slowest, processes[slowest].working, model::imbalance(processes),
      core::memory_text(memory))};
}

std::vector<std::string> linear_systems_text(const la::IterativeWork& work) {
  std::vector<std::string> lines;
  if (work.solutions > 0)
    lines.push_back(
        fmt::format("linear systems: {} solved by multigrid in {:.1f} iterations on average",
                    work.solutions, static_cast<double>(work.iterations) / work.solutions));
  if (work.given_up > 0)
    lines.push_back(fmt::format(
        "warning: multigrid did not solve {} of {} linear systems, which were factored after that; "
        "`solver: {{linear: direct}}` saves the attempts",
        work.given_up, work.given_up + work.solutions));
  return lines;
}

template <int Dim>
nlohmann::json diagnosis_json(const model::BasicModel<Dim>& model,
                              const model::BasicAnalysisResult<Dim>& result) {
  return result.failure ? failure_json(model, *result.failure) : nlohmann::json(nullptr);
}

template <int Dim>
std::vector<ModelFact> model_facts(const deck::BasicBuilt<Dim>& built) {
  const model::BasicModel<Dim>& m = built.model;
  std::vector<ModelFact> facts;
  for (const std::string& note : built.input_notes) facts.push_back({"Input", "", note});
  for (const model::BasicBulkSection<Dim>& section : m.sections)
    facts.push_back({"Bodies", section.name, section_text(m, section)});
  for (const model::BasicRigidBody<Dim>& body : m.rigid)
    facts.push_back({"Rigid bodies", body.name, rigid_text(body)});
  for (const std::string& note : built.notes) facts.push_back({"Contact", "", note});
  const std::map<std::string, int> unlisted = long_groups(m);
  for (const model::BasicContactPair<Dim>& pair : m.pairs)
    if (!unlisted.contains(pair.group)) facts.push_back({"Contact", pair.name, pair_text(pair)});
  for (const auto& entry : unlisted)
    facts.push_back({"Contact", entry.first, fmt::format("{} pairs of bodies", entry.second)});
  for (const model::Step& step : m.steps)
    facts.push_back({"Steps", step.name,
                     step.harmonic      ? fmt::format("frequencies from {:g} to {:g}",
                                                      step.harmonic->from, step.harmonic->to)
                     : step.frequencies ? fmt::format("{} vibrations", step.frequencies->modes)
                     : step.buckling    ? fmt::format("{} buckling loads", step.buckling->factors)
                                        : fmt::format("{} increments", step.increments)});
  return facts;
}

std::string MemoryNeed::notice() const {
  constexpr double large = 1e9;
  if (needed > available) return "warning: memory: " + text();
  return needed > large ? fmt::format("{:<13} {}", "Memory", text()) : std::string{};
}

std::string MemoryNeed::text() const {
  return fmt::format("about {} for the factors of the tangent ({:.2g} entries), {} available",
                     core::memory_text(needed), entries, core::memory_text(available));
}

template <int Dim>
MemoryNeed memory_need(const model::BasicModel<Dim>& model, bool unsymmetric) {
  if (!model::factors_tangents(model.steps)) return {};
  MemoryNeed need;
  need.entries = model::factor_estimate(model).entries * (unsymmetric ? 2 : 1);
  need.needed = model::factor_bytes(need.entries);
  need.available = core::memory_available();
  return need;
}

template MemoryNeed memory_need(const model::Model&, bool);
template MemoryNeed memory_need(const model::Model3&, bool);
template nlohmann::json summary_json(const std::string&, const model::AnalysisResult&,
                                     const std::string&, const RunSeconds&,
                                     const std::vector<double>&,
                                     const std::vector<nlohmann::json>&);
template nlohmann::json summary_json(const std::string&, const model::AnalysisResult3&,
                                     const std::string&, const RunSeconds&,
                                     const std::vector<double>&,
                                     const std::vector<nlohmann::json>&);
template nlohmann::json diagnosis_json(const model::Model&, const model::AnalysisResult&);
template nlohmann::json diagnosis_json(const model::Model3&, const model::AnalysisResult3&);
template std::vector<ModelFact> model_facts(const deck::Built&);
template std::vector<ModelFact> model_facts(const deck::Built3&);

}  // namespace osculate::result
