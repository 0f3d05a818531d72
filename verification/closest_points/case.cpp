#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "../cases.hpp"
#include "brute.hpp"
#include "osculate/projection/projector.hpp"
#include "targets.hpp"

namespace osculate::verification {
namespace {

using projection::ClosestPoint;
using projection::Feature;
using projection::Mode;
using projection::Projector;

constexpr const char* source = "brute force over samples, refined by Newton's method";

/// What went wrong in a run of random queries.
struct Tally {
  double farther = 0;  ///< largest distance beyond that of brute force, as a part of the size
  int wrong_feature = 0, features_checked = 0;
  int wrong_margin = 0, narrow = 0;
  int several = 0;  ///< queries with more than one local minimum
  double fast_farther = 0;
};

int sides_of(Feature feature, int dim) {
  if (feature == Feature::face) return 0;
  return feature == Feature::edge ? 1 : dim - 1;
}

/// Feature and place, where brute force leaves no doubt about them.
template <int Dim>
void check_feature(const ClosestPoint<Dim>& mine, const typename BruteForce<Dim>::Minimum& best,
                   double size, Tally& tally) {
  const bool clear = mine.margin > 1e-9 * size && (best.on_sides > 0 || best.from_border > 1e-9);
  if (!clear) return;
  ++tally.features_checked;
  const bool same_place = (mine.point - best.point).norm() <= 1e-5 * size;
  // Pulled beyond every side it lies on; a mesh may hold it from the neighbour's face.
  const bool named = best.on_sides == 0 ? mine.feature == Feature::face
                     : best.pulled      ? sides_of(mine.feature, Dim) == best.on_sides
                                        : true;
  if (!same_place || !named) ++tally.wrong_feature;
}

/// Margin against the second distinct minimum. A minimum that lies in a valley narrower than the
/// samples is found only by the bounds: then it must be one.
template <int Dim>
void check_margin(const BruteForce<Dim>& brute, const Vec<Dim>& point,
                  const std::vector<typename BruteForce<Dim>::Minimum>& all,
                  const ClosestPoint<Dim>& mine, double size, Tally& tally) {
  double second = std::numeric_limits<double>::infinity();
  for (const auto& m : all)
    if (!m.inner && (m.point - mine.point).norm() > 1e-5 * size)
      second = std::min(second, m.distance);
  const double margin = second - std::abs(mine.distance);
  const double less =
      std::isfinite(margin) || std::isfinite(mine.margin) ? margin - mine.margin : 0;
  if (std::abs(less) <= 1e-9 * size) return;
  if (less > 0 && brute.holds(point, mine.second)) {
    ++tally.narrow;
    return;
  }
  ++tally.wrong_margin;
}

template <int Dim>
Tally run_queries(const SampleTarget<Dim>& sample, int count) {
  const Projector<Dim> projector(sample.target);
  const BruteForce<Dim> brute(sample.target, sample.grid);
  const double size = projector.size();
  std::mt19937 generator(20080310);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Tally tally;
  for (int q = 0; q < count; ++q) {
    Vec<Dim> point = 0.5 * (brute.lo() + brute.hi());
    for (int i = 0; i < Dim; ++i) point[i] += 0.75 * size * uniform(generator);
    const ClosestPoint<Dim> mine = projector.closest(point, Mode::certified);
    const double beyond = sample.one_facet ? 10 * size : 1e-6 * size;
    const auto minima = brute.minima(point, beyond);
    const double distance = std::abs(mine.distance);
    tally.farther = std::max(tally.farther, (distance - minima.front().distance) / size);
    const double fast = std::abs(projector.closest(point, Mode::fast).distance);
    tally.fast_farther = std::max(tally.fast_farther, (fast - minima.front().distance) / size);
    if (std::isfinite(mine.margin)) ++tally.several;
    check_feature<Dim>(mine, minima.front(), size, tally);
    if (sample.one_facet) check_margin<Dim>(brute, point, minima, mine, size, tally);
  }
  return tally;
}

template <int Dim>
void add_rows(const SampleTarget<Dim>& sample, int count, CaseResult& result) {
  const Tally tally = run_queries(sample, count);
  const auto row = [&](const std::string& what, double value, double limit, Relation relation) {
    result.rows.push_back({sample.name + ": " + what, value, limit, relation, 0, source});
  };
  row("farther than brute force (of the size)", tally.farther, 1e-12, Relation::at_most);
  row("wrong feature or place", tally.wrong_feature, 0, Relation::equal);
  if (sample.one_facet) row("wrong margin", tally.wrong_margin, 0, Relation::equal);
  if (tally.narrow > 0)
    row("minima between the samples of brute force", tally.narrow, 0, Relation::info);
  row("features checked", tally.features_checked, count, Relation::info);
  row("queries with several minima", tally.several, count, Relation::info);
  row("fast mode: farther than brute force", tally.fast_farther, 0, Relation::info);
}

CaseResult run_all(int count) {
  CaseResult result;
  for (const SampleTarget<2>& sample : plane_targets()) add_rows(sample, count, result);
  for (const SampleTarget<3>& sample : space_targets()) add_rows(sample, count, result);
  return result;
}

}  // namespace

CaseResult closest_points(const CaseContext&) { return run_all(1000); }
CaseResult closest_points_many(const CaseContext&) { return run_all(100000); }

}  // namespace osculate::verification
