#include "osculate/pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "osculate/embed/definition.hpp"
#include "osculate/errors.hpp"
#include "osculate/evaluator.hpp"
#include "osculate/pairing/reachable.hpp"

namespace osculate {
namespace {

using embed::Access;
using Lists = std::vector<std::vector<Index>>;

void make_unique(std::vector<Index>& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// Lists behind each other.
void compress(Lists& lists, std::vector<Index>& start, std::vector<Index>& all) {
  start.assign(1, 0);
  for (std::vector<Index>& list : lists) {
    make_unique(list);
    all.insert(all.end(), list.begin(), list.end());
    if (all.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
      throw Refused("the pattern has more places than numbers of 32 bits can count");
    start.push_back(static_cast<Index>(all.size()));
  }
}

/// Adds columns to the lists of rows; a list that has grown is made unique on the way.
void add_product(const std::vector<Index>& rows, const std::vector<Index>& columns, Lists& lists) {
  constexpr std::size_t large = 4096;
  for (const Index row : rows) {
    std::vector<Index>& list = lists[static_cast<std::size_t>(row)];
    const bool grows = list.size() / large != (list.size() + columns.size()) / large;
    list.insert(list.end(), columns.begin(), columns.end());
    if (grows) make_unique(list);
  }
}

void append(const std::vector<Index>& more, std::vector<Index>& list) {
  list.insert(list.end(), more.begin(), more.end());
}

/// Nodes that a point pushes on a facet.
template <int Dim>
std::vector<Index> pushed(const pairing::PairDefinition<Dim>& pair,
                          const pairing::ReachablePoint& p, Index f) {
  std::vector<Index> rows = p.own;
  if (pairing::is_tied(pair)) return rows;
  const auto& facet = pair.master.facets[static_cast<std::size_t>(f)];
  rows.insert(rows.end(), facet.nodes.begin(), facet.nodes.begin() + facet.count);
  make_unique(rows);
  return rows;
}

template <int Dim>
void add_point(const pairing::PairDefinition<Dim>& pair, const pairing::ReachablePoint& p,
               Lists& columns, Lists& of_points, Pattern& out) {
  std::vector<Index> rows = p.own;
  const bool apart = p.further.empty();  // the force on a facet depends on that facet alone
  for (const Index f : p.facets) {
    out.couplings.push_back({p.point, f});
    const std::vector<Index> on = pushed(pair, p, f);
    if (apart) add_product(on, on, columns);
    append(on, rows);
  }
  make_unique(rows);
  std::vector<Index> all = rows;
  append(p.further, all);
  make_unique(all);
  if (!apart || p.facets.empty()) add_product(rows, all, columns);
  append(all, of_points[static_cast<std::size_t>(p.point)]);
}

void check_reach(const Reach& reach) {
  if (!(reach.motion >= 0))
    throw Refused(fmt::format("reach: motion must be >= 0, got {:g}", reach.motion));
  if (!(reach.distance >= 0))
    throw Refused(fmt::format("reach: distance must be >= 0, got {:g}", reach.distance));
}

}  // namespace

template <int Dim>
Pattern Evaluator<Dim>::pattern(std::span<const double> coordinates, const History<Dim>& committed,
                                const Reach& reach) const {
  const embed::Definition<Dim>& d = *definition_;
  check_reach(reach);
  const auto& history = Access::of(committed);
  if (!history) throw Refused("history: there is none; ask for initial_history first");
  if (history->key != d.key) throw Refused("history: it belongs to another contact");
  std::vector<Vec<Dim>> x;
  embed::read_points<Dim>(coordinates, d.nodes, x);
  const std::vector<pairing::ReachablePoint> points = embed::refusing("pattern: ", [&] {
    return pairing::reachable<Dim>(d.pair, x, history->state, {reach.motion, reach.distance});
  });
  Pattern out;
  out.dimension = Dim;
  Lists columns(d.nodes), of_points(d.pair.slave.points.size());
  for (const pairing::ReachablePoint& p : points) add_point(d.pair, p, columns, of_points, out);
  compress(columns, out.row_start, out.columns);
  compress(of_points, out.point_start, out.point_nodes);
  return out;
}

template Pattern Evaluator<2>::pattern(std::span<const double>, const History<2>&,
                                       const Reach&) const;
template Pattern Evaluator<3>::pattern(std::span<const double>, const History<3>&,
                                       const Reach&) const;

template <class Number>
CsrPattern<Number> csr_pattern(const Pattern& pattern, std::span<const Number> row_of,
                               std::span<const Number> column_of, Number rows, Number base) {
  const auto dim = static_cast<std::size_t>(pattern.dimension);
  const std::size_t nodes = pattern.row_start.empty() ? 0 : pattern.row_start.size() - 1;
  if (row_of.size() < dim * nodes || column_of.size() < dim * nodes)
    throw Refused(fmt::format("the maps have {} and {} numbers, and there are {} coordinates",
                              row_of.size(), column_of.size(), dim * nodes));
  std::vector<std::vector<Number>> lists(static_cast<std::size_t>(std::max(rows, Number{0})));
  for (std::size_t n = 0; n < nodes; ++n)
    for (std::size_t i = 0; i < dim; ++i) {
      const auto begin = static_cast<std::size_t>(pattern.row_start[n]),
                 end = static_cast<std::size_t>(pattern.row_start[n + 1]);
      const Number row = row_of[dim * n + i];
      if (row < base || begin == end) continue;
      if (row - base >= rows) throw Refused(fmt::format("the matrix has no row {}", row));
      std::vector<Number>& list = lists[static_cast<std::size_t>(row - base)];
      for (std::size_t k = begin; k < end; ++k)
        for (std::size_t j = 0; j < dim; ++j) {
          const Number c = column_of[dim * static_cast<std::size_t>(pattern.columns[k]) + j];
          if (c >= base) list.push_back(c);
        }
    }
  CsrPattern<Number> out;
  out.row_start.push_back(base);
  for (std::vector<Number>& list : lists) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
    out.columns.insert(out.columns.end(), list.begin(), list.end());
    if (out.columns.size() >= static_cast<std::size_t>(std::numeric_limits<Number>::max() - base))
      throw Refused("the pattern has more places than its numbers can count: use those of 64 bits");
    out.row_start.push_back(base + static_cast<Number>(out.columns.size()));
  }
  return out;
}

template CsrPattern<std::int32_t> csr_pattern(const Pattern&, std::span<const std::int32_t>,
                                              std::span<const std::int32_t>, std::int32_t,
                                              std::int32_t);
template CsrPattern<std::int64_t> csr_pattern(const Pattern&, std::span<const std::int64_t>,
                                              std::span<const std::int64_t>, std::int64_t,
                                              std::int64_t);

}  // namespace osculate
