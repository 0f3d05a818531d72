#include "osculate/pairing/pair.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "osculate/core/error.hpp"
#include "osculate/pairing/combinations.hpp"
#include "osculate/pairing/mortar.hpp"
#include "osculate/pairing/pair_points.hpp"
#include "osculate/pairing/placed_points.hpp"
#include "osculate/pairing/point_block.hpp"
#include "osculate/pairing/point_sample.hpp"
#include "osculate/pairing/reentrant_edge.hpp"
#include "osculate/pairing/reentrant_vertex.hpp"
#include "osculate/pairing/response.hpp"
#include "osculate/pairing/sampling.hpp"
#include "osculate/pairing/shared_places.hpp"
#include "osculate/pairing/tie.hpp"

namespace osculate::pairing {

using contact::Branch;
using contact::PointHistory;
using projection::Feature;

namespace {

template <int Dim>
void check_areas(const PairDefinition<Dim>& pair) {
  if (pair.weight == Weight::node) return;
  for (const double area : pair.reference_areas)
    if (!(area > 0))
      throw core::GeometryError(
          sampled_at_nodes(pair.slave)
              ? "a slave node has no positive tributary area; use weight: node"
              : "a slave facet has no area; use weight: node");
}

bool find_reentrant(Chain& master, Points<2> reference, ByMultipliers& unknown) {
  return mark_reentrant_vertices(master, reference, unknown.reentrant_angle);
}
bool find_reentrant(const FacetSurface& master, Points<3> reference, ByMultipliers& unknown) {
  return find_reentrant_edges(master, reference, unknown.reentrant_angle, unknown.reentrant_edges);
}

template <int Dim>
void find_reentrant_vertices(PairDefinition<Dim>& pair, Points<Dim> reference) {
  auto* const unknown = std::get_if<ByMultipliers>(&pair.enforcement);
  if (!unknown) return;
  unknown->reentrant_vertices = !by_mortar(pair) && is<MayPart>(pair.separation) &&
                                pair.offset == 0 && pair.overlap == InitialOverlap::acts &&
                                find_reentrant(pair.master, reference, *unknown);
}

}  // namespace

template <int Dim>
void prepare(PairDefinition<Dim>& pair, Points<Dim> reference) {
  if (const Refusal* const no = refusal(traits_of(pair)))
    throw core::GeometryError(std::string(no->why));
  prepare(pair.filter, pair.master, pair.slave, reference, pair.area);
  point_areas<Dim>(pair.slave, reference, pair.area, pair.reference_areas, nullptr);
  if constexpr (Dim == 3)
    if (auto* const edges = std::get_if<AtEdgesToo>(&pair.sampler))
      prepare_edges(*edges, pair.master, pair.slave, pair.reference_areas, reference);
  find_reentrant_vertices(pair, reference);
  if (auto* const mortar = std::get_if<ByMortar<Dim>>(&pair.sampler))
    mortar->reference.assign(reference.begin(), reference.end());
  check_areas(pair);
  prepare_ties(pair, reference);
}

namespace {

template <int Dim>
Mat<Dim, Dim - 1> frame_of_history(const PairDefinition<Dim>& pair, std::size_t i,
                                   const PointHistory<Dim>& h, Points<Dim> x) {
  if (by_mortar(pair)) return mortar_frame(pair, i, x);
  if constexpr (Dim == 3)
    if (h.edge >= 0) return edge_contact_frame(pair, h, x);
  return stored_frame(pair.master, h.facet, h.xi, x);
}

}  // namespace

namespace {

/// The points of a pair, one run of whole facets of the slave after the other, by several threads.
/// Who takes their blocks gets them after each run, so that there are tangents of one run alone.
template <int Dim>
class PointLoop {
 public:
  PointLoop(const PairDefinition<Dim>& pair, PairEvaluation<Dim>& out, const BlockTaker<Dim>& take,
            core::Crew* crew)
      : points_(pair.slave.points), out_(out), take_(take) {
    // Blocks of the master's facets are the sum of points.
    if (out.master_blocks == 0) crew_ = crew;
  }

