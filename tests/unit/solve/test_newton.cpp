#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "osculate/la/mumps.hpp"
#include "retold_solver.hpp"
#include "toy_system.hpp"

namespace osculate::solve {
namespace {

ToySystem cubic() {
  return scalar_system([](double x, double t) { return x * x * x + x - 10 * t; },
                       [](double x) { return 3 * x * x + 1; });
}

NewtonResult<ToySystem::State> solve_from(ToySystem& system, double x, const NewtonOptions& options,
                                          double time = 1) {
  la::Mumps solver;
  return newton(system, {vector({x})}, time, options, solver);
}

TEST(Newton, ConvergesQuadratically) {
  ToySystem system = cubic();
  const auto result =
      solve_from(system, 1.0, {.residual = 1e-14, .energy = 0, .line_search = LineSearch::off});
  ASSERT_EQ(result.outcome, Outcome::converged);
  EXPECT_NEAR(result.trial.x[0], 2.0, 1e-15);
  std::vector<double> error;
  for (const Eigen::VectorXd& x : system.evaluated)
    if (std::abs(x[0] - 2.0) > 1e-13) error.push_back(std::abs(x[0] - 2.0));
  ASSERT_GE(error.size(), 4u);
  const std::size_t n = error.size();
  // e' = e^2 f''/(2 f') at the root, f'' = 12, f' = 13
  EXPECT_NEAR(error[n - 1] / (error[n - 2] * error[n - 2]), 6.0 / 13.0, 1e-2);
}

TEST(Newton, TellsOfEachIterationWhenItIsDone) {
  ToySystem system = cubic();
  NewtonOptions options;
  std::vector<IterationRecord> told;
  std::vector<std::size_t> evaluated;
  options.iterated = [&](const IterationDone& done) {
    EXPECT_EQ(done.number, std::ssize(told) + 1);
    EXPECT_EQ(done.to, 0.75);
    told.push_back(done.record);
    evaluated.push_back(system.evaluated.size());
  };
  const auto result = solve_from(system, 1.0, options, 0.75);
  ASSERT_EQ(result.outcome, Outcome::converged);
  ASSERT_EQ(told.size(), result.iterations.size());
  ASSERT_GE(told.size(), 3u);
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(told[i].residual, result.iterations[i].residual);
    EXPECT_EQ(told[i].energy, result.iterations[i].energy);
    if (i == 0) continue;
    EXPECT_GT(evaluated[i], evaluated[i - 1]);  // not all at the end
  }
}

/// The stop of every measure, against a Newton loop written out here.
struct Counts {
  int residual = 0, energy_before = 0, both = 0;
};
Counts reference_counts(double residual_tolerance, double energy_tolerance) {
  Counts counts;
  double x = 1, first = 0;
  for (int i = 1; i < 30; ++i) {
    const double r = x * x * x + x - 10, du = -r / (3 * x * x + 1);
    if (i == 1) first = std::abs(du * r);
    const double before = std::abs(du * r);
    x += du;
    const double now = std::abs(x * x * x + x - 10), after = std::abs(du) * now;
    if (!counts.residual && now <= residual_tolerance) counts.residual = i;
    if (!counts.energy_before && before <= energy_tolerance * first) counts.energy_before = i;
    if (!counts.both && now <= residual_tolerance && after <= energy_tolerance * first)
      counts.both = i;
  }
  return counts;
}

TEST(Newton, EveryMeasureStopsWhereItShould) {
  for (const double residual : {1e-2, 1e-5, 1e-9})
    for (const double energy : {1e-3, 1e-8, 1e-16}) {
      SCOPED_TRACE(::testing::Message() << residual << " " << energy);
      const Counts expected = reference_counts(residual, energy);
      ToySystem system = cubic();
      const auto count = [&](double r, double e) {
        return static_cast<int>(
            solve_from(system, 1.0, {.residual = r, .energy = e}).iterations.size());
      };
      EXPECT_EQ(count(residual, 0), expected.residual);
      EXPECT_EQ(count(0, energy), expected.energy_before);
      EXPECT_EQ(count(residual, energy), expected.both);
    }
}

/// The papers count the solve that the energy is measured with: a linear system takes two.
TEST(Newton, EnergyAloneCountsTheLastSolve) {
  ToySystem system =
      scalar_system([](double x, double t) { return 3 * x - t; }, [](double) { return 3.0; });
  EXPECT_EQ(solve_from(system, 0.0, {.residual = 0, .energy = 1e-12}).iterations.size(), 1u)
      << "nothing is left: round-off ends it at once";
  ToySystem nearly = scalar_system([](double x, double t) { return 3 * x - t; },
                                   [](double) { return 3.0 * (1 + 1e-7); });
  const auto result = solve_from(nearly, 0.0, {.residual = 0, .energy = 1e-12});
  ASSERT_EQ(result.iterations.size(), 2u);
  EXPECT_EQ(result.iterations[0].energy, 1.0);
  EXPECT_NEAR(result.iterations[1].energy, 1e-14, 1e-17);
}

TEST(Newton, NothingToDoIsConverged) {
  ToySystem system =
      scalar_system([](double x, double) { return 5 * x; }, [](double) { return 5.0; });
  system.scale = [](const Eigen::VectorXd&, double) { return 0.0; };
  const auto result = solve_from(system, 0.0, {});
  EXPECT_EQ(result.outcome, Outcome::converged);
  EXPECT_EQ(result.iterations.size(), 1u);
  EXPECT_EQ(result.trial.x[0], 0.0);
}

/// A tangent that corrects a part of the error alone, and an estimate of rounding above the load.
TEST(Newton, RoundOffEndsNothingThatStillImproves) {
  ToySystem system =
      scalar_system([](double x, double) { return x - 1; }, [](double) { return 1.25; });
  system.round_off = 100;
  const auto result = solve_from(system, 0.0, {.line_search = LineSearch::off});
  ASSERT_EQ(result.outcome, Outcome::converged);
  EXPECT_NEAR(result.trial.x[0], 1, 1e-9);
  EXPECT_FALSE(result.precision.round_off);
}

/// A residual x - 1 that keeps a noise.
ToySystem noisy(double noise, int& calls) {
  ToySystem system = scalar_system(
      [&calls, noise](double x, double) { return x - 1 + (++calls % 2 ? noise : -noise); },
      [](double) { return 1.0; });
  system.round_off = 10 * noise;
  return system;
}

/// Accepted where the noise is small beside what drives the system, nothing drives it, or inertia
/// has the noise; and said; else not.
TEST(Newton, RoundOffIsAcceptedWhereItIsSmallOrAll) {
  struct Case {
    double noise, start;
    bool loaded, in_time, good;
  };
  const std::vector<Case> cases{{1e-7, 0, true, false, true},  {1e-7, 0, false, false, true},
                                {1e-2, 0, true, false, false}, {1e-2, 0, false, false, false},
                                {1e-2, 1, false, false, true}, {1e-2, 1, true, false, false},
                                {1e-2, 0, true, true, true}};
  for (const Case& c : cases) {
    SCOPED_TRACE(::testing::Message() << c.noise << " from " << c.start << c.loaded << c.in_time);
    int calls = 0;
    ToySystem system = noisy(c.noise, calls);
    system.loaded = c.loaded;
    if (c.in_time) system.round_off_in_time = system.round_off;
    const auto result = solve_from(system, c.start, {.line_search = LineSearch::off});
    EXPECT_EQ(result.outcome, c.good ? Outcome::converged : Outcome::not_converged);
    EXPECT_EQ(result.precision.round_off, c.good);
  }
}

/// Without an estimate: what stands still for three iterations is accepted where a millionth of the
/// forces is out of balance and its work is below the tolerance, and said.
TEST(Newton, StandingResidualsAreAcceptedFarBelowTheForces) {
  for (const double noise : {1e-7, 1e-5}) {
    int calls = 0;
    ToySystem system = noisy(noise, calls);
    system.round_off = 0;
    const auto result = solve_from(system, 0, {.line_search = LineSearch::off});
    const bool small = noise < 1e-6;
    EXPECT_EQ(result.outcome, small ? Outcome::converged : Outcome::not_converged) << noise;
    EXPECT_EQ(result.precision.round_off, small);
    EXPECT_EQ(result.iterations.size() < 7, small);
  }
}

/// Nothing happens in the increment: the first energy is noise, and so are all others.
TEST(Newton, ARestThatStandsFarBelowItsToleranceIsConverged) {
  for (const double noise : {3e-14, 3e-11, 3e-10}) {
    int calls = 0;
    ToySystem system = noisy(noise, calls);
    system.round_off = 0;
    const auto result = solve_from(system, 1, {.line_search = LineSearch::off});
    EXPECT_EQ(result.outcome == Outcome::converged, noise < 1e-10) << noise;
    EXPECT_FALSE(result.precision.round_off);
  }
}

/// A force that jumps over zero: corrections shrink to nothing there.
TEST(Newton, ACorrectionOfWhichNoPartHelpsEndsTheAttempt) {
  ToySystem system = scalar_system([](double x, double) { return x + (x < 0.1 ? -1 : 1); },
                                   [](double) { return 1.0; });
  const auto result = solve_from(system, -0.5, {});
  EXPECT_EQ(result.outcome, Outcome::not_converged);
  EXPECT_EQ(result.reason, "no part of the correction lessens the forces out of balance");
  EXPECT_LT(result.iterations.size(), 10u);
}

/// Along a narrow curved valley the residual grows before it vanishes: guided by its norm alone,
/// steps are short all the way. (Of the first iteration, which is not searched, a tangent leads
/// there.)
TEST(Newton, StepsThatCreepNearASolutionGiveWayToAWholeOne) {
  static constexpr double across = 100;
  ToySystem system;
  system.size = 2;
  system.builder = la::MatrixBuilder{2};
  system.force = [](const Eigen::VectorXd& x, double) {
    return Eigen::VectorXd(Eigen::Vector2d(x[0], across * (x[1] - x[0] * x[0])));
  };
  system.stiffness = [](const Eigen::VectorXd& x) {
    Eigen::Matrix2d k;
    k << 1, 0, -2 * across * x[0], across;
    if (x[0] > 4) k << 1.25, 0, 0, 25 * across;  // from (5, 0) to (1, 1)
    return Eigen::MatrixXd(k);
  };
  system.scale = [](const Eigen::VectorXd&, double) { return 1e5; };
  la::Mumps solver;
  const auto result =
      newton<ToySystem>(system, {Eigen::Vector2d(5, 0)}, 1.0, {.residual = 1e-12}, solver);
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  for (std::size_t i = 1; i < 4; ++i) EXPECT_LT(result.iterations[i].step, 0.3) << i;
  EXPECT_EQ(result.iterations[4].step, 1);
  EXPECT_LE(result.iterations.size(), 7u);
}

TEST(Newton, SingularTangent) {
  ToySystem system = scalar_system([](double, double t) { return t; }, [](double) { return 0.0; });
  const auto result = solve_from(system, 0.0, {});
  EXPECT_EQ(result.outcome, Outcome::numerical_failure);
  EXPECT_EQ(result.reason, "the tangent is singular");
  EXPECT_EQ(result.linear, la::SolveStatus::singular);
  EXPECT_TRUE(result.iterations.empty());
  EXPECT_EQ(result.trial.x[0], 0.0);
}

/// Unknown 1 has hardly any stiffness, and `noise` pushes it back and forth.
TEST(Newton, WhatMovesWithoutWorkIsNotWaitedFor) {
  const auto solved = [](double noise) {
    ToySystem system;
    system.size = 2;
    system.builder = la::MatrixBuilder{2};
    system.stiffness = [](const Eigen::VectorXd&) {
      return Eigen::MatrixXd(Eigen::Vector2d(1, 1e-14).asDiagonal());
    };
    int count = 0;
    system.force = [&count, noise](const Eigen::VectorXd& x, double) {
      return vector({x[0] - 1, (++count % 2 == 0 ? 1 : -1) * noise});
    };
    support::RetoldSolver solver([](la::FactorReport& report) { report.condition = 1e15; });
    return newton<ToySystem>(system, {vector({0, 0})}, 1.0, {}, solver);
  };
  const auto rounding = solved(1e-16);  // it moves by 0.01 each time
  EXPECT_EQ(rounding.outcome, Outcome::converged);
  EXPECT_LE(rounding.iterations.size(), 2u);
  EXPECT_NEAR(rounding.trial.x[0], 1, 1e-12);
  EXPECT_EQ(solved(1e-9).outcome, Outcome::not_converged) << "a force that does work";
}

TEST(Newton, FailuresSayWhy) {
  ToySystem inverted = cubic();
  inverted.wrong = [](const Eigen::VectorXd& x, const Eigen::VectorXd&) {
    return std::string(x[0] > 1.5 ? "cell 7 turned inside out" : "");
  };
  const auto first = solve_from(inverted, 1.0, {});
  EXPECT_EQ(first.outcome, Outcome::numerical_failure);
  EXPECT_EQ(first.reason, "cell 7 turned inside out");

  ToySystem not_a_number = scalar_system([](double x, double t) { return std::log(1 - x) + t; },
                                         [](double x) { return -1 / (1 - x); });
  const auto second = solve_from(not_a_number, 0.0, {}, 5.0);
  EXPECT_EQ(second.outcome, Outcome::numerical_failure);
  EXPECT_EQ(second.reason, "the residual is not a number");

  // Newton on sign(x) sqrt|x| goes from x to -x for ever.
  ToySystem cycle =
      scalar_system([](double x, double) { return std::copysign(std::sqrt(std::abs(x)), x); },
                    [](double x) { return 0.5 / std::sqrt(std::abs(x)); });
  const auto third = solve_from(cycle, 1.0, {.max_iterations = 7, .line_search = LineSearch::off});
  EXPECT_EQ(third.outcome, Outcome::not_converged);
  EXPECT_EQ(third.reason, "not converged after 7 iterations");
  EXPECT_EQ(third.iterations.size(), 7u);
  EXPECT_NEAR(third.trial.x[0], -1.0, 1e-12);
}

/// Newton on sign(x) |x|^0.4 goes from x to -1.5 x: what is left does 1.5^1.4 times the work of the
/// iteration before, more than ten times that of the first one after five. Eight such are enough.
TEST(Newton, EndsEarlyWhereEveryCorrectionLeavesMore) {
  constexpr double power = 0.4;
  ToySystem system =
      scalar_system([](double x, double) { return std::copysign(std::pow(std::abs(x), power), x); },
                    [](double x) { return power * std::pow(std::abs(x), power - 1); });
  const auto result =
      solve_from(system, 1.0, {.max_iterations = 25, .line_search = LineSearch::off});
  EXPECT_EQ(result.outcome, Outcome::not_converged);
  EXPECT_EQ(result.reason, "the iterations diverge: every correction leaves more out of balance");
  ASSERT_EQ(result.iterations.size(), 12u);
  EXPECT_NEAR(result.trial.x[0], std::pow(-1.5, 12), 1e-9);
  EXPECT_LT(result.iterations[3].energy, 10);
  EXPECT_GT(result.iterations[4].energy, 10);
}

/// Each iteration leaves the same share of the residual.
TEST(Newton, GoesOnWhileTheResidualHalvesEveryTenIterations) {
  const auto with_share = [](double share) {
    ToySystem slow = scalar_system([](double x, double t) { return x - t; },
                                   [share](double) { return 1 / (1 - share); });
    return solve_from(slow, 0.0, {.residual = 1e-8, .energy = 0, .line_search = LineSearch::off});
  };
  const auto gains = with_share(0.8);
  EXPECT_EQ(gains.outcome, Outcome::converged) << gains.reason;
  EXPECT_GT(gains.iterations.size(), 75U);
  const auto limited = with_share(0.9);
  EXPECT_EQ(limited.outcome, Outcome::not_converged);
  EXPECT_EQ(limited.iterations.size(), 100U);
  const auto creeps = with_share(0.95);
  EXPECT_EQ(creeps.outcome, Outcome::not_converged);
  EXPECT_EQ(creeps.iterations.size(), 25U);
}

/// Tells once, when it is asked, that its last matrix was not sound.
class Doubtful final : public la::LinearSolver {
 public:
  la::FactorReport factor(const la::SparseMatrix& k, std::uint64_t version,
                          la::Symmetry symmetry) override {
    return inner_.factor(k, version, symmetry);
  }
  la::SolveStatus solve(Eigen::VectorXd& rhs) override { return inner_.solve(rhs); }
  la::SolveStatus solve(Eigen::MatrixXd& rhs) override { return inner_.solve(rhs); }
  [[nodiscard]] double seconds() const override { return inner_.seconds(); }
  [[nodiscard]] bool sound() override { return std::exchange(sound_, true); }

