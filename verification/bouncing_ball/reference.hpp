#pragma once
// A ball that falls on a floor, rigid with a coefficient of restitution, or on the linear spring
// that a penalty is.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace osculate::verification {

/// Height above the floor (negative: penetration), upwards.
struct BallState {
  double height = 0;
  double velocity = 0;
};

/// A rigid ball let go at rest. Requires 0 <= restitution <= 1.
struct RigidBall {
  double height = 1;
  double gravity = 9.81;
  double restitution = 1;
};

/// Of bounce n = 1, 2, ...
/// Formula    t_1 = sqrt(2 h / g), t_n = t_1 (1 + 2 e (1 - e^(n-1)) / (1 - e))
inline double bounce_time(const RigidBall& ball, int n) {
  const double first = std::sqrt(2 * ball.height / ball.gravity), e = ball.restitution;
  if (e == 1) return (2 * n - 1) * first;
  return first * (1 + 2 * e * (1 - std::pow(e, n - 1)) / (1 - e));
}

/// After bounce n: e^n sqrt(2 g h).
inline double bounce_speed(const RigidBall& ball, int n) {
  return std::pow(ball.restitution, n) * std::sqrt(2 * ball.gravity * ball.height);
}

/// Between bounces n and n + 1: e^(2 n) h.
inline double bounce_height(const RigidBall& ball, int n) {
  return std::pow(ball.restitution, 2 * n) * ball.height;
}

/// When the bounces, infinitely many, are over: t_1 (1 + e) / (1 - e).
inline double rest_time(const RigidBall& ball) {
  const double e = ball.restitution;
  if (e == 1) return std::numeric_limits<double>::infinity();
  return std::sqrt(2 * ball.height / ball.gravity) * (1 + e) / (1 - e);
}

/// At a bounce, that after it.
inline BallState ball_at(const RigidBall& ball, double time) {
  if (time >= rest_time(ball)) return {};
  const double g = ball.gravity;
  if (time < bounce_time(ball, 1)) return {ball.height - 0.5 * g * time * time, -g * time};
  int n = 1;
  while (bounce_time(ball, n + 1) <= time) ++n;
  const double since = time - bounce_time(ball, n), up = bounce_speed(ball, n);
  return {since * (up - 0.5 * g * since), up - g * since};
}

/// A ball let go at rest above a spring that only pushes: m x'' = -m g + k max(0, -x).
struct SpringBall {
  double height = 1;
  double gravity = 9.81;
  double mass = 1;
  double stiffness = 1e4;  ///< k: the penalty times what it is multiplied with
};

/// Static depth d = m g / k, angular frequency p = sqrt(k / m), amplitude A = sqrt(d^2 + v^2 / p^2)
/// about the static depth, phase psi = atan2(v / p, d), v = sqrt(2 g h).
struct SpringContact {
  double depth = 0, frequency = 0, amplitude = 0, phase = 0;
};

inline SpringContact spring_contact(const SpringBall& ball) {
  const double p = std::sqrt(ball.stiffness / ball.mass);
  const double d = ball.mass * ball.gravity / ball.stiffness;
  const double swing = std::sqrt(2 * ball.gravity * ball.height) / p;
  return {d, p, std::hypot(d, swing), std::atan2(swing, d)};
}

/// 2 (pi - psi) / p: longer than half a period of the spring, and that for a stiff spring.
inline double contact_duration(const SpringBall& ball) {
  const SpringContact c = spring_contact(ball);
  return 2 * (std::numbers::pi - c.phase) / c.frequency;
}

/// d + A
inline double deepest(const SpringBall& ball) {
  const SpringContact c = spring_contact(ball);
  return c.depth + c.amplitude;
}

/// From one highest point to the next.
inline double bounce_period(const SpringBall& ball) {
  return 2 * std::sqrt(2 * ball.height / ball.gravity) + contact_duration(ball);
}

/// Formula    in contact the penetration is d - A cos(p t + psi), t from the touch; free flight
/// else
inline BallState ball_at(const SpringBall& ball, double time) {
  const double g = ball.gravity, fall = std::sqrt(2 * ball.height / g);
  const double t = std::fmod(time, bounce_period(ball)), contact = contact_duration(ball);
  if (t < fall) return {ball.height - 0.5 * g * t * t, -g * t};
  const double since = t - fall;
  if (since >= contact) {
    const double up = since - contact;
    return {up * (g * fall - 0.5 * g * up), g * fall - g * up};
  }
  const SpringContact c = spring_contact(ball);
  const double angle = c.frequency * since + c.phase;
  return {-c.depth + c.amplitude * std::cos(angle), -c.amplitude * c.frequency * std::sin(angle)};
}

/// Of the spring on the ball.
inline double spring_force(const SpringBall& ball, double time) {
  return ball.stiffness * std::max(0.0, -ball_at(ball, time).height);
}

}  // namespace osculate::verification
