#pragma once
// Forces alone of finite strain, without strain matrices and tangents: for whoever needs many of
// them, such as explicit time integration. The points of a cell are taken together, several in one
// operation of the processor. For sources of this layer.
#include <array>
#include <cmath>
#include <optional>

#include "osculate/material/pointwise.hpp"
#include "osculate/solid/element.hpp"
#include "osculate/solid/finite_point.hpp"

namespace osculate::solid {

using material::Lanes;
using material::Pointwise;

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
void slopes(const PointTable<Dim, N, Q>& table, const Nodal& x, PointMatrix<Dim, Lanes<Q>>& out) {
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) {
      Lanes<Q> sum = x(0, i) * table.d(0, j);
      for (int k = 1; k < N; ++k) sum += x(k, i) * table.d(k, j);
      out(i, j) = sum;
    }
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
    const VolumeRatio<Lanes<Q>> ratio(mean, growth);
    m = ratio.m;
    ratio.apply(strain);
    share = volume * (1 + growth) / (total + grown);
  }
  /// V times the factor of F^-T grad N_k.
  [[nodiscard]] Lanes<Q> pressed(const Lanes<Q>& volume, const Pointwise<C, Q>& strain,
                                 const Pointwise<C, Q>& stress) const {
    Lanes<Q> c = work_of_growth(strain, stress);
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
  PointMatrix<Dim, Lanes<Q>> slope, inverse, f, h, of_f;
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
  green_lagrange(h, strain);
  std::optional<OneRatio<Dim, Q>> mean;
  if (mean_dilatation) mean.emplace(volume, volume_change(h, of_f), strain);
  if (!material::stresses<C, Q>(law, strain, memory, stress)) return Status::material_failed;
  const Lanes<Q> weight = mean ? Lanes<Q>(volume * mean->m) : volume;
  PointMatrix<Dim, Lanes<Q>> pulled;
  weighted_first_stress(f, stress, weight, pulled);
  if (mean) {
    const Lanes<Q> factor = mean->pressed(volume, strain, stress) / ratio;  // of the cofactors
    for (std::size_t i = 0; i < pulled.entry.size(); ++i) pulled.entry[i] += factor * of_f.entry[i];
  }
  times(pulled, inverse, slope);  // along xi
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
