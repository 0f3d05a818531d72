// KSCPP 5.2: a rigid block slides into a valley and turns over its corner.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "../run_model.hpp"
#include "parts.hpp"
#include "reference.hpp"

namespace osculate::verification {
namespace {

constexpr double duration = 3.2;

TurningBlock block_with(double friction, double slid) {
  TurningBlock block;
  block.gravity = 1;
  block.slid = slid;
  block.friction = friction;
  block.slope_friction = friction;  // one valley, one coefficient
  return block;
}

/// How contact is enforced; the penalty is one that no increment resolves.
enum class Means { penalty, augmented, multipliers };
constexpr const char* enforcements[] = {"penalty", "{augmented_lagrange: {target: 1.0e-7}}",
                                        "lagrange_multiplier"};

struct Run {
  Means means;
  int increments;
  bool stops;  ///< increments end at impacts
  bool held;   ///< to 1 %, else information
  bool elastic = false;
};

std::string rigid_model(const TurningBlock& block, const Run& run) {
  const double h = duration / run.increments, q = std::numbers::sqrt2 / 2;
  const double penalty = run.means == Means::penalty ? 100 / (h * h) : 1e4;
  const double slid = block.slid;
  const auto at = [&](double along, double out) {
    return fmt::format("[{:.17g}, {:.17g}]", q * (-along + out), q * (along + out));
  };
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{block: {{line: {{points: [{0}, {1}, {2}, {3}, {0}], elements: [1, 1, 1, 1]}}}}}}}}
rigid:
  body: {{set: block, reference: {4}, mass: 1, inertia: {5:.17g}}}
  reentrant: {{polyline: {{points: [[-4, 4], [0, 0], [6, 0]]}}}}
contact:
  - {{name: c, master: reentrant, slave: body, sampling: nodes, weight: node, normal: {{penalty: {6:.17g}}},
     friction: {{coulomb: {{mu: {7}, penalty: {6:.17g}}}}}, enforcement: {8}}}
steps:
  - {{name: turn, increments: {9}, duration: {10:.17g}, gravity: [0, -1],
     dynamics: {{impact: plastic, impact_times: {11}}}}}
)",
                     at(slid, 0), at(slid + 1, 0), at(slid + 1, 1), at(slid, 1),
                     at(slid + 0.5, 0.5), 1.0 / 6, penalty, block.friction,
                     enforcements[static_cast<std::size_t>(run.means)], run.increments, duration,
                     run.stops ? "auto" : "off");
}

/// One element, so stiff that no increment resolves its vibrations, which the scheme takes out. Its
/// corner belongs to two pairs, one per face.
std::string elastic_model(const TurningBlock& block, const Run& run) {
  const double h = duration / run.increments, penalty = 25 / (h * h);
  const auto pair = [&](const char* face) {
    return fmt::format(R"(
  - {{name: {0}, master: reentrant, slave: block.{0}, sampling: nodes, weight: node,
     normal: {{penalty: {1:.17g}}}, friction: {{coulomb: {{mu: {2}, penalty: {1:.17g}}}}}, enforcement: {3}}})",
                       face, penalty, block.friction,
                       enforcements[static_cast<std::size_t>(run.means)]);
  };
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{block: {{box: {{x: [{0}, {1}], y: [0, 1], elements: [1, 1], angle: -45,
                                  about: [0, 0]}}}}}}}}
materials: {{hard: {{neo_hooke: {{E: 1.0e9, nu: 0.3, density: 1}}}}}}
sections: [{{on: block, element: plane_strain, material: hard, kinematics: finite}}]
rigid: {{reentrant: {{polyline: {{points: [[-4, 4], [0, 0], [6, 0]]}}}}}}
contact: {2}{3}
steps:
  - {{name: turn, increments: {4}, duration: {5:.17g}, gravity: [0, -1],
     dynamics: {{impact: plastic, impact_times: all, scheme: {{generalized_alpha: {{radius: 0}}}}}}}}
)",
                     -block.slid - 1, -block.slid, pair("bottom"), pair("right"), run.increments,
                     duration);
}

struct Sample {
  double time = 0, angle = 0, rate = 0;
  Vec2 force = Vec2::Zero();  ///< on the block
};

/// Angle and rate of turning of the block's four nodes, by least squares.
Sample sample_of(const Snapshot& now) {
  constexpr Index nodes = 4;
  const std::vector<Vec2> x = now.system.positions(now.state);
  const Eigen::VectorXd& velocity = now.state.rates.velocity;
  Vec2 center = Vec2::Zero(), start = Vec2::Zero();
  const auto at = [&](Index node) { return static_cast<std::size_t>(node); };
  for (Index node = 0; node < nodes; ++node) {
    center += x[at(node)] / nodes;
    start += (x[at(node)] - now.state.u.segment<2>(2 * node)) / nodes;
  }
  double sine = 0, cosine = 0, spin = 0, size = 0;
  Sample s;
  for (Index node = 0; node < nodes; ++node) {
    const Vec2 arm = x[at(node)] - center, v = velocity.segment<2>(2 * node);
    const Vec2 before = x[at(node)] - now.state.u.segment<2>(2 * node) - start;
    sine += before.x() * arm.y() - before.y() * arm.x();
    cosine += before.dot(arm);
    spin += arm.x() * v.y() - arm.y() * v.x();
    size += arm.squaredNorm();
    s.force -= now.system.forces().contact.segment<2>(2 * node);
  }
  s.time = now.state.rates.energies.elapsed;
  s.angle = -std::atan2(sine, cosine);
  s.rate = -spin / size;
  return s;
}

