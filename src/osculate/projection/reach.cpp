#include "osculate/projection/reach.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "osculate/projection/bottleneck.hpp"
#include "osculate/projection/piece_search.hpp"

namespace osculate::projection {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Where a ball rests: in the interior of a piece, on a side or joint, at a corner.
enum class Rest : std::uint8_t { face, joint, corner };

/// A place, a unit direction away from the surface and the radius of the ball resting there.
template <int Dim>
struct Probe {
  Rest rest = Rest::face;
  int index = 0;    ///< piece, joint or corner
  Vec2 xi{0, 0};    ///< face: parameters; joint: part of the side
  double step = 0;  ///< distance of the samples, in parameters
  Vec<Dim> r = Vec<Dim>::Zero(), v = Vec<Dim>::Zero();
  double radius = infinite;
  Vec<Dim> other = Vec<Dim>::Zero();
};

/// Signed curvature that bends towards the side (+1 above, -1 below).
template <int Dim>
double towards(const SurfacePlace<Dim>& place, int side) {
  if (!place.valid) return -infinite;
  return side > 0 ? place.k[0] : -place.k[1];
}

template <int Dim>
SideLimit<Dim> curvature_limit(const Composed<Dim>& s, int side, int cells) {
  struct Best {
    double k;
    int piece;
    Vec2 xi;
    double step;
  };
  std::vector<Best> best;
  for (std::size_t p = 0; p < s.pieces().size(); ++p) {
    std::optional<Best> here;
    for_each_sample<Dim>(s.pieces()[p], cells, [&](const Vec2& xi, double step) {
      const double k = towards(s.place(static_cast<int>(p), xi), side);
      if (k > 0 && (!here || k > here->k)) here = Best{k, static_cast<int>(p), xi, step};
    });
    if (here) best.push_back(*here);
  }
  constexpr std::size_t refined = 12;
  const std::size_t count = std::min(refined, best.size());
  std::partial_sort(best.begin(), best.begin() + static_cast<std::ptrdiff_t>(count), best.end(),
                    [](const Best& a, const Best& b) { return a.k > b.k; });
  SideLimit<Dim> out;
  for (std::size_t i = 0; i < count; ++i) {
    Best& b = best[i];
    const auto k_at = [&](const Vec2& xi) { return towards(s.place(b.piece, xi), side); };
    const double k =
        climb(s.pieces()[static_cast<std::size_t>(b.piece)], b.xi, b.step, Dim - 1, k_at);
    if (!(k * s.size() > 1e-9) || !(1 / k < out.value)) continue;
    const Vec<Dim> r = s.place(b.piece, b.xi).r;
    out = {1 / k, Limit::curvature, r, r};
  }
  return out;
}

/// Places with the directions of one side in which balls are laid on them.
template <int Dim>
struct Probes {
  std::vector<Probe<Dim>> list;
  SideLimit<Dim> kink;  ///< zero if an edge or corner opens to the other side
};

template <int Dim>
void add_faces(const Composed<Dim>& s, int side, int cells, Probes<Dim>& out) {
  for (std::size_t p = 0; p < s.pieces().size(); ++p)
    for_each_sample<Dim>(s.pieces()[p], cells, [&](const Vec2& xi, double step) {
      const SurfacePlace<Dim> place = s.place(static_cast<int>(p), xi);
      if (!place.valid) return;
      out.list.push_back({Rest::face, static_cast<int>(p), xi, step, place.r, side * place.n});
    });
}

template <int Dim>
void set_kink(const Vec<Dim>& r, Probes<Dim>& out) {
  if (out.kink.limit == Limit::none) out.kink = {0, Limit::kink, r, r};
}

void add_joints(const Composed<2>& c, int side, double kink, int, Probes<2>& out) {
  for (std::size_t i = 0; i < c.joints().size(); ++i) {
    const Joint& joint = c.joints()[i];
    const auto place = [&](std::size_t k) {
      const SmoothPiece& p = c.pieces()[static_cast<std::size_t>(joint.piece[k])];
      return c.place(joint.piece[k], joint.side[k] == 0 ? p.lo : p.hi);
    };
    const SurfacePlace<2> first = place(0);
    if (!joint.regular) set_kink(first.r, out);
    Vec2 from = side * first.n, to = from;
    if (joint.piece[1] < 0) {
      to = joint.side[0] == 0 ? turn(first.n) : Vec2(-turn(first.n));  // beyond the end
    } else {
      const double angle = side * joint_angle(c, joint);
      if (angle < -kink) set_kink(first.r, out);
      if (angle <= kink) continue;
      to = side * place(1).n;
    }
    constexpr int directions = 8;
    for (int k = 0; k <= directions; ++k)
      out.list.push_back({Rest::joint, static_cast<int>(i), Vec2(0, 0), 0, first.r,
                          turned<2>(from, to, static_cast<double>(k) / directions)});
  }
}

void add_joints(const Composed<3>& s, int side, double kink, int cells, Probes<3>& out) {
  for (std::size_t i = 0; i < s.joints().size(); ++i) {
    const Joint& joint = s.joints()[i];
    const bool border = joint.piece[1] < 0;
    for (int k = 0; k <= cells; ++k) {
      const double t = static_cast<double>(k) / cells;
      EdgeFaces e;
      if (!(border ? border_face(s, joint, t, e) : edge_faces(s, joint, t, e))) continue;
      const SmoothPiece& piece = s.pieces()[static_cast<std::size_t>(joint.piece[0])];
      const Vec3 r = s.jet(joint.piece[0], on_side(piece, joint.side[0], t)).r;
      if (!joint.regular) set_kink(r, out);
      Vec3 from = side * e.n[0], to = -e.into[0];
      if (!border) {
        const double angle = side * edge_angle(e);
        if (angle < -kink) set_kink(r, out);
        if (angle <= kink) continue;
        to = side * e.n[1];
      }
      constexpr int directions = 6;
      for (int d = 1; d <= directions; ++d)
        out.list.push_back({Rest::joint, static_cast<int>(i), Vec2(t, 0), 1.0 / cells, r,
                            turned<3>(from, to, static_cast<double>(d) / directions)});
    }
  }
}

/// Directions of a corner's cone: its rays and what lies between them.
void add_corners(const Composed<3>& s, int side, Probes<3>& out) {
  for (std::size_t i = 0; i < s.corners().size(); ++i) {
    const CornerFan fan = corner_fan(s, s.corners()[i]);
    const std::vector<Vec3> rays = corner_rays(fan.tangents);
    if (rays.size() < 3) continue;  // on a smooth edge or face: the same as its neighbours
    const auto add = [&](const Vec3& v) {
      const double length = v.norm();
      if (!(length > 1e-9) || side * v.dot(fan.normal) < -1e-12 * length) return;
      out.list.push_back(
          {Rest::corner, static_cast<int>(i), Vec2(0, 0), 0, fan.r, Vec3(v / length)});
    };
    Vec3 mean = Vec3::Zero();
    for (const Vec3& a : rays) mean += a;
    add(mean);
    for (std::size_t a = 0; a < rays.size(); ++a) {
      add(rays[a]);
      add(Vec3(rays[a] + mean));
      for (std::size_t b = a + 1; b < rays.size(); ++b) add(Vec3(rays[a] + rays[b]));
    }
  }
}
void add_corners(const Composed<2>&, int, Probes<2>&) {}

void add_apex(const Composed<2>&, int, Probes<2>&) {}
/// The point of a whole cone: a corner that opens outwards.
void add_apex(const Composed<3>& s, int side, Probes<3>& out) {
  const auto* surface = std::get_if<geometry::Surface>(&s.target());
  const auto* cone = surface ? std::get_if<geometry::Cone>(surface) : nullptr;
  if (cone && cone->from == 0 && (side > 0) == cone->inside) set_kink(cone->apex, out);
}

/// Shrinks balls that rest on places until nothing of the surface is inside.
template <int Dim>
class BallPress {
 public:
  BallPress(const Composed<Dim>& s, int side, double kink)
      : surface_(s), side_(side), kink_(kink) {}

