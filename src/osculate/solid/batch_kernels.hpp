#pragma once
// The forces of several cells at once (batch.hpp), as many as a Pack has numbers. For batch.cpp and
// batch_wide.cpp.
#include <array>

#include "osculate/material/pointwise.hpp"
#include "osculate/solid/batch.hpp"
#include "osculate/solid/corner_modes.hpp"
#include "osculate/solid/finite_point.hpp"

namespace osculate::solid::batches {

template <int Dim, class Pack>
using Matrix = PointMatrix<Dim, Pack>;
template <int Dim, class Pack>
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

/// Factors of the products of coordinates in X: numbers of a quad4 or hex8, direction by direction,
/// but the constant ones.
template <int Dim, class Pack>
struct Factors {
  const Pack* numbers;
  const Pack& operator()(std::size_t product, int i) const {
    return numbers[((1 << Dim) - 1) * i + static_cast<int>(product) - 1];
  }
  /// Those behind them, which the kind keeps besides.
  [[nodiscard]] const Pack* more() const { return numbers + Dim * ((1 << Dim) - 1); }
};

/// Mean gradients of the products over a cell, and its volume. The product of all coordinates has
/// none.
///
/// Formula    b_m = dV/dc_m / V ; V = 4 t c_1 x c_2 , in space
///            V = 8 (c_1 . c_2 x c_3 + (c_1 . c_12 x c_13 + c_2 . c_23 x c_12 + c_3 . c_13 x c_23)
///            / 3)
/// Source     V is the integral of det dX/dxi
template <int Dim, class Pack>
struct MeanSlopes {
  static constexpr int count = (1 << Dim) - 2;  ///< from product 1 on
  std::array<std::array<Pack, static_cast<std::size_t>(Dim)>, count + 1> of;
  Pack volume;
};
template <class Pack>
inline void set_mean_slopes(const Factors<2, Pack>& c, double depth, MeanSlopes<2, Pack>& out) {
  const Pack area = c(1, 0) * c(2, 1) - c(1, 1) * c(2, 0), scale = 1 / area;
  out.volume = 4 * depth * area;
  out.of[1] = {scale * c(2, 1), -scale * c(2, 0)};
  out.of[2] = {-scale * c(1, 1), scale * c(1, 0)};
}
template <class Pack>
inline void set_mean_slopes(const Factors<3, Pack>& c, double depth, MeanSlopes<3, Pack>& out) {
  repeat<3>([&](auto axis) {
    constexpr std::size_t i = 1U << axis(), j = 1U << (axis() + 1) % 3, k = 1U << (axis() + 2) % 3;
    repeat<3>([&](auto row) {
      constexpr int p = (row() + 1) % 3, q = (row() + 2) % 3;
      const auto cross = [&](std::size_t m, std::size_t n) {
        return c(m, p) * c(n, q) - c(m, q) * c(n, p);
      };
      out.of[i][row()] = cross(j, k) + 1.0 / 3 * cross(i | j, k | i);
      out.of[j | k][row()] = 1.0 / 3 * (cross(i | j, j) + cross(k, k | i));
    });
  });
  Pack eighth = Pack::Zero();
  repeat<3>([&](auto i) { eighth += c(1, i()) * out.of[1][i()] + c(6, i()) * out.of[6][i()]; });
  out.volume = 8 * depth * eighth;
  const Pack scale = 1 / eighth;
  repeat<6>([&](auto m) { repeat<3>([&](auto i) { out.of[m() + 1][i()] *= scale; }); });
}

/// Factors of the products of coordinates in the displacements, times 2^Dim.
template <int Dim, class Pack>
using Products = std::array<OfCorners<Dim, Pack>, static_cast<std::size_t>(Dim)>;
template <int Dim, class Pack>
inline void set_products(const Pack* u, Products<Dim, Pack>& out) {
  repeat<Dim>([&](auto i) {
    repeat<1 << Dim>([&](auto c) { out[i()][c()] = u[Dim * corner_node<Dim>[c()] + i()]; });
    to_products(out[i()]);
  });
}

/// What a mean displacement gradient and the modes that it does not see do.
template <int Dim, class Pack>
struct Uniform {
  static constexpr int modes = mode_count<Dim>;
  static constexpr double share = 1.0 / (1 << Dim);
  MeanSlopes<Dim, Pack> mean;
  Products<Dim, Pack> product;
  Matrix<Dim, Pack> h;
  std::array<Pack, static_cast<std::size_t>(Dim* modes)> q;  ///< gamma_a . u_i at Dim a + i
};
template <int Dim, class Pack>
inline void measure(const Factors<Dim, Pack>& c, double depth, const Pack* u,
                    Uniform<Dim, Pack>& out) {
  set_mean_slopes(c, depth, out.mean);
  set_products<Dim, Pack>(u, out.product);
  repeat<Dim>([&](auto i) {
    repeat<Dim>([&](auto j) {
      Pack sum = out.product[i()][1] * out.mean.of[1][j()];
      repeat<MeanSlopes<Dim, Pack>::count - 1>(
          [&](auto m) { sum += out.product[i()][m() + 2] * out.mean.of[m() + 2][j()]; });
      out.h(i(), j()) = Uniform<Dim, Pack>::share * sum;
    });
  });
  repeat<mode_count<Dim>>([&](auto a) {
    repeat<Dim>([&](auto i) {
      Pack sum = Uniform<Dim, Pack>::share * out.product[i()][mode_product<Dim>[a()]];
      repeat<Dim>([&](auto j) { sum -= c(mode_product<Dim>[a()], j()) * out.h(i(), j()); });
      out.q[Dim * a() + i()] = sum;
    });
  });
}
/// Forces of what works on the gradient (volume included), on the modes and on the linear products.
template <int Dim, class Pack>
inline void spread(const Factors<Dim, Pack>& c, const MeanSlopes<Dim, Pack>& mean,
                   Matrix<Dim, Pack>& on_gradient, const decltype(Uniform<Dim, Pack>::q)& on_mode,
                   const Matrix<Dim, Pack>* on_linear, Pack* force) {
  repeat<mode_count<Dim>>([&](auto a) {
    repeat<Dim>([&](auto i) {
      repeat<Dim>([&](auto j) {
        on_gradient(i(), j()) -= on_mode[Dim * a() + i()] * c(mode_product<Dim>[a()], j());
      });
    });
  });
  repeat<Dim>([&](auto i) {
    OfCorners<Dim, Pack> v;
    v.front() = v.back() = Pack::Zero();
    repeat<MeanSlopes<Dim, Pack>::count>([&](auto m) {
      Pack sum = on_gradient(i(), 0) * mean.of[m() + 1][0];
      repeat<Dim - 1>(
          [&](auto j) { sum += on_gradient(i(), j() + 1) * mean.of[m() + 1][j() + 1]; });
      v[m() + 1] = sum;
    });
    if (on_linear) repeat<Dim>([&](auto j) { v[std::size_t{1} << j()] += (*on_linear)(i(), j()); });
    repeat<mode_count<Dim>>([&](auto a) { v[mode_product<Dim>[a()]] += on_mode[Dim * a() + i()]; });
    repeat<(1 << Dim) - 1>([&](auto m) { v[m() + 1] *= Uniform<Dim, Pack>::share; });
    from_products(v);
    repeat<1 << Dim>([&](auto at) { force[Dim * corner_node<Dim>[at()] + i()] = v[at()]; });
  });
}

/// Small strain of a displacement gradient.
template <int Dim, class Pack>
inline void small_strain(const Matrix<Dim, Pack>& h, Strains<Dim, Pack>& e) {
  e[2] = Pack::Zero();
  for (int i = 0; i < Dim; ++i) {
    e[component(i, i)] = h(i, i);
    for (int j = i + 1; j < Dim; ++j) e[component(i, j)] = h(i, j) + h(j, i);
  }
}

/// Weighted stress that works on the gradient at one point; false: no answer.
template <int Dim, class Pack, class Law>
[[nodiscard]] inline bool work_on_gradient(const Law& law, bool finite, const Matrix<Dim, Pack>& h,
                                           const Pack& volume, Matrix<Dim, Pack>& out) {
  Strains<Dim, Pack> strain, stress;
  Matrix<Dim, Pack> f = h;
  if (finite) {
    for (int i = 0; i < Dim; ++i) f(i, i) += 1;
    Matrix<Dim, Pack> cofactor;
    if (!core::everywhere(cofactors(f, cofactor) > 0)) return false;
    green_lagrange(h, strain);
  } else {
    small_strain<Dim, Pack>(h, strain);
  }
  if (!material::stresses<components<Dim>>(law, 1, &strain, &stress)) return false;
  if (finite) {
    weighted_first_stress(f, stress, volume, out);
    return true;
  }
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) out(i, j) = volume * stress[component(i, j)];
  return true;
}

