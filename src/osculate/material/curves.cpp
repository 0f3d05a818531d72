#include "osculate/material/curves.hpp"

#include <algorithm>

#include "osculate/material/between.hpp"

namespace osculate::material {

CurvePiece piece_at(const core::Table& points, double plastic) {
  const auto above = std::upper_bound(
      points.begin(), points.end(), plastic,
      [](double value, const std::array<double, 2>& point) { return value < point[1]; });
  const std::size_t next =
      std::max<std::size_t>(1, static_cast<std::size_t>(above - points.begin()));
  const std::array<double, 2>& a = points[next - 1];
  if (next >= points.size()) return {a[1], std::numeric_limits<double>::infinity(), a[0], 0};
  const std::array<double, 2>& b = points[next];
  return {a[1], b[1], a[0], (b[0] - a[0]) / (b[1] - a[1])};
}

CurvePiece piece_at(const core::Curves& curves, const double* temperature, double plastic) {
  if (!temperature) return piece_at(curves.front().points, plastic);
  const auto at = between(curves, *temperature, [](const auto& c) { return c.temperature; });
  const CurvePiece a = piece_at(at.below.points, plastic), b = piece_at(at.above.points, plastic);
  const double weight = at.weight;
  const double start = std::max(a.start, b.start);
  return {start, std::min(a.end, b.end), (1 - weight) * a.at(start) + weight * b.at(start),
          (1 - weight) * a.slope + weight * b.slope};
}

double steepest_fall(const core::Curves& curves) {
  double least = 0;
  for (const core::Curve& curve : curves)
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
      const auto [from, start] = curve.points[i - 1];
      const auto [to, end] = curve.points[i];
      least = std::min(least, (to - from) / (end - start));
    }
  return -least;
}

}  // namespace osculate::material
