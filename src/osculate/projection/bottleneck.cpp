#include "osculate/projection/bottleneck.hpp"

#include <algorithm>
#include <cmath>

#include "osculate/core/dense.hpp"

namespace osculate::projection {
namespace {

template <int Dim>
using Tangents = std::array<Vec<Dim>, Dim - 1>;

std::array<Vec2, 1> first(const geometry::CurveJet<2>& j) { return {j.r1}; }
std::array<Vec3, 2> first(const geometry::SurfaceJet& j) { return j.r1; }
Vec2 second(const geometry::CurveJet<2>& j, std::size_t, std::size_t) { return j.r2; }
Vec3 second(const geometry::SurfaceJet& j, std::size_t a, std::size_t b) { return j.r2[a + b]; }

/// Gradient and second derivatives of |p - q|^2/2 in the parameters of both, scaled to unit
/// tangents.
template <int Dim>
struct PairSystem {
  static constexpr int m = Dim - 1;
  Vec<2 * m> gradient;
  Mat<2 * m, 2 * m> second;
  Vec<2 * m> scale;  ///< lengths of the tangents

  PairSystem(const typename Composed<Dim>::Jet& p, const typename Composed<Dim>::Jet& q) {
    const Vec<Dim> d = q.r - p.r;
    const Tangents<Dim> tp = first(p), tq = first(q);
    const auto tangent = [&](int i) -> const Vec<Dim>& {
      return i < m ? tp[static_cast<std::size_t>(i)] : tq[static_cast<std::size_t>(i - m)];
    };
    for (int i = 0; i < 2 * m; ++i) {
      scale[i] = std::max(tangent(i).norm(), 1e-300);
      gradient[i] = (i < m ? -1 : 1) * d.dot(tangent(i)) / scale[i];
    }
    for (int i = 0; i < 2 * m; ++i)
      for (int j = 0; j < 2 * m; ++j) {
        const bool same = (i < m) == (j < m);
        double entry = (same ? 1 : -1) * tangent(i).dot(tangent(j));
        const auto a = static_cast<std::size_t>(i % m), b = static_cast<std::size_t>(j % m);
        if (same)
          entry += i < m ? -d.dot(osculate::projection::second(p, a, b))
                         : d.dot(osculate::projection::second(q, a, b));
        second(i, j) = entry / scale[i] / scale[j];
      }
  }
};

template <int Dim>
struct Pair {
  PieceSample p, q;
  double distance = 0;
};

/// Moves a place by a step in its parameters, to another piece if it leaves its own.
template <int Dim>
PieceSample moved(const Composed<Dim>& s, const PieceSample& from, const Vec2& step) {
  const SmoothPiece& piece = s.pieces()[static_cast<std::size_t>(from.piece)];
  const Vec2 range = (piece.hi - piece.lo).cwiseMax(1e-300);
  const double part = step.cwiseQuotient(range).cwiseAbs().maxCoeff();
  const Vec2 xi = from.xi + (part > 0.3 ? 0.3 / part : 1.0) * step;
  const bool inside = (xi.array() >= piece.lo.array()).all() &&
                      (xi.array() <= piece.hi.array()).all() && (!piece.triangle || xi.sum() <= 1);
  if (inside) return {from.piece, xi};
  const NearestPlace<Dim> q = s.nearest(s.jet(from.piece, xi).r);
  return q.piece < 0 ? from : PieceSample{q.piece, q.xi};
}

/// The shortest solution, also where whole families of pairs are equally far apart.
template <int N>
Vec<N> solve_symmetric(const Mat<N, N>& matrix, const Vec<N>& right) {
  const core::Spectrum eigen = core::spectrum(matrix);
  const double zero = 1e-9 * eigen.values.cwiseAbs().maxCoeff();
  Vec<N> x = Vec<N>::Zero();
  for (int i = 0; i < N; ++i) {
    const double value = eigen.values[i];
    const Vec<N> direction = eigen.vectors.col(i);
    if (std::abs(value) > zero) x += direction.dot(right) / value * direction;
  }
  return x;
}

template <int Dim>
bool solve(const Composed<Dim>& s, Pair<Dim>& pair) {
  constexpr int m = Dim - 1, most = 30;
  for (int it = 0; it < most; ++it) {
    const auto p = s.jet(pair.p.piece, pair.p.xi), q = s.jet(pair.q.piece, pair.q.xi);
    pair.distance = (q.r - p.r).norm();
    if (!(pair.distance > 1e-6 * s.size())) return false;
    const PairSystem<Dim> system(p, q);
    if (system.gradient.norm() < 1e-11 * pair.distance) return true;
    Vec<2 * m> step = -solve_symmetric<2 * m>(system.second, system.gradient);
    if (!step.allFinite()) return false;
    step = step.cwiseQuotient(system.scale);
    Vec2 a = Vec2::Zero(), b = Vec2::Zero();
    a.head<m>() = step.template head<m>();
    b.head<m>() = step.template tail<m>();
    pair.p = moved(s, pair.p, a);
    pair.q = moved(s, pair.q, b);
  }
  return false;
}

/// True if p and q see each other along their normals of that side.
template <int Dim>
bool face_each_other(const SurfacePlace<Dim>& p, const SurfacePlace<Dim>& q, int side) {
  const Vec<Dim> d = q.r - p.r;
  return p.valid && q.valid && side * d.dot(p.n) > 0 && -side * d.dot(q.n) > 0;
}

/// For each sample the one that it faces best.
template <int Dim>
std::vector<Pair<Dim>> candidates(const Composed<Dim>& s, int side,
                                  std::span<const PieceSample> samples) {
  constexpr std::size_t most = 1200;
  const std::size_t stride = samples.size() / most + 1;
  std::vector<PieceSample> chosen;
  std::vector<SurfacePlace<Dim>> places;
  for (std::size_t k = 0; k < samples.size(); k += stride) {
    chosen.push_back(samples[k]);
    places.push_back(s.place(samples[k].piece, samples[k].xi));
  }
  std::vector<Pair<Dim>> out;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    double best = 0.5;
    Pair<Dim> pair;
    for (std::size_t j = 0; j < chosen.size(); ++j) {
      if (j == i || !face_each_other(places[i], places[j], side)) continue;
      const Vec<Dim> d = places[j].r - places[i].r;
      const double square = d.squaredNorm(), a = d.dot(places[i].n), b = d.dot(places[j].n);
      const double off = 2 - (a * a + b * b) / square;  // squares of the two sines
      if (!(off < best)) continue;
      best = off;
      pair = {chosen[i], chosen[j], std::sqrt(square)};
    }
    if (best < 0.5) out.push_back(pair);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Pair<Dim>& a, const Pair<Dim>& b) { return a.distance < b.distance; });
  return out;
}

}  // namespace

template <int Dim>
SideLimit<Dim> smallest_bottleneck(const Composed<Dim>& s, int side,
                                   std::span<const PieceSample> samples) {
  SideLimit<Dim> out;
  constexpr int most_tries = 400;
  int tries = 0;
  for (Pair<Dim>& pair : candidates(s, side, samples)) {
    if (0.25 * pair.distance > out.value || ++tries > most_tries) break;
    if (!solve(s, pair) || !(0.5 * pair.distance < out.value)) continue;
    const SurfacePlace<Dim> p = s.place(pair.p.piece, pair.p.xi);
    const SurfacePlace<Dim> q = s.place(pair.q.piece, pair.q.xi);
    if (face_each_other(p, q, side)) out = {0.5 * pair.distance, Limit::bottleneck, p.r, q.r};
  }
  return out;
}

template SideLimit<2> smallest_bottleneck(const Composed<2>&, int, std::span<const PieceSample>);
template SideLimit<3> smallest_bottleneck(const Composed<3>&, int, std::span<const PieceSample>);

}  // namespace osculate::projection
