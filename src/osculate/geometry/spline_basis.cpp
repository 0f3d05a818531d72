#include "osculate/geometry/spline_basis.hpp"

#include <algorithm>

namespace osculate::geometry {
namespace {

/// B-spline values of degrees 0..p on one span: row q holds N_{span-q,q} .. N_{span,q}.
using Triangle = std::array<SplineRow, cell::max_line_nodes>;

Triangle spline_values(const double* u, int degree, double xi) {
  Triangle values{};
  values[0][0] = 1.0;
  for (int q = 1; q <= degree; ++q) {
    const SplineRow& lower = values[static_cast<std::size_t>(q - 1)];
    SplineRow& row = values[static_cast<std::size_t>(q)];
    for (int j = 0; j < q; ++j) {  // u points at the start of the span
      const double left = u[j - q + 1], right = u[j + 1];
      const double share = lower[static_cast<std::size_t>(j)] / (right - left);
      row[static_cast<std::size_t>(j)] += (right - xi) * share;
      row[static_cast<std::size_t>(j) + 1] += (xi - left) * share;
    }
  }
  return values;
}

/// Raises a row of degree q-1 to the derivative row of degree q:
/// N'_{i,q} = q (N_{i,q-1}/(u_{i+q}-u_i) - N_{i+1,q-1}/(u_{i+q+1}-u_{i+1})).
SplineRow raise(const SplineRow& lower, const double* u, int q) {
  SplineRow row{};
  for (int j = 0; j < q; ++j) {
    const double share = q * lower[static_cast<std::size_t>(j)] / (u[j + 1] - u[j - q + 1]);
    row[static_cast<std::size_t>(j)] -= share;
    row[static_cast<std::size_t>(j) + 1] += share;
  }
  return row;
}

}  // namespace

std::array<SplineRow, 4> spline_basis(const std::vector<double>& knots, int degree, Index span,
                                      double xi) {
  const double* u = knots.data() + span;
  const Triangle values = spline_values(u, degree, xi);
  std::array<SplineRow, 4> n{};
  for (int d = 0; d <= std::min(3, degree); ++d) {
    SplineRow row = values[static_cast<std::size_t>(degree - d)];
    for (int q = degree - d + 1; q <= degree; ++q) row = raise(row, u, q);
    n[static_cast<std::size_t>(d)] = row;
  }
  return n;
}

Index find_span(const std::vector<double>& knots, int degree, double xi) {
  const auto first = knots.begin() + degree;
  const auto last = knots.end() - degree - 1;
  auto next = std::upper_bound(first, last, xi);  // first knot > xi
  if (next == last || !(*next < *last)) next = std::lower_bound(first, last, *last);
  if (next == first) next = std::upper_bound(first, last, *first);
  return static_cast<Index>(next - knots.begin()) - 1;
}

}  // namespace osculate::geometry
