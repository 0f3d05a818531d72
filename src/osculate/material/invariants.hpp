#pragma once
// Laws by the invariants of the strain without its change of volume, and by the change of volume,
// the same in all directions: what their formulas give by these, and what that makes of a strain.
#include <limits>

#include "osculate/material/free_thickness.hpp"

namespace osculate::material {

/// Invariants of C less their values without strain, which keeps digits at small strain.
struct Invariants {
  bool ok = false;
  double first = 0, second = 0;          ///< tr C - 3, ((tr C)^2 - tr C^2) / 2 - 3
  double log_j = 0;                      ///< ln J
  double bar_first = 0, bar_second = 0;  ///< I1 - 3, I2 - 3 without the change of volume
};
/// Not ok where det C is not positive.
[[nodiscard]] Invariants invariants_of(const Strain3& e);

/// W = energy(I1, I2) + volume(J) and its derivatives by I1, I2 (of `bar_first`, `bar_second`) and
/// J.
struct ByInvariants {
  double energy = 0, d1 = 0, d2 = 0, d11 = 0, d12 = 0, d22 = 0, volume = 0, dj = 0, djj = 0;
};
/// Such a law says what it is by its invariants.
template <class T>
concept OfInvariants = requires(const T& law, const Invariants& v) {
  { by_invariants(law, v) } -> std::same_as<ByInvariants>;
};

/// S = dW/dE and dS/dE by the derivatives of the invariants
///   dI1/dE = 2 J^(-2/3) (I - tr C / 3 C^-1) ,
///   dI2/dE = 2 J^(-4/3) (tr C I - C - 2/3 I2(C) C^-1) ,  dJ/dE = J C^-1 .
///
/// Tested by  tests/unit/material/test_rubber.cpp, test_arruda_boyce.cpp
[[nodiscard]] Response3 response_of_invariants(const Strain3& e, const Invariants& v,
                                               const ByInvariants& w);

template <OfInvariants T>
[[nodiscard]] Response3 respond(const T& law, const Strain3& e) {
  const Invariants v = invariants_of(e);
  if (!v.ok) return {false};
  return response_of_invariants(e, v, by_invariants(law, v));
}
template <OfInvariants T>
[[nodiscard]] Response respond(const T& law, const Strain& e) {
  return in_plane(respond(law, in_space(e)));
}
/// The same with S33 = 0: Newton to round-off for E33.
///
/// Returns    not ok if the area of the plane is not positive, or if no thickness is found
template <OfInvariants T>
[[nodiscard]] Response respond_plane_stress(const T& law, const Strain& strain, double& strain_33) {
  return find_free_thickness(law, strain, 1, strain_33);
}
/// W; infinity where det C is not positive.
template <OfInvariants T>
[[nodiscard]] double energy_of(const T& law, const Strain3& e) {
  const Invariants v = invariants_of(e);
  if (!v.ok) return std::numeric_limits<double>::infinity();
  const ByInvariants w = by_invariants(law, v);
  return w.energy + w.volume;
}
template <OfInvariants T>
[[nodiscard]] double energy_of(const T& law, const Strain& e) {
  return energy_of(law, in_space(e));
}
/// E and nu of a shear modulus and a bulk modulus.
[[nodiscard]] inline Isotropic isotropic_of(double mu, double bulk) {
  return {9 * bulk * mu / (3 * bulk + mu), (3 * bulk - 2 * mu) / (2 * (3 * bulk + mu))};
}

}  // namespace osculate::material
