#pragma once
#include <vector>

#include "osculate/model/system.hpp"

namespace osculate::model {

/// What supports that move by one table make of everything without inertia.
struct Carried {
  Eigen::VectorXd motion;   ///< of all nodes and rigid bodies, at the factor 1
  Eigen::VectorXd momenta;  ///< phi . M motion
  Ramp factor;
  double slope = 0;  ///< of the factor over time, in the last piece
};

/// A linear motion about a state, as amounts of its vibrations.
///
/// Formula    q'' + c q' + omega^2 q = phi . (loads - loads at the state) for each vibration phi;
///            c = 2 ratio omega + mass + stiffness omega^2 + phi . C phi , C of the dampers
///            Where supports move as r s(t), r what they do without inertia: u = phi q + r s, and
///            the force -phi . M r (s'' + mass s'); s is straight in pieces, so that s'' is one
///            impulse at each corner
/// Sign       nothing but the vibrations moves: no part of the others, not even a static one
/// Source     of moving supports: Clough & Penzien 1975, chapter 27
///
/// Tested by  tests/unit/deck/test_modal.cpp, verification/modal_dynamics
template <int Dim>
struct BasicSuperposition {
  BasicState<Dim> standing;  ///< that the steps before led to, and that others go on from
  BasicState<Dim> about;     ///< of the vibrations: this one, or that before the first step
  Vibrations modes;
  Eigen::VectorXd resting;     ///< forces of the loads at the state
  std::vector<bool> rubs;      ///< by pair: it has friction
  std::vector<bool> touching;  ///< the points in contact there
  double elapsed = 0;          ///< time since they were at rest
  VibrationMotion now{};       ///< of the end of the last increment
  std::vector<Carried> carried{};
  std::vector<double> dampers{};  ///< phi . C phi
};

/// c of a vibration, counted from 0: 2 ratio omega + mass + stiffness omega^2.
[[nodiscard]] double damping_of(const ModalDamping& damping, std::size_t mode,
                                double omega_squared);

/// At rest, of vibrations that `step` has found (the running one, begun from `standing`). Its
/// loads are those at the state. `failure`: why it cannot be; empty: it can.
template <int Dim>
[[nodiscard]] BasicSuperposition<Dim> superposition(const BasicModel<Dim>& model,
                                                    BasicSystem<Dim>& system, const Step& step,
                                                    const BasicState<Dim>& standing,
                                                    Vibrations modes, std::string& failure);

/// Lets supports move as the step prescribes, which is begun for that: to be begun again.
template <int Dim>
void carry(BasicSystem<Dim>& system, const Step& step, la::LinearSolver& solver,
           BasicSuperposition<Dim>& motion, std::string& failure);

/// Moves it over an increment of the running step, counted from 0. Loads are straight between the
/// corners of their tables: exact.
template <int Dim>
void advance(BasicSystem<Dim>& system, const Step& step, int increment,
             BasicSuperposition<Dim>& motion);

/// A state in the motion, and its evaluation.
template <int Dim>
struct Superposed {
  BasicState<Dim> state;
  solve::Evaluation evaluation;
  std::string failure;  ///< why it is none; empty: it is one
};
template <int Dim>
[[nodiscard]] Superposed<Dim> superposed(BasicSystem<Dim>& system, double fraction,
                                         const BasicSuperposition<Dim>& motion);

}  // namespace osculate::model