  /// evaluate(i, laps, seconds) for every point.
  template <class Evaluate>
  void run(const Evaluate& evaluate) {
    const std::size_t length = crew_ && crew_->threads() > 1 ? 64 * piece
                               : take_                       ? piece
                                                             : points_.size();
    for (std::size_t end = 0; begin_ < points_.size(); begin_ = end) {
      end = end_of_facets(begin_, length);
      lend(end);
      evaluate_run(end, evaluate);
      if (!take_) continue;
      hand_over(end);
      take_back(end);
    }
  }
  /// Blocks of no slave point.
  void hand_over_others() {
    if (take_) hand_over(out_.blocks.size());
  }

 private:
  static constexpr std::size_t piece = 16;

  /// The end of the facet in which the run from `from` has at least so many points.
  [[nodiscard]] std::size_t end_of_facets(std::size_t from, std::size_t least) const {
    std::size_t end = std::min(points_.size(), from + least);
    while (end < points_.size() && on_same_nodes(points_[end - 1], points_[end])) ++end;
    return end;
  }
  /// The tangents of the last run serve for this one.
  void lend(std::size_t end) {
    const std::size_t count = std::min(end - begin_, out_.spare.size());
    for (std::size_t k = 0; k < count; ++k) {
      ContactBlock<Dim>& block = out_.blocks[begin_ + k];
      std::swap(block.tangent, out_.spare[k].tangent);
      // Zero is what belongs to nodes of the master, behind so many of the slave.
      block.without_master =
          out_.spare[k].without_master && out_.spare[k].slave_count == points_[begin_ + k].count;
    }
  }
  void take_back(std::size_t end) {
    if (out_.spare.size() < end - begin_) out_.spare.resize(end - begin_);
    for (std::size_t k = 0; k < end - begin_; ++k) {
      ContactBlock<Dim>& block = out_.blocks[begin_ + k];
      out_.spare[k] = {std::move(block.tangent), std::exchange(block.without_master, false),
                       points_[begin_ + k].count};
    }
  }
  template <class Evaluate>
  void evaluate_run(std::size_t end, const Evaluate& evaluate) {
    const auto together = [&](std::size_t i) { return on_same_nodes(points_[i - 1], points_[i]); };
    share_points(crew_, begin_, end, together, out_.seconds, evaluate);
  }
  void hand_over(std::size_t end) {
    take_(std::span<const ContactBlock<Dim>>(out_.blocks).subspan(begin_, end - begin_));
  }

