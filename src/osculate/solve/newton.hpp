#pragma once
#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <string>
#include <vector>

#include "osculate/la/direct_solver.hpp"
#include "osculate/la/sparse_matrix.hpp"

namespace osculate::solve {

/// How an attempt ended.
enum class Outcome {
  converged,
  not_converged,      ///< iterations used up, or the residual grows without end: cut the increment
  numerical_failure,  ///< singular tangent, inverted element, not a number: cut, and tell where
  stopped             ///< the observer asked to stop
};

/// States of the contact points, for the log and for state-aware step control.
struct StateCounts {
  int open = 0, stick = 0, slip = 0;
  std::uint64_t signature = 0;  ///< hash of the state of every point
};

/// What a system returns for one configuration. The matrix stays inside the system.
struct Evaluation {
  bool ok = true;
  std::string message;              ///< why not ok (element, material)
  Eigen::VectorXd residual;         ///< out-of-balance force of the unknowns [force]
  Eigen::VectorXd branch_residual;  ///< what to linearise from where it differs from `residual`
  double force_scale = 0;  ///< largest of the norms of internal, external and contact forces
  StateCounts counts;
};

enum class LineSearch { automatic, off };

/// Convergence is judged by the residual |R| <= residual * force_scale and by the energy
/// |du . R| <= energy * (value of the first iteration). A measure with tolerance 0 is not used.
/// Both used (default): after a solve, the energy is the work of the remaining residual on the last
/// correction. Energy alone: the papers' rule, which needs the solve it is measured with
/// ("counting the last solve").
struct NewtonOptions {
  double residual = 1e-9;
  double energy = 1e-12;
  int max_iterations = 25;
  LineSearch line_search = LineSearch::automatic;
};

struct IterationRecord {
  double residual = 0;  ///< |R| / force_scale after the correction
  double energy = 0;    ///< relative to the first iteration
  double step = 1;      ///< line search factor
  StateCounts counts;
};

template <class S>
concept System = requires(S s, const typename S::State& state, const Eigen::VectorXd& du,
                          Evaluation& out, double time) {
  {s.predict(state, time, out)};                // residual and tangent at the committed state
  {s.evaluate(state, state, time, true, out)};  // committed, trial
  { s.apply(state, du, time, 1.0) } -> std::same_as<typename S::State>;
  { s.remember(state) } -> std::same_as<typename S::State>;
  { s.matrix() } -> std::same_as<const la::SparseMatrix&>;
  { s.pattern_version() } -> std::convertible_to<std::uint64_t>;
  { s.symmetry() } -> std::same_as<la::Symmetry>;
};

template <class State>
struct NewtonResult {
  Outcome outcome = Outcome::not_converged;
  std::string reason;
  State state;  ///< last iterate (converged or not)
  Evaluation evaluation;
  std::vector<IterationRecord> iterations;
  la::SolveStatus linear = la::SolveStatus::ok;
  Index bad_row = -1;
};

namespace detail {

inline double relative(double value, double scale) {
  return scale > 0 ? value / scale : (value > 0 ? 1.0 : 0.0);
}

/// Judges one iteration; see NewtonOptions.
struct Judge {
  const NewtonOptions& options;
  double first_energy = 0;

  [[nodiscard]] bool done(double residual, double energy_before, double energy_after) const {
    constexpr double round_off = 1e-14;
    const bool residual_ok = options.residual <= 0 || residual <= options.residual;
    if (options.energy <= 0) return residual_ok;
    const double energy = options.residual > 0 ? energy_after : energy_before;
    const bool energy_ok = energy <= options.energy * first_energy || residual <= round_off;
    return residual_ok && energy_ok;
  }
};

}  // namespace detail

/// One increment by Newton's method from a committed state to `time`.
///
/// The first iteration linearises at the committed state with the loads and prescribed increments
/// of `time` applied through the tangent (residual includes K du_prescribed), so the boundary
/// never moves ahead of the body. The committed state is never written: a failed increment has
/// nothing to undo.
template <System S>
[[nodiscard]] NewtonResult<typename S::State> newton(S& system, const typename S::State& committed,
                                                     double time, const NewtonOptions& options,
                                                     la::DirectSolver& solver);

}  // namespace osculate::solve

#include "osculate/solve/newton_impl.hpp"
