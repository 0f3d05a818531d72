#pragma once
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "osculate/projection/bernstein.hpp"
#include "osculate/projection/piece.hpp"
#include "osculate/projection/surface_distance.hpp"

namespace osculate::projection {

/// A local minimum of the distance over one piece.
template <int Dim>
struct PieceMinimum {
  Vec2 st{0, 0};
  double squared_distance = std::numeric_limits<double>::infinity();
  Vec<Dim> point = Vec<Dim>::Zero();
  std::uint8_t pressed = 0;  ///< bit k: the minimum lies on side k and is pulled beyond it
  bool flat = false;         ///< one of many equally near ones: the distance is a bound from below
  bool open = false;         ///< flat because the search was given up
};

/// How far a foot point may miss a side, as a part of the piece, and still lie inside.
inline constexpr double side_tolerance = 1e-10;

namespace detail {

/// Half the squared distance and its derivatives at one place.
template <int Dim>
struct Place {
  Vec2 st{0, 0};
  double squared = std::numeric_limits<double>::infinity();
  Vec2 slope{0, 0}, noise{0, 0};
  Mat<2, 2> bend = Mat<2, 2>::Zero();
  Vec2 metric{0, 0};  ///< a_11, a_22
  double a12 = 0;
  Vec<Dim> r = Vec<Dim>::Zero();
};

template <int Dim>
[[nodiscard]] Place<Dim> look(const Piece<Dim>& piece, Control<Dim> control, const Vec<Dim>& point,
                              const Vec2& st) {
  const PieceJet<Dim> j = jet(piece, control, st);
  const Vec<Dim> gap = point - j.r;
  Place<Dim> out;
  out.st = st;
  out.r = j.r;
  out.squared = gap.squaredNorm();
  const DistanceJet2 d = distance_jet2<Dim>(gap, j.r1, j.r2);
  out.slope = d.slope;
  out.bend = d.bend;
  out.metric = d.metric.diagonal();
  out.a12 = d.metric(0, 1);
  const double size =
      4 * std::numeric_limits<double>::epsilon() *
      (gap.template lpNorm<1>() + j.r.template lpNorm<1>() + point.template lpNorm<1>());
  for (std::size_t i = 0; i < 2; ++i)
    out.noise[static_cast<Eigen::Index>(i)] = size * j.r1[i].template lpNorm<1>();
  return out;
}

/// A part of the piece: lo <= st <= hi.
struct Range {
  Vec2 lo{0, 0}, hi{1, 1};
};

template <int Dim>
[[nodiscard]] Range whole_range(const Piece<Dim>& piece) {
  return {{0, 0}, {1, piece.degree[1] == 0 ? 0.0 : 1.0}};
}

template <int Dim>
[[nodiscard]] bool pulled(const Place<Dim>& p, const Range& range, Eigen::Index i, bool high) {
  if (high ? p.st[i] < range.hi[i] : p.st[i] > range.lo[i]) return false;
  const double outward = high ? -p.slope[i] : p.slope[i];
  const double scale = std::max(p.bend(i, i), 1e-3 * p.metric[i]);
  return outward > std::max(p.noise[i], side_tolerance * scale);
}

/// Bit k: pulled beyond side k of the whole piece.
template <int Dim>
[[nodiscard]] std::uint8_t pressed_sides(const Piece<Dim>& piece, const Place<Dim>& p) {
  unsigned bits = 0;
  for (unsigned side = 0; side < 4; ++side) {
    const auto i = static_cast<Eigen::Index>(side / 2);
    if (i == 1 && piece.degree[1] == 0) continue;
    if (pulled(p, whole_range(piece), i, side % 2 == 1)) bits |= 1U << side;
  }
  return static_cast<std::uint8_t>(bits);
}

/// Newton's step in the free directions; Gauss-Newton's where that does not lead down.
template <int Dim>
[[nodiscard]] Vec2 step_of(const Place<Dim>& p, const std::array<bool, 2>& fixed, bool newton) {
  const auto& b = p.bend;
  Mat<2, 2> m = b;
  if (!newton) m << p.metric[0], p.a12, p.a12, p.metric[1];
  if (!fixed[0] && !fixed[1]) {
    const double det = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
    if (m(0, 0) > 0 && det > 1e-14 * m(0, 0) * m(1, 1))
      return Vec2(m(1, 1) * p.slope[0] - m(0, 1) * p.slope[1],
                  m(0, 0) * p.slope[1] - m(1, 0) * p.slope[0]) /
             -det;
    if (newton) return step_of(p, fixed, false);
  }
  Vec2 step(0, 0);
  for (Eigen::Index i = 0; i < 2; ++i) {
    if (fixed[static_cast<std::size_t>(i)]) continue;
    const double stiff = newton && b(i, i) > 0 ? b(i, i) : p.metric[i];
    if (stiff > 0) step[i] = -p.slope[i] / stiff;
  }
  return step;
}

/// The local minimum below `start` inside the range: projected Newton steps, halved while the
/// distance grows; the last ones by the slope, since the distance is flat there.
template <int Dim>
[[nodiscard]] Place<Dim> roll_down(const Piece<Dim>& piece, Control<Dim> control,
                                   const Vec<Dim>& point, const Range& range, Place<Dim> p) {
  constexpr int most = 60;
  const auto clamp = [&](const Vec2& st) -> Vec2 {
    return st.cwiseMax(range.lo).cwiseMin(range.hi);
  };
  for (int it = 0; it < most; ++it) {
    std::array<bool, 2> fixed{};
    double slope = 0;
    bool level = true;
    for (Eigen::Index i = 0; i < 2; ++i) {
      const bool at_lo = p.st[i] <= range.lo[i] && p.slope[i] >= 0;
      const bool at_hi = p.st[i] >= range.hi[i] && p.slope[i] <= 0;
      const auto k = static_cast<std::size_t>(i);
      fixed[k] = at_lo || at_hi;
      if (fixed[k]) continue;
      level = level && std::abs(p.slope[i]) <= 0.25 * p.noise[i];
      slope = std::max(slope, std::abs(p.slope[i]) / std::sqrt(std::max(p.metric[i], 1e-300)));
    }
    if (level) return p;
    Vec2 step = step_of(p, fixed, true);
    if (!step.allFinite()) return p;
    bool moved = false;
    for (int half = 0; half < 40 && !moved; ++half, step *= 0.5) {
      const Vec2 st = clamp(p.st + step);
      if (st == p.st) break;
      const Place<Dim> next = look(piece, control, point, st);
      double next_slope = 0;
      for (Eigen::Index i = 0; i < 2; ++i)
        if (!fixed[static_cast<std::size_t>(i)])
          next_slope = std::max(
              next_slope, std::abs(next.slope[i]) / std::sqrt(std::max(next.metric[i], 1e-300)));
      const bool nearer = next.squared < p.squared;
      const bool flatter =
          half == 0 && next_slope < 0.5 * slope && next.squared <= p.squared * (1 + 1e-14) + 1e-300;
      if (!nearer && !flatter) {
        // A step cut off at a side need not lead down: go on along the slope alone.
        if (half == 8) step = 512 * step_of(p, fixed, false);
        continue;
      }
      moved = true;
      p = next;
    }
    if (!moved) return p;
  }
  return p;
}

/// The same; what misses a side of the piece by rounding lies on it.
template <int Dim>
[[nodiscard]] Place<Dim> descend(const Piece<Dim>& piece, Control<Dim> control,
                                 const Vec<Dim>& point, const Range& range,
                                 const Place<Dim>& start) {
  constexpr double rounding = 1e-15;
  const Place<Dim> p = roll_down(piece, control, point, range, start);
  Vec2 st = p.st;
  for (Eigen::Index i = 0; i < 2; ++i) {
    if (st[i] < rounding) st[i] = 0;
    if (st[i] > 1 - rounding) st[i] = 1;
  }
  return st == p.st ? p : look(piece, control, point, st);
}

/// Branch and bound over one piece. `Sink` has two members: `double reach2() const` (minima at or
/// beyond this squared distance are not wanted; may shrink) and `void offer(const
/// PieceMinimum<Dim>&)`.
template <int Dim, int Capacity, class Sink>
class PieceSearch {
 public:
  PieceSearch(const Piece<Dim>& piece, Control<Dim> control, const Vec<Dim>& point,
              double tolerance, Sink& sink)
      : piece_(piece), control_(control), point_(point), tolerance_(tolerance), sink_(sink) {}

