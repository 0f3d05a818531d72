// The penalty is a spring on which the corner vibrates: shown, and what takes the vibration out.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../body_path.hpp"
#include "block_run.hpp"
#include "parts.hpp"
#include "spring.hpp"

namespace osculate::verification {
namespace {

constexpr const char* source = "docs/turning_block.md";
constexpr double slid = 0.3, stiffness = 1e4, first_angle = 0.05;
constexpr int per_period = 100, periods = 6;

Vec2 to_centre(double angle) { return {std::sin(angle), std::cos(angle)}; }

/// Turning as after an impact, with the spring along the line to the centre at half of its load:
/// the force vibrates between a half and three halves of it.
BlockState half_loaded() {
  TurningBlock block;
  block.gravity = 1;
  block.slid = slid;
  const Vec2 force = turning_reaction(block, first_angle), along = to_centre(first_angle);
  const Vec2 loaded = force - 0.5 * force.dot(along) * along;
  return {0, -loaded / stiffness, Vec2::Zero(), first_angle, turning_rate(block, first_angle)};
}

/// What the force along the line to the centre differs by from that of the circle it goes along,
/// m (g cos(phi) - r phi'^2).
std::vector<Vec2> vibration_of(const BlockPath& path) {
  std::vector<Vec2> out;
  for (std::size_t i = 1; i < path.samples.size(); ++i) {
    const BlockSample& s = path.samples[i];
    const Vec2 along = to_centre(s.angle);
    out.emplace_back(s.time, s.force.dot(along) - along.y() + std::sqrt(0.5) * s.rate * s.rate);
  }
  return out;
}

/// Of the vibration: mean period, and the mean factor from one largest value to the next.
struct Measured {
  double period = 0, factor = 0;
};

Measured measured(const std::vector<Vec2>& curve) {
  std::vector<double> zeros, peaks;
  for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
    const double a = curve[i - 1].y(), b = curve[i].y(), c = curve[i + 1].y();
    if (a < 0 && b >= 0)
      zeros.push_back(curve[i].x() - b * (curve[i].x() - curve[i - 1].x()) / (b - a));
    if (b > a && b >= c) peaks.push_back(b - (c - a) * (c - a) / (8 * (a - 2 * b + c)));
  }
  Measured m;
  if (zeros.size() < 2 || peaks.size() < 2) return m;
  m.period = (zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1);
  m.factor = std::pow(peaks.back() / peaks.front(), 1.0 / static_cast<double>(peaks.size() - 1));
  return m;
}

}  // namespace

void add_vibration(CaseResult& out) {
  struct Kind {
    const char* name;
    const char* impact;
    double viscous, factor;  ///< damper; amplitude after a period over that before
  };
  const double period = spring_period(1, stiffness), h = period / per_period;
  constexpr double damper = 4;
  const auto implicit = [&](double theta) {
    return std::pow(implicit_share(1, stiffness, h, theta), per_period);
  };
  Picture picture{"vibration",
                  {"Spring of 10000 m g / a: force along the line to the centre, less its mean",
                   {"time / sqrt(a / g)", false, {}},
                   {"force / (m g)", false, {}},
                   {},
                   {}}};
  for (const Kind& kind :
       {Kind{"average", "average", 0, 1},
        Kind{"average, damper", "average", damper, damped_share(1, damper, period)},
        Kind{"dissipative", "dissipative", 0, implicit(0.5)},
        Kind{"plastic", "plastic", 0, implicit(1)}}) {
    BlockRun run;
    run.start = half_loaded();
    run.friction = 1;
    run.penalty = stiffness;
    run.impact = kind.impact;
    run.viscous = kind.viscous;
    run.increments = periods * per_period;
    run.duration = periods * period;
    const std::vector<Vec2> curve = vibration_of(path_of(run));
    const Measured m = measured(curve);
    const std::string name = fmt::format("vibration, {}: ", kind.name);
    expect(out, name + "period", m.period, period, 2e-3, source);
    expect(out, name + "amplitude after a period over that before", m.factor, kind.factor, 2e-3,
           source);
    io::PlotCurve drawn{kind.name, {}, {}, io::PlotStyle::line};
    for (const Vec2& p : curve) {
      drawn.x.push_back(p.x());
      drawn.y.push_back(p.y());
    }
    picture.plot.curves.push_back(std::move(drawn));
  }
  out.pictures.push_back(std::move(picture));
}

}  // namespace osculate::verification
