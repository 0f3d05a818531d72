#pragma once
#include <array>
#include <cmath>
#include <concepts>

#include "osculate/geometry/catalogue.hpp"

namespace osculate::geometry {
namespace detail {

/// Positive Kronrod nodes with their weights and those of the embedded Gauss rule (0: not in it).
struct KronrodNode {
  double x, kronrod, gauss;
};
inline constexpr std::array<KronrodNode, 7> kronrod_nodes{{
    {0.991455371120812639206854697526329, 0.022935322010529224963732008058970, 0.0},
    {0.949107912342758524526189684047851, 0.063092092629978553290700663189204,
     0.129484966168869693270611432679082},
    {0.864864423359769072789712788640926, 0.104790010322250183839876322541518, 0.0},
    {0.741531185599394439863864773280788, 0.140653259715525918745189590510238,
     0.279705391489276667901467771423780},
    {0.586087235467691130294144691258738, 0.169004726639267902826583426598550, 0.0},
    {0.405845151377397166906606412076961, 0.190350578064785409913256402421014,
     0.381830050505118944950369775488975},
    {0.207784955007898467600689403773245, 0.204432940075298892414161999234649, 0.0},
}};
inline constexpr double kronrod_centre = 0.209482141084727828012999174891714;
inline constexpr double gauss_centre = 0.417959183673469387755102040816327;

template <class Speed>
double integrate(const Speed& speed, double a, double b, int depth) {
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  const double centre = speed(middle);
  double fine = kronrod_centre * centre, coarse = gauss_centre * centre;
  for (const KronrodNode& node : kronrod_nodes) {
    const double pair = speed(middle - half * node.x) + speed(middle + half * node.x);
    fine += node.kronrod * pair;
    coarse += node.gauss * pair;
  }
  // The 15-point rule is far better than this difference, which is the error of the 7-point one.
  constexpr double enough = 1e-11;
  if (depth == 0 || !std::isfinite(fine) || std::abs(fine - coarse) <= enough * std::abs(fine))
    return half * fine;
  return integrate(speed, a, middle, depth - 1) + integrate(speed, middle, b, depth - 1);
}

}  // namespace detail

/// Signed length of a smooth curve between two parameters.
///
/// Formula    s = int sqrt(rho_xi . rho_xi) dxi  (KS2D:19), by a nested 7/15-point Gauss-Kronrod
///            rule that halves the interval until the rest is below 1e-14 of the length
/// Requires   finite parameters
/// Tested by  tests/unit/geometry/test_arc_length.cpp
template <std::invocable<double> Jet>
[[nodiscard]] double arc_length(const Jet& jet, double xi0, double xi1) {
  constexpr int deepest = 40;
  return detail::integrate([&jet](double xi) { return jet(xi).r1.norm(); }, xi0, xi1, deepest);
}

/// The same for a catalogue curve: exact for straight lines and circles, span by span for NURBS.
[[nodiscard]] double arc_length(const Curve& curve, double xi0, double xi1);

}  // namespace osculate::geometry
