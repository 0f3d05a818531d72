// Angles at the joints of a composed curve or surface.
#include <cmath>

#include "osculate/projection/reach.hpp"

namespace osculate::projection {

Vec3 side_tangent(const Composed<3>& s, int piece, int side, double t) {
  const SmoothPiece& p = s.pieces()[static_cast<std::size_t>(piece)];
  const geometry::SurfaceJet j = s.jet(piece, on_side(p, side, t));
  const Vec2 way = on_side(p, side, 1) - on_side(p, side, 0);
  const Vec3 tangent = way.x() * j.r1[0] + way.y() * j.r1[1];
  const double length = tangent.norm();
  return length > 1e-14 * s.size() ? Vec3(tangent / length) : Vec3(Vec3::Zero());
}

namespace {

/// Normal and direction into the face at the place t of a side; false without a normal.
bool half_edge(const Composed<3>& s, int piece, int side, double t, Vec3& tau, Vec3& n,
               Vec3& into) {
  const SurfacePlace<3> place =
      s.place(piece, on_side(s.pieces()[static_cast<std::size_t>(piece)], side, t));
  tau = side_tangent(s, piece, side, t);
  if (!place.valid || tau.isZero()) return false;
  n = place.n;
  into = n.cross(tau);
  return true;
}

}  // namespace

bool edge_faces(const Composed<3>& s, const Joint& joint, double t, EdgeFaces& e) {
  if (joint.piece[1] < 0) return false;
  Vec3 back;
  return half_edge(s, joint.piece[0], joint.side[0], t, e.tau, e.n[0], e.into[0]) &&
         half_edge(s, joint.piece[1], joint.side[1], 1 - t, back, e.n[1], e.into[1]);
}

bool border_face(const Composed<3>& s, const Joint& joint, double t, EdgeFaces& e) {
  if (!half_edge(s, joint.piece[0], joint.side[0], t, e.tau, e.n[0], e.into[0])) return false;
  e.n[1] = -e.n[0];
  e.into[1] = e.into[0];
  return true;
}

CornerFan corner_fan(const Composed<3>& s, std::span<const PieceCorner> around) {
  CornerFan fan;
  for (const PieceCorner& c : around) {
    const SmoothPiece& piece = s.pieces()[static_cast<std::size_t>(c.piece)];
    const int sides = corner_count(piece), before = (c.corner + sides - 1) % sides;
    const SurfacePlace<3> place = s.place(c.piece, piece_corner(piece, c.corner));
    const Vec3 out = side_tangent(s, c.piece, c.corner, 0);
    const Vec3 back = -side_tangent(s, c.piece, before, 1);
    fan.r = place.r;
    if (!place.valid || out.isZero() || back.isZero()) continue;
    fan.tangents.push_back(out);
    fan.tangents.push_back(back);
    fan.normal += std::atan2(out.cross(back).norm(), out.dot(back)) * place.n;
  }
  return fan;
}

double joint_angle(const Composed<2>& c, const Joint& joint) {
  if (joint.piece[1] < 0) return 0;
  const auto tangent = [&](std::size_t k) {
    const SmoothPiece& p = c.pieces()[static_cast<std::size_t>(joint.piece[k])];
    return c.jet(joint.piece[k], joint.side[k] == 0 ? p.lo : p.hi).r1;
  };
  return corner_angle(tangent(0), tangent(1));
}

std::array<double, 2> joint_angles(const Composed<3>& s, const Joint& joint) {
  std::array<double, 2> range{0, 0};
  constexpr int places = 5;
  for (int i = 0; i < places; ++i) {
    EdgeFaces e;
    if (!edge_faces(s, joint, (i + 0.5) / places, e)) continue;
    const double angle = edge_angle(e);
    range = {std::max(range[0], angle), std::min(range[1], angle)};
  }
  return range;
}

}  // namespace osculate::projection
