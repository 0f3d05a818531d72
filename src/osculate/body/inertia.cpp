#include "osculate/body/inertia.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <variant>
#include <vector>

#include "osculate/core/dense.hpp"

namespace osculate::body {
namespace {

constexpr double pi = std::numbers::pi;

/// |r|^2 I - r r^T from the integral of r r^T; in the plane its component out of it.
Mat<1, 1> inertia_from(const Mat<2, 2>& second) { return Mat<1, 1>(second.trace()); }
Mat<3, 3> inertia_from(const Mat<3, 3>& second) {
  return second.trace() * Mat<3, 3>::Identity() - second;
}

/// Abscissae and weights of Gauss' rule with four points on 0..1, over as many pieces of a curve.
constexpr std::array<std::array<double, 2>, 4> gauss{{{0.069431844202973712, 0.17392742256872693},
                                                      {0.33000947820757187, 0.32607257743127307},
                                                      {0.66999052179242813, 0.32607257743127307},
                                                      {0.93056815579702629, 0.17392742256872693}}};
constexpr int pieces = 128;

/// Second moments along an axis and across it.
Mat<3, 3> round_body(const Vec3& axis, double along, double across) {
  const Vec3 e = axis.normalized();
  return across * Mat<3, 3>::Identity() + (along - across) * e * e.transpose();
}

template <class Shape>
std::optional<VolumeMoments<3>> solid(const Shape&) {
  return std::nullopt;
}

std::optional<VolumeMoments<3>> solid(const geometry::Sphere& s) {
  if (s.inside) return std::nullopt;
  const double r2 = s.radius * s.radius, volume = 4.0 / 3 * pi * s.radius * r2;
  return VolumeMoments<3>{s.center, volume, Vec3::Zero(), volume * r2 / 5 * Mat<3, 3>::Identity()};
}

std::optional<VolumeMoments<3>> solid(const geometry::Torus& t) {
  if (t.inside) return std::nullopt;
  const double r2 = t.tube_radius * t.tube_radius, volume = 2 * pi * pi * t.radius * r2;
  const double across = volume * (0.5 * t.radius * t.radius + 0.375 * r2);
  return VolumeMoments<3>{t.center, volume, Vec3::Zero(),
                          round_body(t.axis, volume * r2 / 4, across)};
}

std::optional<VolumeMoments<3>> solid(const geometry::Cylinder& c) {
  if (c.inside || !std::isfinite(c.length)) return std::nullopt;
  const double r2 = c.radius * c.radius, volume = pi * r2 * c.length;
  const Vec3 middle = c.point + 0.5 * c.length * c.axis.normalized();
  return VolumeMoments<3>{middle, volume, Vec3::Zero(),
                          round_body(c.axis, volume * c.length * c.length / 12, volume * r2 / 4)};
}

std::optional<VolumeMoments<3>> solid(const geometry::Cone& c) {
  if (c.inside || !std::isfinite(c.to)) return std::nullopt;
  const double slope2 = std::pow(std::tan(c.half_angle), 2);
  const auto power = [&](int n) { return (std::pow(c.to, n) - std::pow(c.from, n)) / n; };
  const double fifth = pi * slope2 * power(5);  // integral of pi (slope z)^2 z^2 dz
  return VolumeMoments<3>{c.apex, pi * slope2 * power(3),
                          pi * slope2 * power(4) * c.axis.normalized(),
                          round_body(c.axis, fifth, 0.25 * slope2 * fifth)};
}

}  // namespace

template <int Dim>
void add_volume(VolumeMoments<Dim>& moments, const Vec<Dim>& x, double volume) {
  const Vec<Dim> r = x - moments.origin;
  moments.volume += volume;
  moments.first += volume * r;
  moments.second += volume * r * r.transpose();
}

template <int Dim>
void add_boundary(VolumeMoments<Dim>& moments, const Vec<Dim>& x, const Vec<Dim>& outward) {
  const Vec<Dim> r = x - moments.origin;
  const double flux = r.dot(outward);
  moments.volume += flux / Dim;
  moments.first += flux / (Dim + 1) * r;
  moments.second += flux / (Dim + 2) * r * r.transpose();
}

void add_facet(VolumeMoments<2>& moments, const Vec2& a, const Vec2& b) {
  const Vec2 outward = turn(b - a);  // Simpson's rule: the moments are of second degree along it
  add_boundary<2>(moments, a, outward / 6);
  add_boundary<2>(moments, 0.5 * (a + b), outward * (2.0 / 3));
  add_boundary<2>(moments, b, outward / 6);
}

void add_facet(VolumeMoments<3>& moments, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 third = (b - a).cross(c - a) / 6;  // the midpoints' rule is exact for second degree
  add_boundary<3>(moments, 0.5 * (a + b), third);
  add_boundary<3>(moments, 0.5 * (b + c), third);
  add_boundary<3>(moments, 0.5 * (c + a), third);
}

template <int Dim>
Inertia<Dim> inertia_of(const VolumeMoments<Dim>& moments, double density) {
  Inertia<Dim> out;
  out.center = moments.origin;
  if (moments.volume == 0) return out;
  const double scale = std::copysign(density, moments.volume);
  const Vec<Dim> mean = moments.first / moments.volume;
  const Mat<Dim, Dim> central = moments.second - moments.volume * mean * mean.transpose();
  out.mass = scale * moments.volume;
  out.center += mean;
  out.tensor = inertia_from(Mat<Dim, Dim>(scale * central));
  return out;
}

void add_curve(VolumeMoments<2>& moments, const geometry::Curve& curve) {
  std::vector<double> ends{geometry::lo(curve), geometry::hi(curve)};
  if (const auto* const nurbs = std::get_if<geometry::NurbsCurve>(&curve)) ends = nurbs->knots;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double h = (ends[i + 1] - ends[i]) / pieces;
    if (!(h > 0) || ends[i] < geometry::lo(curve) || ends[i + 1] > geometry::hi(curve)) continue;
    for (int p = 0; p < pieces; ++p)
      for (const auto& [at, weight] : gauss) {
        const geometry::CurveJet<2> j = geometry::jet(curve, ends[i] + (p + at) * h);
        add_boundary<2>(moments, j.r, Vec2(weight * h * turn(j.r1)));
      }
  }
}

