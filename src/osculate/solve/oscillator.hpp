#pragma once
#include <cmath>

namespace osculate::solve {

/// An oscillator. k < 0 is one that runs away.
///
/// Formula    q'' + c q' + k q = f ; c = 2 zeta omega >= 0 , k = omega^2
struct Oscillator {
  double c = 0, k = 0;
};

/// Where an oscillator is, and how fast.
struct OscillatorMotion {
  double place = 0, rate = 0;
};

/// What a unit impulse has made of an oscillator at rest after a time h, and the integrals of it.
///
/// Formula    g'' + c g' + k g = 0 , g(0) = 0 , g'(0) = 1 ;
///            rate g'(h), place g(h), once int_0^h g , twice int_0^h int_0^t g
struct ImpulseResponse {
  double rate = 1, place = 0, once = 0, twice = 0;
};

namespace detail {

/// By powers of h: for c h and |k| h^2 up to 1/2, where the terms fall as 1/n!.
inline ImpulseResponse response_by_series(Oscillator o, double h) {
  constexpr int terms = 22;
  ImpulseResponse g{0, 0, 0, 0};
  double before = 0, now = 1, factorial = 1;  // b_n, b_n+1 ; g^(n)(0) = b_n h^(1-n) ; n!
  for (int n = 0; n < terms; ++n) {
    g.rate += now / factorial;
    g.place += h * before / factorial;
    g.once += h * h * before / (factorial * (n + 1));
    g.twice += h * h * h * before / (factorial * (n + 1) * (n + 2));
    const double next = -o.c * h * now - o.k * h * h * before;
    before = now;
    now = next;
    factorial *= n + 1;
  }
  return g;
}

/// int_0^h exp(-r t) dt, and the integral of that.
inline double decay_once(double r, double h) { return r == 0 ? h : -std::expm1(-r * h) / r; }
inline double decay_twice(double r, double h) {
  const double x = r * h;
  constexpr double small = 1e-2;
  if (std::abs(x) > small) return (h - decay_once(r, h)) / r;
  return h * h * (1.0 / 2 - x * (1.0 / 6 - x * (1.0 / 24 - x * (1.0 / 120 - x / 720))));
}

/// Of two decays exp(-r t) that differ: overdamped, without stiffness, or one that runs away.
inline ImpulseResponse response_by_decays(Oscillator o, double h) {
  const double half = 0.5 * o.c;
  const double fast = half + std::sqrt(half * half - o.k), slow = o.k / fast;
  const double apart = fast - slow, e_fast = std::exp(-fast * h), e_slow = std::exp(-slow * h);
  return {(fast * e_fast - slow * e_slow) / apart, (e_slow - e_fast) / apart,
          (decay_once(slow, h) - decay_once(fast, h)) / apart,
          (decay_twice(slow, h) - decay_twice(fast, h)) / apart};
}

/// Of one that swings, or nearly does.
inline ImpulseResponse response_by_swings(Oscillator o, double h) {
  const double half = 0.5 * o.c, squared = o.k - half * half;
  const double w = std::sqrt(std::abs(squared)), x = w * h, decay = std::exp(-half * h);
  double sine = decay * h, cosine = decay;  // both times the decay, the first over w
  if (squared > 0) {
    cosine = decay * std::cos(x);
    sine = decay * std::sin(x) / w;
  } else if (squared < 0) {
    const double slow = std::exp((w - half) * h), fast = std::exp(-(w + half) * h);
    cosine = 0.5 * (slow + fast);
    sine = x < 1 ? decay * std::sinh(x) / w : 0.5 * (slow - fast) / w;
  }
  ImpulseResponse g{cosine - half * sine, sine, 0, 0};
  g.once = (1 - g.rate - o.c * g.place) / o.k;
  g.twice = (h - g.place - o.c * g.once) / o.k;
  return g;
}

}  // namespace detail

/// Exact for every c >= 0, k and h > 0: swinging, creeping, without stiffness.
///
/// Tested by  tests/unit/solve/test_oscillator.cpp
[[nodiscard]] inline ImpulseResponse impulse_response(Oscillator o, double h) {
  constexpr double few = 0.5, distinct = 1.1;
  if (o.c * h <= few && std::abs(o.k) * h * h <= few) return detail::response_by_series(o, h);
  if (0.25 * o.c * o.c > distinct * o.k) return detail::response_by_decays(o, h);
  return detail::response_by_swings(o, h);
}

/// The motion after h, during which the force goes straight from `from` to `to`: exact.
///
/// Formula    q(h) = (g' + c g) q + g q' + once f + twice (f_h - f) / h ,
///            q'(h) = -k g q + g' q' + g f + once (f_h - f) / h
/// Source     Nigam & Jennings 1969, Duhamel's integral of a force of straight pieces
/// Requires   g the response of the oscillator after h
[[nodiscard]] inline OscillatorMotion moved(Oscillator o, const ImpulseResponse& g, double h,
                                            OscillatorMotion q, double from, double to) {
  const double slope = (to - from) / h;
  return {(g.rate + o.c * g.place) * q.place + g.place * q.rate + g.once * from + g.twice * slope,
          g.rate * q.rate - o.k * g.place * q.place + g.place * from + g.once * slope};
}

}  // namespace osculate::solve
