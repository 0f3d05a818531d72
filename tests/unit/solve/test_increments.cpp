#include <gtest/gtest.h>

#include <cmath>

#include "osculate/la/mumps.hpp"
#include "toy_system.hpp"

namespace osculate::solve {
namespace {

struct Log {
  std::vector<double> fractions, states;
  std::vector<std::array<double, 2>> dropped;
  std::vector<std::string> reasons;
};

StepResult<ToySystem::State> run(ToySystem& system, double start, int increments,
                                 const IncrementOptions& options, Log& log, int stop_after = -1) {
  la::Mumps solver;
  return run_step(system, ToySystem::State{vector({start})}, increments, options, solver,
                  IncrementObserver<ToySystem::State>(
                      [&](const ToySystem::State& state, const IncrementRecord& record) {
                        log.fractions.push_back(record.fraction);
                        log.states.push_back(state.x[0]);
                        return static_cast<int>(log.fractions.size()) != stop_after;
                      }),
                  CutbackObserver([&](const std::string& reason, double from, double to,
                                      const std::vector<IterationRecord>&) {
                    log.reasons.push_back(reason);
                    log.dropped.push_back({from, to});
                  }));
}

/// Unloading of a softening spring f = tanh(x): the flat tangent throws Newton far away.
ToySystem softening() {
  return scalar_system([](double x, double t) { return std::tanh(x) - (1 - t) * std::tanh(3.0); },
                       [](double x) { return 1 / (std::cosh(x) * std::cosh(x)); });
}

TEST(Increments, CutBackAndGrowOnTheNominalGrid) {
  ToySystem system = softening();
  IncrementOptions options;
  options.newton.line_search = LineSearch::off;
  Log log;
  const auto result = run(system, 3.0, 2, options, log);
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  EXPECT_NEAR(result.state.x[0], 0.0, 1e-9);
  ASSERT_FALSE(log.dropped.empty());
  EXPECT_EQ(log.dropped.front(), (std::array<double, 2>{0.0, 0.5}));
  for (std::size_t i = 0; i + 1 < log.dropped.size() && log.dropped[i + 1][0] == 0; ++i)
    EXPECT_EQ(log.dropped[i + 1][1], 0.5 * log.dropped[i][1]);  // halved, exactly
  EXPECT_EQ(std::count(log.fractions.begin(), log.fractions.end(), 0.5), 1);
  EXPECT_EQ(log.fractions.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(log.fractions.begin(), log.fractions.end()));
  EXPECT_EQ(result.state.commits, static_cast<int>(log.fractions.size()));
  EXPECT_EQ(result.increments.size(), log.fractions.size());
  int cutbacks = 0, wasted = 0;
  for (const IncrementRecord& record : result.increments) {
    cutbacks += record.cutbacks;
    wasted += record.wasted_iterations;
  }
  EXPECT_EQ(cutbacks, static_cast<int>(log.dropped.size()));
  EXPECT_GT(wasted, 0);
  bool grew = false;
  for (std::size_t i = 2; i < log.fractions.size(); ++i)
    grew |= log.fractions[i] - log.fractions[i - 1] >
            1.5 * (log.fractions[i - 1] - log.fractions[i - 2]);
  EXPECT_TRUE(grew);
}

/// Flows as it moves.
struct FlowingSystem : ToySystem {
  explicit FlowingSystem(ToySystem toy) : ToySystem(std::move(toy)) {}
  [[nodiscard]] double flow(const State& committed, const State& trial) const {
    return 0.02 * std::abs(trial.x[0] - committed.x[0]);
  }
};

// What flows by more than a hundredth in more than ten iterations is halved: here towards a root of
// third order, which Newton's method comes near by a third an iteration.
TEST(Increments, FlowOfManyIterationsIsHalved) {
  FlowingSystem system(scalar_system([](double x, double t) { return x * x * x - 27 * (1 - t); },
                                     [](double x) { return 3 * x * x; }));
  IncrementOptions options;
  options.max_cutbacks = 12;
  options.newton.line_search = LineSearch::off;
  options.newton.predictor = Predictor::tangent;
  std::vector<std::string> reasons;
  double before = 3;
  la::Mumps solver;
  const auto result = run_step(
      system, ToySystem::State{vector({3.0})}, 1, options, solver,
      IncrementObserver<ToySystem::State>(
          [&](const ToySystem::State& state, const IncrementRecord& record) {
            EXPECT_TRUE(record.iterations.size() <= 10 || std::abs(state.x[0] - before) <= 0.5);
            before = state.x[0];
            return true;
          }),
      CutbackObserver([&](const std::string& reason, double, double,
                          const std::vector<IterationRecord>&) { reasons.push_back(reason); }));
  EXPECT_EQ(result.outcome, Outcome::converged);
  ASSERT_FALSE(reasons.empty());
  EXPECT_EQ(reasons[0].substr(0, 39), "metal flows by 6 % in one increment of ") << reasons[0];
}

TEST(Increments, EasyStepsNeedNoSubIncrements) {
  ToySystem system =
      scalar_system([](double x, double t) { return 2 * x - t; }, [](double) { return 2.0; });
  Log log;
  const auto result = run(system, 0.0, 3, {}, log);
  EXPECT_EQ(result.outcome, Outcome::converged);
  EXPECT_EQ(log.fractions, (std::vector<double>{1.0 / 3, 2.0 / 3, 1.0}));
  EXPECT_TRUE(log.dropped.empty());
}

TEST(Increments, WhatNeverConvergesStopsWithAReason) {
  ToySystem system =
      scalar_system([](double x, double) { return std::copysign(std::sqrt(std::abs(x)), x); },
                    [](double x) { return 0.5 / std::sqrt(std::abs(x)); });
  IncrementOptions options;
  options.newton.line_search = LineSearch::off;
  options.newton.max_iterations = 5;
  options.max_cutbacks = 3;
  options.arc_length.use = PathControl::off;
  Log log;
  const auto result = run(system, 1.0, 2, options, log);
  EXPECT_EQ(result.outcome, Outcome::not_converged);
  EXPECT_EQ(result.reason, "not converged after 5 iterations");
  EXPECT_EQ(result.state.x[0], 1.0);  // the start, untouched
  EXPECT_EQ(result.state.commits, 0);
  EXPECT_TRUE(result.increments.empty());
  EXPECT_EQ(result.last_attempt.iterations.size(), 5u);
  const std::vector<std::array<double, 2>> halvings{{0, 0.5}, {0, 0.25}, {0, 0.125}, {0, 0.0625}};
  EXPECT_EQ(log.dropped, halvings);
}

TEST(Increments, AFailureKeepsWhatConverged) {
  ToySystem system =
      scalar_system([](double x, double t) { return 2 * x - t; }, [](double) { return 2.0; });
  system.wrong = [](const Eigen::VectorXd& x, const Eigen::VectorXd&) {
    return std::string(x[0] > 0.3 ? "too far" : "");
  };
  IncrementOptions options;
  options.max_cutbacks = 2;
  options.arc_length.use = PathControl::off;
  Log log;
  const auto result = run(system, 0.0, 4, options, log);
  EXPECT_EQ(result.outcome, Outcome::numerical_failure);
  EXPECT_EQ(result.reason, "too far");
  // 0.25, 0.5 converge; of 0.75 (x = 0.375) only the quarter to 0.5625 does.
  EXPECT_EQ(log.fractions, (std::vector<double>{0.25, 0.5, 0.5625}));
  EXPECT_EQ(result.state.x[0], 0.28125);
  EXPECT_GT(result.last_attempt.trial.x[0], 0.3);
}

TEST(Increments, TheObserverCanStop) {
  ToySystem system =
      scalar_system([](double x, double t) { return 2 * x - t; }, [](double) { return 2.0; });
  Log log;
  const auto result = run(system, 0.0, 4, {}, log, 2);
  EXPECT_EQ(result.outcome, Outcome::stopped);
  EXPECT_EQ(result.reason, "stopped by the user");
  EXPECT_EQ(log.fractions, (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(result.state.x[0], 0.25);
}

/// A step that goes on from the position of any of its increments finds the same bits.
TEST(Increments, GoOnFromAnyPosition) {
  IncrementOptions options;
  options.newton.line_search = LineSearch::off;
  std::vector<StepPosition> positions;
  std::vector<ToySystem::State> states;
  const auto watched = [&](ToySystem& system, const ToySystem::State& start,
                           StepPosition position) {
    la::Mumps solver;
    std::vector<double> found;
    const auto result = run_step(system, start, 3, options, solver,
                                 IncrementObserver<ToySystem::State>(
                                     [&](const ToySystem::State& state, const IncrementRecord&) {
                                       found.push_back(state.x[0]);
                                       return true;
                                     }),
                                 CutbackObserver([](const std::string&, double, double,
                                                    const std::vector<IterationRecord>&) {}),
                                 position);
    EXPECT_EQ(result.outcome, Outcome::converged);
    return found;
  };
  ToySystem whole = softening();
  la::Mumps solver;
  StepPosition running;
  (void)run_step(whole, ToySystem::State{vector({3.0})}, 3, options, solver,
                 IncrementObserver<ToySystem::State>(
                     [&](const ToySystem::State& state, const IncrementRecord&) {
                       positions.push_back(running);
                       states.push_back(state);
                       return true;
                     }),
                 CutbackObserver([](const std::string&, double, double,
                                    const std::vector<IterationRecord>&) {}),
                 running);
  ASSERT_GT(states.size(), 4u);
  for (std::size_t k = 0; k < states.size(); ++k) {
    ToySystem system = softening();
    const std::vector<double> rest = watched(system, states[k], positions[k]);
    ASSERT_EQ(rest.size(), states.size() - k - 1) << k;
    for (std::size_t i = 0; i < rest.size(); ++i) EXPECT_EQ(rest[i], states[k + 1 + i].x[0]);
  }
}

TEST(Extrapolation, IsTheParabolaThroughTheLastThreeStates) {
  const auto path = [](double t) { return vector({2 + 3 * t - 5 * t * t, t * t}); };
  Extrapolation extrapolation;
  NewtonResult<ToySystem::State> step;
  step.iterations.resize(4);
  step.first_residual = 7;
  step.first_energy = 11;
  EXPECT_EQ(extrapolation.guess(1.0).du.size(), 0);
  step.total = path(0.3) - path(0.1);
  extrapolation.add(step, 0.2);
  EXPECT_EQ(extrapolation.guess(1.0).du.size(), 0);
  step.total = path(0.4) - path(0.3);
  extrapolation.add(step, 0.1);
  const Guess guess = extrapolation.guess(0.25);
  EXPECT_LT((guess.du - (path(0.65) - path(0.4))).norm(), 1e-14);
  EXPECT_NEAR(guess.residual, 7 * 2.5, 1e-13);
  EXPECT_NEAR(guess.energy, 11 * 6.25, 1e-12);
  step.evaluation.counts.signature = 5;  // a contact point changed its state
  extrapolation.add(step, 0.1);
  EXPECT_EQ(extrapolation.guess(0.1).du.size(), 0);
}

TEST(Extrapolation, SavesIterationsAndFindsTheSameStates) {
  std::array<int, 2> iterations{};
  std::array<std::vector<double>, 2> states;
  for (const std::size_t k : {0u, 1u}) {
    ToySystem system = scalar_system([](double x, double t) { return std::sinh(x) - 40 * t; },
                                     [](double x) { return std::cosh(x); });
    IncrementOptions options;
    options.newton.predictor = k == 0 ? Predictor::tangent : Predictor::automatic;
    Log log;
    const auto result = run(system, 0.0, 20, options, log);
    ASSERT_EQ(result.outcome, Outcome::converged);
    for (const IncrementRecord& record : result.increments)
      iterations[k] += static_cast<int>(record.iterations.size());
    states[k] = log.states;
  }
  EXPECT_LE(iterations[1], iterations[0] - 15);
  ASSERT_EQ(states[0].size(), states[1].size());
  for (std::size_t i = 0; i < states[0].size(); ++i) EXPECT_NEAR(states[1][i], states[0][i], 1e-9);
}

/// Is told to end after some of its linear solutions.
struct Interrupted : ToySystem {
  int left = 0;
  mutable int asked = 0;
  [[nodiscard]] bool interrupted() const { return ++asked > left; }
};

TEST(Increments, AnInterruptEndsBetweenIterationsWithWhatHasConverged) {
  Interrupted system{scalar_system([](double x, double t) { return x * x * x + x - 10 * t; },
                                   [](double x) { return 3 * x * x + 1; }),
                     14};
  la::Mumps solver;
  int dropped = 0;
  const StepResult<ToySystem::State> done = run_step(
      system, {vector({0})}, 4, {}, solver, [](const auto&, const auto&) { return true; },
      [&](const auto&, double, double, const auto&) { ++dropped; });
  EXPECT_EQ(done.outcome, Outcome::stopped);
  EXPECT_EQ(done.reason, "stopped by the user");
  EXPECT_EQ(system.asked, 15);
  EXPECT_EQ(dropped, 0);
  ASSERT_GE(done.increments.size(), 1u);
  ASSERT_LE(done.increments.size(), 3u);
  const double x = done.state.x[0];
  EXPECT_NEAR(x * x * x + x, 10 * done.increments.back().fraction, 1e-7);
}

TEST(Increments, APathThatLeadsNowhereIsGivenUp) {
  PathPosition still, slow;
  for (int i = 1; i < 25; ++i) EXPECT_FALSE(detail::leads_nowhere(still, 0.5, 0.1)) << i;
  EXPECT_TRUE(detail::leads_nowhere(still, 0.5, 0.1));
  for (int i = 1; i < 200; ++i) EXPECT_FALSE(detail::leads_nowhere(slow, 1e-6 * i, 0.1)) << i;
}

}  // namespace
}  // namespace osculate::solve
