#include "osculate/model/superposition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "osculate/solve/oscillator.hpp"

namespace osculate::model {
namespace {

/// Which points of all pairs are in contact in the last evaluation.
template <int Dim>
std::vector<bool> touching_in(const BasicSystem<Dim>& system) {
  std::vector<bool> out;
  for (const pairing::PairEvaluation<Dim>& pair : system.contact())
    for (const pairing::PointResult<Dim>& point : pair.points)
      out.push_back(point.status != contact::Status::open);
  return out;
}

/// How many contact points do something else than at the state: open, close, or slip.
template <int Dim>
std::size_t others(const BasicSystem<Dim>& system, const BasicSuperposition<Dim>& motion) {
  const std::vector<bool> now = touching_in(system);
  if (now.size() != motion.touching.size()) return now.size();
  std::size_t count = 0, at = 0;
  for (std::size_t p = 0; p < system.contact().size(); ++p)
    for (const pairing::PointResult<Dim>& point : system.contact()[p].points) {
      const bool slips = motion.rubs[p] && point.status == contact::Status::slip;
      if (slips || now[at] != motion.touching[at]) ++count;
      ++at;
    }
  return count;
}

/// Ends of the straight pieces that loads have between two fractions of a step, with both.
std::vector<double> pieces(const Step& step, double from, double to) {
  std::vector<double> ends{to};
  const auto add = [&](const Ramp& ramp) {
    for (const auto& [fraction, factor] : ramp.amplitude)
      if (fraction > from && fraction < to) ends.push_back(fraction);
  };
  for (const DeadLoad& load : step.dead) add(load.ramp);
  for (const PressureLoad& load : step.pressure) add(load.ramp);
  for (const CentrifugalLoad& load : step.centrifugal) add(load.ramp);
  for (const PrescribedDof& p : step.prescribed) add(p.ramp);
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

solve::Oscillator oscillator(const ModalDamping& damping, std::size_t mode, double omega_squared,
                             double dampers) {
  return {damping_of(damping, mode, omega_squared) + dampers, omega_squared};
}

/// phi . C phi of dampers, which must not make one vibration of another.
std::vector<double> damped_alone(const Eigen::MatrixXd& c, std::string& failure) {
  constexpr double rounding = 1e-9;
  std::vector<double> out;
  for (Eigen::Index i = 0; i < c.rows(); ++i) out.push_back(c(i, i));
  const double between = (c - Eigen::MatrixXd(c.diagonal().asDiagonal())).norm();
  if (between > rounding * c.norm())
    failure = "dampers join its vibrations, which move one by one here: use `dynamics`";
  return out;
}

}  // namespace

double damping_of(const ModalDamping& damping, std::size_t mode, double omega_squared) {
  const double positive = std::max(0.0, omega_squared);
  double ratio = damping.ratio;
  for (const ModalDamping::Ratio& r : damping.ratios)
    if (mode + 1 >= r.first && mode + 1 <= r.last) ratio = r.ratio;
  return 2 * ratio * std::sqrt(positive) + damping.mass + damping.stiffness * positive;
}

namespace {

/// Rates of vibrations from velocities that were given, where no step in time has had them.
///
/// Formula    q' = phi . M v
template <int Dim>
Eigen::VectorXd first_rates(const BasicModel<Dim>& model, BasicSystem<Dim>& system,
                            const BasicSuperposition<Dim>& motion) {
  const bool had =
      std::ranges::any_of(model.steps, [](const Step& s) { return s.dynamics.has_value(); });
  if (had || model.initial_velocity.empty())
    return Eigen::VectorXd::Zero(motion.modes.omega_squared.size());
  Eigen::VectorXd velocity = Eigen::VectorXd::Zero(system.dofs().dofs());
  for (const auto& [dof, value] : model.initial_velocity) velocity[dof] = value;
  return system.momenta_along(motion.modes, motion.about, velocity);
}

}  // namespace

template <int Dim>
BasicSuperposition<Dim> superposition(const BasicModel<Dim>& model, BasicSystem<Dim>& system,
                                      const Step& step, const BasicState<Dim>& standing,
                                      Vibrations modes, std::string& failure) {
  BasicSuperposition<Dim> motion;
  for (const BasicContactPair<Dim>& pair : model.pairs)
    motion.rubs.push_back(pair.definition.friction.has_value());
  motion.standing = standing;
  motion.about = step.frequencies->unloaded ? system.initial_state() : standing;
  motion.modes = std::move(modes);
  const Eigen::Index count = motion.modes.omega_squared.size();
  motion.now = {Eigen::VectorXd::Zero(count), first_rates(model, system, motion),
                Eigen::VectorXd::Zero(count)};
  motion.resting = system.forces_on(motion.modes, motion.about, 1.0);
  motion.dampers = damped_alone(system.dampers_on(motion.modes, motion.about), failure);
  solve::Evaluation at_rest;
  system.evaluate(motion.about, 1.0, false, at_rest);
  motion.touching = touching_in(system);
  return motion;
}

template <int Dim>
void carry(BasicSystem<Dim>& system, const Step& step, la::LinearSolver& solver,
           BasicSuperposition<Dim>& motion, std::string& failure) {
  std::vector<Amplitude> tables;
  for (const PrescribedDof& p : step.prescribed)
    if (!p.hold && std::ranges::find(tables, p.ramp.amplitude) == tables.end())
      tables.push_back(p.ramp.amplitude);
  for (const Amplitude& table : tables) {
    if (!table.empty() && !(table.front().second == 0 && table.front().first == 0)) {
      failure = "a support jumps: its amplitude must begin with 0";
      return;
    }
    Step part = step;
    for (PrescribedDof& p : part.prescribed) {
      if (!table.empty() && !p.hold && p.ramp.amplitude == table &&
          system.value(motion.about, p.dof) != 0) {
        failure = "a support has moved before: it may go on without an amplitude only";
        return;
      }
      p.hold = p.hold || p.ramp.amplitude != table;
      p.ramp.amplitude.clear();
    }
    system.begin_step(part, motion.about);
    Carried carried{system.carried_along(motion.about, solver, failure), {}, {0, 1, table}};
    if (!failure.empty()) return;
    if (carried.motion.isZero(0)) continue;
    if (std::ranges::any_of(motion.dampers, [](double c) { return c != 0; }))
      failure = "supports move, and dampers of springs with them: use `dynamics`";
    carried.momenta = system.momenta_along(motion.modes, motion.about, carried.motion);
    motion.carried.push_back(std::move(carried));
  }
}

namespace {

/// The supports go on for h to a fraction of the step: the impulse at its beginning, and the force
/// of the damping by mass until then.
Eigen::VectorXd go_on(double from, double end, double h, double by_mass,
                      std::vector<Carried>& supports, VibrationMotion& now) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(now.rate.size());
  for (std::size_t i = 0; i < supports.size(); ++i) {
    Carried& s = supports[i];
    const double factor = s.factor.value(end), slope = (factor - s.factor.value(from)) / h;
    now.rate -= (slope - s.slope) * s.momenta;
    force -= by_mass * slope * s.momenta;
    s.slope = slope;
    if (i == 0) now.carried = now.carried_rate = Eigen::VectorXd::Zero(s.motion.size());
    now.carried += factor * s.motion;
    now.carried_rate += slope * s.motion;
  }
  return force;
}

}  // namespace

template <int Dim>
void advance(BasicSystem<Dim>& system, const Step& step, int increment,
             BasicSuperposition<Dim>& motion) {
  double from = static_cast<double>(increment) / step.increments;
  const double to = static_cast<double>(increment + 1) / step.increments;
  VibrationMotion& now = motion.now;
  Eigen::VectorXd force = system.forces_on(motion.modes, motion.about, from) - motion.resting;
  for (const double end : pieces(step, from, to)) {
    const Eigen::VectorXd next = system.forces_on(motion.modes, motion.about, end) - motion.resting;
    const double h = (end - from) * step.duration;
    const Eigen::VectorXd dragged =
        go_on(from, end, h, step.modal->mass, motion.carried, motion.now);
    for (Eigen::Index i = 0; i < now.place.size(); ++i) {
      const auto mode = static_cast<std::size_t>(i);
      const solve::Oscillator o =
          oscillator(*step.modal, mode, motion.modes.omega_squared[i], motion.dampers[mode]);
      const solve::OscillatorMotion q =
          solve::moved(o, solve::impulse_response(o, h), h, {now.place[i], now.rate[i]},
                       force[i] + dragged[i], next[i] + dragged[i]);
      now.place[i] = q.place;
      now.rate[i] = q.rate;
      now.acceleration[i] = next[i] + dragged[i] - o.c * q.rate - o.k * q.place;
    }
    motion.elapsed += h;
    force = next;
    from = end;
  }
}

template <int Dim>
Superposed<Dim> superposed(BasicSystem<Dim>& system, double fraction,
                           const BasicSuperposition<Dim>& motion) {
  Superposed<Dim> out;
  out.state = system.moved_along(motion.modes, motion.about, motion.now, fraction);
  out.state.rates.energies.elapsed = motion.elapsed;
  if (!out.state.u.allFinite()) {
    out.failure = "the superposed displacements are too large for a number";
    return out;
  }
  system.evaluate(out.state, fraction, false, out.evaluation);
  if (!out.evaluation.ok) {
    out.failure = out.evaluation.message;
    return out;
  }
  system.add_inertia_of(out.state);
  if (const std::size_t count = others(system, motion); count > 0)
    out.failure = fmt::format(
        "{} contact points open, close or slip, but vibrations keep contacts as they are: use "
        "`dynamics`",
        count);
  return out;
}

template struct BasicSuperposition<2>;
template struct BasicSuperposition<3>;
template BasicSuperposition<2> superposition(const Model&, System&, const Step&, const State&,
                                             Vibrations, std::string&);
template BasicSuperposition<3> superposition(const Model3&, System3&, const Step&, const State3&,
                                             Vibrations, std::string&);
template void carry(System&, const Step&, la::LinearSolver&, BasicSuperposition<2>&, std::string&);
template void carry(System3&, const Step&, la::LinearSolver&, BasicSuperposition<3>&, std::string&);
template void advance(System&, const Step&, int, BasicSuperposition<2>&);
template void advance(System3&, const Step&, int, BasicSuperposition<3>&);
template Superposed<2> superposed(System&, double, const BasicSuperposition<2>&);
template Superposed<3> superposed(System3&, double, const BasicSuperposition<3>&);

}  // namespace osculate::model
