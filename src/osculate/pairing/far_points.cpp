#include "osculate/pairing/far_points.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "osculate/pairing/pair_points.hpp"
#include "osculate/pairing/report.hpp"

namespace osculate::pairing {
namespace {

constexpr double no_height = std::numeric_limits<double>::quiet_NaN();

/// Heights over shapes without a border, negative inside the body; NaN of all others.
double height_over(const geometry::Curve& curve, const Vec2& point) {
  if (const auto* const line = std::get_if<geometry::InfiniteLine>(&curve))
    return (point - line->point).dot(line->unit_normal());
  const auto* const circle = std::get_if<geometry::Circle>(&curve);
  if (!circle) return no_height;
  const double out = (point - circle->center).norm() - circle->radius;
  return circle->inside ? -out : out;
}
double height_over(const geometry::Surface& surface, const Vec3& point) {
  if (const auto* const plane = std::get_if<geometry::Plane>(&surface))
    return (point - plane->point).dot(plane->normal.normalized());
  const auto* const sphere = std::get_if<geometry::Sphere>(&surface);
  if (!sphere) return no_height;
  const double out = (point - sphere->center).norm() - sphere->radius;
  return sphere->inside ? -out : out;
}

template <int Dim>
bool is_one_shape(const Boundary<Dim>& master) {
  return master.facets.size() == 1 && master.facets.front().shape &&
         !std::isnan(height_over(*master.facets.front().shape, Vec<Dim>::Ones()));
}
/// Facets that lie between their nodes.
bool is_flat(const Facet& facet) { return facet.straight(); }
bool is_flat(const SurfaceFacet& facet) { return !facet.shape && !facet.patch && facet.count <= 4; }

/// Whether points may be left out at all.
template <int Dim>
bool may_wait(const PairDefinition<Dim>& pair) {
  if (held_from_start(pair) || by_mortar(pair) || edges_of(pair) ||
      !is<ByPenalty>(pair.enforcement))
    return false;
  if (is_one_shape<Dim>(pair.master)) return !pair.filter.own;
  return pair.filter.limited() && !pair.filter.own &&
         std::ranges::all_of(pair.master.facets, [](const auto& f) { return is_flat(f); });
}

template <int Dim>
Vec<Dim> in_frame(const Boundary<Dim>& master, Points<Dim> x, const Vec<Dim>& point) {
  const auto& facet = master.facets.front();
  const auto node = [&](std::size_t k) -> const Vec<Dim>& {
    return x[static_cast<std::size_t>(facet.nodes[k])];
  };
  const Vec<Dim> arm = point - node(0);
  Vec<Dim> local;
  for (std::size_t k = 0; k < static_cast<std::size_t>(Dim); ++k)
    local[static_cast<Eigen::Index>(k)] = arm.dot(node(k + 1) - node(0));
  return local;
}

/// No traction and nothing that a later one would depend on.
template <int Dim>
bool is_idle(const PointResult<Dim>& result) {
  return result.status == contact::Status::open && !result.outside_domain && result.stored == 0 &&
         std::isinf(result.history.deepest) && !result.history.held;
}

}  // namespace

template <int Dim>
void FarPoints<Dim>::begin(const PairDefinition<Dim>& pair, Points<Dim> x, bool relieved) {
  begun_ = true;
  may_leave_ = !relieved && may_wait(pair);
  of_shape_ = may_leave_ && is_one_shape<Dim>(pair.master);
  points_.assign(pair.slave.points.size(), {});
  for (std::size_t i = 0; i < points_.size(); ++i) points_[i].before = place(pair, x, i);
  master_way_ = 0;
  kept_.clear();
  const auto keep = [&](const auto& nodes, int count) {
    kept_.insert(kept_.end(), nodes.begin(), nodes.begin() + count);
  };
  for (const auto& facet : pair.master.facets) keep(facet.nodes, facet.count);
  if (of_shape_) {
    for (const auto& facet : pair.slave.boundary.facets) keep(facet.nodes, facet.count);
    for (const SlavePoint<Dim>& point : pair.slave.points) keep(point.nodes, point.count);
  }
  std::sort(kept_.begin(), kept_.end());
  kept_.erase(std::unique(kept_.begin(), kept_.end()), kept_.end());
  if (may_leave_) past_.assign(x.begin(), x.end());
}

/// Where the point is; in the frame of a shape, where that rests.
template <int Dim>
Vec<Dim> FarPoints<Dim>::place(const PairDefinition<Dim>& pair, Points<Dim> x,
                               std::size_t i) const {
  const Vec<Dim> here = position<Dim>(pair.slave.points[i], x);
  return of_shape_ ? in_frame<Dim>(pair.master, x, here) : here;
}

/// Of a shape none: its points are seen in its frame.
template <int Dim>
double FarPoints<Dim>::way_of_master(Points<Dim> x) const {
  if (of_shape_) return 0;
  double most = 0;
  for (const Index n : kept_) {
    const auto node = static_cast<std::size_t>(n);
    most = std::max(most, (x[node] - past_[node]).squaredNorm());
  }
  return std::sqrt(Dim * most);
}

template <int Dim>
void FarPoints<Dim>::choose(const PairDefinition<Dim>& pair, Points<Dim> x, bool all,
                            core::Crew* crew) {
  looked_at_.clear();
  back_.clear();
  if (!may_leave_) return;
  const double of_master = way_of_master(x);
  master_way_ += of_master;
  choice_.assign(points_.size(), Choice::looked_at);
  const auto choose_some = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      Point& point = points_[i];
      const Vec<Dim> here = place(pair, x, i);
      point.step = (here - point.before).norm() + of_master;
      point.before = here;
      if (point.room < 0) continue;
      const double moved = (here - point.at).norm() + (master_way_ - point.master_way);
      const bool open = moved + point.step < point.room;
      if (open && !all && moved < early * point.room) {
        choice_[i] = Choice::left_out;
        continue;
      }
      point.room = -1;
      if (!open && !pair.filter.limited()) choice_[i] = Choice::first_where_it_was;
    }
  };
  constexpr std::size_t worth_it = 32;
  if (crew)
    crew->share_runs(points_.size(), worth_it, choose_some);
  else
    choose_some(0, points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (choice_[i] == Choice::left_out) continue;
    looked_at_.push_back(i);
    if (choice_[i] == Choice::first_where_it_was) back_.push_back(i);
  }
  looks_ += looked_at_.size();
  looks_back_ += back_.size();
}

