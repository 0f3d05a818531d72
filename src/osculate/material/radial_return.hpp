#pragma once
// What laws with inelastic strains that keep the volume have in common: an elastic predictor, whose
// deviator is shortened.
#include <cmath>
#include <limits>

#include "osculate/material/condense.hpp"
#include "osculate/material/memory.hpp"
#include "osculate/material/response.hpp"

namespace osculate::material {

/// A scalar that grows with the inelastic strain, and that strain by its tensor components: what
/// such a law remembers first.
struct Inelastic {
  double equivalent = 0;
  Vec<6> strain = Vec<6>::Zero();
};
[[nodiscard]] inline Inelastic inelastic_of(const double* state) {
  if (!state) return {};
  return {state[0], Eigen::Map<const Vec<6>>(state + 1)};
}
inline void remember(const Inelastic& p, const Memory& memory) {
  if (!memory.next) return;
  memory.next[0] = p.equivalent;
  Eigen::Map<Vec<6>>(memory.next + 1) = p.strain;
}

[[nodiscard]] inline Vec<6> deviator(Vec<6> v) {
  const double mean = v.head<3>().mean();
  v.head<3>().array() -= mean;
  return v;
}
/// Of a symmetric tensor.
[[nodiscard]] inline double tensor_norm(const Vec<6>& v) {
  return std::sqrt(v.head<3>().squaredNorm() + 2 * v.tail<3>().squaredNorm());
}
/// Tensor components.
[[nodiscard]] inline Vec<6> elastic_strain(Vec<6> strain, const Vec<6>& inelastic) {
  strain.tail<3>() *= 0.5;
  return strain - inelastic;
}

/// Stress and tangent of Hooke's law at an elastic strain.
[[nodiscard]] inline Response3 elastic_predictor(const Lame& c, const Vec<6>& elastic) {
  Response3 r;
  r.tangent.topLeftCorner<3, 3>().setConstant(c.lambda);
  r.tangent.diagonal().head<3>().array() += 2 * c.mu;
  r.tangent.diagonal().tail<3>().setConstant(c.mu);
  r.stress = 2 * c.mu * elastic;
  r.stress.head<3>().array() += c.lambda * elastic.head<3>().sum();
  return r;
}

/// Takes the step of inelastic strain off the predictor.
///
/// Formula    sigma -= 2 G step , D -= 2 G lost I_dev + 2 G along n n^T ; with the length q of the
///            predictor's deviator and q_1 of what is left: lost = 1 - q_1/q ,
///            along = q_1/q - dq_1/dq
/// Source     Simo & Taylor 1985, Simo & Hughes 1998, box 3.1 and 3.2
inline void return_radially(double mu, const Vec<6>& step, const Vec<6>& direction, double lost,
                            double along, Response3& r) {
  r.stress -= 2 * mu * step;
  r.tangent.topLeftCorner<3, 3>().array() += 2 * mu * lost / 3;
  r.tangent.diagonal().head<3>().array() -= 2 * mu * lost;
  r.tangent.diagonal().tail<3>().array() -= mu * lost;
  r.tangent.noalias() -= 2 * mu * along * direction * direction.transpose();
}

/// S33 = 0 by Newton to round-off for E33, from that of `e` on, the tangent condensed.
template <class T>
[[nodiscard]] Response without_stress_across(const T& law, Strain e, double& strain_33,
                                             const Memory& memory) {
  Response r;
  double smallest = std::numeric_limits<double>::infinity();
  constexpr int most = 60;
  for (int i = 0; i < most; ++i) {
    r = respond(law, e, memory);
    if (!r.ok) return r;
    const double size = r.tangent.row(2).cwiseAbs() * e.cwiseAbs() + r.stress.cwiseAbs().sum();
    const double rest = std::abs(r.stress[2]);
    // rounding, or nearly so and not getting smaller any more
    if (rest <= 1e-16 * size || (rest <= 1e-12 * size && rest >= 0.5 * smallest)) break;
    smallest = std::min(smallest, rest);
    e[2] -= r.stress[2] / r.tangent(2, 2);
    r.ok = false;
  }
  strain_33 = e[2];
  return without_stress_across(r);
}
/// The same from what is elastic.
template <class T>
[[nodiscard]] Response return_in_plane_stress(const T& law, const Strain& strain, double& strain_33,
                                              const Memory& memory) {
  const Inelastic before = inelastic_of(memory.committed);
  const double across = -law.poisson / (1 - law.poisson);
  Strain e = strain;
  e[2] = before.strain[2] + across * (e[0] + e[1] - before.strain[0] - before.strain[1]);
  return without_stress_across(law, e, strain_33, memory);
}

}  // namespace osculate::material
