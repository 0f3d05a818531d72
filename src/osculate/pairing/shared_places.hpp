#pragma once
// Places of points, each looked for by one process and told to all; for sources of this layer.
#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// A place as numbers, none of which another process adds to.
template <int Dim>
inline constexpr std::size_t numbers_of_place = 2 * Dim + 4;

template <int Dim>
void to_numbers(const Projection<Dim>& p, double* to) {
  *to++ = static_cast<double>(p.feature);
  *to++ = p.facet;
  *to++ = p.local;
  *to++ = p.beyond_end ? 1 : 0;
  *to++ = p.distance;
  for (const double xi : p.xi) *to++ = xi;
  for (const double n : p.outward) *to++ = n;
}
template <int Dim>
[[nodiscard]] Projection<Dim> place_of_numbers(const double* from) {
  Projection<Dim> p;
  p.feature = static_cast<projection::Feature>(*from++);
  p.facet = static_cast<Index>(*from++);
  p.local = static_cast<int>(*from++);
  p.beyond_end = *from++ != 0;
  p.distance = *from++;
  for (double& xi : p.xi) xi = *from++;
  for (double& n : p.outward) n = *from++;
  return p;
}

/// find(i) for the points `of` a pair: each process has as many, neighbours together.
template <int Dim, class Find>
[[nodiscard]] std::vector<Projection<Dim>> places_by_all(std::span<const std::size_t> of,
                                                         const Workers& workers, const Find& find) {
  constexpr std::size_t size = numbers_of_place<Dim>, piece = 16;
  std::vector<double> numbers(size * of.size(), core::Ranks::nothing);
  const auto count = static_cast<std::size_t>(workers.ranks->count()),
             rank = static_cast<std::size_t>(workers.ranks->rank());
  const std::size_t first = of.size() * rank / count, last = of.size() * (rank + 1) / count;
  const auto look = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = first + begin; k < first + end; ++k)
      to_numbers<Dim>(find(of[k]), &numbers[size * k]);
  };
  if (workers.crew)
    workers.crew->share_runs(last - first, piece, look);
  else
    look(0, last - first);
  workers.ranks->sum(numbers);
  std::vector<Projection<Dim>> places(of.size());
  for (std::size_t k = 0; k < of.size(); ++k) places[k] = place_of_numbers<Dim>(&numbers[size * k]);
  return places;
}

template <int Dim>
std::vector<std::size_t> all_points(const PairDefinition<Dim>& pair) {
  std::vector<std::size_t> all(pair.slave.points.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

/// Whether this process wants the tangent of a point at its place. Rows of multipliers may be
/// anybody's.
template <int Dim>
bool is_seen(const PairDefinition<Dim>& pair, std::size_t i, const Projection<Dim>& place,
             const Workers& workers) {
  if (workers.seen.empty() || by_multipliers(pair) || place.facet < 0) return true;
  const auto seen = [&](const Index node) {
    return workers.seen[static_cast<std::size_t>(node)] != 0;
  };
  const SlavePoint<Dim>& slave = pair.slave.points[i];
  const auto& facet = pair.master.facets[static_cast<std::size_t>(place.facet)];
  return std::any_of(slave.nodes.begin(), slave.nodes.begin() + slave.count, seen) ||
         std::any_of(facet.nodes.begin(), facet.nodes.begin() + facet.count, seen);
}

}  // namespace osculate::pairing
