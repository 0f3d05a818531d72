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

bool parallel_sided(const FacetPoints& x, cell::CellType type) {
  if (cell::is_triangle(type)) return true;
  constexpr double tolerance = 1e-6;
  return (x[0] - x[1] + x[2] - x[3]).norm() <= tolerance * (x[2] - x[0]).norm();
}

int degree_of(cell::CellType type) {
  if (type == cell::CellType::tri3) return 1;
  return type == cell::CellType::quad4 || type == cell::CellType::tri6 ? 2 : 4;
}

}  // namespace

const cell::Quadrature2D& mortar_rule(cell::CellType slave, const FacetPoints& slave_reference,
                                      cell::CellType master, const FacetPoints& master_reference) {
  static const cell::Quadrature2D second = cell::gauss_triangle(2),
                                  fourth = cell::gauss_triangle(4), sixth = cell::gauss_triangle(6),
                                  eighth = collapsed(5), many = collapsed(7);
  if (!parallel_sided(slave_reference, slave) || !parallel_sided(master_reference, master))
    return many;
  const int own = degree_of(slave), other = degree_of(master);
  const int degree = own + std::max(own, other);
  return degree <= 2 ? second : degree <= 4 ? fourth : degree <= 6 ? sixth : eighth;
}

}  // namespace osculate::pairing
