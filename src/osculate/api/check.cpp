#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "osculate/api/check_facts.hpp"
#include "osculate/api/run.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/result/added_mass.hpp"
#include "osculate/result/initial_gaps.hpp"
#include "osculate/result/penetration.hpp"
#include "osculate/result/result_folder.hpp"
#include "osculate/result/summary.hpp"

namespace osculate::api {
namespace {

std::string gap_line(const std::string& pair, const result::GapFacts& g, std::size_t points) {
  if (g.found == 0)
    return fmt::format(
        "{:<13} {:<16} none of {} slave points faces the master: it is elsewhere, or one of both "
        "looks away\n",
        "Initial gaps", pair, points);
  return fmt::format(
      "{:<13} {:<16} {} of {} slave points face the master, {} touch, {} overlap, gap {:.4g} to "
      "{:.4g}\n",
      "Initial gaps", pair, g.found, points, g.touching, g.overlapping, g.smallest, g.largest);
}

/// The clearance that counts instead, or the deepest overlap by name and what becomes of all of
/// them.
template <int Dim>
std::string overlap_line(const model::BasicModel<Dim>& m, const model::BasicContactPair<Dim>& pair,
                         const result::GapFacts& g) {
  if (pair.definition.overlap == pairing::InitialOverlap::given)
    return fmt::format("{:<13} {:<16} {:.4g} in place of these gaps\n", "Clearance", pair.name,
                       pair.definition.clearance);
  if (g.overlapping == 0) return {};
  const char* fate = "they are pushed out in the first increment";
  if (pair.definition.overlap == pairing::InitialOverlap::ramped)
    fate = "they are let in over the first step";
  if (pair.definition.overlap == pairing::InitialOverlap::kept)
    fate = "gaps are measured from them";
  const Index node = pair.definition.slave.points[g.deepest].nearest_node();
  const std::string deep = pair.height > 0 ? fmt::format(", {:.2g} of the height of the cells",
                                                         -g.smallest / pair.height)
                                           : std::string{};
  return fmt::format("{:<13} {:<16} deepest {:.4g} at {}{}; {}\n", "Overlaps", pair.name,
                     -g.smallest, mesh::describe_node(m.mesh, node), deep, fate);
}

/// Gaps, overlaps and crossings of every pair before the first increment.
template <int Dim>
std::string contact_text(const model::BasicModel<Dim>& m, nlohmann::json& pairs,
                         std::vector<std::string>& warnings) {
  std::string text, apart;
  double rounding = 0;
  for (const Vec<Dim>& x : m.reference) rounding = std::max(rounding, 1e-14 * x.norm());
  for (std::size_t p = 0; p < m.pairs.size(); ++p) {
    const pairing::PairState<Dim> start =
        pairing::initial_state<Dim>(m.pairs[p].definition, m.reference);
    const result::GapFacts g = result::gap_facts<Dim>(start, rounding);
    if (std::string deep = result::deep_overlap(m, m.pairs[p], start); !deep.empty())
      warnings.push_back(std::move(deep));
    if (g.found == 0 && !m.pairs[p].group.empty())
      apart += fmt::format("{}{}", apart.empty() ? "" : ", ", m.pairs[p].name);
    else
      text += gap_line(m.pairs[p].name, g, m.pairs[p].definition.slave.points.size()) +
              overlap_line(m, m.pairs[p], g);
    const pairing::EdgeContact* const edges = pairing::edges_of(m.pairs[p].definition);
    if (edges)
      text += fmt::format("{:<13} {:<16} {} of the master, {} of the slave, {} crossings\n",
                          "Sharp edges", m.pairs[p].name, edges->master.size(), edges->slave.size(),
                          g.edge_contacts);
    pairs.push_back({{"name", m.pairs[p].name},
                     {"points", m.pairs[p].definition.slave.points.size()},
                     {"facing", g.found},
                     {"over_faces", g.over_faces},
                     {"touching", g.touching},
                     {"overlapping", g.overlapping},
                     {"smallest_gap", g.smallest},
                     {"largest_gap", g.largest}});
    pairs.back().update(result::penalty_json(m.pairs[p].definition));
    if (edges)
      pairs.back()["edges"] = {{"master", edges->master.size()},
                               {"slave", edges->slave.size()},
                               {"crossings", g.edge_contacts}};
  }
  if (!apart.empty())
    text += fmt::format("{:<13} no point is near the other side: {}\n", "Initial gaps", apart);
  return text;
}

/// Explicit steps: how long their time steps are, what is added to masses, and what longer steps
/// would cost.
template <int Dim>
std::string time_steps_text(model::BasicSystem<Dim>& system, nlohmann::json& steps,
                            std::vector<std::string>& warnings) {
  const model::BasicModel<Dim>& m = system.model();
  std::string text;
  if (!m.pair_changes.empty() || !m.body_changes.empty()) return text;
  for (std::size_t s = 0; s < m.steps.size(); ++s) {
    const model::Step& step = m.steps[s];
    if (!step.dynamics || !step.dynamics->explicit_steps) continue;
    const result::TimeStepOutlook outlook = result::time_step_outlook(system, step);
    text +=
        fmt::format("{:<13} {:<16} {}\n", "Time step", step.name, result::time_step_text(outlook));
    steps[s]["time_step"] = result::time_step_json(outlook);
    const model::MassScaling& wanted = step.dynamics->mass_scaling;
    if (!(wanted.stable_step > 0) && wanted.factor == 1.0) continue;
    const result::AddedMass added{s, step.name, wanted, system.scaled_masses()};
    for (const std::string& line : result::added_mass_text(added)) text += line + "\n";
    for (std::string& warning : result::added_mass_warnings(added))
      warnings.push_back(std::move(warning));
    steps[s]["mass_scaling"] = result::added_mass_json(added);
  }
  return text;
}

template <int Dim>
CheckReport check_built(const std::string& path, const deck::Description& description,
                        const deck::BasicBuilt<Dim>& built) {
  const model::BasicModel<Dim>& m = built.model;
  model::BasicSystem<Dim> system(m, 1);
  const Index unknowns = system.dofs().unknowns();
  CheckReport report;
  nlohmann::json facts = nlohmann::json::array(), pairs = nlohmann::json::array();
  nlohmann::json more, steps = nlohmann::json::array();
  report.text += mesh_text(built, more);
  for (const result::ModelFact& fact : result::model_facts(built)) {
    report.text += fmt::format("{:<13} {:<16} {}\n", fact.heading, fact.name, fact.text);
    if (fact.heading == "Steps") {
      nlohmann::json step;
      report.text += step_text(description, built, steps.size(), step);
      steps.push_back(std::move(step));
    }
    facts.push_back({{"heading", fact.heading}, {"name", fact.name}, {"text", fact.text}});
  }
  report.text += support_text(built, more);
  report.text += fmt::format("{:<13} {}\n", "Unknowns", unknowns);
  const result::MemoryNeed memory =
      result::memory_need(m, system.symmetry() == la::Symmetry::unsymmetric);
  if (memory.entries > 0) report.text += fmt::format("{:<13} {}\n", "Memory", memory.text());
  if (!built.linear_note.empty())
    report.text += fmt::format("{:<13} {}\n", "Linear", built.linear_note);
  std::vector<std::string> warnings = built.warnings;
  report.text += time_steps_text(system, steps, warnings);
  report.text += contact_text(m, pairs, warnings);
  for (const std::string& warning : warnings) report.text += "warning: " + warning + "\n";
  report.text += "the model file is valid\n";
  nlohmann::json history = nlohmann::json::array();  // the columns that a run writes
  for (const model::HistoryRequest& request : built.history) history.push_back(request.name);
  more.update({{"model", path},
               {"facts", facts},
               {"steps", steps},
               {"contact", pairs},
               {"history", history},
               {"unknowns", unknowns},
               {"memory",
                {{"factor_entries", memory.entries},
                 {"needed", memory.needed},
                 {"available", memory.available}}},
               {"warnings", warnings}});
  report.json = result::json_text(more, 1);
  return report;
}

}  // namespace

CheckReport check(const std::string& path, std::span<const deck::Setting> settings,
                  const deck::SourceNode* document) {
  const deck::Description description =
      document ? deck::parse_model(*document, path, settings) : deck::read_model(path, settings);
  const deck::AnyBuilt any = deck::build_any(description, deck::load_mesh(description));
  return std::visit([&](const auto& built) { return check_built(path, description, built); }, any);
}

}  // namespace osculate::api
