// Factors of the symmetric part of tangents that are nearly symmetric: they change nothing but the
// time, and where they do not serve the whole is factored.
#include <gtest/gtest.h>

#include <cmath>

#include "osculate/la/mumps.hpp"
#include "toy_system.hpp"

namespace osculate::solve {
namespace {

constexpr Index size = 1000;  // the fewest unknowns for which it is worth it

struct NearlySymmetricSystem : ToySystem {
  bool nearly = true;
  [[nodiscard]] bool nearly_symmetric() const { return nearly; }
};

/// A chain of springs that stiffen; each also feels `skew` times what its neighbours do, of one
/// with the other sign. A band is enough: what is far is zero.
NearlySymmetricSystem chain(double skew) {
  NearlySymmetricSystem system;
  system.size = size;
  system.builder = la::MatrixBuilder{size};
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size, size);
  for (Index i = 0; i < size; ++i) {
    k(i, i) = 2.5 + 0.3 * std::sin(i);
    if (i == 0) continue;
    k(i, i - 1) = -1 + skew;
    k(i - 1, i) = -1 - skew;
  }
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

/// Mumps, and what was asked of it.
struct Recorder final : la::LinearSolver {
  la::Mumps solver;
  std::vector<la::Symmetry> kinds;
  double condition = 0;  ///< that the symmetric kinds report
  la::FactorReport factor(const la::SparseMatrix& k, std::uint64_t version,
                          la::Symmetry symmetry) override {
    kinds.push_back(symmetry);
    la::FactorReport report = solver.factor(k, version, symmetry);
    report.operations = 0;  // they serve for one correction
    if (symmetry != la::Symmetry::unsymmetric) report.condition = condition;
    return report;
  }
  la::SolveStatus solve(Eigen::VectorXd& x) override { return solver.solve(x); }
  la::SolveStatus solve(Eigen::MatrixXd& x) override { return solver.solve(x); }
  [[nodiscard]] double seconds() const override { return solver.seconds(); }
};

NewtonResult<ToySystem::Trial> solved(NearlySymmetricSystem& system, Recorder& solver) {
  NewtonOptions options;
  options.residual = 1e-12;
  return newton(system, ToySystem::State{Eigen::VectorXd::Zero(size)}, 1.0, options, solver);
}

/// Beside factors of the whole: the same iterations, the same answer.
void expect_the_same(double skew, Recorder& solver) {
  NearlySymmetricSystem system = chain(skew);
  const auto by_part = solved(system, solver);
  system.nearly = false;
  Recorder whole;
  const auto by_whole = solved(system, whole);
  ASSERT_EQ(by_part.outcome, Outcome::converged) << by_part.reason;
  ASSERT_EQ(by_whole.outcome, Outcome::converged) << by_whole.reason;
  EXPECT_EQ(std::ranges::count(whole.kinds, la::Symmetry::unsymmetric),
            std::ssize(by_whole.iterations));
  EXPECT_EQ(by_part.iterations.size(), by_whole.iterations.size());
  EXPECT_LT((by_part.trial.x - by_whole.trial.x).norm(), 1e-11 * by_whole.trial.x.norm());
}

TEST(SymmetricPart, StandsInForTheWhole) {
  Recorder solver;
  expect_the_same(1e-3, solver);
  EXPECT_GE(solver.kinds.size(), 4U);
  EXPECT_EQ(std::ranges::count(solver.kinds, la::Symmetry::indefinite), std::ssize(solver.kinds));
}

TEST(SymmetricPart, IsTriedOnceInAnIncrementWhereTooMuchIsNotSymmetric) {
  Recorder solver;
  expect_the_same(0.8, solver);
  EXPECT_EQ(solver.kinds.front(), la::Symmetry::indefinite);
  EXPECT_EQ(std::ranges::count(solver.kinds, la::Symmetry::indefinite), 1);
}

TEST(SymmetricPart, IsNotUsedWhereDigitsAreLost) {
  Recorder solver;
  solver.condition = 1e14;
  expect_the_same(1e-3, solver);
  EXPECT_EQ(std::ranges::count(solver.kinds, la::Symmetry::indefinite), 1);
}

}  // namespace
}  // namespace osculate::solve