  void run() {
    Net<Capacity> n, d;
    form(n, d);
    visit(n, d, whole_range(piece_), {false, piece_.degree[1] == 0}, 0);
  }

 private:
  const Piece<Dim>& piece_;
  Control<Dim> control_;
  const Vec<Dim>& point_;
  double tolerance_;  ///< of a distance
  Sink& sink_;
  double slack_ = 0;  ///< rounding error of a coefficient
  int budget_ = 20000;

  /// |w r - w p|^2 and w^2 as Bernstein polynomials.
  void form(Net<Capacity>& n, Net<Capacity>& d) {
    const int p = piece_.degree[0], q = piece_.degree[1];
    n.m = d.m = 2 * p;
    n.n = d.n = 2 * q;
    constexpr auto most = static_cast<std::size_t>((max_piece_degree + 1) * (max_piece_degree + 1));
    std::array<ControlPoint<Dim>, most> scaled;
    double largest = 0;
    std::size_t k = 0;
    for (int i = 0; i <= p; ++i)
      for (int j = 0; j <= q; ++j, ++k) {
        const ControlPoint<Dim>& c = control_[k];
        const double w = c[Dim];
        scaled[k].template head<Dim>() = c.template head<Dim>() - w * point_;
        scaled[k][Dim] = w;
        largest = std::max(largest, scaled[k].template head<Dim>().squaredNorm());
        scaled[k] *= binomial(p, i) * binomial(q, j);
      }
    slack_ = 4e-15 * largest;
    for (std::size_t a = 0; a < k; ++a) {
      const int i = static_cast<int>(a) / (q + 1), j = static_cast<int>(a) % (q + 1);
      for (std::size_t b = a; b < k; ++b) {
        const int ib = static_cast<int>(b) / (q + 1), jb = static_cast<int>(b) % (q + 1);
        const double twice = a == b ? 1 : 2;
        n.at(i + ib, j + jb) +=
            twice * scaled[a].template head<Dim>().dot(scaled[b].template head<Dim>());
        if (piece_.rational) d.at(i + ib, j + jb) += twice * scaled[a][Dim] * scaled[b][Dim];
      }
    }
    for (int i = 0; i <= n.m; ++i)
      for (int j = 0; j <= n.n; ++j) {
        const double scale = 1 / (binomial(n.m, i) * binomial(n.n, j));
        n.at(i, j) *= scale;
        d.at(i, j) *= scale;
      }
  }

