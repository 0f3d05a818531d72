#pragma once
#include <Eigen/Core>
#include <limits>
#include <vector>

#include "osculate/body/rigid_body.hpp"
#include "osculate/body/spin.hpp"
#include "osculate/core/types.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::model {

/// Where the energy is and where it went since the first step with inertia began.
///
/// Formula    kinetic + strain + contact = start + external - friction - damping - plastic -
///            numerical - residual ; work of a step by the mean of the forces at its beginning and
///            end
struct Energies {
  double kinetic = 0;
  double strain = 0;     ///< stored in the cells
  double contact = 0;    ///< stored in the springs of the penalties, those of tied points too
  double external = 0;   ///< work of loads, gravity and supports
  double friction = 0;   ///< dissipated by sliding
  double damping = 0;    ///< dissipated by Rayleigh damping and by damping of contact
  double numerical = 0;  ///< lost by the time integration and by implicit contact forces
  double residual = 0;   ///< not accounted for
  double start = 0;      ///< kinetic + strain + contact at the beginning
  double friction_before = 0;
  double damped = 0;   ///< by damping of contact up to this state, steps without inertia included
  double elapsed = 0;  ///< time since the beginning
  double plastic = 0;  ///< dissipated in materials
  double plastic_before = 0;
};

/// The longest stable step of explicit time integration, as it was estimated last.
struct StableStep {
  double step = 0;       ///< 0: not known
  int since = 0;         ///< time steps since
  Index cell = -1;       ///< that governs it, counted through all sections
  bool contact = false;  ///< the springs of contacts govern it
  /// The longest step that keeps the energy: a point may come and go anywhere within a time step
  /// of its spring, and mass times the damping is not to turn the velocity round.
  double faithful = std::numeric_limits<double>::infinity();
};

/// What a state has in steps with inertia, over the primary dofs. The acceleration is that of all
/// forces but those of contact, unless Impact::average. Velocities of rotations in space are
/// angular velocities in space (not rates of rotation vectors); their accelerations stand in
/// `spins`.
struct Rates {
  Eigen::VectorXd velocity, acceleration;
  Eigen::VectorXd internal, external, contact, damping;  ///< forces
  std::vector<body::RotationRates<3>> spins;             ///< of the rigid bodies in space
  Energies energies;
  StableStep stable{};
  double length = 0;  ///< of the last increment, in time; 0: none yet
  [[nodiscard]] bool empty() const { return velocity.size() == 0; }
};

/// A configuration with its history. Committed states are const.
template <int Dim>
struct BasicState {
  Eigen::VectorXd u;  ///< displacements of all nodes, x0 y0 (z0) x1 y1 ...
  std::vector<body::BasicRigidMotion<Dim>> rigid;  ///< one per rigid body
  std::vector<pairing::PairState<Dim>> pairs;      ///< history of the last converged increment
  std::vector<pairing::PairMultipliers<Dim>> multipliers;  ///< of the pairs; empty by penalty
  double fraction = 0;                                     ///< of the running step
  Rates rates{};                                           ///< empty in steps without inertia
  std::vector<double> memory{};  ///< of the material points (MaterialMemory), at the last converged
                                 ///< increment
  Eigen::VectorXd constraint_forces{};  ///< multipliers of the constraints of nodes
};

/// What an iteration tries: where it is, with the history it started from, and the active set of
/// the iteration before. A type of its own, so that what is tried and what was committed cannot be
/// taken for each other; `commit` makes a state of it, nothing else does.
template <int Dim>
struct BasicTrial {
  BasicState<Dim> state;
  std::vector<pairing::ActiveSet<Dim>> active_set{};  ///< empty: of no iteration
};

using State = BasicState<2>;
using State3 = BasicState<3>;
using Trial = BasicTrial<2>;
using Trial3 = BasicTrial<3>;

}  // namespace osculate::model
