// The line search of hosts takes the steps that the program's own takes.
#include "osculate/line_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "../solve/toy_system.hpp"

namespace osculate {
namespace {

using solve::ToySystem;

/// Residuals of two unknowns along (1, 0): slopes, kinks and a jump, or none up to a step.
struct Wavy {
  Eigen::Vector2d start, slope;
  std::array<Eigen::Vector2d, 3> kink;
  std::array<double, 3> at;
  Eigen::Vector2d jump;
  double jumps_at, none_from;

  explicit Wavy(std::mt19937& engine) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> part;
    const auto any = [&] { return Eigen::Vector2d(normal(engine), normal(engine)); };
    start = any();
    slope = any();
    slope[0] = std::abs(slope[0]);
    if (start[0] > 0) start[0] = -start[0];  // a way down
    for (Eigen::Vector2d& k : kink) k = any();
    for (double& a : at) a = part(engine);
    jump = part(engine) < 0.3 ? any() : Eigen::Vector2d(0, 0);
    jumps_at = part(engine);
    none_from = part(engine) < 0.3 ? 0.3 + 0.7 * part(engine) : 2;
  }
  [[nodiscard]] Eigen::Vector2d operator()(double step) const {
    Eigen::Vector2d r = start + step * slope;
    for (std::size_t k = 0; k < kink.size(); ++k) r += std::max(0.0, step - at[k]) * kink[k];
    return step > jumps_at ? Eigen::Vector2d(r + jump) : r;
  }
};

struct Steps {
  double taken = 0;
  std::vector<double> seen;
};

Steps of_program(const Wavy& wavy) {
  ToySystem system;
  system.size = 2;
  system.force = [&](const Eigen::VectorXd& x, double) -> Eigen::VectorXd { return wavy(x[0]); };
  system.stiffness = [](const Eigen::VectorXd&) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::Identity(2, 2);
  };
  system.wrong = [&](const Eigen::VectorXd& x, const Eigen::VectorXd&) {
    return x[0] > wavy.none_from ? "torn" : "";
  };
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(2), way = Eigen::Vector2d(1, 0);
  solve::NewtonResult<ToySystem::State> result;
  result.trial.x = zero;
  Steps out;
  out.taken =
      solve::detail::line_search(system, ToySystem::State{zero}, result, way, wavy(0), 1).step;
  for (const Eigen::VectorXd& x : system.evaluated) out.seen.push_back(x[0]);
  return out;
}

Steps of_host(const Wavy& wavy) {
  Steps out;
  out.taken = line_search({wavy.start[0], wavy.start.norm()}, [&](double step) {
    out.seen.push_back(step);
    const Eigen::Vector2d r = wavy(step);
    return LinePoint{r[0], r.norm(), false, !(step > wavy.none_from)};
  });
  return out;
}

TEST(LineSearch, OfHostsIsThatOfTheProgram) {
  std::mt19937 engine(20261128);
  int whole = 0, parts = 0, looks = 0;
  for (int i = 0; i < 3000; ++i) {
    const Wavy wavy(engine);
    const Steps program = of_program(wavy), host = of_host(wavy);
    constexpr double rounding = 1e-9;  // of sums that each compiles in its own order
    ASSERT_EQ(host.seen.size(), program.seen.size()) << i;
    for (std::size_t k = 0; k < host.seen.size(); ++k)
      ASSERT_NEAR(host.seen[k], program.seen[k], rounding) << i;
    ASSERT_NEAR(host.taken, program.taken, rounding) << i;
    (host.taken == 1 ? whole : parts) += 1;
    looks = std::max(looks, static_cast<int>(host.seen.size()));
  }
  EXPECT_GT(whole, 300);
  EXPECT_GT(parts, 300);
  EXPECT_GT(looks, 5);
}

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double boundless = std::numeric_limits<double>::infinity();

TEST(LineSearch, AResidualThatIsNotFiniteIsNone) {
  std::mt19937 engine(20261129);
  int none = 0;
  for (int i = 0; i < 1000; ++i) {
    Wavy wavy(engine);
    wavy.none_from = 0.01 + 0.6 * std::generate_canonical<double, 30>(engine);
    const Steps expected = of_host(wavy);
    for (const LinePoint& bad :
         {LinePoint{no_number, no_number}, LinePoint{no_number, 0.01}, LinePoint{-0.01, no_number},
          LinePoint{0.1, boundless}, LinePoint{-boundless, boundless, true}}) {
      std::vector<double> seen;
      const double taken = line_search({wavy.start[0], wavy.start.norm()}, [&](double step) {
        seen.push_back(step);
        const Eigen::Vector2d r = wavy(step);
        return step > wavy.none_from ? bad : LinePoint{r[0], r.norm()};
      });
      ASSERT_EQ(taken, expected.taken) << i;
      ASSERT_EQ(seen, expected.seen) << i;
    }
    none += expected.seen.size() > 2 ? 1 : 0;
  }
  EXPECT_GT(none, 500);
}

TEST(LineSearch, WithoutAnyResidualTenHalvesAreTaken) {
  std::mt19937 engine(20261130);
  Wavy wavy(engine);
  wavy.none_from = 0;
  const Steps program = of_program(wavy), host = of_host(wavy);
  EXPECT_EQ(program.taken, std::exp2(-10));
  EXPECT_EQ(host.taken, std::exp2(-10));
  ASSERT_EQ(host.seen.size(), 11U);
  EXPECT_EQ(host.seen, program.seen);
  for (const LinePoint& none : {LinePoint{no_number, no_number}, LinePoint{1e9, 1e9, false, false},
                                LinePoint{-1, 1e-9, true, false}, LinePoint{1, boundless}}) {
    int looks = 0;
    const auto look = [&](double) {
      ++looks;
      return none;
    };
    EXPECT_EQ(line_search({-1, 1}, look), std::exp2(-10));
    EXPECT_EQ(looks, 11);
  }
}

TEST(LineSearch, AStartThatIsZeroOrNotFiniteAsksForNoLess) {
  for (const LinePoint& start :
       {LinePoint{0, 0}, LinePoint{no_number, no_number}, LinePoint{-boundless, boundless},
        LinePoint{no_number, boundless}, LinePoint{-1, no_number}}) {
    for (const double work : {-2.0, 0.0, 2.0}) {
      const auto look = [&](double step) { return LinePoint{work, 3 + step}; };
      EXPECT_EQ(line_search(start, look), 1) << start.norm << ' ' << work;
      const auto torn = [&](double step) { return LinePoint{work, 3 + step, false, step < 0.3}; };
      if (start.norm == 0) continue;
      EXPECT_EQ(line_search(start, torn), 0.25) << start.norm << ' ' << work;
    }
  }
  EXPECT_EQ(line_search({0, 0}, [](double) { return LinePoint{0, 0}; }), 1);
}

TEST(LineSearch, PointsThatJumpDecideThemselves) {
  int looks = 0;
  const auto look = [&](double step) {
    ++looks;
    return LinePoint{5 * step, 5, true};
  };
  EXPECT_EQ(line_search({-1, 1}, look), 1);
  EXPECT_EQ(looks, 1);
}

}  // namespace
}  // namespace osculate
