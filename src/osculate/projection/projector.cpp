#include "osculate/projection/projector.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "osculate/core/error.hpp"
#include "osculate/projection/on_cell.hpp"
#include "osculate/projection/piece_trees.hpp"
#include "osculate/projection/shape_answer.hpp"
#include "osculate/projection/triangle.hpp"

namespace osculate::projection {

std::string_view name(Status status) {
  switch (status) {
    case Status::projected:
      return "projected";
    case Status::ambiguous:
      return "ambiguous";
    case Status::outside_domain:
      return "outside_domain";
    case Status::invalid:
      break;
  }
  return "invalid";
}

std::string_view name(Feature feature) {
  switch (feature) {
    case Feature::face:
      return "face";
    case Feature::edge:
      return "edge";
    case Feature::corner:
      return "corner";
    case Feature::none:
      break;
  }
  return "none";
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A minimum and the piece it was found on.
template <int Dim>
struct Found {
  Index piece = -1;
  PieceMinimum<Dim> minimum;
};

}  // namespace

template <int Dim>
struct Projector<Dim>::Impl {
  Target<Dim> target;
  double size = 0;
  bool analytic = false;
  CellComplex<Dim> all;
  PieceTrees<Dim> trees;

  [[nodiscard]] const Piece<Dim>& piece(Index k) const {
    return all.set.pieces[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] Control<Dim> control(const Piece<Dim>& p) const {
    return control_of(p, all.set.control);
  }
};

namespace {

template <int Dim>
double size_of(const Shape<Dim>& shape) {
  return std::visit(
      [](const auto& s) {
        using S = std::decay_t<decltype(s)>;
        if constexpr (requires { s.tube_radius; })
          return 2 * (s.radius + s.tube_radius);
        else if constexpr (requires {
                             s.radius;
                             s.length;
                           })
          return std::isfinite(s.length) ? std::hypot(2 * s.radius, s.length) : 2 * s.radius;
        else if constexpr (requires { s.radius; })
          return 2 * s.radius;
        else if constexpr (std::is_same_v<S, geometry::Cone>)
          return std::isfinite(s.to) ? 2 * s.to * std::tan(s.half_angle) : 1.0;
        else
          return 1.0;  // without any length of its own
      },
      shape);
}

// -- one query ----------------------------------------------------------------------------------

/// Keeps the nearest place; of places that are equally near to rounding (a point far away cannot
/// tell them) the one that is pulled beyond fewer sides.
template <int Dim>
struct NearestSink {
  Vec<Dim> point;
  Index piece = -1;
  Found<Dim> best{};
  double reach = infinity;  ///< squared

  [[nodiscard]] double reach2() const { return reach; }
  /// From now on other places must be nearer by `lead`.
  void prefer(double lead) {
    if (best.piece < 0) return;
    const double near = std::max(std::sqrt(best.minimum.squared_distance) - lead, 0.0);
    reach = near * near;
  }
  void offer(PieceMinimum<Dim> m) {
    if (m.squared_distance > reach) return;
    constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
    if (m.flat) m.squared_distance = (point - m.point).squaredNorm();
    const double taken = best.minimum.squared_distance;
    if (!(m.squared_distance <= taken * (1 + rounding))) return;
    const bool tied = m.squared_distance >= taken * (1 - rounding);
    const int sides = std::popcount(m.pressed), taken_sides = std::popcount(best.minimum.pressed);
    if (tied && (sides > taken_sides || (sides == taken_sides && m.squared_distance >= taken)))
      return;
    best = {piece, m};
    reach = std::nextafter(m.squared_distance * (1 + rounding), infinity);
  }
};

/// Keeps the second-best minimum at another place, if it is one of the composed surface.
template <int Dim, class Valid>
struct SecondSink {
  const Valid& valid;
  Vec<Dim> taken;  ///< the best place
  double taken_distance = 0;
  double apart = 0;  ///< nearer places are the same
  double size = 1;   ///< of the target
  double tolerance = 0;
  Index piece = -1;
  double second = infinity;  ///< distance
  Vec<Dim> place = Vec<Dim>::Constant(std::numeric_limits<double>::quiet_NaN());
  double reach = infinity;  ///< squared

