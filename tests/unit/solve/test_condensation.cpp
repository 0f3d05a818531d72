#include "osculate/solve/condensation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "osculate/la/condensed.hpp"
#include "toy_system.hpp"

namespace osculate::solve {
namespace {

/// A chain of springs that is held at its beginning and loaded all along; its last two nodes, the
/// few, are held by a spring with a cubic law. With `hidden` a node amid the chain has one, too,
/// which the system does not tell of.
struct Chain : ToySystem {
  static constexpr Index nodes = 60;
  struct Says {
    bool leaves_out = false, constant_alone = false;
    int whole = 0, of_few = 0;
  };
  std::shared_ptr<Says> says = std::make_shared<Says>();
  double hidden = 0;
  bool linear = true;

  [[nodiscard]] static Eigen::MatrixXd springs() {
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(nodes, nodes);
    for (Index i = 0; i < nodes; ++i) {
      k(i, i) += 100;
      if (i + 1 == nodes) break;
      k(i, i) += 100;
      k(i, i + 1) = k(i + 1, i) = -100;
    }
    return k;
  }
  explicit Chain(double hidden_cubic = 0) : hidden(hidden_cubic) {
    size = nodes;
    builder = la::MatrixBuilder(nodes);
    scale = [](const Vector&, double t) { return std::max(t, 1e-3); };
    force = [s = says, cubic = hidden](const Vector& x, double t) {
      ++(s->leaves_out ? s->of_few : s->whole);
      Vector r = Vector::Constant(nodes, -0.1 * t);
      for (Index i = nodes - 2; i < nodes; ++i) r[i] += 50 * x[i] + 30 * x[i] * x[i] * x[i];
      if (!s->leaves_out) {
        r += springs() * x;
        r[20] += cubic * x[20] * x[20] * x[20];
      }
      return r;
    };
    stiffness = [s = says](const Vector& x) {
      Eigen::MatrixXd k = Eigen::MatrixXd::Zero(nodes, nodes);
      if (!s->leaves_out || s->constant_alone) k += springs();
      for (Index i = nodes - 2; i < nodes && !s->constant_alone; ++i)
        k(i, i) += 50 + 90 * x[i] * x[i];
      return k;
    };
  }
  [[nodiscard]] bool stays_linear() const { return linear; }
  [[nodiscard]] static std::vector<Index> changing_unknowns() { return {nodes - 2, nodes - 1}; }
  void leave_out_constant(bool on) const { says->leaves_out = on; }
  void assemble_constant(const State& committed, double) {
    says->constant_alone = true;
    fill(committed.x);
    says->constant_alone = false;
  }
  [[nodiscard]] Vector constant_forces(const State&, const Trial& trial, double) const {
    Vector f = springs() * trial.x;
    if (prescribed) f[0] = 0;
    return f;
  }
  [[nodiscard]] Index unknowns() const { return size; }
};
static_assert(Condenses<Chain>);

struct Solved {
  NewtonResult<Chain::Trial> result;
  int whole = 0, of_few = 0, dropped = 0;
};
Solved solved(Chain& chain, bool among_few, const NewtonOptions& options = {}) {
  la::Condensed solver;
  solver.may_change(Chain::changing_unknowns());
  Condensation<Chain> condensation(among_few ? 1 : 1000);
  Solved out;
  Chain::State state{Eigen::VectorXd::Zero(Chain::nodes)};
  for (const double time : {1.0, 2.0}) {
    *chain.says = {};
    out.result = condensation.newton(chain, state, time, options, solver, {}, out.dropped);
    EXPECT_EQ(out.result.outcome, Outcome::converged) << out.result.reason;
    EXPECT_FALSE(chain.says->leaves_out);
    state = out.result.trial;
  }
  out.whole = chain.says->whole;
  out.of_few = chain.says->of_few;
  return out;
}

TEST(Condensation, FindsWhatAllUnknownsFind) {
  Chain chain;
  const Solved all = solved(chain, false), few = solved(chain, true);
  EXPECT_EQ(all.of_few, 0);
  EXPECT_EQ(few.whole, 1);  // at the end of the increment
  EXPECT_GT(few.of_few, 3);
  EXPECT_EQ(few.dropped, 0);
  EXPECT_EQ(few.result.iterations.size(), all.result.iterations.size());
  EXPECT_LE((few.result.trial.x - all.result.trial.x).norm(), 1e-11 * all.result.trial.x.norm());
  EXPECT_LE((few.result.total - all.result.total).norm(), 1e-11 * all.result.total.norm());
  EXPECT_LE(few.result.evaluation.residual.norm(), 1e-9 * few.result.evaluation.force_scale);
  EXPECT_EQ(count_factorisations(few.result.iterations).whole, 0);
}

TEST(Condensation, PrescribedMotionsReachTheFew) {
  Chain chain;
  chain.prescribed = [](double time) { return 0.3 * time; };
  const Solved all = solved(chain, false), few = solved(chain, true);
  EXPECT_EQ(few.whole, 1);
  EXPECT_EQ(few.result.trial.x[0], 0.6);
  EXPECT_LE((few.result.trial.x - all.result.trial.x).norm(), 1e-11 * all.result.trial.x.norm());
}

/// A system that is not as linear as it says costs iterations, and ends where it is in balance.
TEST(Condensation, WhatIsNotLinearIsFoundAtTheEnd) {
  Chain chain(5.0);
  const Solved all = solved(chain, false), few = solved(chain, true);
  EXPECT_GT(few.whole, 1);
  EXPECT_GT(few.result.iterations.size(), all.result.iterations.size());
  EXPECT_LE(few.result.evaluation.residual.norm(), 1e-9 * few.result.evaluation.force_scale);
  EXPECT_LE((few.result.trial.x - all.result.trial.x).norm(), 1e-8 * all.result.trial.x.norm());
  EXPECT_LE(few.result.iterations.back().residual, 1e-9);
}

/// Where the few find no end, all unknowns are asked from the beginning, and what was in vain
/// counts.
TEST(Condensation, WhatDoesNotConvergeBeginsAnewWithAll) {
  Chain chain;
  NewtonOptions options;
  const Solved all = solved(chain, false, options);
  chain.touching = [](const Eigen::VectorXd&) { return 0; };
  const auto usual = chain.force;
  chain.force = [usual, s = chain.says](const Eigen::VectorXd& x, double t) {
    Eigen::VectorXd r = usual(x, t);
    if (s->leaves_out) r[Chain::nodes - 1] += s->of_few % 2 ? 40.0 : -40.0;  // never at rest
    return r;
  };
  const Solved few = solved(chain, true, options);
  EXPECT_GT(few.dropped, 0);
  EXPECT_EQ(few.result.iterations.size(), all.result.iterations.size());
  EXPECT_LE((few.result.trial.x - all.result.trial.x).norm(), 1e-11 * all.result.trial.x.norm());
}

TEST(Condensation, NotWhereTheSystemIsNotLinearOrResistsOrEnergyAloneCounts) {
  Chain chain;
  chain.linear = false;
  EXPECT_EQ(solved(chain, true).of_few, 0);
  chain.linear = true;
  NewtonOptions by_energy;
  by_energy.residual = 0;
  EXPECT_EQ(solved(chain, true, by_energy).of_few, 0);
}

}  // namespace
}  // namespace osculate::solve
