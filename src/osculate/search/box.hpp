#pragma once
#include <algorithm>
#include <limits>

#include "osculate/core/types.hpp"

namespace osculate::search {

/// Axis-aligned box; empty until it is extended. Infinite sides are allowed (an infinite line's box
/// is everything). Closed: boxes that touch overlap.
///
/// Tested by  tests/unit/search/test_box.cpp
template <int Dim>
struct Box {
  Vec<Dim> lo = Vec<Dim>::Constant(std::numeric_limits<double>::infinity());
  Vec<Dim> hi = Vec<Dim>::Constant(-std::numeric_limits<double>::infinity());

  [[nodiscard]] bool empty() const { return (lo.array() > hi.array()).any(); }
  [[nodiscard]] bool bounded() const { return lo.allFinite() && hi.allFinite(); }

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
  [[nodiscard]] bool overlaps(const Box& other) const {
    return !empty() && !other.empty() && (lo.array() <= other.hi.array()).all() &&
           (other.lo.array() <= hi.array()).all();
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
  /// Squared distance of two boxes (zero where they overlap, infinite for an empty one).
  [[nodiscard]] double squared_distance(const Box& other) const {
    if (empty() || other.empty()) return std::numeric_limits<double>::infinity();
    double sum = 0;
    for (int i = 0; i < Dim; ++i) {
      const double apart = std::max({lo[i] - other.hi[i], other.lo[i] - hi[i], 0.0});
      sum += apart * apart;
    }
    return sum;
  }
};

}  // namespace osculate::search
