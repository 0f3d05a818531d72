#include "block_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "../run_model.hpp"

namespace osculate::verification {
namespace {

constexpr double q = std::numbers::sqrt2 / 2;

/// Coordinates in the block, along its lower face (up the slope) and out of it, to a place.
Vec2 place_in(const BlockState& s, double along, double out) {
  const Vec2 arm(q * (-along + out), q * (along + out));  // with angle 0
  const double c = std::cos(s.angle), d = std::sin(s.angle);
  return s.corner + Vec2(c * arm.x() + d * arm.y(), -d * arm.x() + c * arm.y());
}

std::string point(const Vec2& p) { return fmt::format("[{:.17g}, {:.17g}]", p.x(), p.y()); }

std::string friction_of(const BlockRun& run) {
  if (!std::isfinite(run.friction))
    return fmt::format("{{rough: {{penalty: {:.17g}}}}}", run.penalty);
  return fmt::format("{{coulomb: {{mu: {:.17g}, penalty: {:.17g}}}}}", run.friction, run.penalty);
}

std::string pair_of(const BlockRun& run, const char* name, const char* master,
                    const std::string& friction) {
  const std::string damping =
      run.viscous > 0 ? fmt::format(", damping: {{viscous: {:.17g}}}", run.viscous) : "";
  return fmt::format(R"(
  - {{name: {}, master: {}, slave: body, sampling: nodes, weight: node,
     normal: {{penalty: {:.17g}{}}}, friction: {}, enforcement: {}}})",
                     name, master, run.penalty, damping, friction, run.enforcement);
}

/// Two masters: each ends with a short piece, whose continuation at its open end (5 % of a facet)
/// is nothing.
std::string masters(const BlockRun& run) {
  if (run.reentrant == ReentrantVertex::generalized)
    return "  valley: {polyline: {points: [[-4, 4], [0, 0], [6, 0]]}}";
  constexpr double piece = 1e-6;
  const double beyond = run.reentrant == ReentrantVertex::overlapping ? 0.3 : 0;
  const Vec2 down(q, -q), back(-1, 0);
  return fmt::format(
      "  slope: {{polyline: {{points: [[-4, 4], {}, {}]}}}}\n"
      "  floor: {{polyline: {{points: [{}, {}, [6, 0]]}}}}",
      point((beyond - piece) * down), point(beyond * down), point(beyond * back),
      point((beyond - piece) * back));
}

std::string pairs(const BlockRun& run) {
  const std::string friction = friction_of(run);
  if (run.reentrant == ReentrantVertex::generalized) return pair_of(run, "c", "valley", friction);
  return pair_of(run, "s", "slope", run.smooth_slope ? "none" : friction) +
         pair_of(run, "f", "floor", friction);
}

std::string model_of(const BlockRun& run) {
  const BlockState& s = run.start;
  const Vec2 centre = place_in(s, 0.5, 0.5), arm = centre - s.corner;
  const Vec2 velocity = s.velocity + s.rate * Vec2(arm.y(), -arm.x());
  const auto at = [&](double along, double out) { return point(place_in(s, along, out)); };
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{block: {{line: {{points: [{0}, {1}, {2}, {3}, {0}], elements: [1, 1, 1, 1]}}}}}}}}
rigid:
  body: {{set: block, reference: {4}, mass: 1, inertia: {5:.17g}}}
{6}
contact:{7}
initial_velocity: [{{on: body, vx: {8:.17g}, vy: {9:.17g}, wz: {10:.17g}}}]
steps:
  - {{name: turn, increments: {11}, duration: {12:.17g}, gravity: [0, -1],
     dynamics: {{impact: {13}}}}}
)",
                     at(0, 0), at(1, 0), at(1, 1), at(0, 1), point(centre), 1.0 / 6, masters(run),
                     pairs(run), velocity.x(), velocity.y(), -s.rate, run.increments, run.duration,
                     run.impact);
}

constexpr std::size_t corner = 0, front = 3;  // of the four nodes

BlockSample sample_of(const BlockState& start, const Snapshot& now) {
  const Eigen::Index body = now.state.u.size();
  BlockSample s;
  s.time = now.state.rates.energies.elapsed;
  s.corner = now.system.positions(now.state)[corner];
  s.angle = start.angle - now.state.rigid.front().angle;
  s.rate = -now.state.rates.velocity[body + 2];
  for (const auto& pair : now.system.contact()) {
    for (const pairing::PointResult<2>& p : pair.points)
      s.force -= p.weight * (p.normal_traction * p.normal + p.shear());
    s.corner_open = s.corner_open && pair.points[corner].status == contact::Status::open;
    s.front_open = s.front_open && pair.points[front].status == contact::Status::open;
  }
  return s;
}

}  // namespace

BlockState at_rest(double slid) { return {0, slid * Vec2(-q, q), Vec2::Zero(), 0, 0}; }

BlockState before_impact(double slid, double slope_friction, double time_left) {
  const double speed = std::sqrt(std::numbers::sqrt2 * slid), faster = q * (1 - slope_friction);
  const Vec2 down(q, -q);
  return {0, -time_left * (speed - 0.5 * faster * time_left) * down,
          (speed - faster * time_left) * down, 0, 0};
}

BlockPath path_of(const BlockRun& run) {
  BlockPath path;
  const model::AnalysisResult result = run_text(model_of(run), [&](const Snapshot& now) {
    if (!now.state.rates.empty()) path.samples.push_back(sample_of(run.start, now));
  });
  path.finished = result.outcome == solve::Outcome::converged;
  return path;
}

Turning turning(const BlockPath& path, double impact) {
  constexpr double begun = 0.3;  // rad: the block is not on the slope any more
  const std::vector<BlockSample>& all = path.samples;
  Turning t;
  while (t.begin < all.size() && all[t.begin].time <= impact) ++t.begin;
  t.end = t.begin;
  while (t.end < all.size() && (all[t.end].front_open || all[t.end].angle < begun)) ++t.end;
  if (t.end < all.size()) t.landed = all[t.end].time;
  return t;
}

bool even_steps(const std::vector<BlockSample>& samples, std::size_t i) {
  constexpr std::size_t count = 4;
  if (i < count) return false;
  const double h = samples[i].time - samples[i - 1].time;
  for (std::size_t k = i - 1; k + count > i; --k)
    if (std::abs(samples[k].time - samples[k - 1].time - h) > 1e-6 * h) return false;
  return true;
}

}  // namespace osculate::verification
