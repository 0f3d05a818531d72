#pragma once
// The one list of material laws. A new law is a header of its own and one entry here.
#include <variant>

#include "osculate/material/linear_elastic.hpp"
#include "osculate/material/neo_hooke.hpp"
#include "osculate/material/st_venant_kirchhoff.hpp"

namespace osculate::material {

using Law = std::variant<LinearElastic, StVenantKirchhoff, NeoHooke>;

/// Calls `visit(T{})` with a default value of each law, in the order of the list.
template <class Visit>
constexpr void for_each_law(const Visit& visit) {
  [&]<class... Laws>(const std::variant<Laws...>*) {
    (visit(Laws{}), ...);
  }(static_cast<const Law*>(nullptr));
}

/// What every entry offers.
template <class T>
concept IsLaw = requires(const T& law, const Strain& strain, const Strain3& strain3,
                         double& strain_33) {
  { T::key } -> std::convertible_to<std::string_view>;
  { T::doc } -> std::convertible_to<std::string_view>;
  { T::finite_strain } -> std::convertible_to<bool>;  ///< of large rotations
  { T::large_strain } -> std::convertible_to<bool>;   ///< made for large compression
  { law.density } -> std::convertible_to<double>;
  { unloaded(law) } -> std::same_as<Isotropic>;
  { energy_of(law, strain) } -> std::same_as<double>;
  { energy_of(law, strain3) } -> std::same_as<double>;
  { T::params().front() } -> std::convertible_to<core::Param<T>>;
  { respond(law, strain) } -> std::same_as<Response>;
  { respond(law, strain3) } -> std::same_as<Response3>;
  { respond_plane_stress(law, strain, strain_33) } -> std::same_as<Response>;
};

namespace detail {
template <class... Laws>
constexpr bool all_are_laws(const std::variant<Laws...>*) {
  return (IsLaw<Laws> && ...);
}
template <class... Laws>
constexpr bool keys_differ(const std::variant<Laws...>*) {
  const std::array<std::string_view, sizeof...(Laws)> keys{Laws::key...};
  for (std::size_t i = 0; i < keys.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (keys[i] == keys[j]) return false;
  return true;
}
}  // namespace detail
static_assert(detail::all_are_laws(static_cast<const Law*>(nullptr)));
static_assert(detail::keys_differ(static_cast<const Law*>(nullptr)));

}  // namespace osculate::material
