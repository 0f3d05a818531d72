#pragma once
// The forces of four cells at once (batch.hpp). For batch.cpp.
#include <array>

#include "osculate/material/pointwise.hpp"
#include "osculate/solid/batch.hpp"
#include "osculate/solid/corner_modes.hpp"
#include "osculate/solid/finite_point.hpp"

namespace osculate::solid::batches {

using core::Pack;
template <int Dim>
using Matrix = PointMatrix<Dim, Pack>;
template <int Dim>
using Strains = std::array<Pack, static_cast<std::size_t>(components<Dim>)>;

/// The products beyond linear ones, as reduced.hpp counts them: without xi_a, and all three.
template <int Dim>
inline constexpr std::array<std::size_t, Dim == 2 ? 1 : 4> mode_product = {};
template <>
inline constexpr std::array<std::size_t, 1> mode_product<2> = {3};
template <>
inline constexpr std::array<std::size_t, 4> mode_product<3> = {6, 5, 3, 7};
template <int Dim>
inline constexpr int mode_count = Dim == 2 ? 1 : 4;

/// Numbers of a cell: its volume, the mean gradients dN_k/dX_j (at Dim k + j), and for quad4 and
/// hex8  h_a . X_j / 2^Dim  (at Dim a + j), before what the kind keeps besides.
template <int Dim>
struct Kept {
  const Pack* volume;
  const Pack* gradient;
  const Pack* slant;
  const Pack* more;
  Kept(const Pack* numbers, int nodes)
      : volume(numbers),
        gradient(volume + 1),
        slant(gradient + Dim * nodes),
        more(slant + Dim * mode_count<Dim>) {}
};

/// Mean displacement gradient du_i/dX_j.
template <int Dim, int Nodes>
inline void mean_gradient(const Pack* gradient, const Pack* u, Matrix<Dim>& h) {
  repeat<Dim>([&](auto i) {
    repeat<Dim>([&](auto j) {
      Pack sum = u[i()] * gradient[j()];
      repeat<Nodes - 1>([&](auto k) {
        sum += u[Dim * (k() + 1) + i()] * gradient[Dim * (k() + 1) + j()];
      });
      h(i(), j()) = sum;
    });
  });
}

/// Factors of the products of coordinates in the displacements, times 2^Dim.
template <int Dim>
using Products = std::array<OfCorners<Dim, Pack>, static_cast<std::size_t>(Dim)>;
template <int Dim>
inline void set_products(const Pack* u, Products<Dim>& out) {
  repeat<Dim>([&](auto i) {
    repeat<1 << Dim>([&](auto c) { out[i()][c()] = u[Dim * corner_node<Dim>[c()] + i()]; });
    to_products(out[i()]);
  });
}

/// What a mean displacement gradient and the modes that it does not see do.
template <int Dim>
struct Uniform {
  static constexpr int modes = mode_count<Dim>;
  static constexpr double share = 1.0 / (1 << Dim);
  Products<Dim> product;
  Matrix<Dim> h;
  std::array<Pack, static_cast<std::size_t>(Dim* modes)> q;  ///< gamma_a . u_i at Dim a + i
};
template <int Dim>
inline void measure(const Kept<Dim>& kept, const Pack* u, Uniform<Dim>& out) {
  set_products<Dim>(u, out.product);
  mean_gradient<Dim, 1 << Dim>(kept.gradient, u, out.h);
  repeat<mode_count<Dim>>([&](auto a) {
    repeat<Dim>([&](auto i) {
      Pack sum = Uniform<Dim>::share * out.product[i()][mode_product<Dim>[a()]];
      repeat<Dim>([&](auto j) { sum -= kept.slant[Dim * a() + j()] * out.h(i(), j()); });
      out.q[Dim * a() + i()] = sum;
    });
  });
}
/// Forces of what works on the gradient (volume included), on the modes and on the linear products
/// (share included).
template <int Dim>
inline void spread(const Kept<Dim>& kept, Matrix<Dim>& on_gradient,
                   const decltype(Uniform<Dim>::q)& on_mode, const Matrix<Dim>* on_linear,
                   Pack* force) {
  constexpr double share = Uniform<Dim>::share;
  repeat<mode_count<Dim>>([&](auto a) {
    repeat<Dim>([&](auto i) {
      repeat<Dim>([&](auto j) {
        on_gradient(i(), j()) -= on_mode[Dim * a() + i()] * kept.slant[Dim * a() + j()];
      });
    });
  });
  repeat<Dim>([&](auto i) {
    OfCorners<Dim, Pack> v;
    v[0] = Pack::Zero();
    repeat<Dim>([&](auto j) {
      v[std::size_t{1} << j()] = on_linear ? share * (*on_linear)(i(), j()) : Pack::Zero();
    });
    repeat<mode_count<Dim>>([&](auto a) {
      v[mode_product<Dim>[a()]] = share * on_mode[Dim * a() + i()];
    });
    from_products(v);
    repeat<1 << Dim>([&](auto c) {
      constexpr int k = corner_node<Dim>[c()];
      Pack sum = v[c()];
      repeat<Dim>([&](auto j) { sum += on_gradient(i(), j()) * kept.gradient[Dim * k + j()]; });
      force[Dim * k + i()] = sum;
    });
  });
}

/// Small strain of a displacement gradient.
template <int Dim>
inline void small_strain(const Matrix<Dim>& h, Strains<Dim>& e) {
  e[2] = Pack::Zero();
  for (int i = 0; i < Dim; ++i) {
    e[component(i, i)] = h(i, i);
    for (int j = i + 1; j < Dim; ++j) e[component(i, j)] = h(i, j) + h(j, i);
  }
}

/// Weighted stress that works on the gradient at one point; false: no answer.
template <int Dim>
[[nodiscard]] inline bool work_on_gradient(const Section<Dim>& section, const Matrix<Dim>& h,
                                           const Pack& volume, Matrix<Dim>& out) {
  Strains<Dim> strain, stress;
  Matrix<Dim> f = h;
  const bool finite = section.kinematics == Kinematics::finite;
  if (finite) {
    for (int i = 0; i < Dim; ++i) f(i, i) += 1;
    Matrix<Dim> cofactor;
    if (!core::everywhere(cofactors(f, cofactor) > 0)) return false;
    green_lagrange(h, strain);
  } else {
    small_strain<Dim>(h, strain);
  }
  if (!material::stresses<components<Dim>>(section.law, strain, stress)) return false;
  if (finite) {
    weighted_first_stress(f, stress, volume, out);
    return true;
  }
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) out(i, j) = volume * stress[component(i, j)];
  return true;
}

