#pragma once
#include "osculate/contact/law/catalogue.hpp"

namespace osculate::contact {

/// What eps_T is multiplied by around a multiplier, so that a limit that falls while the point
/// slides never falls as steeply as the elastic trial rises. A point that slides by s has the
/// multiplier t = L(s), hence the trial L(s) + eps_T s; were that below L(0) it would be taken for
/// sticking, and no iteration could end. eps_T is a means there, the answer does not depend on it.
///
/// Formula    the least power of ten with factor eps_T >= 2 max |dL/ds| ,
///            max |dL/ds| = (mu - mu_k) p / scale, by speed / (scale duration). It is constant but
///            for jumps, and so it has no derivative
/// Tested by  tests/unit/contact/test_friction_laws.cpp,
/// tests/unit/pairing/test_multiplier_laws.cpp
[[nodiscard]] inline double steadying(const FrictionLaw& law, double normal_traction,
                                      double duration) {
  constexpr double margin = 2, most = 1e12;
  const auto* const coulomb = std::get_if<Coulomb>(&law);
  if (!coulomb || !coulomb->change) return 1;
  const FrictionChange& change = *coulomb->change;
  const bool by_speed = change.by == FrictionChange::By::speed;
  if (by_speed && !(duration > 0)) return 1;
  const double fall = (coulomb->mu - change.kinetic) * pressure_of(normal_traction) /
                      (by_speed ? change.scale * duration : change.scale);
  double factor = 1;
  while (factor * coulomb->stiffness < margin * fall && factor < most) factor *= 10;
  return factor;
}

}  // namespace osculate::contact
