#include "osculate/api/summary.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cmath>
#include <map>

#include "osculate/core/version.hpp"

namespace osculate::api {
namespace {

nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json increment_json(double step_time, const solve::IncrementRecord& record) {
  nlohmann::json residuals = nlohmann::json::array(), energies = nlohmann::json::array();
  for (const solve::IterationRecord& it : record.iterations) {
    residuals.push_back(number(it.residual));
    energies.push_back(number(it.energy));
  }
  const solve::IterationRecord last =
      record.iterations.empty() ? solve::IterationRecord{} : record.iterations.back();
  return {{"time", step_time + record.fraction},
          {"iterations", record.iterations.size()},
          {"residual", number(last.residual)},
          {"energy", number(last.energy)},
          {"cutbacks", record.cutbacks},
          {"wasted_iterations", record.wasted_iterations},
          {"open", last.counts.open},
          {"stick", last.counts.stick},
          {"slip", last.counts.slip},
          {"residuals", residuals},
          {"energies", energies}};
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

std::string section_text(const model::Model& m, const model::BulkSection& section) {
  std::map<std::string, int> counts;
  for (const mesh::CellRef& ref : section.cells)
    ++counts[std::string(cell::info(m.mesh.blocks[static_cast<std::size_t>(ref.block)].type).name)];
  std::string text;
  for (const auto& entry : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", entry.second, entry.first);
  const solid::Section& s = section.section;
  const char* const assumption = s.assumption == solid::Assumption::plane_strain   ? "plane strain"
                                 : s.assumption == solid::Assumption::plane_stress ? "plane stress"
                                                                                   : "axisymmetric";
  return fmt::format("{}, {}, {} strain", text, assumption,
                     s.kinematics == solid::Kinematics::small ? "small" : "finite");
}

}  // namespace

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

nlohmann::json summary_json(const std::string& model_file, const model::AnalysisResult& result,
                            const std::string& status, double seconds_input) {
  nlohmann::json steps = nlohmann::json::array();
  int iterations = 0, increments = 0, cutbacks = 0;
  for (std::size_t s = 0; s < result.steps.size(); ++s) {
    nlohmann::json list = nlohmann::json::array();
    for (const solve::IncrementRecord& record : result.steps[s].increments) {
      list.push_back(increment_json(static_cast<double>(s), record));
      iterations += static_cast<int>(record.iterations.size()) + record.wasted_iterations;
      cutbacks += record.cutbacks;
      ++increments;
    }
    steps.push_back({{"name", result.steps[s].name}, {"increments", list}});
  }
  return {
      {"osculate", core::version},
      {"model", model_file},
      {"status", status},
      {"message", result.message},
      {"steps", steps},
      {"total", {{"increments", increments}, {"iterations", iterations}, {"cutbacks", cutbacks}}},
      {"seconds", {{"input", seconds_input}, {"analysis", result.seconds}}},
      {"peak_memory_mb", peak_memory_mb()},
      {"unknowns", result.unknowns}};
}

std::vector<ModelFact> model_facts(const deck::Built& built) {
  const model::Model& m = built.model;
  std::vector<ModelFact> facts;
  for (const model::BulkSection& section : m.sections)
    facts.push_back({"Bodies", section.name, section_text(m, section)});
  for (const model::RigidBody& body : m.rigid)
    facts.push_back({"Rigid bodies", body.name,
                     fmt::format("{}, reference point ({:g}, {:g})",
                                 body.shape ? std::string(geometry::key(*body.shape))
                                            : fmt::format("{} nodes", body.nodes.size()),
                                 body.reference.x(), body.reference.y())});
  for (const model::ContactPair& pair : m.pairs) {
    const pairing::PairDefinition<2>& d = pair.definition;
    const std::string friction = d.friction ? fmt::format("Coulomb {:g} (penalty {:g})",
                                                          d.friction->mu, d.friction->stiffness)
                                            : std::string("frictionless");
    facts.push_back(
        {"Contact", pair.name,
         fmt::format("{} slave nodes on {} facets, penalty {:g}, {}, {}", d.slave.nodes.size(),
                     d.master.facets.size(), d.normal.stiffness, friction, weight_name(d.weight))});
  }
  for (const model::Step& step : m.steps)
    facts.push_back({"Steps", step.name, fmt::format("{} increments", step.increments)});
  return facts;
}

}  // namespace osculate::api
