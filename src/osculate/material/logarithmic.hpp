#pragma once
#include <cmath>
#include <limits>

#include "osculate/material/memory.hpp"
#include "osculate/material/response.hpp"

namespace osculate::material {

/// Logarithms eps_i of the principal stretches, with all digits of what they differ by.
struct PrincipalStrain {
  Vec3 value = Vec3::Zero();
  Mat<3, 3> difference = Mat<3, 3>::Zero();  ///< eps_i - eps_j
  Mat<3, 3> mean_slope = Mat<3, 3>::Zero();  ///< (eps_i - eps_j) / (E_i - E_j)
};

/// A strain E = (C - I)/2 in the basis of its own axes.
///
/// Tested by  tests/unit/material/test_logarithmic.cpp
class LogarithmicStrain {
 public:
  explicit LogarithmicStrain(const Strain3& strain);
  [[nodiscard]] bool ok() const { return ok_; }  ///< C is positive definite
  /// ln(C)/2
  [[nodiscard]] Strain3 strain() const;
  [[nodiscard]] PrincipalStrain principal() const;
  [[nodiscard]] const Mat<3, 3>& axes() const { return axes_; }  ///< of C, columns
  /// Second Piola-Kirchhoff stress from the stress that works on the logarithmic strain.
  [[nodiscard]] Stress3 stress(const Stress3& of_logarithm) const;
  /// Stress and dS/dE from stress and tangent in the logarithmic strain.
  ///
  /// Formula    S = P^T T ,  dS/dE = P^T D P + T : L ,  P = dE_log/dE ,  L = d2(E_log)/dE2 ,
  ///            in the axes of C by divided differences of ln, which are smooth where its
  ///            eigenvalues meet: P_ab = ln[a, b] , (T : L)(H, K) = 2 sum_abc T_ab ln[a, b, c]
  ///            (H_ac K_cb + K_ac H_cb)
  /// Source     Miehe, Apel & Lambrecht 2002, with the derivatives of Daleckii & Krein
  [[nodiscard]] Response3 response(const Response3& of_logarithm) const;

 private:
  bool ok_ = false;
  Mat<3, 3> axes_ = Mat<3, 3>::Identity();  ///< columns
  Vec3 strain_ = Vec3::Zero();              ///< eigenvalues of E
  Mat<3, 3> first_ = Mat<3, 3>::Zero();     ///< ln[a, b]
};

/// Divided difference of ln over three numbers near 1 + 2 e, for eigenvalues e of a strain.
///
/// Tested by  tests/unit/material/test_logarithmic.cpp
[[nodiscard]] double second_difference_of_log(double a, double b, double c);

/// A law of small strains in the logarithmic strain: one for finite strains. Its stored energy is
/// that of the law at E_log, so that it turns with the body, and what it remembers, too.
template <class T>
struct Logarithmic {
  static constexpr std::string_view key = T::key;
  static constexpr std::string_view doc = T::doc;
  static constexpr bool finite_strain = true, large_strain = true;
  static constexpr auto memory = T::memory;
  T law;
};

template <class T>
[[nodiscard]] Response3 respond(const Logarithmic<T>& m, const Strain3& strain, Memory memory) {
  const LogarithmicStrain log(strain);
  if (!log.ok()) return {false};
  return log.response(respond(m.law, log.strain(), memory));
}
template <class T>
[[nodiscard]] Response respond(const Logarithmic<T>& m, const Strain& strain, Memory memory) {
  return in_plane(respond(m, in_space(strain), memory));
}
template <class T, int N>
[[nodiscard]] StressOf<N> stress_of(const Logarithmic<T>& m, const Vec<N>& strain, Memory memory) {
  const LogarithmicStrain log(in_space(strain));
  if (!log.ok()) return {false};
  const Response3 r = respond(m.law, log.strain(), memory);
  return {r.ok, log.stress(r.stress).template head<N>()};
}
/// The thickness is an axis of C of its own: S33 = 0 where the stress across it in the logarithmic
/// strain is.
template <class T>
[[nodiscard]] Response respond_plane_stress(const Logarithmic<T>& m, Strain strain,
                                            double& strain_33, Memory memory) {
  strain[2] = 0;
  const LogarithmicStrain log(in_space(strain));
  if (!log.ok()) return {false};
  double across = 0;
  const Response r =
      respond_plane_stress(m.law, Strain(log.strain().template head<4>()), across, memory);
  strain_33 = 0.5 * std::expm1(2 * across);
  return in_plane(log.response(in_space(r)));
}

template <class T>
[[nodiscard]] Isotropic unloaded(const Logarithmic<T>& m) {
  return unloaded(m.law);
}
template <class T>
[[nodiscard]] double energy_of(const Logarithmic<T>& m, const Strain3& strain,
                               const Memory& memory) {
  const LogarithmicStrain log(strain);
  return log.ok() ? energy_of(m.law, log.strain(), memory)
                  : std::numeric_limits<double>::infinity();
}
template <class T>
[[nodiscard]] double dissipated_by(const Logarithmic<T>& m, const double* state) {
  return dissipated_by(m.law, state);
}

}  // namespace osculate::material
