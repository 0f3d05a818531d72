#include "osculate/projection/reach_bound.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>

#include "osculate/projection/bernstein.hpp"
#include "osculate/projection/piece_bend.hpp"

namespace osculate::projection {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double most_sizes = 1e3;
constexpr std::size_t most_features = 2000;

template <int Dim>
double angle_between(const Vec<Dim>& a, const Vec<Dim>& b) {
  return 2 * std::atan2((a - b).norm(), (a + b).norm());
}

// -- 1/k ----------------------------------------------------------------------------------------

/// Bound of the curvature towards the side, of faces and along borders and sharp edges.
template <int Dim>
double bend_of(const ReachFeature<Dim>& f, int side) {
  const Cone<Dim>& normal = f.owners[0].normal;
  if (f.kind == FeatureKind::point || f.kind == FeatureKind::rim) return -infinite;
  if (f.kind == FeatureKind::face) {
    if (!normal.narrow()) return infinite;
    return largest_bend<Dim>(f.piece, f.control, {Vec<Dim>(side * normal.axis), normal.angle});
  }
  if constexpr (Dim == 3) {
    // v = cos phi n - sin phi n x tau: n and the way outwards in turn
    const Cone<3> up{Vec3(side * normal.axis), normal.angle};
    const Cone<3> along = along_cone<3>(f.piece, f.control, f.side);
    const Cone<3> into = inward_cone<3>(f.piece, f.control, f.side);
    Vec3 out = into.axis.dot(along.axis) * along.axis - into.axis;
    out -= out.dot(up.axis) * up.axis;
    const Cone<3> outwards{out.normalized(), 1.2 * (normal.angle + along.angle)};
    const double a = largest_side_bend(f.piece, f.control, f.side, up);
    const double b = largest_side_bend(f.piece, f.control, f.side, outwards);
    if (f.directions.narrow() && f.directions.angle > 0.8) {  // a wedge of more than 90 degrees
      const Cone<3> down{Vec3(-up.axis), up.angle};
      return std::hypot(std::max({a, largest_side_bend(f.piece, f.control, f.side, down), 0.0}),
                        std::max(b, 0.0));
    }
    return std::hypot(std::max(a, 0.0), std::max(b, 0.0));
  }
  return infinite;
}

struct BoundResult {
  double value = 0;
  Gap gap = Gap::none;
};

/// Halves of a feature with the bounds of their curvature; of a face those that bound it better.
template <int Dim>
bool halve_best(const CellComplex<Dim>& all, int side, const ReachFeature<Dim>& f,
                std::array<ReachFeature<Dim>, 2>& halves, std::array<double, 2>& bends) {
  const bool both = f.kind == FeatureKind::face && Dim == 3 && !f.piece.triangle;
  if (!halve(all, side, f, halves, both ? 0 : -1)) return false;
  bends = {bend_of(halves[0], side), bend_of(halves[1], side)};
  if (!both) return true;
  std::array<ReachFeature<Dim>, 2> others;
  if (!halve(all, side, f, others, 1)) return true;
  const std::array<double, 2> other{bend_of(others[0], side), bend_of(others[1], side)};
  const double here = std::max(bends[0], bends[1]), there = std::max(other[0], other[1]);
  const bool longer =
      std::isinf(here) && std::isinf(there) && longer_direction<Dim>(f.piece, f.control) == 1;
  if (there < here || longer) {
    halves = std::move(others);
    bends = other;
  }
  return true;
}

/// The smallest radius of curvature from below; ends at `wanted`.
template <int Dim>
BoundResult smallest_radius(const CellComplex<Dim>& all, int side,
                            const std::vector<ReachFeature<Dim>>& list, double size, double wanted,
                            int effort) {
  struct Open {
    double bend;
    ReachFeature<Dim> feature;
  };
  const auto less = [](const Open& a, const Open& b) { return a.bend < b.bend; };
  std::vector<Open> heap;
  const double enough = 1 / wanted;
  const auto push = [&](const ReachFeature<Dim>& f, double bend) {
    if (bend <= enough) return;
    heap.push_back({bend, f});
    std::push_heap(heap.begin(), heap.end(), less);
  };
  for (const ReachFeature<Dim>& f : list) push(f, bend_of(f, side));
  while (!heap.empty()) {
    const Open& top = heap.front();
    const double radius = std::isfinite(top.bend) ? 1 / top.bend : 0;
    const bool pole = std::isinf(top.bend);
    if (top.feature.radius < 1e-5 * size || --effort < 0)
      return {radius, pole ? Gap::pole : Gap::effort};
    std::pop_heap(heap.begin(), heap.end(), less);
    const Open open = std::move(heap.back());
    heap.pop_back();
    std::array<ReachFeature<Dim>, 2> halves;
    std::array<double, 2> bends{};
    if (!halve_best(all, side, open.feature, halves, bends)) return {radius, Gap::effort};
    for (std::size_t k = 0; k < 2; ++k) push(halves[k], bends[k]);
  }
  return {wanted, Gap::none};
}

// -- pairs --------------------------------------------------------------------------------------

/// Smallest and largest x . t of a hull.
template <int Dim>
Bounds along(const std::vector<Vec<Dim>>& hull, const Vec<Dim>& t) {
  Bounds b = detail::nothing;
  for (const Vec<Dim>& x : hull) detail::widen(b, x.dot(t));
  return b;
}

template <int Dim>
class PairSearch {
 public:
  PairSearch(const CellComplex<Dim>& all, int side, std::vector<ReachFeature<Dim>> list,
             double size, double wanted, int effort)
      : all_(all),
        side_(side),
        list_(std::move(list)),
        size_(size),
        wanted_(wanted),
        effort_(effort) {}

