#pragma once
// A block that slides over a horizontal plane until Coulomb's friction has stopped it.
#include <algorithm>

namespace osculate::verification {

struct StoppedBlock {
  double mass = 1;
  double speed = 1;  ///< at the start
  double friction = 0.3;
  double gravity = 9.81;
};

/// v / (mu g)
inline double stop_time(const StoppedBlock& b) { return b.speed / (b.friction * b.gravity); }
/// v^2 / (2 mu g)
inline double stop_distance(const StoppedBlock& b) {
  return 0.5 * b.speed * b.speed / (b.friction * b.gravity);
}

struct SlideState {
  double way = 0, speed = 0;
};

inline SlideState slide_at(const StoppedBlock& b, double time) {
  const double t = std::min(time, stop_time(b)), brake = b.friction * b.gravity;
  return {t * (b.speed - 0.5 * brake * t), b.speed - brake * t};
}

/// mu m g against the motion; none once it rests.
inline double friction_force(const StoppedBlock& b, double time) {
  return time < stop_time(b) ? b.friction * b.mass * b.gravity : 0;
}

/// mu m g times the way; in the end the whole m v^2 / 2.
inline double dissipated(const StoppedBlock& b, double time) {
  return b.friction * b.mass * b.gravity * slide_at(b, time).way;
}

}  // namespace osculate::verification
