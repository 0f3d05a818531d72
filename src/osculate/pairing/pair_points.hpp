#pragma once
// What evaluations of a pair consist of: what its points share, and one point after the other; for
// sources of this layer.
#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

#include "osculate/core/crew.hpp"
#include "osculate/pairing/master_at.hpp"
#include "osculate/pairing/pair.hpp"
#include "osculate/pairing/point_block.hpp"
#include "osculate/pairing/point_normal.hpp"
#include "osculate/pairing/point_sample.hpp"
#include "osculate/pairing/reentrant_edge.hpp"
#include "osculate/pairing/reentrant_vertex.hpp"
#include "osculate/pairing/response.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::pairing {

/// Adds the time since the last call to one of the phases.
class Laps {
 public:
  void add_to(double& seconds) {
    const auto now = std::chrono::steady_clock::now();
    seconds += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// evaluate(k, laps, seconds) for k from `begin` to before `end`, in pieces by all threads.
/// together(k): k is to be in the piece of k - 1.
template <class Together, class Evaluate>
void share_points(core::Crew* crew, std::size_t begin, std::size_t end, const Together& together,
                  PairSeconds& seconds, const Evaluate& evaluate) {
  constexpr std::size_t piece = 16, worth_it = 2 * piece;
  const auto some = [&](std::size_t from, std::size_t to, PairSeconds& of) {
    Laps laps;
    for (std::size_t k = from; k < to; ++k) evaluate(k, laps, of);
  };
  if (!crew || crew->threads() == 1 || end - begin < worth_it) return some(begin, end, seconds);
  std::vector<std::size_t> cuts{begin};
  while (cuts.back() < end) {
    std::size_t next = std::min(end, cuts.back() + piece);
    while (next < end && together(next)) ++next;
    cuts.push_back(next);
  }
  std::vector<PairSeconds> of_pieces(cuts.size() - 1);
  double all = 0;
  Laps laps;
  crew->share(of_pieces.size(), [&](std::size_t p) { some(cuts[p], cuts[p + 1], of_pieces[p]); });
  laps.add_to(all);
  double projection = 0, evaluation = 0;
  for (const PairSeconds& of : of_pieces) {
    projection += of.projection;
    evaluation += of.evaluation;
  }
  const double sum = projection + evaluation;
  if (!(sum > 0)) return;
  seconds.projection += all * projection / sum;
  seconds.evaluation += all * evaluation / sum;
}

/// Nodes of the largest block there can be.
template <int Dim>
int largest_block(const PairDefinition<Dim>& pair) {
  constexpr int of_edge_contact = 6;
  int slave = 1, master = 0;
  for (const SlavePoint<Dim>& p : pair.slave.points) slave = std::max(slave, p.count);
  for (const auto& facet : pair.master.facets) master = std::max(master, facet.count);
  const bool both_facets = Dim == 3 && has_reentrant_vertices(pair);
  return std::max(slave + (both_facets ? 2 : 1) * master, edges_of(pair) ? of_edge_contact : 0);
}

inline void refresh_facets(const Chain& master, Points<2> x, PairEvaluation<2>& out) {
  facet_boxes(master, x, out.boxes);
}
inline void refresh_facets(const FacetSurface& master, Points<3> x, PairEvaluation<3>& out) {
  const auto is_smooth = [](const SurfaceFacet& f) { return f.patch != nullptr; };
  out.patches.resize(std::ranges::any_of(master.facets, is_smooth) ? master.facets.size() : 0);
  for (std::size_t f = 0; f < out.patches.size(); ++f)
    if (is_smooth(master.facets[f])) out.patches[f] = patch_points(master.facets[f], x);
  facet_boxes(master, x, out.boxes, out.patches);
}

/// Blocks of the points, and empty ones of a smooth master's facets, each under many slave facets.
template <int Dim>
void refresh_blocks(const PairDefinition<Dim>& pair, PairEvaluation<Dim>& out) {
  const std::size_t n = pair.slave.points.size();
  const bool shared = !edges_of(pair) && !has_reentrant_vertices(pair);
  const std::size_t facets = shared ? out.patches.size() : 0;
  out.blocks.resize(n + facets);
  out.master_blocks = facets > 0 ? n : 0;
  for (std::size_t k = n; k < out.blocks.size(); ++k) clear_block(out.blocks[k]);
}

/// Whether points were looked for on many facets in vain, or nobody knows yet.
template <int Dim>
bool some_had_no_place(const PairDefinition<Dim>& pair, const PairEvaluation<Dim>& out) {
  constexpr std::size_t few = 16;
  if (pair.master.facets.size() < few) return false;
  const std::size_t n = std::min(out.points.size(), pair.slave.points.size());
  const auto end = out.points.begin() + static_cast<std::ptrdiff_t>(n);
  return out.points.empty() ||
         std::any_of(out.points.begin(), end,
                     [](const PointResult<Dim>& point) { return point.history.facet < 0; });
}

/// All that the points of a pair share at `x`. `only`: the points that will be looked at.
template <int Dim>
void refresh(const PairDefinition<Dim>& pair, Points<Dim> x, bool with_tangent,
             PairEvaluation<Dim>& out, const std::vector<std::size_t>* only = nullptr) {
  const std::size_t n = pair.slave.points.size();
  const bool in_vain = some_had_no_place(pair, out);
  out.points.resize(n);
  const std::size_t before = out.boxes.size();
  if (!rests(pair.master, x, out.master_at)) {
    refresh_facets(pair.master, x, out);
    out.planted = false;
  }
  refresh_blocks(pair, out);
  out.taken_multipliers.resize(has_reentrant_vertices(pair) ? n : 0);
  out.block_nodes = largest_block(pair);
  if (pair.weight == Weight::current_area) {
    point_areas<Dim>(pair.slave, x, pair.area, out.areas,
                     with_tangent ? &out.area_gradients : nullptr);
    if (pair.filter.limited())
      nodal_areas(pair.filter.parts, x, pair.area, out.filter.areas,
                  with_tangent ? &out.filter.area_gradients : nullptr);
  }
  if (!out.planted) out.same_way.fresh = false;
  out.apart = beyond_search(pair, x, out.boxes);
  if (pair.filter.limited()) {
    // The first evaluation gives the tree its shape, so that it does not depend on when they met.
    // Who asks for some points asks it how far they are, too.
    if (!out.apart || only || out.tree.size() != out.boxes.size()) {
      refresh(pair.filter, pair.master, x, out.boxes, !out.planted, out.filter, out.tree);
      out.planted = true;
    }
    mean_normals(pair.filter, out.filter, out.normals);
    return;
  }
  if (only) {
    out.normals.resize(n);
    for (const std::size_t i : *only) out.normals[i] = point_normal<Dim>(pair.slave, x, i);
  } else {
    point_normals<Dim>(pair.slave, x, out.normals);
  }
  if (!out.planted) {
    if (before == out.boxes.size() && before > 0)
      out.tree.refit(out.boxes);
    else
      out.tree = Tree<Dim>(out.boxes);
    out.planted = true;
  }
  if (in_vain && !out.same_way.fresh) out.same_way.refresh(pair.master, x, out.tree);
}
inline std::array<Index, 2> neighbours(const Facet& facet) { return {facet.prev, facet.next}; }
inline const auto& neighbours(const SurfaceFacet& facet) { return facet.neighbour; }

/// Whether the facets next to one lie in its plane, but for 1e-3 rad: 5 % of its length beyond its
/// border the gap is off by 5e-5 of it, less than what a facet leaves of an arc.
template <int Dim>
bool is_flat_around(const Boundary<Dim>& master, Index facet, Points<Dim> x) {
  constexpr double flat = 1 - 5e-7;
  const auto& own = master.facets[static_cast<std::size_t>(facet)];
  if (own.shape) return false;
  const Vec<Dim> n = middle_normal(own, x);
  return std::ranges::all_of(neighbours(own), [&](Index other) {
    return other < 0 ||
           n.dot(middle_normal(master.facets[static_cast<std::size_t>(other)], x)) > flat;
  });
}

/// The facet that a point keeps: one of a plane from the first change on, where it makes hardly a
/// difference and neighbours would take turns for the sake of rounding.
template <int Dim>
Index kept_facet(const Boundary<Dim>& master, const ActiveBranch<Dim>& active, Points<Dim> x) {
  const bool of_a_plane =
      active.changes > 0 && active.facet >= 0 && is_flat_around<Dim>(master, active.facet, x);
  return of_a_plane ? active.facet : active.kept();
}

/// A point where it was placed, or in the re-entrant vertex beside that place.
template <int Dim>
void evaluate_projected(const PairDefinition<Dim>& pair, Points<Dim> x,
                        const contact::PointHistory<Dim>& history, ProjectedPoint<Dim>& projected,
                        PointContext<Dim>& context, bool with_tangent, std::size_t i,
                        PairEvaluation<Dim>& out) {
  if constexpr (Dim == 2)
    if (has_reentrant_vertices(pair) && context.multiplier)
      if (const std::optional<ReentrantVertex> reentrant = find_reentrant_vertex(
              pair, x, history, i, out, out.taken_multipliers[i], context, projected)) {
        evaluate_reentrant_vertex(pair, x, history, *reentrant, context, with_tangent, i, out);
        return;
      }
  if constexpr (Dim == 3)
    if (has_reentrant_vertices(pair) && context.multiplier)
      if (const std::optional<EdgePlace> place = find_reentrant_edge(
              pair, x, history, i, out, out.taken_multipliers[i], context, projected)) {
        evaluate_reentrant_edge(pair, x, history, *place, context, with_tangent, i, out);
        return;
      }
  context.kept =
      keeps_contact(pair, x, history, projected, context, position<Dim>(pair.slave.points[i], x));
  evaluate_point<Dim>(pair, x, history,
                      {pair.master, projected, &pair.slave.points[i], 1, pair.history}, context,
                      with_tangent, i, out);
}

/// One point where it was placed: what it reports and remembers, its block. `context` without the
/// way of the gap.
template <int Dim>
void evaluate_slave_point(const PairDefinition<Dim>& pair, Points<Dim> x,
                          const contact::PointHistory<Dim>& history,
                          const ActiveSet<Dim>& active_set, ProjectedPoint<Dim>& projected,
                          PointContext<Dim>& context, bool with_tangent, std::size_t i,
                          PairEvaluation<Dim>& out, Laps& laps, PairSeconds& seconds) {
  context.way =
      way_of_gap(pair, active_set, history, projected.projection.facet, projected.kinematics.gap);
  laps.add_to(seconds.projection);
  evaluate_projected(pair, x, history, projected, context, with_tangent, i, out);
  laps.add_to(seconds.evaluation);
}

}  // namespace osculate::pairing
