#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "osculate/contact/law/penalty_param.hpp"
#include "osculate/contact/law/tangential.hpp"

namespace osculate::contact {

/// Friction that depends on the sliding speed and on how long the contact has rested or slid: the
/// law of faults and of dry rubbing surfaces, with the aging of the state and a speed that may
/// vanish.
///
/// Formula    mu = a asinh(V / (2 V_0) exp((mu_0 + b ln(V_0 theta / D)) / a)) ,
///            d(theta)/dt = 1 - V theta / D ;
///            at the end of the increment of duration h, with the distance s slid in it:
///            V = s / h ,  theta = (theta_n + h) / (1 + s / D)              (backward Euler)
///            mu(s) p + eps_T s = |t_tr| ,  t = mu(s) p t_tr / |t_tr|
/// Source     A. L. Ruina, J. Geophys. Res. 88 (1983) 10359 (state); J. H. Dieterich, J. Geophys.
///            Res. 84 (1979) 2161 (aging); J. R. Rice, N. Lapusta, K. Ranjith, J. Mech. Phys.
///            Solids 49 (2001) 1865 (regularisation by asinh)
/// Returns    where the equation for s has several roots (eps_T <= b p / D: the spring of the
///            penalty is softer than friction falls) one of them. Sliding never ends quite; where
///            eps_T s is round-off of the trial the point sticks
/// Units      mu_0, a, b: 1; V_0: length/time; D: length; theta: time
/// Tested by  tests/unit/contact/test_rate_and_state.cpp, verification/rate_and_state
struct RateAndState {
  static constexpr std::string_view key = "rate_and_state", words = "rate and state {mu}",
                                    doc =
                                        "Friction by sliding speed and by the age of the contact.";
  double mu = 0.6, a = 0.01, b = 0;
  double stiffness = 0;  ///< eps_T
  double speed = 1, distance = 1;
  std::optional<double> state{};

  static constexpr auto params();

  /// theta of a point that has just touched, or of the last increment.
  [[nodiscard]] double state_before(const Sliding& sliding) const {
    return sliding.memory[0] > 0 ? sliding.memory[0] : state.value_or(distance / speed);
  }
  [[nodiscard]] LawMemory remembered(double slid, const Sliding& sliding) const {
    return {(state_before(sliding) + sliding.duration) / (1 + slid / distance)};
  }
  /// Steepest fall of the limit while a point slides, max |dL/ds| from below: that of the state.
  [[nodiscard]] double fall(double pressure, double) const { return b * pressure / distance; }

  /// Coefficient of friction and its derivative by ln s, at z = ln s.
  struct Coefficient {
    double value = 0, slope = 0;
  };
  [[nodiscard]] Coefficient coefficient(double z, const Sliding& sliding) const {
    const double slid = std::exp(z), h = sliding.duration;
    const double log_state = std::log((state_before(sliding) + h) / (1 + slid / distance));
    const double w =
        z - std::log(2 * speed * h) + (mu + b * (std::log(speed / distance) + log_state)) / a;
    const double inverse = std::exp(-2 * std::max(w, -300.0));  // of the square of asinh's argument
    const double part = 1 / std::sqrt(1 + inverse);
    const double value = w > 0 ? w + std::log1p(std::sqrt(1 + inverse)) : std::asinh(std::exp(w));
    return {a * value, part * (a - b * slid / (distance + slid))};
  }

  /// The limit of a point with this trial, which it has reached whatever the trial.
  [[nodiscard]] SlipLimit limit(double trial, double pressure, const Sliding& sliding) const {
    if (!(pressure > 0)) return {};
    if (!(sliding.duration > 0)) return {mu * pressure, 0, mu};
    const auto [z, c] = solved(trial, pressure, sliding);
    const double spring = stiffness * std::exp(z), all = pressure * c.slope + spring;
    return {c.value * pressure, pressure * c.slope / all, c.value * spring / all};
  }
  /// Before the first iteration nothing has slid: a sliding point goes on as it did.
  [[nodiscard]] SlipLimit predicted_limit(double trial, double pressure, const Sliding&) const {
    return pressure > 0 ? SlipLimit{trial, 0, trial / pressure} : SlipLimit{};
  }
  template <int Dim>
  [[nodiscard]] TangentialResponse<Dim> response(const Vec<Dim - 1>& trial, double normal_traction,
                                                 const Sliding& sliding = {}) const {
    constexpr double rounding = 1e-15;
    const double pressure = pressure_of(normal_traction), size = length_of<Dim>(trial);
    if (!(size > 0)) return stick_response<Dim>(trial);
    SlipLimit most = limit(size, pressure, sliding);
    if (size - most.value <= rounding * size) return stick_response<Dim>(trial);
    if (normal_traction > 0) most.d_pressure = 0;  // pulled harder: still no pressure
    return slip_response<Dim>(trial / size, size, most);
  }

 private:
  struct Root {
    double z = 0;
    Coefficient c;
  };
  /// The root z = ln s of mu(z) p + eps_T e^z = |t_tr|, by Newton's method between bounds.
  [[nodiscard]] Root solved(double trial, double pressure, const Sliding& sliding) const {
    constexpr int most = 100;
    constexpr double rounding = 1e-15;
    double high = std::log(trial / stiffness), low = high - 1;
    const auto excess = [&](double z, const Coefficient& c) {
      return c.value * pressure + stiffness * std::exp(z) - trial;
    };
    while (excess(low, coefficient(low, sliding)) > 0) low = high - 2 * (high - low);
    Root r{0.5 * (low + high), {}};
    for (int i = 0; i < most; ++i) {
      r.c = coefficient(r.z, sliding);
      const double error = excess(r.z, r.c);
      if (!(std::abs(error) > rounding * trial)) break;
      (error > 0 ? high : low) = r.z;
      const double slope = r.c.slope * pressure + stiffness * std::exp(r.z);
      const double next = r.z - error / slope;
      const double before = r.z;
      r.z = slope > 0 && next > low && next < high ? next : 0.5 * (low + high);
      if (r.z == before) break;
    }
    r.c = coefficient(r.z, sliding);
    return r;
  }
};

constexpr auto RateAndState::params() {
  using T = RateAndState;
  return std::array<core::Param<T>, 7>{
      {{.key = "mu",
        .unit = "1",
        .doc = "Coefficient of friction of steady sliding at `speed`.",
        .slot = &T::mu,
        .range = {.lower = 0},
        .example = "0.6"},
       {.key = "a",
        .unit = "1",
        .doc = "What e times the speed adds at once.",
        .slot = &T::a,
        .range = {.lower = 0},
        .example = "0.01"},
       {.key = "b",
        .unit = "1",
        .doc = "What an e times older contact adds.",
        .slot = &T::b,
        .range = {.lower = 0, .with_lower = true},
        .example = "0.015"},
       shear_penalty_param<T>(),
       {.key = "speed",
        .unit = "length/time",
        .doc = "Speed that mu belongs to; every step needs a duration.",
        .slot = &T::speed,
        .range = {.lower = 0},
        .example = "0.1",
        .timed = true},
       {.key = "distance",
        .unit = "length",
        .doc = "Distance over which sliding renews the contact.",
        .slot = &T::distance,
        .range = {.lower = 0},
        .example = "0.01"},
       {.key = "state",
        .unit = "time",
        .doc = "Age of a contact that has just begun.",
        .slot = &T::state,
        .range = {.lower = 0},
        .required = false,
        .example = "0.1",
        .otherwise = "distance / speed"}}};
}

}  // namespace osculate::contact
