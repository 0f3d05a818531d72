#pragma once
#include <algorithm>
#include <string_view>

#include "osculate/contact/law/law.hpp"
#include "osculate/core/param.hpp"

namespace osculate::contact {

/// A damper beside the spring of the normal law, while there is contact.
///
/// Formula    p = max(0, p_spring(zeta) + c w / h) ,  w = min(zeta_n, onset) - zeta ,
///            h the duration of the increment: w is the way of the increment that lies within the
///            onset of the law, so that p begins at zero where the contact does; in the increment
///            in which it begins w / h is less than the closing speed (first order in h).
///            Dissipated p_damper w >= 0, also where the damper would pull and the surfaces let
///            go: then it has taken what the spring had
/// Units      c: pressure per speed (force per speed with weight node)
/// Requires   a duration; without one there is the spring alone
/// Tested by  tests/unit/contact/test_damping.cpp
struct Viscous {
  static constexpr std::string_view key = "viscous";
  double coefficient = 0;  ///< c

  static constexpr auto params() {
    return std::array<core::Param<Viscous>, 1>{
        {{.key = "",
          .unit = "force time/length^3 (force time/length with weight: node)",
          .doc = "A damper beside the spring: pressure per closing speed; every step needs a "
                 "duration.",
          .slot = &Viscous::coefficient,
          .range = {.lower = 0, .with_lower = true},
          .example = "0.5",
          .timed = true}}};
  }

  template <class Law>
  [[nodiscard]] NormalResponse response(const Law& law, double gap, const Closing& closing) const {
    NormalResponse r = law.response(gap);
    if (!r.active) return r;
    r.stored = law.energy(gap);
    if (!(closing.duration > 0)) return r;
    const double spring = r.traction, rate = coefficient / closing.duration;
    const double way = std::min(closing.from, law.onset_gap()) - gap;
    r.traction -= rate * way;
    r.d_traction += rate;
    if (r.traction > 0) {
      r.active = false;
      r.traction = r.d_traction = 0;
    }
    r.dissipated = (spring - r.traction) * way;
    return r;
  }
  /// The damper's coefficient, for who treats it apart from the spring.
  [[nodiscard]] double damper() const { return coefficient; }
  /// Largest dN/dzeta of a spring with this stiffness.
  [[nodiscard]] double stiffest(double spring, double duration) const {
    return duration > 0 ? spring + coefficient / duration : spring;
  }
};

/// A spring that gives back the share e^2 of the work it has taken up: unloading is steeper than
/// loading. Whatever body, mass and speed is stopped by it leaves with e times its speed.
///
/// Formula    p = p_spring(zeta) where zeta <= d ;
///            p = p_spring(d + (zeta - d) / e^2) else, d the least gap since zeta was above the
///            onset of the law: unloading, and loading again up to there. Stored: e^2 U at that
///            argument; dissipated (1 - e^2) (U(zeta) - U(d)) where zeta < d. The pressure does
///            not fall with the penetration, so that stored + dissipated is convex in zeta
/// Source     WaltonBraun1986 (linear spring, k_unload = k / e^2), here for any law: e^2 is the
///            ratio of the works of restitution and compression (Stronge1990)
/// Note       e below `least` counts as `least`: the slope of unloading is 1 / e^2 times that of
///            loading
/// Tested by  tests/unit/contact/test_damping.cpp
struct Restitution {
  static constexpr std::string_view key = "restitution";
  static constexpr double least = 0.02;
  double value = 1;  ///< e

  static constexpr auto params() {
    return std::array<core::Param<Restitution>, 1>{
        {{.key = "",
          .unit = "1",
          .doc =
              "Speed after an impact over that before: unloading gives back the share e^2 of the "
              "work of the pressure. Below 0.02 it acts as 0.02.",
          .slot = &Restitution::value,
          .range = {.lower = 0, .upper = 1, .with_lower = true, .with_upper = true},
          .example = "0.5"}}};
  }
  [[nodiscard]] double returned() const {
    const double e = std::max(value, least);
    return e * e;
  }
  template <class Law>
  [[nodiscard]] NormalResponse response(const Law& law, double gap, const Closing& closing) const {
    NormalResponse r;
    if (gap > law.onset_gap()) return r;
    const double back = returned(), deepest = closing.deepest;
    if (!(gap > deepest)) {
      r = law.response(gap);
      r.stored = back * law.energy(gap);
      r.dissipated = (1 - back) * (law.energy(gap) - law.energy(deepest));
      r.deepest = gap;
      return r;
    }
    const double at = deepest + (gap - deepest) / back;
    r = law.response(at);
    r.d_traction /= back;
    r.stored = back * law.energy(at);
    r.deepest = deepest;
    return r;
  }
  [[nodiscard]] double stiffest(double spring, double) const { return spring / returned(); }
};

}  // namespace osculate::contact
