#include "elastica.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace osculate::verification {
namespace {

/// x, z, angle, moment, energy
using Section = Vec<5>;

Vec2 tangent(const Section& y) { return {std::cos(y[2]), std::sin(y[2])}; }
Vec2 normal(const Section& y) { return {-std::sin(y[2]), std::cos(y[2])}; }

Section derivative(const ElasticaSetUp& set_up, const Section& y, const Vec2& force) {
  const Vec2 t = tangent(y), n = normal(y);
  const Vec2 along = (1 + set_up.axial * force.dot(t)) * t + set_up.shear * force.dot(n) * n;
  return {along.x(), along.y(), y[3] / set_up.stiffness,
          force.x() * along.y() - force.y() * along.x(), 0.5 * y[3] * y[3] / set_up.stiffness};
}

Section integrate(const ElasticaSetUp& set_up, Section y, const Vec2& force, double length,
                  int steps) {
  const double h = length / steps;
  for (int i = 0; i < steps; ++i) {
    const Section k1 = derivative(set_up, y, force);
    const Section k2 = derivative(set_up, y + 0.5 * h * k1, force);
    const Section k3 = derivative(set_up, y + 0.5 * h * k2, force);
    const Section k4 = derivative(set_up, y + h * k3, force);
    y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return y;
}

/// Outward normal of the circle where the beam touches it; `before`: force before the point.
Vec2 contact_normal(const ElasticaSetUp& set_up, const Section& y, const Vec2& before, double q) {
  const double angle = y[2] + set_up.shear * (before.dot(normal(y)) - 0.5 * q);
  return {-std::sin(angle), std::cos(angle)};
}

struct Shot {
  Section contact, end;
  Vec2 normal;  ///< at the contact point
  Vec2 force;   ///< behind it
};

Section clamp(const ElasticaSetUp& set_up, const ElasticaUnknowns& u) {
  Section y = Section::Zero();
  y.head<2>() = set_up.start;
  y[3] = u[0];
  return y;
}

Shot shoot(const ElasticaSetUp& set_up, const ElasticaUnknowns& u, int steps) {
  const Vec2 before = u.segment<2>(1);
  Shot shot;
  shot.contact = integrate(set_up, clamp(set_up, u), before, u[3], steps);
  shot.normal = contact_normal(set_up, shot.contact, before, u[4]);
  shot.force = before - u[4] * shot.normal;
  shot.end = integrate(set_up, shot.contact, shot.force, set_up.length - u[3], steps);
  return shot;
}

/// Conditions at the contact point (two), on the force, the moment and the place of the end, all
/// as lengths over the length of the beam.
ElasticaUnknowns conditions(const ElasticaSetUp& set_up, const ElasticaUnknowns& u, double pull,
                            int steps) {
  const Shot shot = shoot(set_up, u, steps);
  const Vec2 touch = shot.contact.head<2>() - set_up.offset * normal(shot.contact) - set_up.centre -
                     set_up.radius * shot.normal;
  const Vec2 edge = shot.end.head<2>() - set_up.offset * normal(shot.end);
  const double l = set_up.length, unit = set_up.stiffness / (l * l);
  const double end_moment = set_up.offset * std::sin(shot.end[2]) * shot.force.y();
  return {touch.x() / l, touch.y() / l, shot.force.x() / unit,
          (shot.end[3] - end_moment) / (unit * l),
          (edge.y() - set_up.start.y() + set_up.offset + pull) / l};
}

}  // namespace

ElasticaPoint elastica_point(const ElasticaSetUp& set_up, const ElasticaUnknowns& unknowns,
                             double s, int steps) {
  Vec2 force = unknowns.segment<2>(1);
  const double contact = unknowns[3];
  Section y = integrate(set_up, clamp(set_up, unknowns), force, std::min(s, contact), steps);
  if (s > contact) {
    force -= unknowns[4] * contact_normal(set_up, y, force, unknowns[4]);
    y = integrate(set_up, y, force, s - contact, steps);
  }
  return {y.head<2>(), y[2], y[3], force};
}

Elastica solve_elastica(const ElasticaSetUp& set_up, double pull, const ElasticaUnknowns& start,
                        int steps) {
  constexpr int iterations = 20;
  constexpr double small = 1e-13;
  const double l = set_up.length, unit = set_up.stiffness / (l * l);
  const ElasticaUnknowns scale{unit * l, unit, unit, l, unit};
  Elastica out;
  out.unknowns = start;
  for (int i = 0; i < iterations && !out.converged; ++i) {
    const ElasticaUnknowns r = conditions(set_up, out.unknowns, pull, steps);
    Mat<5, 5> k;
    for (int j = 0; j < 5; ++j) {
      const double h = 1e-5 * scale[j];
      ElasticaUnknowns more = out.unknowns, less = out.unknowns;
      more[j] += h;
      less[j] -= h;
      k.col(j) = (conditions(set_up, more, pull, steps) - conditions(set_up, less, pull, steps)) /
                 (2 * h) * scale[j];
    }
    const ElasticaUnknowns step = k.partialPivLu().solve(r);
    out.unknowns -= step.cwiseProduct(scale);
    out.converged = step.cwiseAbs().maxCoeff() < small * 10;
  }
  out.residual = conditions(set_up, out.unknowns, pull, steps).cwiseAbs().maxCoeff();
  out.converged = out.converged && out.residual < small * 10;
  const Shot shot = shoot(set_up, out.unknowns, steps);
  out.force = -shot.force.y();
  out.rotation = shot.end[2];
  out.energy = shot.end[4];
  return out;
}

Elastica pull_elastica(const ElasticaSetUp& set_up, double pull, int parts) {
  Elastica out;
  out.unknowns[3] = set_up.centre.x() - set_up.start.x();
  out.converged = true;
  for (int i = 1; i <= parts && out.converged; ++i)
    out = solve_elastica(set_up, pull * i / parts, out.unknowns);
  return out;
}

}  // namespace osculate::verification
