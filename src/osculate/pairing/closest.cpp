#include "osculate/pairing/closest.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/pairing/other_side.hpp"
#include "osculate/projection/point_to_curve.hpp"

namespace osculate::pairing {
namespace {

using projection::CurveFoot;
using projection::Feature;

Vec2 node(const Facet& facet, std::size_t k, std::span<const Vec2> x) {
  return x[static_cast<std::size_t>(facet.nodes[k])];
}

Vec2 unit_normal(const Facet& facet, double xi, std::span<const Vec2> x) {
  const Vec2 tangent = facet_jet(facet, xi, x).r1;
  const double length = tangent.norm();
  return length > 0 ? Vec2(turn(tangent) / length) : Vec2(Vec2::Zero());
}

/// Whether the chain ends for this point behind the facet: nothing is there, or another side.
bool ends_at(const Chain& chain, const Facet& facet, bool high, std::span<const Vec2> x,
             const ProjectionQuery<2>& query) {
  const Index next = high ? facet.next : facet.prev;
  if (next < 0 || query.kept >= 0) return true;
  if (facet.shape || (!query.slave_normal && !query.filter)) return false;
  const Facet& other = chain.facets[static_cast<std::size_t>(next)];
  return ends_between<2>(query, unit_normal(facet, high ? facet.hi : facet.lo, x),
                         unit_normal(other, high ? other.lo : other.hi, x),
                         node(other, high ? 1 : 0, x) - node(facet, high ? 0 : 1, x));
}

/// The true foot point just beyond an end of the facet, by Newton's steps on the continued curve.
///
/// Between neighbours this covers the tolerance of the projection: clamped to the end, the slip
/// would stand still there and then jump. But a point that is seen from the end at an angle to the
/// normal belongs to the corner there, however near: between a normal and the next the force of a
/// point that rests in a re-entrant vertex would jump. At an open end of the chain the facet is
/// continued by `beyond_open` of its range: the last node of a surface must not lose contact
/// because its master tilts or stretches a little.
template <class Jet, class Open>
void release_end(const Jet& jet, const Facet& facet, const Vec2& point, const Open& open,
                 const ProjectionQuery<2>& query, CurveFoot& foot) {
  if (!foot.converged || (foot.xi != facet.lo && foot.xi != facet.hi)) return;
  const bool high = foot.xi == facet.hi, open_end = open(high);
  if (foot.at_end && !open_end) return;
  const double range = facet.hi - facet.lo;
  const bool kept = query.kept >= 0 && (high ? facet.next : facet.prev) >= 0;
  const double extension = kept ? end_extension : query.beyond_open;
  const double limit = (open_end ? extension : 2 * projection::end_tolerance) * range;
  double xi = foot.xi;
  projection::DistanceJet d = projection::distance_jet(jet(xi), xi, point);
  const bool beyond = high ? d.slope < 0 : d.slope > 0;
  const double least = 1e-10 * range * std::sqrt(d.a11);  // nearer: the angle is rounding
  if (!open_end && beyond && std::abs(d.slope) > 4 * d.noise &&
      d.squared_distance > least * least) {
    foot.at_end = true;
    return;
  }
  for (int i = 0; i < 8 && d.bend > 0; ++i) {
    const double step = projection::newton_step(d);
    xi += step;
    if (std::abs(xi - foot.xi) > limit) return;
    d = projection::distance_jet(jet(xi), xi, point);
    if (std::abs(step) <= 1e-15 * range) break;
  }
  if (!(d.bend > 0)) return;
  foot.xi = xi;
  foot.squared_distance = d.squared_distance;
  foot.at_end = false;
}

/// Foot point on one facet in the current configuration.
CurveFoot foot_on_facet(const Chain& chain, const Facet& facet, std::span<const Vec2> x,
                        const ProjectionQuery<2>& query) {
  const Vec2& point = query.point;
  const auto open = [&](bool high) { return ends_at(chain, facet, high, x, query); };
  if (facet.shape) {
    const Vec2 origin = node(facet, 0, x);
    const Vec2 arm = point - origin;
    const Vec2 local(arm.dot(node(facet, 1, x) - origin), arm.dot(node(facet, 2, x) - origin));
    CurveFoot foot = projection::closest_point(*facet.shape, local);
    const Index beyond = foot.xi == facet.hi ? facet.next : facet.prev;
    if (beyond >= 0 && !facet.closed)
      release_end([&](double xi) { return geometry::jet(*facet.shape, xi); }, facet, local, open,
                  query, foot);
    return foot;
  }
  const auto released = [&](const auto& curve, CurveFoot foot) {
    release_end([&](double xi) { return curve.jet(xi); }, facet, point, open, query, foot);
    return foot;
  };
  if (facet.bezier) {
    const SmoothCurve curve(facet, x);
    const auto jet = [&](double xi) { return curve.jet(xi); };
    const int samples = 4 * static_cast<int>(curve.degree);
    return released(curve, projection::closest_on_interval(jet, -1, 1, samples, point));
  }
  const geometry::LagrangeCurve curve = facet_curve(facet, x);
  return released(curve, projection::closest_point(curve, point));
}

/// Candidate of one facet, and the order among candidates that are equally near.
struct Candidate {
  Index facet = -1;
  CurveFoot foot;
  double distance = std::numeric_limits<double>::infinity();
  double cosine = -1;  ///< of the angle between the normals of facet and slave
};

int rank(const Candidate& c, Index history) {
  if (c.foot.at_end) return 3;
  if (c.facet == history) return 0;
  return across(c.cosine) ? 2 : 1;
}

bool better(const Candidate& a, const Candidate& b, Index history, double tie) {
  if (b.facet < 0) return true;
  if (std::abs(a.distance - b.distance) > tie) return a.distance < b.distance;
  const int ra = rank(a, history), rb = rank(b, history);
  return ra != rb ? ra < rb : a.facet < b.facet;
}

/// A kink inside an analytic curve: the normals just before and after it.
void add_kink_normal(const Facet& facet, double xi, std::span<const Vec2> x, Projection<2>& p) {
  const double step = 1e-9 * (facet.hi - facet.lo);
  p.outward = unit_normal(facet, xi - step, x) + unit_normal(facet, xi + step, x);
  if (p.outward.norm() > 0) p.outward.normalize();
}

/// Fills in what a vertex needs: its outward direction from both neighbours, or that the chain
/// ends.
void resolve_end(const Chain& chain, std::span<const Vec2> x, const ProjectionQuery<2>& query,
                 Projection<2>& p) {
  const Facet& facet = chain.facets[static_cast<std::size_t>(p.facet)];
  const double xi = p.xi[0];
  const bool at_high = xi > 0.5 * (facet.lo + facet.hi);
  const Index neighbour = at_high ? facet.next : facet.prev;
  p.local = at_high ? 1 : 0;
  p.outward = unit_normal(facet, xi, x);
  const double range = facet.hi - facet.lo;
  const double to_end = std::min(facet.hi - xi, xi - facet.lo);
  if (to_end > 1e-6 * range) return add_kink_normal(facet, xi, x, p);
  if (ends_at(chain, facet, at_high, x, query)) {
    p.beyond_end = true;
    return;
  }
  const Facet& other = chain.facets[static_cast<std::size_t>(neighbour)];
  p.outward += unit_normal(other, at_high ? other.lo : other.hi, x);
  if (p.outward.norm() > 0) p.outward.normalize();
}

/// Two neighbours at the same distance and no history to choose: the vertex between them.
void share(const Chain& chain, std::span<const Vec2> x, Index other,
           const ProjectionQuery<2>& query, Projection<2>& p) {
  const Facet& facet = chain.facets[static_cast<std::size_t>(p.facet)];
  if (facet.next != other && facet.prev != other) return;
  p.feature = Feature::corner;
  p.xi[0] = facet.next == other ? facet.hi : facet.lo;
  resolve_end(chain, x, query, p);
}

/// Of the angle between the normals of facet and slave; -1 where the slave's does not matter. A
/// facet that faces the same way as the slave is the far side of a thin body.
double cosine_at(const Facet& facet, const CurveFoot& foot, std::span<const Vec2> x,
                 const ProjectionQuery<2>& query) {
  return query.slave_normal ? unit_normal(facet, foot.xi, x).dot(*query.slave_normal) : -1.0;
}

/// What `entered_through` asks of a candidate.
struct Look {
  const Chain& chain;
  std::span<const Vec2> x;
  const ProjectionQuery<2>& query;

