#include "osculate/material/pointwise.hpp"

#include "osculate/material/energy.hpp"
#include "osculate/material/law.hpp"
#include "osculate/material/pointwise_laws.hpp"

namespace osculate::material {
namespace {

/// mu tr E - mu ln J + lambda/2 (ln J)^2.
template <int N, class T>
T energies_of(const NeoHooke& law, const Several<N, T>& e) {
  const Lame k = lame(law.young, law.poisson);
  const T zero = T::Zero();
  const T f = N == 6 ? e[N - 2] : zero, g = N == 6 ? e[N - 1] : zero;
  const T c11 = 1 + 2 * e[0], c22 = 1 + 2 * e[1], c33 = 1 + 2 * e[2], d = e[3];
  const T determinant = c33 * (c11 * c22 - d * d) + f * (d * g - f * c11) + g * (d * f - g * c22);
  const T log_j = 0.5 * log(determinant);
  return k.mu * (e[0] + e[1] + e[2] - log_j) + 0.5 * k.lambda * log_j * log_j;
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
template <int N>
bool one_by_one(const Law& law, const Several<N, core::Pack>& e, Several<N, core::Pack>& out) {
  for (int q = 0; q < core::Pack::count; ++q) {
    Vec<N> strain;
    for (std::size_t i = 0; i < N; ++i) strain[static_cast<Eigen::Index>(i)] = e[i][q];
    const StressOf<N> s = stress(law, strain);
    if (!s.ok) return false;
    for (std::size_t i = 0; i < N; ++i) out[i].set(q, s.stress[static_cast<Eigen::Index>(i)]);
  }
  return true;
}

}  // namespace

template <int N, int Q>
bool stresses(const Law& law, const Pointwise<N, Q>& strain, const Memory& memory,
              Pointwise<N, Q>& out) {
  const auto of = [&]<class T>(const T& m) {
    if constexpr (requires { stresses_of<N, Lanes<Q>>(m, strain, out); })
      return stresses_of<N, Lanes<Q>>(m, strain, out);
    else
      return one_by_one<N, Q>(law, strain, memory, out);
  };
  if (memory.expansion || memory.temperature || memory.initial)
    return one_by_one<N, Q>(law, strain, memory, out);
  return std::visit(of, law);
}

template <int N>
bool stresses(const Law& law, std::size_t count, const Several<N, core::Pack>* strain,
              Several<N, core::Pack>* out) {
  const auto of = [&]<class T>(const T& m) {
    for (std::size_t q = 0; q < count; ++q) {
      if constexpr (requires { stresses_of<N, core::Pack>(m, strain[q], out[q]); }) {
        if (!stresses_of<N, core::Pack>(m, strain[q], out[q])) return false;
      } else if (!one_by_one<N>(law, strain[q], out[q])) {
        return false;
      }
    }
    return true;
  };
  return std::visit(of, law);
}

bool at_once(const Law& law) {
  return std::visit(
      []<class T>(const T& m) {
        return requires(const Several<6, core::Pack>& e, Several<6, core::Pack>& s) {
          stresses_of<6, core::Pack>(m, e, s);
        };
      },
      law);
}

template <int N>
core::Pack stored_energies(const Law& law, const Several<N, core::Pack>& strain) {
  core::Pack energy;
  if (const auto* const soft = std::get_if<NeoHooke>(&law))
    return energies_of<N, core::Pack>(*soft, strain);
  if (const auto* const stiff = std::get_if<StVenantKirchhoff>(&law)) {
    Several<N, core::Pack> s;
    hooke_of<N, core::Pack>(stiff->young, stiff->poisson, strain, s);
    energy = s[0] * strain[0];
    for (std::size_t i = 1; i < N; ++i) energy += s[i] * strain[i];
    return 0.5 * energy;
  }
  for (int q = 0; q < core::Pack::count; ++q) {
    Vec<N> e;
    for (std::size_t i = 0; i < N; ++i) e[static_cast<Eigen::Index>(i)] = strain[i][q];
    energy.set(q, stored_energy(law, e));
  }
  return energy;
}

template core::Pack stored_energies<4>(const Law&, const Several<4, core::Pack>&);
template core::Pack stored_energies<6>(const Law&, const Several<6, core::Pack>&);
template bool stresses<4>(const Law&, std::size_t, const Several<4, core::Pack>*,
                          Several<4, core::Pack>*);
template bool stresses<6>(const Law&, std::size_t, const Several<6, core::Pack>*,
                          Several<6, core::Pack>*);
template bool stresses<4, 4>(const Law&, const Pointwise<4, 4>&, const Memory&, Pointwise<4, 4>&);
template bool stresses<6, 1>(const Law&, const Pointwise<6, 1>&, const Memory&, Pointwise<6, 1>&);
template bool stresses<6, 8>(const Law&, const Pointwise<6, 8>&, const Memory&, Pointwise<6, 8>&);

}  // namespace osculate::material