  const std::vector<SlavePoint<Dim>>& points_;
  PairEvaluation<Dim>& out_;
  const BlockTaker<Dim>& take_;
  core::Crew* crew_ = nullptr;
  std::size_t begin_ = 0;
};

}  // namespace

template <int Dim>
void evaluate(const PairDefinition<Dim>& pair, Points<Dim> x, const PairState<Dim>& committed,
              bool with_tangent, PairEvaluation<Dim>& out, const ActiveSet<Dim>& active_set,
              const PairMultipliers<Dim>* multipliers, const BlockTaker<Dim>& take,
              const Workers& workers) {
  Laps laps;
  out.stiffening = multipliers ? multipliers->stiffening : 1;
  if (is_tied(pair) || by_mortar(pair)) {
    if (is_tied(pair))
      evaluate_ties(pair, x, active_set.relief, with_tangent, out);
    else
      evaluate_mortar(pair, x, committed, with_tangent, out, active_set, multipliers);
    laps.add_to(out.seconds.evaluation);
    if (take) take(out.blocks);
    return;
  }
  refresh(pair, x, with_tangent, out);
  out.near = active_set.near;
  laps.add_to(out.seconds.search);
  const auto place_of = [&](std::size_t i) {
    const PointContext<Dim> context = context_of(pair, active_set, multipliers, i);
    return place_of_point(pair, out, x, i, committed.points[i],
                          kept_facet<Dim>(pair.master, context.active, x));
  };
  std::vector<Projection<Dim>> places;
  const bool by_all = workers.ranks && !out.apart;  // else no point has a place
  if (by_all) {
    places = places_by_all<Dim>(all_points(pair), workers, place_of);
    laps.add_to(out.seconds.projection);
  }
  PointLoop<Dim> loop(pair, out, take, workers.crew);
  loop.run([&](std::size_t i, Laps& of_point, PairSeconds& seconds) {
    PointContext<Dim> context = context_of(pair, active_set, multipliers, i);
    if (!committed.overlap.empty()) context.relieved = active_set.relief * committed.overlap[i];
    const Projection<Dim> place = by_all ? places[i] : place_of(i);
    const bool seen = is_seen(pair, i, place, workers);
    // Forces have the same bits with a tangent and without, but not by other derivatives.
    ProjectedPoint<Dim> projected =
        point_at(pair, out, x, i, place, derivatives_needed(pair, with_tangent));
    evaluate_slave_point(pair, x, committed.points[i], active_set, projected, context,
                         with_tangent && seen, i, out, of_point, seconds);
    if (!seen) out.blocks[i].elsewhere = true;
  });
  if constexpr (Dim == 3)
    if (edges_of(pair)) {
      Laps of_edges;
      evaluate_edge_contacts(pair, x, committed, with_tangent, out, active_set);
      of_edges.add_to(out.seconds.evaluation);
    }
  loop.hand_over_others();
}

template <int Dim>
void look_far(const PairDefinition<Dim>& pair, Points<Dim> x, const PairState<Dim>& committed,
              PairEvaluation<Dim>& out, const Workers& workers) {
  if (!out.near || !pair.filter.limited()) return;
  Laps laps;
  out.near = false;
  std::vector<std::size_t> far;
  for (std::size_t i = 0; i < pair.slave.points.size(); ++i)
    if (out.points[i].history.facet < 0 && out.points[i].status == contact::Status::open)
      far.push_back(i);
  const auto place_of = [&](std::size_t i) {
    return place_of_point(pair, out, x, i, committed.points[i]);
  };
  std::vector<Projection<Dim>> places;
  if (workers.ranks) places = places_by_all<Dim>(far, workers, place_of);
  for (std::size_t k = 0; k < far.size(); ++k) {
    const std::size_t i = far[k];
    const ProjectedPoint<Dim> projected =
        point_at(pair, out, x, i, workers.ranks ? places[k] : place_of(i));
    if (projected.projection.feature == Feature::none) continue;
    const double acts_below = pair.offset + contact::onset_gap(pair.normal);
    if (projected.projection.beyond_end || projected.kinematics.gap > acts_below)
      report_far(pair, committed.points[i], projected, out.points[i]);
  }
  laps.add_to(out.seconds.projection);
}

template <int Dim>
ActiveSet<Dim> committed_active_set(const PairDefinition<Dim>& pair,
                                    const PairState<Dim>& committed, Points<Dim> x,
                                    Prediction friction) {
  ActiveSet<Dim> active_set;
  active_set.predict = true;
  for (std::size_t i = 0; i < committed.points.size(); ++i) {
    const PointHistory<Dim>& h = committed.points[i];
    ActiveBranch<Dim> branch;
    if (h.active) branch.branch = Branch::stick;
    const double size = h.traction.norm();
    if (h.active && size == 0 && friction == Prediction::sliding)
      branch = {Branch::slip, Vec<Dim>::Zero()};
    if (h.active && h.slipping && size > 0 && friction != Prediction::sticking)
      branch = {Branch::slip, frame_of_history(pair, i, h, x) * (h.traction / size)};
    if (h.edge >= 0) branch.edges = {h.edge, h.facet};
    if constexpr (Dim == 2)
      if (h.active && rests_in_reentrant_vertex(pair, h, x)) {
        branch = {Branch::reentrant, Vec2::Zero()};
        branch.facet = h.facet;
      }
    if constexpr (Dim == 3)
      if (h.active && rests_in_reentrant_edge(pair, h))
        branch = predicted_in_edge(pair, h, x, friction);
    active_set.branch.push_back(branch);
  }
  return active_set;
}

template <int Dim>
ActiveSet<Dim> evaluated_active_set(const PairEvaluation<Dim>& evaluation,
                                    const ActiveSet<Dim>& before) {
  ActiveSet<Dim> active_set;
  for (std::size_t i = 0; i < evaluation.points.size(); ++i) {
    const PointResult<Dim>& point = evaluation.points[i];
    ActiveBranch<Dim>& branch = active_set.branch.emplace_back(point.branch);
    const bool touches = point.status != contact::Status::open;
    branch.facet = (touches || branch.closed) && branch.edges[0] < 0 ? point.history.facet : -1;
    branch.closed =
        branch.closed || (touches && branch.facet >= 0 && point.history.feature == Feature::face);
    branch.xi = point.history.xi;
    if (before.predict || i >= before.branch.size()) continue;
    const ActiveBranch<Dim>& last = before.branch[i];
    const bool along_edge = Dim == 3 && branch.branch == Branch::reentrant;  // no border of a side
    const bool changed =
        !along_edge && branch.facet >= 0 && last.facet >= 0 && branch.facet != last.facet;
    branch.changes = last.changes + (changed ? 1 : 0);
    if (branch.facet < 0) branch.facet = last.facet;
  }
  return active_set;
}

namespace {

/// Whether a point lies over or behind a place of the master, not beyond its border.
template <int Dim>
bool has_place(const ProjectedPoint<Dim>& projected) {
  return projected.projection.feature != Feature::none && !projected.projection.beyond_end &&
         contact::inside_domain(projected.kinematics);
}

/// The part of the gap at the start that does not count; with a clearance that decides also whether
/// the point is in contact.
template <int Dim>
double relieve(const PairDefinition<Dim>& pair, bool placed, PointHistory<Dim>& history) {
  const double gap = history.gap - pair.offset;
  if (pair.overlap != InitialOverlap::given) return history.active ? std::min(0.0, gap) : 0.0;
  if (!placed) return 0;
  PointContext<Dim> context;
  context.relieved = gap - pair.clearance;
  history.active = is_closed(pair, history, history.gap, context);
  return context.relieved;
}

}  // namespace

template <int Dim>
PairState<Dim> initial_state(const PairDefinition<Dim>& pair, Points<Dim> x) {
  PairEvaluation<Dim> work;
  if (is_tied(pair)) {
    evaluate(pair, x, {}, false, work);
    return commit(work);
  }
  if (by_mortar(pair)) return initial_mortar_state(pair, x);
  refresh(pair, x, false, work);
  PairState<Dim> state;
  state.points.resize(pair.slave.points.size());
  std::vector<bool> placed(state.points.size());
  for (std::size_t i = 0; i < state.points.size(); ++i) {
    const ProjectedPoint<Dim> projected = project_point<Dim>(pair, work, x, i, {});
    if (projected.projection.feature == Feature::none) continue;
    PointHistory<Dim>& h = state.points[i];
    h = history_at<Dim>(projected);
    if (projected.projection.beyond_end) h.gap = std::abs(h.gap);
    placed[i] = has_place<Dim>(projected);
    if (!placed[i]) continue;
    hold(pair, h);
    h.active = is_closed(pair, h, h.gap);
  }
  if (pair.overlap != InitialOverlap::acts)
    for (std::size_t i = 0; i < state.points.size(); ++i)
      state.overlap.push_back(relieve<Dim>(pair, placed[i], state.points[i]));
  if constexpr (Dim == 3) {
    if (!edges_of(pair)) return state;
    // By a whole evaluation: it tells which edge-edge contacts are the nodes' own contacts.
    evaluate<3>(pair, x, state, false, work);
    for (std::size_t i = state.points.size(); i < work.points.size(); ++i) {
      PointHistory<3>& h = state.points.emplace_back(work.points[i].history);
      h.deepest = std::numeric_limits<double>::infinity();
      h.damping_work = 0;
    }
  }
  return state;
}

template <int Dim>
std::vector<bool> placed_points(const PairDefinition<Dim>& pair, Points<Dim> x) {
  PairEvaluation<Dim> work;
  refresh(pair, x, false, work);
  std::vector<bool> placed(pair.slave.points.size());
  for (std::size_t i = 0; i < placed.size(); ++i)
    placed[i] = has_place<Dim>(project_point<Dim>(pair, work, x, i, {}));
  return placed;
}
template std::vector<bool> placed_points<2>(const PairDefinition<2>&, Points<2>);
template std::vector<bool> placed_points<3>(const PairDefinition<3>&, Points<3>);

template <int Dim>
PairMultipliers<Dim> initial_multipliers(const PairDefinition<Dim>& pair,
                                         const PairState<Dim>& state) {
  PairMultipliers<Dim> out;
  if (!is<ByPenalty>(pair.enforcement)) out.points.resize(state.points.size());
  return out;
}

template <int Dim>
PairMultipliers<Dim> augmented(const PairDefinition<Dim>& pair,
                               const PairEvaluation<Dim>& evaluation,
                               const PairMultipliers<Dim>& used) {
  constexpr double fast_enough = 0.25, more = 10;
  PairMultipliers<Dim> next = used;
  next.violation = 0;
  for (std::size_t i = 0; i < next.points.size(); ++i) {
    const PointResult<Dim>& point = evaluation.points[i];
    const contact::Multiplier<Dim>& old = used.points[i];
    next.points[i] = {point.normal_traction, point.shear()};
    const PointPenalty penalty = point_penalty(pair, i);
    const double normal = used.stiffening * penalty.normal;
    const double shear = pair.friction ? used.stiffening * penalty.shear : 1.0;
    next.violation =
        std::max({next.violation, std::abs(point.normal_traction - old.normal) / normal,
                  (next.points[i].shear - old.shear).norm() / shear});
  }
  if (next.violation > fast_enough * used.violation) next.stiffening *= more;
  return next;
}

template <int Dim>
PairMultipliers<Dim> commit(const PairEvaluation<Dim>& evaluation, PairMultipliers<Dim> used) {
  used = taken_over(evaluation, std::move(used));
  used.violation = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < used.points.size(); ++i) {
    const PointResult<Dim>& point = evaluation.points[i];
    if (point.branch.branch == Branch::reentrant)
      continue;  // the multiplier is all of the traction
    if (point.status == contact::Status::open) used.points[i].normal = 0;
    used.points[i].shear = point.shear();
  }
  return used;
}

