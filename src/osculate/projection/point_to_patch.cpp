// Closest point of a NURBS patch.
#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/projection/point_to_curve.hpp"
#include "osculate/projection/point_to_surface.hpp"
#include "osculate/projection/surface_distance.hpp"
#include "osculate/search/box.hpp"

namespace osculate::projection {
namespace {

using geometry::NurbsPatch;
using geometry::PatchSpan;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// One span of the patch and the point to project.
struct PatchPiece {
  const NurbsPatch& patch;
  Vec3 point;
  PatchSpan span;
  Vec2 lo, hi;
};

struct Sample {
  Vec2 xi{0, 0};
  DistanceJet2 distance;
  Vec2 noise{0, 0};  ///< rounding error to expect in the slope
};

Sample sample_at(const PatchPiece& piece, const Vec2& xi) {
  const geometry::SurfaceJet jet = piece.patch.jet_in_span(piece.span, xi, 2);
  const Vec3 gap = piece.point - jet.r;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double size = 4 * epsilon * (gap.lpNorm<1>() + jet.r.lpNorm<1>());
  return {xi,
          distance_jet2<3>(gap, jet.r1, jet.r2),
          {size * jet.r1[0].lpNorm<1>(), size * jet.r1[1].lpNorm<1>()}};
}

/// The nearest point so far and the range of its piece.
struct Best {
  Sample sample;
  Vec2 lo{0, 0}, hi{0, 0};
  [[nodiscard]] double squared_distance() const { return sample.distance.squared_distance; }
};

/// Pressed against a side of the piece: moving inwards would only lead away.
bool pressed(const PatchPiece& piece, const Sample& s, Eigen::Index i) {
  return (s.xi[i] <= piece.lo[i] && s.distance.slope[i] > 0) ||
         (s.xi[i] >= piece.hi[i] && s.distance.slope[i] < 0);
}

/// Newton's step in the directions that are free.
Vec2 free_step(const Sample& s, const std::array<bool, 2>& fixed) {
  if (!fixed[0] && !fixed[1]) return descent(s.distance);
  Vec2 step(0, 0);
  for (Eigen::Index i = 0; i < 2; ++i) {
    if (fixed[static_cast<std::size_t>(i)]) continue;
    const double bend = s.distance.bend(i, i), a = s.distance.metric(i, i);
    step[i] = -s.distance.slope[i] / (bend > 0 ? bend : std::max(a, 1e-300));
  }
  return step;
}

/// Tries the step, halved until the distance shrinks; true if `s` has moved.
bool advance(const PatchPiece& piece, const Vec2& step, Sample& s) {
  constexpr int most = 40;
  Vec2 part = step;
  for (int half = 0; half < most; ++half, part *= 0.5) {
    const Vec2 xi = (s.xi + part).cwiseMax(piece.lo).cwiseMin(piece.hi);
    if (xi == s.xi) return false;
    const Sample next = sample_at(piece, xi);
    if (next.distance.squared_distance < s.distance.squared_distance) {
      s = next;
      return true;
    }
  }
  return false;
}

/// Takes full Newton steps that the distance is too coarse to judge, while the slope shrinks.
void polish(const PatchPiece& piece, const std::array<bool, 2>& fixed, Sample& s) {
  for (int it = 0; it < 3 && positive(s.distance.bend); ++it) {
    const Vec2 step = free_step(s, fixed);
    if (!step.allFinite()) return;
    const Sample next = sample_at(piece, (s.xi + step).cwiseMax(piece.lo).cwiseMin(piece.hi));
    double before = 0, after = 0;
    for (Eigen::Index i = 0; i < 2; ++i) {
      if (fixed[static_cast<std::size_t>(i)]) continue;
      before += std::abs(s.distance.slope[i]);
      after += std::abs(next.distance.slope[i]);
    }
    if (!(after < before)) return;
    s = next;
  }
}

/// Local minimum of the piece below `s`.
void descend(const PatchPiece& piece, Sample& s) {
  constexpr int most = 60;
  std::array<bool, 2> fixed{};
  for (int it = 0; it < most; ++it) {
    bool level = true;
    for (Eigen::Index i = 0; i < 2; ++i) {
      const auto k = static_cast<std::size_t>(i);
      fixed[k] = pressed(piece, s, i);
      level = level && (fixed[k] || std::abs(s.distance.slope[i]) <= s.noise[i]);
    }
    if (level) return;
    const Vec2 step = free_step(s, fixed);
    if (step.allFinite() && advance(piece, step, s)) continue;
    Vec2 down(0, 0);  // a step cut off at a side need not lead down
    for (Eigen::Index i = 0; i < 2; ++i)
      if (!fixed[static_cast<std::size_t>(i)])
        down[i] = -s.distance.slope[i] / std::max(s.distance.metric(i, i), 1e-300);
    if (!down.allFinite() || !advance(piece, down, s)) break;
  }
  polish(piece, fixed, s);
}

/// The control points of a span surround its piece of the surface.
double nearest_possible(const NurbsPatch& patch, const PatchSpan& span, const Vec3& point) {
  search::Box<3> box;
  for (Index i = span[0] - patch.degree[0]; i <= span[0]; ++i)
    for (Index j = span[1] - patch.degree[1]; j <= span[1]; ++j)
      box.extend(patch.control[patch.index(i, j)]);
  return box.squared_distance(point);
}

constexpr int most_samples = 2 * geometry::max_spline_degree + 1;
using Grid = std::array<std::array<double, most_samples>, most_samples>;

bool local_minimum(const Grid& grid, const std::array<int, 2>& last, int i, int j) {
  const auto at = [&grid](int a, int b) {
    return grid[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  };
  for (int a = std::max(i - 1, 0); a <= std::min(i + 1, last[0]); ++a)
    for (int b = std::max(j - 1, 0); b <= std::min(j + 1, last[1]); ++b)
      if (at(a, b) < at(i, j)) return false;
  return true;
}

/// Improves `best` by the minima of one piece.
void search_piece(const PatchPiece& piece, Best& best) {
  Grid grid;
  const std::array<int, 2> last{2 * piece.patch.degree[0], 2 * piece.patch.degree[1]};
  const auto xi_at = [&](int i, int j) {
    const Vec2 t(static_cast<double>(i) / last[0], static_cast<double>(j) / last[1]);
    return Vec2(((Vec2::Ones() - t).cwiseProduct(piece.lo) + t.cwiseProduct(piece.hi)));
  };
  for (int i = 0; i <= last[0]; ++i)
    for (int j = 0; j <= last[1]; ++j)
      grid[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          (piece.point - piece.patch.jet_in_span(piece.span, xi_at(i, j), 0).r).squaredNorm();
  for (int i = 0; i <= last[0]; ++i)
    for (int j = 0; j <= last[1]; ++j) {
      if (!local_minimum(grid, last, i, j)) continue;
      Sample s = sample_at(piece, xi_at(i, j));
      descend(piece, s);
      // Pieces meet: a later one must be nearer by more than rounding.
      const double rounding = best.squared_distance() == infinity ? 0 : 1e-15;
      if (s.distance.squared_distance < best.squared_distance() * (1 - rounding))
        best = {s, piece.lo, piece.hi};
    }
}

/// visit(piece) for every non-empty span.
template <class Visit>
void for_each_piece(const NurbsPatch& patch, const Vec3& point, const Visit& visit) {
  const std::array<std::vector<double>, 2>& u = patch.knots;
  for (Index i = patch.degree[0]; i < patch.count[0]; ++i)
    for (Index j = patch.degree[1]; j < patch.count[1]; ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      if (!(u[0][a] < u[0][a + 1] && u[1][b] < u[1][b + 1])) continue;
      visit(PatchPiece{patch, point, {i, j}, {u[0][a], u[1][b]}, {u[0][a + 1], u[1][b + 1]}});
    }
}

/// Opposite borders of the patch meet at the border point `here`.
bool meets_itself(const NurbsPatch& patch, const Vec2& xi, Eigen::Index i) {
  Vec2 opposite = xi;
  opposite[i] = xi[i] <= patch.lo()[i] ? patch.hi()[i] : patch.lo()[i];
  const Vec3 here = patch.jet(xi).r, there = patch.jet(opposite).r;
  const double size = (patch.control.front() - here).norm() + here.norm();
  return (here - there).norm() <= 1e-12 * size;
}

/// Sets `at_border` and `at_kink` where the foot point is pulled out of its piece.
void classify(const NurbsPatch& patch, const Best& best, SurfaceFoot& foot) {
  const Vec2 lo = patch.lo(), hi = patch.hi();
  const Sample& s = best.sample;
  for (Eigen::Index i = 0; i < 2; ++i) {
    const bool low = s.xi[i] <= best.lo[i], high = s.xi[i] >= best.hi[i];
    const double slope = s.distance.slope[i];
    if (!(low && slope > 0) && !(high && slope < 0)) continue;
    const double scale = std::max(s.distance.bend(i, i), 1e-3 * s.distance.metric(i, i));
    if (std::abs(slope) <= std::max(end_tolerance * (hi[i] - lo[i]) * scale, s.noise[i])) continue;
    const bool outer = low ? s.xi[i] <= lo[i] : s.xi[i] >= hi[i];
    (outer && !meets_itself(patch, s.xi, i) ? foot.at_border : foot.at_kink) = true;
  }
}

}  // namespace

SurfaceFoot closest_point(const geometry::NurbsPatch& patch, const Vec3& point) {
  SurfaceFoot foot;
  foot.xi = patch.lo();
  if (!point.allFinite()) return foot;
  // The most promising span first, then those that may hold something nearer.
  double least = infinity;
  PatchSpan first{-1, -1};
  for_each_piece(patch, point, [&](const PatchPiece& piece) {
    const double d = nearest_possible(patch, piece.span, point);
    if (d < least) least = d, first = piece.span;
  });
  Best best;
  best.sample.distance.squared_distance = infinity;
  for_each_piece(patch, point, [&](const PatchPiece& piece) {
    if (piece.span == first) search_piece(piece, best);
  });
  for_each_piece(patch, point, [&](const PatchPiece& piece) {
    if (piece.span == first) return;
    if (nearest_possible(patch, piece.span, point) < best.squared_distance())
      search_piece(piece, best);
  });
  if (!std::isfinite(best.squared_distance())) return foot;
  foot.converged = true;
  foot.xi = best.sample.xi;
  foot.squared_distance = best.squared_distance();
  classify(patch, best, foot);
  return foot;
}

}  // namespace osculate::projection
