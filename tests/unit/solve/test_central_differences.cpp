// Central differences on masses and springs, against closed solutions and the invariants of the
// scheme.
#include "osculate/solve/central_differences.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace osculate::solve {
namespace {

/// Masses on springs; dof 0 follows `driven` where it is given. Damping C = alpha M.
struct Springs {
  Eigen::VectorXd mass;
  Eigen::MatrixXd stiffness;
  double alpha = 0, stable = std::numeric_limits<double>::infinity(), faithful = stable;
  double (*driven)(double) = nullptr;
  int looked = 0, refuse_after = 1 << 30, accelerated = 0;
  bool growing = false;
  std::string why = "refused";

  double stable_step(const ExplicitMotion&) {
    ++looked;
    return stable;
  }
  [[nodiscard]] double faithful_step() const { return faithful; }
  void follow(double time, double h, ExplicitMotion& m) const {
    if (driven) m.velocity[0] = (driven(time) - m.position[0]) / h;
  }
  bool accelerate(double, double h, ExplicitMotion& m) {
    m.acceleration = -(stiffness * m.position).cwiseQuotient(mass);
    m.acceleration = (m.acceleration - alpha * m.velocity) / (1 + 0.5 * h * alpha);
    if (driven) m.acceleration[0] = 0;
    return ++accelerated <= refuse_after;
  }
  [[nodiscard]] bool grows(const ExplicitMotion&) const { return growing; }
  [[nodiscard]] const std::string& fault() const { return why; }
};

Springs oscillator(double omega, double alpha = 0) {
  Springs s;
  s.mass = Eigen::VectorXd::Ones(1);
  s.stiffness = Eigen::MatrixXd::Constant(1, 1, omega * omega);
  s.alpha = alpha;
  return s;
}

/// n masses 1 in a row, free at both ends, springs of stiffness 1, half masses at the ends: the
/// largest frequency is 2.
Springs chain(int n) {
  Springs s;
  s.mass = Eigen::VectorXd::Ones(n);
  s.mass[0] = s.mass[n - 1] = 0.5;
  s.stiffness = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    s.stiffness(i, i) += 1;
    s.stiffness(i + 1, i + 1) += 1;
    s.stiffness(i, i + 1) -= 1;
    s.stiffness(i + 1, i) -= 1;
  }
  return s;
}

ExplicitMotion start(Springs& s, const Eigen::VectorXd& u, const Eigen::VectorXd& v) {
  ExplicitMotion m{u, v, Eigen::VectorXd::Zero(u.size())};
  m.acceleration = -(s.stiffness * u).cwiseQuotient(s.mass) - s.alpha * v;
  return m;
}

Eigen::VectorXd mixed(int n) {
  Eigen::VectorXd v(n);
  for (int i = 0; i < n; ++i) v[i] = std::sin(1.7 * i * i + 0.3);
  return v;
}

/// Error of the damped oscillator at the time 3 with a step h.
double error_at_three(double alpha, double h) {
  constexpr double omega = 2;
  Springs s = oscillator(omega, alpha);
  ExplicitMotion m = start(s, Eigen::VectorXd::Constant(1, 1.0), Eigen::VectorXd::Zero(1));
  TimeSteps taken;
  EXPECT_EQ(advance(s, m, 0, 3, {0.9, h}, taken), TimeStepping::done);
  const double damped = std::sqrt(omega * omega - 0.25 * alpha * alpha);
  const double exact =
      std::exp(-1.5 * alpha) * (std::cos(3 * damped) + 0.5 * alpha / damped * std::sin(3 * damped));
  return std::abs(m.position[0] - exact);
}

TEST(CentralDifferences, AreOfSecondOrder) {
  for (const double alpha : {0.0, 0.8}) {
    const double order = std::log2(error_at_three(alpha, 0.02) / error_at_three(alpha, 0.01));
    EXPECT_NEAR(order, 2, 0.02) << alpha;
  }
}

TEST(CentralDifferences, HaveTheFrequencyOfTheirRecurrence) {
  // u_n+1 - (2 - (wh)^2) u_n + u_n-1 = 0: after n steps cos(n theta), 2 sin(theta / 2) = w h.
  Springs s = oscillator(1.5);
  ExplicitMotion m = start(s, Eigen::VectorXd::Constant(1, 1.0), Eigen::VectorXd::Zero(1));
  constexpr double h = 0.4;
  for (int n = 1; n <= 50; ++n) {
    ASSERT_TRUE(time_step(s, m, n * h, h));
    EXPECT_NEAR(m.position[0], std::cos(2 * n * std::asin(0.5 * 1.5 * h)), 1e-12);
  }
}

