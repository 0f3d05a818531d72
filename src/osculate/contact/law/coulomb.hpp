#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "osculate/contact/law/penalty_param.hpp"
#include "osculate/contact/law/tangential.hpp"

namespace osculate::contact {

/// Coulomb friction by return mapping from an elastic predictor, with an optional change from the
/// static coefficient to a kinetic one, an optional cap of the shear traction and an optional film
/// beside it.
///
/// Formula    t = t_tr            if |t_tr| <= L_0                        (stick)
///            t = L t_tr / |t_tr| otherwise                               (slip)
///            L = min(mu(a) p, cap) + c V , a and the speed V taken at the end of the increment:
///            they depend on L by the distance slid, (|t_tr| - L) / eps_T; L_0 is L without sliding
///            in the increment; c V as in viscous_friction.hpp, none while the point sticks;
///            p = |N| under pressure, 0 where a held point is pulled
///            mu(a) = mu_k + (mu - mu_k) exp(-a / scale) ,
///            a = distance slid since the point came into contact, or
///            a = speed = distance slid in the increment / duration of the increment
/// Source     KS2D:76, KS2D:57 in physical components (T_i = t . rho_,i), signs of docs/errata.md;
///            mu(a) by speed: J. T. Oden, J. A. C. Martins, Comput. Methods Appl. Mech. Engrg. 52
///            (1985) 527-634, section 2, in the usual exponential form; by distance: the same with
///            what slip-weakening models of faults take for a (Y. Ida, J. Geophys. Res. 77 (1972)
///            3796)
/// Sign       the force on the slave's residual is +t for a slip in the direction +t
/// Tested by  tests/unit/contact/test_laws.cpp, test_friction_laws.cpp
struct Coulomb {
  static constexpr std::string_view
      key = "coulomb",
      words = "Coulomb {mu}[ to {kinetic}][ up to {cap}][ and viscous {viscous}]",
      doc = "Coulomb's law with an elastic stick range.";
  static constexpr core::OneOf decay{
      "decay",
      "How the coefficient goes from mu to kinetic: mu(a) = kinetic + (mu - kinetic) exp(-a / "
      "scale).",
      "{distance: 0.01}"};
  double mu = 0;
  double stiffness = 0;  ///< eps_T, units as eps_N
  double cap = std::numeric_limits<double>::infinity();
  std::optional<double> kinetic{};  ///< mu_k; above mu: friction grows
  /// The scale of a: one of them where there is a kinetic coefficient.
  std::optional<double> distance{}, speed{};
  std::optional<double> viscous{};  ///< c of the film

  static constexpr auto params();
  [[nodiscard]] std::optional<core::Fault> fault() const {
    const bool changes = distance || speed;
    if (kinetic && !changes)
      return core::Fault{
          "how the coefficient changes is missing: add decay: {distance: ...} or "
          "{speed: ...}",
          "kinetic"};
    if (changes && !kinetic)
      return core::Fault{"decay goes with a kinetic coefficient, which is missing", "decay"};
    if (distance && speed) return core::Fault{"distance and speed exclude each other", "decay"};
    return std::nullopt;
  }
  /// Steepest fall of the limit while a point slides: max |dL/ds|; less than zero where it grows.
  ///
  /// Formula    (mu - mu_k) p / scale, by speed / (scale duration)
  [[nodiscard]] double fall(double pressure, double duration) const {
    if (!kinetic || (speed && !(duration > 0))) return 0;
    return (mu - *kinetic) * pressure / (speed ? *speed * duration : scale());
  }

  [[nodiscard]] double coefficient(double a) const {
    if (!kinetic) return mu;
    return *kinetic + (mu - *kinetic) * std::exp(-a / scale());
  }

  /// The limit at which a point that has not slid in the increment begins to.
  [[nodiscard]] SlipLimit first_limit(double pressure, const Sliding& sliding) const {
    const double now = coefficient(argument(0, sliding));
    return capped({now * pressure, 0, now});  // @eq KS2D:77
  }

  /// The limit of a point whose trial is beyond the first limit.
  [[nodiscard]] SlipLimit limit(double trial, double pressure, const Sliding& sliding) const {
    const double film = film_rate(sliding);
    const SlipLimit dry = first_limit(pressure, sliding);
    if (!kinetic || rate(sliding) == 0.0) return beside_film(dry, trial, film);
    const double value = solved(trial, pressure, sliding);
    const double a = argument(trial - value, sliding);
    if (coefficient(a) * pressure > cap) return beside_film({cap, 0, 0}, trial, film);
    const double growth = slope(a) * rate(sliding) * pressure + film;  // kappa
    return {value, growth / (1 + growth), coefficient(a) / (1 + growth)};
  }

  /// Before the first iteration nothing has slid: at which limit a sliding point will go on.
  [[nodiscard]] SlipLimit predicted_limit(double trial, double pressure,
                                          const Sliding& sliding) const {
    SlipLimit dry = predicted_dry(trial, pressure, sliding);
    if (film_rate(sliding) > 0) dry.value = std::max(dry.value, trial);  // as fast as before
    return dry;
  }

