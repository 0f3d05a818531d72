#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "../../examples/user_material/metal.c"
#include "../cases.hpp"
#include "../run_model.hpp"

namespace osculate::verification {
namespace {

/// Forces of the top after each step, those of all increments, and iterations.
struct Cycle {
  std::vector<double> forces;
  int iterations = 0;
  bool finished = false;
};

Cycle run_cycle(const std::string& path, solid::Assumption kind, bool by_user) {
  Cycle out;
  deck::Built built = deck::build_file(path);
  solid::Section<2>& section = built.model.sections[0].section;
  section.assumption = kind;
  if (by_user) {
    material::UserMaterial law;
    law.constants = {200, 0.3, 1, 20};
    law.state = 7;
    if (law.use(umat_)) return out;
    section.law = law;
  }
  const double area = kind == solid::Assumption::axisymmetric ? std::numbers::pi : 1;
  const auto look = [&](const Snapshot& now) {
    out.forces.push_back(
        model::history_value(now.system, built.model, now.state, built.history[0]) / area);
  };
  const model::AnalysisResult result = run_built(built, look);
  out.iterations = total_iterations(result);
  out.finished = result.outcome == solve::Outcome::converged;
  return out;
}

}  // namespace

CaseResult user_material(const CaseContext& context) {
  CaseResult out;
  const std::string path = context.folder + "/cycle.yaml";
  for (const auto& [kind, name] : {std::pair(solid::Assumption::plane_stress, "plane_stress"),
                                   std::pair(solid::Assumption::axisymmetric, "axisymmetric")}) {
    const Cycle own = run_cycle(path, kind, true), there = run_cycle(path, kind, false);
    const std::size_t steps = 3, each = 4;
    if (!own.finished || !there.finished || own.forces.size() != steps * each + 1 ||
        there.forces.size() != own.forces.size()) {
      out.rows.push_back({fmt::format("{}: finished", name), 0, 1, Relation::equal, 0, ""});
      continue;
    }
    // E = 200, Y = 1, H = 20: each piece that flows rises by E H / (E + H) of its strain
    constexpr std::array<double, 3> closed{1.2727272727, -1.7685950413, 2.1743050338};
    for (std::size_t k = 0; k < steps; ++k)
      out.rows.push_back({fmt::format("{}: stress after step {}", name, k + 1),
                          own.forces[each * (k + 1)], closed[k], Relation::equal, 1e-9,
                          "closed solution"});
    double apart = 0;
    for (std::size_t i = 0; i < own.forces.size(); ++i)
      apart = std::max(apart, std::abs(own.forces[i] - there.forces[i]));
    out.rows.push_back({fmt::format("{}: farthest from the built-in metal", name),
                        apart / closed[2], 1e-12, Relation::at_most, 0, "elastoplastic"});
    out.rows.push_back({fmt::format("{}: iterations", name), static_cast<double>(own.iterations),
                        static_cast<double>(there.iterations), Relation::equal, 0,
                        "elastoplastic"});
  }
  return out;
}

}  // namespace osculate::verification
