#pragma once
// The one list of material laws. A new law is a header of its own and one entry here.
#include <variant>

#include "osculate/material/anisotropic.hpp"
#include "osculate/material/arruda_boyce.hpp"
#include "osculate/material/deformation_plasticity.hpp"
#include "osculate/material/hyperfoam.hpp"
#include "osculate/material/j2_plasticity.hpp"
#include "osculate/material/linear_elastic.hpp"
#include "osculate/material/logarithmic.hpp"
#include "osculate/material/neo_hooke.hpp"
#include "osculate/material/norton.hpp"
#include "osculate/material/ogden.hpp"
#include "osculate/material/orthotropic.hpp"
#include "osculate/material/relaxing.hpp"
#include "osculate/material/rubber.hpp"
#include "osculate/material/st_venant_kirchhoff.hpp"
#include "osculate/material/user_material.hpp"
#include "osculate/material/viscoelastic.hpp"

namespace osculate::material {

/// One of the laws, as a value. Its copies are made in law.cpp: only what asks which laws there are
/// (that source, energy.cpp and deck/materials.cpp) has them in its code.
struct Law
    : std::variant<LinearElastic, StVenantKirchhoff, NeoHooke, J2Plasticity,
                   Logarithmic<J2Plasticity>, Norton, Logarithmic<Norton>, DeformationPlasticity,
                   Logarithmic<DeformationPlasticity>, Rubber, Ogden, Hyperfoam, ArrudaBoyce,
                   Orthotropic, GreenLagrange<Orthotropic>, Anisotropic, GreenLagrange<Anisotropic>,
                   Viscoelastic, Logarithmic<Viscoelastic>, UserMaterial, Logarithmic<UserMaterial>,
                   Relaxing<NeoHooke>, Relaxing<Rubber>, Relaxing<Ogden>, Relaxing<Hyperfoam>,
                   Relaxing<ArrudaBoyce>> {
  using variant::variant;
  Law();  ///< the first of the list, with its defaults
  Law(const Law&);
  Law(Law&&) noexcept;
  Law& operator=(const Law&);
  Law& operator=(Law&&) noexcept;
  ~Law();
};

/// A law that has a key in the model file; the others are forms of such laws.
template <class T>
concept IsNamed = requires {
  T::params().front();
};

/// Calls `visit(T{})` with a default value of each law that has a key, in the order of the list.
template <class Visit>
constexpr void for_each_law(const Visit& visit) {
  const auto one = [&]<class T>(T law) {
    if constexpr (IsNamed<T>) visit(std::move(law));
  };
  [&]<class... Laws>(const std::variant<Laws...>*) {
    (one(Laws{}), ...);
  }(static_cast<const Law*>(nullptr));
}

/// What every entry offers.
template <class T>
concept IsLaw = requires(const T& law) {
  { T::key } -> std::convertible_to<std::string_view>;
  { T::doc } -> std::convertible_to<std::string_view>;
  { T::finite_strain } -> std::convertible_to<bool>;  ///< of large rotations
  { T::large_strain } -> std::convertible_to<bool>;   ///< made for large compression
  { unloaded(law) } -> std::same_as<Isotropic>;
};
/// Of laws whose stress follows from the strain alone, the same in all directions.
template <class T>
concept Forgets = requires(const T& law, const Strain& strain, const Strain3& strain3,
                           double& strain_33) {
  { energy_of(law, strain) } -> std::same_as<double>;
  { energy_of(law, strain3) } -> std::same_as<double>;
  { respond(law, strain) } -> std::same_as<Response>;
  { respond(law, strain3) } -> std::same_as<Response3>;
  { respond_plane_stress(law, strain, strain_33) } -> std::same_as<Response>;
};
/// Of laws that say what they remember (memory.hpp): they get it, and say what is stored and what
/// is dissipated.
template <class T>
concept TakesMemory = requires(const T& law, const Strain& strain, const Strain3& strain3,
                               double& strain_33, const Memory& memory, const double* state) {
  { T::memory.front() } -> std::convertible_to<Remembered>;
  { energy_of(law, strain3, memory) } -> std::same_as<double>;
  { dissipated_by(law, state) } -> std::same_as<double>;
  { respond(law, strain, memory) } -> std::same_as<Response>;
  { respond(law, strain3, memory) } -> std::same_as<Response3>;
  { respond_plane_stress(law, strain, strain_33, memory) } -> std::same_as<Response>;
};

namespace detail {
template <class... Laws>
constexpr bool all_are_laws(const std::variant<Laws...>*) {
  return ((IsLaw<Laws> &&
           (Directional<Laws> || (Remembers<Laws> ? TakesMemory<Laws> : Forgets<Laws>))) &&
          ...);
}
template <class... Laws>
constexpr bool keys_differ(const std::variant<Laws...>*) {
  const std::array<std::string_view, sizeof...(Laws)> keys{
      (IsNamed<Laws> ? Laws::key : std::string_view())...};
  for (std::size_t i = 0; i < keys.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!keys[i].empty() && keys[i] == keys[j]) return false;
  return true;
}
}  // namespace detail
static_assert(detail::all_are_laws(static_cast<const Law*>(nullptr)));
static_assert(detail::keys_differ(static_cast<const Law*>(nullptr)));

}  // namespace osculate::material
