#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "osculate/la/linear_solver.hpp"
#include "osculate/model/buckling.hpp"
#include "osculate/model/evaluated.hpp"
#include "osculate/model/mass_scaling.hpp"
#include "osculate/model/model.hpp"
#include "osculate/model/point_state.hpp"
#include "osculate/model/state.hpp"
#include "osculate/model/vibrations.hpp"
#include "osculate/solve/central_differences.hpp"
#include "osculate/solve/impact_ahead.hpp"
#include "osculate/solve/newton.hpp"
#include "osculate/solve/time_steps.hpp"

namespace osculate::model {

/// Names of the terms of the system whose tangent can be checked part by part.
enum class Term { bulk, contact, pressure, rigid };

/// Where the time of all evaluations went [s], summed up since the system was made.
struct SystemSeconds {
  double contact = 0;                  ///< search, projection, contact terms of all points
  pairing::PairSeconds contact_parts;  ///< the same in parts, all pairs together
  double bulk = 0;                     ///< internal forces and tangents of the cells
  double assembly = 0;                 ///< everything else: loads, scatter into vectors and matrix
};

/// What a system remembers beside the states: with it, another one of the same model goes on with
/// the same bits.
struct SystemMemory {
  std::vector<double> starts;          ///< of the prescribed dofs' ramps in the running step
  std::vector<la::MatrixPlace> grown;  ///< entries of contact in the pattern of the matrix
  int built = 0;           ///< how often the system was built anew, which leaves nothing of `grown`
  Eigen::VectorXd speeds;  ///< at the beginning of a step that estimates errors in time
};

/// One increment of explicit time integration.
template <class State>
struct ExplicitIncrement {
  solve::TimeStepping outcome = solve::TimeStepping::done;
  std::string reason;  ///< why it is not done
  State state;         ///< at its end, with history and rates; where it stopped if not done
  solve::TimeSteps time_steps;
  solve::StateCounts counts;
};

/// The system that `solve` sees: assembles residual and tangent of a model.
///
/// Owns: dof space, matrix, evaluation buffers. Does not own: the model, the states.
/// Deterministic: element blocks are computed in parallel and added in a fixed order, so the bits
/// do not depend on the number of threads.
///
/// Tested by  tests/unit/model/test_system.cpp, test_contact.cpp, test_contact_tangent.cpp
template <int Dim>
class BasicSystem {
 public:
  using State = BasicState<Dim>;
  using Trial = BasicTrial<Dim>;

  /// `ranks`: processes that each have such a system, and the same model; null: none beside this.
  BasicSystem(const BasicModel<Dim>& model, int threads, const core::Ranks* ranks = nullptr);
  ~BasicSystem();
  BasicSystem(const BasicSystem&) = delete;
  BasicSystem& operator=(const BasicSystem&) = delete;

  [[nodiscard]] State initial_state();
  /// The model: as it is in the running step.
  [[nodiscard]] const BasicModel<Dim>& model() const;
  /// After bodies or equations of the model have changed: unknowns, matrix and buffers are made
  /// anew, as those of a new system. A step has to be begun then.
  void build_anew();
  /// Fixes what is prescribed and loaded during a step; start values come from `committed`.
  void begin_step(const Step& step, const State& committed);
  /// Between two increments of a step: processes deal out nodes anew where contact has moved, as
  /// they do where a step begins. False: nothing has changed.
  bool share_anew(const State& committed);
  /// Processes do all of the work each from here on, until a step begins.
  void share_no_more();
  /// The committed state with what the running step needs of it: accelerations and the energies of
  /// its beginning, or none of them in a step without inertia. To be called after `begin_step`.
  [[nodiscard]] State begin_motion(const State& committed);
  [[nodiscard]] SystemMemory memory() const;
  /// Begins `step` as it was begun when the memory was taken, in the middle of it.
  void resume_step(const Step& step, const State& committed, const SystemMemory& memory);

