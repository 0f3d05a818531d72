// Time steps that are chosen by their errors.
#include "osculate/la/mumps.hpp"
#include "osculate/solve/time_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "toy_system.hpp"

namespace osculate::solve {
namespace {

// ---- the error of one step ---------------------------------------------------------------------

struct Flight {
  double u, v, a;
};

/// One step of a mass 1 under a force f(t) per mass.
template <class Force>
Flight step(const TimeScheme& s, double t, double h, const Flight& at, const Force& force) {
  const double f = (1 - s.alpha_f) * force(t + h) + s.alpha_f * force(t);
  const double a = (f - s.alpha_m * at.a) / (1 - s.alpha_m);
  return {at.u + h * at.v + h * h * ((0.5 - s.beta) * at.a + s.beta * a),
          at.v + h * ((1 - s.gamma) * at.a + s.gamma * a), a};
}

double relative_miss(const TimeScheme& s, double h) {
  const double t = 0.7;  // u = sin t
  const auto force = [](double at) { return -std::sin(at); };
  const Flight at{std::sin(t), std::cos(t), force(t + (s.alpha_m - s.alpha_f) * h)};
  const Flight next = step(s, t, h, at, force);
  const double error = next.u - std::sin(t + h);
  return error_factor(s) * h * h * (next.a - at.a) / error - 1;
}

TEST(ErrorFactor, IsTheOneOfTheLocalError) {
  for (const TimeScheme& s : {newmark(), hht(0.05), hht(1.0 / 3), generalized_alpha(0),
                              generalized_alpha(0.6), generalized_alpha(1)}) {
    const double coarse = relative_miss(s, 0.02), fine = relative_miss(s, 0.01);
    EXPECT_LT(std::abs(fine), 0.05);
    EXPECT_NEAR(std::log2(std::abs(coarse / fine)), 1, 0.05);
  }
}

TEST(ErrorFactor, DoesNotVanish) {
  EXPECT_DOUBLE_EQ(error_factor(newmark()), 1.0 / 12);
  for (const double r : {0.0, 0.3, 1.0}) {
    const TimeScheme s = generalized_alpha(r);
    const double shift = s.alpha_m - s.alpha_f;
    EXPECT_NEAR(error_factor(s), 1.0 / 12 + 0.25 * shift * shift, 1e-15);
  }
}

// ---- lengths -----------------------------------------------------------------------------------

TEST(TimeTarget, HitsCornersAndTheEnd) {
  const std::vector<double> corners{0.2, 0.5};
  EXPECT_EQ(time_target(0, 0.3, 1, corners), 0.2);
  EXPECT_EQ(time_target(0.2, 0.1, 1, corners), 0.2 + 0.1);
  EXPECT_EQ(time_target(0.2, 0.25, 1, corners), 0.2 + 0.5 * (0.5 - 0.2));
  EXPECT_EQ(time_target(0.5, 2, 1, corners), 1);
  EXPECT_EQ(time_target(0.5, 0.4, 1, corners), 0.75);
  EXPECT_EQ(time_target(0, 0.1 * (1 - 1e-8), 0.1, {}), 0.1);       // no slivers
  EXPECT_EQ(time_target(0, 0.1, 0.5, {0.5 * (1 - 1e-9)}), 0.1);    // nor at the end
  EXPECT_EQ(time_target(0.2 * (1 - 1e-9), 0.3, 1, corners), 0.5);  // nor at a corner
}

TEST(TimeLengths, FollowTheError) {
  // The rate of the error is of second order: the next one is 0.64 of what is allowed.
  EXPECT_DOUBLE_EQ(shorter(0.1, 4, 0), 0.04);
  EXPECT_DOUBLE_EQ(shorter(0.1, 1e6, 0), 0.01);
  EXPECT_DOUBLE_EQ(shorter(0.1, 1e6, 0.02), 0.02);
  EXPECT_DOUBLE_EQ(next_length(0.1, 0.1, 1.44, true, 0, 1), 0.1 * 0.8 / 1.2);
  EXPECT_DOUBLE_EQ(next_length(0.1, 0.1, 0.25, true, 0, 1), 0.16);
  EXPECT_DOUBLE_EQ(next_length(0.1, 0.1, 1e-6, true, 0, 1), 0.2);
  EXPECT_DOUBLE_EQ(next_length(0.1, 0.1, 0, true, 0, 0.15), 0.15);
}

TEST(TimeLengths, StayWhereTheyFit) {
  for (const double share : {0.35, 0.64, 1.0})
    EXPECT_EQ(next_length(0.1, 0.1, share, true, 0, 1), 0.1);
  EXPECT_EQ(next_length(0.1, 0.1, 0.01, false, 0, 1), 0.1);
  // One that was cut to hit something says nothing against longer ones.
  EXPECT_EQ(next_length(0.1, 0.01, 0.0064, true, 0, 1), 0.1);
}

TEST(TimeErrors, AreSmallAgainstTheLargestSpeed) {
  const TimePace fresh;
  EXPECT_EQ(relative_error({0, 0, 1}, fresh), 0);
  EXPECT_EQ(relative_error({2, 4, 1}, fresh), 0.5);
  const TimePace tried = after_refusal(fresh, {2, 8, 1}, 0.5);
  EXPECT_EQ(relative_error({2, 4, 1}, tried), 0.25);
  const TimePace within = after_step(tried, {2, 4, 1}, 0.25);
  EXPECT_EQ(relative_error({2, 1, 1}, within), 0.25);
  const TimePace behind = after_step(within, {2, 1, 1}, 0.5);
  EXPECT_EQ(relative_error({2, 1, 1}, behind), 0.5);
}

// ---- the step control --------------------------------------------------------------------------

/// x is the time; the error of a step is roughness(at its end) h^2.
struct TimedSystem : ToySystem {
  std::function<double(double time)> roughness;
  [[nodiscard]] TimeError time_error(const State& committed, const State& next) const {
    const double h = next.x[0] - committed.x[0];
    return {roughness(next.x[0]) * h * h, 1, h};
  }
};

static_assert(EstimatesTimeErrors<TimedSystem>);
static_assert(!EstimatesTimeErrors<ToySystem>);

TimedSystem timed(std::function<double(double)> roughness) {
  TimedSystem system;
  system.force = [](const Eigen::VectorXd& x, double t) { return vector({x[0] - t}); };
  system.stiffness = [](const Eigen::VectorXd&) { return Eigen::MatrixXd::Identity(1, 1); };
  system.roughness = std::move(roughness);
  return system;
}

struct Taken {
  std::vector<double> ends, errors;
  std::vector<StepPosition> positions;
  int refused = 0, commits = 0;
};

Taken run_from(TimedSystem& system, const IncrementOptions& options, int increments, double start,
               StepPosition position) {
  la::Mumps solver;
  Taken run;
  const auto result = run_step(
      system, ToySystem::State{vector({start})}, increments, options, solver,
      IncrementObserver<ToySystem::State>([&](const ToySystem::State& state,
                                              const IncrementRecord& record) {
        EXPECT_EQ(state.x[0], record.fraction);
        run.ends.push_back(record.fraction);
        run.errors.push_back(record.time_step.error);
        run.positions.push_back(position);
        run.refused += record.time_step.refused;
        run.commits = state.commits;
        EXPECT_NEAR(record.time_step.length,
                    record.fraction - (run.ends.size() > 1 ? run.ends[run.ends.size() - 2] : start),
                    1e-15);
        return true;
      }),
      CutbackObserver(
          [](const std::string&, double, double, const std::vector<IterationRecord>&) {}),
      position);
  EXPECT_EQ(result.outcome, Outcome::converged);
  return run;
}

Taken run_all(TimedSystem& system, const TimeAccuracy& accuracy, int increments) {
  IncrementOptions options;
  options.time_steps = accuracy;
  return run_from(system, options, increments, 0, {});
}

/// Thirty times as short steps in the middle.
double bump(double t) { return t > 0.37 && t < 0.55 ? 1e3 : 1; }

TEST(TimeSteps, HaveTheErrorThatIsAllowed) {
  for (const double error : {1e-2, 1e-3, 1e-4}) {
    TimedSystem system = timed([](double) { return 1.0; });
    const Taken run = run_all(system, {error, 0, {}}, 1);
    const double ideal = 1 / (0.8 * std::sqrt(error));  // number of steps
    EXPECT_GT(run.ends.size(), ideal / 1.4);
    EXPECT_LT(run.ends.size(), ideal * 1.4 + 2);
    for (const double e : run.errors) EXPECT_LE(e, 1.5 * error);
    EXPECT_LE(run.refused, 3);
  }
}

TEST(TimeSteps, AreShortWhereItIsRoughOnly) {
  TimedSystem system = timed(bump);
  const Taken run = run_all(system, {1e-2, 0, {}}, 2);
  int within = 0;
  for (const double end : run.ends) within += end > 0.37 && end < 0.55 ? 1 : 0;
  EXPECT_GT(within, 50);
  EXPECT_LT(run.ends.size() - static_cast<std::size_t>(within), 40u);
  for (const double e : run.errors) EXPECT_LE(e, 1.5e-2);
  EXPECT_NE(std::find(run.ends.begin(), run.ends.end(), 0.5), run.ends.end());
  EXPECT_EQ(run.ends.back(), 1);
}

TEST(TimeSteps, HitTheCorners) {
  TimedSystem system = timed([](double) { return 1.0; });
  const std::vector<double> corners{0.1, 0.37, 0.6};
  const Taken run = run_all(system, {5e-3, 0, corners}, 2);
  for (const double corner : corners)
    EXPECT_NE(std::find(run.ends.begin(), run.ends.end(), corner), run.ends.end()) << corner;
}

TEST(TimeSteps, OfTheSmallestLengthAreNotRefused) {
  TimedSystem system = timed([](double) { return 1e12; });
  const Taken run = run_all(system, {1e-3, 0.01, {}}, 1);
  EXPECT_GE(run.ends.size(), 99u);
  EXPECT_LE(run.ends.size(), 101u);
}

TEST(TimeSteps, WithoutErrorsAreTheNominalIncrements) {
  TimedSystem system = timed([](double) { return 0.0; });
  EXPECT_EQ(run_all(system, {1e-3, 0, {}}, 4).ends, (std::vector<double>{0.25, 0.5, 0.75, 1}));
}

TEST(TimeSteps, RefusedOnesAreDropped) {
  TimedSystem system = timed(bump);
  const Taken run = run_all(system, {1e-2, 0, {}}, 2);
  EXPECT_GE(run.refused, 2);
  EXPECT_EQ(run.commits, static_cast<int>(run.ends.size()));  // of the states on the way
}

TEST(TimeSteps, GoOnFromEveryPlaceAsIfTheyHadNeverStopped) {
  TimedSystem system = timed(bump);
  IncrementOptions options;
  options.time_steps = TimeAccuracy{1e-2, 0, {0.37}};
  const Taken whole = run_from(system, options, 2, 0, {});
  for (std::size_t i = 0; i + 1 < whole.ends.size(); ++i) {
    const Taken rest = run_from(system, options, 2, whole.ends[i], whole.positions[i]);
    EXPECT_TRUE(std::equal(rest.ends.begin(), rest.ends.end(),
                           whole.ends.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                           whole.ends.end()))
        << i;
  }
}

TEST(TimeSteps, ThatFailAreHalvedFromWhereTheyAre) {
  TimedSystem system = timed([](double) { return 100.0; });
  system.wrong = [](const Eigen::VectorXd& x, const Eigen::VectorXd& committed) {
    return x[0] - committed[0] > 3e-3 ? std::string("too far") : std::string();
  };
  const Taken run = run_all(system, {1e-2, 1e-3, {}}, 1);  // 8e-3 by the error
  EXPECT_EQ(run.ends.back(), 1);
  EXPECT_GT(run.ends.size(), 300u);
}

}  // namespace
}  // namespace osculate::solve