  template <int Dim>
  [[nodiscard]] TangentialResponse<Dim> response(const Vec<Dim - 1>& trial, double normal_traction,
                                                 const Sliding& sliding = {}) const {
    const double pressure = pressure_of(normal_traction);
    const double size = length_of<Dim>(trial);
    if (size <= first_limit(pressure, sliding).value) return stick_response<Dim>(trial);
    SlipLimit most = limit(size, pressure, sliding);
    if (normal_traction > 0) most.d_pressure = 0;  // pulled harder: still no pressure
    return slip_response<Dim>(trial / size, size, most);
  }

 private:
  [[nodiscard]] SlipLimit predicted_dry(double trial, double pressure,
                                        const Sliding& sliding) const {
    if (!kinetic || !speed || !(pressure > 0)) return first_limit(pressure, sliding);
    const double low = std::min(mu, *kinetic), high = std::max(mu, *kinetic);
    const double last = std::clamp(trial / pressure, low, high);  // of the last increment
    return capped({last * pressure, 0, last});
  }
  [[nodiscard]] double scale() const { return speed ? *speed : distance.value_or(1); }
  [[nodiscard]] SlipLimit capped(const SlipLimit& limit) const {
    return limit.value > cap ? SlipLimit{cap, 0, 0} : limit;
  }
  /// c / (eps_T h): c V is so many times the excess of the trial.
  [[nodiscard]] double film_rate(const Sliding& sliding) const {
    return sliding.duration > 0 ? viscous.value_or(0) / (stiffness * sliding.duration) : 0.0;
  }
  /// The limit of a constant dry friction with the film.
  [[nodiscard]] static SlipLimit beside_film(const SlipLimit& dry, double trial, double film) {
    return {(dry.value + film * trial) / (1 + film), film / (1 + film),
            dry.d_pressure / (1 + film)};
  }
  /// d(a) / d(distance in the increment) / eps_T
  [[nodiscard]] double rate(const Sliding& sliding) const {
    if (!speed) return 1 / stiffness;
    return sliding.duration > 0 ? 1 / (stiffness * sliding.duration) : 0.0;
  }
  /// a after sliding by `excess` / eps_T.
  [[nodiscard]] double argument(double excess, const Sliding& sliding) const {
    if (!kinetic) return 0;
    const double before = speed ? 0.0 : sliding.distance;
    return before + std::max(0.0, excess) * rate(sliding);
  }
  /// d(mu) / d(a)
  [[nodiscard]] double slope(double a) const {
    return (*kinetic - mu) / scale() * std::exp(-a / scale());
  }
  /// The one root of L = mu(a(L)) p + c V(L) below the trial. Friction that falls: the function is
  /// concave and the tangents' roots rise to it from the least limit; that grows: convex, from
  /// above.
  [[nodiscard]] double solved(double trial, double pressure, const Sliding& sliding) const {
    constexpr int most = 50;
    constexpr double rounding = 4e-15;
    const double film = film_rate(sliding);
    double value = std::min(trial, (*kinetic * pressure + film * trial) / (1 + film));
    for (int i = 0; i < most; ++i) {
      const double a = argument(trial - value, sliding);
      const double error = value - coefficient(a) * pressure - film * (trial - value);
      const double step = error / (1 + slope(a) * rate(sliding) * pressure + film);
      value -= step;
      if (!(std::abs(step) > rounding * value)) break;
    }
    return value;
  }
};

constexpr auto Coulomb::params() {
  return std::array<core::Param<Coulomb>, 7>{
      {{.key = "mu",
        .unit = "1",
        .doc = "Coefficient of friction.",
        .slot = &Coulomb::mu,
        .range = {.lower = 0, .with_lower = true},
        .example = "0.3"},
       shear_penalty_param<Coulomb>(),
       {.key = "kinetic",
        .unit = "1",
        .doc = "Coefficient of friction after sliding, or at speed.",
        .slot = &Coulomb::kinetic,
        .range = {.lower = 0, .with_lower = true},
        .required = false,
        .example = "0.2",
        .otherwise = "mu"},
       {.key = "distance",
        .unit = "length",
        .doc = "Scale of the distance slid since the point touched.",
        .slot = &Coulomb::distance,
        .range = {.lower = 0},
        .required = false,
        .example = "0.01",
        .one_of = &decay},
       {.key = "speed",
        .unit = "length/time",
        .doc = "Scale of the sliding speed; every step needs a duration.",
        .slot = &Coulomb::speed,
        .range = {.lower = 0},
        .required = false,
        .example = "0.5",
        .one_of = &decay,
        .timed = true},
       {.key = "cap",
        .unit = "force/length^2 (force with weight: node)",
        .doc = "Largest shear traction, whatever the pressure.",
        .slot = &Coulomb::cap,
        .range = {.lower = 0},
        .required = false,
        .example = "40",
        .otherwise = "none"},
       {.key = "viscous",
        .unit = "force time/length^3 (force time/length with weight: node)",
        .doc = "Shear traction per sliding speed of a film, on top; every step needs a duration.",
        .slot = &Coulomb::viscous,
        .range = {.lower = 0, .with_lower = true},
        .required = false,
        .example = "0.5",
        .otherwise = "none",
        .timed = true}}};
}

}  // namespace osculate::contact
