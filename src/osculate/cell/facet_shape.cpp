#include "osculate/cell/facet_shape.hpp"

#include <algorithm>

#include "osculate/cell/shape.hpp"
#include "osculate/core/dense.hpp"

namespace osculate::cell {
namespace {

/// A shape function is a sum of monomials xi^p eta^q; which ones, by type.
struct Monomials {
  int count;
  std::array<std::array<int, 2>, max_facet_nodes> power;
};

constexpr std::array<std::array<int, 2>, max_facet_nodes> quad_powers{
    {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}, {0, 2}, {2, 1}, {1, 2}, {2, 2}}};
constexpr std::array<std::array<int, 2>, max_facet_nodes> tri_powers{
    {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}}};

Monomials monomials(CellType type) {
  return {info(type).nodes, is_triangle(type) ? tri_powers : quad_powers};
}

double power(double x, int p) { return p == 0 ? 1.0 : p == 1 ? x : x * x; }

/// d^k/dx^k of x^p for p = 0, 1, 2.
double power_derivative(double x, int p, int k) {
  if (k > p) return 0.0;
  double factor = 1;
  for (int i = 0; i < k; ++i) factor *= p - i;
  return factor * power(x, p - k);
}

using Coefficients = Mat<max_facet_nodes, max_facet_nodes>;

/// Row k: coefficients of shape function k. The entries are multiples of 1/4 for every type, so
/// rounding of the inverse is removed.
Coefficients make_coefficients(CellType type) {
  const Monomials m = monomials(type);
  Eigen::MatrixXd at_nodes(m.count, m.count);  // monomial i at node k
  for (int i = 0; i < m.count; ++i)
    for (int k = 0; k < m.count; ++k) {
      const Vec2 x = area_node(type, k);
      const auto& p = m.power[static_cast<std::size_t>(i)];
      at_nodes(i, k) = power(x.x(), p[0]) * power(x.y(), p[1]);
    }
  const Eigen::MatrixXd inverse =
      core::least_squares(at_nodes, Eigen::MatrixXd::Identity(m.count, m.count));
  Coefficients c = Coefficients::Zero();
  c.topLeftCorner(m.count, m.count) = (4.0 * inverse).array().round().matrix() / 4.0;
  return c;
}

const Coefficients& coefficients(CellType type) {
  static const std::array<Coefficients, 5> all{
      make_coefficients(CellType::tri3), make_coefficients(CellType::tri6),
      make_coefficients(CellType::quad4), make_coefficients(CellType::quad8),
      make_coefficients(CellType::quad9)};
  switch (type) {
    case CellType::tri3:
      return all[0];
    case CellType::tri6:
      return all[1];
    case CellType::quad4:
      return all[2];
    case CellType::quad8:
      return all[3];
    default:
      return all[4];
  }
}

/// Derivatives up to the third in the places of `FacetShape::n`; the first `derivatives(order)`.
constexpr std::array<std::array<int, 2>, 10> orders{
    {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}}};

constexpr std::array<std::size_t, 4> derivatives{1, 3, 6, 10};

/// Values and derivatives of the one-dimensional functions of a product cell; row: node of
/// (-1, 1) or (-1, 1, 0).
using LineValues = std::array<std::array<double, 4>, 3>;

LineValues line_values(bool quadratic, double x) {
  if (!quadratic) return {{{0.5 * (1 - x), -0.5, 0, 0}, {0.5 * (1 + x), 0.5, 0, 0}, {}}};
  return {{{0.5 * x * (x - 1), x - 0.5, 1, 0},
           {0.5 * x * (x + 1), x + 0.5, 1, 0},
           {1 - x * x, -2 * x, -2, 0}}};
}

/// Places of the nodes of quad4 and quad9 in the two lines.
constexpr std::array<std::array<std::size_t, 2>, 9> product_nodes{
    {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {1, 2}, {2, 1}, {0, 2}, {2, 2}}};

void fill_product(bool quadratic, const Vec2& xi, std::size_t count, FacetShape& s) {
  const LineValues a = line_values(quadratic, xi.x()), b = line_values(quadratic, xi.y());
  for (std::size_t d = 0; d < count; ++d)
    for (std::size_t k = 0; k < static_cast<std::size_t>(s.count); ++k)
      s.n[d][k] = a[product_nodes[k][0]][static_cast<std::size_t>(orders[d][0])] *
                  b[product_nodes[k][1]][static_cast<std::size_t>(orders[d][1])];
}

void fill_monomials(CellType type, const Vec2& xi, std::size_t count, FacetShape& s) {
  const Monomials m = monomials(type);
  const Coefficients& c = coefficients(type);
  for (std::size_t d = 0; d < count; ++d)
    for (int i = 0; i < m.count; ++i) {
      const auto& p = m.power[static_cast<std::size_t>(i)];
      const double value = power_derivative(xi.x(), p[0], orders[d][0]) *
                           power_derivative(xi.y(), p[1], orders[d][1]);
      if (value == 0.0) continue;
      for (int k = 0; k < m.count; ++k) s.n[d][static_cast<std::size_t>(k)] += c(k, i) * value;
    }
}

/// The same bits as of the sum of monomials.
void fill_triangle(const Vec2& xi, std::size_t count, FacetShape& s) {
  s.n[0] = {1 - xi.x() - xi.y(), xi.x(), xi.y()};
  if (count == 1) return;
  s.n[1] = {-1, 1, 0};
  s.n[2] = {-1, 0, 1};
}

}  // namespace

FacetShape facet_shape(CellType type, const Vec2& xi, int order) {
  FacetShape s;
  s.count = info(type).nodes;
  const int highest = std::min(order, highest_derivative(type));
  const std::size_t count = derivatives[static_cast<std::size_t>(highest)];
  if (type == CellType::quad4 || type == CellType::quad9)
    fill_product(type == CellType::quad9, xi, count, s);
  else if (type == CellType::tri3)
    fill_triangle(xi, count, s);
  else
    fill_monomials(type, xi, count, s);
  return s;
}

}  // namespace osculate::cell