  /// The radius at the probe if it is below `radius`, else `radius`; sets `other` and turns the
  /// direction of a probe on an edge or corner to where the ball is smallest.
  double press(Probe<Dim>& p, double radius) const {
    for (int it = 0; it < 100; ++it) {
      const Vec<Dim> centre = p.r + radius * p.v;
      const double inside = radius * (1 - slack_);
      const NearestPlace<Dim> q = surface_.nearest(centre, inside * inside);
      if (q.piece < 0 || !(q.squared_distance < inside * inside)) break;
      const double next = ball(p, q.r);
      if (!(next < radius)) break;
      radius = next;
      p.other = q.r;
    }
    return radius;
  }

  /// Radius of the ball that rests on the probe and has q on it. A place nearby may stand out by
  /// what the kink of a joint that counts as smooth raises it.
  double resting(const Probe<Dim>& p, const Vec<Dim>& q) const {
    const Vec<Dim> d = q - p.r;
    const double distance = d.norm();
    double height = d.dot(p.v);
    if (!(distance > 1e-5 * surface_.size()) || !(height > 1e-9 * distance)) return infinite;
    if (4 * height < distance) height -= kink_ * distance;  // closer than half the radius
    return height > 1e-9 * distance ? distance * distance / (2 * height) : infinite;
  }

