// Prony series at points: against closed solutions, in all dimensions, small and logarithmic.
#include "osculate/material/viscoelastic.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "derivative_check.hpp"
#include "osculate/material/energy.hpp"
#include "osculate/material/law.hpp"
#include "point_in_time.hpp"

namespace osculate::material {
namespace {

const Viscoelastic polymer{100, 0.4, 0, {{0.3, 0.5}, {0.4, 20}}, {{0.25, 3}}};
using State = std::array<double, 7 + 2 * 7>;

const Strain3 first{{0.012, -0.006, 0.004, 0.010, -0.005, 0.008}};
const Strain3 second{{-0.004, 0.009, 0.002, -0.012, 0.006, 0.003}};
const Strain3 along{{0.5, -0.3, 0.2, 0.7, -0.4, 0.6}};

struct Point : testing::PointInTime<std::tuple_size_v<State>> {
  explicit Point(const Law& of = polymer) : PointInTime{of} {}
};

/// Hooke's law with shares of the shear and the bulk modulus.
Stress3 hooke_of(const Strain3& e, double shear, double bulk) {
  const Lame c = lame(polymer.young, polymer.poisson);
  const double volume = e.head<3>().sum(), k = c.lambda + 2 * c.mu / 3;
  Stress3 s = 2 * shear * c.mu * e;
  s.tail<3>() *= 0.5;
  s.head<3>().array() += (bulk * k - 2 * shear * c.mu / 3) * volume;
  return s;
}
/// What is left of a modulus at a time after a strain, and of the integral of that.
double left_at(const core::Table& series, double time) {
  double left = 1;
  for (const auto& [share, tau] : series) left -= share * -std::expm1(-time / tau);
  return left;
}
double integral_of_left(const core::Table& series, double time) {
  double sum = time;
  for (const auto& [share, tau] : series) sum -= share * (time + tau * std::expm1(-time / tau));
  return sum;
}

TEST(Viscoelastic, AtOnceIsHookesLaw) {
  Point point;
  const Stress3 s = point.commit(first, 0);
  EXPECT_LT((s - hooke_of(first, 1, 1)).norm(), 1e-14 * s.norm());
  EXPECT_EQ(dissipated_energy(polymer, point.now.data()), 0);
  // evaluating what is committed again changes no bit
  State next{};
  EXPECT_LT((point.at(first, 0, next).stress - s).norm(), 1e-15 * s.norm());
  EXPECT_EQ(next, point.now);
}

// However long the increments are.
TEST(Viscoelastic, RelaxesByItsSeries) {
  for (const int parts : {1, 7}) {
    Point point;
    (void)point.commit(first, 0);
    double time = 0;
    for (const double to : {0.1, 2.0, 50.0, 1000.0}) {
      Stress3 s = Stress3::Zero();
      for (int i = 0; i < parts; ++i) s = point.commit(first, (to - time) / parts);
      time = to;
      const Stress3 known =
          hooke_of(first, left_at(polymer.shear, time), left_at(polymer.bulk, time));
      EXPECT_LT((s - known).norm(), 1e-14 * known.norm()) << time;
      // what the dampers have taken: sum G g e:e (1 - exp(-2 t / tau)) and of the bulk
      const Lame c = lame(polymer.young, polymer.poisson);
      const double volume = first.head<3>().sum(), k = c.lambda + 2 * c.mu / 3,
                   shape = first.head<3>().squaredNorm() + 0.5 * first.tail<3>().squaredNorm() -
                           volume * volume / 3;
      double lost = 0;
      for (const auto& [g, tau] : polymer.shear)
        lost += c.mu * g * shape * -std::expm1(-2 * time / tau);
      for (const auto& [b, tau] : polymer.bulk)
        lost += 0.5 * k * b * volume * volume * -std::expm1(-2 * time / tau);
      EXPECT_NEAR(dissipated_energy(polymer, point.now.data()), lost, 1e-13 * lost) << time;
      const double work = 0.5 * first.dot(hooke_of(first, 1, 1));
      EXPECT_NEAR(stored_energy(polymer, first, {point.now.data()}), work - lost, 1e-13 * work);
    }
  }
}

TEST(Viscoelastic, FollowsAnEvenStrainExactly) {
  for (const int parts : {1, 5}) {
    Point point;
    Stress3 s = Stress3::Zero();
    const double time = 8;
    for (int i = 1; i <= parts; ++i) s = point.commit(first * i / parts, time / parts);
    const Stress3 known = hooke_of(first / time, integral_of_left(polymer.shear, time),
                                   integral_of_left(polymer.bulk, time));
    EXPECT_LT((s - known).norm(), 1e-14 * known.norm());
  }
}

TEST(Viscoelastic, IsOfSecondOrderWhereStrainsChangeUnevenly) {
  const auto stress_after = [](int parts) {
    Point point;
    Stress3 s = Stress3::Zero();
    for (int i = 1; i <= parts; ++i) {
      const double t = static_cast<double>(i) / parts;
      s = point.commit(std::sin(2 * t) * first + t * t * second, 3.0 / parts);
    }
    return s;
  };
  const Stress3 exact = stress_after(4096);
  const double coarse = (stress_after(16) - exact).norm(), fine = (stress_after(32) - exact).norm();
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.05);
}

TEST(Viscoelastic, HasAConsistentTangent) {
  for (const Law& law : {Law(polymer), in_finite_strain(polymer)})
    for (const double duration : {0.0, 0.3, 40.0})
      for (const double size : {1.0, 25.0}) {
        Point point{law};
        (void)point.commit(size * first, 0.7);
        State next{};
        const Strain3 e = size * second;
        const Response3 here = point.at(e, duration, next);
        const auto of = [&](const Strain3& x) -> Eigen::VectorXd {
          return point.at(x, duration, next).stress;
        };
        const auto d = testing::check_derivative(of, here.tangent * along, e, along, 1e-3);
        EXPECT_TRUE(d.exact || std::abs(d.order - 2) < 0.1) << d.order << " " << d.error;
        EXPECT_LT((here.tangent - here.tangent.transpose()).norm(), 1e-14 * here.tangent.norm());
      }
}

// The stress is the derivative of what is stored, where no time passes.
TEST(Viscoelastic, StoresWhatItGivesBackAtOnce) {
  Point point;
  (void)point.commit(first, 0.7);
  State next{};
  const auto stored = [&](const Strain3& x) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, stored_energy(polymer, x, {point.now.data()}));
  };
  const double slope = point.at(second, 0, next).stress.dot(along);
  const auto d =
      testing::check_derivative(stored, Eigen::VectorXd::Constant(1, slope), second, along, 1e-3);
  EXPECT_TRUE(d.exact || std::abs(d.order - 2) < 0.1) << d.order << " " << d.error;
}

