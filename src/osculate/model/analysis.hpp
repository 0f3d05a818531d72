#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "osculate/la/shared_solvers.hpp"
#include "osculate/model/failure.hpp"
#include "osculate/model/process_records.hpp"
#include "osculate/model/system.hpp"
#include "osculate/solve/increments.hpp"

namespace osculate::model {

/// Processes that run the same analysis, and the solvers that they share.
struct Together {
  const core::Ranks* ranks = nullptr;  ///< null: this process is alone
  la::SharedSolvers solvers{};
};

struct AnalysisOptions {
  solve::IncrementOptions increments;
  int threads = 1;
  const core::Ranks* ranks = nullptr;  ///< see `share`
  la::MakeSolver linear_solver = la::make_default_solver;
  bool by_multigrid = false;  ///< what `linear_solver` is for large models
  std::string until;          ///< last step to run (inclusive), empty = all
};

/// The analysis is run by several processes, whose observers answer alike. They solve together.
void share(const Together& together, AnalysisOptions& options);

/// Where the analysis stands when an observer is called.
struct Progress {
  Index step = 0;       ///< 0-based
  Index increment = 0;  ///< 1-based inside the step, sub-increments counted
  double fraction = 0;
  /// Of the analysis: steps with inertia last as long as they are told to, others one unit each. In
  /// harmonic steps the frequency.
  double time = 0;
};

struct StepRecord {
  std::string name;
  std::vector<solve::IncrementRecord> increments;
  std::optional<Vibrations> vibrations{};  ///< of a step that looks for them
  std::optional<Buckling> buckling{};      ///< likewise
};

/// A converged increment and all that is needed to go on from there with the same bits.
template <int Dim>
struct BasicResumePoint {
  BasicState<Dim> state;
  Progress progress;
  solve::StepPosition position;
  SystemMemory memory;
  std::vector<StepRecord> steps;  ///< what went before, for the result
};

template <int Dim>
struct BasicAnalysisResult {
  solve::Outcome outcome = solve::Outcome::converged;
  std::string message;  ///< plain words
  std::vector<StepRecord> steps;
  BasicState<Dim> state;                     ///< last converged
  BasicState<Dim> last_iterate;              ///< of the failed attempt (equal to `state` when done)
  std::optional<BasicFailure<Dim>> failure;  ///< why the analysis stopped before its end
  double seconds = 0;                        ///< of the whole analysis, observers included
  SystemSeconds seconds_system;              ///< of its evaluations
  double seconds_solver = 0;                 ///< of the linear solver: factors and solutions
  la::IterativeWork linear;                  ///< what it did by iterations
  std::vector<ProcessRecord> processes;      ///< of several
  Index unknowns = 0;
};

/// Real or imaginary part of a harmonic motion.
struct HarmonicPart {
  const HarmonicMotion& motion;
  const Eigen::VectorXd& omega_squared;  ///< of the vibrations
  bool imaginary;
  const solve::IncrementRecord& record;
};

/// Hooks of an analysis. All may be empty.
template <int Dim>
struct BasicAnalysisObserver {
  /// After the initial state and after each converged increment. Return false to stop.
  std::function<bool(BasicSystem<Dim>&, const BasicState<Dim>&, const Progress&,
                     const solve::IncrementRecord*)>
      converged;
  std::function<void(const std::string& reason, const Progress&, double to,
                     const std::vector<solve::IterationRecord>&)>
      cutback;
  /// After `converged`, with what a resume point consists of. Return true if it was kept: what
  /// follows is then what a run that goes on from there finds, to the last bit.
  std::function<bool(const BasicSystem<Dim>&, const BasicState<Dim>&, const Progress&,
                     const solve::StepPosition&)>
      resumable;
  /// A step with central differences begins, or goes on from a resume point.
  std::function<void(const BasicSystem<Dim>&, const Progress&)> begins{};
  /// Vibrations have been found about a state.
  std::function<void(const BasicSystem<Dim>&, const BasicState<Dim>&, const Progress&,
                     const Vibrations&)>
      vibrates{};
  /// Factors at which a state buckles have been found.
  std::function<void(const BasicSystem<Dim>&, const BasicState<Dim>&, const Progress&,
                     const Buckling&)>
      buckles{};
  /// In place of `converged`, at each frequency of a harmonic step: the real part, and behind it
  /// the imaginary one, as states that have been evaluated. Return false to stop.
  std::function<bool(BasicSystem<Dim>&, const BasicState<Dim>&, const Progress&,
                     const HarmonicPart&)>
      harmonic{};
  /// Where the analysis goes on from a resume point: it stands there, nothing has been solved yet.
  std::function<void(const BasicSystem<Dim>&, const BasicState<Dim>&)> resumed{};
  /// After each iteration, also of attempts that are dropped: where its increment is to end, its
  /// number in the attempt, and what it found.
  std::function<void(const Progress& aim, int number, const solve::IterationRecord&)> iterated{};
  /// Asked between two iterations: true ends the analysis with what has converged.
  std::function<bool()> interrupted;
};

/// Runs the steps of a model one after the other. Keeps everything converged when a step fails and
/// says in `message` why: the reason of the solver and, where there is one, the free motion. With
/// `from` it goes on from there; the observer hears of what comes after only.
template <int Dim>
[[nodiscard]] BasicAnalysisResult<Dim> run(const BasicModel<Dim>& model,
                                           const AnalysisOptions& options,
                                           const BasicAnalysisObserver<Dim>& observer,
                                           const BasicResumePoint<Dim>* from = nullptr);

using ResumePoint = BasicResumePoint<2>;
using ResumePoint3 = BasicResumePoint<3>;
using AnalysisResult = BasicAnalysisResult<2>;
using AnalysisResult3 = BasicAnalysisResult<3>;
using AnalysisObserver = BasicAnalysisObserver<2>;
using AnalysisObserver3 = BasicAnalysisObserver<3>;

}  // namespace osculate::model