std::vector<Sample> samples_of(const TurningBlock& block, const Run& run) {
  std::vector<Sample> all;
  const model::AnalysisResult result =
      run_text(run.elastic ? elastic_model(block, run) : rigid_model(block, run),
               [&](const Snapshot& now) { all.push_back(sample_of(now)); });
  if (result.outcome != solve::Outcome::converged) all.clear();
  return all;
}

/// Where something first happens.
template <class Test>
std::size_t first_where(const std::vector<Sample>& all, const Test& test) {
  return static_cast<std::size_t>(std::find_if(all.begin(), all.end(), test) - all.begin());
}

void add_run(const Run& run, const BlockMotion& motion, CaseResult& out) {
  const std::vector<Sample> all = samples_of(motion.block, run);
  const double rate = rate_after_impact(motion.block), impact = impact_time(motion.block);
  const std::size_t hit = first_where(all, [&](const Sample& s) { return s.rate > 0.3 * rate; });
  const std::size_t flat =
      first_where(all, [](const Sample& s) { return s.angle > std::numbers::pi / 4 - 1e-4; });
  constexpr std::size_t settled = 12;            // steps after the impact
  const auto rate_around = [&](std::size_t i) {  // an elastic block vibrates
    double sum = 0;
    for (std::size_t k = 0; k < settled; ++k) sum += all[i + k].rate / settled;
    return run.elastic ? sum : all[i].rate;
  };
  const bool turned = hit + 2 * settled < flat && flat < all.size();
  const BlockState end = motion.stages.back().states.back();
  const char* const names[] = {"penalty", "augmented Lagrangian", "multipliers"};
  const std::string name =
      fmt::format("mu {}, L {} a: {}{}{}, {} increments", motion.block.friction, motion.block.slid,
                  run.elastic ? "elastic block, " : "", names[static_cast<std::size_t>(run.means)],
                  run.stops ? "" : ", impacts within increments", run.increments);
  const auto add = [&](const char* what, double value, double wanted, Relation relation) {
    out.rows.push_back({fmt::format("{}: {}", name, what), value, wanted, relation, 0.01,
                        "docs/turning_block.md"});
  };
  const Relation held = run.held ? Relation::equal : Relation::info;
  add("time of the impact", hit < all.size() ? all[hit].time : 0, impact, Relation::equal);
  add("rate after it, 3 v / (4 a)", turned ? rate_around(hit + settled) : 0, rate, held);
  add("time of the second contact", turned ? all[flat].time : 0, end.time, held);
  add("rate before it", turned ? all[flat - 1].rate : 0, end.rate, held);
  double worst = turned ? 0.0 : 1.0;
  Curve curve{fmt::format("reaction_{}", out.curves.size() + 1),
              {"t", "Rt", "Rn", "Rt_exact", "Rn_exact"},
              {}};
  constexpr double calm = 0.3;  // the corner hops no more: time since the impact
  // A plastic step leaves a body at rest with half the speed of a fall over the step, so that
  // forces jump where steps change their length.
  const auto even = [&](std::size_t i) {
    const double h = all[i].time - all[i - 1].time;
    for (std::size_t k = i - 1; k + 4 > i; --k)
      if (std::abs(all[k].time - all[k - 1].time - h) > 1e-6 * h) return false;
    return true;
  };
  for (std::size_t i = hit; turned && i + settled < flat; ++i) {
    if (all[i].time < impact + calm || !even(i)) continue;
    const Vec2 exact = reaction_at(motion, all[i].time);
    worst = std::max(worst, (all[i].force - exact).norm());
    curve.rows.push_back({all[i].time, all[i].force.x(), all[i].force.y(), exact.x(), exact.y()});
  }
  if (!run.elastic) add("largest error of the reaction / (m g)", worst, 0, held);
  out.curves.push_back(std::move(curve));
}

}  // namespace

CaseResult turning_block(const CaseContext&) {
  CaseResult out;
  const BlockMotion half = follow(block_with(0.5, 0.6)), third = follow(block_with(0.3, 0.3));
  for (const int increments : {800, 1600, 3200}) {
    add_run({Means::penalty, increments, true, true}, half, out);
    add_run({Means::augmented, increments, true, true}, half, out);
    add_run({Means::multipliers, increments, true, true}, half, out);
    add_run({Means::penalty, increments, false, false}, half, out);
    add_run({Means::penalty, increments, true, true}, third, out);
    add_run({Means::multipliers, increments, true, true}, third, out);
    add_run({Means::penalty, increments, true, increments == 3200, true}, half, out);
    add_run({Means::multipliers, increments, true, increments == 3200, true}, half, out);
    add_run({Means::penalty, increments, true, increments == 3200, true}, third, out);
    add_run({Means::multipliers, increments, true, false, true}, third, out);
  }
  add_projections(out);
  add_map(out);
  add_vibration(out);
  add_side_by_side(out);
  return out;
}

}  // namespace osculate::verification
