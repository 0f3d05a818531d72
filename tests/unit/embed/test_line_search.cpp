// The line search of hosts takes the steps that the program's own takes.
#include "osculate/line_search.hpp"

#include <gtest/gtest.h>

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
