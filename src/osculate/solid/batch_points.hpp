#pragma once
// The forces of four cells at once, in finite strain at all their points. For batch.cpp.
#include "osculate/solid/batch_kernels.hpp"

namespace osculate::solid::batches {

/// One Gauss point of a cell in finite strain.
template <int Dim>
struct FinitePoint {
  Matrix<Dim> inverse;  ///< dxi_j/dX_i at (i, j)
  Matrix<Dim> f, of_f;  ///< deformation gradient; its cofactors, with the mean dilatation
  Pack volume, ratio;   ///< undeformed; det F
  Pack growth;          ///< det F - 1, with the mean dilatation
  Pack weight;          ///< of the stress that works on the change of B: V m
};
/// All of them.
template <int Dim>
struct FinitePoints {
  static constexpr std::size_t count = std::size_t{1} << Dim;
  using Slopes = std::array<PointSlopes<Dim, Pack>, static_cast<std::size_t>(Dim)>;
  std::array<FinitePoint<Dim>, count> point;
  std::array<Strains<Dim>, count> strain, stress;
  Pack total, grown;  ///< sum V , sum V (J - 1), with the mean dilatation
};
template <int Dim>
inline Matrix<Dim> slopes_at(const typename FinitePoints<Dim>::Slopes& slopes, std::size_t q) {
  Matrix<Dim> m;
  repeat<Dim>([&](auto i) { repeat<Dim>([&](auto j) { m(i(), j()) = slopes[i()].at(j(), q); }); });
  return m;
}
/// Without the mean dilatation nobody needs cofactors and growth.
template <bool Mean, int Dim>
inline void set_point(const Matrix<Dim>& jacobian, const Matrix<Dim>& slope, double depth,
                      FinitePoint<Dim>& p, Strains<Dim>& strain) {
  const Pack determinant = cofactors(jacobian, p.inverse);
  p.volume = p.weight = depth * determinant;
  const Pack scale = 1 / determinant;
  repeat<Dim * Dim>([&](auto e) { p.inverse.entry[e()] *= scale; });
  Matrix<Dim> h;
  times_transposed(slope, p.inverse, h);
  p.f = h;
  repeat<Dim>([&](auto i) { p.f(i(), i()) += 1; });
  Matrix<Dim> of_f;
  p.ratio = cofactors(p.f, of_f);
  green_lagrange(h, strain);
  if constexpr (Mean) {
    p.growth = volume_change(h, of_f);
    p.of_f = of_f;
  }
}
/// Slopes of reference and displacements.
///
/// Input      numbers: factors of the products of coordinates in X, but the constant ones
template <int Dim>
inline void set_cell_slopes(const Pack* numbers, const Pack* u,
                            typename FinitePoints<Dim>::Slopes& reference,
                            typename FinitePoints<Dim>::Slopes& displacement) {
  constexpr int Q = static_cast<int>(FinitePoints<Dim>::count);
  Products<Dim> product;
  set_products<Dim>(u, product);
  repeat<Dim>([&](auto i) {
    OfCorners<Dim, Pack> of_reference;
    of_reference[0] = Pack::Zero();
    repeat<Q - 1>([&](auto m) {
      of_reference[m() + 1] = numbers[(Q - 1) * i() + m()];
      product[i()][m() + 1] *= Uniform<Dim>::share;
    });
    set_slopes<Dim>(of_reference, reference[i()]);
    set_slopes<Dim>(product[i()], displacement[i()]);
  });
}
/// Kinematics of finite_forces.hpp, where the formulas stand; false: turned inside out.
template <bool Mean, int Dim>
[[nodiscard]] bool set_finite_points(double depth, const Pack* numbers, const Pack* u,
                                     FinitePoints<Dim>& out) {
  typename FinitePoints<Dim>::Slopes reference, displacement;
  set_cell_slopes<Dim>(numbers, u, reference, displacement);
  out.total = out.grown = Pack::Zero();
  Pack::Mask upright = Pack(1.0) > 0.0;
  for (std::size_t q = 0; q < out.point.size(); ++q) {
    FinitePoint<Dim>& p = out.point[q];
    set_point<Mean, Dim>(slopes_at<Dim>(reference, q), slopes_at<Dim>(displacement, q), depth, p,
                         out.strain[q]);
    upright = upright && p.ratio > 0;
    if constexpr (Mean) {
      out.total += p.volume;
      out.grown += p.volume * p.growth;
    }
  }
  if (!core::everywhere(upright)) return false;
  if constexpr (Mean) {
    const Pack mean = out.grown / out.total;
    for (std::size_t q = 0; q < out.point.size(); ++q) {
      const VolumeRatio<Pack> ratio(mean, out.point[q].growth);
      ratio.apply(out.strain[q]);
      out.point[q].weight *= ratio.m;
    }
  }
  return true;
}
/// Forces of what works on the slopes along xi.
template <int Dim>
inline void forces_of_slopes(typename FinitePoints<Dim>::Slopes& work, Pack* force) {
  repeat<Dim>([&](auto i) {
    OfCorners<Dim, Pack> v;
    for (Pack& value : v) value = Pack::Zero();
    add_transposed<Dim>(work[i()], v);
    for (Pack& value : v) value *= Uniform<Dim>::share;
    from_products(v);
    repeat<1 << Dim>([&](auto at) { force[Dim * corner_node<Dim>[at()] + i()] = v[at()]; });
  });
}

/// Adds what a point has to what works on the slopes.
template <int Dim>
inline void add_pulled(const Matrix<Dim>& first_stress, const Matrix<Dim>& inverse, std::size_t q,
                       typename FinitePoints<Dim>::Slopes& work) {
  Matrix<Dim> slope;
  times(first_stress, inverse, slope);
  repeat<Dim>(
      [&](auto i) { repeat<Dim>([&](auto j) { work[i()].at(j(), q) += slope(i(), j()); }); });
}
template <int Dim>
inline void clear(typename FinitePoints<Dim>::Slopes& work) {
  for (auto& of_direction : work)
    for (auto& along : of_direction.along) along.fill(Pack::Zero());
}

template <bool Mean, int Dim>
[[nodiscard, gnu::flatten]] bool points_forces(const material::Law& law, double depth,
                                               const Pack* numbers, const Pack* u, Pack* force) {
  constexpr std::size_t Q = FinitePoints<Dim>::count;
  FinitePoints<Dim> cell;
  if (!set_finite_points<Mean>(depth, numbers, u, cell) ||
      !material::stresses<components<Dim>>(law, Q, cell.strain.data(), cell.stress.data()))
    return false;
  std::array<Pack, Q> growing;  // V c
  Pack per_volume = Pack::Zero();
  if constexpr (Mean) {
    for (std::size_t q = 0; q < Q; ++q) {
      growing[q] = cell.point[q].volume * work_of_growth(cell.strain[q], cell.stress[q]);
      per_volume += growing[q];
    }
    per_volume = per_volume / (cell.total + cell.grown);
  }
  typename FinitePoints<Dim>::Slopes work;
  clear<Dim>(work);
  for (std::size_t q = 0; q < Q; ++q) {
    const FinitePoint<Dim>& p = cell.point[q];
    Matrix<Dim> first_stress;
    weighted_first_stress(p.f, cell.stress[q], p.weight, first_stress);
    if constexpr (Mean) {
      const Pack pressed = 2.0 / 3 * (per_volume * p.volume * (1 + p.growth) - growing[q]);
      const Pack factor = pressed / p.ratio;  // of the cofactors
      repeat<Dim * Dim>([&](auto e) { first_stress.entry[e()] += factor * p.of_f.entry[e()]; });
    }
    add_pulled<Dim>(first_stress, p.inverse, q, work);
  }
  forces_of_slopes<Dim>(work, force);
  return true;
}

/// Stored energy of the points; false: turned inside out.
template <bool Mean, int Dim>
[[nodiscard]] bool points_energy(const material::Law& law, double depth, const Pack* numbers,
                                 const Pack* u, Pack& energy) {
  FinitePoints<Dim> cell;
  if (!set_finite_points<Mean>(depth, numbers, u, cell)) return false;
  energy = Pack::Zero();
  for (std::size_t q = 0; q < cell.point.size(); ++q)
    energy +=
        cell.point[q].volume * material::stored_energies<components<Dim>>(law, cell.strain[q]);
  return true;
}

}  // namespace osculate::solid::batches
