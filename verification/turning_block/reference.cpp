#include "reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace osculate::verification {
namespace {

constexpr double root2 = std::numbers::sqrt2, flat = std::numbers::pi / 4;
constexpr double r = root2 / 2;  // from the corner to the centre, over a
constexpr double about_centre = 1.0 / 6;

// Inside, lengths are over a, times over sqrt(a / g), masses over m.

struct Point {
  Vec2 at = Vec2::Zero(), velocity = Vec2::Zero();
  double angle = 0, rate = 0;
};

struct Contact {
  BlockPhase phase = BlockPhase::sticking;
  int direction = 0;
};

Vec2 to_centre(double angle) { return r * Vec2(std::sin(angle), std::cos(angle)); }

/// On a corner that does not move.
Vec2 sticking_force(const Point& p) {
  const double s = std::sin(p.angle), c = std::cos(p.angle), w2 = p.rate * p.rate;
  const double turning = 1.5 * r * s;
  return {r * (turning * c - w2 * s), 1 - r * (turning * s + w2 * c)};
}

/// On a corner that moves along the floor, from y'' = 0 with the friction -direction mu N.
Vec2 slipping_force(const Point& p, double mu, int direction) {
  const double s = std::sin(p.angle), c = std::cos(p.angle);
  const double lever = s + direction * mu * c;
  const double normal = (1 - r * p.rate * p.rate * c) / (1 + r * r / about_centre * s * lever);
  return {-direction * mu * normal, normal};
}

Vec2 force(const Point& p, double mu, const Contact& contact) {
  if (contact.phase == BlockPhase::sticking) return sticking_force(p);
  if (contact.phase == BlockPhase::slipping) return slipping_force(p, mu, contact.direction);
  return Vec2::Zero();
}

Point rates(const Point& p, double mu, const Contact& contact) {
  const Vec2 f = force(p, mu, contact);
  const double s = std::sin(p.angle), c = std::cos(p.angle), w2 = p.rate * p.rate;
  const double turning = r * (f.y() * s - f.x() * c) / about_centre;
  Vec2 corner = f - Vec2(0, 1) + r * Vec2(w2 * s - turning * c, w2 * c + turning * s);
  if (contact.phase != BlockPhase::flying) corner.y() = 0;
  if (contact.phase == BlockPhase::sticking) corner.x() = 0;
  return {p.velocity, corner, p.rate, turning};
}

Point moved(const Point& p, double h, const Point& d) {
  return {p.at + h * d.at, p.velocity + h * d.velocity, p.angle + h * d.angle, p.rate + h * d.rate};
}

Point runge_kutta(const Point& p, double h, double mu, const Contact& contact) {
  const Point k1 = rates(p, mu, contact);
  const Point k2 = rates(moved(p, h / 2, k1), mu, contact);
  const Point k3 = rates(moved(p, h / 2, k2), mu, contact);
  const Point k4 = rates(moved(p, h, k3), mu, contact);
  return moved(moved(moved(moved(p, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
}

constexpr double rounding = 1e-13;

/// Not negative as long as floor and slope can hold the corner. At the valley line the slope keeps
/// it from slipping back.
double grip(const Point& p, double mu) {
  const Vec2 f = sticking_force(p);
  const double back = p.at.x() <= 0 ? std::max(1.0, mu) : mu;
  return std::min({f.y(), (mu * f.y() + f.x()) / (1 + mu), (back * f.y() - f.x()) / (1 + back)});
}

/// How the corner goes on: on the floor and not moving off it. A grip that has just been lost is
/// lost here too, whatever the rounding.
Contact contact_now(const Point& p, double mu) {
  int direction = p.velocity.x() > 0 ? 1 : (p.velocity.x() < 0 ? -1 : 0);
  if (direction == 0) {
    if (grip(p, mu) > rounding) return {BlockPhase::sticking, 0};
    const Vec2 f = sticking_force(p);
    direction = f.x() > 0 && f.y() > 0 ? -1 : 1;
  }
  if (slipping_force(p, mu, direction).y() > 0) return {BlockPhase::slipping, direction};
  return {BlockPhase::flying, 0};
}

/// Height of the front upper corner.
double front_height(const Point& p) {
  return p.at.y() + r * (std::cos(p.angle) - std::sin(p.angle));
}

/// Not negative as long as the phase lasts.
double margin(const Point& p, double mu, const Contact& contact) {
  if (contact.phase == BlockPhase::flying) return std::min(p.at.y(), front_height(p));
  const double to_go = flat - p.angle;
  if (contact.phase == BlockPhase::slipping) {
    const double going = contact.direction * p.velocity.x();
    return std::min({to_go, going, contact.direction < 0 ? p.at.x() : going});
  }
  return std::min(to_go, grip(p, mu));
}

struct Impulse {
  Vec2 p = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
  double turning = 0;  ///< change of the rate
};

/// Plastic impact of a corner that the centre is at `angle` from the vertical of: its velocity
/// normal to the floor becomes zero; friction acts against what is left along the floor (Moreau's
/// law).
Impulse plastic_impact(const Vec2& velocity, double angle, double mu) {
  const double s = std::sin(angle), c = std::cos(angle), k = r * r / about_centre;
  Mat<2, 2> mobility;
  mobility << 1 + k * c * c, -k * s * c, -k * s * c, 1 + k * s * s;
  const double det = 1 + k;
  Impulse out;
  out.p = -Vec2(mobility(1, 1) * velocity.x() - mobility(0, 1) * velocity.y(),
                mobility(0, 0) * velocity.y() - mobility(1, 0) * velocity.x()) /
          det;
  if (std::abs(out.p.x()) > mu * out.p.y()) {
    const double along = out.p.x() > 0 ? mu : -mu;
    out.p.y() = -velocity.y() / (mobility(1, 1) + along * mobility(1, 0));
    out.p.x() = along * out.p.y();
    out.velocity.x() = velocity.x() + mobility.row(0).dot(out.p);
  }
  out.turning = r / about_centre * (s * out.p.y() - c * out.p.x());
  return out;
}

double deceleration(const TurningBlock& b) { return b.gravity * (1 - b.slope_friction) / root2; }
double unit_time(const TurningBlock& b) { return std::sqrt(b.edge / b.gravity); }
double unit_speed(const TurningBlock& b) { return std::sqrt(b.edge * b.gravity); }
double ratio(const TurningBlock& b) { return b.slid * (1 - b.slope_friction) / b.edge; }

Point scaled(const TurningBlock& b, const BlockState& s) {
  return {s.corner / b.edge, s.velocity / unit_speed(b), s.angle, s.rate * unit_time(b)};
}

BlockState unscaled(const TurningBlock& b, const Point& p, double time) {
  return {time, p.at * b.edge, p.velocity * unit_speed(b), p.angle, p.rate / unit_time(b)};
}

BlockState on_slope(const TurningBlock& b, double time) {
  const Vec2 down = Vec2(1, -1) / root2;
  const double way = 0.5 * deceleration(b) * time * time;
  return {time, (way - b.slid) * down, deceleration(b) * time * down, 0, 0};
}

/// From `p` to the end of the phase or of the time; both changed.
BlockStage follow_phase(const TurningBlock& b, const Contact& contact, Point& p, double& time,
                        double step, double latest) {
  BlockStage out{contact.phase, contact.direction, {unscaled(b, p, time)}};
  const double unit = unit_time(b), mu = b.friction;
  while (time < latest) {
    const Point next = runge_kutta(p, step, mu, contact);
    if (margin(next, mu, contact) >= 0) {
      p = next;
      time += step * unit;
      out.states.push_back(unscaled(b, p, time));
      continue;
    }
    double low = 0, high = step;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (margin(runge_kutta(p, middle, mu, contact), mu, contact) >= 0 ? low : high) = middle;
    }
    p = runge_kutta(p, high, mu, contact);
    time += high * unit;
    break;
  }
  out.states.push_back(unscaled(b, p, time));
  return out;
}

/// What ends the motion where a phase ends, if anything does; otherwise the corner is made ready
/// for the next one, by an impact where it has landed.
bool ends(BlockMotion& motion, const Contact& contact, Point& p) {
  if (contact.phase == BlockPhase::flying) {
    if (front_height(p) <= rounding) return true;
    const Impulse impulse = plastic_impact(p.velocity, p.angle, motion.block.friction);
    p.at.y() = 0;
    p.velocity = impulse.velocity;
    p.rate += impulse.turning;
    motion.impulses.push_back(impulse.p * motion.block.mass * unit_speed(motion.block));
    return false;
  }
  if (p.angle >= flat - rounding) return true;
  if (contact.phase != BlockPhase::slipping) return false;
  if (contact.direction < 0 && p.at.x() <= 0) {
    motion.end = BlockEnd::at_the_slope;
    return true;
  }
  p.velocity.x() = 0;
  return false;
}

/// The stage in which `time` lies and the last of its states not after it.
std::pair<const BlockStage*, const BlockState*> before(const BlockMotion& motion, double time) {
  const BlockStage* stage = &motion.stages.front();
  for (const BlockStage& s : motion.stages)
    if (s.states.front().time <= time) stage = &s;
  const auto next = std::upper_bound(stage->states.begin(), stage->states.end(), time,
                                     [](double t, const BlockState& s) { return t < s.time; });
  return {stage, next == stage->states.begin() ? &*next : &*std::prev(next)};
}

}  // namespace

Vec2 centre(const TurningBlock& block, const BlockState& state) {
  return state.corner + block.edge * to_centre(state.angle);
}

Vec2 centre_velocity(const TurningBlock& block, const BlockState& state) {
  return state.velocity - block.edge * state.rate * turn(to_centre(state.angle));
}

double kinetic_energy(const TurningBlock& block, const BlockState& state) {
  const double inertia = about_centre * block.edge * block.edge;
  return 0.5 * block.mass *
         (centre_velocity(block, state).squaredNorm() + inertia * state.rate * state.rate);
}

double potential_energy(const TurningBlock& block, const BlockState& state) {
  return block.mass * block.gravity * centre(block, state).y();
}

double impact_time(const TurningBlock& block) {
  return std::sqrt(2 * block.slid / deceleration(block));
}

double impact_speed(const TurningBlock& block) {
  return std::sqrt(2 * block.slid * deceleration(block));
}

double rate_after_impact(const TurningBlock& block) {
  return 3 * std::min(0.25, block.friction) * impact_speed(block) / block.edge;
}

double turning_rate(const TurningBlock& block, double angle) {
  const double start = 0.75 * impact_speed(block) / block.edge;
  return std::sqrt(start * start + 3 / root2 * block.gravity / block.edge * (1 - std::cos(angle)));
}

double turning_time(const TurningBlock& block, double angle) {
  // phi'^2 = w^2 (1 + n sin^2(phi / 2)), n = 6 g / (sqrt(2) a w^2); the parameter -n is made
  // positive
  const double w = 0.75 * impact_speed(block) / block.edge;
  const double n = 6 / root2 * block.gravity / (block.edge * w * w);
  const double k = std::sqrt(n / (1 + n));
  const double complete = std::comp_ellint_1(k);
  const double rest = std::ellint_1(k, (std::numbers::pi - angle) / 2);
  return 2 / w * (complete - rest) / std::sqrt(1 + n);
}

Vec2 turning_reaction(const TurningBlock& block, double angle) {
  const double s = std::sin(angle), c = std::cos(angle);
  const double along = 2.5 * c - 1.5 - 9.0 / 16 * ratio(block), across = -0.25 * s;
  return block.mass * block.gravity * Vec2(along * s + across * c, along * c - across * s);
}

double longest_without_slip(double friction) {
  const double fraction = 2 / (1 + friction) - 1;  // (1 - mu) / (1 + mu)
  return 4.0 / 9 * (5 * root2 - 6) - 2 * root2 / 9 * fraction;
}

double friction_without_slip(double slid_over_edge) {
  const double along = 1.25 * root2 - 1.5 - 9.0 / 16 * slid_over_edge, across = root2 / 8;
  if (along <= -across) return std::numeric_limits<double>::infinity();
  return std::max(0.25, (across - along) / (across + along));
}

double shortest_jump(double friction) {
  const double least = std::min(0.25, friction);
  return 1 / (9 * least * least);
}

BlockMotion follow(const TurningBlock& block, double step) {
  constexpr double longest = 50;
  BlockMotion motion{block, {{BlockPhase::sliding, 0, {on_slope(block, 0)}}}, {}, {}};
  double time = impact_time(block);
  const double latest = time + longest * unit_time(block);
  motion.stages.front().states.push_back(on_slope(block, time));
  Point p = scaled(block, motion.stages.front().states.back());
  p.at.setZero();
  Contact contact{BlockPhase::flying, 0};  // it lands on its corner
  while (!ends(motion, contact, p)) {
    if (time >= latest) {
      motion.end = BlockEnd::still_upright;
      break;
    }
    contact = contact_now(p, block.friction);
    motion.stages.push_back(follow_phase(block, contact, p, time, step, latest));
  }
  return motion;
}

BlockState state_at(const BlockMotion& motion, double time) {
  const auto place = before(motion, time);
  const TurningBlock& b = motion.block;
  if (place.first->phase == BlockPhase::sliding) return on_slope(b, time);
  const Contact contact{place.first->phase, place.first->direction};
  const double h = (time - place.second->time) / unit_time(b);
  return unscaled(b, runge_kutta(scaled(b, *place.second), h, b.friction, contact), time);
}

Vec2 reaction_at(const BlockMotion& motion, double time) {
  const BlockStage& stage = *before(motion, time).first;
  const TurningBlock& b = motion.block;
  const double weight = b.mass * b.gravity;
  if (stage.phase == BlockPhase::sliding)
    return 0.5 * weight * (Vec2(1, 1) + b.slope_friction * Vec2(-1, 1));
  const Contact contact{stage.phase, stage.direction};
  return weight * force(scaled(b, state_at(motion, time)), b.friction, contact);
}

TurningKind turning_kind(double slid_over_edge, double friction) {
  if (slid_over_edge > shortest_jump(friction)) return TurningKind::jumps;
  if (friction < 0.25) return TurningKind::slips_at_impact;
  if (slid_over_edge > longest_without_slip(friction)) return TurningKind::slips;
  return TurningKind::turns;
}

SecondImpact second_impact(const TurningBlock& block, const BlockState& state) {
  const Point p = scaled(block, state);
  const double from_front = p.angle - std::numbers::pi / 2;
  const Vec2 middle = p.velocity - p.rate * turn(to_centre(p.angle));
  const Vec2 front = middle + p.rate * turn(to_centre(from_front));
  Impulse impulse = plastic_impact(front, from_front, block.friction);
  SecondImpact out{p.rate + impulse.turning, impulse.velocity, impulse.p};
  if (out.rate < 0 && p.angle <= flat + rounding) {  // the first corner keeps the face from tilting
    const double up = -middle.y();
    const double along = std::min(std::abs(middle.x()), block.friction * up);
    out = {0, Vec2(middle.x() - std::copysign(along, middle.x()), 0),
           Vec2(-std::copysign(along, middle.x()), up)};
  }
  out.rate /= unit_time(block);
  out.velocity *= unit_speed(block);
  out.impulse *= block.mass * unit_speed(block);
  return out;
}

}  // namespace osculate::verification
