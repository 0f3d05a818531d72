// The map over the way L and the friction mu: where the corner slips, lifts off and jumps.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "../body_path.hpp"
#include "block_run.hpp"
#include "parts.hpp"

namespace osculate::verification {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity(), h = 1e-3;
constexpr double calm = 0.3;  // the corner hops no more: time since the impact
constexpr const char* source = "docs/turning_block.md";

/// As published: from rest, a slope without friction. (One master has one friction, so that these
/// are two.)
BlockRun run_at(double slid, double friction, double after) {
  BlockRun run;
  run.friction = friction;
  run.smooth_slope = true;
  run.reentrant = ReentrantVertex::overlapping;
  run.start = at_rest(slid);
  TurningBlock block;
  block.gravity = 1;
  block.slid = slid;
  run.increments = static_cast<int>((impact_time(block) + after) / h);
  run.duration = h * run.increments;
  run.penalty = 100 / (h * h);
  return run;
}

/// Of the corner from `calm` after the impact to the second contact.
struct Grip {
  double demand = -infinite;  ///< largest -R_t / R_n
  double slips_at = 0;        ///< angle [degrees] at which it reaches mu; 0: it does not
  double least = infinite;    ///< smallest R_n
  double lifts_at = 0;        ///< angle [degrees] at which it vanishes; 0: it does not
};

Grip grip_of(const BlockPath& path, const Turning& t, double friction) {
  constexpr double degrees = 180 / std::numbers::pi, rounding = 1e-9, nothing = 1e-4;
  Grip g;
  for (std::size_t i = t.begin; i < t.end; ++i) {
    const BlockSample& s = path.samples[i];
    if (s.time < path.samples[t.begin].time + calm || !even_steps(path.samples, i)) continue;
    g.least = std::min(g.least, s.force.y());
    if (s.force.y() < nothing && g.lifts_at == 0) g.lifts_at = degrees * s.angle;
    if (!(s.force.y() > 0)) continue;
    const double demand = -s.force.x() / s.force.y();
    g.demand = std::max(g.demand, demand);
    if (demand > friction * (1 - rounding) && g.slips_at == 0) g.slips_at = degrees * s.angle;
  }
  return g;
}

TurningBlock block_of(double slid, double friction) {
  TurningBlock block;
  block.gravity = 1;
  block.slid = slid;
  block.friction = friction;
  return block;
}

/// One run of the map.
struct Tried {
  double slid = 0, friction = 0;
  Grip grip;
  double landed = 0, rate = 0;  ///< second contact; 0: none
};

Tried tried(double slid, double friction, double after) {
  const BlockPath path = path_of(run_at(slid, friction, after));
  const Turning t = turning(path, impact_time(block_of(slid, friction)));
  return {slid, friction, grip_of(path, t, friction), t.landed.value_or(0),
          t.landed ? path.samples[t.end - 1].rate : 0};
}

/// 2 % to both sides of the border of slip.
void add_borders(CaseResult& out, std::vector<Tried>& all) {
  for (const double friction : {0.3, 1.0, 2.0})
    for (const double share : {0.98, 1.02}) {
      const double border = longest_without_slip(friction);
      all.push_back(tried(share * border, friction, 1.35));
      const bool below = share < 1;
      out.rows.push_back({fmt::format("mu {}, 2 % {} the border {:.5f} a: largest -R_t / (mu R_n)",
                                      friction, below ? "below" : "above", border),
                          all.back().grip.demand / friction, below ? 0.99 : 1 - 1e-9,
                          below ? Relation::at_most : Relation::at_least, 0, source});
    }
}

/// Where it slips or jumps: from which angle on, and when the front meets the floor. (How the
/// penalty finds its grip hides the beginning of a slip that begins with the turning.)
void add_slips(CaseResult& out, std::vector<Tried>& all) {
  constexpr double degrees = 180 / std::numbers::pi;
  struct Place {
    double slid, friction, tolerance;
  };
  for (const Place& p : {Place{0.5, 0.5, 0.01}, Place{0.6, 0.3, 0.01}, Place{0.9, 0.3, 0.01},
                         Place{0.7, 1.0, 0.01}, Place{1.5, 0.3, 0.02}, Place{2.0, 0.3, 0.02}}) {
    const BlockMotion motion = follow(block_of(p.slid, p.friction));
    const auto slipping =
        std::find_if(motion.stages.begin(), motion.stages.end(),
                     [](const BlockStage& s) { return s.phase == BlockPhase::slipping; });
    const BlockState last = motion.stages.back().states.back();
    const Tried run = tried(p.slid, p.friction, 1.35);
    const bool jumps = p.slid > shortest_jump(p.friction);
    const std::string name =
        fmt::format("mu {}, L {} a{}: ", p.friction, p.slid, jumps ? ", jumps" : "");
    if (!jumps && slipping->states.front().time > impact_time(motion.block) + calm) {
      expect(out, name + "slips from [degrees]", run.grip.slips_at,
             degrees * slipping->states.front().angle, p.tolerance, source);
      all.push_back(run);
    }
    const double impact = impact_time(motion.block);
    expect(out, name + "time from impact to second contact",
           run.landed > 0 ? run.landed - impact : 0, last.time - impact, p.tolerance, source);
    expect(out, name + "rate before it", run.rate, last.rate, p.tolerance, source);
  }
}

/// A corner that cannot slip leaves the floor before the second contact above 0.79030 a only.
void add_lift(CaseResult& out) {
  const double border = longest_without_slip(infinite);
  constexpr double flat = std::numbers::pi / 4, degrees = 180 / std::numbers::pi;
  for (const double share : {0.98, 1.02}) {
    const TurningBlock block = block_of(share * border, infinite);
    double low = 0, high = flat;  // where R_n vanishes
    while (high - low > 1e-12) {
      const double middle = 0.5 * (low + high);
      (turning_reaction(block, middle).y() > 0 ? low : high) = middle;
    }
    const Grip g = tried(block.slid, infinite, 1.1).grip;
    const std::string name =
        fmt::format("no slip, 2 % {} the border {:.5f} a: ", share < 1 ? "below" : "above", border);
    expect(out, name + "angle of lift-off [degrees]", g.lifts_at, share < 1 ? 0 : degrees * low,
           0.005, source);
    inform(out, name + "smallest R_n / (m g)", g.least,
           std::max(0.0, turning_reaction(block, flat).y()), source);
  }
}

Picture picture_of(const std::vector<Tried>& all) {
  io::PlotCurve border{"border, docs/turning_block.md", {}, {}, io::PlotStyle::line};
  for (double mu = 0.25; mu < 2.2; mu += 0.01) {
    border.x.push_back(mu);
    border.y.push_back(longest_without_slip(mu));
  }
  io::PlotCurve sticks{"solver: sticks", {}, {}, io::PlotStyle::marks},
      slips{"solver: slips", {}, {}, io::PlotStyle::marks};
  for (const Tried& run : all) {
    io::PlotCurve& curve = run.grip.slips_at > 0 ? slips : sticks;
    curve.x.push_back(run.friction);
    curve.y.push_back(run.slid);
  }
  return {"slip",
          {"Whether the corner slips before the second contact",
           {"friction mu", false, {}},
           {"way L / a", false, {}},
           {std::move(border), std::move(sticks), std::move(slips)},
           {}}};
}

}  // namespace

void add_map(CaseResult& out) {
  std::vector<Tried> all;
  add_borders(out, all);
  add_slips(out, all);
  out.pictures.push_back(picture_of(all));
  add_lift(out);
}

}  // namespace osculate::verification