  [[nodiscard]] double reach2() const { return reach; }
  [[nodiscard]] bool same(const PieceMinimum<Dim>& m, double distance) const {
    const double off = (m.point - taken).norm();
    const double near = m.flat ? std::max(apart, 1e-5 * size) : apart;
    return off <= 1e-8 * size || (off <= near && distance <= taken_distance + 1e-11 * size);
  }
  void offer(const PieceMinimum<Dim>& m) {
    const double distance = std::sqrt(std::max(m.squared_distance, 0.0));
    if (!(distance < second) || same(m, distance)) return;
    if ((!m.flat || m.pressed != 0) && !valid(piece, m)) return;
    second = distance;
    place = m.point;
    const double near = std::max(distance - tolerance, 0.0);
    reach = near * near;
  }
};

template <int Dim, class Impl, class Sink>
void search_piece(const Impl& impl, Index k, const Vec<Dim>& point, double tolerance, Sink& sink) {
  sink.piece = k;
  const Piece<Dim>& piece = impl.piece(k);
  const Control<Dim> control = impl.control(piece);
  if constexpr (Dim == 3) {
    if (piece.triangle) {
      const TriangleFoot foot =
          closest_on_triangle(control[0].template head<3>(), control[1].template head<3>(),
                              control[2].template head<3>(), point);
      if (foot.squared_distance < sink.reach2())
        sink.offer({foot.xi, foot.squared_distance, foot.point, foot.pressed});
      return;
    }
  }
  find_minima<Dim>(piece, control, point, tolerance, sink);
}

/// Newton's method from the middle of the piece, if that is nearly flat.
template <int Dim, class Impl, class Sink>
void descend_piece(const Impl& impl, Index k, const Vec<Dim>& point, double tolerance, Sink& sink) {
  const Piece<Dim>& piece = impl.piece(k);
  if (piece.triangle || piece.bent) return search_piece<Dim>(impl, k, point, tolerance, sink);
  sink.piece = k;
  const Control<Dim> control = impl.control(piece);
  const detail::Range range = detail::whole_range(piece);
  const Vec2 middle = 0.5 * (range.lo + range.hi);
  const detail::Place<Dim> place = detail::descend<Dim>(
      piece, control, point, range, detail::look<Dim>(piece, control, point, middle));
  PieceMinimum<Dim> m;
  m.st = place.st;
  m.squared_distance = place.squared;
  m.point = place.r;
  m.pressed = detail::pressed_sides(piece, place);
  sink.offer(m);
}

/// The bottom of a valley that the bounds could not narrow down.
template <int Dim, class Impl>
void polish(const Impl& impl, const Vec<Dim>& point, Found<Dim>& found) {
  const Piece<Dim>& piece = impl.piece(found.piece);
  const Control<Dim> control = impl.control(piece);
  const detail::Place<Dim> place =
      detail::descend<Dim>(piece, control, point, detail::whole_range(piece),
                           detail::look<Dim>(piece, control, point, found.minimum.st));
  found.minimum.st = place.st;
  found.minimum.squared_distance = place.squared;
  found.minimum.point = place.r;
  found.minimum.pressed = detail::pressed_sides(piece, place);
}

template <int Dim>
ClosestPoint<Dim> answer_of(const CellComplex<Dim>& all, const OnCell& found, const Vec<Dim>& point,
                            const Vec<Dim>& foot, double& bend) {
  ClosestPoint<Dim> out;
  const Vec<Dim> gap = point - foot;
  const OnCell on = first_owner(all, found);
  out.feature = on.corner >= 0 ? Feature::corner : on.edge >= 0 ? Feature::edge : Feature::face;
  out.facet = all.cell(on.cell).facet;
  out.xi[0] = on.xi[0];
  if (Dim == 3) out.xi[1] = on.xi[1];
  out.point = foot;
  const double length = gap.norm();
  out.distance = gap.dot(shared_normal(all, on)) < 0 ? -length : length;
  bend = bend_at(all, on, gap);
  out.status = bend <= least_bend_allowed ? Status::outside_domain : Status::projected;
  return out;
}

}  // namespace

template <int Dim>
Projector<Dim>::Projector(Target<Dim> target) : impl_(std::make_unique<Impl>()) {
  Impl& impl = *impl_;
  impl.target = std::move(target);
  if (const auto* shape = std::get_if<Shape<Dim>>(&impl.target)) {
    const std::string wrong = geometry::validate(*shape);
    if (!wrong.empty()) throw core::InputError({}, wrong);
    std::optional<CellComplex<Dim>> all = complex_of(*shape);
    impl.analytic = !all.has_value();
    if (all) impl.all = std::move(*all);
    if (!all) impl.size = size_of<Dim>(*shape);
  } else {
    impl.all = make_complex(std::get<FacetMesh<Dim>>(impl.target));
  }
  if (impl.analytic) return;
  sort_by_place(impl.all.set);
  impl.trees = plant(impl.all);
  const search::Box<Dim>& whole = impl.trees.inner.tree.node_box(0);
  impl.size = (whole.hi - whole.lo).norm();
}
template <int Dim>
Projector<Dim>::~Projector() = default;
template <int Dim>
Projector<Dim>::Projector(Projector&&) noexcept = default;
template <int Dim>
Projector<Dim>& Projector<Dim>::operator=(Projector&&) noexcept = default;

template <int Dim>
const Target<Dim>& Projector<Dim>::target() const {
  return impl_->target;
}
template <int Dim>
const CellComplex<Dim>* Projector<Dim>::cells() const {
  return impl_->analytic ? nullptr : &impl_->all;
}
template <int Dim>
double Projector<Dim>::size() const {
  return impl_->size;
}

namespace {

/// Distances are told apart down to this; it follows the rounding of far points.
template <int Dim, class Impl>
double tolerance_at(const Impl& impl, const Vec<Dim>& point) {
  const double far = (point - impl.trees.inner.tree.node_box(0).lo).norm();
  return 1e-13 * (impl.size + (far > impl.size ? far - impl.size : 0));
}

template <int Dim, class Impl>
void look_at_piece(const Impl& impl, Index k, const Vec<Dim>& point, Mode mode, double tolerance,
                   NearestSink<Dim>& nearest) {
  if (mode == Mode::fast)
    descend_piece<Dim>(impl, k, point, tolerance, nearest);
  else
    search_piece<Dim>(impl, k, point, tolerance, nearest);
}

/// Names the nearest place; in certified mode looks for the second-best minimum.
template <int Dim, class Impl>
ClosestPoint<Dim> conclude(const Impl& impl, const Vec<Dim>& point, Mode mode, double tolerance,
                           Found<Dim> best) {
  if (best.piece < 0) return {};
  if (best.minimum.flat) polish<Dim>(impl, point, best);
  double bend = 1;
  ClosestPoint<Dim> out =
      answer_of<Dim>(impl.all, locate(impl.all, impl.piece(best.piece), best.minimum), point,
                     best.minimum.point, bend);
  if (mode != Mode::certified) return out;
  const auto valid = [&](Index k, const PieceMinimum<Dim>& m) {
    return minimum_of_all<Dim>(impl.all, locate(impl.all, impl.piece(k), m), point, m.point);
  };
  // Near a centre of curvature a minimum is so flat that its place is known to 1e-3 only.
  const double apart = (bend < 1e-4 ? 1e-3 : 1e-8) * impl.size;
  SecondSink<Dim, decltype(valid)> sink{valid, best.minimum.point, std::abs(out.distance),
                                        apart, impl.size,          tolerance};
  for_each_possible(impl.trees, point, sink.reach,
                    [&](Index k) { search_piece<Dim>(impl, k, point, tolerance, sink); });
  out.second = sink.place;
  out.margin = std::max(sink.second - std::abs(out.distance), 0.0);
  out.unique = out.margin > least_margin * impl.size;
  if (!out.unique && out.status == Status::projected) out.status = Status::ambiguous;
  if (best.minimum.open) out.status = Status::ambiguous;
  return out;
}

/// Squared distances of points farther than that are beyond the range of doubles.
template <int Dim>
bool can_be_asked(const Vec<Dim>& point) {
  return point.allFinite() && point.cwiseAbs().maxCoeff() <= farthest_coordinate;
}

}  // namespace

template <int Dim>
ClosestPoint<Dim> Projector<Dim>::closest(const Vec<Dim>& point, Mode mode) const {
  const Impl& impl = *impl_;
  if (!can_be_asked<Dim>(point)) return {};
  if (impl.analytic) return *shape_answer(std::get<Shape<Dim>>(impl.target), point);
  const double tolerance = tolerance_at<Dim>(impl, point);
  NearestSink<Dim> nearest{point};
  for_each_possible(impl.trees, point, nearest.reach,
                    [&](Index k) { look_at_piece<Dim>(impl, k, point, mode, tolerance, nearest); });
  return conclude<Dim>(impl, point, mode, tolerance, nearest.best);
}

template <int Dim>
ClosestPoint<Dim> Projector<Dim>::nearest_within(const Vec<Dim>& point,
                                                 double squared_bound) const {
  const Impl& impl = *impl_;
  if (!can_be_asked<Dim>(point)) return {};
  if (impl.analytic) {
    const ClosestPoint<Dim> c = *shape_answer(std::get<Shape<Dim>>(impl.target), point);
    return c.distance * c.distance <= squared_bound ? c : ClosestPoint<Dim>{};
  }
  const double tolerance = tolerance_at<Dim>(impl, point);
  NearestSink<Dim> nearest{point};
  nearest.reach = squared_bound;
  for_each_possible(impl.trees, point, nearest.reach, [&](Index k) {
    look_at_piece<Dim>(impl, k, point, Mode::nearest, tolerance, nearest);
  });
  return conclude<Dim>(impl, point, Mode::nearest, tolerance, nearest.best);
}

template <int Dim>
ClosestPoint<Dim> Projector<Dim>::follow(const Vec<Dim>& point, const ClosestPoint<Dim>& last,
                                         Mode mode) const {
  const Impl& impl = *impl_;
  if (!can_be_asked<Dim>(point) || impl.analytic || !last.point.allFinite())
    return closest(point, mode);
  const double tolerance = tolerance_at<Dim>(impl, point);
  NearestSink<Dim> nearest{point};
  impl.trees.inner.tree.for_each_within(last.point, 1e-9 * impl.size, [&](Index k) {
    look_at_piece<Dim>(impl, k, point, mode, tolerance, nearest);
  });
  nearest.prefer(least_margin * impl.size);
  for_each_possible(impl.trees, point, nearest.reach,
                    [&](Index k) { look_at_piece<Dim>(impl, k, point, mode, tolerance, nearest); });
  return conclude<Dim>(impl, point, mode, tolerance, nearest.best);
}

template class Projector<2>;
template class Projector<3>;

}  // namespace osculate::projection
