#include "osculate/pairing/reachable.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "osculate/core/error.hpp"
#include "osculate/pairing/moving_facet.hpp"
#include "osculate/pairing/sampling.hpp"
#include "osculate/projection/point_to_curve.hpp"
#include "osculate/projection/point_to_facet.hpp"

namespace osculate::pairing {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

std::size_t spot(Index i) { return static_cast<std::size_t>(i); }

void sort_out(std::vector<Index>& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// ---- the plane and space ------------------------------------------------------------------------

/// A distance from the facet that its own is not larger than.
double distance_at_most(const Facet& facet, std::span<const Vec2> x, const Vec2& point) {
  if (facet.shape) return unbounded;
  if (!facet.bezier)
    return std::sqrt(projection::closest_point(facet_curve(facet, x), point).squared_distance);
  return std::min((x[spot(facet.nodes[0])] - point).norm(),
                  (x[spot(facet.nodes[1])] - point).norm());
}
double distance_at_most(const SurfaceFacet& facet, std::span<const Vec3> x, const Vec3& point) {
  if (facet.shape) return unbounded;
  std::array<Vec3, cell::max_facet_nodes> nodes;
  const auto count = spot(is_plain(facet) ? facet.count : edge_count(facet));
  double nearest = unbounded;
  for (std::size_t k = 0; k < count; ++k) {
    nodes[k] = x[spot(facet.nodes[k])];
    nearest = std::min(nearest, (nodes[k] - point).norm());
  }
  if (!is_plain(facet)) return nearest;
  return std::sqrt(
      projection::closest_point(facet.type, {nodes.data(), count}, point).squared_distance);
}

/// Steps along the chain from one facet to another; -1: it does not lead there.
int steps_along(const Chain& chain, Index from, Index to) {
  Index f = from;
  for (int n = 0; n <= static_cast<int>(chain.facets.size()) && f >= 0; ++n) {
    if (f == to) return n;
    f = chain.facets[spot(f)].next;
  }
  return -1;
}

/// Adds all facets that a path between two of the list may lead over: of the two ways round a
/// closed chain the one over fewer borders.
void add_ways(const Chain& chain, std::vector<Index>& facets) {
  const std::vector<Index> ends = facets;
  const auto add = [&](Index from, int steps) {
    for (Index f = from; steps >= 0; --steps, f = chain.facets[spot(f)].next) facets.push_back(f);
  };
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    for (std::size_t j = i + 1; j < ends.size(); ++j) {
      const int ahead = steps_along(chain, ends[i], ends[j]),
                behind = steps_along(chain, ends[j], ends[i]);
      if (ahead >= 0 && (behind < 0 || ahead <= behind)) add(ends[i], ahead);
      if (behind >= 0 && (ahead < 0 || behind <= ahead)) add(ends[j], behind);
      if (i > 0 && facets.size() > 4 * ends.size()) sort_out(facets);
    }
  sort_out(facets);
}
void add_ways(const FacetSurface&, std::vector<Index>&) {}  // from the one facet to the other

// ---- one pair -----------------------------------------------------------------------------------

template <int Dim>
class ReachSearch {
 public:
  ReachSearch(const PairDefinition<Dim>& pair, Points<Dim> x, const PairState<Dim>& committed,
              const Reach& reach)
      : pair_(pair), x_(x), committed_(committed), reach_(reach) {
    MovingFacets<Dim> moving;
    master_ = moving.of(pair.master, x, reach.motion);
    slave_ = moving.of(pair.slave.boundary, x, reach.motion);
    std::vector<search::Box<Dim>> now, moved;
    for (const MovingFacet<Dim>& f : master_) {
      now.push_back(f.box);
      moved.push_back(f.box);
      moved.back().inflate(f.lever * reach.motion);
    }
    now_ = Tree<Dim>(now);
    moved_ = Tree<Dim>(moved);
    set_beside();
  }

  [[nodiscard]] ReachablePoint of(std::size_t i) const {
    ReachablePoint out;
    const SlavePoint<Dim>& p = pair_.slave.points[i];
    out.point = static_cast<Index>(i);
    out.own.assign(p.nodes.begin(), p.nodes.begin() + p.count);
    const At at = at_point(i);
    Candidates found = candidates(at);
    for (const Index f : found.all)
      if (may_push(at, f, std::ranges::binary_search(found.near, f))) out.facets.push_back(f);
    if (out.facets.empty()) return out;
    if (pair_.friction) {
      const Index last = committed_.points[at.i].facet;
      if (last >= 0) found.all.push_back(last);  // also where it is no candidate any more
      sort_out(found.all);
      add_ways(pair_.master, found.all);
      for (const Index f : found.all) add_nodes(pair_.master.facets[spot(f)], out.further);
    }
    if (pair_.weight == Weight::current_area)
      for (const Index f : own_facets(i))
        add_nodes(pair_.slave.boundary.facets[spot(f)], out.further);
    sort_out(out.further);
    return out;
  }

  /// Facets that share nodes with this one.
  [[nodiscard]] const std::vector<Index>& beside(Index facet) const { return beside_[spot(facet)]; }

 private:
  /// A slave point: where it is, how much of a node's motion it makes, and where it may face.
  struct At {
    std::size_t i = 0;
    Vec<Dim> point;
    double lever = 1;
    bool faces = false;  ///< it has a normal
    projection::Cone<Dim> cone;
  };

  template <class AnyFacet>
  static void add_nodes(const AnyFacet& facet, std::vector<Index>& nodes) {
    nodes.insert(nodes.end(), facet.nodes.begin(), facet.nodes.begin() + facet.count);
  }

  void set_beside() {
    std::map<Index, std::vector<Index>> at_node;
    const auto& facets = pair_.master.facets;
    for (std::size_t f = 0; f < facets.size(); ++f)
      for (int k = 0; k < facets[f].count; ++k)
        at_node[facets[f].nodes[spot(k)]].push_back(static_cast<Index>(f));
    beside_.resize(facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
      for (int k = 0; k < facets[f].count; ++k) {
        const std::vector<Index>& others = at_node[facets[f].nodes[spot(k)]];
        beside_[f].insert(beside_[f].end(), others.begin(), others.end());
      }
      sort_out(beside_[f]);
    }
  }

  /// Facets of the slave that normal and area of a point are of.
  [[nodiscard]] std::vector<Index> own_facets(std::size_t i) const {
    if (sampled_at_nodes(pair_.slave)) return pair_.slave.facets_of[i];
    return {pair_.slave.points[i].facet};
  }

  [[nodiscard]] At at_point(std::size_t i) const {
    const SlavePoint<Dim>& p = pair_.slave.points[i];
    At at{i, position<Dim>(p, x_), 0, false, {}};
    for (int k = 0; k < p.count; ++k) at.lever += std::abs(p.shape[spot(k)]);
    for (const Index f : own_facets(i)) {
      const projection::Cone<Dim>& cone = slave_[spot(f)].cone;
      at.cone = at.faces ? projection::join<Dim>(at.cone, cone) : cone;
      at.faces = true;
    }
    return at;
  }

  /// The angles there may be between the normals of point and facet.
  [[nodiscard]] std::array<double, 2> angles(const projection::Cone<Dim>& a,
                                             const projection::Cone<Dim>& b) const {
    constexpr double pi = std::numbers::pi;
    if (!a.narrow() || !b.narrow()) return {0, pi};
    const double between = std::acos(std::clamp(a.axis.dot(b.axis), -1.0, 1.0));
    return {std::max(between - a.angle - b.angle, 0.0), std::min(between + a.angle + b.angle, pi)};
  }

  /// Whether the facet cannot come to face the same way as the point.
  [[nodiscard]] bool stays_candidate(const At& at, Index f) const {
    return !at.faces || angles(at.cone, master_[spot(f)].cone)[0] > std::acos(same_way_cosine);
  }
  [[nodiscard]] bool is_no_candidate(const At& at, Index f) const {
    const projection::Cone<Dim>& cone = master_[spot(f)].cone;
    if (at.faces && angles(at.cone, cone)[1] < std::acos(same_way_cosine)) return true;
    if (!pair_.filter.own) return false;
    const std::vector<Index> own = own_facets(at.i);
    if (std::ranges::find(own, f) != own.end()) return true;
    return !own.empty() && std::ranges::all_of(own, [&](Index o) {
      return angles(slave_[spot(o)].cone, cone)[1] < std::acos(facing_cosine);
    });
  }

  /// Within this distance of the point is the place that it will have.
  [[nodiscard]] double farthest_place(const At& at) const {
    const double slave = at.lever * reach_.motion;
    double most = unbounded;
    if (pair_.filter.limited()) {
      most = pair_.filter.distance;
      const contact::PointHistory<Dim>& h = committed_.points[at.i];
      if (h.facet >= 0 && !pair_.master.facets[spot(h.facet)].shape)
        most = std::max(most, way_from(at, h));
    } else {
      now_.for_each_nearest(at.point, 0, [&](Index f) {
        if (!stays_candidate(at, f)) return unbounded;
        const double d = distance_at_most(pair_.master.facets[spot(f)], x_, at.point);
        most = std::min(most, d + slave + master_[spot(f)].lever * reach_.motion);
        return d + master_[spot(f)].lever * reach_.motion;
      });
    }
    return std::min(most, farthest_contact()) * (1 + 1e-9);
  }

  /// And within this distance, if it is in contact there.
  [[nodiscard]] double farthest_contact() const {
    // Friction remembers places of open points, too.
    if (only_penalty() && !pair_.friction && pair_.overlap == InitialOverlap::acts)
      return std::min(reach_.distance, std::max(pair_.depth, onset()));
    return reach_.distance;
  }

  /// What a point may have gone since the last increment.
  [[nodiscard]] double way_from(const At& at, const contact::PointHistory<Dim>& h) const {
    const MovingFacet<Dim>& facet = master_[spot(h.facet)];
    double farthest = 0;
    for (int k = 0; k < Dim; ++k) {
      const double side = std::max(std::abs(at.point[k] - facet.box.lo[k]),
                                   std::abs(at.point[k] - facet.box.hi[k]));
      farthest += side * side;
    }
    return std::sqrt(farthest) + (at.lever + facet.lever) * reach_.motion;
  }

  /// Facets that the place of a point may be on: because they are near, or because they are beside
  /// such a facet, or beside that of its history, or beside one that it may have come to so.
  struct Candidates {
    std::vector<Index> near, all;
  };
  [[nodiscard]] Candidates candidates(const At& at) const {
    Candidates out;
    const double place = farthest_place(at), radius = place + at.lever * reach_.motion;
    moved_.for_each_within(at.point, radius, [&](Index f) { out.near.push_back(f); });
    sort_out(out.near);
    out.all = out.near;
    if (const Index last = committed_.points[at.i].facet; last >= 0) out.all.push_back(last);
    if (at.faces) {
      const std::vector<Index> found = out.all;
      for (const Index f : found) out.all.insert(out.all.end(), beside(f).begin(), beside(f).end());
    }
    sort_out(out.all);
    if (!pair_.filter.limited() && place < farthest_contact() && may_be_across(at, out.near))
      follow(at, out.all);
    std::erase_if(out.all, [&](Index f) { return is_no_candidate(at, f); });
    return out;
  }

  /// Whether the point may come behind a facet across, instead of which it keeps the side that it
  /// came through (`entered_through`).
  [[nodiscard]] bool may_be_across(const At& at, const std::vector<Index>& near) const {
    return at.faces && std::ranges::any_of(near, [&](Index f) {
             const double least = angles(at.cone, master_[spot(f)].cone)[0];
             return least < std::acos(facing_cosine) && !in_front(at, f, f);
           });
  }

  /// Whether the point may have a foot inside the facet, behind it, and face it there.
  ///
  /// Formula    the way to a foot is along the normal there: places of the facet, less that of the
  ///            point, are within r of w, normals within alpha of a; angle(w, a) <= alpha +
  ///            asin(r / |w|)
  [[nodiscard]] bool may_hold(const At& at, Index f) const {
    const MovingFacet<Dim>& facet = master_[spot(f)];
    if (angles(at.cone, facet.cone)[1] < std::acos(facing_cosine) || in_front(at, f, f))
      return false;
    if (!facet.cone.narrow()) return true;
    const Vec<Dim> way = 0.5 * (facet.box.lo + facet.box.hi) - at.point;
    const double length = way.norm(), radius = 0.5 * (facet.box.hi - facet.box.lo).norm() +
                                               (facet.lever + at.lever) * reach_.motion;
    if (length <= radius) return true;
    const double between = std::acos(std::clamp(way.dot(facet.cone.axis) / length, -1.0, 1.0));
    return between <= facet.cone.angle + std::asin(radius / length) + 1e-9;
  }

  /// Adds facets that a point may come to by one increment after the other, each on a facet beside
  /// the last one.
  void follow(const At& at, std::vector<Index>& facets) const {
    std::vector<bool> seen(master_.size());
    for (const Index f : facets) seen[spot(f)] = true;
    std::vector<Index> next;
    for (const Index f : facets)
      if (may_hold(at, f)) next.push_back(f);
    while (!next.empty()) {
      const Index from = next.back();
      next.pop_back();
      for (const Index f : beside(from)) {
        if (seen[spot(f)] || !may_hold(at, f)) continue;
        seen[spot(f)] = true;
        facets.push_back(f);
        next.push_back(f);
      }
    }
    sort_out(facets);
  }

  [[nodiscard]] bool only_penalty() const {
    return is<ByPenalty>(pair_.enforcement) && is<MayPart>(pair_.separation);
  }
  [[nodiscard]] double onset() const {
    return std::max(0.0, pair_.offset + contact::onset_gap(pair_.normal));
  }

  /// Whether the point stays, by more than the gap at which the law begins, in front of all places
  /// of one facet, as the normals of another one beside it say.
  ///
  /// Formula    (p - c) . m >= (p - c_j) . m_k less what motions may take from it, over all control
  ///            points c_j and normals m_k; the gap is at least the least of them by the longest m
  [[nodiscard]] bool in_front(const At& at, Index of, Index as) const {
    const MovingFacet<Dim>&facet = master_[spot(of)], &side = master_[spot(as)];
    if (facet.points.empty() || side.points.empty()) return false;
    const double d = reach_.motion;
    double least = unbounded, longest = 0;
    for (const MovingVector<Dim>& m : side.normals) {
      const double length = m.value.norm() + m.lever * d;
      longest = std::max(longest, length);
      for (const MovingVector<Dim>& c : facet.points) {
        const Vec<Dim> arm = at.point - c.value;
        const double taken = arm.norm() * m.lever * d + (c.lever + at.lever) * d * length;
        least = std::min(least, arm.dot(m.value) - taken - 1e-12 * arm.norm() * length);
      }
    }
    return least > 0 && least > onset() * longest;
  }

  /// At borders the gap is that by the mean of the normals of the facets there; a facet that is not
  /// near serves for places inside it alone.
  [[nodiscard]] bool may_push(const At& at, Index f, bool near) const {
    if (!only_penalty() || !in_front(at, f, f)) return true;
    return near && !std::ranges::all_of(beside(f), [&](Index g) { return in_front(at, f, g); });
  }

  const PairDefinition<Dim>& pair_;
  Points<Dim> x_;
  const PairState<Dim>& committed_;
  Reach reach_;
  std::vector<MovingFacet<Dim>> master_, slave_;
  Tree<Dim> now_, moved_;
  std::vector<std::vector<Index>> beside_;
};

template <int Dim>
std::vector<ReachablePoint> reachable_ties(const Tied<Dim>& tied) {
  std::vector<ReachablePoint> out;
  for (const TiedPoint<Dim>& tie : tied.ties) {
    ReachablePoint& p = out.emplace_back();
    p.point = tie.point;
    if (tie.facet >= 0) p.facets.push_back(tie.facet);
    p.own = tie.nodes;
  }
  return out;
}

}  // namespace

template <int Dim>
std::vector<ReachablePoint> reachable(const PairDefinition<Dim>& pair, Points<Dim> x,
                                      const PairState<Dim>& committed, const Reach& reach) {
  if (const auto* const tied = std::get_if<Tied<Dim>>(&pair.separation))
    return reachable_ties(*tied);
  if (by_mortar(pair))
    throw core::GeometryError("what mortar's integrals may reach is not known beforehand");
  if (edges_of(pair))
    throw core::GeometryError("which edges may cross is not known beforehand: leave out edges");
  const ReachSearch<Dim> search(pair, x, committed, reach);
  std::vector<ReachablePoint> out;
  for (std::size_t i = 0; i < pair.slave.points.size(); ++i) {
    ReachablePoint p = search.of(i);
    if (p.facets.empty()) continue;
    for (const Index f : p.facets) {
      if (!has_reentrant_vertices(pair)) break;
      for (const Index other : search.beside(f)) {
        const auto& facet = pair.master.facets[spot(other)];
        p.own.insert(p.own.end(), facet.nodes.begin(), facet.nodes.begin() + facet.count);
      }
    }
    sort_out(p.own);
    out.push_back(std::move(p));
  }
  return out;
}

template std::vector<ReachablePoint> reachable<2>(const PairDefinition<2>&, Points<2>,
                                                  const PairState<2>&, const Reach&);
template std::vector<ReachablePoint> reachable<3>(const PairDefinition<3>&, Points<3>,
                                                  const PairState<3>&, const Reach&);

}  // namespace osculate::pairing
