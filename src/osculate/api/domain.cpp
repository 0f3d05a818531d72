#include "osculate/api/domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "osculate/geometry/point_class.hpp"
#include "osculate/projection/piece_search.hpp"
#include "osculate/projection/reach.hpp"
#include "osculate/projection/reach_bound.hpp"
#include "osculate/result/domain_picture.hpp"

namespace osculate::api {
namespace {

using projection::Composed;
using projection::Joint;
using projection::SurfacePlace;
using result::DomainReport;
using result::in_space;
using result::text_of;

constexpr double degree = std::numbers::pi / 180;
constexpr double infinite = std::numeric_limits<double>::infinity();

template <int Dim>
result::DomainLimit plain(const projection::SideLimit<Dim>& limit) {
  return {limit.value, std::string(name(limit.limit)), in_space(limit.at), in_space(limit.other)};
}
template <int Dim>
result::DomainSide plain(const projection::SideReach<Dim>& side,
                         const projection::SideBound& bound) {
  std::string why;
  if (bound.gap != projection::Gap::none) why = name(bound.gap);
  return {plain(side.curvature), plain(side.bottleneck), plain(side.reach), bound.least,
          std::move(why)};
}

/// Largest and smallest angle of a joint, in radians.
std::array<double, 2> angles_of(const Composed<2>& s, const Joint& joint) {
  const double angle = joint_angle(s, joint);
  return {angle, angle};
}
std::array<double, 2> angles_of(const Composed<3>& s, const Joint& joint) {
  return joint_angles(s, joint);
}

Vec3 middle_of(const Composed<2>& s, const Joint& joint) {
  const projection::SmoothPiece& p = s.pieces()[static_cast<std::size_t>(joint.piece[0])];
  return in_space(s.jet(joint.piece[0], joint.side[0] == 0 ? p.lo : p.hi).r);
}
Vec3 middle_of(const Composed<3>& s, const Joint& joint) {
  const projection::SmoothPiece& p = s.pieces()[static_cast<std::size_t>(joint.piece[0])];
  return s.jet(joint.piece[0], on_side(p, joint.side[0], 0.5)).r;
}

/// Numbers of the smooth parts that the pieces belong to.
class SmoothParts {
 public:
  explicit SmoothParts(std::size_t pieces) : part_(pieces) {
    std::iota(part_.begin(), part_.end(), 0);
  }
  [[nodiscard]] std::size_t of(std::size_t piece) {
    while (part_[piece] != piece) piece = part_[piece] = part_[part_[piece]];
    return piece;
  }
  void join(std::size_t a, std::size_t b) { part_[of(a)] = of(b); }

