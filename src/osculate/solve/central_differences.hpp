#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <string>

namespace osculate::solve {

/// How an integration by central differences chooses its time steps.
struct CentralDifferences {
  double safety = 0.9;  ///< share of the stable step that is taken
  double step = 0;      ///< the longest step that is taken; 0: no limit beside the stable one
};

/// A motion over all dofs of a system, those that do not move by themselves included.
struct ExplicitMotion {
  Eigen::VectorXd position, velocity, acceleration;
};

/// What central differences ask of a system. `follow` sets the velocities within a time step of
/// what does not move by itself (way of the step / h); `accelerate` evaluates the forces at the new
/// positions, velocities being those within the step, and sets the accelerations (zero where
/// something follows); false: it cannot, and says why in `fault`.
template <class S>
concept ExplicitSystem = requires(S s, ExplicitMotion& m, double time, double h) {
  { s.stable_step(m) } -> std::convertible_to<double>;
  { s.faithful_step() } -> std::convertible_to<double>;  // what the energy asks for, beside it
  {s.follow(time, h, m)};
  { s.accelerate(time, h, m) } -> std::convertible_to<bool>;
  { s.grows(m) } -> std::convertible_to<bool>;  // energy that nothing has put in
  { s.fault() } -> std::convertible_to<std::string>;
};

/// The time steps of an interval.
struct TimeSteps {
  int count = 0;
  double longest = 0;    ///< time step
  double stable = 0;     ///< smallest estimate of the longest stable step
  std::string governed;  ///< by what
};

enum class TimeStepping { done, failed, unstable, too_many };

/// One time step, which ends at `time`.
///
/// Formula    v_n+1/2 = v_n + h/2 a_n ,  u_n+1 = u_n + h v_n+1/2 ,  M a_n+1 = f(u_n+1) ,
///            v_n+1 = v_n+1/2 + h/2 a_n+1 : central differences with v_n the mean of its halves
/// Source     Belytschko2014, section 6.2 (the leapfrog form of Newmark's beta = 0, gamma = 1/2)
/// Conserves  momentum; of a linear system without loads v_n-1/2 . M v_n+1/2 / 2 + u . K u / 2
/// Requires   h > 0; stable up to h = 2 / omega_max
/// Tested by  tests/unit/solve/test_central_differences.cpp
template <ExplicitSystem S>
[[nodiscard]] bool time_step(S& system, ExplicitMotion& m, double time, double h) {
  m.velocity += (0.5 * h) * m.acceleration;
  system.follow(time, h, m);
  m.position += h * m.velocity;
  if (!system.accelerate(time, h, m)) return false;
  m.velocity += (0.5 * h) * m.acceleration;
  return true;
}

/// Time steps from `from` to `to`, all of the same length until the stable step is looked at again,
/// which is done after `inspect` of them. `taken` is added to.
///
/// Tested by  tests/unit/solve/test_central_differences.cpp
template <ExplicitSystem S>
[[nodiscard]] TimeStepping advance(S& system, ExplicitMotion& m, double from, double to,
                                   const CentralDifferences& options, TimeSteps& taken,
                                   int inspect = 50) {
  constexpr double most = 1e8, sliver = 1e-9;
  double time = from;
  while (time < to) {
    const double stable = system.stable_step(m);
    taken.stable = taken.count == 0 ? stable : std::min(taken.stable, stable);
    double limit = std::min(options.safety * stable, static_cast<double>(system.faithful_step()));
    if (options.step > 0) limit = std::min(limit, options.step);
    const double wanted = std::ceil((to - time) / limit * (1 - sliver));
    if (!(limit > 0) || wanted > most) return TimeStepping::too_many;
    const int left = std::max(1, static_cast<int>(wanted));
    const double h = (to - time) / left;
    const int now = std::min(left, inspect);
    for (int k = 1; k <= now; ++k) {
      const double end = k == left ? to : time + k * h;
      if (!time_step(system, m, end, h)) return TimeStepping::failed;
      ++taken.count;
    }
    taken.longest = std::max(taken.longest, h);
    if (system.grows(m)) return TimeStepping::unstable;
    time = now == left ? to : time + now * h;
  }
  return TimeStepping::done;
}

}  // namespace osculate::solve
