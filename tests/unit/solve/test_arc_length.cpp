// Paths of equilibria that turn back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "osculate/la/mumps.hpp"
#include "toy_system.hpp"

namespace osculate::solve {
namespace {

/// F(x) = x^3 - 3 x^2 + 2.5 x: rises to 0.6361 at x = 0.5918, falls to 0.3639, and is 1 at x = 2.
double force(double x) { return x * (x * (x - 3) + 2.5); }
ToySystem snapping() {
  return scalar_system([](double x, double t) { return force(x) - t; },
                       [](double x) { return x * (3 * x - 6) + 2.5; });
}

/// The same with the load as a second unknown, in units in which it is large.
ToySystem snapping_with_a_multiplier() {
  constexpr double unit = 1e6;
  ToySystem system;
  system.size = 2;
  system.builder = la::MatrixBuilder{2};
  system.primary = 1;
  system.force = [](const Eigen::VectorXd& x, double t) {
    return vector({force(x[0]) - x[1] / unit, x[1] / unit - t});
  };
  system.stiffness = [](const Eigen::VectorXd& x) {
    Eigen::MatrixXd k(2, 2);
    k << x[0] * (3 * x[0] - 6) + 2.5, -1 / unit, 0, 1 / unit;
    return k;
  };
  return system;
}

struct Path {
  StepResult<ToySystem::State> result;
  StepPosition position;
  std::vector<double> fractions, places;
};

/// Ten increments from `from`; the path is stopped after so many of them.
Path run(ToySystem system, PathControl use, int stop_after = -1, const Path* from = nullptr) {
  Path path;
  IncrementOptions options;
  options.arc_length.use = use;
  la::Mumps solver;
  if (from) path.position = from->position;
  path.result = run_step(
      system, from ? from->result.state : ToySystem::State{Eigen::VectorXd::Zero(system.size)}, 10,
      options, solver,
      IncrementObserver<ToySystem::State>([&](const ToySystem::State& s, const IncrementRecord& r) {
        path.fractions.push_back(r.fraction);
        path.places.push_back(s.x[0]);
        return static_cast<int>(path.places.size()) != stop_after;
      }),
      [](const std::string&, double, double, const std::vector<IterationRecord>&) {},
      path.position);
  return path;
}

TEST(ArcLength, FollowsTheWholePath) {
  const Path path = run(snapping(), PathControl::always);
  ASSERT_EQ(path.result.outcome, Outcome::converged) << path.result.reason;
  EXPECT_NEAR(path.places.back(), 2.0, 1e-8);
  EXPECT_EQ(path.fractions.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(path.places.begin(), path.places.end()));
  for (std::size_t i = 0; i < path.places.size(); ++i)
    EXPECT_NEAR(force(path.places[i]), path.fractions[i], 1e-8);
  const auto turn = std::find_if(path.places.begin(), path.places.end(),
                                 [](double x) { return x > 0.6 && x < 1.4; });
  EXPECT_NE(turn, path.places.end()) << "the branch that falls";
  EXPECT_TRUE(path.result.increments.back().on_path);
  EXPECT_FALSE(path.result.increments.front().on_path);
}

TEST(ArcLength, TellsOfEachIterationWhereItStands) {
  ToySystem system = snapping();
  IncrementOptions options;
  options.arc_length.use = PathControl::always;
  std::vector<IterationDone> told;
  std::vector<double> residuals;
  options.newton.iterated = [&](const IterationDone& done) {
    told.push_back(done);
    residuals.push_back(done.record.residual);
  };
  la::Mumps solver;
  StepPosition position;
  const auto result = run_step(
      system, ToySystem::State{Eigen::VectorXd::Zero(1)}, 10, options, solver,
      IncrementObserver<ToySystem::State>([&](const ToySystem::State&, const IncrementRecord& r) {
        EXPECT_NEAR(told.back().to, r.fraction, 1e-12);
        EXPECT_EQ(residuals.back(), r.iterations.back().residual);
        return true;
      }),
      [](const std::string&, double, double, const std::vector<IterationRecord>&) {}, position);
  ASSERT_EQ(result.outcome, Outcome::converged);
  std::size_t iterations = 0;
  for (const IncrementRecord& record : result.increments)
    iterations += record.iterations.size() + static_cast<std::size_t>(record.wasted_iterations);
  EXPECT_EQ(told.size(), iterations);
}

TEST(ArcLength, IsNotUsedWhereItIsOff) {
  const Path path = run(snapping(), PathControl::off);
  // Load control may jump over to the other branch, or stop: it never walks down.
  EXPECT_TRUE(std::is_sorted(path.fractions.begin(), path.fractions.end()));
}

TEST(ArcLength, CanBeStoppedOnTheWay) {
  const Path whole = run(snapping(), PathControl::always);
  const int some = static_cast<int>(whole.places.size()) - 2;
  const Path path = run(snapping(), PathControl::always, some);
  EXPECT_EQ(path.result.outcome, Outcome::stopped);
  EXPECT_EQ(path.places.size(), static_cast<std::size_t>(some));
}

/// Stopped after any increment, it goes on with the same bits.
TEST(ArcLength, GoesOnFromAnyPoint) {
  const Path whole = run(snapping(), PathControl::always);
  for (int n = 1; n < static_cast<int>(whole.places.size()); ++n) {
    const Path before = run(snapping(), PathControl::always, n);
    const Path after = run(snapping(), PathControl::always, -1, &before);
    ASSERT_EQ(after.result.outcome, Outcome::converged);
    std::vector<double> places = before.places, fractions = before.fractions;
    places.insert(places.end(), after.places.begin(), after.places.end());
    fractions.insert(fractions.end(), after.fractions.begin(), after.fractions.end());
    EXPECT_EQ(places, whole.places) << n;
    EXPECT_EQ(fractions, whole.fractions) << n;
  }
}

/// The same where nothing may move farther than 0.2 in an increment, so that load control cannot
/// jump over to the other branch: it stops at the limit point, and the path passes it.
ToySystem snapping_in_small_steps() {
  ToySystem system = snapping();
  system.wrong = [](const Eigen::VectorXd& x, const Eigen::VectorXd& committed) {
    return std::abs(x[0] - committed[0]) > 0.2 ? std::string("too far") : std::string{};
  };
  return system;
}

TEST(ArcLength, IsTheLastResort) {
  EXPECT_NE(run(snapping_in_small_steps(), PathControl::off).result.outcome, Outcome::converged);
  const Path path = run(snapping_in_small_steps(), PathControl::last_resort);
  ASSERT_EQ(path.result.outcome, Outcome::converged) << path.result.reason;
  EXPECT_NEAR(path.places.back(), 2.0, 1e-8);
  for (std::size_t i = 0; i < path.places.size(); ++i)
    EXPECT_NEAR(force(path.places[i]), path.fractions[i], 1e-8);
  EXPECT_FALSE(path.result.increments.front().on_path);
  EXPECT_FALSE(path.result.increments.back().on_path) << "load control goes on behind the snap";
  EXPECT_FALSE(std::is_sorted(path.fractions.begin(), path.fractions.end()));
}

/// F(x) = x - x^2 / 2 has no equilibrium beyond 1/2 at all: the path falls for ever.
TEST(ArcLength, GivesUpWhereThePathDoesNotComeBack) {
  for (const PathControl use : {PathControl::always, PathControl::last_resort}) {
    const Path path = run(scalar_system([](double x, double t) { return x - 0.5 * x * x - t; },
                                        [](double x) { return 1 - x; }),
                          use);
    EXPECT_NE(path.result.outcome, Outcome::converged);
    EXPECT_FALSE(path.result.reason.empty());
    EXPECT_LE(path.position.path.increments, ArcLengthOptions{}.max_increments);
  }
}

// Multipliers are not counted in the length of an arc: the path is the one without them.
TEST(ArcLength, IsMeasuredOnDisplacements) {
  const Path alone = run(snapping(), PathControl::always);
  const Path path = run(snapping_with_a_multiplier(), PathControl::always);
  ASSERT_EQ(path.result.outcome, Outcome::converged) << path.result.reason;
  ASSERT_EQ(path.places.size(), alone.places.size());
  for (std::size_t i = 0; i < path.places.size(); ++i)
    EXPECT_NEAR(path.places[i], alone.places[i], 1e-7) << i;
  ToySystem counted = snapping_with_a_multiplier();
  counted.primary = 2;
  const Path by_load = run(counted, PathControl::always);
  EXPECT_TRUE(std::is_sorted(by_load.fractions.begin(), by_load.fractions.end()))
      << "as long as the load is the length, it cannot fall";
}

/// Beside the strip that snaps, a spring is pressed against a stop: a penalty and a multiplier that
/// is corrected around the solutions.
struct PressedSystem {
  static constexpr double penalty = 100, stop = 0.1, target = 1e-8;
  struct State {
    Eigen::VectorXd x;
    double multiplier = 0;
  };
  using Trial = State;
  bool often = false;
  la::MatrixBuilder builder{2};