template <int Dim>
void linear_forces(const Batch<Dim>& batch, const Pack* numbers, const Pack* u, Pack* force) {
  constexpr int C = components<Dim>, M = Dim * mode_count<Dim>;
  const Kept<Dim> kept(numbers, 1 << Dim);
  Uniform<Dim> at;
  measure(kept, u, at);
  Strains<Dim> strain, stress;
  small_strain<Dim>(at.h, strain);
  for (int i = 0; i < C; ++i) {
    Pack sum = batch.stiffness(i, 0) * strain[0];
    for (int j = 1; j < C; ++j) sum += batch.stiffness(i, j) * strain[static_cast<std::size_t>(j)];
    stress[static_cast<std::size_t>(i)] = *kept.volume * sum;
  }
  Matrix<Dim> on_gradient;
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) on_gradient(i, j) = stress[component(i, j)];
  std::array<Pack, M> w;
  const Pack* k = kept.more;  // the upper triangle, row by row
  repeat<M>([&](auto r) { w[r()] = Pack::Zero(); });
  repeat<M>([&](auto r) {
    Pack sum = w[r()] + *k++ * at.q[r()];
    repeat<M>([&](auto c) {
      if constexpr (c() > r()) {
        const Pack value = *k++;
        sum += value * at.q[c()];
        w[c()] += value * at.q[r()];
      }
    });
    w[r()] = sum;
  });
  spread<Dim>(kept, on_gradient, w, nullptr, force);
}

