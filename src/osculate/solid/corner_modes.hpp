#pragma once
// Nodal values of quad4 and hex8 as sums of products of reference coordinates, and their slopes at
// the 2 x 2 (x 2) Gauss points: axis after axis, where tables of shape functions would take an
// operation for each pair of a node and a point. For sources of this layer.
#include <array>
#include <bit>

#include "osculate/core/repeat.hpp"
#include "osculate/solid/element.hpp"

namespace osculate::solid {

using core::repeat;

/// Corners, points and products are numbered by bits: bit j of a corner or point says that xi_j is
/// positive there, that of a product that it has the factor xi_j. The node at a corner:
template <int Dim>
inline constexpr std::array<int, 1 << Dim> corner_node = {};
template <>
inline constexpr std::array<int, 4> corner_node<2> = {0, 1, 3, 2};
template <>
inline constexpr std::array<int, 8> corner_node<3> = {0, 1, 3, 2, 4, 5, 7, 6};

/// One value a corner, product or point.
template <int Dim, class T>
using OfCorners = std::array<T, std::size_t{1} << Dim>;

/// Sums and differences along each axis, without the factor 2^-Dim: from values at the corners to
/// the factors of the products; `from_products` is its transposed.
///
/// Formula    c_m = 2^-Dim sum_k v_k prod_{j in m} xi_j(k)
template <std::size_t Count, class T>
inline void to_products(std::array<T, Count>& v) {
  repeat<std::bit_width(unsigned{Count}) - 1>([&](auto axis) {
    constexpr std::size_t bit = std::size_t{1} << axis();
    repeat<static_cast<int>(Count)>([&](auto at) {
      constexpr std::size_t low = at();
      if constexpr ((low & bit) == 0) {
        const T a = v[low], b = v[low | bit];
        v[low] = a + b;
        v[low | bit] = b - a;
      }
    });
  });
}
template <std::size_t Count, class T>
inline void from_products(std::array<T, Count>& v) {
  repeat<std::bit_width(unsigned{Count}) - 1>([&](auto axis) {
    constexpr std::size_t bit = std::size_t{1} << axis();
    repeat<static_cast<int>(Count)>([&](auto at) {
      constexpr std::size_t low = at();
      if constexpr ((low & bit) == 0) {
        const T a = v[low], b = v[low | bit];
        v[low] = a - b;
        v[low | bit] = a + b;
      }
    });
  });
}
/// `bits` with another one put in at `axis`, and without that at `axis`.
constexpr std::size_t with_axis(std::size_t bits, int axis) {
  const std::size_t below = (std::size_t{1} << axis) - 1;
  return (bits & below) | (std::size_t{1} << axis) | ((bits & ~below) << 1U);
}
constexpr std::size_t without_axis(std::size_t bits, int axis) {
  const std::size_t below = (std::size_t{1} << axis) - 1;
  return (bits & below) | ((bits >> 1U) & ~below);
}
/// A product of Gauss points' coordinates 1/sqrt(3).
constexpr double gauss_product(std::size_t bits) {
  constexpr double g = 0.57735026918962576451;
  double product = 1;
  for (; bits != 0; bits &= bits - 1) product *= g;
  return product;
}

/// Derivatives of values at all points along the axes: that along xi_j does not depend on xi_j.
template <int Dim, class T>
struct PointSlopes {
  static constexpr std::size_t places = std::size_t{1} << (Dim - 1);
  std::array<std::array<T, places>, Dim> along;
  [[nodiscard]] const T& at(int axis, std::size_t point) const {
    return along[static_cast<std::size_t>(axis)][without_axis(point, axis)];
  }
  T& at(int axis, std::size_t point) {
    return along[static_cast<std::size_t>(axis)][without_axis(point, axis)];
  }
};
/// Input      factors of the products
template <int Dim, class T>
inline void set_slopes(const OfCorners<Dim, T>& factor, PointSlopes<Dim, T>& out) {
  repeat<Dim>([&](auto axis) {
    auto& s = out.along[axis()];
    repeat<1 << (Dim - 1)>([&](auto r) {
      constexpr std::size_t rest = r();
      if constexpr (rest == 0)
        s[rest] = factor[with_axis(rest, axis())];
      else
        s[rest] = gauss_product(rest) * factor[with_axis(rest, axis())];
    });
    from_products(s);
  });
}
/// The transposed: adds what works on the slopes, summed over the points that share them, to what
/// works on the factors.
template <int Dim, class T>
inline void add_transposed(PointSlopes<Dim, T>& of, OfCorners<Dim, T>& factor) {
  repeat<Dim>([&](auto axis) {
    auto& s = of.along[axis()];
    to_products(s);
    repeat<1 << (Dim - 1)>([&](auto r) {
      constexpr std::size_t rest = r();
      if constexpr (rest == 0)
        factor[with_axis(rest, axis())] += s[rest];
      else
        factor[with_axis(rest, axis())] += gauss_product(rest) * s[rest];
    });
  });
}

}  // namespace osculate::solid
