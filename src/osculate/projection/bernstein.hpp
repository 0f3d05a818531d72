#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/core/types.hpp"

namespace osculate::projection {

/// Bernstein coefficients of a polynomial of degree m in s and n in t over the unit square (n = 0:
/// over the unit interval); coefficient (i, j) stands at i (n + 1) + j. Their smallest and largest
/// bound the polynomial.
///
/// Tested by  tests/unit/projection/test_pieces.cpp
template <int Capacity>
struct Net {
  int m = 0, n = 0;
  std::array<double, static_cast<std::size_t>(Capacity)> c{};

  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(i * (n + 1) + j);
  }
  [[nodiscard]] double at(int i, int j) const { return c[index(i, j)]; }
  double& at(int i, int j) { return c[index(i, j)]; }
};

/// Binomial coefficients up to 28 over k: products of four polynomials of degree 7.
inline constexpr auto binomials = [] {
  std::array<std::array<double, 29>, 29> table{};
  for (std::size_t n = 0; n < 29; ++n) {
    table[n][0] = 1;
    for (std::size_t k = 1; k <= n; ++k)
      table[n][k] = table[n][k - 1] * double(n - k + 1) / double(k);
  }
  return table;
}();
[[nodiscard]] inline double binomial(int n, int k) {
  return binomials[static_cast<std::size_t>(n)][static_cast<std::size_t>(k)];
}

struct Bounds {
  double lo = 0, hi = 0;
};

/// The part of the square where s (direction 0) or t (1) is below or above a half, as two nets over
/// the unit square (de Casteljau at a half).
template <int Capacity>
void halve(const Net<Capacity>& net, int direction, Net<Capacity>& low, Net<Capacity>& high) {
  low.m = high.m = net.m;
  low.n = high.n = net.n;
  const bool along_s = direction == 0;
  const int degree = along_s ? net.m : net.n, lines = along_s ? net.n : net.m;
  for (int l = 0; l <= lines; ++l) {
    std::array<double, 16> row{};
    for (int k = 0; k <= degree; ++k)
      row[static_cast<std::size_t>(k)] = along_s ? net.at(k, l) : net.at(l, k);
    for (int k = 0; k <= degree; ++k) {
      const auto last = static_cast<std::size_t>(degree - k);
      (along_s ? low.at(k, l) : low.at(l, k)) = row[0];
      (along_s ? high.at(degree - k, l) : high.at(l, degree - k)) = row[last];
      for (std::size_t i = 0; i < last; ++i) row[i] = 0.5 * (row[i] + row[i + 1]);
    }
  }
}

/// The side s = 0 or 1 (direction 0), t = 0 or 1 (direction 1); the direction has degree 0 then.
template <int Capacity>
[[nodiscard]] Net<Capacity> side_of(const Net<Capacity>& net, int direction, bool high) {
  Net<Capacity> out;
  if (direction == 0) {
    out.n = net.n;
    for (int j = 0; j <= net.n; ++j) out.at(0, j) = net.at(high ? net.m : 0, j);
  } else {
    out.m = net.m;
    for (int i = 0; i <= net.m; ++i) out.at(i, 0) = net.at(i, high ? net.n : 0);
  }
  return out;
}

/// Bounds of value, first and second derivatives over the square.
struct NetBounds {
  std::array<Bounds, 2> first;   ///< d/ds, d/dt
  std::array<Bounds, 3> second;  ///< d2/ds2, d2/dsdt, d2/dt2
};

namespace detail {
inline void widen(Bounds& b, double value) {
  b.lo = std::min(b.lo, value);
  b.hi = std::max(b.hi, value);
}
inline constexpr Bounds nothing{1e300, -1e300};
}  // namespace detail

/// Bounds of N - lambda D (D may be left out: lambda then belongs to a constant and drops out).
template <int Capacity>
[[nodiscard]] NetBounds derivative_bounds(const Net<Capacity>& net) {
  using detail::widen;
  NetBounds b;
  b.first.fill(detail::nothing);
  b.second.fill(detail::nothing);
  const int m = net.m, n = net.n;
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j <= n; ++j) {
      const double c = net.at(i, j);
      if (i < m) widen(b.first[0], m * (net.at(i + 1, j) - c));
      if (j < n) widen(b.first[1], n * (net.at(i, j + 1) - c));
      if (i + 1 < m)
        widen(b.second[0], m * (m - 1) * (net.at(i + 2, j) - 2 * net.at(i + 1, j) + c));
      if (i < m && j < n)
        widen(b.second[1],
              m * n * (net.at(i + 1, j + 1) - net.at(i + 1, j) - net.at(i, j + 1) + c));
      if (j + 1 < n)
        widen(b.second[2], n * (n - 1) * (net.at(i, j + 2) - 2 * net.at(i, j + 1) + c));
    }
  for (Bounds& one : b.first)
    if (one.lo > one.hi) one = {};
  for (Bounds& one : b.second)
    if (one.lo > one.hi) one = {};
  return b;
}

}  // namespace osculate::projection
