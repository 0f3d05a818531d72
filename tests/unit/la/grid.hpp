#pragma once
#include <array>
#include <cmath>

#include "osculate/la/sparse_matrix.hpp"

namespace osculate::la::test {

/// Plane strain stiffness of a square element with E = 1, nu = 0.3 (2 x 2 Gauss points).
inline Mat<8, 8> square_stiffness() {
  constexpr double nu = 0.3, c = 1 / ((1 + nu) * (1 - 2 * nu));
  const Mat<3, 3> d{{c * (1 - nu), c * nu, 0}, {c * nu, c * (1 - nu), 0}, {0, 0, c * (0.5 - nu)}};
  constexpr std::array<double, 4> sx{-1, 1, 1, -1}, sy{-1, -1, 1, 1};
  const double gauss = 1 / std::sqrt(3.0);
  Mat<8, 8> k = Mat<8, 8>::Zero();
  for (const double x : {-gauss, gauss})
    for (const double y : {-gauss, gauss}) {
      Mat<3, 8> b = Mat<3, 8>::Zero();
      for (int a = 0; a < 4; ++a) {
        const auto s = static_cast<std::size_t>(a);
        b(0, 2 * a) = b(2, 2 * a + 1) = sx[s] * (1 + sy[s] * y) / 2;
        b(1, 2 * a + 1) = b(2, 2 * a) = sy[s] * (1 + sx[s] * x) / 2;
      }
      k += b.transpose() * d * b / 4;
    }
  return k;
}

/// A block of nx x ny squares; `held` puts its left side on springs.
inline MatrixBuilder grid(Index nx, Index ny, bool held) {
  const Mat<8, 8> k = square_stiffness();
  MatrixBuilder m(2 * (nx + 1) * (ny + 1));
  const auto unknowns = [nx](Index i, Index j) {
    const Index a = 2 * (j * (nx + 1) + i), b = a + 2 * (nx + 1);
    return std::array<Index, 8>{a, a + 1, a + 2, a + 3, b + 2, b + 3, b, b + 1};
  };
  for (Index j = 0; j < ny; ++j)
    for (Index i = 0; i < nx; ++i) m.reserve_block(unknowns(i, j));
  m.finish();
  for (Index j = 0; j < ny; ++j)
    for (Index i = 0; i < nx; ++i) {
      const std::array<Index, 8> u = unknowns(i, j);
      for (int a = 0; a < 8; ++a)
        for (int b = 0; b < 8; ++b)
          m.add(u[static_cast<std::size_t>(a)], u[static_cast<std::size_t>(b)], k(a, b));
    }
  if (held)
    for (Index u = 0; u < m.finish().n; u += 2 * (nx + 1)) m.add(u, u, 10), m.add(u + 1, u + 1, 10);
  return m;
}

inline Eigen::MatrixXd dense(const SparseMatrix& k) {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(k.n, k.n);
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[static_cast<std::size_t>(i)];
         e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e)
      full(i, k.column[static_cast<std::size_t>(e)]) += k.value[static_cast<std::size_t>(e)];
  return full;
}

}  // namespace osculate::la::test
