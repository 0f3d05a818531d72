// Newton's method that jumps between two states for ever is told from one that converges.
#include <gtest/gtest.h>

#include "toy_system.hpp"

namespace osculate::solve {
namespace {

std::vector<IterationRecord> records(const std::vector<std::uint64_t>& states, double factor) {
  std::vector<IterationRecord> out;
  double residual = 1;
  for (const std::uint64_t state : states) {
    IterationRecord record;
    record.residual = residual;
    record.counts.signature = state;
    out.push_back(record);
    residual *= factor;
  }
  return out;
}

TEST(Cycles, AreStatesThatComeBackTwiceWithoutProgress) {
  EXPECT_TRUE(detail::comes_back(records({1, 2, 1, 2}, 1)));
  EXPECT_TRUE(detail::comes_back(records({9, 1, 2, 3, 1, 2, 3}, 1)));
  EXPECT_TRUE(detail::comes_back(records({1, 2, 3, 4, 1, 2, 3, 4}, 1)));
  EXPECT_FALSE(detail::comes_back(records({1, 2, 1, 2}, 0.5))) << "the residual falls";
  EXPECT_FALSE(detail::comes_back(records({1, 2, 1}, 1))) << "once is no circle";
  EXPECT_FALSE(detail::comes_back(records({1, 1, 1, 1, 1, 1}, 1))) << "nothing flips";
  EXPECT_FALSE(detail::comes_back(records({1, 2, 1, 3}, 1)));
  EXPECT_FALSE(detail::comes_back({}));
}

/// r = sign(x) sqrt|x|: Newton's step goes from x to -x. The branch residual takes the line search
/// away, as points do that have jumped over their sticking range.
struct Jumping : ToySystem {
  Jumping() {
    static_cast<ToySystem&>(*this) =
        scalar_system([](double x, double) { return x > 0 ? std::sqrt(x) : -std::sqrt(-x); },
                      [](double x) { return 0.5 / std::sqrt(std::max(std::abs(x), 1e-30)); });
  }
  void evaluate(const State& committed, const State& trial, double time, bool tangent,
                Evaluation& out) {
    ToySystem::evaluate(committed, trial, time, tangent, out);
    out.branch_residual = out.residual;
    out.counts.signature = trial.x[0] > 0 ? 1 : 2;
  }
};

TEST(Cycles, HalfAStepLeadsOut) {
  for (const bool cure : {false, true}) {
    Jumping system;
    la::DirectSolver solver;
    NewtonOptions options;
    options.cycle_cure = cure;
    const auto result = newton<Jumping>(system, {vector({1.0})}, 1.0, options, solver);
    if (cure) {
      EXPECT_EQ(result.outcome, Outcome::converged) << result.reason;
      EXPECT_NEAR(result.state.x[0], 0, 1e-12);
    } else {
      EXPECT_EQ(result.outcome, Outcome::not_converged);
    }
  }
}

}  // namespace
}  // namespace osculate::solve
