#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "osculate/contact/law/tangential.hpp"

namespace osculate::contact {

/// How a coefficient of friction goes over from the static to the kinetic one.
///
/// Formula    mu(a) = mu_k + (mu - mu_k) exp(-a / scale) ,
///            a = distance slid since the point came into contact, or
///            a = speed = distance slid in the increment / duration of the increment
/// Source     by speed: J. T. Oden, J. A. C. Martins, Comput. Methods Appl. Mech. Engrg. 52 (1985)
///            527-634, section 2, in the usual exponential form; by distance: the same with what
///            slip-weakening models of faults take for a (Y. Ida, J. Geophys. Res. 77 (1972) 3796)
struct FrictionChange {
  enum class By : std::uint8_t { distance, speed };
  double kinetic = 0;  ///< mu_k; above mu: friction grows
  double scale = 1;    ///< length, or length per time; > 0
  By by = By::distance;
};

/// Coulomb friction by return mapping from an elastic trial, with an optional change of the
/// coefficient and an optional cap of the shear traction.
///
/// Formula    t = t_tr            if |t_tr| <= L_0                        (stick)
///            t = L t_tr / |t_tr| otherwise                               (slip)
///            L = min(mu(a) p, cap) , a taken at the end of the increment: it depends on L by
///            the distance slid, (|t_tr| - L) / eps_T; L_0 is L without sliding in the increment;
///            p = |N| under pressure, 0 where a held point is pulled
/// Source     KS2D:76, KS2D:57 in physical components (T_i = t . rho_,i), signs of docs/errata.md
/// Sign       the force on the slave's residual is +t for a slip in the direction +t
/// Tested by  tests/unit/contact/test_laws.cpp, test_friction_laws.cpp
struct Coulomb {
  static constexpr std::string_view key = "coulomb";
  double mu = 0;
  double stiffness = 0;  ///< eps_T, units as eps_N
  double cap = std::numeric_limits<double>::infinity();
  std::optional<FrictionChange> change{};

  [[nodiscard]] double coefficient(double a) const {
    if (!change) return mu;
    return change->kinetic + (mu - change->kinetic) * std::exp(-a / change->scale);
  }

  /// The limit at which a point that has not slid in the increment begins to.
  [[nodiscard]] SlipLimit first_limit(double pressure, const Sliding& sliding) const {
    const double now = coefficient(argument(0, sliding));
    return capped({now * pressure, 0, now});  // @eq KS2D:77
  }

  /// The limit of a point whose trial is beyond the first limit.
  [[nodiscard]] SlipLimit limit(double trial, double pressure, const Sliding& sliding) const {
    if (!change || rate(sliding) == 0.0) return first_limit(pressure, sliding);
    const double value = solved(trial, pressure, sliding);
    const double a = argument(trial - value, sliding);
    const double growth = slope(a) * rate(sliding) * pressure;  // kappa
    return capped({value, growth / (1 + growth), coefficient(a) / (1 + growth)});
  }

  /// Before the first iteration nothing has slid: at which limit a sliding point will go on.
  [[nodiscard]] SlipLimit predicted_limit(double trial, double pressure,
                                          const Sliding& sliding) const {
    if (!change || change->by == FrictionChange::By::distance || !(pressure > 0))
      return first_limit(pressure, sliding);
    const double low = std::min(mu, change->kinetic), high = std::max(mu, change->kinetic);
    const double last = std::clamp(trial / pressure, low, high);  // of the last increment
    return capped({last * pressure, 0, last});
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
  [[nodiscard]] SlipLimit capped(const SlipLimit& limit) const {
    return limit.value > cap ? SlipLimit{cap, 0, 0} : limit;
  }
  /// d(a) / d(distance in the increment) / eps_T
  [[nodiscard]] double rate(const Sliding& sliding) const {
    if (change->by == FrictionChange::By::distance) return 1 / stiffness;
    return sliding.duration > 0 ? 1 / (stiffness * sliding.duration) : 0.0;
  }
  /// a after sliding by `excess` / eps_T.
  [[nodiscard]] double argument(double excess, const Sliding& sliding) const {
    if (!change) return 0;
    const double before = change->by == FrictionChange::By::distance ? sliding.distance : 0.0;
    return before + std::max(0.0, excess) * rate(sliding);
  }
  /// d(mu) / d(a)
  [[nodiscard]] double slope(double a) const {
    return (change->kinetic - mu) / change->scale * std::exp(-a / change->scale);
  }
  /// The one root of L = mu(a(L)) p below the trial. Friction that falls: the function is concave
  /// and the tangents' roots rise to it from the least limit; that grows: convex, from above.
  [[nodiscard]] double solved(double trial, double pressure, const Sliding& sliding) const {
    constexpr int most = 50;
    constexpr double rounding = 4e-15;
    double value = std::min(trial, change->kinetic * pressure);
    for (int i = 0; i < most; ++i) {
      const double a = argument(trial - value, sliding);
      const double error = value - coefficient(a) * pressure;
      const double step = error / (1 + slope(a) * rate(sliding) * pressure);
      value -= step;
      if (!(std::abs(step) > rounding * value)) break;
    }
    return value;
  }
};

}  // namespace osculate::contact
