#include "osculate/pairing/chain.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "osculate/cell/quadrature.hpp"

namespace osculate::pairing {

Facet lagrange_facet(std::span<const Index> nodes) {
  Facet facet;
  facet.count = static_cast<int>(nodes.size());
  std::copy(nodes.begin(), nodes.end(), facet.nodes.begin());
  return facet;
}

Facet shape_facet(geometry::Curve curve, const std::array<Index, 3>& frame) {
  Facet facet;
  facet.count = 3;
  std::copy(frame.begin(), frame.end(), facet.nodes.begin());
  facet.lo = geometry::lo(curve);
  facet.hi = geometry::hi(curve);
  facet.closed = geometry::closed(curve);
  facet.shape = std::make_shared<const geometry::Curve>(std::move(curve));
  return facet;
}

void add_curves(const std::vector<geometry::Curve>& curves, bool closed,
                const std::array<Index, 3>& frame, Chain& chain) {
  const auto first = static_cast<Index>(chain.facets.size());
  const auto count = static_cast<Index>(curves.size());
  for (Index i = 0; i < count; ++i) {
    Facet facet = shape_facet(curves[static_cast<std::size_t>(i)], frame);
    if (i > 0 || closed) facet.prev = first + (i + count - 1) % count;
    if (i + 1 < count || closed) facet.next = first + (i + 1) % count;
    chain.facets.push_back(std::move(facet));
  }
}

void connect(Chain& chain) {
  std::unordered_map<Index, Index> starts;
  for (std::size_t f = 0; f < chain.facets.size(); ++f) {
    Facet& facet = chain.facets[f];
    if (facet.shape) {
      if (facet.closed) facet.prev = facet.next = static_cast<Index>(f);
      continue;
    }
    starts.emplace(facet.nodes[0], static_cast<Index>(f));
  }
  for (std::size_t f = 0; f < chain.facets.size(); ++f) {
    Facet& facet = chain.facets[f];
    if (facet.shape) continue;
    const auto found = starts.find(facet.nodes[1]);
    if (found == starts.end()) continue;
    facet.next = found->second;
    chain.facets[static_cast<std::size_t>(found->second)].prev = static_cast<Index>(f);
  }
}

cell::LineShape facet_shape(const Facet& facet, double xi) {
  if (facet.bezier) return bezier_shape(*facet.bezier, facet.count, xi);
  if (!facet.shape) return cell::lagrange_line(facet.count, xi);
  const geometry::CurveJet<2> jet = geometry::jet(*facet.shape, xi);
  cell::LineShape shape;
  shape.count = 3;
  const std::array<const Vec2*, 4> d{&jet.r, &jet.r1, &jet.r2, &jet.r3};
  for (std::size_t order = 0; order < 4; ++order) {
    shape.n[order][0] = (order == 0 ? 1.0 : 0.0) - d[order]->sum();
    shape.n[order][1] = d[order]->x();
    shape.n[order][2] = d[order]->y();
  }
  return shape;
}

geometry::CurveJet<2> facet_jet(const Facet& facet, const cell::LineShape& shape,
                                std::span<const Vec2> x) {
  geometry::CurveJet<2> jet;
  for (int k = 0; k < shape.count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Vec2& node = x[static_cast<std::size_t>(facet.nodes[i])];
    jet.r += shape.n[0][i] * node;
    jet.r1 += shape.n[1][i] * node;
    jet.r2 += shape.n[2][i] * node;
    jet.r3 += shape.n[3][i] * node;
  }
  return jet;
}

geometry::LagrangeCurve facet_curve(const Facet& facet, std::span<const Vec2> x) {
  geometry::LagrangeCurve curve;
  curve.count = facet.count;
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
    curve.nodes[k] = x[static_cast<std::size_t>(facet.nodes[k])];
  return curve;
}

SmoothCurve::SmoothCurve(const Facet& facet, std::span<const Vec2> x)
    : degree(facet.bezier->degree) {
  power.fill(Vec2::Zero());
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k) {
    const Vec2& node = x[static_cast<std::size_t>(facet.nodes[k])];
    for (std::size_t d = 0; d <= degree; ++d)
      power[d] += facet.bezier->power[d][static_cast<Eigen::Index>(k)] * node;
  }
}