template <int Dim, class Pack>
[[gnu::flatten]] void linear_forces(const Batch<Dim>& batch, double depth, const Pack* numbers,
                                    const Pack* u, Pack* force) {
  constexpr int C = components<Dim>, M = Dim * mode_count<Dim>;
  const Factors<Dim, Pack> c{numbers};
  Uniform<Dim, Pack> at;
  measure(c, depth, u, at);
  Strains<Dim, Pack> strain, stress;
  small_strain<Dim, Pack>(at.h, strain);
  for (int i = 0; i < C; ++i) {
    Pack sum = batch.stiffness(i, 0) * strain[0];
    for (int j = 1; j < C; ++j) sum += batch.stiffness(i, j) * strain[static_cast<std::size_t>(j)];
    stress[static_cast<std::size_t>(i)] = at.mean.volume * sum;
  }
  Matrix<Dim, Pack> on_gradient;
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) on_gradient(i, j) = stress[component(i, j)];
  std::array<Pack, M> w;
  const Pack* k = c.more();  // the upper triangle, row by row
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
  spread<Dim, Pack>(c, at.mean, on_gradient, w, nullptr, force);
}

/// What the modes of reduced.hpp do: see there for the energy.
///
/// Input      base: g_i in columns; inverse: 1/|G_i|^2; along: E' V, shear: mu V
/// Returns    what works on q_a (at Dim a + i); what works on g_i, in columns
template <int Dim, class Pack>
inline void mode_work(const decltype(Uniform<Dim, Pack>::q)& q, const Matrix<Dim, Pack>& base,
                      const Pack* inverse, const Pack& along, const Pack& shear,
                      decltype(Uniform<Dim, Pack>::q)& on_mode, Matrix<Dim, Pack>& on_base) {
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
  if constexpr (Dim == 3) repeat<3>([&](auto i) { diagonal[i()] = s[i()][i()]; });
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

/// Input      moduli: E' and mu, as reduced.hpp has them
template <int Dim, class Pack>
inline void one_point_modes(bool finite, const std::array<double, 2>& moduli,
                            const Factors<Dim, Pack>& c, const Uniform<Dim, Pack>& at,
                            decltype(Uniform<Dim, Pack>::q)& on_mode, Matrix<Dim, Pack>& on_base) {
  Matrix<Dim, Pack> base;
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) base(i, j) = c(std::size_t{1} << static_cast<unsigned>(j), i);
  std::array<Pack, Dim> inverse;
  for (int j = 0; j < Dim; ++j) {
    Pack square = base(0, j) * base(0, j);
    for (int i = 1; i < Dim; ++i) square += base(i, j) * base(i, j);
    inverse[static_cast<std::size_t>(j)] = 1 / square;
  }
  if (finite)
    repeat<Dim>([&](auto i) {
      repeat<Dim>([&](auto j) {
        base(i(), j()) += Uniform<Dim, Pack>::share * at.product[i()][std::size_t{1} << j()];
      });
    });
  mode_work<Dim, Pack>(at.q, base, inverse.data(), moduli[0] * at.mean.volume,
                       moduli[1] * at.mean.volume, on_mode, on_base);
}
template <int Dim, class Pack, class Law>
[[nodiscard, gnu::flatten]] bool one_point_forces(const Law& law, bool finite,
                                                  const std::array<double, 2>& moduli, double depth,
                                                  const Pack* numbers, const Pack* u, Pack* force) {
  const Factors<Dim, Pack> c{numbers};
  Uniform<Dim, Pack> at;
  measure(c, depth, u, at);
  Matrix<Dim, Pack> on_gradient, on_base;
  if (!work_on_gradient<Dim, Pack>(law, finite, at.h, at.mean.volume, on_gradient)) return false;
  decltype(at.q) on_mode;
  one_point_modes<Dim, Pack>(finite, moduli, c, at, on_mode, on_base);
  spread<Dim, Pack>(c, at.mean, on_gradient, on_mode, finite ? &on_base : nullptr, force);
  return true;
}

