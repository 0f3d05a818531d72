#pragma once
// Clipping of convex polygons in a plane, for numbers and for duals.
#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/core/dual.hpp"

namespace osculate::pairing {

template <class T>
struct PlanePoint {
  T x{}, y{};
  friend PlanePoint operator+(const PlanePoint& a, const PlanePoint& b) {
    return {a.x + b.x, a.y + b.y};
  }
  friend PlanePoint operator-(const PlanePoint& a, const PlanePoint& b) {
    return {a.x - b.x, a.y - b.y};
  }
  friend PlanePoint operator*(const T& s, const PlanePoint& a) { return {s * a.x, s * a.y}; }
};
template <class T>
[[nodiscard]] T cross(const PlanePoint<T>& a, const PlanePoint<T>& b) {
  return a.x * b.y - a.y * b.x;
}

template <class T>
[[nodiscard]] PlanePoint<double> plain(const PlanePoint<T>& p) {
  return {core::value(p.x), core::value(p.y)};
}

/// A convex polygon, counter-clockwise. Two quadrilaterals have at most eight common corners.
template <class T>
struct Polygon {
  std::size_t count = 0;
  std::array<PlanePoint<T>, 10> corners;
  void add(const PlanePoint<T>& p) {
    if (count < corners.size()) corners[count++] = p;
  }
};

template <class T>
[[nodiscard]] double area_of(const Polygon<T>& p) {
  double twice = 0;
  for (std::size_t k = 0; k < p.count; ++k) {
    const PlanePoint<T>&a = p.corners[k], &b = p.corners[(k + 1) % p.count];
    twice += core::value(a.x) * core::value(b.y) - core::value(a.y) * core::value(b.x);
  }
  return 0.5 * twice;
}

/// Sets `out` to the part of `p` on the left of the line from `a` to `b`. A corner within
/// `tolerance` of the line counts as on it and stays where it is: edges that lie on each other are
/// not cut (the place of their intersection is arbitrary, its derivative without bound).
///
/// Formula    corner where the edge c -> d crosses: c + t (d - c), t = h_c / (h_c - h_d), h the
///            distance from the line
template <class T>
void left_part(const Polygon<T>& p, const PlanePoint<T>& a, const PlanePoint<T>& b,
               double tolerance, Polygon<T>& out) {
  const PlanePoint<double> from = plain(a), way = plain(b) - from;
  const double length = std::hypot(way.x, way.y);
  std::array<int, 10> side{};
  for (std::size_t k = 0; k < p.count; ++k) {
    const double h = cross(way, plain(p.corners[k]) - from) / length;
    side[k] = h > tolerance ? 1 : h < -tolerance ? -1 : 0;
  }
  out.count = 0;
  for (std::size_t k = 0; k < p.count; ++k) {
    const std::size_t next = (k + 1) % p.count;
    if (side[k] >= 0) out.add(p.corners[k]);
    if (side[k] * side[next] >= 0) continue;
    const T here = cross(b - a, p.corners[k] - a), there = cross(b - a, p.corners[next] - a);
    out.add(p.corners[k] + here / (here - there) * (p.corners[next] - p.corners[k]));
  }
}

/// Common part of two convex polygons; empty where it is no larger than `tolerance` wide.
///
/// Source     Sutherland and Hodgman, Communications of the ACM 17 (1974) 32-42
/// Tested by  tests/unit/pairing/test_mortar_clip.cpp
template <class T>
[[nodiscard]] Polygon<T> common_part(const Polygon<T>& first, const Polygon<T>& second,
                                     double tolerance) {
  std::array<Polygon<T>, 2> parts;  // by turns what is cut and what is left
  const Polygon<T>* left = &first;
  double size = 0;
  for (std::size_t k = 0; k < second.count; ++k) {
    const PlanePoint<T>&a = second.corners[k], &b = second.corners[(k + 1) % second.count];
    size += std::hypot(core::value(b.x) - core::value(a.x), core::value(b.y) - core::value(a.y));
    left_part(*left, a, b, tolerance, parts[k % 2]);
    left = &parts[k % 2];
    if (left->count < 3) return {};
  }
  return area_of(*left) > tolerance * size ? *left : Polygon<T>{};
}

}  // namespace osculate::pairing
