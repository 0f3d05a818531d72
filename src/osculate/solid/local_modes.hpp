#pragma once
#include <Eigen/LU>
#include <limits>

namespace osculate::solid {

/// Finds the parameters of enhanced strains at which their generalised stresses vanish: Newton's
/// method inside one cell, halved where the law has no answer.
///
/// Formula    alpha <- alpha - stiffness^-1 rest(alpha), until rest is rounding of `scale`. With
///            `kinks`, where points begin and cease to flow within a step, a step that overshoots
///            is shortened by secants until  step . rest  is a tenth of what it was: the stored and
///            dissipated energy of an increment is convex in alpha at small strain
/// Requires   `modes` has alpha (as many zeros as modes), stiffness and ok; sample(modes, rest,
///            scale) fills the stiffness, the generalised stresses and their size at modes.alpha,
///            false where the law has no answer
/// Returns    modes.ok: found
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_memory.cpp
template <class Vector, class Modes, class Sample>
void solve_modes(Modes& modes, bool kinks, const Sample& sample) {
  Vector rest, step = modes.alpha, start = modes.alpha;
  double scale = 0, before = std::numeric_limits<double>::infinity();
  double slope = 0;                                         // step . rest at the start of the step
  double low = 0, low_slope = 0, high = 0, high_slope = 0;  // a bracket along it; high 0: none
  const int most = kinks ? 200 : 40;
  for (int it = 0; it < most; ++it) {
    // Rounding level: small enough, or nearly so and not getting smaller any more.
    constexpr double rounding = 1e-15, nearly = 1e-12, enough = 0.1;
    modes.ok = sample(modes, rest, scale);
    const double size = rest.template lpNorm<Eigen::Infinity>();
    if (modes.ok && (size <= rounding * scale || (size <= nearly * scale && size >= 0.5 * before)))
      return;
    const double here = step.dot(rest);
    const bool beyond = here > -enough * slope, short_of = high > 0 && here < enough * slope;
    if (modes.ok && kinks && slope < 0 && (beyond || short_of)) {
      const double at = high > 0 ? low + (high - low) * low_slope / (low_slope - high_slope) : 1;
      (beyond ? high : low) = at;
      (beyond ? high_slope : low_slope) = here;
      modes.alpha = start + (low + (high - low) * low_slope / (low_slope - high_slope)) * step;
    } else if (modes.ok) {
      before = size;
      start = modes.alpha;
      step = -modes.stiffness.partialPivLu().solve(rest);
      modes.alpha += step;
      low = high = 0;
      slope = low_slope = step.dot(rest);
    } else {  // too far: half of the way back to where the law had an answer
      if (it == 0) return;
      step *= 0.5;
      modes.alpha -= step;
    }
  }
  modes.ok = false;
}

}  // namespace osculate::solid
