#pragma once
// Laws by the principal stretches, the same in all directions: what their formulas give along the
// axes, and what that makes of a strain.
#include <limits>

#include "osculate/material/free_thickness.hpp"
#include "osculate/material/logarithmic.hpp"

namespace osculate::material {

/// Energy of what depends on the volume alone and its derivatives by ln J.
struct OfVolume {
  double energy = 0, pull = 0, slope = 0;
};
/// Energy of a law and its derivatives by the logarithms eps_i of the principal stretches, but for
/// what depends on the volume alone.
struct AlongAxes {
  double energy = 0;
  Vec3 stress = Vec3::Zero();            ///< t_i = dW/d(eps_i)
  Mat<3, 3> slope = Mat<3, 3>::Zero();   ///< dt_i/d(eps_j)
  Mat<3, 3> secant = Mat<3, 3>::Zero();  ///< (t_i - t_j)/(eps_i - eps_j), its limit where they meet
  OfVolume volume{};
};
/// One term A exp(alpha (eps_i - shift)) of the t_i; what is the same for all i is none.
struct StretchTerm {
  double factor, power, shift;
};
/// Adds its part of the secants.
///
/// Formula    A exp(alpha (eps_j - shift)) (exp(alpha d) - 1) / d , d = eps_i - eps_j
inline void add_secants(const StretchTerm& term, const PrincipalStrain& e, AlongAxes& to) {
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j) {
      const double way = term.power * e.difference(i, j);
      const double mean = way == 0 ? 1 : std::expm1(way) / way;
      to.secant(i, j) +=
          term.factor * term.power * std::exp(term.power * (e.value[j] - term.shift)) * mean;
    }
}

/// Such a law says what it is along the axes.
template <class T>
concept ByStretches = requires(const T& law, const PrincipalStrain& e) {
  { along_axes(law, e) } -> std::same_as<AlongAxes>;
};

/// Stress and dS/dE from what a law is along the axes of C.
///
/// Formula    S = sum s_i n_i n_i , s_i = t_i / c_i , c_i = 1 + 2 E_i ; in the axes
///            dS_ii/dE_jj = (dt_i/d(eps_j) / c_j - 2 delta_ij s_i) / c_i , dS_ij = (s_i - s_j) /
///            (E_i - E_j) dE_ij with (s_i - s_j)/(E_i - E_j) = (secant_ij ln[c_i, c_j] - 2 s_j) /
///            c_i
/// Source     R. W. Ogden, Non-Linear Elastic Deformations, 1984, section 6.1.4: moduli of an
///            isotropic solid in its principal axes
/// Tested by  tests/unit/material/test_ogden.cpp
[[nodiscard]] Response3 response_of_axes(const LogarithmicStrain& strain, const AlongAxes& law);

template <ByStretches T>
[[nodiscard]] Response3 respond(const T& law, const Strain3& e) {
  const LogarithmicStrain strain(e);
  if (!strain.ok()) return {false};
  return response_of_axes(strain, along_axes(law, strain.principal()));
}
template <ByStretches T>
[[nodiscard]] Response respond(const T& law, const Strain& e) {
  return in_plane(respond(law, in_space(e)));
}
template <ByStretches T>
[[nodiscard]] Response respond_plane_stress(const T& law, const Strain& strain, double& strain_33) {
  const double nu = unloaded(law).poisson;
  return find_free_thickness(law, strain, nu / (1 - nu), strain_33);
}
/// W; infinity where det C is not positive.
template <ByStretches T>
[[nodiscard]] double energy_of(const T& law, const Strain3& e) {
  const LogarithmicStrain strain(e);
  if (!strain.ok()) return std::numeric_limits<double>::infinity();
  const AlongAxes w = along_axes(law, strain.principal());
  return w.energy + w.volume.energy;
}
template <ByStretches T>
[[nodiscard]] double energy_of(const T& law, const Strain& e) {
  return energy_of(law, in_space(e));
}

}  // namespace osculate::material
