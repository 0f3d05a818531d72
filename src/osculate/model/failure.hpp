#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "osculate/model/beyond_slave.hpp"
#include "osculate/model/failure_contact.hpp"
#include "osculate/solve/increments.hpp"

namespace osculate::model {

/// Why an increment fails for good. In the order in which they are looked for: the first that
/// applies is named.
enum class FailureCause {
  over_constrained,     ///< multipliers of contact points whose gap is prescribed
  initial_overlap,      ///< nothing has moved yet, and the slave is deep in the master
  beyond_slave,         ///< a body goes into a master beside its slave set
  inverted_element,     ///< an element is turned inside out
  sliding_motion,       ///< a body in contact is free to slide: without friction, or too little
  free_motion,          ///< nothing resists a rigid motion of a body
  stiffness_ratio,      ///< contact so stiff that the digits do not suffice
  flipping,             ///< contact points change between states for ever
  instability,          ///< the tangent has lost its positive definiteness: snap-through, buckling
  unstable_time_step,   ///< of explicit time integration
  too_large_increment,  ///< none of these
  no_equilibrium        ///< nor does the increment's size matter
};
[[nodiscard]] std::string_view cause_name(FailureCause cause);

/// A contact point that changed its state at least twice in the last iterations.
struct FlippingPoint {
  std::string pair;
  Index node = -1;     ///< of the slave, the nearest one
  std::string states;  ///< of the last iterations, e.g. `open, stick, open, stick`
  int changes = 0;
};

/// What is known of an increment that failed for good.
template <int Dim>
struct BasicFailure {
  FailureCause cause = FailureCause::too_large_increment;
  std::string reason;    ///< of the solver
  std::string message;   ///< one paragraph: what happened, the cause, what to change
  std::string proposal;  ///< the one change
  std::vector<FlippingPoint> flips;
  std::vector<BasicFreeMotion<Dim>> motions;
  bool pulled = false;           ///< the loads pull the first of these bodies off what it touches
  std::vector<HeldPoints> held;  ///< of the last iterate
  InitialOverlap overlap;        ///< the deepest, where it has to be pushed out at once
  std::vector<BeyondSlave> beyond;  ///< at the last converged state
  double stiffness_ratio = 0;       ///< largest of contact to bulk stiffness on the diagonal
  /// Of the tangent's upper triangle at the last converged state, or, where small increments fail
  /// too, at the last iterate.
  int negative_pivots = 0;
  bool softened = false;  ///< next to nothing resists the increment: a limit point is near
  double last_step = 0;   ///< largest displacement of the last iterate, over the model's size
  Index last_node = -1;   ///< where
  double smallest = 1;    ///< increment tried, over one of the step's
};

/// Looks for the cause in the last attempt: its message, the tangent at the last converged state,
/// the states of the contact points in its last iterations.
///
/// Tested by  tests/system/test_diagnosis.py
template <int Dim>
[[nodiscard]] BasicFailure<Dim> diagnose(
    BasicSystem<Dim>& system, const BasicModel<Dim>& model, const Step& step,
    const solve::StepResult<BasicState<Dim>, BasicTrial<Dim>>& result);

/// Why explicit time integration ended before its time, at a fraction of the step.
///
/// Tested by  tests/unit/deck/test_explicit.cpp
template <int Dim>
[[nodiscard]] BasicFailure<Dim> explicit_failure(const Step& step, solve::TimeStepping outcome,
                                                 const std::string& reason, double fraction);

/// The motion at the nodes of its body, its largest vector of length 1; zero elsewhere.
template <int Dim>
[[nodiscard]] std::vector<Vec<Dim>> motion_field(const BasicModel<Dim>& model,
                                                 const BasicState<Dim>& state,
                                                 const BasicFreeMotion<Dim>& motion);

using Failure = BasicFailure<2>;
using Failure3 = BasicFailure<3>;

}  // namespace osculate::model
