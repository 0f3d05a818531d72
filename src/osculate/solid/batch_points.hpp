#pragma once
// The forces of several cells at once, in finite strain at all their points. For batch.cpp and
// batch_wide.cpp.
#include "osculate/solid/batch_kernels.hpp"

namespace osculate::solid::batches {

/// One Gauss point of a cell in finite strain.
template <int Dim, class Pack>
struct FinitePoint {
  Matrix<Dim, Pack> inverse;  ///< dxi_j/dX_i at (i, j)
  Matrix<Dim, Pack> f, of_f;  ///< deformation gradient; its cofactors, with the mean dilatation
  Pack volume, ratio;         ///< undeformed; det F
  Pack growth;                ///< det F - 1, with the mean dilatation
  Pack weight;                ///< of the stress that works on the change of B: V m
};
/// All of them.
template <int Dim, class Pack>
struct FinitePoints {
  static constexpr std::size_t count = std::size_t{1} << Dim;
  using Slopes = std::array<PointSlopes<Dim, Pack>, static_cast<std::size_t>(Dim)>;
  std::array<FinitePoint<Dim, Pack>, count> point;
  std::array<Strains<Dim, Pack>, count> strain, stress;
  Pack total, grown;  ///< sum V , sum V (J - 1), with the mean dilatation
};
template <int Dim, class Pack>
inline Matrix<Dim, Pack> slopes_at(const typename FinitePoints<Dim, Pack>::Slopes& slopes,
                                   std::size_t q) {
  Matrix<Dim, Pack> m;
  repeat<Dim>([&](auto i) { repeat<Dim>([&](auto j) { m(i(), j()) = slopes[i()].at(j(), q); }); });
  return m;
}
/// Without the mean dilatation nobody needs cofactors and growth.
template <bool Mean, int Dim, class Pack>
inline void set_point(const Matrix<Dim, Pack>& jacobian, const Matrix<Dim, Pack>& slope,
                      double depth, FinitePoint<Dim, Pack>& p, Strains<Dim, Pack>& strain) {
  const Pack determinant = cofactors(jacobian, p.inverse);
  p.volume = p.weight = depth * determinant;
  const Pack scale = 1 / determinant;
  repeat<Dim * Dim>([&](auto e) { p.inverse.entry[e()] *= scale; });
  Matrix<Dim, Pack> h;
  times_transposed(slope, p.inverse, h);
  p.f = h;
  repeat<Dim>([&](auto i) { p.f(i(), i()) += 1; });
  Matrix<Dim, Pack> of_f;
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
template <int Dim, class Pack>
inline void set_cell_slopes(const Pack* numbers, const Pack* u,
                            typename FinitePoints<Dim, Pack>::Slopes& reference,
                            typename FinitePoints<Dim, Pack>::Slopes& displacement) {
  constexpr int Q = static_cast<int>(FinitePoints<Dim, Pack>::count);
  Products<Dim, Pack> product;
  set_products<Dim, Pack>(u, product);
  repeat<Dim>([&](auto i) {
    OfCorners<Dim, Pack> of_reference;
    of_reference[0] = Pack::Zero();
    repeat<Q - 1>([&](auto m) {
      of_reference[m() + 1] = numbers[(Q - 1) * i() + m()];
      product[i()][m() + 1] *= Uniform<Dim, Pack>::share;
    });
    set_slopes<Dim>(of_reference, reference[i()]);
    set_slopes<Dim>(product[i()], displacement[i()]);
  });
}
/// Kinematics of finite_forces.hpp, where the formulas stand; false: turned inside out.
template <bool Mean, int Dim, class Pack>
[[nodiscard]] bool set_finite_points(double depth, const Pack* numbers, const Pack* u,
                                     FinitePoints<Dim, Pack>& out) {
  typename FinitePoints<Dim, Pack>::Slopes reference, displacement;
  set_cell_slopes<Dim, Pack>(numbers, u, reference, displacement);
  out.total = out.grown = Pack::Zero();
  typename Pack::Mask upright = Pack(1.0) > 0.0;
  for (std::size_t q = 0; q < out.point.size(); ++q) {
    FinitePoint<Dim, Pack>& p = out.point[q];
    set_point<Mean, Dim, Pack>(slopes_at<Dim, Pack>(reference, q),
                               slopes_at<Dim, Pack>(displacement, q), depth, p, out.strain[q]);
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
template <int Dim, class Pack>
inline void forces_of_slopes(typename FinitePoints<Dim, Pack>::Slopes& work, Pack* force) {
  repeat<Dim>([&](auto i) {
    OfCorners<Dim, Pack> v;
    for (Pack& value : v) value = Pack::Zero();
    add_transposed<Dim>(work[i()], v);
    for (Pack& value : v) value *= Uniform<Dim, Pack>::share;
    from_products(v);
    repeat<1 << Dim>([&](auto at) { force[Dim * corner_node<Dim>[at()] + i()] = v[at()]; });
  });
}

/// Adds what a point has to what works on the slopes.
template <int Dim, class Pack>
inline void add_pulled(const Matrix<Dim, Pack>& first_stress, const Matrix<Dim, Pack>& inverse,
                       std::size_t q, typename FinitePoints<Dim, Pack>::Slopes& work) {
  Matrix<Dim, Pack> slope;
  times(first_stress, inverse, slope);
  repeat<Dim>(
      [&](auto i) { repeat<Dim>([&](auto j) { work[i()].at(j(), q) += slope(i(), j()); }); });
}
template <int Dim, class Pack>
inline void clear(typename FinitePoints<Dim, Pack>::Slopes& work) {
  for (auto& of_direction : work)
    for (auto& along : of_direction.along) along.fill(Pack::Zero());
}

template <bool Mean, int Dim, class Pack, class Law>
[[nodiscard, gnu::flatten]] bool points_forces(const Law& law, double depth, const Pack* numbers,
                                               const Pack* u, Pack* force) {
  constexpr std::size_t Q = FinitePoints<Dim, Pack>::count;
  FinitePoints<Dim, Pack> cell;
  if (!set_finite_points<Mean, Dim, Pack>(depth, numbers, u, cell) ||
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
  typename FinitePoints<Dim, Pack>::Slopes work;
  clear<Dim, Pack>(work);
  for (std::size_t q = 0; q < Q; ++q) {
    const FinitePoint<Dim, Pack>& p = cell.point[q];
    Matrix<Dim, Pack> first_stress;
    weighted_first_stress(p.f, cell.stress[q], p.weight, first_stress);
    if constexpr (Mean) {
      const Pack pressed = 2.0 / 3 * (per_volume * p.volume * (1 + p.growth) - growing[q]);
      const Pack factor = pressed / p.ratio;  // of the cofactors
      repeat<Dim * Dim>([&](auto e) { first_stress.entry[e()] += factor * p.of_f.entry[e()]; });
    }
    add_pulled<Dim, Pack>(first_stress, p.inverse, q, work);
  }
  forces_of_slopes<Dim, Pack>(work, force);
  return true;
}

/// Stored energy of the points; false: turned inside out.
template <bool Mean, int Dim, class Pack>
[[nodiscard]] bool points_energy(const material::Law& law, double depth, const Pack* numbers,
                                 const Pack* u, Pack& energy) {
  FinitePoints<Dim, Pack> cell;
  if (!set_finite_points<Mean, Dim, Pack>(depth, numbers, u, cell)) return false;
  energy = Pack::Zero();
  for (std::size_t q = 0; q < cell.point.size(); ++q)
    energy +=
        cell.point[q].volume * material::stored_energies<components<Dim>>(law, cell.strain[q]);
  return true;
}

}  // namespace osculate::solid::batches
