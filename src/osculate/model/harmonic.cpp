#include "osculate/model/harmonic.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace osculate::model {
namespace {

using Complex = std::complex<double>;

double angular(double frequency) { return 2 * std::numbers::pi * frequency; }

/// Place of a frequency in the range, as the tables of loads have it.
double place_in(const Harmonic& range, double frequency) {
  const double width = range.to - range.from;
  return width > 0 ? (frequency - range.from) / width : 0.0;
}

/// Appends points of an interval but the first.
void add_interval(const Harmonic& range, double a, double b, std::vector<double>& out) {
  for (int k = 1; k + 1 < range.points; ++k) {
    const double x = -1 + 2.0 * k / (range.points - 1);
    out.push_back((a + b) / 2 +
                  std::copysign(std::pow(std::abs(x), 1 / range.bias), x) * (b - a) / 2);
  }
  out.push_back(b);
}

/// Why vibrations without damping have no amplitude at this frequency; empty: they have one.
std::string endless(const Eigen::VectorXd& omega_squared, const Eigen::MatrixXcd& a, double w,
                    double frequency) {
  constexpr double near = 1e-9, free = 1e-8;
  const double largest = omega_squared.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < omega_squared.size(); ++i) {
    const double own = std::abs(omega_squared[i]);
    if (w == 0 && own <= free * largest)
      return fmt::format(
          "vibration {} is a free motion, which a force at the frequency 0 does not "
          "end: begin with a frequency above 0",
          i + 1);
    if (std::abs(a(i, i)) <= near * std::max(own, w * w))
      return fmt::format(
          "the frequency {:g} is that of vibration {}, which has no damping: its "
          "amplitude has no end",
          frequency, i + 1);
  }
  return {};
}

}  // namespace

VibrationMotion part_of(const HarmonicMotion& motion, bool imaginary) {
  const double w = angular(motion.frequency);
  const auto part = [imaginary](const Eigen::VectorXcd& v) {
    return imaginary ? Eigen::VectorXd(v.imag()) : Eigen::VectorXd(v.real());
  };
  const auto rate = [&](const Eigen::VectorXcd& v) {  // i w v
    return imaginary ? Eigen::VectorXd(w * v.real()) : Eigen::VectorXd(-w * v.imag());
  };
  VibrationMotion out{part(motion.place), rate(motion.place), -w * w * part(motion.place)};
  if (motion.carried.size() == 0) return out;
  out.carried = part(motion.carried);
  out.carried_rate = rate(motion.carried);
  out.carried_acceleration = -w * w * out.carried;
  return out;
}

std::vector<double> sweep(const Harmonic& range, const Eigen::VectorXd& omega_squared) {
  constexpr double same = 1e-9;
  std::vector<double> ends{range.from};
  for (const double value : omega_squared) {
    const double own = frequency(value);
    if (own - ends.back() > same * range.to && own < range.to * (1 - same)) ends.push_back(own);
  }
  std::vector<double> out{range.from};
  if (range.to > range.from) ends.push_back(range.to);
  for (std::size_t i = 1; i < ends.size(); ++i) add_interval(range, ends[i - 1], ends[i], out);
  return out;
}

template <int Dim>
BasicHarmonicSystem<Dim> harmonic_system(BasicSystem<Dim>& system, const Step& of,
                                         const BasicState<Dim>& standing, Vibrations modes,
                                         std::string& failure) {
  BasicHarmonicSystem<Dim> h;
  h.rest = system.initial_state();
  h.about = of.frequencies->unloaded ? h.rest : standing;
  h.modes = std::move(modes);
  if (h.modes.omega_squared.size() == 0) failure = "there are no vibrations";
  if (failure.empty() && !h.modes.omega_squared.allFinite()) failure = "vibrations are no numbers";
  h.dampers = system.dampers_on(h.modes, h.about);
  return h;
}

