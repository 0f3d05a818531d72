#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "osculate/api/penetration.hpp"
#include "osculate/api/run.hpp"
#include "osculate/api/summary.hpp"
#include "osculate/mesh/boundary.hpp"

namespace osculate::api {
namespace {

struct GapFacts {
  int found = 0, touching = 0, overlapping = 0, crossings = 0;
  double smallest = 0, largest = 0;
  std::size_t deepest = 0;  ///< point with the smallest gap
};

template <int Dim>
GapFacts gap_facts(const pairing::PairState<Dim>& state) {
  GapFacts facts;
  for (std::size_t i = 0; i < state.points.size(); ++i) {
    const contact::PointHistory<Dim>& point = state.points[i];
    if (point.edge >= 0) {
      ++facts.crossings;
      continue;
    }
    if (point.facet < 0) continue;
    const double gap = point.gap + (i < state.overlap.size() ? state.overlap[i] : 0.0);
    if (!facts.found || gap < facts.smallest) facts.deepest = i;
    facts.smallest = facts.found ? std::min(facts.smallest, gap) : gap;
    facts.largest = facts.found ? std::max(facts.largest, gap) : gap;
    ++facts.found;
    if (gap == 0) ++facts.touching;
    if (gap < 0) ++facts.overlapping;
  }
  return facts;
}

std::string gap_line(const std::string& pair, const GapFacts& g, std::size_t points) {
  return fmt::format(
      "{:<13} {:<16} {} of {} slave nodes face the master, {} touch, {} overlap, gap {:.4g} to "
      "{:.4g}\n",
      "Initial gaps", pair, g.found, points, g.touching, g.overlapping, g.smallest, g.largest);
}

/// The deepest overlap by name, and what becomes of all of them.
template <int Dim>
std::string overlap_line(const model::BasicModel<Dim>& m, const model::BasicContactPair<Dim>& pair,
                         const GapFacts& g) {
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

template <int Dim>
CheckReport check_built(const std::string& path, const deck::BasicBuilt<Dim>& built) {
  const model::BasicModel<Dim>& m = built.model;
  model::BasicSystem<Dim> system(m, 1);
  const model::BasicState<Dim> state = system.initial_state();
  CheckReport report;
  nlohmann::json facts = nlohmann::json::array(), pairs = nlohmann::json::array();
  std::string apart;
  for (const ModelFact& fact : model_facts(built)) {
    report.text += fmt::format("{:<13} {:<16} {}\n", fact.heading, fact.name, fact.text);
    facts.push_back({{"heading", fact.heading}, {"name", fact.name}, {"text", fact.text}});
  }
  report.text += fmt::format("{:<13} {}\n", "Unknowns", system.dofs().unknowns());
  for (std::size_t p = 0; p < m.pairs.size(); ++p) {
    const GapFacts g = gap_facts<Dim>(state.pairs[p]);
    if (g.found == 0 && !m.pairs[p].group.empty())
      apart += fmt::format("{}{}", apart.empty() ? "" : ", ", m.pairs[p].name);
    else
      report.text += gap_line(m.pairs[p].name, g, m.pairs[p].definition.slave.points.size()) +
                     overlap_line(m, m.pairs[p], g);
    const pairing::EdgeContact& edges = m.pairs[p].definition.edges;
    if (edges.on)
      report.text += fmt::format("{:<13} {:<16} {} of the master, {} of the slave, {} crossings\n",
                                 "Sharp edges", m.pairs[p].name, edges.master.size(),
                                 edges.slave.size(), g.crossings);
    pairs.push_back({{"name", m.pairs[p].name},
                     {"points", m.pairs[p].definition.slave.points.size()},
                     {"facing", g.found},
                     {"touching", g.touching},
                     {"overlapping", g.overlapping},
                     {"smallest_gap", g.smallest},
                     {"largest_gap", g.largest}});
    pairs.back().update(penalty_json(m.pairs[p].definition));
    if (edges.on)
      pairs.back()["edges"] = {{"master", edges.master.size()},
                               {"slave", edges.slave.size()},
                               {"crossings", g.crossings}};
  }
  if (!apart.empty())
    report.text +=
        fmt::format("{:<13} no node is near the other side: {}\n", "Initial gaps", apart);
  for (const std::string& warning : built.warnings) report.text += "warning: " + warning + "\n";
  report.text += "the model file is valid\n";
  report.json = nlohmann::json{{"model", path},
                               {"facts", facts},
                               {"contact", pairs},
                               {"unknowns", system.dofs().unknowns()},
                               {"warnings", built.warnings}}
                    .dump(1);
  return report;
}

}  // namespace

CheckReport check(const std::string& path) {
  const deck::AnyBuilt any = deck::build_any_file(path);
  return std::visit([&](const auto& built) { return check_built(path, built); }, any);
}

}  // namespace osculate::api
