#pragma once
#include <vector>

#include "osculate/core/types.hpp"

namespace osculate::cell {

/// Points and weights on -1..1.
struct Quadrature1D {
  std::vector<double> points, weights;
};

/// Gauss-Legendre rule with n points (1..20), exact for polynomials of degree 2n - 1.
[[nodiscard]] Quadrature1D gauss_legendre(int n);
/// Gauss-Lobatto rule with n points (2..20), both ends included, exact for degree 2n - 3.
[[nodiscard]] Quadrature1D gauss_lobatto(int n);

/// Points and weights on a reference area (quads -1..1 squared, triangles 0..1).
struct Quadrature2D {
  std::vector<Vec2> points;
  std::vector<double> weights;
};

/// n x n tensor Gauss rule.
[[nodiscard]] Quadrature2D gauss_quad(int n);
/// Triangle rule exact for polynomials of at least the degree (1..6): 1, 3, 6, 6, 7 or 12 points
/// inside the triangle with positive weights, whose sum is 1/2.
[[nodiscard]] Quadrature2D gauss_triangle(int degree);

/// Points and weights on a reference volume.
struct Quadrature3D {
  std::vector<Vec3> points;
  std::vector<double> weights;
};

/// n x n x m tensor Gauss rule, m along zeta; m = 0 stands for n.
[[nodiscard]] Quadrature3D gauss_hex(int n, int m = 0);
/// Tetrahedron rule exact for polynomials of at least the degree (1..5): 1, 4 or 15 points inside
/// with positive weights, whose sum is 1/6.
[[nodiscard]] Quadrature3D gauss_tetrahedron(int degree);
/// Triangle rule of the degree times n Gauss points along zeta.
[[nodiscard]] Quadrature3D gauss_wedge(int degree, int n);

}  // namespace osculate::cell