template <int Dim>
PairMultipliers<Dim> taken_over(const PairEvaluation<Dim>& evaluation, PairMultipliers<Dim> used) {
  if (evaluation.taken_multipliers.size() == used.points.size())
    used.points = evaluation.taken_multipliers;
  return used;
}

template <int Dim>
PairState<Dim> commit(const PairEvaluation<Dim>& evaluation) {
  PairState<Dim> state;
  state.points.reserve(evaluation.points.size());
  for (const PointResult<Dim>& point : evaluation.points) state.points.push_back(point.history);
  state.places = evaluation.mortar.places;
  return state;
}

template void prepare<2>(PairDefinition<2>&, Points<2>);
template void prepare<3>(PairDefinition<3>&, Points<3>);
template PairState<2> initial_state<2>(const PairDefinition<2>&, Points<2>);
template PairState<3> initial_state<3>(const PairDefinition<3>&, Points<3>);
template void look_far<2>(const PairDefinition<2>&, Points<2>, const PairState<2>&,
                          PairEvaluation<2>&, const Workers&);
template void look_far<3>(const PairDefinition<3>&, Points<3>, const PairState<3>&,
                          PairEvaluation<3>&, const Workers&);
template ActiveSet<2> committed_active_set<2>(const PairDefinition<2>&, const PairState<2>&,
                                              Points<2>, Prediction);
