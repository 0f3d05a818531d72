#pragma once
#include <Eigen/Core>
#include <concepts>
#include <functional>
#include <string>
#include <vector>

#include "osculate/core/prediction.hpp"
#include "osculate/la/linear_solver.hpp"
#include "osculate/la/sparse_matrix.hpp"

// What Newton's method asks of a system, and what it says of itself.
namespace osculate::solve {

/// How an attempt ended.
enum class Outcome {
  converged,
  not_converged,      ///< iterations used up, or the residual grows without end: cut the increment
  numerical_failure,  ///< singular tangent, inverted element, not a number: cut, and tell where
  stopped,            ///< the observer asked to stop
  out_of_memory       ///< no smaller increment needs less
};

/// States of the contact points, for the log and for state-aware step control.
struct StateCounts {
  int open = 0, stick = 0, slipping = 0;
  int closed = 0;               ///< in contact where nothing could hold them along the master
  std::uint64_t signature = 0;  ///< hash of the state of every point
  double friction_work = 0;     ///< dissipated by all points since the beginning
  [[nodiscard]] int touching() const { return stick + slipping + closed; }
};

/// What a system returns for one configuration. The matrix stays inside the system.
struct Evaluation {
  bool ok = true;
  std::string message;              ///< why not ok (element, material)
  bool apart = false;               ///< not ok because nodes are farther away than can be
  Eigen::VectorXd residual;         ///< out-of-balance force of the unknowns [force]
  Eigen::VectorXd branch_residual;  ///< what to linearise from where it differs from `residual`
  double force_scale = 0;  ///< largest of the norms of internal, external and contact forces
  double round_off = 0;    ///< a residual below this may be rounding of coordinates times stiffness
  double round_off_in_time =
      0;               ///< the part of it that inertia has: the position is none the worse
  bool loaded = true;  ///< forces act from outside
  StateCounts counts;
  bool led = false;     ///< a prediction: what is prescribed has yet to move, and bodies with it
  bool saddle = false;  ///< some unknowns are multipliers: the residual has no potential
};

struct IterationRecord {
  double residual = 0;   ///< |R| / scale after the correction
  double energy = 0;     ///< relative to the first iteration
  double step = 1;       ///< line search factor
  bool factored = true;  ///< else the factors of a former iteration served
  bool whole = true;     ///< else no more was factored than the unknowns of contact
  StateCounts counts;
};

/// An iteration that has just been done, for who watches.
struct IterationDone {
  double to;   ///< fraction of the step that the increment aims at (on a path: of the iterate)
  int number;  ///< 1-based, since the attempt or the last correction of multipliers began
  const IterationRecord& record;
};

enum class LineSearch { automatic, off };

/// Where an increment starts from. tangent: from the committed state, linearised there.
/// automatic: the same, but where increments follow each other smoothly and Newton needs several
/// iterations, from the quadratic extrapolation of the last ones (see increments.hpp).
enum class Predictor { automatic, tangent };

/// Convergence is judged by the residual |R| <= residual * scale and by the energy
/// |du . R| <= energy * (value of the first iteration). A measure with tolerance 0 is not used.
/// A correction at round-off (1e-10 of the increment's largest) ends the iteration in any case; so
/// does a residual that no longer falls, below the estimate of round-off and 1e-3 of the scale,
/// when the work of the correction has fallen to 1e-10 of the first. Where no force acts from
/// outside and the prediction leaves rounding alone, or inertia has it all, such a residual is all
/// there is. A residual that stands still for three iterations ends them too, at 1e-6 of the scale
/// with an energy below its tolerance, or one for two at 1e-3 of its own tolerance, at 0.1 of it
/// where the increment began below that. With a tangent without digits corrections must have fallen
/// to 1e-5 of the largest besides. Both used (default): after a solve, the energy is the work of
/// the remaining residual on the last correction. Energy alone: the papers' rule, which needs the
/// solve it is measured with ("counting the last solve").
///
/// Formula    scale = max(force_scale, 1e-3 |R_1|), R_1 the residual of the prediction: a body that
///            is carried along without resistance has no forces but round-off to compare with
struct NewtonOptions {
  double residual = 1e-9;
  double energy = 1e-12;
  int max_iterations = 25;
  LineSearch line_search = LineSearch::automatic;
  Predictor predictor = Predictor::automatic;
  /// Told of each iteration when it is done; may be empty.
  std::function<void(const IterationDone&)> iterated{};
};

/// A first guess of an increment, and what its convergence is measured by: an extrapolated start
/// is so near that its own first iteration would be no measure.
struct Guess {
  Eigen::VectorXd du;   ///< correction of the unknowns; empty = none
  double residual = 0;  ///< |R| of the last increment that was started by the tangent
  double energy = 0;    ///< first energy of that increment
  Prediction friction = Prediction::as_before;  ///< without du
  bool resisted = false;  ///< without du: resist free motions (see Resistance)
};

/// Of all unknowns, and of those of contact alone.
struct Factorisations {
  std::ptrdiff_t whole = 0, of_contact = 0;
};
[[nodiscard]] inline Factorisations count_factorisations(
    const std::vector<IterationRecord>& iterations) {
  Factorisations count;
  for (const IterationRecord& record : iterations)
    if (record.factored) ++(record.whole ? count.whole : count.of_contact);
  return count;
}

/// Where digits were lost, and what else there is to say of a solution.
struct Precision {
  double condition = 0;  ///< of the tangent, about; 0: at most 1e13
  bool round_off =
      false;         ///< the residual is above its tolerance, and as small as rounding lets it
  int unstable = 0;  ///< motions that the equilibrium drives on: see look_at_stability
};

/// `State` is what was committed, `Trial` what an iteration tries; they may be one type, but where
/// they are two, neither can be taken for the other.
template <class S>
concept System = requires(S s, const typename S::State& state, const typename S::Trial& trial,
                          const Eigen::VectorXd& du, Evaluation& out, double time) {
  {s.predict(state, time, out)};  // residual and tangent at the committed state
  {s.evaluate(state, trial, time, true, out)};
  { s.apply(state, du, time, 1.0) } -> std::same_as<typename S::Trial>;
  { s.apply(trial, du, time, 1.0) } -> std::same_as<typename S::Trial>;
  { s.remember(trial) } -> std::same_as<typename S::Trial>;
  { s.matrix() } -> std::same_as<const la::SparseMatrix&>;
  { s.pattern_version() } -> std::convertible_to<std::uint64_t>;
  { s.symmetry() } -> std::same_as<la::Symmetry>;
};

template <class Trial>
struct NewtonResult {
  Outcome outcome = Outcome::not_converged;
  std::string reason;
  Trial trial;  ///< last iterate (converged or not)
  Evaluation evaluation;
  std::vector<IterationRecord> iterations;
  Eigen::VectorXd total;      ///< sum of the corrections
  bool extrapolated = false;  ///< started from the guess
  double first_residual = 0, first_energy = 0;
  la::SolveStatus linear = la::SolveStatus::ok;
  Index bad_row = -1;
  bool whole_factors = true;  ///< of the last factorisation: la::FactorReport
  bool kept_factors = false;  ///< nothing was factored, and the solver iterates
  int negative_pivots = 0;    ///< likewise
  Precision precision{};
};

namespace detail {

template <class Trial>
bool fail(NewtonResult<Trial>& result, Outcome outcome, std::string reason) {
  result.outcome = outcome;
  result.reason = std::move(reason);
  return false;
}

}  // namespace detail

}  // namespace osculate::solve
