#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "../cases.hpp"
#include "osculate/body/spin.hpp"

namespace osculate::verification {
namespace {

using body::RotationScheme;
constexpr const char* euler = "Landau, Lifshitz, Mechanics, section 37";
const Vec3 moments(1, 2, 3), start(1, 0, 0.58);

struct Top {
  body::RigidMotion3 motion;
  body::RotationRates<3> rates;
};

Mat<3, 3> inertia() { return moments.asDiagonal(); }

/// Period of w_1 and w_2 of Euler's free top from w = (w_1, 0, w_3) with L^2 > 2 E J_2.
double period() {
  const Vec3& i = moments;
  const double twice_e = i.dot(start.cwiseAbs2()), l2 = i.cwiseAbs2().dot(start.cwiseAbs2());
  const double a = twice_e * i[2] - l2, b = l2 - twice_e * i[0];
  const double rate = std::sqrt((i[2] - i[1]) * b / i.prod());
  const double modulus = std::sqrt((i[1] - i[0]) * a / ((i[2] - i[1]) * b));
  return 4 * std::comp_ellint_1(modulus) / rate;
}

Top step(const Top& top, const RotationScheme& scheme) {
  Top next = top;
  next.motion.rotation = body::predicted_turn(top.motion, top.rates, scheme.step);
  const double size = (inertia() * top.rates.velocity).norm() / scheme.step;
  for (int i = 0; i < 20; ++i) {
    const body::InertiaMoment<3> now =
        body::inertia_moment(inertia(), top.rates, scheme, top.motion, next.motion);
    next.rates = now.rates;
    if (now.moment.norm() < 1e-15 * size) break;
    const body::RotationForce<3> force =
        body::rotation_force(next.motion, now.moment, now.gradient);
    next.motion.rotation -= force.tangent.inverse() * force.force;
  }
  next.motion = body::rebased(next.motion, 0.0);
  return next;
}

struct Run {
  double momentum = 0;  ///< largest change of the momentum, relative
  double energy = 0;    ///< largest change of the energy, relative
  double gain = 0;      ///< largest gain in a step of the energy that the scheme carries, relative
  double lost = 0;      ///< energy at the end, relative
  double flip = 0;      ///< time of the last flip
};

/// Time within a step at which w_2 is zero, by the cubic through values and rates at both ends.
double edge_contact(double h, double a, double da, double b, double db) {
  double s = a / (a - b);
  for (int i = 0; i < 20; ++i) {
    const double t = 1 - s;
    const double value =
        a * t * t * (1 + 2 * s) + b * s * s * (1 + 2 * t) + h * (da * s * t * t - db * s * s * t);
    const double slope = 6 * s * t * (b - a) + h * (da * t * (t - 2 * s) - db * s * (2 * t - s));
    s -= value / slope;
  }
  return s * h;
}

/// `flips` counts the changes of sign of w_2 after the start, two a period.
Run run(RotationScheme scheme, int steps_a_period, int flips) {
  scheme.step = period() / steps_a_period;
  Top top;
  top.rates = body::initial_rates(inertia(), top.motion, start, Vec3::Zero());
  const Vec3 l = body::angular_momentum(inertia(), top.motion, top.rates);
  const double e = body::rotation_energy(inertia(), top.rates);
  const double share = 0.5 * scheme.step * scheme.step * (scheme.beta - 0.5 * scheme.gamma);
  const auto carried = [&](const body::RotationRates<3>& rates) {
    return body::rotation_energy(inertia(), rates) +
           share * rates.acceleration.dot(inertia() * rates.acceleration);
  };
  Run out;
  for (int i = 0, seen = 0; seen < flips && i < steps_a_period * flips; ++i) {
    const Top next = step(top, scheme);
    const double now = body::rotation_energy(inertia(), next.rates) / e - 1;
    const Vec3 change = body::angular_momentum(inertia(), next.motion, next.rates) - l;
    out.momentum = std::max(out.momentum, change.norm() / l.norm());
    out.energy = std::max(out.energy, std::abs(now));
    out.gain = std::max(out.gain, (carried(next.rates) - carried(top.rates)) / e);
    out.lost = -now;
    const double a = top.rates.velocity[1], b = next.rates.velocity[1];
    if (i > 0 && a * b < 0) {
      ++seen;
      out.flip = i * scheme.step + edge_contact(scheme.step, a, top.rates.acceleration[1], b,
                                                next.rates.acceleration[1]);
    }
    top = next;
  }
  return out;
}

}  // namespace

CaseResult free_top(const CaseContext&) {
  constexpr RotationScheme conserving{0, 0.5, 0.25, 0.5};
  constexpr RotationScheme dissipative{0, 0, 4.0 / 9, 5.0 / 6};  // spectral radius 1/2
  CaseResult result;
  const Run kept = run(conserving, 150, 20), lossy = run(dissipative, 150, 20);
  result.rows = {
      {"change of momentum in space", kept.momentum, 1e-12, Relation::at_most, 0, "exact"},
      {"change of energy", kept.energy, 1e-12, Relation::at_most, 0, "exact"},
      {"dissipative: change of momentum", lossy.momentum, 1e-12, Relation::at_most, 0, "exact"},
      {"dissipative: gain of carried energy in a step", lossy.gain, 1e-14, Relation::at_most, 0,
       "docs/decisions/022"},
      {"dissipative: energy lost in 10 periods", lossy.lost, 0, Relation::info, 0, ""},
  };
  const double exact = 2 * period();
  const double coarse = run(conserving, 600, 4).flip / exact - 1;
  const double fine = run(conserving, 1200, 4).flip / exact - 1;
  result.rows.push_back(
      {"600 steps a period: time of 4 flips / exact", coarse + 1, 1, Relation::info, 0, euler});
  result.rows.push_back(
      {"1200 steps a period: time of 4 flips / exact", fine + 1, 1, Relation::equal, 1e-3, euler});
  result.rows.push_back(
      {"order of its error", std::log2(coarse / fine), 2, Relation::equal, 0.05, euler});
  return result;
}

}  // namespace osculate::verification