 private:
  std::vector<std::size_t> part_;
};

template <int Dim>
void look_at_joints(const Composed<Dim>& s, double kink, DomainReport& report, SmoothParts& parts) {
  const auto note = [](result::DomainKinks& kinks, double angle, const Vec3& at) {
    ++kinks.count;
    if (angle > kinks.largest) kinks = {kinks.count, angle, at};
  };
  int irregular = 0;
  for (const Joint& joint : s.joints()) {
    if (joint.piece[1] < 0) {
      ++report.borders;
      continue;
    }
    irregular += !joint.regular;
    const std::array<double, 2> angle = angles_of(s, joint);
    if (angle[0] > kink) note(report.ridges, angle[0] / degree, middle_of(s, joint));
    if (angle[1] < -kink) note(report.valleys, -angle[1] / degree, middle_of(s, joint));
    if (angle[0] <= kink && angle[1] >= -kink)
      parts.join(static_cast<std::size_t>(joint.piece[0]),
                 static_cast<std::size_t>(joint.piece[1]));
  }
  if (irregular > 0)
    report.warnings.push_back(
        fmt::format("facets of opposite orientation, or more than two, meet at {} {}: sides and "
                    "reach mean nothing there",
                    irregular, Dim == 2 ? "node(s)" : "edge(s)"));
}

std::string_view class_name(const SurfacePlace<2>& place, double size) {
  if (!place.valid) return "singular";
  if (std::abs(place.k[0]) * size <= geometry::flat_tolerance) return "straight";
  return place.k[0] > 0 ? "bent above" : "bent below";
}
std::string_view class_name(const SurfacePlace<3>& place, double size) {
  return place.valid ? name(geometry::point_class(place.k, size)) : "singular";
}

void count_class(std::string_view name, DomainReport& report) {
  const auto known = std::find_if(report.classes.begin(), report.classes.end(),
                                  [&](const auto& c) { return c.first == name; });
  if (known == report.classes.end())
    report.classes.emplace_back(name, 1);
  else
    ++known->second;
  ++report.places;
}

/// Counts classes; finds distorted places and the smallest bounds of the smooth parts.
template <int Dim>
std::vector<std::array<double, 2>> look_at_places(const Composed<Dim>& s, int cells,
                                                  DomainReport& report, SmoothParts& parts) {
  std::vector<std::array<double, 2>> bounds(s.pieces().size(), {infinite, infinite});
  Vec3 distorted = Vec3::Zero();
  std::vector<Vec3> without;  // a normal
  for (std::size_t p = 0; p < s.pieces().size(); ++p)
    projection::for_each_sample<Dim>(s.pieces()[p], cells, [&](const Vec2& xi, double) {
      const SurfacePlace<Dim> place = s.place(static_cast<int>(p), xi);
      count_class(class_name(place, s.size()), report);
      if (!place.valid) without.push_back(in_space(place.r));
      if (place.valid && place.sine < report.smallest_sine) {
        report.smallest_sine = place.sine;
        distorted = in_space(place.r);
      }
      if (!place.valid) return;
      std::array<double, 2>& bound = bounds[parts.of(p)];
      if (place.k[0] * s.size() > 1e-9) bound[1] = std::min(bound[1], 1 / place.k[0]);
      if (-place.k[1] * s.size() > 1e-9) bound[0] = std::min(bound[0], -1 / place.k[1]);
    });
  if (!without.empty())
    report.warnings.push_back(fmt::format("there is no normal at {} of the places, at {} first",
                                          without.size(), text_of(without.front())));
  constexpr double distortion = 0.02;
  if (report.smallest_sine < distortion)
    report.warnings.push_back(
        fmt::format("the coordinate lines are parallel to {:.3g} degrees at {}: det a is close to "
                    "zero there, and Newton's method may not converge",
                    std::asin(report.smallest_sine) / degree, text_of(distorted)));
  for (std::size_t p = 0; p < bounds.size(); ++p) bounds[p] = bounds[parts.of(p)];
  return bounds;
}

void look_for_flat_points(const Composed<2>&, int, DomainReport&) {}
/// Planar points of surfaces that are not flat around them.
void look_for_flat_points(const Composed<3>& s, int cells, DomainReport& report) {
  constexpr std::size_t most = 5;
  constexpr int most_pieces = 200;
  const int stride = static_cast<int>(s.pieces().size()) / most_pieces + 1;
  for (int p = 0; p < static_cast<int>(s.pieces().size()); p += stride) {
    const projection::SmoothPiece& piece = s.pieces()[static_cast<std::size_t>(p)];
    const auto bend = [&](const Vec2& xi) {
      const SurfacePlace<3> place = s.place(p, xi);
      return place.valid ? -std::max(std::abs(place.k[0]), std::abs(place.k[1])) : -infinite;
    };
    Vec2 best = 0.5 * (piece.lo + piece.hi);
    double least = -infinite, most_bent = 0, step = 1;
    projection::for_each_sample<3>(piece, cells, [&](const Vec2& xi, double h) {
      const double value = bend(xi);
      step = h;
      if (std::isfinite(value)) most_bent = std::min(most_bent, value);
      if (!(value > least)) return;
      least = value;
      best = xi;
    });
    constexpr double flat = 1e-6;
    if (-most_bent * s.size() < flat) continue;  // flat as a whole
    if (-projection::climb(piece, best, step, 2, bend) * s.size() > flat) continue;
    const geometry::SurfaceJet j = s.jet(p, best);
    const bool known = std::any_of(
        report.flat.begin(), report.flat.end(),
        [&](const result::FlatPlace& f) { return (f.at - j.r).norm() < 1e-3 * s.size(); });
    if (known || report.flat.size() >= most) continue;
    const geometry::FlatPoint point = flat_point(j, surface_frame(j), s.size(), flat);
    report.flat.push_back({j.r, std::string(name(point.form))});
  }
}

template <int Dim>
DomainReport survey(const projection::Target<Dim>& target, const DomainOptions& options) {
  const Composed<Dim> s(target);
  DomainReport report;
  report.dimension = Dim;
  report.size = s.size();
  report.pieces = static_cast<int>(s.pieces().size());
  const double kink = options.kink * degree;
  const int cells = projection::cells_of(s, options.samples);
  SmoothParts parts(s.pieces().size());
  look_at_joints(s, kink, report, parts);
  std::vector<std::array<double, 2>> even = look_at_places(s, cells, report, parts);
  look_for_flat_points(s, cells, report);
  const projection::Reach<Dim> r = reach(s, {kink, options.samples});
  const projection::ReachBound bound =
      reach_bound(target, r, {.kink = kink, .tolerance = options.tolerance});
  report.above = plain(r.above, bound.above);
  report.below = plain(r.below, bound.below);
  report.tolerance = options.tolerance;
  std::size_t smooth_parts = 0;
  for (std::size_t p = 0; p < s.pieces().size(); ++p) smooth_parts += parts.of(p) == p;
  if (smooth_parts == 1)
    even.assign(even.size(), {r.below.curvature.value, r.above.curvature.value});
  const double length = options.length > 0 ? options.length : s.size();
  report.picture = result::draw_domain(s, {kink, length, options.cells}, even);
  return report;
}

}  // namespace

DomainReport survey_domain(const deck::AnyTarget& target, const std::string& name,
                           const DomainOptions& options) {
  DomainReport report = target.index() == 0 ? survey<2>(std::get<0>(target), options)
                                            : survey<3>(std::get<1>(target), options);
  report.surface = name;
  return report;
}

}  // namespace osculate::api