  /// Residual and tangent of the first iteration.
  void predict(const State& committed, double fraction, solve::Evaluation& out,
               Prediction friction = Prediction::as_before);
  /// Points of pairs with friction touch that carry no shear.
  [[nodiscard]] bool touches_without_shear(const State& state) const;
  /// Residual and tangent of a trial state. Places far from the master may be left out.
  void evaluate(const State& committed, const Trial& trial, double fraction, bool with_tangent,
                solve::Evaluation& out);
  /// The same of a state against itself, with every place.
  void evaluate(const State& state, double fraction, bool with_tangent, solve::Evaluation& out);
  /// The trial moved by a correction, and by what is prescribed; from a committed state the first.
  [[nodiscard]] Trial apply(const Trial& trial, const Eigen::VectorXd& du, double fraction,
                            double factor) const;
  [[nodiscard]] Trial apply(const State& committed, const Eigen::VectorXd& du, double fraction,
                            double factor) const;
  /// The trial state that remembers the branches of the last evaluation, for the next iteration.
  [[nodiscard]] Trial remember(const Trial& trial) const;
  /// After a solution: the state with corrected multipliers, or nothing where all pairs by
  /// augmented Lagrangian have reached their target. `trial` must be the last state evaluated.
  [[nodiscard]] std::optional<Trial> augment(const Trial& trial) const;
  /// Whether the multipliers are corrected after every iteration instead of every solution.
  [[nodiscard]] bool augments_often() const;
  /// Whether a solution may stay though no solution is found around what `augment` made of it: it
  /// was only a stiffer penalty.
  [[nodiscard]] bool may_stay() const;
  /// The state with normal penalties so much softer that points sink into the master by half of the
  /// height of the cells behind them, at most 2^13 times; nothing where none can be softer by much,
  /// or in steps in time. `trial` must be the last state evaluated.
  [[nodiscard]] std::optional<Trial> relaxed(const Trial& trial) const;
  /// The state with the penalties of `before` times (now / before)^part.
  [[nodiscard]] Trial restored(const Trial& trial, const Trial& before, double part) const;
  /// Why a solution is none, `trial` the last state evaluated: points went through a master that
  /// they were in front of, to where no contact is looked for. Else empty.
  [[nodiscard]] std::string refused(const State& committed, const Trial& trial) const;
  /// The converged state with its new history and rates. `trial` must be the last state evaluated.
  [[nodiscard]] State commit(const Trial& trial, double fraction) const;
  /// The first impact before `fraction` (or not long after it) if everything goes on with the
  /// velocity of `committed`: of points that were open, and of points that come upon another part
  /// of the master at an angle. Nothing where the running step does not end increments at impacts.
  [[nodiscard]] std::optional<solve::ImpactAhead> impact_ahead(const State& committed,
                                                               double fraction) const;
  /// Whether one of these points has met its obstacle in the last state evaluated.
  [[nodiscard]] bool has_met(const State& committed, const solve::ImpactAhead& expected) const;

  /// What the step in time from a committed state to the last one committed is off by. To be called
  /// in steps whose time steps are chosen by errors. Contact forces have no part in it unless they
  /// enter as all others do.
  [[nodiscard]] solve::TimeError time_error(const State& committed, const State& next) const;

  /// Free vibrations about a committed state in the running step: `count` of them.
  ///
  /// Tested by  tests/unit/model/test_vibrations.cpp, verification/vibrations
  [[nodiscard]] Vibrations vibrations(const State& state, int count, la::LinearSolver& solver);

  /// Buckling of a committed state by what the loads of the running step add to it from its
  /// beginning to its end: `count` of the smallest factors.
  ///
  /// Requires   sections of small strain and linear laws, springs that do not turn
  /// Tested by  tests/unit/deck/test_buckling.cpp, verification/buckling
  [[nodiscard]] Buckling buckling(const State& state, int count, la::LinearSolver& solver);
  /// Stiffness and mass that they are those of, by the unknowns, multipliers included. Returns why
  /// there are none; empty: there are.
  [[nodiscard]] std::string vibration_matrices(const State& state, la::SparseMatrix& stiffness,
                                               la::SparseMatrix& mass);
  /// The motion of all nodes and rigid bodies by a small one of the unknowns about a state.
  [[nodiscard]] Eigen::VectorXd motion_by(const State& about,
                                          const Eigen::VectorXd& unknowns) const;

  /// Forces of the loads of the running step on vibrations about a state.
  ///
  /// Formula    phi . F , F at the places of that state
  [[nodiscard]] Eigen::VectorXd forces_on(const Vibrations& modes, const State& about,
                                          double fraction);
  /// phi . C phi of the dampers of springs, vibration by vibration.
  [[nodiscard]] Eigen::MatrixXd dampers_on(const Vibrations& modes, const State& about) const;
  /// phi . C w of the dampers of springs, w a motion of all nodes and rigid bodies.
  [[nodiscard]] Eigen::VectorXd drag_along(const Vibrations& modes, const State& about,
                                           const Eigen::VectorXd& motion) const;
  /// Displacement or rotation of a dof.
  [[nodiscard]] double value(const State& state, Dof dof) const;
  /// What the motions that the running step prescribes make of all nodes and rigid bodies up to its
  /// end, linearly and without inertia. `failure`: why it is not known.
  [[nodiscard]] Eigen::VectorXd carried_along(const State& about, la::LinearSolver& solver,
                                              std::string& failure);
  /// phi . M w of a motion of all nodes and rigid bodies.
  [[nodiscard]] Eigen::VectorXd momenta_along(const Vibrations& modes, const State& about,
                                              const Eigen::VectorXd& w);
  /// The state moved along vibrations, linearly: rigid bodies turn by little. Its rates are theirs.
  [[nodiscard]] State moved_along(const Vibrations& modes, const State& about,
                                  const VibrationMotion& by, double fraction) const;
  /// Adds mass times acceleration of a state to the forces of the last evaluation.
  void add_inertia_of(const State& state);