TEST(CentralDifferences, KeepMomentumAndTheEnergyOfHalfSteps) {
  constexpr int n = 12;
  Springs s = chain(n);
  ExplicitMotion m = start(s, 0.1 * mixed(n), mixed(n));
  const double momentum = s.mass.dot(m.velocity);
  constexpr double h = 0.9;
  const auto energy = [&] {
    const Eigen::VectorXd before = m.velocity - 0.5 * h * m.acceleration;
    const Eigen::VectorXd after = m.velocity + 0.5 * h * m.acceleration;
    return 0.5 * before.dot(s.mass.cwiseProduct(after)) +
           0.5 * m.position.dot(s.stiffness * m.position);
  };
  const double first = energy();
  for (int k = 0; k < 500; ++k) {
    ASSERT_TRUE(time_step(s, m, 0, h));
    ASSERT_NEAR(energy(), first, 1e-11);
  }
  EXPECT_NEAR(s.mass.dot(m.velocity), momentum, 1e-12);
}

TEST(CentralDifferences, AreStableUpToTheCriticalStep) {
  constexpr int n = 12;
  for (const double share : {0.99, 1.01}) {
    Springs s = chain(n);
    ExplicitMotion m = start(s, Eigen::VectorXd::Zero(n), mixed(n));
    const double first = m.velocity.norm();
    for (int k = 0; k < 400; ++k) ASSERT_TRUE(time_step(s, m, 0, share));
    if (share < 1) {
      EXPECT_LT(m.velocity.norm(), 10 * first);
    } else {
      EXPECT_GT(m.velocity.norm(), 1e6 * first);
    }
  }
}

TEST(CentralDifferences, FollowWhatIsPrescribed) {
  Springs s = chain(3);
  s.driven = [](double t) { return t * t; };
  ExplicitMotion m = start(s, Eigen::VectorXd::Zero(3), Eigen::VectorXd::Zero(3));
  TimeSteps taken;
  ASSERT_EQ(advance(s, m, 0, 2, {0.9, 0.1}, taken), TimeStepping::done);
  EXPECT_NEAR(m.position[0], 4, 1e-13);
  EXPECT_GT(m.position[2], 0);
}

TEST(CentralDifferences, TakeEqualStepsUntilTheyLookAgain) {
  Springs s = oscillator(1);
  s.stable = 0.1;
  ExplicitMotion m = start(s, Eigen::VectorXd::Ones(1), Eigen::VectorXd::Zero(1));
  TimeSteps taken;
  ASSERT_EQ(advance(s, m, 0, 9, {0.9, 0}, taken, 30), TimeStepping::done);
  EXPECT_EQ(taken.count, 100);
  EXPECT_EQ(s.looked, 4);
  EXPECT_NEAR(taken.longest, 0.09, 1e-14);
  EXPECT_EQ(taken.stable, 0.1);
  taken = {};
  ASSERT_EQ(advance(s, m, 0, 1, {0.9, 0.02}, taken), TimeStepping::done);
  EXPECT_EQ(taken.count, 50);
}

TEST(CentralDifferences, TakeShorterStepsWhereTheEnergyAsksForThem) {
  Springs s = oscillator(1);
  s.stable = 2;
  s.faithful = 0.25;
  ExplicitMotion m = start(s, Eigen::VectorXd::Ones(1), Eigen::VectorXd::Zero(1));
  TimeSteps taken;
  ASSERT_EQ(advance(s, m, 0, 1, {0.9, 0}, taken), TimeStepping::done);
  EXPECT_EQ(taken.count, 4);
  EXPECT_EQ(taken.stable, 2);
}

TEST(CentralDifferences, SayWhyTheyEnd) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  TimeSteps taken;
  Springs s = oscillator(1);
  s.stable = 0;
  ExplicitMotion m = start(s, one, one);
  EXPECT_EQ(advance(s, m, 0, 1, {}, taken), TimeStepping::too_many);
  s.stable = 1e-12;
  EXPECT_EQ(advance(s, m, 0, 1, {}, taken), TimeStepping::too_many);
  s.stable = 0.1;
  s.growing = true;
  EXPECT_EQ(advance(s, m, 0, 1, {}, taken), TimeStepping::unstable);
  s.growing = false;
  s.refuse_after = s.accelerated + 3;
  taken = {};
  EXPECT_EQ(advance(s, m, 0, 1, {}, taken), TimeStepping::failed);
  EXPECT_EQ(taken.count, 3);
}

}  // namespace
}  // namespace osculate::solve
