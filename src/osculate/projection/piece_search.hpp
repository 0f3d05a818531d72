#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/projection/composed.hpp"

namespace osculate::projection {

/// Grid of parameters of a piece: calls visit(xi, step), ends included.
template <int Dim, class Visit>
void for_each_sample(const SmoothPiece& piece, int cells, const Visit& visit) {
  const Vec2 range = piece.hi - piece.lo;
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= (Dim == 2 ? 0 : piece.triangle ? cells - i : cells); ++j)
      visit(Vec2(piece.lo + range.cwiseProduct(Vec2(i, j) / cells)), 1.0 / cells);
}

/// Cells per direction of each piece so that all together have about the wanted samples.
template <int Dim>
[[nodiscard]] int cells_of(const Composed<Dim>& s, int samples) {
  const double each = samples / static_cast<double>(s.pieces().size());
  return std::clamp(static_cast<int>(Dim == 2 ? each : std::sqrt(each)), 1, 400);
}

[[nodiscard]] inline Vec2 clamped(const SmoothPiece& piece, Vec2 xi) {
  xi = xi.cwiseMax(piece.lo).cwiseMin(piece.hi);
  if (piece.triangle && xi.sum() > 1) xi /= xi.sum();
  return xi;
}

/// Pattern search: the largest value of f round `xi` in its piece. f may be -infinity.
template <class F>
double climb(const SmoothPiece& piece, Vec2& xi, double step, int dimension, const F& f) {
  const Vec2 range = piece.hi - piece.lo;
  double best = f(xi);
  for (int it = 0; it < 400 && step > 1e-9; ++it) {
    bool moved = false;
    for (int i = 0; i < (dimension == 1 ? 2 : 8) && !moved; ++i) {
      constexpr std::array<std::array<double, 2>, 8> ways{
          {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
      const std::array<double, 2>& way = ways[static_cast<std::size_t>(i)];
      const Vec2 next = clamped(piece, xi + step * range.cwiseProduct(Vec2(way[0], way[1])));
      const double value = f(next);
      if (!(value > best)) continue;
      best = value;
      xi = next;
      moved = true;
    }
    if (!moved) step *= 0.5;
  }
  return best;
}

}  // namespace osculate::projection