template ActiveSet<3> committed_active_set<3>(const PairDefinition<3>&, const PairState<3>&,
                                              Points<3>, Prediction);
template ActiveSet<2> evaluated_active_set<2>(const PairEvaluation<2>&, const ActiveSet<2>&);
template ActiveSet<3> evaluated_active_set<3>(const PairEvaluation<3>&, const ActiveSet<3>&);
template void evaluate<2>(const PairDefinition<2>&, Points<2>, const PairState<2>&, bool,
                          PairEvaluation<2>&, const ActiveSet<2>&, const PairMultipliers<2>*,
                          const BlockTaker<2>&, const Workers&);
template void evaluate<3>(const PairDefinition<3>&, Points<3>, const PairState<3>&, bool,
                          PairEvaluation<3>&, const ActiveSet<3>&, const PairMultipliers<3>*,
                          const BlockTaker<3>&, const Workers&);
template PairMultipliers<2> initial_multipliers<2>(const PairDefinition<2>&, const PairState<2>&);
template PairMultipliers<2> augmented<2>(const PairDefinition<2>&, const PairEvaluation<2>&,
                                         const PairMultipliers<2>&);
template PairMultipliers<2> commit<2>(const PairEvaluation<2>&, PairMultipliers<2>);
template PairState<2> commit<2>(const PairEvaluation<2>&);
template PairMultipliers<2> taken_over<2>(const PairEvaluation<2>&, PairMultipliers<2>);
template PairMultipliers<3> taken_over<3>(const PairEvaluation<3>&, PairMultipliers<3>);
template PairMultipliers<3> initial_multipliers<3>(const PairDefinition<3>&, const PairState<3>&);
template PairMultipliers<3> augmented<3>(const PairDefinition<3>&, const PairEvaluation<3>&,
                                         const PairMultipliers<3>&);
template PairMultipliers<3> commit<3>(const PairEvaluation<3>&, PairMultipliers<3>);
template PairState<3> commit<3>(const PairEvaluation<3>&);

}  // namespace osculate::pairing
