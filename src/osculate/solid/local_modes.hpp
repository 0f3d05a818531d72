#pragma once
#include <Eigen/LU>
#include <limits>

namespace osculate::solid {

/// Finds the parameters of enhanced strains at which their generalised stresses vanish: Newton's
/// method inside one cell, halved where the law has no answer.
///
/// Formula    alpha <- alpha - stiffness^-1 rest(alpha), until rest is rounding of `scale`
/// Requires   `modes` has alpha (as many zeros as modes), stiffness and ok; sample(modes, rest,
///            scale) fills the stiffness, the generalised stresses and their size at modes.alpha,
///            false where the law has no answer
/// Returns    modes.ok: found
/// Tested by  tests/unit/solid/test_derivatives.cpp
template <class Vector, class Modes, class Sample>
void solve_modes(Modes& modes, const Sample& sample) {
  Vector rest, step = modes.alpha;
  double scale = 0, before = std::numeric_limits<double>::infinity();
  constexpr int most = 40;
  for (int it = 0; it < most; ++it) {
    // Rounding level: small enough, or nearly so and not getting smaller any more.
    constexpr double rounding = 1e-15, nearly = 1e-12;
    modes.ok = sample(modes, rest, scale);
    const double size = rest.template lpNorm<Eigen::Infinity>();
    if (modes.ok && (size <= rounding * scale || (size <= nearly * scale && size >= 0.5 * before)))
      return;
    if (modes.ok) {
      before = size;
      step = -modes.stiffness.partialPivLu().solve(rest);
      modes.alpha += step;
    } else {  // too far: half of the way back to where the law had an answer
      if (it == 0) return;
      step *= 0.5;
      modes.alpha -= step;
    }
  }
  modes.ok = false;
}

}  // namespace osculate::solid
