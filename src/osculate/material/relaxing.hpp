#pragma once
#include <optional>
#include <span>

#include "osculate/material/hyperfoam.hpp"
#include "osculate/material/invariants.hpp"
#include "osculate/material/memory.hpp"
#include "osculate/material/neo_hooke.hpp"
#include "osculate/material/ogden.hpp"
#include "osculate/material/prony.hpp"

namespace osculate::material {

/// What an elastic law says of a strain, by the change of the shape and of the volume.
struct Parts {
  Response3 shape;          ///< without what depends on the volume alone
  double shape_energy = 0;  ///< W less that of the volume
  double log_j = 0;
  OfVolume volume{};
};
/// Laws whose energy is one of the shape and one of the volume.
template <OfInvariants T>
[[nodiscard]] Parts parts_of(const T& law, const Strain3& e) {
  const Invariants v = invariants_of(e);
  if (!v.ok) return {{false}};
  ByInvariants w = by_invariants(law, v);
  const double j = std::exp(v.log_j);
  const OfVolume volume{w.volume, j * w.dj, j * (w.dj + j * w.djj)};
  w.dj = w.djj = 0;
  return {response_of_invariants(e, v, w), w.energy, v.log_j, volume};
}
[[nodiscard]] Parts parts_of(const Ogden& law, const Strain3& e);
/// Laws in which both are one: `shape` is the whole, `volume.pull` a third of S : C, and no more is
/// said of the volume.
[[nodiscard]] Parts parts_of(const NeoHooke& law, const Strain3& e);
[[nodiscard]] Parts parts_of(const Hyperfoam& law, const Strain3& e);

/// A law that may relax.
template <class T>
concept Relaxable = requires(const T& law, const Strain3& e) {
  { parts_of(law, e) } -> std::same_as<Parts>;
};
/// Of such a law shape and volume relax by the same series.
template <class T>
constexpr bool relaxes_as_one = std::same_as<T, NeoHooke> || std::same_as<T, Hyperfoam>;

/// Numbers of a point that relaxes: what is dissipated, C J^(-2/3) - I, T, ln J, p and both
/// energies; of a term h, its energy, p_i and its energy.
constexpr std::size_t relaxing_own = 17, relaxing_each = 9;
constexpr std::array<Remembered, relaxing_own + relaxing_each * Relaxation::most> relaxing_memory{
    {{"CDENS", "energy dissipated by creep, per volume", false}}};

/// A hyperelastic law, the one at once, whose stresses relax by Prony series: finite linear
/// viscoelasticity.
///
/// Formula    S = J^(-2/3) DEV((1 - sum g_i) T + sum g_i h_i) + ((1 - sum k_i) p + sum k_i p_i)
///            C^-1 , dh_i/dt = dT/dt - h_i / tau_i , p_i like h_i; of the law at once
///            T = J^(2/3) DEV(S_0) , p = S_0 : C / 3 (Kirchhoff's mean stress),
///            DEV(A) = A - (A : C) C^-1 / 3 ; in an increment by its series (prony.hpp), as if T
///            changed evenly: of second order in the increment, and exact where the strain is held
/// Source     J. C. Simo, Comput. Methods Appl. Mech. Eng. 60 (1987) 153; Simo & Hughes 1998,
///            section 10.3
/// Requires   of neo_hooke and hyperfoam, whose energies do not split, bulk = shear; det C > 0,
///            otherwise the response is not ok
/// Units      times: time
/// Returns    stored energy: that of what remains, and of each term the work on it less what it
///            has lost, at the rate 2 / tau_i of what it has; dissipated: what has been lost
/// Tested by  tests/unit/material/test_relaxing.cpp, verification/relaxation
template <class T>
struct Relaxing {
  static constexpr std::string_view key = T::key;
  static constexpr std::string_view doc = T::doc;
  static constexpr bool finite_strain = true, large_strain = true;
  static constexpr auto memory = relaxing_memory;
  T law{};
  Relaxation series{};
};

namespace detail {
/// The response after an increment, from that at once. `as_one`: see relaxes_as_one.
[[nodiscard]] Response3 relaxed(const Relaxation& series, bool as_one, const Strain3& strain,
                                const Parts& at_once, const Memory& memory);
/// Stored at a strain that is reached at once from what is remembered.
[[nodiscard]] double relaxed_energy(const Relaxation& series, bool as_one, const Strain3& strain,
                                    const Parts& at_once, const Memory& memory);
/// A law and what a point of it remembers: to find its thickness.
template <class T>
struct AtPoint {
  const Relaxing<T>& law;
  Memory memory;
};
template <class T>
[[nodiscard]] Response respond(const AtPoint<T>& m, const Strain& strain) {
  const Strain3 e = in_space(strain);
  return in_plane(relaxed(m.law.series, relaxes_as_one<T>, e, parts_of(m.law.law, e), m.memory));
}
}  // namespace detail

template <class T>
[[nodiscard]] Response3 respond(const Relaxing<T>& m, const Strain3& strain, Memory memory) {
  return detail::relaxed(m.series, relaxes_as_one<T>, strain, parts_of(m.law, strain), memory);
}
template <class T>
[[nodiscard]] Response respond(const Relaxing<T>& m, const Strain& strain, Memory memory) {
  return respond(detail::AtPoint<T>{m, memory}, strain);
}
template <class T>
[[nodiscard]] Response respond_plane_stress(const Relaxing<T>& m, const Strain& strain,
                                            double& strain_33, Memory memory) {
  const double nu = unloaded(m.law).poisson;
  return find_free_thickness(detail::AtPoint<T>{m, memory}, strain, nu / (1 - nu), strain_33);
}
template <class T>
[[nodiscard]] Isotropic unloaded(const Relaxing<T>& m) {
  return unloaded(m.law);
}
/// Infinity where det C is not positive.
template <class T>
[[nodiscard]] double energy_of(const Relaxing<T>& m, const Strain3& strain, const Memory& memory) {
  return detail::relaxed_energy(m.series, relaxes_as_one<T>, strain, parts_of(m.law, strain),
                                memory);
}
template <class T>
[[nodiscard]] double dissipated_by(const Relaxing<T>&, const double* state) {
  return state ? state[0] : 0;
}
template <class T>
[[nodiscard]] std::span<const Remembered> remembered_by(const Relaxing<T>& m) {
  return std::span(relaxing_memory)
      .first(relaxing_own + relaxing_each * terms_of(m.series.shear, m.series.bulk));
}

}  // namespace osculate::material