/// What the modes of reduced.hpp do: see there for the energy.
///
/// Input      base: g_i in columns; inverse: 1/|G_i|^2; along: E' V, shear: mu V
/// Returns    what works on q_a (at Dim a + i); what works on g_i, in columns
template <int Dim>
inline void mode_work(const decltype(Uniform<Dim>::q)& q, const Matrix<Dim>& base,
                      const Pack* inverse, const Pack& along, const Pack& shear,
                      decltype(Uniform<Dim>::q)& on_mode, Matrix<Dim>& on_base) {
  constexpr int M = mode_count<Dim>;
  std::array<std::array<Pack, Dim>, M> s;  // Q_ai, then what works on them
  repeat<M>([&](auto a) {
    repeat<Dim>([&](auto i) {
      Pack sum = q[Dim * a()] * base(0, i());
      repeat<Dim - 1>([&](auto k) { sum += q[Dim * a() + k() + 1] * base(k() + 1, i()); });
      s[a()][i()] = sum;
    });
  });
  std::array<Pack, Dim> diagonal;
  if constexpr (Dim == 3)
    repeat<3>([&](auto i) { diagonal[i()] = s[i()][i()]; });
  repeat<Dim>([&](auto i) {
    const Pack weight = along * inverse[i()] * inverse[i()];
    repeat<M>([&](auto a) {
      if constexpr (Dim == 2 || a() != i()) s[a()][i()] *= weight * (a() == 3 ? 1.0 / 9 : 1.0 / 3);
    });
  });
  if constexpr (Dim == 3) {
    std::array<Pack, 3> t;
    repeat<3>([&](auto i) {
      constexpr std::size_t j = (i() + 1) % 3;
      t[i()] = 1.0 / 3 * shear * inverse[i()] * inverse[j] * (diagonal[i()] + diagonal[j]);
    });
    repeat<3>([&](auto i) { s[i()][i()] = t[i()] + t[(i() + 2) % 3]; });
  }
  repeat<M>([&](auto a) {
    repeat<Dim>([&](auto k) {
      Pack sum = s[a()][0] * base(k(), 0);
      repeat<Dim - 1>([&](auto i) { sum += s[a()][i() + 1] * base(k(), i() + 1); });
      on_mode[Dim * a() + k()] = sum;
    });
  });
  repeat<Dim>([&](auto k) {
    repeat<Dim>([&](auto i) {
      Pack sum = s[0][i()] * q[k()];
      repeat<M - 1>([&](auto a) { sum += s[a() + 1][i()] * q[Dim * (a() + 1) + k()]; });
      on_base(k(), i()) = sum;
    });
  });
}

/// Input      along, shear: E' and mu, as reduced.hpp has them
template <int Dim>
[[nodiscard]] bool one_point_forces(const Batch<Dim>& batch, double along, double shear,
                                    const Pack* numbers, const Pack* u, Pack* force) {
  const Kept<Dim> kept(numbers, 1 << Dim);
  Uniform<Dim> at;
  measure(kept, u, at);
  Matrix<Dim> on_gradient, base, on_base;
  if (!work_on_gradient<Dim>(batch.section, at.h, *kept.volume, on_gradient)) return false;
  const bool finite = batch.section.kinematics == Kinematics::finite;
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) base(i, j) = kept.more[Dim * i + j];
  if (finite)
    repeat<Dim>([&](auto i) {
      repeat<Dim>([&](auto j) {
        base(i(), j()) += Uniform<Dim>::share * at.product[i()][std::size_t{1} << j()];
      });
    });
  decltype(at.q) on_mode;
  mode_work<Dim>(at.q, base, kept.more + Dim * Dim, along * *kept.volume, shear * *kept.volume,
                 on_mode, on_base);
  spread<Dim>(kept, on_gradient, on_mode, finite ? &on_base : nullptr, force);
  return true;
}

template <int Dim>
[[nodiscard]] bool simplex_forces(const Batch<Dim>& batch, const Pack* numbers, const Pack* u,
                                  Pack* force) {
  const Kept<Dim> kept(numbers, Dim + 1);
  Matrix<Dim> h, work;
  mean_gradient<Dim, Dim + 1>(kept.gradient, u, h);
  if (!work_on_gradient<Dim>(batch.section, h, *kept.volume, work)) return false;
  for (int k = 0; k <= Dim; ++k)
    for (int i = 0; i < Dim; ++i) {
      Pack sum = work(i, 0) * kept.gradient[Dim * k];
      for (int j = 1; j < Dim; ++j) sum += work(i, j) * kept.gradient[Dim * k + j];
      force[Dim * k + i] = sum;
    }
  return true;
}

/// One Gauss point of a cell in finite strain.
template <int Dim>
struct FinitePoint {
  Matrix<Dim> inverse;  ///< dxi_j/dX_i at (i, j)
  Matrix<Dim> f, of_f;  ///< deformation gradient, its cofactors
  Pack volume, ratio;   ///< undeformed; det F
  Pack growth;          ///< det F - 1
  Strains<Dim> strain, stress;
};
template <int Dim>
inline void set_point(const Matrix<Dim>& jacobian, const Matrix<Dim>& slope, double depth,
                      bool with_growth, FinitePoint<Dim>& p) {
  const Pack determinant = cofactors(jacobian, p.inverse);
  p.volume = depth * determinant;
  const Pack scale = 1 / determinant;
  for (Pack& entry : p.inverse.entry) entry *= scale;
  Matrix<Dim> h;
  times_transposed(slope, p.inverse, h);
  p.f = h;
  for (int i = 0; i < Dim; ++i) p.f(i, i) += 1;
  p.ratio = cofactors(p.f, p.of_f);
  green_lagrange(h, p.strain);
  if (with_growth) p.growth = volume_change(h, p.of_f);
}