  [[nodiscard]] Bounds value_bounds(const Net<Capacity>& n, const Net<Capacity>& d) const {
    Bounds b = nothing;
    const auto count = static_cast<std::size_t>((n.m + 1) * (n.n + 1));
    for (std::size_t k = 0; k < count; ++k) widen(b, piece_.rational ? n.c[k] / d.c[k] : n.c[k]);
    return b;
  }

  /// Of f where f < reach: of N, or of N - lambda D for every lambda that f may be there. With
  /// these bounds a critical point, or a second minimum, of f is one of N - lambda D.
  [[nodiscard]] NetBounds slopes(const Net<Capacity>& n, const Net<Capacity>& d,
                                 const Bounds& f) const {
    if (!piece_.rational) return derivative_bounds(n);
    const auto with = [&](double lambda) {
      Net<Capacity> g = n;
      const auto count = static_cast<std::size_t>((n.m + 1) * (n.n + 1));
      for (std::size_t k = 0; k < count; ++k) g.c[k] -= lambda * d.c[k];
      return derivative_bounds(g);
    };
    NetBounds b = with(f.lo);
    const NetBounds other = with(std::min(f.hi, std::max(f.lo, sink_.reach2())));
    for (std::size_t k = 0; k < b.first.size(); ++k) {
      widen(b.first[k], other.first[k].lo);
      widen(b.first[k], other.first[k].hi);
    }
    for (std::size_t k = 0; k < b.second.size(); ++k) {
      widen(b.second[k], other.second[k].lo);
      widen(b.second[k], other.second[k].hi);
    }
    return b;
  }

