#include "osculate/geometry/interpolation.hpp"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cassert>

#include "osculate/geometry/spline_basis.hpp"

namespace osculate::geometry {
namespace {

std::vector<double> inner_knots(const std::vector<double>& t, int degree) {
  if (degree < 3) return {};
  return {t.begin() + 2, t.end() - 2};
}

/// Values of all B-splines at the points; with these knots every point has one of its own.
Eigen::SparseMatrix<double> collocation(const std::vector<double>& knots, int degree,
                                        const std::vector<double>& t) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Index span = find_span(knots, degree, t[i]);
    const SplineRow row = spline_basis(knots, degree, span, t[i])[0];
    for (int k = 0; k <= degree; ++k)
      entries.emplace_back(static_cast<int>(i), static_cast<int>(span) - degree + k,
                           row[static_cast<std::size_t>(k)]);
  }
  const auto n = static_cast<Eigen::Index>(t.size());
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

NurbsCurve spline_through(const std::vector<double>& t, const std::vector<Vec2>& p) {
  assert(t.size() >= 2 && t.size() == p.size());
  NurbsCurve curve;
  curve.degree = static_cast<int>(std::min<std::size_t>(3, t.size() - 1));
  const auto ends = static_cast<std::size_t>(curve.degree) + 1;
  curve.knots.assign(ends, t.front());
  const std::vector<double> inner = inner_knots(t, curve.degree);
  curve.knots.insert(curve.knots.end(), inner.begin(), inner.end());
  curve.knots.insert(curve.knots.end(), ends, t.back());
  Eigen::MatrixX2d values(static_cast<Eigen::Index>(p.size()), 2);
  for (std::size_t i = 0; i < p.size(); ++i)
    values.row(static_cast<Eigen::Index>(i)) = p[i].transpose();
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(
      collocation(curve.knots, curve.degree, t));
  const Eigen::MatrixX2d control = solver.solve(values);
  for (Eigen::Index i = 0; i < control.rows(); ++i)
    curve.control.emplace_back(control.row(i).transpose());
  curve.weights.assign(curve.control.size(), 1.0);
  return curve;
}

NurbsCurve graph_through(const std::vector<double>& x, const std::vector<double>& y) {
  assert(x.size() >= 2 && x.size() == y.size());
  const double way = x.front() < x.back() ? 1.0 : -1.0;
  std::vector<double> t;
  std::vector<Vec2> p;
  for (std::size_t i = 0; i < x.size(); ++i) {
    t.push_back(way * x[i]);
    p.emplace_back(x[i], y[i]);
  }
  return spline_through(t, p);
}

}  // namespace osculate::geometry
