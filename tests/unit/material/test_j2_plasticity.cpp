// Return mapping of von Mises plasticity: at points, in all dimensions, small and logarithmic.
#include "osculate/material/j2_plasticity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "derivative_check.hpp"
#include "osculate/material/energy.hpp"
#include "osculate/material/law.hpp"
#include "von_mises.hpp"

namespace osculate::material {
namespace {

using support::mises;

using State = std::array<double, J2Plasticity::memory.size()>;

const J2Plasticity perfect{200, 0.3, 0, 1, 0, 0};
const J2Plasticity isotropic{200, 0.3, 0, 1, 20, 0};
const J2Plasticity kinematic{200, 0.3, 0, 1, 0, 20};
const J2Plasticity table{200, 0.4, 0, 0, 3, 5, {{1, 0}, {1.5, 0.01}, {1.6, 0.02}, {1.55, 0.04}}};
const J2Plasticity all_laws[] = {perfect, isotropic, kinematic, table};

/// A point that is driven from strain to strain.
template <class StrainType>
struct Point {
  Law law;
  State now{};

  auto at(const StrainType& e, State& next) const {
    return response(law, e, {now.data(), next.data(), now.size()});
  }
  auto commit(const StrainType& e) {
    State next{};
    const auto r = at(e, next);
    EXPECT_TRUE(r.ok);
    now = next;
    return r;
  }
};

/// Stress without the back stress of a state.
Stress3 relative(const J2Plasticity& law, const Stress3& s, const State& state) {
  return s - 2.0 / 3 * law.kinematic * Eigen::Map<const Stress3>(state.data() + 1);
}

const Strain3 first{{0.012, -0.006, 0.004, 0.010, -0.005, 0.008}};
const Strain3 second{{-0.004, 0.009, 0.002, -0.012, 0.006, 0.003}};
const Strain3 along{{0.5, -0.3, 0.2, 0.7, -0.4, 0.6}};

TEST(J2Plasticity, IsHookesLawBelowTheYieldStress) {
  Point<Strain3> point{table};
  const Strain3 e = 0.1 * first;
  const Response3 hooke = response(LinearElastic{200, 0.4, 0}, e);
  const Response3 r = point.commit(e);
  EXPECT_LT((r.stress - hooke.stress).norm(), 1e-15 * hooke.stress.norm());
  EXPECT_LT((r.tangent - hooke.tangent).norm(), 1e-15 * hooke.tangent.norm());
  EXPECT_EQ(point.now, State{});
}

// However far a step goes over the points of the table.
TEST(J2Plasticity, EndsOnTheYieldSurface) {
  for (const J2Plasticity& law : all_laws)
    for (const double size : {0.6, 1.0, 3.0, 10.0}) {
      Point<Strain3> point{law};
      for (const Strain3& e : {Strain3(size * first), Strain3(size * second)}) {
        const double before = point.now[0];
        const Response3 r = point.commit(e);
        EXPECT_GT(point.now[0], before);
        const double limit = yield_stress(law, point.now[0]).value;
        EXPECT_NEAR(mises(relative(law, r.stress, point.now)), limit, 1e-13 * limit);
        EXPECT_NEAR(point.now[1] + point.now[2] + point.now[3], 0, 1e-16 * size);
      }
    }
}

TEST(J2Plasticity, YieldStressFollowsTheTable) {
  EXPECT_DOUBLE_EQ(yield_stress(table, 0).value, 1);
  EXPECT_DOUBLE_EQ(yield_stress(table, 0.005).value, 1.25 + 3 * 0.005);
  EXPECT_NEAR(yield_stress(table, 0.01).slope, 10 + 3, 1e-12);
  EXPECT_DOUBLE_EQ(yield_stress(table, 0.03).value, 1.575 + 3 * 0.03);
  EXPECT_DOUBLE_EQ(yield_stress(table, 1).value, 1.55 + 3);
  EXPECT_TRUE(std::isinf(yield_stress({200, 0.3, 0}, 1).value));
}

template <class StrainType>
void expect_consistent(const Law& law, const StrainType& before, const StrainType& e,
                       const StrainType& direction, bool plastic) {
  Point<StrainType> point{law};
  point.commit(before);
  const State from = point.now;
  State next{};
  const auto flows = [&] { return next[0] > from[0]; };
  const auto here = point.at(e, next);
  EXPECT_EQ(flows(), plastic);
  const auto stress = [&](const StrainType& x) -> Eigen::VectorXd {
    const auto r = point.at(x, next);
    EXPECT_EQ(flows(), plastic);  // both probes are in the same branch
    return r.stress;
  };
  const auto r = testing::check_derivative(stress, here.tangent * direction, e, direction, 1e-4);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << r.order << " " << r.error;
  EXPECT_LT((here.tangent - here.tangent.transpose()).norm(), 1e-14 * here.tangent.norm());
}

TEST(J2Plasticity, TangentIsConsistentInBothBranches) {
  for (const J2Plasticity& small : all_laws)
    for (const Law& law : {Law(small), in_finite_strain(small)}) {
      expect_consistent<Strain3>(law, first, second, along, true);
      expect_consistent<Strain3>(law, first, 0.92 * first, along, false);
      const auto plane = [](const Strain3& e) { return Strain(e.head<4>()); };
      expect_consistent<Strain>(law, plane(first), plane(second), plane(along), true);
      expect_consistent<Strain>(law, plane(first), 0.92 * plane(first), plane(along), false);
    }
}

TEST(J2Plasticity, LargeStrainsHaveAConsistentTangent) {
  for (const J2Plasticity& small : all_laws)
    expect_consistent<Strain3>(in_finite_strain(small), 30 * first, 25 * second, along, true);
}

TEST(J2Plasticity, UnloadsElasticallyAndRemembersNothingNew) {
  for (const J2Plasticity& law : all_laws) {
    Point<Strain3> point{law};
    const Response3 loaded = point.commit(first);
    const State before = point.now;
    const Strain3 back = 0.9 * first;
    State next{};
    const Response3 r = point.at(back, next);
    EXPECT_EQ(next, before);
    const Stress3 change =
        response(LinearElastic{law.young, law.poisson, 0}, Strain3(back - first)).stress;
    EXPECT_LT((r.stress - loaded.stress - change).norm(), 1e-14 * loaded.stress.norm());
    // The committed state itself is elastic, so that evaluating it again changes no bit.
    (void)point.at(first, next);
    EXPECT_EQ(next, before);
  }
}

TEST(J2Plasticity, NeverWritesToWhatIsCommitted) {
  Point<Strain3> point{table};
  point.commit(first);
  const State before = point.now;
  State one{}, two{};
  const Response3 far = point.at(5 * second, one);
  const Response3 near = point.at(second, two);
  EXPECT_EQ(point.now, before);
  State again{};
  EXPECT_EQ(point.at(5 * second, again).stress, far.stress);
  EXPECT_EQ(again, one);
  EXPECT_NE(one, two);
  EXPECT_NE(near.stress, far.stress);
}

/// A bar: both stresses across it vanish.
Response bar(const Law& law, double strain, const State& now, State& next, double& across) {
  Response r;
  for (int i = 0; i < 50; ++i) {
    r = plane_stress_response(law, Strain(strain, across, 0, 0), nullptr,
                              {now.data(), next.data(), now.size()});
    EXPECT_TRUE(r.ok);
    if (std::abs(r.stress[1]) < 1e-13) break;
    across -= r.stress[1] / r.tangent(1, 1);
  }
  EXPECT_LT(std::abs(r.stress[1]), 1e-13);
  return r;
}

// Cycles of a bar: between Y above and below the back stress it is elastic, beyond the slope is
// E H / (E + H), and the back stress of kinematic hardening moves with what has flown.
TEST(J2Plasticity, CyclesOfABarAreTheClosedSolution) {
  const double young = 200, hardening = 20, slope = young * hardening / (young + hardening);
  for (const bool moves : {true, false}) {
    const Law law = moves ? kinematic : isotropic;
    State now{};
    double across = 0, stress = 0, strain = 0, back = 0, limit = 1;
    for (const double to : {0.01, -0.012, 0.02, 0.021, -0.02}) {
      // in three steps, which the closed solution of straight pieces does not see
      for (int i = 1; i <= 3; ++i) {
        const double at = strain + (to - strain) / (4 - i);
        State next{};
        const double found = bar(law, at, now, next, across).stress[0];
        now = next;
        const double trial = stress + young * (at - strain);
        const double over = std::abs(trial - back) - limit, sign = trial > back ? 1 : -1;
        stress = trial;
        if (over > 0) {
          const double flown = over / (young + hardening);
          stress -= sign * young * flown;
          (moves ? back : limit) += (moves ? sign : 1) * hardening * flown;
        }
        strain = at;
        EXPECT_NEAR(found, stress, 2e-12) << at;
      }
    }
    EXPECT_GT(now[0], 0.05);
  }
  EXPECT_NEAR(slope, 18.18, 0.01);
}

TEST(J2Plasticity, PlaneStressIsTheOneOfTheThicknessFound) {
  for (const J2Plasticity& small : all_laws)
    for (const Law& law : {Law(small), in_finite_strain(small)}) {
      State now{};
      for (const Strain& e : {Strain(0.012, -0.004, 0, 0.01), Strain(-0.006, 0.02, 0, -0.01),
                              Strain(-0.004, 0.019, 0, -0.01)}) {
        State plane{}, full{};
        Strain whole = e;
        const Response r =
            plane_stress_response(law, e, &whole[2], {now.data(), plane.data(), now.size()});
        ASSERT_TRUE(r.ok);
        const Response f = response(law, whole, {now.data(), full.data(), now.size()});
        EXPECT_LT(std::abs(f.stress[2]), 1e-13);
        EXPECT_LT((f.stress - r.stress).norm(), 1e-13);
        EXPECT_NEAR(plane[0], full[0], 1e-15);
        const Tangent condensed = f.tangent - f.tangent.col(2) * f.tangent.row(2) / f.tangent(2, 2);
        EXPECT_LT((r.tangent - condensed).norm(), 1e-11 * f.tangent.norm());
        const bool flows = plane[0] > now[0];
        const auto stress = [&](const Strain& x) -> Eigen::VectorXd {
          State next{};
          const Response at =
              plane_stress_response(law, x, nullptr, {now.data(), next.data(), now.size()});
          EXPECT_EQ(next[0] > now[0], flows);
          return at.stress;
        };
        const Strain direction(0.5, -0.3, 0, 0.7);
        const auto d = testing::check_derivative(stress, r.tangent * direction, e, direction, 1e-4);
        EXPECT_TRUE(d.exact || std::abs(d.order - 2) < 0.1) << d.order << " " << d.error;
        now = plane;
      }
      EXPECT_GT(now[0], 0.01);
    }
}

// What is put in is stored or dissipated; the mean stress of steps half as long misses a quarter.
TEST(J2Plasticity, WorkIsStoredOrDissipated) {
  for (const J2Plasticity& law : all_laws) {
    const auto missed = [&](int steps) {
      Point<Strain3> point{law};
      Stress3 before = Stress3::Zero();
      double work = 0;
      for (int i = 1; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        const Response3 r = point.commit(t * first + t * t * second);
        const double past = t - 1.0 / steps;
        work += 0.5 * (before + r.stress).dot((t - past) * first + (t * t - past * past) * second);
        before = r.stress;
      }
      const Strain3 end = first + second;
      return work - stored_energy(law, end, {point.now.data()}) -
             dissipated_energy(law, point.now.data());
    };
    EXPECT_LT(std::abs(missed(4000)), 1e-6) << missed(4000);
    EXPECT_LT(std::abs(missed(4000)), 0.6 * std::abs(missed(2000)));
  }
}

TEST(J2Plasticity, LogarithmicFormIsTheSmallOneAtSmallStrain) {
  for (J2Plasticity law : all_laws) {
    double last = 0;
    for (const double size : {1e-3, 1e-4, 1e-5}) {
      law.young = 200 / size;  // yields at the same share of the strain
      law.isotropic /= size;
      law.kinematic /= size;
      for (auto& point : law.hardening) point[1] *= size;
      Point<Strain3> small{law}, large{in_finite_strain(law)};
      Stress3 a, b;
      for (const Strain3& e : {Strain3(size * 100 * first), Strain3(size * 100 * second)}) {
        a = small.commit(e).stress;
        b = large.commit(e).stress;
      }
      EXPECT_GT(small.now[0], 0);
      const double error = (a - b).norm() / a.norm();
      EXPECT_LT(error, 10 * size);
      EXPECT_TRUE(last == 0 || error < 0.2 * last) << error << " after " << last;
      last = error;
    }
  }
}

TEST(J2Plasticity, SaysWhatIsWrongWithItsHardening) {
  EXPECT_EQ(range_problem(Law(table)), "");
  EXPECT_EQ(range_problem(in_finite_strain(perfect)), "");
  const auto wrong = [](core::Table points) {
    return range_problem(J2Plasticity{200, 0.3, 0, 0, 0, 0, std::move(points)});
  };
  EXPECT_EQ(wrong({{1, 0.1}}), "the first plastic strain is 0");
  EXPECT_EQ(wrong({{0, 0}}), "a yield stress is greater than 0");
  EXPECT_EQ(wrong({{1, 0}, {2, 0}}), "plastic strains rise from point to point");
  EXPECT_EQ(wrong({{10, 0}, {1, 0.01}}),
            "the yield stress falls more steeply than the elastic stress can follow");
  EXPECT_NE(range_problem(J2Plasticity{200, 0.3, 0, 0, 0, 0}), "");
  EXPECT_NE(range_problem(J2Plasticity{200, 0.3, 0, 1, 0, 0, {{1, 0}}}), "");
  EXPECT_NE(range_problem(J2Plasticity{200, 0.3, 0, 1, -300, 0}), "");
}

}  // namespace
}  // namespace osculate::material