  [[nodiscard]] bool convex(const NetBounds& b, const std::array<bool, 2>& fixed) const {
    const double least = 100 * slack_;
    const Bounds &ss = b.second[0], &st = b.second[1], &tt = b.second[2];
    if (fixed[0]) return fixed[1] || tt.lo > least;
    if (fixed[1]) return ss.lo > least;
    const double mixed = std::max(std::abs(st.lo), std::abs(st.hi));
    return ss.lo > least && tt.lo > least && ss.lo * tt.lo > mixed * mixed * (1 + 1e-12);
  }

  /// Nowhere bent upwards in all directions: no minimum but on sides.
  [[nodiscard]] bool saddle(const NetBounds& b, const std::array<bool, 2>& fixed) const {
    const double least = 100 * slack_;
    const Bounds &ss = b.second[0], &st = b.second[1], &tt = b.second[2];
    if ((!fixed[0] && ss.hi < -least) || (!fixed[1] && tt.hi < -least)) return true;
    if (fixed[0] || fixed[1] || st.lo * st.hi <= 0) return false;
    const double mixed = std::min(std::abs(st.lo), std::abs(st.hi));
    return mixed > least &&
           mixed * mixed > std::max(ss.hi, least) * std::max(tt.hi, least) * (1 + 1e-12);
  }

  void visit(const Net<Capacity>& n, const Net<Capacity>& d, const Range& range,
             std::array<bool, 2> fixed, int depth) {
    const Bounds f = value_bounds(n, d);
    if (f.lo - slack_ >= sink_.reach2()) return;
    if (fixed[0] && fixed[1]) return settle(range);
    const NetBounds b = slopes(n, d, f);
    if (convex(b, fixed)) return settle(range);
    for (std::size_t k = 0; k < 2; ++k) {
      if (fixed[k]) continue;
      const double least = 10 * slack_;
      const bool rises = b.first[k].lo > least, falls = b.first[k].hi < -least;
      if (!rises && !falls) continue;
      return to_side(n, d, range, fixed, k, falls, depth);
    }
    if (saddle(b, fixed)) {
      for (std::size_t k = 0; k < 2; ++k)
        for (const bool high : {false, true})
          if (!fixed[k]) to_side(n, d, range, fixed, k, high, depth);
      return;
    }
    constexpr int deepest = 90;
    const bool level =
        std::sqrt(std::max(f.hi, 0.0)) - std::sqrt(std::max(f.lo, 0.0)) <= tolerance_;
    if (level || depth > deepest || --budget_ < 0)
      return offer_flat(range, fixed, std::max(f.lo, 0.0), !level);
    const auto change = [&](std::size_t k) {
      return fixed[k] ? -1 : std::max(std::abs(b.first[k].lo), std::abs(b.first[k].hi));
    };
    split(n, d, range, fixed, change(1) > change(0) ? 1 : 0, depth);
  }

  /// Looks for minima on one side of the range.
  void to_side(const Net<Capacity>& n, const Net<Capacity>& d, Range range,
               std::array<bool, 2> fixed, std::size_t k, bool high, int depth) {
    const auto i = static_cast<Eigen::Index>(k);
    if (high ? range.hi[i] < 1 : range.lo[i] > 0) return;  // goes on beyond it
    if (piece_.side[2 * k + (high ? 1 : 0)] < 0) return;
    (high ? range.lo : range.hi)[i] = high ? 1 : 0;
    fixed[k] = true;
    const auto direction = static_cast<int>(k);
    Net<Capacity> side_d;
    if (piece_.rational) side_d = side_of(d, direction, high);
    visit(side_of(n, direction, high), side_d, range, fixed, depth + 1);
  }