template <int Dim>
void begin_harmonic_step(BasicSystem<Dim>& system, const Step& step, const la::MakeSolver& solver,
                         BasicHarmonicSystem<Dim>& h, std::string& failure) {
  h.parts = {step, *step.harmonic->imaginary};
  h.supports.clear();
  for (const bool imaginary : {false, true}) {
    const Step& whole = h.parts[imaginary ? 1 : 0];
    std::vector<Amplitude> tables;
    for (const PrescribedDof& p : whole.prescribed)
      if (!p.hold && std::ranges::find(tables, p.ramp.amplitude) == tables.end())
        tables.push_back(p.ramp.amplitude);
    for (const Amplitude& table : tables) {
      Step moving = whole;
      for (PrescribedDof& p : moving.prescribed) {
        p.hold = p.hold || p.ramp.amplitude != table;
        p.ramp.amplitude.clear();
        p.ramp.target += system.value(h.about, p.dof);
      }
      system.begin_step(moving, h.about);
      const std::unique_ptr<la::LinearSolver> own = solver();
      Swung swung{system.carried_along(h.about, *own, failure), {}, {}, {1, 1, table}, imaginary};
      if (!failure.empty()) return;
      if (swung.motion.isZero(0)) continue;
      swung.momenta = system.momenta_along(h.modes, h.about, swung.motion);
      swung.drag = system.drag_along(h.modes, h.about, swung.motion);
      h.supports.push_back(std::move(swung));
    }
  }
}

template <int Dim>
HarmonicMotion harmonic_response(BasicSystem<Dim>& system, const BasicHarmonicSystem<Dim>& h,
                                 double frequency, std::string& failure) {
  const Harmonic& range = *h.parts[0].harmonic;
  const double w = angular(frequency), place = place_in(range, frequency);
  const Eigen::VectorXd& squares = h.modes.omega_squared;
  Eigen::MatrixXcd a = Complex(0, w) * h.dampers;
  for (Eigen::Index i = 0; i < squares.size(); ++i)
    a(i, i) += Complex(squares[i] - w * w,
                       w * damping_of(range.damping, static_cast<std::size_t>(i), squares[i]));
  failure = endless(squares, a, w, frequency);
  if (!failure.empty()) return {};
  Eigen::VectorXcd force(squares.size());
  system.begin_step(h.parts[0], h.about);
  force.real() = system.forces_on(h.modes, h.about, place);
  system.begin_step(h.parts[1], h.about);
  force.imag() = system.forces_on(h.modes, h.about, place);
  HarmonicMotion out{frequency, {}};
  for (const Swung& support : h.supports) {
    const Complex s =
        support.factor.value(place) * (support.imaginary ? Complex(0, 1) : Complex(1));
    force += s * (Complex(w * w, -w * range.damping.mass) * support.momenta -
                  Complex(0, w) * support.drag);
    if (out.carried.size() == 0) out.carried.setZero(support.motion.size());
    out.carried += s * support.motion;
  }
  out.place = h.dampers.isZero(0) ? Eigen::VectorXcd(force.array() / a.diagonal().array())
                                  : Eigen::VectorXcd(a.partialPivLu().solve(force));
  if (!out.place.allFinite()) failure = "amplitudes are too large for a number";
  return out;
}

template <int Dim>
Superposed<Dim> harmonic_part(BasicSystem<Dim>& system, const BasicHarmonicSystem<Dim>& h,
                              const HarmonicMotion& motion, bool imaginary) {
  Superposed<Dim> out;
  const double place = place_in(*h.parts[0].harmonic, motion.frequency);
  system.begin_step(h.parts[imaginary ? 1 : 0], h.rest);
  out.state = system.moved_along(h.modes, h.rest, part_of(motion, imaginary), place);
  if (!out.state.u.allFinite()) {
    out.failure = "amplitudes are too large for a number";
    return out;
  }
  system.evaluate(out.state, place, false, out.evaluation);
  if (!out.evaluation.ok) out.failure = out.evaluation.message;
  system.add_inertia_of(out.state);
  return out;
}

template struct BasicHarmonicSystem<2>;
template struct BasicHarmonicSystem<3>;
template BasicHarmonicSystem<2> harmonic_system(System&, const Step&, const State&, Vibrations,
                                                std::string&);
template BasicHarmonicSystem<3> harmonic_system(System3&, const Step&, const State3&, Vibrations,
                                                std::string&);
template void begin_harmonic_step(System&, const Step&, const la::MakeSolver&,
                                  BasicHarmonicSystem<2>&, std::string&);
template void begin_harmonic_step(System3&, const Step&, const la::MakeSolver&,
                                  BasicHarmonicSystem<3>&, std::string&);
template HarmonicMotion harmonic_response(System&, const BasicHarmonicSystem<2>&, double,
                                          std::string&);
template HarmonicMotion harmonic_response(System3&, const BasicHarmonicSystem<3>&, double,
                                          std::string&);
template Superposed<2> harmonic_part(System&, const BasicHarmonicSystem<2>&, const HarmonicMotion&,
                                     bool);
template Superposed<3> harmonic_part(System3&, const BasicHarmonicSystem<3>&, const HarmonicMotion&,
                                     bool);

}  // namespace osculate::model