  /// The same after turning the direction of a probe on an edge or corner.
  double ball(Probe<Dim>& p, const Vec<Dim>& q) const {
    if (resting(p, q) < infinite) aim(p, Vec<Dim>(q - p.r));
    return resting(p, q);
  }

 private:
  /// The direction of the edge's wedge or the corner's cone nearest to d, if it is a better one.
  void aim(Probe<Dim>& p, const Vec<Dim>& d) const {
    if (p.rest == Rest::face) return;
    Vec<Dim> v = d;
    if constexpr (Dim == 2) {
      const Joint& joint = surface_.joints()[static_cast<std::size_t>(p.index)];
      std::vector<Vec2> tangents;
      for (std::size_t k = 0; k < 2 && joint.piece[k] >= 0; ++k) {
        const SmoothPiece& piece = surface_.pieces()[static_cast<std::size_t>(joint.piece[k])];
        const bool begins = joint.side[k] == 0;
        const Vec2 r1 = surface_.jet(joint.piece[k], begins ? piece.lo : piece.hi).r1;
        tangents.push_back(begins ? r1 : Vec2(-r1));
      }
      const bool border = joint.piece[1] < 0;
      if (!in_normal_cone<2>(tangents, v) || (border && wrong_side(joint, v))) return;
    } else if (p.rest == Rest::joint) {
      const Joint& joint = surface_.joints()[static_cast<std::size_t>(p.index)];
      EdgeFaces e;
      const bool border = joint.piece[1] < 0;
      if (!(border ? border_face(surface_, joint, p.xi.x(), e)
                   : edge_faces(surface_, joint, p.xi.x(), e)))
        return;
      v -= v.dot(e.tau) * e.tau;
      if (!in_edge_wedge(e, v) || (border && side_ * v.dot(e.n[0]) < 0)) return;
    } else {
      const CornerFan fan =
          corner_fan(surface_, surface_.corners()[static_cast<std::size_t>(p.index)]);
      if (!in_normal_cone<3>(fan.tangents, v) || side_ * v.dot(fan.normal) < 0) return;
    }
    const double length = v.norm();
    if (length > 0) p.v = v / length;
  }

  [[nodiscard]] bool wrong_side(const Joint& joint, const Vec2& v) const {
    const SmoothPiece& piece = surface_.pieces()[static_cast<std::size_t>(joint.piece[0])];
    const Vec2 n = surface_.place(joint.piece[0], joint.side[0] == 0 ? piece.lo : piece.hi).n;
    return side_ * v.dot(n) < 0;
  }