/// As finite_forces.hpp, where the formulas stand.
template <int Dim>
[[nodiscard]] bool points_forces(const Batch<Dim>& batch, double depth, const Pack* numbers,
                                 const Pack* u, Pack* force) {
  constexpr std::size_t Q = std::size_t{1} << Dim;
  constexpr double share = Uniform<Dim>::share;
  const bool mean = batch.section.formulation == Formulation::bbar;
  std::array<PointSlopes<Dim, Pack>, Dim> reference, displacement;
  Products<Dim> product;
  set_products<Dim>(u, product);
  repeat<Dim>([&](auto i) {
    OfCorners<Dim, Pack> of_reference;
    of_reference[0] = Pack::Zero();
    repeat<static_cast<int>(Q) - 1>([&](auto m) {
      of_reference[m() + 1] = numbers[(static_cast<int>(Q) - 1) * i() + m()];
      product[i()][m() + 1] *= share;
    });
    set_slopes<Dim>(of_reference, reference[i()]);
    set_slopes<Dim>(product[i()], displacement[i()]);
  });
  std::array<FinitePoint<Dim>, Q> point;
  Pack total = Pack::Zero(), grown = Pack::Zero();
  for (std::size_t q = 0; q < Q; ++q) {
    Matrix<Dim> jacobian, slope;
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) {
        jacobian(i, j) = reference[static_cast<std::size_t>(i)].at(j, q);
        slope(i, j) = displacement[static_cast<std::size_t>(i)].at(j, q);
      }
    FinitePoint<Dim>& p = point[q];
    set_point<Dim>(jacobian, slope, depth, mean, p);
    if (!core::everywhere(p.ratio > 0)) return false;
    if (!mean) continue;
    total += p.volume;
    grown += p.volume * p.growth;
  }
  const Pack of_mean = mean ? grown / total : Pack::Zero();
  std::array<Pack, Q> weight, c;
  Pack sum = Pack::Zero();
  for (std::size_t q = 0; q < Q; ++q) {
    FinitePoint<Dim>& p = point[q];
    weight[q] = p.volume;
    if (mean) {
      const VolumeRatio<Pack> ratio(of_mean, p.growth);
      ratio.apply(p.strain);
      weight[q] *= ratio.m;
    }
    if (!material::stresses<components<Dim>>(batch.section.law, p.strain, p.stress)) return false;
    if (!mean) continue;
    c[q] = p.volume * work_of_growth(p.strain, p.stress);
    sum += c[q];
  }
  const Pack per_volume = mean ? sum / (total + grown) : Pack::Zero();
  for (std::size_t q = 0; q < Q; ++q) {
    FinitePoint<Dim>& p = point[q];
    Matrix<Dim> pulled, slope;
    weighted_first_stress(p.f, p.stress, weight[q], pulled);
    if (mean) {
      const Pack factor =
          2.0 / 3 * (per_volume * p.volume * (1 + p.growth) - c[q]) / p.ratio;  // of the cofactors
      for (std::size_t i = 0; i < pulled.entry.size(); ++i)
        pulled.entry[i] += factor * p.of_f.entry[i];
    }
    times(pulled, p.inverse, slope);
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) {
        Pack& at = displacement[static_cast<std::size_t>(i)].at(j, q);  // no longer needed
        // the points that differ in xi_j alone come one after the other
        at = (q >> j & 1U) == 0 ? slope(i, j) : at + slope(i, j);
      }
  }
  repeat<Dim>([&](auto i) {
    OfCorners<Dim, Pack> v;
    for (Pack& value : v) value = Pack::Zero();
    add_transposed<Dim>(displacement[i()], v);
    repeat<static_cast<int>(Q)>([&](auto m) { v[m()] *= share; });
    from_products(v);
    repeat<static_cast<int>(Q)>(
        [&](auto at) { force[Dim * corner_node<Dim>[at()] + i()] = v[at()]; });
  });
  return true;
}

}  // namespace osculate::solid::batches
