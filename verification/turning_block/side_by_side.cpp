// One impact with every means: what the corner does between the impact and the second contact.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../body_path.hpp"
#include "block_run.hpp"
#include "parts.hpp"

namespace osculate::verification {
namespace {

constexpr const char* source = "docs/turning_block.md";

struct Means {
  const char* name;
  const char* enforcement;
  const char* impact;
  double penalty;
  double viscous;
  ReentrantVertex reentrant;
  bool held;  ///< to 1 %, else information
};

double highest(const BlockPath& path, const Turning& t) {
  double most = 0;
  for (std::size_t i = t.begin; i < t.end; ++i) most = std::max(most, path.samples[i].corner.y());
  return most;
}

constexpr const char* augmented = "{augmented_lagrange: {target: 1.0e-7}}";

void add_run(const Means& means, double slid, double h, CaseResult& out) {
  TurningBlock block;
  block.gravity = 1;
  block.slid = slid;
  block.friction = block.slope_friction = 0.5;
  const BlockMotion motion = follow(block);
  const BlockState last = motion.stages.back().states.back();
  BlockRun run;
  run.start = at_rest(slid);
  run.friction = block.friction;
  run.enforcement = means.enforcement;
  run.impact = means.impact;
  run.penalty = means.penalty;
  run.viscous = means.viscous;
  run.reentrant = means.reentrant;
  run.increments = static_cast<int>(1.1 * last.time / h);
  run.duration = h * run.increments;
  const BlockPath path = path_of(run);
  const Turning t = turning(path, impact_time(block));
  const std::string name =
      fmt::format("mu 0.5, L {} a, {}, increments of {}: ", slid, means.name, h);
  const auto add = [&](const char* what, double value, double wanted, double tolerance) {
    out.rows.push_back({name + what, value, wanted, means.held ? Relation::equal : Relation::info,
                        tolerance, source});
  };
  add("highest place of the corner / a", highest(path, t), 0, 1e-4);
  add("time of the second contact", t.landed.value_or(0), last.time, 0.01);
  add("rate before it", t.landed ? path.samples[t.end - 1].rate : 0, last.rate, 0.01);
}

}  // namespace

void add_side_by_side(CaseResult& out) {
  constexpr double h = 2e-3, stiff = 1e4, unresolved = 100 / (h * h);
  const ReentrantVertex one = ReentrantVertex::generalized, two = ReentrantVertex::overlapping;
  for (const Means& means :
       {Means{"penalty", "penalty", "average", stiff, 0, one, false},
        Means{"penalty, critical damper", "penalty", "average", stiff, 200, one, false},
        Means{"penalty, five times that", "penalty", "average", stiff, 1000, one, false},
        Means{"penalty, dissipative", "penalty", "dissipative", unresolved, 0, one, false},
        Means{"penalty, plastic", "penalty", "plastic", unresolved, 0, one, true},
        Means{"augmented Lagrangian, plastic", augmented, "plastic", stiff, 0, one, true},
        Means{"augmented Lagrangian, plastic, two masters", augmented, "plastic", stiff, 0, two,
              true},
        Means{"multipliers, plastic", "lagrange_multiplier", "plastic", stiff, 0, one, true},
        Means{"multipliers, plastic, two masters", "lagrange_multiplier", "plastic", stiff, 0, two,
              true}})
    add_run(means, 0.6, h, out);
  for (const ReentrantVertex reentrant : {one, two})
    add_run({reentrant == one ? "multipliers, plastic" : "multipliers, plastic, two masters",
             "lagrange_multiplier", "plastic", stiff, 0, reentrant, true},
            0.4, 2 * h, out);
  for (const ReentrantVertex reentrant : {one, two})  // does not always find the corner
    add_run({reentrant == one ? "augmented Lagrangian, plastic"
                              : "augmented Lagrangian, plastic, two masters",
             augmented, "plastic", stiff, 0, reentrant, false},
            0.4, 2 * h, out);
}

}  // namespace osculate::verification
