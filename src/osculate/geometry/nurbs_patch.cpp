#include "osculate/geometry/nurbs_patch.hpp"

#include <fmt/format.h>

#include <cmath>

#include "osculate/geometry/nurbs.hpp"

namespace osculate::geometry {
namespace {

/// Derivatives d/dxi1^a d/dxi2^b in the order of SurfaceJet.
constexpr std::array<std::array<std::size_t, 2>, 10> orders{
    {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}}};
constexpr std::array<std::size_t, 4> derivatives{1, 3, 6, 10};
constexpr std::array<std::array<double, 4>, 4> binomial{
    {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}}};

/// Weighted sums of control points and of weights.
struct Sums {
  std::array<Vec3, 10> point;
  std::array<double, 10> weight{};
};

Sums weighted_sums(const NurbsPatch& patch, const PatchSpan& span, const Vec2& xi,
                   std::size_t used) {
  const auto n = spline_basis(patch.knots[0], patch.degree[0], span[0], xi.x());
  const auto m = spline_basis(patch.knots[1], patch.degree[1], span[1], xi.y());
  Sums sums;
  sums.point.fill(Vec3::Zero());
  for (int i = 0; i <= patch.degree[0]; ++i)
    for (int j = 0; j <= patch.degree[1]; ++j) {
      const std::size_t at =
          patch.index(span[0] - patch.degree[0] + i, span[1] - patch.degree[1] + j);
      const Vec3& point = patch.control[at];
      for (std::size_t d = 0; d < used; ++d) {
        const double share = n[orders[d][0]][static_cast<std::size_t>(i)] *
                             m[orders[d][1]][static_cast<std::size_t>(j)] * patch.weights[at];
        sums.weight[d] += share;
        sums.point[d] += share * point;
      }
    }
  return sums;
}

/// From the sums to the derivatives of their quotient.
void divide(Sums& sums, std::size_t used) {
  for (std::size_t d = 0; d < used; ++d) {
    const auto [a, b] = orders[d];
    for (std::size_t e = 0; e < d; ++e) {  // the lower derivative e, times one of W
      const auto [p, q] = orders[e];
      if (p > a || q > b) continue;
      std::size_t w = 0;
      while (orders[w][0] != a - p || orders[w][1] != b - q) ++w;
      sums.point[d] -= binomial[a][p] * binomial[b][q] * sums.weight[w] * sums.point[e];
    }
    sums.point[d] /= sums.weight[0];
  }
}

/// Largest distance between two opposite borders; `along` is the parameter that runs along them.
double gap_between_borders(const NurbsPatch& patch, Eigen::Index along) {
  const Vec2 lo = patch.lo(), hi = patch.hi();
  double gap = 0;
  const auto side = static_cast<std::size_t>(along);
  const int samples = 2 * patch.count[side] + 1;
  for (int k = 0; k <= samples; ++k) {
    Vec2 a = lo, b = hi;
    a[along] = b[along] = lo[along] + (hi[along] - lo[along]) * k / samples;
    gap = std::max(gap, (patch.jet(a).r - patch.jet(b).r).norm());
  }
  return gap;
}

}  // namespace

Vec2 NurbsPatch::lo() const {
  return {knots[0][static_cast<std::size_t>(degree[0])],
          knots[1][static_cast<std::size_t>(degree[1])]};
}
Vec2 NurbsPatch::hi() const {
  return {knots[0][static_cast<std::size_t>(count[0])],
          knots[1][static_cast<std::size_t>(count[1])]};
}

ClosedFlags NurbsPatch::closed() const {
  Vec3 low = control.front(), high = control.front();
  for (const Vec3& point : control) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double same = 1e-12 * (high - low).norm();
  return {gap_between_borders(*this, 1) <= same, gap_between_borders(*this, 0) <= same};
}

PatchSpan NurbsPatch::find_span(const Vec2& xi) const {
  return {geometry::find_span(knots[0], degree[0], xi.x()),
          geometry::find_span(knots[1], degree[1], xi.y())};
}

SurfaceJet NurbsPatch::jet_in_span(const PatchSpan& span, const Vec2& xi, int order) const {
  const std::size_t used = derivatives[static_cast<std::size_t>(order)];
  Sums sums = weighted_sums(*this, span, xi, used);
  divide(sums, used);
  const std::array<Vec3, 10>& p = sums.point;
  return {p[0], {p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8], p[9]}};
}

std::string validate(const NurbsPatch& patch) {
  for (std::size_t d = 0; d < 2; ++d) {
    const auto points = static_cast<std::size_t>(std::max(patch.count[d], 0));
    if (std::string text = validate_knots(points, patch.degree[d], patch.knots[d]); !text.empty())
      return fmt::format("direction {}: {}", d + 1, text);
  }
  const auto points =
      static_cast<std::size_t>(patch.count[0]) * static_cast<std::size_t>(patch.count[1]);
  if (patch.control.size() != points)
    return fmt::format("control: expected {} rows of {} points, found {} points", patch.count[0],
                       patch.count[1], patch.control.size());
  if (patch.weights.size() != points)
    return fmt::format("weights: expected one for each of the {} control points, found {}", points,
                       patch.weights.size());
  for (std::size_t k = 0; k < points; ++k) {
    if (!patch.control[k].allFinite())
      return fmt::format("control: expected finite coordinates, point {} has none", k);
    if (!(patch.weights[k] > 0) || !std::isfinite(patch.weights[k]))
      return fmt::format("weights: expected numbers > 0, weight {} is {}", k, patch.weights[k]);
  }
  return {};
}

NurbsPatch reversed(const NurbsPatch& patch) {
  NurbsPatch out{.degree = {patch.degree[1], patch.degree[0]},
                 .knots = {patch.knots[1], patch.knots[0]},
                 .count = {patch.count[1], patch.count[0]},
                 .control = patch.control,
                 .weights = patch.weights};
  for (Index i = 0; i < patch.count[0]; ++i)
    for (Index j = 0; j < patch.count[1]; ++j) {
      out.control[out.index(j, i)] = patch.control[patch.index(i, j)];
      out.weights[out.index(j, i)] = patch.weights[patch.index(i, j)];
    }
  return out;
}

}  // namespace osculate::geometry