  BoundResult run() {
    const auto count = static_cast<Index>(list_.size());
    for (Index p = 0; p < count; ++p)
      for (Index q = 0; q < count; ++q) push(p, q);
    while (!heap_.empty()) {
      const Pair top = heap_.top();
      if (--effort_ < 0) return {top.least, Gap::effort};
      heap_.pop();
      const bool first = radius(top.p) >= radius(top.q);
      Index chosen = first ? top.p : top.q;
      if (!divided(chosen)) chosen = first ? top.q : top.p;
      if (!divided(chosen)) return {top.least, reason(top)};
      const std::array<Index, 2> child = at(chosen).child;
      if (top.p == top.q) {
        for (const Index a : child)
          for (const Index b : child) push(a, b);
        continue;
      }
      for (const Index c : child) chosen == top.p ? push(c, top.q) : push(top.p, c);
    }
    return {wanted_, Gap::none};
  }

 private:
  struct Pair {
    double least = 0, size = 0;
    Index p = -1, q = -1;
    /// Last in the queue: larger values, then larger parts, so that what cannot be separated shows
    /// soon.
    bool operator<(const Pair& o) const {
      return least != o.least ? least > o.least : size > o.size;
    }
  };

  [[nodiscard]] const ReachFeature<Dim>& at(Index k) const {
    return list_[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] double radius(Index k) const { return at(k).radius; }

  [[nodiscard]] Gap reason(const Pair& pair) const {
    for (const Index k : {pair.p, pair.q})
      if (at(k).kind == FeatureKind::face && !at(k).directions.narrow()) return Gap::pole;
    return Gap::touch;
  }

  /// Makes sure that a feature has halves; false where it is a point or too small.
  bool divided(Index k) {
    if (at(k).child[0] >= 0) return true;
    if (radius(k) < 1e-5 * size_) return false;
    std::array<ReachFeature<Dim>, 2> halves;
    if (!halve(all_, side_, at(k), halves)) return false;
    for (std::size_t h = 0; h < 2; ++h) {
      list_[static_cast<std::size_t>(k)].child[h] = static_cast<Index>(list_.size());
      list_.push_back(std::move(halves[h]));
    }
    return true;
  }

  void push(Index p, Index q) {
    const ReachFeature<Dim>&a = at(p), &b = at(q);
    if (b.kind == FeatureKind::rim) return;  // it is there as an edge already
    const double apart = (a.center - b.center).norm() - a.radius - b.radius;
    if (0.5 * apart >= wanted_) return;
    const std::optional<double> least = least_of(a, b);
    if (least && *least < wanted_) heap_.push({*least, a.radius + b.radius, p, q});
  }

  /// Lower bound of the quotient of a pair; nothing where it cannot be smallest there.
  [[nodiscard]] std::optional<double> least_of(const ReachFeature<Dim>& a,
                                               const ReachFeature<Dim>& b) const {
    if (a.kind == FeatureKind::point && b.kind == FeatureKind::point && a.center == b.center)
      return std::nullopt;
    const double gap = std::sqrt(a.box.squared_distance(b.box));
    const double tiny = 1e-12 * size_;
    const double nearest = std::max(gap, (a.center - b.center).norm() - a.radius - b.radius);
    const double farthest = (a.center - b.center).norm() + a.radius + b.radius;
    const auto excluded = [&](const Barrier<Dim>& barrier, const ReachFeature<Dim>& from,
                              const ReachFeature<Dim>& to) {
      const double off = along<Dim>(to.hull, barrier.t).lo - along<Dim>(from.hull, barrier.t).hi;
      return off > barrier.s * (barrier.s > 0 ? farthest : nearest) + tiny;
    };
    for (const Barrier<Dim>& barrier : a.sees)
      if (excluded(barrier, a, b)) return std::nullopt;
    if (a.kind != FeatureKind::rim)
      for (const Barrier<Dim>& barrier : b.seen)
        if (excluded(barrier, b, a)) return std::nullopt;
    const bool apart = gap > tiny;
    if (!apart && one_graph(all_, a, b)) return std::nullopt;
    const bool told_apart = apart || meet(all_, a, b);
    if (told_apart && cannot_face(a, b)) return std::nullopt;
    double least = 0.5 * std::max(nearest, 0.0);
    if (a.kind == FeatureKind::rim) return rim_bound(a, b, least, nearest, farthest, told_apart);
    if (!a.directions.narrow()) return least;
    const Bounds to = along<Dim>(b.hull, a.directions.axis),
                 from = along<Dim>(a.hull, a.directions.axis);
    if (told_apart && to.hi - from.lo <= tiny) return std::nullopt;
    return std::max(least, 0.5 * (to.lo - from.hi));
  }

  /// The cones of directions do not hold opposite ones (of faces that are seen: of either side).
  [[nodiscard]] static bool cannot_face(const ReachFeature<Dim>& a, const ReachFeature<Dim>& b) {
    if (a.kind == FeatureKind::rim || !a.directions.narrow() || !b.directions.narrow())
      return false;
    const double angle = angle_between<Dim>(a.directions.axis, b.directions.axis);
    const double both = a.directions.angle + b.directions.angle + 1e-9;
    constexpr double half_turn = 3.141592653589793;
    if (half_turn - angle <= both) return false;
    return b.kind != FeatureKind::face || angle > both;
  }

  /// |d|^2/(2 d . v) itself, over the outermost directions.
  [[nodiscard]] std::optional<double> rim_bound(const ReachFeature<Dim>& a,
                                                const ReachFeature<Dim>& b, double least,
                                                double nearest, double farthest,
                                                bool told_apart) const {
    double reach = -infinite;
    for (const Vec<Dim>& v : a.outermost)
      reach = std::max(reach, along<Dim>(b.hull, v).hi - along<Dim>(a.hull, v).lo);
    reach += 2 * std::sin(0.5 * std::min(a.spread, 3.1)) * farthest;
    if (a.outermost.size() == 2) {
      const double cosine = std::cos(0.5 * angle_between<Dim>(a.outermost[0], a.outermost[1]));
      if (cosine < 0.1) return least;
      reach = reach > 0 ? reach / cosine : reach;
    }
    if (reach <= 1e-12 * size_) {
      if (told_apart) return std::nullopt;
      return least;
    }
    return nearest > 0 ? std::max(least, nearest * nearest / (2 * reach)) : least;
  }

  const CellComplex<Dim>& all_;
  int side_;
  std::vector<ReachFeature<Dim>> list_;
  double size_, wanted_;
  int effort_;
  std::priority_queue<Pair> heap_;
};

// -- the whole ----------------------------------------------------------------------------------

template <int Dim>
SideBound bound_side(const CellComplex<Dim>& all, int side, double size, double found,
                     const ReachBoundOptions& options) {
  if (all.set.pieces.size() > most_features) return {0, Gap::size};
  ReachFeatures<Dim> features = features_of(all, side, options.kink);
  if (features.gap != Gap::none) return {0, features.gap};
  if (features.list.size() > most_features) return {0, Gap::size};
  const double end = most_sizes * size;  // farther is without end, as in `reach`
  const double wanted = std::min(found * (1 - options.tolerance), end);
  const BoundResult bend =
      smallest_radius<Dim>(all, side, features.list, size, wanted, options.effort);
  if (!(bend.value > 0)) return {0, bend.gap};
  PairSearch<Dim> pairs(all, side, std::move(features.list), size, std::min(wanted, bend.value),
                        16 * options.effort);
  const BoundResult pair = pairs.run();
  const double least = std::min(pair.value, bend.value);
  if (least >= end) return {infinite, Gap::none};
  return {least, pair.gap == Gap::none ? bend.gap : pair.gap};
}

/// A ball of the shape's own radius inside, and what the outside of a torus has.
std::optional<ReachBound> known(const geometry::Surface& surface) {
  const auto sides = [](double within, double outside, bool inside) {
    const SideBound a{within, Gap::none}, b{outside, Gap::none};
    return inside ? ReachBound{b, a} : ReachBound{a, b};
  };
  if (std::holds_alternative<geometry::Plane>(surface)) return sides(infinite, infinite, false);
  if (const auto* s = std::get_if<geometry::Sphere>(&surface))
    return sides(s->radius, infinite, s->inside);
  if (const auto* c = std::get_if<geometry::Cylinder>(&surface))
    return sides(c->radius, infinite, c->inside);
  if (const auto* t = std::get_if<geometry::Torus>(&surface))
    return sides(t->tube_radius, t->radius - t->tube_radius, t->inside);
  return std::nullopt;
}

std::optional<ReachBound> known(const geometry::Curve& curve) {
  if (std::holds_alternative<geometry::InfiniteLine>(curve))
    return ReachBound{{infinite, Gap::none}, {infinite, Gap::none}};
  if (const auto* c = std::get_if<geometry::Circle>(&curve)) {
    const SideBound within{c->radius, Gap::none}, outside{infinite, Gap::none};
    return c->inside ? ReachBound{outside, within} : ReachBound{within, outside};
  }
  return std::nullopt;
}

}  // namespace

template <int Dim>
ReachBound reach_bound(const Target<Dim>& target, const Reach<Dim>& found,
                       const ReachBoundOptions& options) {
  std::optional<CellComplex<Dim>> all;
  if (const auto* shape = std::get_if<Shape<Dim>>(&target)) {
    if (const std::optional<ReachBound> exact = known(*shape)) return *exact;
    all = complex_of(*shape);
    if constexpr (Dim == 2)
      if (const auto* arc = std::get_if<geometry::Arc>(shape); arc && !arc->closed())
        all = make_complex(as_nurbs(*arc));
    if (!all) return {{0, Gap::shape}, {0, Gap::shape}};
  } else {
    all = make_complex(std::get<FacetMesh<Dim>>(target));
  }
  search::Box<Dim> box;
  for (const Piece<Dim>& piece : all->set.pieces)
    box.extend(box_of<Dim>(piece, control_of(piece, all->set.control)));
  const double size = (box.hi - box.lo).norm();
  const auto side_bound = [&](int side, double value) -> SideBound {
    if (!(value > 0)) return {};
    return bound_side<Dim>(*all, side, size, value, options);
  };
  return {side_bound(-1, found.below.reach.value), side_bound(1, found.above.reach.value)};
}

template ReachBound reach_bound(const Target<2>&, const Reach<2>&, const ReachBoundOptions&);
template ReachBound reach_bound(const Target<3>&, const Reach<3>&, const ReachBoundOptions&);

}  // namespace osculate::projection
