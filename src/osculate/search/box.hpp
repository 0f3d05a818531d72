#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "osculate/core/types.hpp"

namespace osculate::search {

/// Axis-aligned box; empty until it is extended. Infinite sides are allowed.
template <int Dim>
struct Box {
  Vec<Dim> lo = Vec<Dim>::Constant(std::numeric_limits<double>::infinity());
  Vec<Dim> hi = Vec<Dim>::Constant(-std::numeric_limits<double>::infinity());

  void extend(const Vec<Dim>& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  void extend(const Box& other) {
    lo = lo.cwiseMin(other.lo);
    hi = hi.cwiseMax(other.hi);
  }
  void inflate(double margin) {
    lo.array() -= margin;
    hi.array() += margin;
  }
  /// Squared distance of a point from the box (zero inside, infinite for an empty box).
  [[nodiscard]] double squared_distance(const Vec<Dim>& p) const {
    double sum = 0;
    for (int i = 0; i < Dim; ++i) {
      const double outside = std::max({lo[i] - p[i], p[i] - hi[i], 0.0});
      sum += outside * outside;
    }
    return sum;
  }
};

}  // namespace osculate::search
