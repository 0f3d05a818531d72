// Corrections by the factors of a former iteration: where they may be, and that they change nothing
// but the time.
#include <gtest/gtest.h>

#include <algorithm>

#include "osculate/la/mumps.hpp"
#include "retold_solver.hpp"
#include "toy_system.hpp"

namespace osculate::solve {
namespace {

constexpr Index size = 400;  // dense: dear enough

/// Springs that stiffen, each of which pulls at all others.
ToySystem springs() {
  ToySystem system;
  system.size = size;
  system.builder = la::MatrixBuilder{size};
  const auto linear = [] {
    Eigen::MatrixXd k = Eigen::MatrixXd::Constant(size, size, -0.5 / size);
    for (Index i = 0; i < size; ++i) k(i, i) += 1 + 0.3 * std::sin(i);
    return k;
  };
  const Eigen::MatrixXd k = linear();
  system.force = [k](const Eigen::VectorXd& x, double t) -> Eigen::VectorXd {
    return k * x + Eigen::VectorXd(x.array().cube()) -
           t * Eigen::VectorXd::LinSpaced(size, 0.2, 0.6);
  };
  system.stiffness = [k](const Eigen::VectorXd& x) {
    Eigen::MatrixXd tangent = k;
    tangent.diagonal() += Eigen::VectorXd(3 * x.array().square());
    return tangent;
  };
  return system;
}

NewtonResult<ToySystem::Trial> solved(ToySystem& system, la::LinearSolver& solver) {
  return newton(system, ToySystem::State{Eigen::VectorXd::Zero(size)}, 1.0, {}, solver);
}

std::ptrdiff_t factorisations(const NewtonResult<ToySystem::Trial>& result) {
  return std::ranges::count_if(result.iterations, &IterationRecord::factored);
}

TEST(FormerFactors, SaveFactorisationsAndNothingElse) {
  ToySystem system = springs();
  la::Mumps mumps;
  const auto silent = support::factors_that_serve_once();
  const auto with = solved(system, mumps), without = solved(system, *silent);
  ASSERT_EQ(with.outcome, Outcome::converged) << with.reason;
  ASSERT_EQ(without.outcome, Outcome::converged) << without.reason;
  EXPECT_EQ(factorisations(without), std::ssize(without.iterations));
  EXPECT_LT(factorisations(with), std::ssize(with.iterations));
  EXPECT_EQ(with.iterations.size(), without.iterations.size());
  EXPECT_LT((with.trial.x - without.trial.x).norm(), 1e-9 * without.trial.x.norm());
}

/// States that change with the first `changes` evaluations.
NewtonResult<ToySystem::Trial> with_changes(std::uint64_t changes, const NewtonOptions& options) {
  ToySystem system = springs();
  std::uint64_t calls = 0;
  system.states = [&](const Eigen::VectorXd&) { return std::min(++calls, changes); };
  la::Mumps mumps;
  return newton(system, ToySystem::State{Eigen::VectorXd::Zero(size)}, 1.0, options, mumps);
}

TEST(FormerFactors, ServeOnTheWayWhereStatesHaveChanged) {
  const auto result = with_changes(4, {});
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  EXPECT_FALSE(result.iterations[1].factored);
  EXPECT_LT(factorisations(result), std::ssize(result.iterations));
  ToySystem system = springs();
  la::Mumps mumps;
  EXPECT_LT((result.trial.x - solved(system, mumps).trial.x).norm(), 1e-9 * result.trial.x.norm());
}

// States that never come to rest: noise says at the end that all is held.
TEST(FormerFactors, OfOtherStatesEndAnIncrementOnceTheirTangentIsTried) {
  const auto result = with_changes(1000, {});
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  EXPECT_EQ(factorisations(result), 1);
}

// What changes comes to rest, and noise says that all is held: no second factorisation.
TEST(FormerFactors, EndAnIncrementWhereNoiseSaysThatAllIsHeld) {
  const auto result = with_changes(3, {});
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  EXPECT_EQ(factorisations(result), 1);
  EXPECT_LE(result.iterations.back().residual, NewtonOptions{}.residual);
}

/// Springs that hold each other, and nothing else.
Eigen::MatrixXd loose_springs() {
  Eigen::MatrixXd k = Eigen::MatrixXd::Constant(size, size, -1.0 / size);
  k.diagonal().array() += 1;
  return k;
}
/// Loads that balance each other.
Eigen::VectorXd balanced_load() {
  Eigen::VectorXd load = Eigen::VectorXd::LinSpaced(size, -0.4, 0.4);
  load[0] = 0;
  load.array() -= load.mean();
  return load;
}

/// Springs between neighbours, of which the first one is held by a point until it comes loose in
/// the second evaluation. The loads balance each other with and without it, so that there is a
/// solution that a solver can find.
NewtonResult<ToySystem::Trial> come_loose(bool loose, int changes) {
  ToySystem system = springs();
  const Eigen::MatrixXd k = loose_springs();
  const Eigen::VectorXd load = balanced_load();
  int calls = 0;
  const auto hold = [&calls, loose] { return loose && calls > 1 ? 0.0 : 1.0; };
  const auto cubes = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd((x.array() - x.mean()).cube());
  };
  const auto centred = [](Eigen::VectorXd f) {
    f.array() -= f.mean();
    return f;
  };
  system.force = [=](const Eigen::VectorXd& x, double t) -> Eigen::VectorXd {
    Eigen::VectorXd f = k * x + centred(cubes(x)) - t * load;
    f[0] += hold() * x[0];
    return f;
  };
  system.stiffness = [=](const Eigen::VectorXd& x) -> Eigen::MatrixXd {
    const Eigen::MatrixXd centre = loose_springs();
    const Eigen::VectorXd slope = 3 * (x.array() - x.mean()).square();
    Eigen::MatrixXd tangent = k + centre * slope.asDiagonal() * centre;
    tangent(0, 0) += hold();
    return tangent;
  };
  system.states = [&calls, changes](const Eigen::VectorXd&) {
    return static_cast<std::uint64_t>(std::min(calls++, changes));
  };
  la::Mumps mumps;
  return newton(system, ToySystem::State{Eigen::VectorXd::Zero(size)}, 1.0, {}, mumps);
}

TEST(FormerFactors, EndNothingThatHasComeLoose) {
  for (const int changes : {2, 1000}) {  // states that come to rest, and others
    SCOPED_TRACE(changes);
    const auto held = come_loose(false, changes), loose = come_loose(true, changes);
    EXPECT_EQ(held.outcome, Outcome::converged) << held.reason;
    EXPECT_EQ(factorisations(held), 1);
    EXPECT_EQ(loose.outcome, Outcome::numerical_failure);
    EXPECT_EQ(loose.linear, la::SolveStatus::singular) << loose.reason;
  }
}

/// Springs without inertia, whose pivots tell whether they are stable.
struct RestingSystem : ToySystem {
  [[nodiscard]] static la::Symmetry symmetry() { return la::Symmetry::positive_definite; }
  [[nodiscard]] static bool at_rest() { return true; }
};

// Noise says of the tangent at the end that it is stable, as the first one was.
TEST(FormerFactors, EndAnIncrementAtRestWhereNoiseSaysThatItIsStable) {
  RestingSystem system{springs()};
  la::Mumps mumps;
  const auto result = newton(system, ToySystem::State{Eigen::VectorXd::Zero(size)}, 1.0, {}, mumps);
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  ASSERT_GT(result.iterations.size(), 2U);
  EXPECT_EQ(factorisations(result), 1);
  EXPECT_EQ(result.negative_pivots, 0);
}

/// The last spring loses its stiffness as the first one is pulled, and is in balance where it is.
RestingSystem column_of(double softening) {
  RestingSystem system{springs()};
  const auto before = system.force;
  const auto stiffness = system.stiffness;
  constexpr Index last = size - 1;
  const auto decoupled = [](Eigen::MatrixXd k) {
    k.row(last).setZero();
    k.col(last).setZero();
    k(last, last) = 1;
    return k;
  };
  system.force = [=](const Eigen::VectorXd& x, double t) -> Eigen::VectorXd {
    Eigen::VectorXd without = x;
    without[last] = 0;
    Eigen::VectorXd f = before(without, t);
    f[last] = (1 - softening * x[0]) * x[last];
    f[0] -= 0.5 * softening * x[last] * x[last];
    return f;
  };
  system.stiffness = [=](const Eigen::VectorXd& x) -> Eigen::MatrixXd {
    Eigen::MatrixXd k = decoupled(stiffness(x));
    k(last, last) = 1 - softening * x[0];
    k(0, last) = k(last, 0) = -softening * x[last];
    return k;
  };
  return system;
}

NewtonResult<ToySystem::Trial> column(double softening) {
  RestingSystem system = column_of(softening);
  la::Mumps mumps;
  return newton(system, ToySystem::State{Eigen::VectorXd::Zero(size)}, 1.0, {}, mumps);
}

// The pivots at the end are of a tangent of the end, not of the first one.
TEST(FormerFactors, EndNoIncrementWithoutPivotsWhereItIsUnstable) {
  const auto stable = column(0);
  ASSERT_EQ(stable.outcome, Outcome::converged) << stable.reason;
  EXPECT_EQ(factorisations(stable), 1);
  const double critical = 1 / stable.trial.x[0];
  for (const double share : {0.9, 0.999, 1.001, 1.1, 3.0}) {
    SCOPED_TRACE(share);
    const auto result = column(share * critical);
    ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
    EXPECT_EQ(result.negative_pivots, share > 1 ? 1 : 0);
    if (share > 1) {
      EXPECT_EQ(factorisations(result), 2);
      EXPECT_TRUE(result.iterations.back().factored);
    }
  }
}

TEST(FormerFactors, OfOtherStatesDoNotServeWhereTheEnergyAloneCounts) {
  NewtonOptions by_energy;
  by_energy.residual = 0;
  const auto result = with_changes(1000, by_energy);
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  EXPECT_EQ(factorisations(result), std::ssize(result.iterations));
}

TEST(FormerFactors, BeginAnewWithEveryIncrement) {
  ToySystem system = springs();
  la::Mumps mumps, fresh;
  const auto first = solved(system, mumps), again = solved(system, mumps);
  const auto alone = solved(system, fresh);
  EXPECT_TRUE(again.iterations.front().factored);
  EXPECT_EQ(again.trial.x, first.trial.x);
  EXPECT_EQ(again.trial.x, alone.trial.x);
}

template <class S>
StepResult<ToySystem::State, ToySystem::Trial> increments(
    S& system, int count, const std::function<bool(int, const ToySystem::State&)>& anew,
    StepPosition& position, const ToySystem::State& start = {Eigen::VectorXd::Zero(size)}) {
  la::Mumps mumps;
  IncrementOptions options;
  options.newton.predictor = Predictor::tangent;
  options.max_cutbacks = 0;
  return run_step(
      system, start, count, options, mumps,
      IncrementObserver<ToySystem::State>([&](const auto& state, const auto&) {
        position.anew = anew(position.nominal + 1, state);
        return true;
      }),
      [](const auto&...) {}, position);
}

const auto never = [](int, const ToySystem::State&) { return false; };

std::ptrdiff_t factorisations(const StepResult<ToySystem::State, ToySystem::Trial>& of) {
  std::ptrdiff_t sum = 0;
  for (const IncrementRecord& i : of.increments) sum += count_factorisations(i.iterations).whole;
  return sum;
}

TEST(FormerFactors, PassFromOneIncrementToTheNext) {
  ToySystem system = springs();
  StepPosition one, each;
  const auto passed = increments(system, 4, never, one);
  const auto anew = increments(
      system, 4, [](int, const auto&) { return true; }, each);
  ASSERT_EQ(passed.outcome, Outcome::converged) << passed.reason;
  EXPECT_EQ(factorisations(passed), 1);
  EXPECT_EQ(factorisations(anew), 4);
  EXPECT_LT((passed.state.x - anew.state.x).norm(), 1e-9 * anew.state.x.norm());
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(passed.increments[i].iterations.size(), anew.increments[i].iterations.size());
}

// Who goes on from there has a solver without factors.
TEST(FormerFactors, DoNotPassWhereALaterRunMayGoOn) {
  ToySystem system = springs();
  StepPosition whole, rest;
  ToySystem::State middle;
  const auto all = increments(
      system, 4,
      [&](int n, const ToySystem::State& state) {
        if (n != 2) return false;
        middle = state;
        rest = whole;
        return true;
      },
      whole);
  const auto later = increments(system, 4, never, rest, middle);
  EXPECT_EQ(factorisations(all), 2);
  EXPECT_EQ(later.increments.size(), 2U);
  EXPECT_EQ(later.state.x, all.state.x);
}

// States are the same before and after; noise says that nothing holds the springs any more.
TEST(FormerFactors, OfAnEarlierIncrementEndNothingThatHasComeLoose) {
  for (const bool loose : {false, true}) {
    SCOPED_TRACE(loose);
    double held = 1;
    ToySystem system = springs();
    const Eigen::MatrixXd k = loose_springs();
    const Eigen::VectorXd load = balanced_load();
    system.force = [&](const Eigen::VectorXd& x, double t) -> Eigen::VectorXd {
      Eigen::VectorXd f = k * x - t * load;
      f[0] += held * x[0];
      return f;
    };
    system.stiffness = [&](const Eigen::VectorXd&) {
      Eigen::MatrixXd tangent = k;
      tangent(0, 0) += held;
      return tangent;
    };
    StepPosition position;
    const auto result = increments(
        system, 2,
        [&](int, const auto&) {
          if (loose) held = 0;
          return false;
        },
        position);
    EXPECT_EQ(result.increments.size(), loose ? 1U : 2U);
    EXPECT_EQ(result.outcome, loose ? Outcome::numerical_failure : Outcome::converged);
    if (!loose) {
      EXPECT_EQ(factorisations(result), 1);
    }
  }
}

// Pivots are those of the end of each increment.
TEST(FormerFactors, OfAnEarlierIncrementEndNoneThatIsUnstable) {
  const double critical = 1 / column(0).trial.x[0];
  for (const double share : {0.9, 1.001, 1.5}) {
    SCOPED_TRACE(share);
    RestingSystem system = column_of(share * critical);
    la::Mumps mumps;
    Condensation<RestingSystem> passing;
    const ToySystem::State start{Eigen::VectorXd::Zero(size)};
    const auto first = passing.of_all(system, start, 0.5, {}, mumps, {});
    ASSERT_EQ(first.outcome, Outcome::converged) << first.reason;
    EXPECT_EQ(first.negative_pivots, 0);
    const auto second = passing.of_all(system, first.trial, 1.0, {}, mumps, {});
    ASSERT_EQ(second.outcome, Outcome::converged) << second.reason;
    EXPECT_FALSE(second.iterations.front().factored);
    EXPECT_EQ(second.negative_pivots, share > 1 ? 1 : 0);
    EXPECT_EQ(second.iterations.back().factored, share > 1);
  }
}

}  // namespace
}  // namespace osculate::solve
