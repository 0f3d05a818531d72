#include "osculate/pairing/mortar_rule.hpp"

#include <algorithm>

namespace osculate::pairing {
namespace {

/// Gauss rule on the triangle by collapsing the square: exact for total degree 2 n - 2.
cell::Quadrature2D collapsed(int n) {
  const cell::Quadrature1D line = cell::gauss_legendre(n);
  cell::Quadrature2D rule;
  for (std::size_t i = 0; i < line.points.size(); ++i)
    for (std::size_t j = 0; j < line.points.size(); ++j) {
      const double u = 0.5 * (1 + line.points[i]);
      rule.points.emplace_back(u, 0.5 * (1 + line.points[j]) * (1 - u));
      rule.weights.push_back(0.25 * line.weights[i] * line.weights[j] * (1 - u));
    }
  return rule;
}

/// |x_0 - x_1 + x_2 - x_3| over the shorter diagonal: how far a quadrilateral is from a
/// parallelogram.
double skew_of(const FacetPoints& x, cell::CellType type) {
  if (cell::is_triangle(type)) return 0;
  const double diagonal = std::min((x[2] - x[0]).norm(), (x[3] - x[1]).norm());
  return (x[0] - x[1] + x[2] - x[3]).norm() / diagonal;
}

int degree_of(cell::CellType type) {
  if (type == cell::CellType::tri3) return 1;
  return type == cell::CellType::quad4 || type == cell::CellType::tri6 ? 2 : 4;
}

}  // namespace

const cell::Quadrature2D& mortar_rule(cell::CellType slave, const FacetPoints& slave_reference,
                                      cell::CellType master, const FacetPoints& master_reference) {
  static const std::array<cell::Quadrature2D, 3> exact{
      cell::gauss_triangle(2), cell::gauss_triangle(4), cell::gauss_triangle(6)};
  static const std::array<cell::Quadrature2D, 4> more{collapsed(4), collapsed(5), collapsed(7),
                                                      collapsed(10)};
  const double skew = std::max(skew_of(slave_reference, slave), skew_of(master_reference, master));
  const int own = degree_of(slave), other = degree_of(master);
  const int degree = own + std::max(own, other);
  constexpr double none = 1e-6;
  if (skew <= none && degree <= 6) return exact[static_cast<std::size_t>((degree - 1) / 2)];
  const std::size_t by_skew = skew <= 0.03 ? 0 : skew <= 0.1 ? 1 : skew <= 0.27 ? 2 : 3;
  return more[std::max<std::size_t>(by_skew, degree > 6 ? 1 : 0)];
}

}  // namespace osculate::pairing
