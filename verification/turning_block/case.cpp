// KSCPP 5.2: a rigid block slides into a valley and turns over its corner.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "../run_model.hpp"
#include "reference.hpp"

namespace osculate::verification {
namespace {

constexpr double friction = 0.5, slid = 0.6, duration = 3.2;

TurningBlock block_of_case() {
  TurningBlock block;
  block.gravity = 1;
  block.slid = slid;
  block.friction = friction;
  block.slope_friction = friction;  // one valley, one coefficient
  return block;
}

/// Stiff enough that a step does not resolve it: 100 / h^2.
std::string model_text(int increments) {
  const double h = duration / increments, penalty = 100 / (h * h), q = std::numbers::sqrt2 / 2;
  const auto at = [&](double along, double out) {
    return fmt::format("[{:.17g}, {:.17g}]", q * (-along + out), q * (along + out));
  };
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{block: {{line: {{points: [{0}, {1}, {2}, {3}, {0}], elements: [1, 1, 1, 1]}}}}}}}}
rigid:
  body: {{set: block, reference: {4}, mass: 1, inertia: {5:.17g}}}
  valley: {{polyline: {{points: [[-4, 4], [0, 0], [6, 0]]}}}}
contact:
  - {{name: c, master: valley, slave: body, sampling: nodes, weight: node, normal: {{penalty: {6:.17g}}},
     friction: {{coulomb: {{mu: {7}, penalty: {6:.17g}}}}}}}
steps:
  - {{name: turn, increments: {8}, duration: {9}, gravity: [0, -1], dynamics: {{impact: plastic}}}}
)",
                     at(slid, 0), at(slid + 1, 0), at(slid + 1, 1), at(slid, 1),
                     at(slid + 0.5, 0.5), 1.0 / 6, penalty, friction, increments, duration);
}

struct Sample {
  double time = 0, angle = 0, rate = 0;
  Vec2 force = Vec2::Zero();  ///< on the block
};

std::vector<Sample> samples_of(int increments) {
  std::vector<Sample> all;
  const model::AnalysisResult result = run_text(model_text(increments), [&](const Snapshot& now) {
    Sample s;
    s.time = now.state.rates.energies.elapsed;
    s.angle = -now.state.rigid[0].angle;
    s.rate = -now.state.rates.velocity[now.system.dofs().body_dof(0, 2)];
    for (Index node = 0; node < 4; ++node)
      s.force -= now.system.forces().contact.segment<2>(2 * node);
    all.push_back(s);
  });
  if (result.outcome != solve::Outcome::converged) all.clear();
  return all;
}

/// Where something first happens.
template <class Test>
std::size_t first_where(const std::vector<Sample>& all, const Test& test) {
  return static_cast<std::size_t>(std::find_if(all.begin(), all.end(), test) - all.begin());
}

void add_run(int increments, const BlockMotion& motion, CaseResult& out) {
  const std::vector<Sample> all = samples_of(increments);
  const double rate = rate_after_impact(motion.block), impact = impact_time(motion.block);
  const std::size_t hit = first_where(all, [&](const Sample& s) { return s.rate > 0.3 * rate; });
  const std::size_t flat =
      first_where(all, [](const Sample& s) { return s.angle > std::numbers::pi / 4 - 1e-6; });
  constexpr std::size_t settled = 12;  // steps after the impact
  const bool turned = hit + settled < flat && flat < all.size();
  const BlockState end = motion.stages.back().states.back();
  // What follows the impact depends on how the increment of the impact ends: not yet held to 1 %.
  const auto add = [&](const char* what, double value, double wanted, Relation relation) {
    out.rows.push_back({fmt::format("{}, {} increments", what, increments), value, wanted, relation,
                        0.01, "docs/turning_block.md"});
  };
  add("time of the impact", hit < all.size() ? all[hit].time : 0, impact, Relation::equal);
  add("rate after the impact, 3 v / (4 a)", turned ? all[hit + settled].rate : 0, rate,
      Relation::info);
  add("time of the second contact", turned ? all[flat].time : 0, end.time, Relation::info);
  add("rate before it", turned ? all[flat - 1].rate : 0, end.rate, Relation::info);
  double worst = 0;
  Curve curve{
      fmt::format("reaction_{}", increments), {"t", "Rt", "Rn", "Rt_exact", "Rn_exact"}, {}};
  for (std::size_t i = hit + 4 * settled; turned && i + settled < flat; ++i) {
    const Vec2 exact = reaction_at(motion, all[i].time);
    worst = std::max(worst, (all[i].force - exact).norm());
    curve.rows.push_back({all[i].time, all[i].force.x(), all[i].force.y(), exact.x(), exact.y()});
  }
  add("largest error of the reaction / (m g)", worst, 0, Relation::info);
  out.curves.push_back(std::move(curve));
}

}  // namespace

CaseResult turning_block(const CaseContext&) {
  CaseResult out;
  const BlockMotion motion = follow(block_of_case());
  for (const int increments : {800, 1600, 3200}) add_run(increments, motion, out);
  return out;
}

}  // namespace osculate::verification
