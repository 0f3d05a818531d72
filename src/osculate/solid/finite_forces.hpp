#pragma once
// Forces alone of finite strain, without strain matrices and tangents: for whoever needs many of
// them, such as explicit time integration. For sources of this layer.
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <span>

#include "osculate/material/law.hpp"
#include "osculate/material/stretch.hpp"
#include "osculate/solid/element.hpp"
#include "osculate/solid/stress_tensor.hpp"

namespace osculate::solid {

/// Green-Lagrange strain of a displacement gradient; in the plane without a strain across it.
[[nodiscard]] inline material::Strain green_lagrange(const Mat<2, 2>& h) {
  const Mat<2, 2> hh = h.transpose() * h;
  return {h(0, 0) + 0.5 * hh(0, 0), h(1, 1) + 0.5 * hh(1, 1), 0, h(0, 1) + h(1, 0) + hh(0, 1)};
}
[[nodiscard]] inline material::Strain3 green_lagrange(const Mat<3, 3>& h) {
  const Mat<3, 3> hh = h.transpose() * h;
  return {h(0, 0) + 0.5 * hh(0, 0),     h(1, 1) + 0.5 * hh(1, 1),     h(2, 2) + 0.5 * hh(2, 2),
          h(0, 1) + h(1, 0) + hh(0, 1), h(1, 2) + h(2, 1) + hh(1, 2), h(0, 2) + h(2, 0) + hh(0, 2)};
}

/// One point: what the displacement does there.
template <int Dim, int N>
struct FinitePoint {
  double volume = 0;  ///< undeformed
  Mat<Dim, Dim> f;
  Mat<N, Dim> gradient;  ///< dN_k/dX
  Vec<Dim == 2 ? 4 : 6> strain;
};

/// Nodal forces of a cell in finite strain, plane strain or in space, one row a node.
///
/// Formula    f_k = sum_q V F S grad N_k ; with the mean dilatation (one volume ratio theta for all
///            points, E_m = m (E + I/2) - I/2 , m = (theta / J)^(2/3)), in which the derivative of
///            ln m enters with c = S : (E_m + I/2):
///            f_k = sum_q V m F S grad N_k + sum_q 2/3 (T share_q - V_q c_q) F^-T grad N_k ,
///            T = sum_q V c , share = V J / sum V J
/// Source     the internal forces of element.hpp and volume.hpp, with d(ln J)/du_k = F^-T grad N_k
/// Input      shapes, weights: of the quadrature; depth: thickness, 1 in space
/// Returns    as ElementResult::status
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_invariance.cpp, test_finite_forces.cpp
template <int Dim, int N, int Q, class Shape>
[[nodiscard]] Status finite_forces(const material::Law& law, double depth, bool mean_dilatation,
                                   std::span<const Shape, Q> shapes,
                                   std::span<const double, Q> weights, const Mat<N, Dim>& reference,
                                   const Mat<N, Dim>& displacement, const material::Memory& memory,
                                   Mat<N, Dim>& force) {
  force.setZero();
  std::array<FinitePoint<Dim, N>, Q> points;
  std::array<double, Q> square{};  // J^2 - 1; ratios without cancellation at small strain
  double volume = 0, growth = 0;   // int dV, int (J - 1) dV
  const auto growth_of = [&](std::size_t q) { return square[q] / (1 + std::sqrt(1 + square[q])); };
  for (std::size_t q = 0; q < Q; ++q) {
    FinitePoint<Dim, N>& p = points[q];
    const auto d = shapes[q].d.template topRows<N>();
    const Mat<Dim, Dim> jacobian = reference.transpose() * d;
    p.volume = weights[q] * jacobian.determinant() * depth;
    p.gradient.noalias() = d * jacobian.inverse();
    const Mat<Dim, Dim> h = displacement.transpose() * p.gradient;
    p.f = Mat<Dim, Dim>::Identity() + h;
    if (!(p.f.determinant() > 0)) return Status::inverted;
    p.strain = green_lagrange(h);
    if (!mean_dilatation) continue;
    square[q] = material::determinant_change(p.strain);
    volume += p.volume;
    growth += p.volume * growth_of(q);
  }
  const double mean = mean_dilatation ? growth / volume : 0;
  decltype(FinitePoint<Dim, N>::strain) half_unit;
  half_unit.setZero();
  half_unit.template head<3>().setConstant(0.5);
  std::array<double, Q> pressed{};  // V c
  double total = 0;
  for (std::size_t q = 0; q < Q; ++q) {
    FinitePoint<Dim, N>& p = points[q];
    double m = 1;
    if (mean_dilatation) {
      const double change = (mean * (2 + mean) - square[q]) / (1 + square[q]);  // m^3 - 1
      m = std::cbrt(1 + change);
      p.strain = m * p.strain + change / (1 + m + m * m) * half_unit;
    }
    const auto s = material::stress(law, p.strain, memory.at(q));
    if (!s.ok) return Status::material_failed;
    const Mat<Dim, Dim> pulled = m * p.volume * p.f * stress_tensor(s.stress);
    force.noalias() += p.gradient * pulled.transpose();
    if (!mean_dilatation) continue;
    pressed[q] = p.volume * s.stress.dot(p.strain + half_unit);
    total += pressed[q];
  }
  for (std::size_t q = 0; mean_dilatation && q < Q; ++q) {
    const FinitePoint<Dim, N>& p = points[q];
    const double share = p.volume * (1 + growth_of(q)) / (volume + growth);
    const double factor = 2.0 / 3 * (total * share - pressed[q]);
    force.noalias() += p.gradient * (factor * p.f.inverse());
  }
  return Status::ok;
}

/// The same as the result of a cell with the quadrature `rule`.
template <int Dim, int N, int Q, class Rule, class AnyCoordinates, class Result>
void set_finite_forces(const material::Law& law, double depth, bool mean_dilatation,
                       const Rule& rule, const AnyCoordinates& reference,
                       const AnyCoordinates& displacement, const material::Memory& memory,
                       Result& out) {
  using Shape = typename decltype(rule.shape)::value_type;
  Mat<N, Dim> force;
  out.status = finite_forces<Dim, N, Q>(
      law, depth, mean_dilatation, std::span<const Shape, Q>(rule.shape),
      std::span<const double, Q>(rule.weights), reference, displacement, memory, force);
  out.force.resize(Dim * N);
  for (Eigen::Index k = 0; k < N; ++k) out.force.template segment<Dim>(Dim * k) = force.row(k);
}

}  // namespace osculate::solid
