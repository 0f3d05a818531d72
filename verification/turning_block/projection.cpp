// KSCPP Fig. 12: what the block does when its corner is projected onto faces alone, onto
// overlapping faces, and onto faces and the valley line between them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "../body_path.hpp"
#include "block_run.hpp"
#include "parts.hpp"

namespace osculate::verification {
namespace {

constexpr const char* source = "KSCPP 5.2, Fig. 12";
constexpr std::array<const char*, 3> names{"faces and valley line", "faces alone",
                                           "overlapping faces"};

/// What is seen of the corner between the impact and the second contact.
struct Seen {
  double highest = 0, deepest = 0;  ///< place over the floor
  double open = 0;                  ///< share of the time without contact
};

Seen seen(const BlockPath& path, const Turning& t) {
  Seen out;
  double total = 0;
  for (std::size_t i = t.begin; i < t.end; ++i) {
    const BlockSample& s = path.samples[i];
    const double h = s.time - path.samples[i - 1].time;
    out.highest = std::max(out.highest, s.corner.y());
    out.deepest = std::min(out.deepest, s.corner.y());
    total += h;
    if (s.corner_open) out.open += h;
  }
  if (total > 0) out.open /= total;
  return out;
}

/// A deep corner brings the front face to the floor early, and does so without an impact: until the
/// block has turned by 45 degrees.
Turning until_turned(const BlockPath& path, double impact) {
  Turning t = turning(path, impact);
  for (t.end = t.begin; t.end < path.samples.size(); ++t.end)
    if (path.samples[t.end].angle > std::numbers::pi / 4 - 1e-3) break;
  return t;
}

io::PlotCurve height_of(const BlockPath& path, const Turning& t, const char* name) {
  io::PlotCurve curve{name, {}, {}, io::PlotStyle::line};
  for (std::size_t i = t.begin; i < t.end; ++i) {
    curve.x.push_back(path.samples[i].time - path.samples[t.begin].time);
    curve.y.push_back(path.samples[i].corner.y());
  }
  return curve;
}

/// The published set-up: a spring that gives back what it takes (Newmark's scheme), chosen so soft
/// that the generalised projection holds the corner.
void add_soft_spring(CaseResult& out) {
  constexpr double slid = 0.2, h = 0.004, impact = 3.3 * h;
  BlockRun run;
  run.impact = "average";
  run.penalty = 10;
  run.start = before_impact(slid, run.friction, impact);
  run.increments = 550;
  run.duration = h * run.increments;
  Picture picture{"projection",
                  {"Spring of 10 m g / a: height of the corner after the impact",
                   {"time since the impact / sqrt(a / g)", false, {}},
                   {"height over the floor / a", false, {}},
                   {},
                   {{"floor", 0}}}};
  for (const ReentrantVertex reentrant :
       {ReentrantVertex::generalized, ReentrantVertex::faces, ReentrantVertex::overlapping}) {
    run.reentrant = reentrant;
    const BlockPath path = path_of(run);
    const Turning t = until_turned(path, impact);
    const Seen s = seen(path, t);
    const char* const name = names[static_cast<std::size_t>(reentrant)];
    const auto add = [&](const char* what, double value, double wanted, Relation relation) {
      out.rows.push_back({fmt::format("spring of 10 m g / a, {}: {}", name, what), value, wanted,
                          relation, 0, source});
    };
    const bool holds = reentrant == ReentrantVertex::generalized;
    add("highest place of the corner / a", s.highest, holds ? 0 : 0.1,
        holds ? Relation::at_most : Relation::at_least);
    add("share of the time without contact", s.open, holds ? 0 : 0.1,
        holds ? Relation::at_most : Relation::at_least);
    add("deepest place of the corner / a", s.deepest, 0, Relation::info);
    picture.plot.curves.push_back(height_of(path, t, name));
  }
  out.pictures.push_back(std::move(picture));
}

/// With plastic impacts and contacts that no increment resolves, for a way and a friction with
/// which the floor alone cannot hold the corner (it would slip back into the valley).
void add_plastic(CaseResult& out) {
  constexpr double slid = 0.1, h = 0.004, impact = 3.3 * h;
  BlockRun run;
  run.friction = 0.3;
  run.penalty = 100 / (h * h);
  run.start = before_impact(slid, run.friction, impact);
  run.increments = 475;
  run.duration = h * run.increments;
  TurningBlock block;
  block.gravity = 1;
  block.slid = slid;
  block.friction = run.friction;
  const BlockMotion motion = follow(block);
  const BlockState last = motion.stages.back().states.back();
  const double wanted = last.time - impact_time(block);
  for (const ReentrantVertex reentrant :
       {ReentrantVertex::generalized, ReentrantVertex::faces, ReentrantVertex::overlapping}) {
    run.reentrant = reentrant;
    const BlockPath path = path_of(run);
    const Turning t = turning(path, impact);
    const Seen s = seen(path, t);
    const std::string name =
        fmt::format("plastic impact, {}: ", names[static_cast<std::size_t>(reentrant)]);
    const double landed = t.landed ? *t.landed - impact : 0;
    if (reentrant == ReentrantVertex::faces) {
      out.rows.push_back({name + "deepest place of the corner / a", s.deepest, -0.01,
                          Relation::at_most, 0, source});
      inform(out, name + "time from impact to second contact", landed, wanted, source);
    } else {
      expect(out, name + "time from impact to second contact", landed, wanted, 0.01, source);
      expect(out, name + "rate before it", t.landed ? path.samples[t.end - 1].rate : 0, last.rate,
             0.01, source);
    }
  }
}

}  // namespace

void add_projections(CaseResult& out) {
  add_soft_spring(out);
  add_plastic(out);
}

}  // namespace osculate::verification