 private:
  la::Mumps inner_;
  bool sound_ = false;
};

TEST(Newton, HasOneIterationMoreWhereTheLastWasNotSound) {
  ToySystem system =
      scalar_system([](double x, double t) { return x - t; }, [](double) { return 1.0; });
  Doubtful solver;
  const auto result =
      newton(system, {vector({0.0})}, 1.0, {.residual = 1e-8, .max_iterations = 1}, solver);
  EXPECT_EQ(result.outcome, Outcome::converged) << result.reason;
  EXPECT_EQ(result.iterations.size(), 2U);
}

/// Two springs in a row, the first end moved: the boundary moves with the body, not ahead of it.
ToySystem chain(double stiffening) {
  ToySystem system;
  system.size = 2;
  system.builder = la::MatrixBuilder(2);
  system.force = [stiffening](const Eigen::VectorXd& x, double) {
    const double e = x[0] - x[1];
    const double f = e + stiffening * e * e * e;
    return vector({f, -f + x[1]});
  };
  system.stiffness = [stiffening](const Eigen::VectorXd& x) {
    const double e = x[0] - x[1], k = 1 + 3 * stiffening * e * e;
    Eigen::MatrixXd m(2, 2);
    m << k, -k, -k, k + 1;
    return m;
  };
  system.prescribed = [](double t) { return 2 * t; };
  return system;
}

TEST(Newton, PrescribedValuesEnterThroughTheTangent) {
  ToySystem linear = chain(0);
  la::Mumps solver;
  const auto result = newton(linear, {vector({0, 0})}, 1.0, {}, solver);
  ASSERT_EQ(result.outcome, Outcome::converged);
  EXPECT_EQ(result.iterations.size(), 1u);
  EXPECT_EQ(result.trial.x[0], 2.0);
  EXPECT_NEAR(result.trial.x[1], 1.0, 1e-15);

  ToySystem stiff = chain(5.0);
  const auto second = newton(stiff, {vector({0, 0})}, 1.0, {.residual = 1e-13}, solver);
  ASSERT_EQ(second.outcome, Outcome::converged);
  ASSERT_GE(stiff.evaluated.size(), 2u);
  EXPECT_EQ(stiff.evaluated[0], vector({0, 0}));                    // the committed state
  EXPECT_TRUE(stiff.evaluated[1].isApprox(vector({2, 1}), 1e-15));  // its linear answer
  EXPECT_EQ(stiff.predicted_to, std::vector<double>{1.0});
  const double e = second.trial.x[0] - second.trial.x[1];
  EXPECT_NEAR(e + 5 * e * e * e, second.trial.x[1], 1e-12);
}

/// A point that sticks within 1e-6 and slips with force 1 on either side: Newton jumps over.
ToySystem friction() {
  constexpr double stick = 1e6;
  return scalar_system(
      [](double x, double t) { return std::clamp(stick * x, -1.0, 1.0) + x - 0.3 * t; },
      [](double x) { return std::abs(stick * x) <= 1 ? stick + 1 : 1.0; });
}

TEST(Newton, LineSearchFindsTheStickingRange) {
  ToySystem plain = friction();
  const auto off = solve_from(plain, -0.5, {.line_search = LineSearch::off});
  EXPECT_EQ(off.outcome, Outcome::not_converged);
  ToySystem searched = friction();
  const auto on = solve_from(searched, -0.5, {});
  ASSERT_EQ(on.outcome, Outcome::converged) << on.reason;
  EXPECT_NEAR(on.trial.x[0], 0.3 / (1e6 + 1), 1e-15);
  EXPECT_EQ(on.iterations[0].step, 1.0);
  EXPECT_LT(on.iterations[1].step, 1.0);
}

/// An evaluation that has no answer shortens the correction instead of ending the attempt.
TEST(Newton, LineSearchStaysWhereThereIsAnAnswer) {
  // atan: from 1.45 to -1.551, from there the full correction would go to 1.848.
  ToySystem system = scalar_system([](double x, double) { return std::atan(x); },
                                   [](double x) { return 1 / (1 + x * x); });
  system.wrong = [](const Eigen::VectorXd& x, const Eigen::VectorXd&) {
    return std::string(std::abs(x[0]) < 1.6 ? "" : "too far");
  };
  const auto result = solve_from(system, 1.45, {});
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  EXPECT_NEAR(result.trial.x[0], 0, 1e-9);
  EXPECT_EQ(result.iterations[1].step, 0.5);
  const auto plain = solve_from(system, 1.45, {.line_search = LineSearch::off});
  EXPECT_EQ(plain.outcome, Outcome::numerical_failure);
  EXPECT_EQ(plain.reason, "too far");
  EXPECT_EQ(plain.iterations.size(), 1u);
}

/// A soft spring of stiffness 1 that a force of 40 drives against a wall at 12.
Eigen::VectorXd pushed_back(const Eigen::VectorXd& x) {
  constexpr double stiffness = 1e6;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(x.size());
  const Eigen::Index last = x.size() - 1;
  f[last] = stiffness * std::max(x[last] - 12, 0.0);
  return f;
}

// The first correction knows no wall: of it no more than the way to the wall is taken.
TEST(Newton, TheFirstCorrectionEndsWhereItMeetsMoreThanItBrought) {
  ToySystem system =
      scalar_system([](double x, double t) { return x + pushed_back(vector({x}))[0] - 40 * t; },
                    [](double x) { return x > 12 ? 1e6 + 1 : 1.0; });
  system.touching = [](const Eigen::VectorXd& x) { return x[0] > 12 ? 1 : 0; };
  const auto result = solve_from(system, 0, {});
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  EXPECT_NEAR(result.trial.x[0], 12 + 28 / (1e6 + 1), 1e-9);
  EXPECT_LT(result.iterations[0].step, 0.3 + 1e-6);
  EXPECT_GT(result.iterations[0].step, 0.25);
  EXPECT_LE(result.iterations.size(), 6U);
  // Without a wall, or one that gives way, all of it is.
  EXPECT_EQ(solve_from(system, 0, {}, 0.2).iterations[0].step, 1.0);
  ToySystem soft =
      scalar_system([](double x, double t) { return x + std::max(x - 12, 0.0) - 40 * t; },
                    [](double x) { return x > 12 ? 2.0 : 1.0; });
  soft.touching = system.touching;
  EXPECT_EQ(solve_from(soft, 0, {}).iterations[0].step, 1.0);
}

// What is prescribed has moved in whole: bodies that came along by a part would be torn.
TEST(Newton, TheFirstCorrectionFollowsWhatIsPrescribed) {
  ToySystem system;
  system.size = 2;
  system.force = [](const Eigen::VectorXd& x, double) {
    return Eigen::VectorXd(vector({x[0] - x[1], x[1] - x[0]}) + pushed_back(x));
  };
  system.stiffness = [](const Eigen::VectorXd& x) {
    Eigen::MatrixXd k(2, 2);
    k << 1, -1, -1, 1 + (x[1] > 12 ? 1e6 : 0.0);
    return k;
  };
  system.builder = la::MatrixBuilder(2);
  system.prescribed = [](double t) { return 40 * t; };
  system.touching = [](const Eigen::VectorXd& x) { return x[1] > 12 ? 1 : 0; };
  la::Mumps solver;
  const auto result = newton(system, {vector({0, 0})}, 1.0, {}, solver);
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  EXPECT_EQ(result.iterations[0].step, 1.0);
}

}  // namespace
}  // namespace osculate::solve
