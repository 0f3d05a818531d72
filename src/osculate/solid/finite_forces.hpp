#pragma once
// Forces alone of finite strain, without strain matrices and tangents: for whoever needs many of
// them, such as explicit time integration. The points of a cell are taken together, several in one
// operation of the processor. For sources of this layer.
#include <array>
#include <cmath>
#include <optional>

#include "osculate/material/pointwise.hpp"
#include "osculate/solid/element.hpp"

namespace osculate::solid {

using material::Lanes;
using material::Pointwise;

/// A matrix at each of Q points.
template <int Dim, int Q>
struct PointMatrix {
  std::array<Lanes<Q>, static_cast<std::size_t>(Dim* Dim)> entry;
  Lanes<Q>& operator()(int i, int j) { return entry[static_cast<std::size_t>(Dim * i + j)]; }
  const Lanes<Q>& operator()(int i, int j) const {
    return entry[static_cast<std::size_t>(Dim * i + j)];
  }
};

/// Weights and derivatives of the shape functions of N nodes at the Q points of a rule.
template <int Dim, int N, int Q>
struct PointTable {
  template <class Rule>
  explicit PointTable(const Rule& rule) {
    for (int q = 0; q < Q; ++q) {
      const auto at = static_cast<std::size_t>(q);
      weight[q] = rule.weights[at];
      for (int k = 0; k < N; ++k)
        for (int j = 0; j < Dim; ++j)
          slope[static_cast<std::size_t>(Dim * k + j)][q] = rule.shape[at].d(k, j);
    }
  }
  [[nodiscard]] const Lanes<Q>& d(int k, int j) const {
    return slope[static_cast<std::size_t>(Dim * k + j)];
  }
  Lanes<Q> weight;
  std::array<Lanes<Q>, static_cast<std::size_t>(Dim* N)> slope;  ///< dN_k/dxi_j at Dim k + j
};

/// Derivatives of nodal values, one row a node, along xi: sum_k x_ki dN_k/dxi_j.
template <int Dim, int N, int Q, class Nodal>
void slopes(const PointTable<Dim, N, Q>& table, const Nodal& x, PointMatrix<Dim, Q>& out) {
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) {
      Lanes<Q> sum = x(0, i) * table.d(0, j);
      for (int k = 1; k < N; ++k) sum += x(k, i) * table.d(k, j);
      out(i, j) = sum;
    }
}

/// The transposed of adj A = det(A) A^-1, returns det A.
template <int Q>
Lanes<Q> cofactors(const PointMatrix<2, Q>& a, PointMatrix<2, Q>& out) {
  out.entry = {a(1, 1), -a(1, 0), -a(0, 1), a(0, 0)};
  return a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0);
}
template <int Q>
Lanes<Q> cofactors(const PointMatrix<3, Q>& a, PointMatrix<3, Q>& out) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int k = (i + 1) % 3, l = (i + 2) % 3, m = (j + 1) % 3, n = (j + 2) % 3;
      out(i, j) = a(k, m) * a(l, n) - a(k, n) * a(l, m);
    }
  return a(0, 0) * out(0, 0) + a(0, 1) * out(0, 1) + a(0, 2) * out(0, 2);
}

/// det(I + h) - 1 without cancellation at small strain; `of_f` are the cofactors of I + h.
template <int Dim, int Q>
Lanes<Q> volume_change(const PointMatrix<Dim, Q>& h, const PointMatrix<Dim, Q>& of_f) {
  Lanes<Q> first = h(1, 1);  // the first cofactor, less 1
  if constexpr (Dim == 3) first += h(2, 2) + h(1, 1) * h(2, 2) - h(1, 2) * h(2, 1);
  Lanes<Q> sum = first + h(0, 0) * (1 + first);
  for (int j = 1; j < Dim; ++j) sum += h(0, j) * of_f(0, j);
  return sum;
}

/// A B^T.
template <int Dim, int Q>
void times_transposed(const PointMatrix<Dim, Q>& a, const PointMatrix<Dim, Q>& b,
                      PointMatrix<Dim, Q>& out) {
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) {
      Lanes<Q> sum = a(i, 0) * b(j, 0);
      for (int k = 1; k < Dim; ++k) sum += a(i, k) * b(j, k);
      out(i, j) = sum;
    }
}

/// Component of a strain or stress at row i and column j.
constexpr std::size_t component(int i, int j) {
  return static_cast<std::size_t>(i == j ? i : i + j == 1 ? 3 : i + j == 3 ? 4 : 5);
}

/// Green-Lagrange strain of a displacement gradient; in the plane without a strain across it.
template <int Dim, int Q, int C = Dim == 2 ? 4 : 6>
void green_lagrange(const PointMatrix<Dim, Q>& h, Pointwise<C, Q>& out) {
  out[2].setZero();
  for (int i = 0; i < Dim; ++i)
    for (int j = i; j < Dim; ++j) {
      Lanes<Q> sum = h(0, i) * h(0, j);
      for (int k = 1; k < Dim; ++k) sum += h(k, i) * h(k, j);
      out[component(i, j)] =
          i == j ? Lanes<Q>(h(i, i) + 0.5 * sum) : Lanes<Q>(h(i, j) + h(j, i) + sum);
    }
}