/// Energy per volume of a finite displacement gradient.
template <int Dim, class Pack>
[[nodiscard]] Pack gradient_energy(const Batch<Dim>& batch, const Matrix<Dim, Pack>& h) {
  Strains<Dim, Pack> strain;
  green_lagrange(h, strain);
  return material::stored_energies<components<Dim>>(batch.section.law, strain);
}
/// In finite strain; of a quadratic form in the modes  sum_a (work on q_a) . q_a / 2.
template <int Dim, class Pack>
[[nodiscard]] Pack one_point_energy(const Batch<Dim>& batch, const std::array<double, 2>& moduli,
                                    double depth, const Pack* numbers, const Pack* u) {
  const Factors<Dim, Pack> c{numbers};
  Uniform<Dim, Pack> at;
  measure(c, depth, u, at);
  decltype(at.q) on_mode;
  Matrix<Dim, Pack> on_base;
  one_point_modes<Dim, Pack>(true, moduli, c, at, on_mode, on_base);
  Pack sum = Pack::Zero();
  for (std::size_t m = 0; m < on_mode.size(); ++m) sum += on_mode[m] * at.q[m];
  return at.mean.volume * gradient_energy(batch, at.h) + 0.5 * sum;
}

/// Displacement gradient of a tri3 or tet4.
///
/// Input      gradient: dN_k/dX_j at Dim k + j
template <int Dim, class Pack>
inline void simplex_gradient(const Pack* gradient, const Pack* u, Matrix<Dim, Pack>& h) {
  repeat<Dim>([&](auto i) {
    repeat<Dim>([&](auto j) {
      Pack sum = u[i()] * gradient[j()];
      repeat<Dim>(
          [&](auto k) { sum += u[Dim * (k() + 1) + i()] * gradient[Dim * (k() + 1) + j()]; });
      h(i(), j()) = sum;
    });
  });
}
template <int Dim, class Pack>
[[nodiscard, gnu::flatten]] bool simplex_forces(const Batch<Dim>& batch, const Pack* numbers,
                                                const Pack* u, Pack* force) {
  const Pack& volume = *numbers;
  const Pack* const gradient = numbers + 1;
  Matrix<Dim, Pack> h, work;
  simplex_gradient<Dim, Pack>(gradient, u, h);
  if (!work_on_gradient<Dim, Pack>(batch.section.law,
                                   batch.section.kinematics == Kinematics::finite, h, volume, work))
    return false;
  for (int k = 0; k <= Dim; ++k)
    for (int i = 0; i < Dim; ++i) {
      Pack sum = work(i, 0) * gradient[Dim * k];
      for (int j = 1; j < Dim; ++j) sum += work(i, j) * gradient[Dim * k + j];
      force[Dim * k + i] = sum;
    }
  return true;
}

}  // namespace osculate::solid::batches