  void predict(const State& state, double time, Evaluation& out) {
    evaluate(state, state, time, true, out);
  }
  void evaluate(const State&, const State& trial, double time, bool, Evaluation& out) {
    const double x = trial.x[0], y = trial.x[1];
    const double pressure = trial.multiplier + penalty * (y - stop);
    const bool touches = pressure > 0;
    out.ok = true;
    out.residual = vector({force(x) - time, y + (touches ? pressure : 0) - 3 * time});
    out.force_scale = 1;
    builder.clear();
    builder.add(0, 0, x * (3 * x - 6) + 2.5);
    builder.add(1, 1, 1 + (touches ? penalty : 0));
  }
  [[nodiscard]] static State apply(const State& s, const Eigen::VectorXd& du, double,
                                   double factor) {
    return {s.x + factor * du, s.multiplier};
  }
  [[nodiscard]] static State remember(const State& state) { return state; }
  [[nodiscard]] static State commit(const State& state, double) { return state; }
  [[nodiscard]] static std::optional<State> augment(const State& state) {
    const double depth = state.x[1] - stop;
    if (depth <= target) return std::nullopt;
    return State{state.x, state.multiplier + penalty * depth};
  }
  [[nodiscard]] bool augments_often() const { return often; }
  [[nodiscard]] bool may_stay() const { return false; }
  const la::SparseMatrix& matrix() { return builder.finish(); }
  [[nodiscard]] std::uint64_t pattern_version() const { return builder.pattern_version(); }
  [[nodiscard]] static la::Symmetry symmetry() { return la::Symmetry::unsymmetric; }
};

// The increment that ends a path meets the target of penetration as all others do.
TEST(ArcLength, TheEndOfAPathIsCorrectedToo) {
  for (const bool often : {false, true}) {
    PressedSystem system;
    system.often = often;
    IncrementOptions options;
    options.arc_length.use = PathControl::always;
    la::Mumps solver;
    std::vector<double> depths;
    const auto result =
        run_step(system, PressedSystem::State{Eigen::VectorXd::Zero(2)}, 10, options, solver,
                 IncrementObserver<PressedSystem::State>(
                     [&](const PressedSystem::State& s, const IncrementRecord&) {
                       depths.push_back(s.x[1] - PressedSystem::stop);
                       return true;
                     }),
                 [](const std::string&, double, double, const std::vector<IterationRecord>&) {});
    ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
    EXPECT_TRUE(result.increments.back().on_path);
    EXPECT_EQ(result.increments.back().fraction, 1.0);
    EXPECT_GT(depths.size(), 10U);
    for (const double depth : depths) EXPECT_LE(depth, PressedSystem::target);
  }
}

TEST(ArcLength, TheRootThatGoesOn) {
  const Eigen::VectorXd total = vector({1.0, 0.0}), none = vector({0.0, 0.0}),
                        load = vector({1.0, 1.0});
  const auto step = detail::keep_length(total, none, load, std::sqrt(2.0));
  ASSERT_TRUE(step.has_value());
  EXPECT_NEAR((total + *step * load).norm(), std::sqrt(2.0), 1e-15);
  EXPECT_GT((total + *step * load).dot(total), 0);
  EXPECT_FALSE(detail::keep_length(vector({0.0, 3.0}), none, vector({1.0, 0.0}), 1.0).has_value());
}

}  // namespace
}  // namespace osculate::solve
