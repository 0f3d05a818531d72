#pragma once
// Laws whose stress is a stiffness times the strain, which differs with the direction.
#include <concepts>
#include <optional>

#include "osculate/material/memory.hpp"
#include "osculate/material/orientation.hpp"
#include "osculate/material/over_temperature.hpp"

namespace osculate::material {

/// A law that is its stiffness, in axes that the body gives it (Memory::axes).
template <class T>
concept Directional = requires(const T& law) {
  { stiffness(law) } -> std::same_as<Tangent3>;
};

/// A law of small strains between second Piola-Kirchhoff stress and Green-Lagrange strain: one for
/// large rotations and moderate strains, as Saint Venant and Kirchhoff's.
template <class T>
struct GreenLagrange {
  static constexpr std::string_view key = T::key;
  static constexpr std::string_view doc = T::doc;
  static constexpr bool finite_strain = true, large_strain = false, hooke_at_first = true;
  T law;
};
template <Directional T>
[[nodiscard]] Tangent3 stiffness(const GreenLagrange<T>& form) {
  return stiffness(form.law);
}
template <Directional T>
[[nodiscard]] Isotropic unloaded(const GreenLagrange<T>& form) {
  return unloaded(form.law);
}

/// At the temperature of a point, in the axes of the law.
template <Directional T>
[[nodiscard]] Tangent3 own_stiffness(const T& law, const Memory& memory) {
  if constexpr (OverTemperature<T>)
    if (has_tables(law)) return stiffness(at_point(law, memory));
  return stiffness(law);
}
template <Directional T>
[[nodiscard]] Tangent3 own_stiffness(const GreenLagrange<T>& form, const Memory& memory) {
  return own_stiffness(form.law, memory);
}
/// In the axes of a point; without, these are the global ones.
template <Directional T>
[[nodiscard]] Tangent3 stiffness_at(const T& law, const Memory& memory) {
  const Tangent3 own = own_stiffness(law, memory);
  return memory.axes ? turned(own, Eigen::Map<const Mat<3, 3>>(memory.axes)) : own;
}

/// Formula    S = D E ; in the plane nothing shears across it
template <int N>
[[nodiscard]] ResponseOf<N> proportional(const Tangent3& d, const Vec<N>& strain) {
  ResponseOf<N> r;
  r.tangent = d.topLeftCorner<N, N>();
  r.stress = r.tangent * strain;
  return r;
}
/// The same with S33 = 0, which gives E33.
[[nodiscard]] Response proportional_plane_stress(const Tangent3& d, const Strain& strain,
                                                 double& strain_33);

/// The isotropic material that is as stiff in the mean of all directions.
///
/// Formula    9 K = D11 + D22 + D33 + 2 (D12 + D23 + D13) ,
///            15 G = D11 + D22 + D33 - D12 - D23 - D13 + 3 (D44 + D55 + D66)
/// Source     Voigt, Lehrbuch der Kristallphysik, 1910; Hill 1952
[[nodiscard]] Isotropic mean_of_directions(const Tangent3& d);
/// Row of the first pivot of the stiffness that is not positive; none: every strain takes energy.
[[nodiscard]] std::optional<int> first_not_positive(const Tangent3& d);

}  // namespace osculate::material
