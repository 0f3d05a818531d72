// Hardening by curves over the plastic strain and the temperature.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "derivative_check.hpp"
#include "osculate/material/energy.hpp"
#include "osculate/material/j2_plasticity.hpp"
#include "osculate/material/law.hpp"
#include "von_mises.hpp"

namespace osculate::material {
namespace {

using support::mises;

using State = std::array<double, J2Plasticity::memory.size()>;

const core::Curves yields{{0, {{1, 0}, {1.5, 0.01}, {1.6, 0.03}}},
                          {100, {{0.4, 0}, {0.6, 0.015}, {0.55, 0.05}}}};
const core::Curves moves{{0, {{0, 0}, {0.3, 0.008}, {0.5, 0.04}}}, {100, {{0, 0}, {0.2, 0.02}}}};

J2Plasticity metal(bool isotropic, bool kinematic) {
  J2Plasticity law{200, 0.3};
  if (isotropic)
    law.hardening_over = yields;
  else
    law.yield = 1;
  if (kinematic)
    law.kinematic_over = moves;
  else
    law.kinematic = 4;
  law.young_over = {{0, 200}, {100, 150}};
  law.poisson_over = {{0, 0.3}, {100, 0.35}};
  return law;
}
const J2Plasticity all_laws[] = {metal(true, false), metal(false, true), metal(true, true)};

const Strain3 first{{0.012, -0.006, 0.004, 0.010, -0.005, 0.008}};
const Strain3 second{{-0.004, 0.009, 0.002, -0.012, 0.006, 0.003}};
const Strain3 along{{0.5, -0.3, 0.2, 0.7, -0.4, 0.6}};

struct Point {
  Law law;
  double temperature = 0;
  State now{};