  [[nodiscard]] const Facet& facet(Index f) const {
    return chain.facets[static_cast<std::size_t>(f)];
  }
  [[nodiscard]] Candidate on(Index f) const {
    const CurveFoot foot = foot_on_facet(chain, facet(f), x, query);
    return {f, foot, std::sqrt(foot.squared_distance), cosine_at(facet(f), foot, x, query)};
  }
  [[nodiscard]] bool inside(const Candidate& c) const {
    return c.foot.converged && !c.foot.at_end &&
           (!query.filter || admits(*query.filter, facet(c.facet), c.foot.xi, x));
  }
  [[nodiscard]] double gap(const Candidate& c) const {
    return (query.point - facet_jet(facet(c.facet), c.foot.xi, x).r)
        .dot(unit_normal(facet(c.facet), c.foot.xi, x));
  }
};

/// Two different foot points inside their facets, equally far away.
bool equidistant(const Chain& chain, std::span<const Vec2> x, const Candidate& best,
                 const Candidate& tied) {
  if (tied.facet < 0 || best.foot.at_end || tied.foot.at_end) return false;
  const Facet& a = chain.facets[static_cast<std::size_t>(best.facet)];
  const Facet& b = chain.facets[static_cast<std::size_t>(tied.facet)];
  const double size = (node(a, 1, x) - node(a, 0, x)).norm();
  const double apart = (facet_jet(a, best.foot.xi, x).r - facet_jet(b, tied.foot.xi, x).r).norm();
  return best.distance > 1e-10 * size && apart > 1e-6 * best.distance &&
         std::abs(tied.distance - best.distance) <= 1e-10 * best.distance;
}

/// The foot on the facet that the point keeps, if it is still there.
Projection<2> on_kept_facet(const Chain& chain, std::span<const Vec2> x,
                            const ProjectionQuery<2>& query) {
  Projection<2> p;
  const Facet& facet = chain.facets[static_cast<std::size_t>(query.kept)];
  const CurveFoot foot = foot_on_facet(chain, facet, x, query);
  if (!foot.converged || foot.at_end || cosine_at(facet, foot, x, query) > same_way_cosine)
    return p;
  p.feature = Feature::face;
  p.facet = query.kept;
  p.xi[0] = foot.xi;
  p.distance = std::sqrt(foot.squared_distance);
  return p;
}

/// How far beyond the nearest facet another one may lie and still count as equally near.
double tie_distance(const Chain& chain, std::span<const Vec2> x) {
  const Facet& facet = chain.facets.front();
  return 1e-10 * (node(facet, 1, x) - node(facet, 0, x)).norm();
}

/// A line lies in the hull of its ends and, of second and third order, of the Bezier control points
/// between them.
void extend_by_control_points_of_line(const Facet& facet, std::span<const Vec2> x,
                                      search::Box<2>& box) {
  const Vec2 a = node(facet, 0, x), b = node(facet, 1, x);
  box.extend(a);
  box.extend(b);
  if (facet.count == 3) box.extend(Vec2(2 * node(facet, 2, x) - 0.5 * (a + b)));
  if (facet.count != 4) return;
  const Vec2 third = node(facet, 2, x), two_thirds = node(facet, 3, x);
  box.extend(Vec2((18 * third - 9 * two_thirds - 5 * a + 2 * b) / 6));
  box.extend(Vec2((18 * two_thirds - 9 * third - 5 * b + 2 * a) / 6));
}

/// A Bezier curve lies in the hull of its control points.
void extend_by_control_points(const Facet& facet, std::span<const Vec2> x, search::Box<2>& box) {
  for (std::size_t j = 0; j <= facet.bezier->degree; ++j) {
    Vec2 point = Vec2::Zero();
    for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
      point += facet.bezier->weight[k][j] * node(facet, k, x);
    box.extend(point);
  }
}

}  // namespace

void facet_boxes(const Chain& chain, std::span<const Vec2> x, std::vector<search::Box<2>>& boxes) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  boxes.resize(chain.facets.size());
  for (std::size_t f = 0; f < chain.facets.size(); ++f) {
    const Facet& facet = chain.facets[f];
    search::Box<2>& box = boxes[f];
    box = {};
    if (facet.shape) {
      box.lo = Vec2::Constant(-infinite);
      box.hi = Vec2::Constant(infinite);
      continue;
    }
    if (facet.bezier) {
      extend_by_control_points(facet, x, box);
      continue;
    }
    extend_by_control_points_of_line(facet, x, box);
  }
}

