#pragma once
// Stresses at several points at once, law by law. For pointwise.cpp, and for kernels that know the
// law.
#include <array>

#include "osculate/core/pack.hpp"
#include "osculate/material/linear_elastic.hpp"
#include "osculate/material/neo_hooke.hpp"
#include "osculate/material/st_venant_kirchhoff.hpp"

namespace osculate::material {

using core::everywhere;
/// A strain or stress of N components, each of several points.
template <int N, class T>
using Several = std::array<T, static_cast<std::size_t>(N)>;

/// lambda tr(E) I + 2 mu E.
template <int N, class T>
inline void hooke_of(double young, double poisson, const Several<N, T>& e, Several<N, T>& out) {
  const Lame c = lame(young, poisson);
  const T pressure = c.lambda * (e[0] + e[1] + e[2]);
  for (std::size_t i = 0; i < N; ++i)
    out[i] = i < 3 ? T(pressure + 2 * c.mu * e[i]) : T(c.mu * e[i]);
}
template <int N, class T>
inline bool stresses_of(const StVenantKirchhoff& law, const Several<N, T>& e, Several<N, T>& out) {
  hooke_of<N, T>(law.young, law.poisson, e, out);
  return true;
}
template <int N, class T>
inline bool stresses_of(const LinearElastic& law, const Several<N, T>& e, Several<N, T>& out) {
  hooke_of<N, T>(law.young, law.poisson, e, out);
  return true;
}

/// S = mu 2 E C^-1 + lambda ln J C^-1 with C^-1 by cofactors, as in neo_hooke.cpp.
template <int N, class T>
inline bool stresses_of(const NeoHooke& law, const Several<N, T>& e, Several<N, T>& out) {
  const T zero = T::Zero();
  const T a = 2 * e[0], b = 2 * e[1], c = 2 * e[2], d = e[3];
  const T f = N == 6 ? e[N - 2] : zero, g = N == 6 ? e[N - 1] : zero;
  const T c11 = 1 + a, c22 = 1 + b, c33 = 1 + c;
  const T minor = a + b + a * b - d * d;  // of the plane, less 1
  const T change = minor + c * (1 + minor) + f * (d * g - f * c11) + g * (d * f - g * c22);
  const T determinant = 1 + change;
  if (!everywhere(c11 > 0) || !everywhere(minor > -1) || !everywhere(determinant > 0)) return false;
  const T scale = 1 / determinant;
  const Several<6, T> inverse{scale * (c22 * c33 - f * f), scale * (c11 * c33 - g * g),
                              scale * (1 + minor),         scale * (f * g - d * c33),
                              scale * (d * g - f * c11),   scale * (d * f - g * c22)};
  // ln(1 + change) with the digits that are lost in the sum
  const Lame k = lame(law.young, law.poisson);
  const T pull = 0.5 * k.lambda * (log(determinant) + scale * (change - (determinant - 1)));
  out[0] = k.mu * (a * inverse[0] + d * inverse[3] + g * inverse[5]) + pull * inverse[0];
  out[1] = k.mu * (d * inverse[3] + b * inverse[1] + f * inverse[4]) + pull * inverse[1];
  out[2] = k.mu * (g * inverse[5] + f * inverse[4] + c * inverse[2]) + pull * inverse[2];
  for (std::size_t i = 3; i < N; ++i) out[i] = (pull - k.mu) * inverse[i];
  return true;
}

/// As pointwise.hpp, of a law that is known.
template <int N, class Known, class T>
requires requires(const Known& law, Several<N, T>& s) { stresses_of<N, T>(law, s, s); }
[[nodiscard]] inline bool stresses(const Known& law, std::size_t count,
                                   const std::array<T, static_cast<std::size_t>(N)>* strain,
                                   std::array<T, static_cast<std::size_t>(N)>* out) {
  for (std::size_t q = 0; q < count; ++q)
    if (!stresses_of<N, T>(law, strain[q], out[q])) return false;
  return true;
}

}  // namespace osculate::material
