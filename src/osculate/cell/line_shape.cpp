#include "osculate/cell/line_shape.hpp"

#include <cassert>

namespace osculate::cell {
namespace {

/// Node k of a line with n nodes sits at position(k, n) / (n - 1): whole numbers, so that the
/// nodes are exactly symmetric about zero.
int position(int k, int n) {
  if (k == 0) return 1 - n;
  if (k == 1) return n - 1;
  return 2 * (k - 1) - (n - 1);
}

/// Product of the linear factors (t - t_j), j != k, and its first three derivatives in t.
std::array<double, 4> product_jet(int k, int n, double t) {
  std::array<double, 4> p{1.0, 0.0, 0.0, 0.0};
  for (int j = 0; j < n; ++j) {
    if (j == k) continue;
    const double factor = t - position(j, n);
    p[3] = p[3] * factor + 3.0 * p[2];
    p[2] = p[2] * factor + 2.0 * p[1];
    p[1] = p[1] * factor + p[0];
    p[0] = p[0] * factor;
  }
  return p;
}

int denominator(int k, int n) {
  int product = 1;
  for (int j = 0; j < n; ++j)
    if (j != k) product *= position(k, n) - position(j, n);
  return product;
}

// @eq KS2D:64 the two-node line, which most contact facets are
LineShape two_node_line(double xi) {
  LineShape shape;
  shape.count = 2;
  shape.n[0][0] = 0.5 * (1.0 - xi);
  shape.n[0][1] = 0.5 * (1.0 + xi);
  shape.n[1][0] = -0.5;
  shape.n[1][1] = 0.5;
  return shape;
}

/// Closed form for speed: most curved contact facets are quadratic.
LineShape three_node_line(double xi) {
  LineShape shape;
  shape.count = 3;
  shape.n[0] = {0.5 * xi * (xi - 1.0), 0.5 * xi * (xi + 1.0), (1.0 - xi) * (1.0 + xi)};
  shape.n[1] = {xi - 0.5, xi + 0.5, -2.0 * xi};
  shape.n[2] = {1.0, 1.0, -2.0};
  return shape;
}

}  // namespace

LineShape lagrange_line(int nodes, double xi) {
  assert(nodes >= 2 && nodes <= max_line_nodes);
  if (nodes == 2) return two_node_line(xi);
  if (nodes == 3) return three_node_line(xi);
  LineShape shape;
  if (nodes < 2 || nodes > max_line_nodes) return shape;
  shape.count = nodes;
  const double scale = nodes - 1;
  for (int k = 0; k < nodes; ++k) {
    const std::array<double, 4> p = product_jet(k, nodes, scale * xi);
    double factor = 1.0 / denominator(k, nodes);
    for (std::size_t d = 0; d < 4; ++d) {
      shape.n[d][static_cast<std::size_t>(k)] = factor * p[d];
      factor *= scale;
    }
  }
  return shape;
}

}  // namespace osculate::cell
