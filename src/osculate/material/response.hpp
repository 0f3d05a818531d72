#pragma once
#include <array>
#include <concepts>
#include <string_view>

#include "osculate/core/param.hpp"
#include "osculate/core/types.hpp"

namespace osculate::material {

/// Working components of plane and axisymmetric problems: 11, 22, 33, 12. Strains carry twice the
/// shear (2 E12), right Cauchy-Green tensors the plain component (C12).
using Strain = Vec<4>;
using Stress = Vec<4>;
using Tangent = Mat<4, 4>;

/// Components in space: 11, 22, 33, 12, 23, 13, of which the first four are the plane ones.
using Strain3 = Vec<6>;
using Stress3 = Vec<6>;
using Tangent3 = Mat<6, 6>;

/// Stress and its derivative with respect to the strain. `ok` is false where the law has no
/// answer (volume not positive, no thickness found): step control cuts the increment.
template <int N>
struct ResponseOf {
  bool ok = true;
  Vec<N> stress = Vec<N>::Zero();
  Mat<N, N> tangent = Mat<N, N>::Zero();
};
/// The stress alone.
template <int N>
struct StressOf {
  bool ok = true;
  Vec<N> stress = Vec<N>::Zero();
};
using Response = ResponseOf<4>;
using Response3 = ResponseOf<6>;

/// Components of the plane in space, without shear across the plane, and back.
[[nodiscard]] inline Strain3 in_space(const Strain& e) {
  Strain3 out = Strain3::Zero();
  out.head<4>() = e;
  return out;
}
[[nodiscard]] inline const Strain3& in_space(const Strain3& e) { return e; }
[[nodiscard]] inline Response3 in_space(const Response& r) {
  Response3 out;
  out.ok = r.ok;
  out.stress.head<4>() = r.stress;
  out.tangent.topLeftCorner<4, 4>() = r.tangent;
  return out;
}
[[nodiscard]] inline Response in_plane(const Response3& r) {
  return {r.ok, r.stress.head<4>(), r.tangent.topLeftCorner<4, 4>()};
}

/// Elastic constants.
struct Isotropic {
  double young, poisson;
};

/// Lame constants.
struct Lame {
  double lambda, mu;
};
[[nodiscard]] inline Lame lame(double young, double poisson) {
  return {young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

/// The three constants of an isotropic law with the members young, poisson and density; those with
/// young_over and poisson_over may be tables over the temperature.
template <class T>
[[nodiscard]] constexpr std::array<core::Param<T>, 3> isotropic_params() {
  std::array<core::Param<T>, 3> params{{{"E",
                                         "force/length^2",
                                         "Young's modulus of the unloaded material.",
                                         &T::young,
                                         {.lower = 0},
                                         true,
                                         "2.1e5"},
                                        {"nu",
                                         "1",
                                         "Poisson's ratio of the unloaded material.",
                                         &T::poisson,
                                         {.lower = -1, .upper = 0.5},
                                         true,
                                         "0.3"},
                                        {"density",
                                         "mass/length^3",
                                         "Mass per reference volume.",
                                         &T::density,
                                         {.lower = 0, .with_lower = true},
                                         false,
                                         "7.85e-9"}}};
  if constexpr (requires(T law) { law.young_over; }) {
    params[0].over = &T::young_over;
    params[1].over = &T::poisson_over;
  }
  return params;
}

}  // namespace osculate::material