// Trapezes of the stress over the strain miss a quarter in steps half as long.
TEST(Viscoelastic, WorkIsStoredOrDissipated) {
  for (const double time : {0.05, 5.0, 400.0}) {
    const auto missed = [&](int parts) {
      Point point;
      Strain3 before = Strain3::Zero();
      Stress3 last = Stress3::Zero();
      double work = 0;
      for (int i = 1; i <= parts; ++i) {
        const double t = static_cast<double>(i) / parts;
        const Strain3 e = t * first + t * t * second;
        const Stress3 s = point.commit(e, time / parts);
        work += 0.5 * (s + last).dot(e - before);
        before = e;
        last = s;
      }
      return std::abs(work - stored_energy(polymer, before, {point.now.data()}) -
                      dissipated_energy(polymer, point.now.data())) /
             work;
    };
    const double fine = missed(4000);
    EXPECT_LT(fine, 1e-5) << time;
    EXPECT_NEAR(missed(2000) / fine, 4, 0.2) << time;
  }
}

TEST(Viscoelastic, PlaneStressIsTheOneOfTheThicknessFound) {
  for (const Law& law : {Law(polymer), in_finite_strain(polymer)}) {
    State now{};
    for (const Strain& e : {Strain(0.12, -0.04, 0, 0.1), Strain(-0.06, 0.2, 0, -0.1)}) {
      State plane{}, full{};
      Strain whole = e;
      const Response r =
          plane_stress_response(law, e, &whole[2], {now.data(), plane.data(), now.size(), 0.8});
      ASSERT_TRUE(r.ok);
      const Response f = response(law, whole, {now.data(), full.data(), now.size(), 0.8});
      EXPECT_LT(std::abs(f.stress[2]), 1e-13);
      EXPECT_LT((f.stress - r.stress).norm(), 1e-13);
      const Tangent condensed = f.tangent - f.tangent.col(2) * f.tangent.row(2) / f.tangent(2, 2);
      EXPECT_LT((r.tangent - condensed).norm(), 1e-12 * f.tangent.norm());
      now = plane;
    }
  }
}

TEST(Viscoelastic, SaysWhatItIs) {
  EXPECT_EQ(memory_of(Law(polymer)).size(), 21U);
  EXPECT_EQ(memory_of(in_finite_strain(polymer)).size(), 21U);
  EXPECT_TRUE(needs_duration(Law(polymer)));
  EXPECT_FALSE(linear(Law(polymer)));
  EXPECT_EQ(range_problem(Law(polymer)), "");
  const auto wrong = [](core::Table shear, core::Table bulk) {
    return range_problem(Viscoelastic{100, 0.4, 0, std::move(shear), std::move(bulk)});
  };
  EXPECT_EQ(wrong({}, {}), "give `shear` or `bulk`: without, nothing relaxes");
  EXPECT_EQ(wrong({{-0.1, 1}}, {}), "shares are not negative");
  EXPECT_EQ(wrong({}, {{0.1, 0}}), "times are greater than 0");
  EXPECT_EQ(wrong({{0.5, 1}, {0.5, 2}}, {}),
            "the sum of the shares is less than 1: something remains");
  EXPECT_EQ(wrong(core::Table(21, {0.01, 1}), {}), "a series has at most 20 terms");
}

}  // namespace
}  // namespace osculate::material
