#include "osculate/pairing/smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "osculate/pairing/chain.hpp"

namespace osculate::pairing {
namespace {

/// A vector as a combination of the nodes of one facet: begin, end, the one before, the one after.
using Combination = std::array<double, smooth_line_nodes>;

Combination combined(double a, const Combination& x, double b, const Combination& y) {
  Combination out;
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = a * x[k] + b * y[k];
  return out;
}

/// First and second derivative at an end of a facet.
struct Ends {
  Combination slope, bend;
};

/// The facets before and after one facet where the corner between is smooth; -1 elsewhere.
struct Neighbours {
  Index before = -1, after = -1;
};

Vec2 span_of(const Facet& facet, std::span<const Vec2> x) {
  return x[static_cast<std::size_t>(facet.nodes[1])] - x[static_cast<std::size_t>(facet.nodes[0])];
}

bool smooth_corner(const Facet& a, const Facet& b, std::span<const Vec2> x, double sharp_angle) {
  if (a.shape || b.shape || a.nodes[0] == b.nodes[1]) return false;
  const Vec2 u = span_of(a, x), v = span_of(b, x);
  return std::atan2(std::abs(turn(u).dot(v)), u.dot(v)) <= sharp_angle;
}

std::vector<Neighbours> smooth_neighbours(const Chain& chain, std::span<const Vec2> x,
                                          double sharp_angle) {
  std::vector<Neighbours> all(chain.facets.size());
  for (std::size_t f = 0; f < chain.facets.size(); ++f) {
    const Facet& facet = chain.facets[f];
    if (facet.next < 0) continue;
    const auto next = static_cast<std::size_t>(facet.next);
    if (!smooth_corner(facet, chain.facets[next], x, sharp_angle)) continue;
    all[f].after = facet.next;
    all[next].before = static_cast<Index>(f);
  }
  return all;
}

/// The parabola at the node between two facets with the divided differences e and lengths h.
Ends parabola(const Combination& e1, double h1, const Combination& e2, double h2) {
  const double sum = h1 + h2;
  return {combined(h2 / sum, e1, h1 / sum, e2), combined(2 / sum, e2, -2 / sum, e1)};
}

/// Derivatives at the one end by the parabola of the other, `way` facets lengths ahead.
Ends continued(const Ends& other, double way) {
  return {combined(1, other.slope, way, other.bend), other.bend};
}

/// Control points from both ends.
BezierWeights bezier_of(const std::array<Ends, 2>& ends, double h, SmoothingKind kind) {
  BezierWeights out;
  out.degree = kind == SmoothingKind::nurbs ? 5 : 3;
  const auto n = static_cast<double>(out.degree);
  const double bends = kind == SmoothingKind::nurbs ? h * h / (n * (n - 1)) : 0.0;
  for (std::size_t k = 0; k < smooth_line_nodes; ++k) {
    const double begin = k == 0 ? 1.0 : 0.0, end = k == 1 ? 1.0 : 0.0;
    auto& w = out.weight[k];
    w[0] = begin;
    w[1] = begin + h / n * ends[0].slope[k];
    w[out.degree - 1] = end - h / n * ends[1].slope[k];
    w[out.degree] = end;
    if (out.degree < 5) continue;
    w[2] = begin + 2 * h / n * ends[0].slope[k] + bends * ends[0].bend[k];
    w[3] = end - 2 * h / n * ends[1].slope[k] + bends * ends[1].bend[k];
  }
  return out;
}

/// In a ring of three the node before is the one after: one node has both shares.
void merge_ring(Facet& facet, BezierWeights& bezier) {
  if (facet.count < 4 || facet.nodes[2] != facet.nodes[3]) return;
  for (std::size_t j = 0; j <= bezier.degree; ++j) bezier.weight[2][j] += bezier.weight[3][j];
  facet.count = 3;
}

/// Powers from the control points, as Taylor coefficients in the middle.
///
/// Formula    power_d = C(n, d) / 2^n sum_j C(n - d, j) (difference of order d of the weights)_j
void set_powers(BezierWeights& bezier) {
  const std::size_t n = bezier.degree;
  auto w = bezier.weight;
  double ahead = std::ldexp(1.0, -static_cast<int>(n));  // C(n, d) / 2^n
  for (std::size_t d = 0; d <= n; ++d) {
    for (std::size_t k = 0; k < smooth_line_nodes; ++k) {
      double binomial = 1, sum = 0;  // C(n - d, j)
      for (std::size_t j = 0; j <= n - d; ++j) {
        sum += binomial * w[k][j];
        binomial *= static_cast<double>(n - d - j) / static_cast<double>(j + 1);
      }
      bezier.power[d][static_cast<Eigen::Index>(k)] = ahead * sum;
      for (std::size_t j = 0; j + d < n; ++j) w[k][j] = w[k][j + 1] - w[k][j];
    }
    ahead *= static_cast<double>(n - d) / static_cast<double>(d + 1);
  }
}

Facet smoothed(const Chain& chain, const Facet& facet, const Neighbours& at,
               std::span<const Vec2> x, SmoothingKind kind) {
  const double h = span_of(facet, x).norm();
  const Combination own{-1 / h, 1 / h, 0, 0};
  std::array<Ends, 2> ends;
  Facet out = facet;
  const auto add_node = [&](Index node) {
    out.nodes[static_cast<std::size_t>(out.count)] = node;
    return static_cast<std::size_t>(out.count++);
  };
  if (at.before >= 0) {
    const Facet& before = chain.facets[static_cast<std::size_t>(at.before)];
    const double length = span_of(before, x).norm();
    Combination e{1 / length, 0, 0, 0};
    e[add_node(before.nodes[0])] = -1 / length;
    ends[0] = parabola(e, length, own, h);
  }
  if (at.after >= 0) {
    const Facet& after = chain.facets[static_cast<std::size_t>(at.after)];
    const double length = span_of(after, x).norm();
    Combination e{0, -1 / length, 0, 0};
    e[add_node(after.nodes[1])] = 1 / length;
    ends[1] = parabola(own, h, e, length);
  }
  if (at.before < 0) ends[0] = continued(ends[1], -h);
  if (at.after < 0) ends[1] = continued(ends[0], h);
  BezierWeights bezier = bezier_of(ends, h, kind);
  merge_ring(out, bezier);
  set_powers(bezier);
  out.bezier = std::make_shared<const BezierWeights>(bezier);
  return out;
}

}  // namespace

cell::LineShape bezier_shape(const BezierWeights& bezier, int count, double xi) {
  using Four = Eigen::Array4d;
  const std::array<Four, 4> t =
      taylor_at(std::span<const Four>(bezier.power).first(bezier.degree + 1), xi);
  constexpr std::array<double, 4> factorial{1, 1, 2, 6};
  cell::LineShape shape;
  shape.count = count;
  for (std::size_t order = 0; order < t.size(); ++order)
    Eigen::Map<Four>(shape.n[order].data()) = factorial[order] * t[order];
  return shape;
}

Eigen::Array4d bezier_slopes(const BezierWeights& bezier, double xi) {
  Eigen::Array4d sum = Eigen::Array4d::Zero();
  for (std::size_t d = bezier.degree; d > 0; --d)
    sum = xi * sum + static_cast<double>(d) * bezier.power[d];
  return sum;
}

void smooth(Chain& chain, std::span<const Vec2> reference, const Smoothing& options) {
  if (options.kind == SmoothingKind::none) return;
  const std::vector<Neighbours> at = smooth_neighbours(chain, reference, options.sharp_angle);
  std::vector<Facet> facets = chain.facets;
  for (std::size_t f = 0; f < facets.size(); ++f)
    if (at[f].before >= 0 || at[f].after >= 0)
      facets[f] = smoothed(chain, chain.facets[f], at[f], reference, options.kind);
  chain.facets = std::move(facets);
}

}  // namespace osculate::pairing
