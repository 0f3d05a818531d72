#include "osculate/material/pointwise.hpp"

#include "osculate/material/law.hpp"

namespace osculate::material {
namespace {

template <int N, int Q>
bool stresses_of(const StVenantKirchhoff& law, const Pointwise<N, Q>& e, Pointwise<N, Q>& out) {
  const Lame c = lame(law.young, law.poisson);
  const Lanes<Q> pressure = c.lambda * (e[0] + e[1] + e[2]);
  for (std::size_t i = 0; i < N; ++i)
    out[i] = i < 3 ? Lanes<Q>(pressure + 2 * c.mu * e[i]) : Lanes<Q>(c.mu * e[i]);
  return true;
}

/// S = mu 2 E C^-1 + lambda ln J C^-1 with C^-1 by cofactors, as in neo_hooke.cpp.
template <int N, int Q>
bool stresses_of(const NeoHooke& law, const Pointwise<N, Q>& e, Pointwise<N, Q>& out) {
  using T = Lanes<Q>;
  const T zero = T::Zero();
  const T a = 2 * e[0], b = 2 * e[1], c = 2 * e[2], d = e[3];
  const T f = N == 6 ? e[N - 2] : zero, g = N == 6 ? e[N - 1] : zero;
  const T c11 = 1 + a, c22 = 1 + b, c33 = 1 + c;
  const T minor = a + b + a * b - d * d;  // of the plane, less 1
  const T change = minor + c * (1 + minor) + f * (d * g - f * c11) + g * (d * f - g * c22);
  const T determinant = 1 + change;
  if (!(c11 > 0 && minor > -1 && determinant > 0).all()) return false;
  const T scale = 1 / determinant;
  const Pointwise<6, Q> inverse{scale * (c22 * c33 - f * f), scale * (c11 * c33 - g * g),
                                scale * (1 + minor),         scale * (f * g - d * c33),
                                scale * (d * g - f * c11),   scale * (d * f - g * c22)};
  // ln(1 + change) with the digits that are lost in the sum
  const Lame k = lame(law.young, law.poisson);
  const T pull = 0.5 * k.lambda * (determinant.log() + scale * (change - (determinant - 1)));
  out[0] = k.mu * (a * inverse[0] + d * inverse[3] + g * inverse[5]) + pull * inverse[0];
  out[1] = k.mu * (d * inverse[3] + b * inverse[1] + f * inverse[4]) + pull * inverse[1];
  out[2] = k.mu * (g * inverse[5] + f * inverse[4] + c * inverse[2]) + pull * inverse[2];
  for (std::size_t i = 3; i < N; ++i) out[i] = (pull - k.mu) * inverse[i];
  return true;
}

/// Of other laws: one point after the other.
template <int N, int Q>
bool one_by_one(const Law& law, const Pointwise<N, Q>& e, const Memory& memory,
                Pointwise<N, Q>& out) {
  for (Eigen::Index q = 0; q < Q; ++q) {
    Vec<N> strain;
    for (std::size_t i = 0; i < N; ++i) strain[static_cast<Eigen::Index>(i)] = e[i][q];
    const StressOf<N> s = stress(law, strain, memory.at(static_cast<std::size_t>(q)));
    if (!s.ok) return false;
    for (std::size_t i = 0; i < N; ++i) out[i][q] = s.stress[static_cast<Eigen::Index>(i)];
  }
  return true;
}

}  // namespace

template <int N, int Q>
bool stresses(const Law& law, const Pointwise<N, Q>& strain, const Memory& memory,
              Pointwise<N, Q>& out) {
  const auto of = [&]<class T>(const T& m) {
    if constexpr (requires { stresses_of<N, Q>(m, strain, out); })
      return stresses_of<N, Q>(m, strain, out);
    else
      return one_by_one<N, Q>(law, strain, memory, out);
  };
  if (memory.expansion || memory.temperature || memory.initial)
    return one_by_one<N, Q>(law, strain, memory, out);
  return std::visit(of, law);
}

template bool stresses<4, 4>(const Law&, const Pointwise<4, 4>&, const Memory&, Pointwise<4, 4>&);
template bool stresses<6, 1>(const Law&, const Pointwise<6, 1>&, const Memory&, Pointwise<6, 1>&);
template bool stresses<6, 8>(const Law&, const Pointwise<6, 8>&, const Memory&, Pointwise<6, 8>&);

}  // namespace osculate::material