  /// Explicit time integration from a committed state to a fraction of the running step, in as many
  /// time steps as are stable. To be called in steps with central differences only.
  [[nodiscard]] ExplicitIncrement<State> advance(const State& committed, double fraction);
  /// What such a step adds to the masses of cells and nodes.
  [[nodiscard]] const ScaledMasses& scaled_masses() const;
  /// The longest time step that it takes in a state that `begin_motion` has made, and what governs
  /// it.
  struct FirstTimeStep {
    double length = 0;
    std::string governed;
  };
  [[nodiscard]] FirstTimeStep first_time_step(const State& begun);

  /// Unknowns of the matrix: those of the dof space, then the multipliers that are unknowns.
  [[nodiscard]] Index unknowns() const;
  [[nodiscard]] Index displacements() const;  ///< those of the dof space
  [[nodiscard]] const la::SparseMatrix& matrix();
  [[nodiscard]] std::uint64_t pattern_version() const;
  [[nodiscard]] la::Symmetry symmetry() const;
  /// Unsymmetric for pressures that follow surfaces, or contact without friction, alone.
  [[nodiscard]] bool nearly_symmetric() const;
  /// See model/changing_unknowns.hpp; for la::LinearSolver::may_change.
  [[nodiscard]] std::vector<Index> changing_unknowns() const;
  // Bodies that are linear, as solve::Condensation sees them (system_constant.cpp).
  /// Whether cells that are linear (is_constant) do the same to all states of the running step, but
  /// for forces that are linear in the displacements.
  [[nodiscard]] bool stays_linear() const;
  /// Evaluations leave out these cells, and tell of entries between unknowns that may change alone;
  /// others are of no use then. Requires a tangent that was evaluated in whole before.
  void leave_out_constant(bool on);
  /// Makes a tangent of these cells alone, of the entries between unknowns that may change.
  void assemble_constant(const State& committed, double fraction);
  /// Their forces on the unknowns in a trial state.
  [[nodiscard]] Eigen::VectorXd constant_forces(const State& committed, const Trial& trial,
                                                double fraction);
  /// See model/unknown_places.hpp; for la::LinearSolver::place.
  [[nodiscard]] la::Places unknown_places() const;

  [[nodiscard]] const BasicDofSpace<Dim>& dofs() const;
  [[nodiscard]] const Forces& forces() const;  ///< of the last evaluation
  [[nodiscard]] const std::vector<pairing::PairEvaluation<Dim>>& contact() const;
  /// What the material points would remember of the last evaluation.
  [[nodiscard]] const std::vector<double>& material_memory() const;
  /// By pair: whether it was closed in a time step of explicit integration so far.
  [[nodiscard]] const std::vector<bool>& touched() const;
  /// At the beginning of the last iterations (at most eight) of the running attempt and at its end.
  [[nodiscard]] std::vector<ContactStates> recent_contact() const;
  [[nodiscard]] std::vector<Vec<Dim>> positions(const State& state) const;
  [[nodiscard]] bool prescribed(Index unknown) const;
  [[nodiscard]] SystemSeconds seconds() const;
  /// Asked between two iterations whether no more are wanted; none: they always are.
  void interrupt_by(std::function<bool()> asked);
  [[nodiscard]] bool interrupted() const;
  /// Whether a motion that the tangent hardly resists leaves every body as it is: then nothing
  /// holds it. Otherwise something is only very slender or soft. Multipliers: true.
  ///
  /// Tested by  tests/unit/model/test_diagnosis.cpp
  [[nodiscard]] bool is_free_motion(const Trial& trial, const Eigen::VectorXd& mode) const;
  /// Gives every multiplier of the running tangent a little compliance (see solve::Softens).
  /// Returns false where there are none.
  bool soften();
  /// No step in time: what is in balance is an equilibrium.
  [[nodiscard]] bool at_rest() const;
  /// Puts `share` of the bodies' own stiffness on the diagonal of the tangent, this one and those
  /// to come, against free motions (solve::Resistance). 0 removes it.
  void resist(double share);
  /// Largest motion of a node in a correction, over the height of the cells at the contacts or the
  /// largest prescribed motion of the increment.
  [[nodiscard]] double stride(const Eigen::VectorXd& du) const;
  /// Switch terms off (tangent check only); all are on by default.
  void enable(Term term, bool on);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether tangents of a model are factored as unsymmetric matrices.
template <int Dim>
[[nodiscard]] bool needs_unsymmetric(const BasicModel<Dim>& model);

using System = BasicSystem<2>;
using System3 = BasicSystem<3>;

}  // namespace osculate::model