/// How far the point may go until it may be in contact; negative if that is not known.
template <int Dim>
double FarPoints<Dim>::room_of(const PairDefinition<Dim>& pair, const PairEvaluation<Dim>& work,
                               std::size_t i) const {
  constexpr double rounding = 1e-12;
  const bool limited = pair.filter.limited();
  if (limited && work.points[i].history.facet >= 0) return -1;
  const Vec<Dim>& here = points_[i].before;
  double distance = 0, reach = pair.filter.distance;
  if (of_shape_) {
    const double height = height_over(*pair.master.facets.front().shape, here);
    distance = limited ? std::abs(height) : height;
  } else {
    const auto of_box = [&](Index f) {
      return work.boxes[static_cast<std::size_t>(f)].squared_distance(here);
    };
    distance = std::sqrt(work.tree.nearest(here, of_box).squared_distance);
  }
  if (!limited) reach = std::max(0.0, pair.offset + contact::onset_gap(pair.normal));
  return distance - reach - rounding * (here.norm() + distance + reach);
}

template <int Dim>
void FarPoints<Dim>::leave(const PairDefinition<Dim>& pair, const PairEvaluation<Dim>& work,
                           std::size_t i, contact::PointHistory<Dim>& history) {
  constexpr double worth = 8;  // ways of an evaluation
  if (!is_idle(work.points[i])) return;
  Point& point = points_[i];
  const double room = room_of(pair, work, i);
  if (!(room > worth * point.step)) return;
  point.room = room;
  point.at = point.before;
  point.master_way = master_way_;
  history.facet = -1;
  history.feature = projection::Feature::none;
  history.xi.setZero();
  history.gap = 0;
}

template <int Dim>
void evaluate(const PairDefinition<Dim>& pair, Points<Dim> x, const PairState<Dim>& committed,
              PairEvaluation<Dim>& out, const ActiveSet<Dim>& active_set, FarPoints<Dim>& far,
              bool all, core::Crew* crew) {
  if (!far.begun_) far.begin(pair, x, !committed.overlap.empty());
  far.choose(pair, x, all, crew);
  if (!far.may_leave_) {
    evaluate<Dim>(pair, x, committed, false, out, active_set, nullptr, {}, Workers{crew});
    return;
  }
  Laps laps;
  out.stiffening = 1;
  out.near = false;
  far.recalled_.clear();
  if (!far.back_.empty()) {
    refresh<Dim>(pair, far.past_, false, out, &far.back_);
    for (const std::size_t i : far.back_) {
      PointResult<Dim> result = open_result(committed.points[i], 0.0);
      report_far(pair, committed.points[i],
                 project_point<Dim>(pair, out, far.past_, i, committed.points[i], -1, 0), result);
      far.recalled_.push_back(result.history);
    }
  }
  if (!far.looked_at_.empty()) refresh(pair, x, false, out, &far.looked_at_);
  laps.add_to(out.seconds.search);
  const auto look_at = [&](std::size_t k, Laps& of_point, PairSeconds& seconds) {
    const std::size_t i = far.looked_at_[k];
    const auto back = std::ranges::lower_bound(far.back_, i);
    const bool recalled = back != far.back_.end() && *back == i;
    const contact::PointHistory<Dim>& history =
        recalled ? far.recalled_[static_cast<std::size_t>(back - far.back_.begin())]
                 : committed.points[i];
    PointContext<Dim> context = context_of<Dim>(pair, active_set, nullptr, i);
    ProjectedPoint<Dim> projected =
        project_point(pair, out, x, i, history, kept_facet<Dim>(pair.master, context.active, x),
                      derivatives_needed(pair, false));
    evaluate_slave_point(pair, x, history, active_set, projected, context, false, i, out, of_point,
                         seconds);
    if (!all) far.leave(pair, out, i, out.points[i].history);
  };
  const auto together = [&](std::size_t k) {
    return on_same_nodes(pair.slave.points[far.looked_at_[k - 1]],
                         pair.slave.points[far.looked_at_[k]]);
  };
  // Blocks of a smooth master's facets are the sum of points.
  share_points(out.master_blocks == 0 ? crew : nullptr, 0, far.looked_at_.size(), together,
               out.seconds, look_at);
  for (const Index n : far.kept_)
    far.past_[static_cast<std::size_t>(n)] = x[static_cast<std::size_t>(n)];
}

template class FarPoints<2>;
template class FarPoints<3>;
template void evaluate<2>(const PairDefinition<2>&, Points<2>, const PairState<2>&,
                          PairEvaluation<2>&, const ActiveSet<2>&, FarPoints<2>&, bool,
                          core::Crew*);
template void evaluate<3>(const PairDefinition<3>&, Points<3>, const PairState<3>&,
                          PairEvaluation<3>&, const ActiveSet<3>&, FarPoints<3>&, bool,
                          core::Crew*);

}  // namespace osculate::pairing