std::optional<VolumeMoments<2>> enclosed(const geometry::Curve& curve) {
  if (!geometry::closed(curve)) return std::nullopt;
  VolumeMoments<2> out;
  out.origin = geometry::jet(curve, geometry::lo(curve)).r;
  add_curve(out, curve);
  if (!(out.volume > 0)) return std::nullopt;  // a hole
  return out;
}

std::optional<VolumeMoments<3>> enclosed(const geometry::Surface& surface) {
  return std::visit([](const auto& s) { return solid(s); }, surface);
}

template <int Dim>
typename Inertia<Dim>::Tensor tensor_about(const Inertia<Dim>& inertia, const Vec<Dim>& point) {
  const Vec<Dim> d = point - inertia.center;
  return inertia.tensor + inertia_from(Mat<Dim, Dim>(inertia.mass * d * d.transpose()));
}

template <int Dim>
Inertia<Dim> joined(const Inertia<Dim>& a, const Inertia<Dim>& b) {
  Inertia<Dim> out;
  out.mass = a.mass + b.mass;
  out.center = out.mass == 0 ? Vec<Dim>(0.5 * (a.center + b.center))
                             : Vec<Dim>((a.mass * a.center + b.mass * b.center) / out.mass);
  out.tensor = tensor_about<Dim>(a, out.center) + tensor_about<Dim>(b, out.center);
  return out;
}

template <>
std::string validate(const Inertia<2>& inertia) {
  if (!(inertia.mass > 0 && std::isfinite(inertia.mass))) return "the mass must be positive";
  if (!(inertia.tensor(0, 0) > 0 && std::isfinite(inertia.tensor(0, 0))))
    return "the moment of inertia must be positive";
  return inertia.center.allFinite() ? "" : "the centre of mass must be given by finite numbers";
}

template <>
std::string validate(const Inertia<3>& inertia) {
  if (!(inertia.mass > 0 && std::isfinite(inertia.mass))) return "the mass must be positive";
  if (!inertia.center.allFinite()) return "the centre of mass must be given by finite numbers";
  const Mat<3, 3>& j = inertia.tensor;
  if (!j.allFinite()) return "the inertia must be given by finite numbers";
  if ((j - j.transpose()).norm() > 1e-12 * j.norm()) return "the inertia must be symmetric";
  const Vec3 principal = core::eigenvalues(j);
  if (!(principal[0] > 1e-12 * principal[2])) return "the moments of inertia must be positive";
  if (principal[2] > (1 + 1e-9) * (principal[0] + principal[1]))
    return "no body has this inertia: one of its principal moments is larger than the sum of the "
           "others";
  return "";
}

template void add_volume(VolumeMoments<2>&, const Vec2&, double);
template void add_volume(VolumeMoments<3>&, const Vec3&, double);
template void add_boundary(VolumeMoments<2>&, const Vec2&, const Vec2&);
template void add_boundary(VolumeMoments<3>&, const Vec3&, const Vec3&);
template Inertia<2> inertia_of(const VolumeMoments<2>&, double);
template Inertia<3> inertia_of(const VolumeMoments<3>&, double);
template Inertia<2>::Tensor tensor_about<2>(const Inertia<2>&, const Vec2&);
template Inertia<3>::Tensor tensor_about<3>(const Inertia<3>&, const Vec3&);
template Inertia<2> joined(const Inertia<2>&, const Inertia<2>&);
template Inertia<3> joined(const Inertia<3>&, const Inertia<3>&);

}  // namespace osculate::body
