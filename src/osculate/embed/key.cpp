#include <variant>

#include "osculate/core/archive.hpp"
#include "osculate/embed/definition.hpp"
#include "osculate/embed/state_bytes.hpp"

// Members of what a history refers to, for core/archive.hpp.
namespace osculate {
template <class A>
void fields(A& a, Line& s) {
  a(s.point, s.normal);
}
template <class A>
void fields(A& a, Segment& s) {
  a(s.from, s.to);
}
template <class A>
void fields(A& a, Circle& s) {
  a(s.center, s.radius, s.inside);
}
template <class A>
void fields(A& a, Arc& s) {
  a(s.center, s.radius, s.from, s.to, s.inside);
}
template <class A>
void fields(A& a, NurbsCurve& s) {
  a(s.degree, s.knots, s.control, s.weights);
}
template <class A>
void fields(A& a, Plane& s) {
  a(s.point, s.normal);
}
template <class A>
void fields(A& a, Sphere& s) {
  a(s.center, s.radius, s.inside);
}
template <class A>
void fields(A& a, Cylinder& s) {
  a(s.point, s.axis, s.radius, s.inside, s.length);
}
template <class A>
void fields(A& a, Cone& s) {
  a(s.apex, s.axis, s.half_angle, s.inside, s.from, s.to);
}
template <class A>
void fields(A& a, Torus& s) {
  a(s.center, s.axis, s.radius, s.tube_radius, s.inside);
}
template <class A>
void fields(A& a, NurbsSurface& s) {
  a(s.degree, s.knots, s.count, s.control, s.weights);
}
template <class A>
void fields(A& a, Facets& f) {
  a(f.type, f.nodes);
}
template <class A, int Dim>
void fields(A& a, Surface<Dim>& s) {
  a(s.facets, s.framed.closed, s.framed.frame, s.points);
  for (auto& shape : s.framed.shapes) {
    a(shape.index());
    std::visit([&](auto& one) { a(one); }, shape);
  }
}
}  // namespace osculate

namespace osculate::embed {

template <int Dim>
std::uint64_t key_of(const Contact<Dim>& c, std::span<const double> reference) {
  core::Saver saver;
  saver(Dim, c.master, c.slave.has_value());
  if (c.slave) saver(*c.slave);
  saver(c.sampling.rule, c.sampling.points, c.sampling.subdomains, c.enforcement, c.separation,
        c.overlap, c.smoothing.kind, c.smoothing.sharp_angle, c.edge_angle.value_or(0),
        c.reentrant_vertices, c.friction.has_value());
  for (const double value : reference) saver(value);
  return fingerprint(saver.take());
}

template std::uint64_t key_of(const Contact<2>&, std::span<const double>);
template std::uint64_t key_of(const Contact<3>&, std::span<const double>);

}  // namespace osculate::embed
