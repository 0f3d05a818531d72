#include "osculate/material/relaxing.hpp"

#include <cmath>

namespace osculate::material {
namespace {

/// Of two symmetric tensors by their components.
double contracted(const Vec<6>& a, const Vec<6>& b) {
  return a.head<3>().dot(b.head<3>()) + 2 * a.tail<3>().dot(b.tail<3>());
}

/// Parts of a law of which `shape` is the whole.
Parts as_one(const Response3& whole, double energy, const Strain3& e) {
  Parts out{whole, energy, 0, {}};
  if (!whole.ok) return out;
  out.log_j = log_volume_ratio(e);
  // S : C , with C = I + 2 E
  out.volume.pull = (whole.stress.head<3>().sum() + 2 * whole.stress.dot(e)) / 3;
  return out;
}

/// What of a term is left after x = t / tau.
struct Fading {
  double left;  ///< of what was there
  double mean;  ///< of what came evenly
  double work;  ///< work on what came evenly, by that without relaxation: 2 (1 - mean) / x
  double lost;  ///< of its energy: 1 - left^2
};
Fading fading_of(double x) {
  Fading f{std::exp(-x), left_in_the_mean(x), 0, -std::expm1(-2 * x)};
  constexpr double loses_digits = 0.5;
  if (x > loses_digits) {
    f.work = 2 * (1 - f.mean) / x;
    return f;
  }
  constexpr int terms = 14;
  double term = 1;  // 2 (-x)^k / (k + 2)!
  for (int k = 1; k <= terms; ++k) {
    f.work += term;
    term *= -x / (k + 2);
  }
  return f;
}

/// What a point is at a strain, and what a point remembers of it.
struct Point {
  Vec<6> stretch = Vec<6>::Zero();  ///< C J^(-2/3) - I
  Vec<6> shape = Vec<6>::Zero();    ///< T
  double log_j = 0, pull = 0, shape_energy = 0, volume_energy = 0;
};
constexpr Eigen::Index first_of_point = 1;
Point point_of(const double* state) {
  if (!state) return {};
  const double* const s = state + first_of_point;
  return {Eigen::Map<const Vec<6>>(s), Eigen::Map<const Vec<6>>(s + 6), s[12], s[13], s[14], s[15]};
}
void remember(const Point& p, double* state) {
  double* const s = state + first_of_point;
  Eigen::Map<Vec<6>>{s} = p.stretch;
  Eigen::Map<Vec<6>>{s + 6} = p.shape;
  s[12] = p.log_j;
  s[13] = p.pull;
  s[14] = p.shape_energy;
  s[15] = p.volume_energy;
}
Point point_of(bool as_one, const Strain3& e, const Parts& of, const Vec<6>& inv) {
  Point p;
  const double shrink = std::exp(-2.0 / 3 * of.log_j);
  p.stretch = shrink * e;
  p.stretch.head<3>() *= 2;
  p.stretch.head<3>().array() += std::expm1(-2.0 / 3 * of.log_j);
  p.shape = of.shape.stress;
  if (as_one) p.shape -= of.volume.pull * inv;
  p.shape /= shrink;
  p.log_j = of.log_j;
  p.pull = of.volume.pull;
  p.shape_energy = of.shape_energy;
  p.volume_energy = of.volume.energy;
  return p;
}

/// From one state of a point to another: work of the stress at once in the state before, and what
/// is of second order.
struct Way {
  Vec<6> half_stretch;  ///< half the change of C J^(-2/3)
  double log_j, shape_rest, volume_rest;
};
Way way_of(bool as_one, const Point& from, const Point& to) {
  Way way{0.5 * (to.stretch - from.stretch), to.log_j - from.log_j, 0, 0};
  way.shape_rest = to.shape_energy - from.shape_energy - contracted(from.shape, way.half_stretch);
  way.volume_rest = to.volume_energy - from.volume_energy - from.pull * way.log_j;
  if (as_one) {
    way.shape_rest += way.volume_rest;
    way.volume_rest = 0;
  }
  return way;
}

/// An overstress h of N components and its energy, one behind the other.
template <int N>
struct Term {
  Vec<N> stress = Vec<N>::Zero();
  double energy = 0;
};
template <int N>
Term<N> term_of(const double* state, std::size_t offset) {
  if (!state) return {};
  return {Eigen::Map<const Vec<N>>(state + offset), state[offset + N]};
}
/// The terms of one modulus, all together.
template <int N>
struct Terms {
  double slope = 1;                   ///< of the stress by that at once
  Vec<N> fixed = Vec<N>::Zero();      ///< stress = slope * that at once + fixed
  double stored = 0, dissipated = 0;  ///< energy of the terms, and lost in the increment
};
/// Goes on by an increment and writes the terms to `next`, if that is asked for.
///
/// Formula    energies: U -> exp(-2 x) U + share (exp(-x) m w + m^2 r) , lost: (1 - exp(-2 x)) U +
///            share (m (1 - exp(-x)) w + (2 (1 - m) / x - m^2) r) , m = (1 - exp(-x)) / x , w the
///            work of h, r that of the change of the stress at once: dU/dt = h de/dt - 2 U / tau
template <int N, class WorkOf>
Terms<N> terms_after(const core::Table& series, const Memory& memory, std::size_t offset,
                     const Vec<N>& before, const Vec<N>& now, double rest_of_work,
                     const WorkOf& work_of) {
  Terms<N> out;
  out.slope = remaining(series);
  for (std::size_t i = 0; i < series.size(); ++i, offset += relaxing_each) {
    const auto [share, time] = series[i];
    const double x = memory.duration / time;
    const Fading f = fading_of(x);
    const Term<N> was = term_of<N>(memory.committed, offset);
    const double work = share * work_of(was.stress), rest = share * rest_of_work;
    const Vec<N> fixed = f.left * was.stress - f.mean * before;
    const double energy =
        (1 - f.lost) * was.energy + f.left * f.mean * work + f.mean * f.mean * rest;
    out.slope += share * f.mean;
    out.fixed += share * fixed;
    out.stored += energy;
    out.dissipated +=
        f.lost * was.energy + x * f.mean * f.mean * work + (f.work - f.mean * f.mean) * rest;
    if (!memory.next) continue;
    Eigen::Map<Vec<N>>(memory.next + offset) = fixed + f.mean * now;
    memory.next[offset + N] = energy;
  }
  return out;
}

/// Shape and volume after an increment.
struct After {
  Terms<6> shape;
  Terms<1> volume;
};
After after_increment(const Relaxation& series, bool as_one, const Point& now,
                      const Memory& memory) {
  const Point before = point_of(memory.committed);
  const Way way = way_of(as_one, before, now);
  return {
      terms_after<6>(series.shear, memory, relaxing_own, before.shape, now.shape, way.shape_rest,
                     [&](const Vec<6>& h) { return contracted(h, way.half_stretch); }),
      terms_after<1>(series.bulk, memory, relaxing_own + 7, Vec<1>(before.pull), Vec<1>(now.pull),
                     way.volume_rest, [&](const Vec<1>& p) { return p[0] * way.log_j; })};
}

/// Adds J^(-2/3) DEV(A) of a constant A and its derivative.
///
/// Formula    the gradient of J^(-2/3) A : C / 2 by E, and its gradient
void add_deviator(const Vec<6>& a, const Strain3& e, double log_j, const Vec<6>& inv,
                  const Tangent3& squared, Response3& to) {
  const double shrink = std::exp(-2.0 / 3 * log_j);
  const double trace = a.head<3>().sum() + 2 * a.dot(e);  // A : C
  to.stress += shrink * (a - trace / 3 * inv);
  to.tangent += shrink * (-2.0 / 3 * (a * inv.transpose() + inv * a.transpose()) +
                          2.0 / 9 * trace * inv * inv.transpose() + 2.0 / 3 * trace * squared);
}

}  // namespace

Parts parts_of(const Ogden& law, const Strain3& e) {
  const LogarithmicStrain strain(e);
  if (!strain.ok()) return {{false}};
  const PrincipalStrain principal = strain.principal();
  AlongAxes w = along_axes(law, principal);
  const OfVolume volume = w.volume;
  w.volume = {};
  return {response_of_axes(strain, w), w.energy, principal.value.sum(), volume};
}
Parts parts_of(const NeoHooke& law, const Strain3& e) {
  return as_one(respond(law, e), energy_of(law, e), e);
}
Parts parts_of(const Hyperfoam& law, const Strain3& e) {
  return as_one(respond(law, e), energy_of(law, e), e);
}

Response3 detail::relaxed(const Relaxation& series, bool as_one, const Strain3& strain,
                          const Parts& at_once, const Memory& memory) {
  if (!at_once.shape.ok) return {false};
  const Vec<6> inv = inverse_stretch(strain);
  const Tangent3 squared = square(inv);
  const Point now = point_of(as_one, strain, at_once, inv);
  const After after = after_increment(series, as_one, now, memory);
  Response3 r;
  r.stress = after.shape.slope * at_once.shape.stress;
  r.tangent = after.shape.slope * at_once.shape.tangent;
  add_deviator(after.shape.fixed, strain, now.log_j, inv, squared, r);
  double pull = after.volume.fixed[0];
  if (!as_one) {
    pull += after.volume.slope * now.pull;
    r.tangent += after.volume.slope * at_once.volume.slope * inv * inv.transpose();
  }
  r.stress += pull * inv;
  r.tangent -= 2 * pull * squared;
  r.ok = r.stress.allFinite() && r.tangent.allFinite();
  if (!memory.next) return r;
  memory.next[0] = (memory.committed ? memory.committed[0] : 0) + after.shape.dissipated +
                   after.volume.dissipated;
  remember(now, memory.next);
  return r;
}

double detail::relaxed_energy(const Relaxation& series, bool as_one, const Strain3& strain,
                              const Parts& at_once, const Memory& memory) {
  if (!at_once.shape.ok) return std::numeric_limits<double>::infinity();
  const Point now = point_of(as_one, strain, at_once, inverse_stretch(strain));
  const After after = after_increment(series, as_one, now, {memory.committed, nullptr});
  return remaining(series.shear) * now.shape_energy + remaining(series.bulk) * now.volume_energy +
         after.shape.stored + after.volume.stored;
}

}  // namespace osculate::material