  void split(const Net<Capacity>& n, const Net<Capacity>& d, const Range& range,
             const std::array<bool, 2>& fixed, int direction, int depth) {
    Net<Capacity> n0, n1, d0, d1;
    halve(n, direction, n0, n1);
    if (piece_.rational) halve(d, direction, d0, d1);
    Range r0 = range, r1 = range;
    r0.hi[direction] = r1.lo[direction] = 0.5 * (range.lo[direction] + range.hi[direction]);
    if (value_bounds(n0, d0).lo <= value_bounds(n1, d1).lo) {
      visit(n0, d0, r0, fixed, depth + 1);
      visit(n1, d1, r1, fixed, depth + 1);
    } else {
      visit(n1, d1, r1, fixed, depth + 1);
      visit(n0, d0, r0, fixed, depth + 1);
    }
  }

  /// The one minimum of a range in which there is no second one.
  void settle(const Range& range) {
    const Vec2 middle = 0.5 * (range.lo + range.hi);
    const Place<Dim> p =
        descend(piece_, control_, point_, range, look(piece_, control_, point_, middle));
    PieceMinimum<Dim> m;
    m.st = p.st;
    m.squared_distance = p.squared;
    m.point = p.r;
    for (Eigen::Index i = 0; i < (piece_.degree[1] == 0 ? 1 : 2); ++i)
      for (const bool high : {false, true}) {
        if (!pulled(p, range, i, high)) continue;
        const bool outer = high ? p.st[i] >= 1 : p.st[i] <= 0;
        const auto side = static_cast<std::size_t>(2 * i + (high ? 1 : 0));
        if (!outer || piece_.side[side] < 0) return;  // the surface goes on: no minimum
      }
    m.pressed = pressed_sides(piece_, p);
    sink_.offer(m);
  }

  void offer_flat(const Range& range, const std::array<bool, 2>& fixed, double least,
                  bool given_up) {
    PieceMinimum<Dim> m;
    m.st = 0.5 * (range.lo + range.hi);
    m.point = look(piece_, control_, point_, m.st).r;
    m.squared_distance = least;
    m.flat = true;
    m.open = given_up;
    unsigned bits = 0;
    for (unsigned k = 0; k < (piece_.degree[1] == 0 ? 1U : 2U); ++k)
      if (fixed[k]) bits |= 1U << (2 * k + (m.st[static_cast<Eigen::Index>(k)] > 0.5 ? 1 : 0));
    m.pressed = static_cast<std::uint8_t>(bits);
    sink_.offer(m);
  }

  static void widen(Bounds& b, double value) { detail::widen(b, value); }
};

}  // namespace detail

/// Offers to the sink every local minimum of the distance over the piece that is nearer than
/// `sink.reach2()`; proved by bounds of Bernstein coefficients: a part of the piece is left out if
/// all of it is farther, or if the distance has no critical point in it; it is settled by Newton's
/// method if the distance is convex in it. What remains is halved.
///
/// Requires   not a `triangle`
/// Returns    minima the bounds cannot tell apart to `tolerance` come marked `flat` with a lower
///            bound of their distance
/// Tested by  tests/unit/projection/test_pieces.cpp
template <int Dim, class Sink>
void find_minima(const Piece<Dim>& piece, Control<Dim> control, const Vec<Dim>& point,
                 double tolerance, Sink& sink) {
  const int degree = std::max(piece.degree[0], piece.degree[1]);
  constexpr bool plane = Dim == 2;
  if (degree <= 1)
    detail::PieceSearch<Dim, plane ? 3 : 9, Sink>(piece, control, point, tolerance, sink).run();
  else if (degree == 2)
    detail::PieceSearch<Dim, plane ? 5 : 25, Sink>(piece, control, point, tolerance, sink).run();
  else if (degree == 3)
    detail::PieceSearch<Dim, plane ? 7 : 49, Sink>(piece, control, point, tolerance, sink).run();
  else
    detail::PieceSearch<Dim, plane ? 15 : 225, Sink>(piece, control, point, tolerance, sink).run();
}

}  // namespace osculate::projection