  const Composed<Dim>& surface_;
  int side_;
  double kink_;
  static constexpr double slack_ = 1e-9;  ///< of the radius
};

/// Moves a probe to another place of its face or edge; false where there is none.
template <int Dim>
bool place_probe(const Composed<Dim>& s, int side, const Vec2& xi, Probe<Dim>& p) {
  p.xi = xi;
  if (p.rest == Rest::face) {
    const SurfacePlace<Dim> place = s.place(p.index, xi);
    p.r = place.r;
    p.v = side * place.n;
    return place.valid;
  }
  if constexpr (Dim == 3) {
    const Joint& joint = s.joints()[static_cast<std::size_t>(p.index)];
    const SmoothPiece& piece = s.pieces()[static_cast<std::size_t>(joint.piece[0])];
    EdgeFaces e;
    const bool ok =
        joint.piece[1] < 0 ? border_face(s, joint, xi.x(), e) : edge_faces(s, joint, xi.x(), e);
    p.r = s.jet(joint.piece[0], on_side(piece, joint.side[0], xi.x())).r;
    p.v -= p.v.dot(e.tau) * e.tau;
    if (!ok || !(p.v.norm() > 1e-6)) return false;
    p.v.normalize();
    return in_edge_wedge(e, p.v, 1e-6);
  }
  return false;
}

/// The smallest ball near a probe, by moving its place.
template <int Dim>
void refine(const Composed<Dim>& s, const BallPress<Dim>& press, int side, Probe<Dim>& best) {
  if (best.rest == Rest::corner || (Dim == 2 && best.rest == Rest::joint)) return;
  const SmoothPiece line{Vec2(0, 0), Vec2(1, 0)};
  const SmoothPiece& range =
      best.rest == Rest::face ? s.pieces()[static_cast<std::size_t>(best.index)] : line;
  const int dimension = best.rest == Rest::face ? Dim - 1 : 1;
  Vec2 xi = best.xi;
  (void)climb(range, xi, best.step, dimension, [&](const Vec2& next) {
    Probe<Dim> p = best;
    if (!place_probe(s, side, next, p)) return -infinite;
    const double radius = press.press(p, best.radius);
    if (radius < best.radius) {
      p.radius = radius;
      best = p;
    }
    return next == best.xi ? -best.radius : -infinite;
  });
}

/// First guesses from a cloud of points of the surface.
template <int Dim>
void press_on_cloud(const BallPress<Dim>& press, std::vector<Probe<Dim>>& probes) {
  constexpr std::size_t most = 1500;
  const std::size_t stride = probes.size() / most + 1;
  for (Probe<Dim>& p : probes) {
    for (std::size_t k = 0; k < probes.size(); k += stride) {
      const double radius = press.resting(p, probes[k].r);
      if (!(radius < p.radius)) continue;
      p.radius = radius;
      p.other = probes[k].r;
    }
    if (p.radius < infinite) p.radius = std::min(p.radius, press.ball(p, p.other));
  }
  std::stable_sort(probes.begin(), probes.end(),
                   [](const Probe<Dim>& a, const Probe<Dim>& b) { return a.radius < b.radius; });
}

/// The smallest ball of the side below `limit`.
template <int Dim>
SideLimit<Dim> smallest_ball(const Composed<Dim>& s, int side, const ReachOptions& options,
                             const SideLimit<Dim>& limit, std::vector<Probe<Dim>>& probes) {
  const BallPress<Dim> press(s, side, options.kink);
  press_on_cloud(press, probes);
  double best = limit.value;
  std::vector<Probe<Dim>> found;
  constexpr std::size_t refined = 4;
  for (Probe<Dim>& p : probes) {
    const double start = std::min({best, p.radius, 1e3 * s.size()});
    const double radius = press.press(p, start);
    if (radius >= std::min(best, 1e3 * s.size())) continue;
    if (radius == p.radius) {  // the cloud's own point is the one on the ball
      const NearestPlace<Dim> q = s.nearest(p.other);
      if (q.piece >= 0) p.other = q.r;
    }
    best = p.radius = radius;
    found.push_back(p);
  }
  SideLimit<Dim> out = limit;
  for (std::size_t i = 0; i < std::min(refined, found.size()); ++i) {
    Probe<Dim>& p = found[found.size() - 1 - i];
    refine(s, press, side, p);
    const bool close = (p.other - p.r).norm() < p.radius;  // the bend itself, but for rounding
    if (close && p.radius > (1 - 1e-6) * limit.value) continue;
    if (p.radius < out.value) out = {p.radius, Limit::bottleneck, p.r, p.other};
  }
  return out;
}

template <int Dim>
std::vector<PieceSample> face_samples(const std::vector<Probe<Dim>>& probes) {
  std::vector<PieceSample> samples;
  for (const Probe<Dim>& p : probes)
    if (p.rest == Rest::face) samples.push_back({p.index, p.xi});
  return samples;
}

}  // namespace

std::string_view name(Limit limit) {
  constexpr std::array<std::string_view, 4> names{"none", "curvature", "bottleneck", "kink"};
  return names[static_cast<std::size_t>(limit)];
}

template <int Dim>
Reach<Dim> reach(const Composed<Dim>& surface, const ReachOptions& options) {
  const int cells = cells_of(surface, options.samples);
  Reach<Dim> out;
  for (const int side : {-1, 1}) {
    SideReach<Dim>& to = side > 0 ? out.above : out.below;
    to.curvature = curvature_limit(surface, side, 2 * cells);
    Probes<Dim> probes;
    add_faces(surface, side, cells, probes);
    add_joints(surface, side, options.kink, cells, probes);
    add_corners(surface, side, probes);
    add_apex(surface, side, probes);
    to.bottleneck = smallest_bottleneck<Dim>(surface, side, face_samples(probes.list));
    if (probes.kink.limit == Limit::kink) {
      to.reach = probes.kink;
      continue;
    }
    to.reach = smallest_ball(surface, side, options, to.curvature, probes.list);
    const bool opposite = (to.reach.other - to.reach.at).norm() > 1.999 * to.reach.value;
    if (to.reach.limit == Limit::bottleneck && opposite &&
        to.reach.value < (1 - 1e-9) * to.bottleneck.value)
      to.bottleneck = to.reach;
    if (to.bottleneck.value <= to.reach.value) to.reach = to.bottleneck;
  }
  return out;
}

template Reach<2> reach(const Composed<2>&, const ReachOptions&);
template Reach<3> reach(const Composed<3>&, const ReachOptions&);

}  // namespace osculate::projection