  Response3 at(const Strain3& e, State& next) const {
    Memory memory{now.data(), next.data(), now.size()};
    memory.temperature = &temperature;
    return response(law, e, memory);
  }
  Response3 commit(const Strain3& e) {
    State next{};
    const Response3 r = at(e, next);
    EXPECT_TRUE(r.ok);
    now = next;
    return r;
  }
};

// Without a change of the temperature the law of that temperature alone has the same answers.
TEST(J2Curves, AtOneTemperatureAreThatCurve) {
  J2Plasticity alone{150, 0.35};
  alone.hardening = yields[1].points;
  J2Plasticity curves = metal(true, true);
  curves.kinematic_over.clear();
  Point one{alone}, other{curves, 100};
  for (const Strain3& e : {first, second, Strain3(0.5 * first)}) {
    const Response3 a = one.commit(e), b = other.commit(e);
    EXPECT_LT((a.stress - b.stress).norm(), 1e-14);
    EXPECT_LT((a.tangent - b.tangent).norm(), 1e-12);
    EXPECT_NEAR(one.now[0], other.now[0], 1e-16);
  }
}

// One straight piece is Prager's law up to its end.
TEST(J2Curves, AStraightCurveOfKinematicHardeningIsAModulus) {
  J2Plasticity modulus{200, 0.3, 0, 1, 2, 10}, curve = modulus;
  curve.kinematic = 0;
  curve.kinematic_over = {{0, {{0, 0}, {3, 0.3}}}};
  for (const bool finite : {false, true}) {
    Point one{finite ? in_finite_strain(modulus) : Law(modulus)},
        other{finite ? in_finite_strain(curve) : Law(curve)};
    for (const Strain3& e : {first, second, Strain3(0.5 * first), Strain3(-second)}) {
      const Response3 a = one.commit(e), b = other.commit(e);
      EXPECT_LT((a.stress - b.stress).norm(), 1e-14);
      EXPECT_LT((a.tangent - b.tangent).norm(), 1e-12);
    }
    EXPECT_GT(one.now[0], 0.01);
  }
}

TEST(J2Curves, EndOnTheYieldSurfaceOfTheTemperature) {
  for (const J2Plasticity& law : all_laws)
    for (const double size : {1.0, 3.0, 10.0}) {
      Point point{law};
      double temperature = 10;
      for (const Strain3& e :
           {Strain3(size * first), Strain3(size * second), Strain3(-size * first)}) {
        point.temperature = temperature;
        const double before = point.now[0];
        const Response3 r = point.commit(e);
        EXPECT_GT(point.now[0], before);
        const double limit = yield_stress(law, point.now[0], &temperature).value;
        const Stress3 back = Eigen::Map<const Stress3>(point.now.data() + 7);
        EXPECT_NEAR(mises(r.stress - back), limit, 1e-13 * limit);
        temperature += 30;
      }
    }
}

// The middle moves by what the curve rises by along the way of the plastic strain, also back.
TEST(J2Curves, TheMiddleMovesByTheRiseOfTheCurve) {
  J2Plasticity law{200, 0.3, 0, 1};
  law.kinematic_over = {moves[0]};
  Point point{law};
  double middle = 0, before = 0;
  const auto curve = [&](double a) {
    return a < 0.008 ? 0.3 * a / 0.008 : std::min(0.5, 0.3 + 0.2 * (a - 0.008) / 0.032);
  };
  for (const double to : {0.005, 0.011, 0.03, 0.0, -0.01, 0.02}) {
    const Response3 r = point.commit({to, -to / 2, -to / 2, 0, 0, 0});
    const double rise = curve(point.now[0]) - curve(before);
    const int way = r.stress[0] > 2.0 / 3 * middle ? 1 : -1;
    middle += way * rise;
    before = point.now[0];
    EXPECT_NEAR(point.now[7], 2.0 / 3 * middle, 1e-15);
    EXPECT_NEAR(1.5 * r.stress[0], middle + way, 1e-13);
  }
}

// A body that is held where it is flows as its yield stress falls, and what has moved stays.
TEST(J2Curves, FlowAsTheTemperatureRises) {
  Point point{metal(true, true)};
  (void)point.commit(first);
  const State before = point.now;
  (void)point.commit(first);
  EXPECT_EQ(point.now, before);  // at the same temperature nothing happens
  point.temperature = 60;
  const Response3 r = point.commit(first);
  EXPECT_GT(point.now[0], before[0]);
  const Stress3 back = Eigen::Map<const Stress3>(point.now.data() + 7);
  EXPECT_NEAR(mises(r.stress - back),
              yield_stress(metal(true, true), point.now[0], &point.temperature).value, 1e-13);
  const State hot = point.now;
  point.temperature = 0;
  (void)point.commit(first);
  EXPECT_EQ(point.now, hot);
}

TEST(J2Curves, HaveAConsistentTangent) {
  for (const J2Plasticity& small : all_laws)
    for (const Law& law : {Law(small), in_finite_strain(small)})
      for (const double size : {1.0, 4.0}) {
        Point point{law, 20};
        (void)point.commit(size * first);
        point.temperature = 55;
        State next{};
        const Response3 here = point.at(size * second, next);
        EXPECT_GT(next[0], point.now[0]);
        const auto stress = [&](const Strain3& x) -> Eigen::VectorXd {
          const Response3 r = point.at(x, next);
          EXPECT_GT(next[0], point.now[0]);  // both probes flow
          return r.stress;
        };
        const auto d = testing::check_derivative(stress, here.tangent * along,
                                                 Strain3(size * second), along, 1e-4);
        EXPECT_TRUE(d.exact || std::abs(d.order - 2) < 0.1) << d.order << " " << d.error;
      }
}

TEST(J2Curves, PlaneStressIsTheOneOfTheThicknessFound) {
  for (const J2Plasticity& law : all_laws) {
    State now{};
    double temperature = 30;
    for (const Strain& e : {Strain(0.012, -0.004, 0, 0.01), Strain(-0.006, 0.02, 0, -0.01)}) {
      State plane{}, full{};
      Memory memory{now.data(), plane.data(), now.size()};
      memory.temperature = &temperature;
      Strain whole = e;
      const Response r = plane_stress_response(law, e, &whole[2], memory);
      ASSERT_TRUE(r.ok);
      memory.next = full.data();
      const Response f = response(law, whole, memory);
      EXPECT_LT(std::abs(f.stress[2]), 1e-13);
      EXPECT_LT((f.stress - r.stress).norm(), 1e-13);
      now = plane;
      temperature = 70;
    }
    EXPECT_GT(now[0], 0.01);
  }
}

// At one temperature what is put in is stored or dissipated.
TEST(J2Curves, WorkIsStoredOrDissipated) {
  for (const J2Plasticity& law : all_laws) {
    const auto missed = [&](int steps) {
      Point point{law, 40};
      Stress3 before = Stress3::Zero();
      double work = 0;
      for (int i = 1; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps, past = t - 1.0 / steps;
        const Response3 r = point.commit(t * first + t * t * second);
        work += 0.5 * (before + r.stress).dot((t - past) * first + (t * t - past * past) * second);
        before = r.stress;
      }
      Memory memory{point.now.data()};
      memory.temperature = &point.temperature;
      return std::abs(work - stored_energy(law, Strain3(first + second), memory) -
                      dissipated_energy(law, point.now.data()));
    };
    EXPECT_LT(missed(4000), 3e-6);
    EXPECT_LT(missed(4000), 0.6 * missed(2000));
  }
}

TEST(J2Curves, OnlyTheyRememberMore) {
  EXPECT_EQ(memory_of(J2Plasticity{200, 0.3, 0, 1}).size(), 7U);
  EXPECT_EQ(memory_of(in_finite_strain(J2Plasticity{200, 0.3, 0, 1})).size(), 7U);
  for (const J2Plasticity& law : all_laws) {
    EXPECT_EQ(memory_of(law).size(), 14U);
    EXPECT_EQ(memory_of(in_finite_strain(law)).size(), 14U);
    EXPECT_TRUE(over_temperature(law));
    EXPECT_TRUE(over_temperature(in_finite_strain(law)));
  }
  J2Plasticity one{200, 0.3, 0, 1};
  one.kinematic_over = {moves[0]};
  EXPECT_FALSE(over_temperature(one));
  EXPECT_TRUE(hooke_at_first(one));
  one.young_over = {{0, 200}, {100, 100}};
  EXPECT_TRUE(over_temperature(one));
}

TEST(J2Curves, SayWhatIsWrongWithThem) {
  const auto wrong = [](const core::Curves& hardening, const core::Curves& kinematic,
                        double young_when_hot = 200) {
    J2Plasticity law{200, 0.3};
    law.hardening_over = hardening;
    law.kinematic_over = kinematic;
    law.young_over = {{0, 200}, {100, young_when_hot}};
    return range_problem(law);
  };
  EXPECT_EQ(wrong(yields, moves), "");
  EXPECT_EQ(wrong({yields[0], {100, {{1, 0.1}}}}, moves), "the first plastic strain is 0");
  EXPECT_EQ(wrong({yields[0], {100, {{0, 0}}}}, moves), "a yield stress is greater than 0");
  EXPECT_EQ(wrong(yields, {{0, {{1, 0}, {2, 1}}}}),
            "a curve of kinematic hardening begins with [0, 0]");
  EXPECT_EQ(wrong(yields, {{0, {{0, 0}, {2, 1}, {3, 1}}}}),
            "plastic strains rise from point to point");
  const char* const steep =
      "the yield stress falls more steeply than the elastic stress can follow";
  EXPECT_EQ(wrong({{0, {{10, 0}, {1, 0.05}}}}, {}), "");
  EXPECT_EQ(wrong({{0, {{10, 0}, {1, 0.05}}}}, {}, 100), steep);
  EXPECT_EQ(wrong(yields, {{0, {{0, 0}, {-5, 0.01}}}}), steep);
  J2Plasticity none{200, 0.3};
  EXPECT_EQ(range_problem(none), "give `yield` or `hardening`, one of both");
}

}  // namespace
}  // namespace osculate::material