Projection<2> closest(const Chain& chain, const Tree<2>& tree, std::span<const Vec2> x,
                      const ProjectionQuery<2>& query) {
  if (query.kept >= 0) {
    const Projection<2> kept = on_kept_facet(chain, x, query);
    if (kept.feature != Feature::none) return kept;
    ProjectionQuery<2> any = query;
    any.kept = -1;
    return closest(chain, tree, x, any);
  }
  constexpr double far_away = std::numeric_limits<double>::infinity();
  const double reach = query.filter ? query.filter->distance : far_away;
  Candidate best, tied;
  const auto visit = [&](Index f) {
    const Facet& facet = chain.facets[static_cast<std::size_t>(f)];
    if (query.filter && query.filter->skips(f, query.slave_normal)) return far_away;
    if (faces_same_way(query, f)) return far_away;
    const CurveFoot foot = foot_on_facet(chain, facet, x, query);
    const double distance = std::sqrt(foot.squared_distance);
    const double cosine = cosine_at(facet, foot, x, query);
    if (!foot.converged || cosine > same_way_cosine) return far_away;
    if (query.filter && !admits(*query.filter, facet, foot.xi, x)) return far_away;
    const Candidate candidate{f, foot, distance, cosine};
    const double tie = 1e-10 * (node(facet, 1, x) - node(facet, 0, x)).norm();
    const bool wins = better(candidate, best, query.history, tie);
    const Candidate& loser = wins ? best : candidate;
    if (loser.facet >= 0 && std::abs(candidate.distance - best.distance) <= tie) tied = loser;
    if (wins) best = candidate;
    return distance;
  };
  const auto wanted = [&](Index branch) {
    if (query.filter) return !query.filter->misses(branch, query.slave_normal);
    return !branch_faces_same_way(query, branch);
  };
  // First where the point was: most others are farther away than that.
  const double tie = tie_distance(chain, x);
  double bound = reach;
  if (query.history >= 0) bound = std::min(reach, visit(query.history) + tie);
  const auto visit_other = [&](Index f) { return f == query.history ? far_away : visit(f); };
  tree.for_each_nearest_wanted(query.point, tie, wanted, visit_other, bound);
  Projection<2> p;
  if (best.facet < 0) return p;
  if (query.history >= 0) {
    const Facet& last = chain.facets[static_cast<std::size_t>(query.history)];
    best = entered_through(query, best, std::array{last.prev, last.next}, Look{chain, x, query});
  }
  p.feature = best.foot.at_end ? Feature::corner : Feature::face;
  p.facet = best.facet;
  p.xi[0] = best.foot.xi;
  p.distance = best.distance;
  if (best.foot.at_end) {
    resolve_end(chain, x, query, p);
  } else if (query.shares() && equidistant(chain, x, best, tied)) {
    share(chain, x, tied.facet, query, p);
  }
  return p;
}

}  // namespace osculate::pairing