/// (1 + c)^(1/3): Halley's steps, of which each triples the digits.
template <int Q>
Lanes<Q> cube_root(const Lanes<Q>& c) {
  const Lanes<Q> a = 1 + c;
  if (!(c.abs() < 0.5).all()) return a.unaryExpr([](double v) { return std::cbrt(v); });
  Lanes<Q> m = 1 + c * (1.0 / 3 - c * (1.0 / 9));
  for (int step = 0; step < 2; ++step) {
    const Lanes<Q> cube = m * m * m;
    m += m * (a - cube) / (2 * cube + a);
  }
  return m;
}

/// One volume ratio for all points of a cell.
template <int Dim, int Q>
struct OneRatio {
  static constexpr int C = Dim == 2 ? 4 : 6;
  Lanes<Q> m;      ///< (theta / J)^(2/3)
  Lanes<Q> share;  ///< V J / sum V J

  /// Replaces the strains E by E_m.
  ///
  /// Input      growth: J - 1
  OneRatio(const Lanes<Q>& volume, const Lanes<Q>& growth, Pointwise<C, Q>& strain) {
    const double total = volume.sum(), grown = (volume * growth).sum(), mean = grown / total;
    const Lanes<Q> square = growth * (2 + growth);                        // J^2 - 1
    const Lanes<Q> change = (mean * (2 + mean) - square) / (1 + square);  // m^3 - 1
    m = cube_root<Q>(change);
    const Lanes<Q> half = 0.5 * change / (1 + m + m * m);  // (m - 1) / 2
    for (std::size_t i = 0; i < C; ++i)
      strain[i] = i < 3 ? Lanes<Q>(m * strain[i] + half) : Lanes<Q>(m * strain[i]);
    share = volume * (1 + growth) / (total + grown);
  }
  /// V times the factor of F^-T grad N_k.
  [[nodiscard]] Lanes<Q> pressed(const Lanes<Q>& volume, const Pointwise<C, Q>& strain,
                                 const Pointwise<C, Q>& stress) const {
    Lanes<Q> c = stress[0] * (strain[0] + 0.5);
    for (std::size_t i = 1; i < C; ++i) c += stress[i] * (i < 3 ? strain[i] + 0.5 : strain[i] + 0);
    c *= volume;
    return 2.0 / 3 * (c.sum() * share - c);
  }
};

/// Nodal forces of a cell in finite strain, plane strain or in space, node by node.
///
/// Formula    f_k = sum_q V F S grad N_k ; with the mean dilatation (one volume ratio theta for all
///            points, E_m = m (E + I/2) - I/2 , m = (theta / J)^(2/3)), in which the derivative of
///            ln m enters with c = S : (E_m + I/2):
///            f_k = sum_q V m F S grad N_k + sum_q 2/3 (T share_q - V_q c_q) F^-T grad N_k ,
///            T = sum_q V c , share = V J / sum V J
/// Source     the internal forces of element.hpp, with d(ln J)/du_k = F^-T grad N_k
/// Input      depth: thickness, 1 in space; coordinates with one row a node
/// Returns    as ElementResult::status
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_invariance.cpp, test_finite_forces.cpp
template <int Dim, int N, int Q, class Nodal, class Vector>
[[nodiscard]] Status finite_forces(const PointTable<Dim, N, Q>& table, const material::Law& law,
                                   double depth, bool mean_dilatation, const Nodal& reference,
                                   const Nodal& displacement, const material::Memory& memory,
                                   Vector& force) {
  constexpr int C = Dim == 2 ? 4 : 6;
  PointMatrix<Dim, Q> slope, inverse, f, h, of_f;
  slopes(table, reference, slope);
  const Lanes<Q> determinant = cofactors(slope, inverse);  // of dX/dxi
  const Lanes<Q> volume = depth * table.weight * determinant, scale = 1 / determinant;
  for (Lanes<Q>& entry : inverse.entry) entry *= scale;  // dxi_j/dX_i at (i, j)
  slopes(table, displacement, slope);
  times_transposed(slope, inverse, h);
  f = h;
  for (int i = 0; i < Dim; ++i) f(i, i) += 1;
  const Lanes<Q> ratio = cofactors(f, of_f);
  if (!(ratio > 0).all()) return Status::inverted;
  Pointwise<C, Q> strain, stress;
  green_lagrange<Dim, Q>(h, strain);
  std::optional<OneRatio<Dim, Q>> mean;
  if (mean_dilatation) mean.emplace(volume, volume_change(h, of_f), strain);
  if (!material::stresses<C, Q>(law, strain, memory, stress)) return Status::material_failed;
  const Lanes<Q> weight = mean ? Lanes<Q>(volume * mean->m) : volume;
  PointMatrix<Dim, Q> s, pulled;
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) s(i, j) = weight * stress[component(i, j)];
  times_transposed(f, s, pulled);
  if (mean) {
    const Lanes<Q> factor = mean->pressed(volume, strain, stress) / ratio;  // of the cofactors
    for (std::size_t i = 0; i < pulled.entry.size(); ++i) pulled.entry[i] += factor * of_f.entry[i];
  }
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) {  // along xi
      slope(i, j) = pulled(i, 0) * inverse(0, j);
      for (int k = 1; k < Dim; ++k) slope(i, j) += pulled(i, k) * inverse(k, j);
    }
  force.resize(Dim * N);
  for (int k = 0; k < N; ++k)
    for (int i = 0; i < Dim; ++i) {
      Lanes<Q> sum = slope(i, 0) * table.d(k, 0);
      for (int j = 1; j < Dim; ++j) sum += slope(i, j) * table.d(k, j);
      force[Dim * k + i] = sum.sum();
    }
  return Status::ok;
}

}  // namespace osculate::solid
