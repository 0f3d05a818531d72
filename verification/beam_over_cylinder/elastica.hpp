#pragma once
// Inextensible elastica over a smooth circle: the reference of this case.
#include "osculate/core/types.hpp"

namespace osculate::verification {

/// A clamped beam that touches a circle in one point and whose end is pulled down.
///
/// Formula    t = (cos a, sin a), n = (-sin a, cos a);  r' = t ,  a' = M / EI ,
///            M' = -(r' x F) ,  F constant but for the jump -q n at the contact point s = c
/// Ends       s = 0: r = start, a = 0.  s = L: F = (0, -P) at the lower edge of the end section,
///            so M = -P offset sin a there, and this edge is at start - offset - pull
/// Contact    frictionless: the bottom r - offset n at s = c is the place of the circle with normal
///            n; the bending moment is continuous, the circle pushes (q > 0), and -M(c) <
///            EI / (radius + offset): bent less than the circle, the beam touches it in one point
/// Beyond     with compliances r' = (1 + axial F.t) t + shear (F.n) n; the normal at the contact
///            point then is that of the mean of r' on both sides
struct ElasticaSetUp {
  double length = 0;
  double stiffness = 0;  ///< EI
  double offset = 0;     ///< from the centreline to the bottom: half the height
  double radius = 0;     ///< of the circle that the bottom touches
  Vec2 start, centre;    ///< (x, z)
  double axial = 0;      ///< 1 / EA; 0: inextensible
  double shear = 0;      ///< 1 / GA of shear; 0: sections stay perpendicular
};

/// Moment and force (x, z) at the clamp, arc length to the contact point, contact force.
using ElasticaUnknowns = Vec<5>;

struct ElasticaPoint {
  Vec2 x = Vec2::Zero();
  double angle = 0, moment = 0;
  Vec2 force = Vec2::Zero();  ///< of the part behind on the part before the section
};

/// Integrates from the clamp to arc length `s`. `steps`: of the classical Runge-Kutta rule, on each
/// side of the contact point.
[[nodiscard]] ElasticaPoint elastica_point(const ElasticaSetUp& set_up,
                                           const ElasticaUnknowns& unknowns, double s,
                                           int steps = 400);

struct Elastica {
  bool converged = false;
  ElasticaUnknowns unknowns = ElasticaUnknowns::Zero();
  double force = 0;     ///< P
  double rotation = 0;  ///< of the end section
  double energy = 0;    ///< of bending
  double residual = 0;  ///< largest violation of the conditions, as lengths over L
};

/// Newton on the conditions at contact and end, from the unknowns of a smaller `pull`.
[[nodiscard]] Elastica solve_elastica(const ElasticaSetUp& set_up, double pull,
                                      const ElasticaUnknowns& start, int steps = 400);

/// The same from the straight beam (which touches at s = contact) in equal parts of the pull.
[[nodiscard]] Elastica pull_elastica(const ElasticaSetUp& set_up, double pull, int parts);

}  // namespace osculate::verification
