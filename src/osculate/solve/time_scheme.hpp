#pragma once

namespace osculate::solve {

/// How contact forces enter the step of time.
///
/// average      as all other forces: second order in time where the step resolves the stiffness of
///              the contact, and free of numerical dissipation with Newmark's scheme
/// dissipative  by their value at the end of the step, with half the impulse's way: energy does not
///              grow, whatever the step, where the bodies are linear and the contact's potential is
///              convex (Kane1999); a body that hits bounces
/// plastic      the same with the whole impulse's way: what has hit stays, as after a plastic
///              impact (backward Euler for the contact alone)
enum class Impact { average, dissipative, plastic };

/// A member of the generalised-alpha family.
///
/// Formula    (1 - alpha_m) M a_n+1 + alpha_m M a_n + (1 - alpha_f) F_n+1 + alpha_f F_n = 0 ,
///            u_n+1 = u_n + h v_n + h^2 ((1/2 - beta) a_n + beta a_n+1) + theta h^2 b ,
///            v_n+1 = v_n + h ((1 - gamma) a_n + gamma a_n+1) + h b ,
///            F all forces but inertia, on the side of the internal forces; impact average: with
///            contact, b = 0; otherwise without it, M b = -contact at n+1,
///            theta = 1/2 (dissipative) or 1 (plastic)
/// Source     ChungHulbert1993; b: Kane1999
/// Tested by  tests/unit/solve/test_time_scheme.cpp
struct TimeScheme {
  double alpha_m = 0, alpha_f = 0, beta = 0.25, gamma = 0.5;
  Impact impact = Impact::dissipative;
};

/// Newmark's average acceleration.
[[nodiscard]] constexpr TimeScheme newmark() { return {}; }

/// Formula    gamma = 1/2 + alpha, beta = (1 + alpha)^2 / 4 , 0 <= alpha <= 1/3
/// Source     Hilber1977
[[nodiscard]] constexpr TimeScheme hht(double alpha) {
  return {0, alpha, 0.25 * (1 + alpha) * (1 + alpha), 0.5 + alpha};
}

/// Formula    alpha_m = (2 r - 1) / (r + 1), alpha_f = r / (r + 1), gamma = 1/2 - alpha_m +
///            alpha_f, beta = (1 - alpha_m + alpha_f)^2 / 4 , r the spectral radius for infinitely
///            high frequencies, 0 (most dissipation) to 1 (none)
/// Source     ChungHulbert1993
[[nodiscard]] constexpr TimeScheme generalized_alpha(double r) {
  const double m = (2 * r - 1) / (r + 1), f = r / (r + 1);
  return {m, f, 0.25 * (1 - m + f) * (1 - m + f), 0.5 - m + f};
}

/// What multiplies the terms of one step's residual, scaled such that contact forces keep the
/// factor 1.
///
/// Formula    R = mass M (u - u*) + past_mass M a_n + force F_n+1 + past_force F_n (+ contact) ,
///            u* = u_n + h v_n + h^2 (1/2 - beta) a_n ;
///            rate: dv/du of v = v_n + h (1 - gamma) a_n + rate (u - u*)
struct StepFactors {
  double mass = 0, past_mass = 0, force = 1, past_force = 0, rate = 0;
  /// Of (1 - alpha_m) x_n+1 + alpha_m x_n, where x_n+1 is the rate of a momentum as Newmark's
  /// formulas without b give it from the displacement.
  double balance = 1;
};

[[nodiscard]] constexpr double impulse_way(Impact impact) {
  return impact == Impact::plastic ? 1.0 : 0.5;
}

/// Requires   h > 0
[[nodiscard]] constexpr StepFactors step_factors(const TimeScheme& s, double h) {
  StepFactors f;
  f.rate = s.gamma / (s.beta * h);
  if (s.impact == Impact::average) {
    const double scale = 1 / (1 - s.alpha_f);
    f.mass = scale * (1 - s.alpha_m) / (s.beta * h * h);
    f.past_mass = scale * s.alpha_m;
    f.past_force = scale * s.alpha_f;
    f.balance = scale;
    return f;
  }
  const double theta = impulse_way(s.impact), scale = s.beta / (theta * (1 - s.alpha_m));
  f.mass = 1 / (theta * h * h);
  f.past_mass = scale * s.alpha_m;
  f.force = scale * (1 - s.alpha_f);
  f.past_force = scale * s.alpha_f;
  f.balance = scale;
  return f;
}

}  // namespace osculate::solve
