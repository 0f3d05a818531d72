#pragma once
// Kinematics of finite strain at one point, for numbers of any kind T: those of all points of a
// cell, or of one point of each of several cells. For sources of this layer.
#include <array>

#include "osculate/core/pack.hpp"
#include "osculate/core/repeat.hpp"

namespace osculate::solid {

/// A matrix of such numbers.
template <int Dim, class T>
struct PointMatrix {
  std::array<T, static_cast<std::size_t>(Dim* Dim)> entry;
  T& operator()(int i, int j) { return entry[static_cast<std::size_t>(Dim * i + j)]; }
  const T& operator()(int i, int j) const { return entry[static_cast<std::size_t>(Dim * i + j)]; }
};

/// The transposed of adj A = det(A) A^-1, returns det A.
template <class T>
T cofactors(const PointMatrix<2, T>& a, PointMatrix<2, T>& out) {
  out.entry = {a(1, 1), -a(1, 0), -a(0, 1), a(0, 0)};
  return a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0);
}
template <class T>
T cofactors(const PointMatrix<3, T>& a, PointMatrix<3, T>& out) {
  core::repeat<3>([&](auto i) {
    core::repeat<3>([&](auto j) {
      constexpr int k = (i() + 1) % 3, l = (i() + 2) % 3, m = (j() + 1) % 3, n = (j() + 2) % 3;
      out(i(), j()) = a(k, m) * a(l, n) - a(k, n) * a(l, m);
    });
  });
  return a(0, 0) * out(0, 0) + a(0, 1) * out(0, 1) + a(0, 2) * out(0, 2);
}

/// det(I + h) - 1 without cancellation at small strain; `of_f` are the cofactors of I + h.
template <int Dim, class T>
T volume_change(const PointMatrix<Dim, T>& h, const PointMatrix<Dim, T>& of_f) {
  T first = h(1, 1);  // the first cofactor, less 1
  if constexpr (Dim == 3) first += h(2, 2) + h(1, 1) * h(2, 2) - h(1, 2) * h(2, 1);
  T sum = first + h(0, 0) * (1 + first);
  core::repeat<Dim - 1>([&](auto j) { sum += h(0, j() + 1) * of_f(0, j() + 1); });
  return sum;
}

/// A B^T.
template <int Dim, class T>
void times_transposed(const PointMatrix<Dim, T>& a, const PointMatrix<Dim, T>& b,
                      PointMatrix<Dim, T>& out) {
  core::repeat<Dim>([&](auto i) {
    core::repeat<Dim>([&](auto j) {
      T sum = a(i(), 0) * b(j(), 0);
      core::repeat<Dim - 1>([&](auto k) { sum += a(i(), k() + 1) * b(j(), k() + 1); });
      out(i(), j()) = sum;
    });
  });
}

/// Component of a strain or stress at row i and column j.
constexpr std::size_t component(int i, int j) {
  return static_cast<std::size_t>(i == j ? i : i + j == 1 ? 3 : i + j == 3 ? 4 : 5);
}

/// Green-Lagrange strain of a displacement gradient; in the plane without a strain across it.
template <int Dim, class T, std::size_t C>
void green_lagrange(const PointMatrix<Dim, T>& h, std::array<T, C>& out) {
  out[2] = T::Zero();
  core::repeat<Dim>([&](auto row) {
    core::repeat<Dim>([&](auto column) {
      constexpr int i = row(), j = column();
      if constexpr (i <= j) {
        T sum = h(0, i) * h(0, j);
        core::repeat<Dim - 1>([&](auto k) { sum += h(k() + 1, i) * h(k() + 1, j); });
        if constexpr (i == j)
          out[component(i, j)] = h(i, i) + 0.5 * sum;
        else
          out[component(i, j)] = h(i, j) + h(j, i) + sum;
      }
    });
  });
}

/// (1 + c)^(1/3): Halley's steps, of which each triples the digits.
template <class T>
T cube_root(const T& c) {
  const T a = 1 + c;
  using core::everywhere;
  if (!everywhere(abs(c) < 0.5)) return core::cube_root_of(a);
  T m = 1 + c * (1.0 / 3 - c * (1.0 / 9));
  for (int step = 0; step < 2; ++step) {
    const T cube = m * m * m;
    m += m * (a - cube) / (2 * cube + a);
  }
  return m;
}

/// The common volume ratio of a cell as one of its points sees it.
///
/// Formula    E_m = m (E + I/2) - I/2 , m = (theta / J)^(2/3)
/// Input      mean: theta - 1; growth: J - 1
template <class T>
struct VolumeRatio {
  T m, half;  ///< m, (m - 1) / 2
  template <class Mean>
  VolumeRatio(const Mean& mean, const T& growth) {
    const T square = growth * (2 + growth);                        // J^2 - 1
    const T change = (mean * (2 + mean) - square) / (1 + square);  // m^3 - 1
    m = cube_root<T>(change);
    half = 0.5 * change / (1 + m + m * m);
  }
  template <std::size_t C>
  void apply(std::array<T, C>& strain) const {
    for (std::size_t i = 0; i < C; ++i)
      strain[i] = i < 3 ? T(m * strain[i] + half) : T(m * strain[i]);
  }
};
/// S : (E + I/2).
template <class T, std::size_t C>
T work_of_growth(const std::array<T, C>& strain, const std::array<T, C>& stress) {
  T c = stress[0] * (strain[0] + 0.5);
  for (std::size_t i = 1; i < 3; ++i) c += stress[i] * (strain[i] + 0.5);
  for (std::size_t i = 3; i < C; ++i) c += stress[i] * strain[i];
  return c;
}

/// weight F S.
template <int Dim, class T, std::size_t C>
void weighted_first_stress(const PointMatrix<Dim, T>& f, const std::array<T, C>& stress,
                           const T& weight, PointMatrix<Dim, T>& out) {
  PointMatrix<Dim, T> s;
  core::repeat<Dim>([&](auto i) {
    core::repeat<Dim>([&](auto j) { s(i(), j()) = weight * stress[component(i(), j())]; });
  });
  times_transposed(f, s, out);
}
/// A B.
template <int Dim, class T>
void times(const PointMatrix<Dim, T>& a, const PointMatrix<Dim, T>& b, PointMatrix<Dim, T>& out) {
  core::repeat<Dim>([&](auto i) {
    core::repeat<Dim>([&](auto j) {
      T sum = a(i(), 0) * b(0, j());
      core::repeat<Dim - 1>([&](auto k) { sum += a(i(), k() + 1) * b(k() + 1, j()); });
      out(i(), j()) = sum;
    });
  });
}

}  // namespace osculate::solid