namespace {

constexpr int curved_points = 10;

const cell::Quadrature1D& curved_rule() {
  static const cell::Quadrature1D rule = cell::gauss_legendre(curved_points);
  return rule;
}

/// First derivatives of the shape functions of a facet's nodes.
std::array<double, cell::max_line_nodes> slopes_at(const Facet& facet, double xi) {
  if (!facet.bezier) return facet_shape(facet, xi).n[1];
  std::array<double, cell::max_line_nodes> n{};
  Eigen::Map<Eigen::Array4d>(n.data()) = bezier_slopes(*facet.bezier, xi);
  return n;
}

/// Length of facet between a and b (signed) and its gradient.
double piece_length(const Facet& facet, std::span<const Vec2> x, double a, double b,
                    std::vector<NodeGradient<2>>* gradient) {
  const double half = 0.5 * (b - a);
  const double middle = 0.5 * (a + b);
  const bool one_point = facet.straight();
  const int points = one_point ? 1 : curved_points;
  const auto count = static_cast<std::size_t>(facet.count);
  double length = 0;
  std::array<Vec2, cell::max_line_nodes> nodes, sum;
  for (std::size_t k = 0; k < count; ++k) nodes[k] = x[static_cast<std::size_t>(facet.nodes[k])];
  sum.fill(Vec2::Zero());
  for (int i = 0; i < points; ++i) {
    const double xi =
        one_point ? middle : middle + half * curved_rule().points[static_cast<std::size_t>(i)];
    const double weight =
        half * (one_point ? 2.0 : curved_rule().weights[static_cast<std::size_t>(i)]);
    const std::array<double, cell::max_line_nodes> slope = slopes_at(facet, xi);
    Vec2 r1 = Vec2::Zero();
    for (std::size_t k = 0; k < count; ++k) r1 += slope[k] * nodes[k];
    const double speed = r1.norm();
    length += weight * speed;  // @eq KS2D:19
    if (!gradient || !(speed > 0)) continue;
    const Vec2 tangent = r1 / speed;
    for (std::size_t k = 0; k < count; ++k) sum[k] += weight * slope[k] * tangent;
  }
  if (gradient)
    for (std::size_t k = 0; k < count; ++k) gradient->push_back({facet.nodes[k], sum[k]});
  return length;
}

/// Facets to cross from `from` to `to` going forward (or backward), -1 if there is no way.
int hops(const Chain& chain, Index from, Index to, bool forward) {
  Index facet = from;
  for (int count = 1; count <= static_cast<int>(chain.facets.size()); ++count) {
    const Facet& here = chain.facets[static_cast<std::size_t>(facet)];
    facet = forward ? here.next : here.prev;
    if (facet < 0) return -1;
    if (facet == to) return count;
  }
  return -1;
}

double same_facet_length(const Facet& facet, std::span<const Vec2> x, double a, double b,
                         std::vector<NodeGradient<2>>* gradient) {
  double step = b - a;
  if (facet.closed && facet.shape) step = std::remainder(step, facet.hi - facet.lo);
  return piece_length(facet, x, a, a + step, gradient);
}

/// Length of the way from `from` to another facet, forward or backward (there must be one).
double walk(const Chain& chain, std::span<const Vec2> x, const Location& from, const Location& to,
            bool forward, std::vector<NodeGradient<2>>* gradient) {
  const auto at = [&](Index f) -> const Facet& {
    return chain.facets[static_cast<std::size_t>(f)];
  };
  const auto leave = [&](const Facet& f) { return forward ? f.hi : f.lo; };
  const auto enter = [&](const Facet& f) { return forward ? f.lo : f.hi; };
  double length = piece_length(at(from.facet), x, from.xi, leave(at(from.facet)), gradient);
  Index facet = forward ? at(from.facet).next : at(from.facet).prev;
  while (facet != to.facet) {
    length += piece_length(at(facet), x, enter(at(facet)), leave(at(facet)), gradient);
    facet = forward ? at(facet).next : at(facet).prev;
  }
  return length + piece_length(at(facet), x, enter(at(facet)), to.xi, gradient);
}

}  // namespace

std::optional<double> path_length(const Chain& chain, std::span<const Vec2> x, const Location& from,
                                  const Location& to, std::vector<NodeGradient<2>>* gradient) {
  if (from.facet < 0 || to.facet < 0) return std::nullopt;
  if (from.facet == to.facet)
    return same_facet_length(chain.facets[static_cast<std::size_t>(from.facet)], x, from.xi, to.xi,
                             gradient);
  const int ahead = hops(chain, from.facet, to.facet, true);
  const int behind = hops(chain, from.facet, to.facet, false);
  if (ahead < 0 && behind < 0) return std::nullopt;
  bool forward = behind < 0 || (ahead >= 0 && ahead <= behind);
  if (ahead == behind)  // opposite facets of a closed chain: both ways cross as many borders
    forward = std::abs(walk(chain, x, from, to, true, nullptr)) <=
              std::abs(walk(chain, x, from, to, false, nullptr));
  return walk(chain, x, from, to, forward, gradient);
}

std::optional<ReentrantVertex> reentrant_vertex_after(const Chain& chain, Index facet,
                                                      std::span<const Vec2> x) {
  constexpr double least_sine = 1e-6;  // a straight line is no corner, whatever rounding says
  const auto number = static_cast<std::size_t>(facet);
  const Facet& before = chain.facets[number];
  if (before.next < 0 || before.next == facet) return std::nullopt;
  if (number < chain.sharp_behind.size() && !chain.sharp_behind[number]) return std::nullopt;
  const Facet& behind = chain.facets[static_cast<std::size_t>(before.next)];
  const geometry::CurveJet<2> end = facet_jet(before, before.hi, x);
  ReentrantVertex v;
  v.facets = {facet, before.next};
  v.end = before.hi;
  v.point = end.r;
  v.along = {end.r1.normalized(), facet_jet(behind, behind.lo, x).r1.normalized()};
  v.normal = {turn(v.along[0]), turn(v.along[1])};
  v.bisector = (v.normal[0] + v.normal[1]).normalized();
  if (!(v.normal[0].dot(v.along[1]) > least_sine)) return std::nullopt;
  return v;
}

bool mark_reentrant_vertices(Chain& chain, std::span<const Vec2> x, double angle) {
  std::vector<char> sharp(chain.facets.size(), 0);
  chain.sharp_behind.clear();
  for (std::size_t f = 0; f < sharp.size(); ++f)
    if (const std::optional<ReentrantVertex> v =
            reentrant_vertex_after(chain, static_cast<Index>(f), x))
      sharp[f] = std::atan2(v->normal[0].dot(v->along[1]), v->along[0].dot(v->along[1])) > angle;
  chain.sharp_behind = std::move(sharp);
  return std::ranges::any_of(chain.sharp_behind, [](char is) { return is != 0; });
}

}  // namespace osculate::pairing
