// Friction beyond the constant coefficient: the implicit limit, derivatives by order, dissipation.
#include <gtest/gtest.h>

#include <cmath>

#include "derivative_check.hpp"
#include "osculate/contact/law/catalogue.hpp"

namespace osculate::contact {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
enum class By { distance, speed };

Coulomb changing(double kinetic, double scale, By by, double cap = infinite) {
  Coulomb law{0.5, 80.0, cap, kinetic};
  (by == By::distance ? law.distance : law.speed) = scale;
  return law;
}

// The limit satisfies its equation: mu at the distance that the point has slid in the end.
TEST(ChangingCoulomb, LimitBelongsToWhereThePointEndsUp) {
  for (const double kinetic : {0.2, 0.0, 0.9})
    for (const double trial : {5.3, 9.0, 60.0})
      for (const double before : {0.0, 0.04}) {
        const Coulomb law = changing(kinetic, 0.1, By::distance);
        const TangentialResponse<2> r = law.response<2>(Vec<1>(-trial), -10.0, {before, 0});
        if (r.status == Status::stick) {
          EXPECT_LE(trial, 10 * law.coefficient(before));
          continue;
        }
        const double limit = -r.traction[0];
        const double moved = slid<2>(Vec<1>(-trial), r, law.stiffness);
        EXPECT_GT(moved, 0);
        const double mu = kinetic + (0.5 - kinetic) * std::exp(-(before + moved) / 0.1);
        EXPECT_NEAR(limit, 10 * mu, 1e-13 * trial);
      }
}

TEST(ChangingCoulomb, SpeedIsDistanceOverDuration) {
  const Coulomb law = changing(0.2, 0.3, By::speed);
  for (const double duration : {0.01, 1.0}) {
    const TangentialResponse<2> r = law.response<2>(Vec<1>(9.0), -10.0, {123.0, duration});
    const double speed = slid<2>(Vec<1>(9.0), r, 80.0) / duration;
    EXPECT_NEAR(r.traction[0], 10 * (0.2 + 0.3 * std::exp(-speed / 0.3)), 1e-13);
  }
  EXPECT_EQ(law.response<2>(Vec<1>(9.0), -10.0, {}).traction[0], 5.0);  // no time: static
  EXPECT_TRUE(needs_duration(FrictionLaw(law)));
  EXPECT_FALSE(needs_duration(FrictionLaw(changing(0.2, 0.3, By::distance))));
  EXPECT_FALSE(needs_duration(FrictionLaw(Tresca{1, 1})));
}

// Around multipliers: as stiff as the limit falls, by powers of ten, and no stiffer than needed.
TEST(ChangingCoulomb, IsSteadiedByPowersOfTen) {
  const FrictionLaw falling = changing(0.2, 0.1, By::distance);  // dL/ds = 3 p
  EXPECT_EQ(steadying(falling, -10, 0), 1);                      // 80 >= 2 x 30
  EXPECT_EQ(steadying(falling, -20, 0), 10);
  EXPECT_EQ(steadying(falling, -2000, 0), 1000);
  EXPECT_EQ(steadying(falling, 20, 0), 1);  // pulled: no pressure
  const FrictionLaw by_speed = changing(0.2, 0.1, By::speed);
  EXPECT_EQ(steadying(by_speed, -20, 0), 1);  // no time: static
  EXPECT_EQ(steadying(by_speed, -20, 10), 1);
  EXPECT_EQ(steadying(by_speed, -20, 0.01), 1000);
  EXPECT_EQ(steadying(changing(0.9, 0.1, By::distance), -2000, 0), 1);  // it grows
  EXPECT_EQ(steadying(Coulomb{0.5, 1e-9}, -2000, 0), 1);
  EXPECT_EQ(steadying(falling, -infinite, 0), 1e12);
}

Coulomb with_film(Coulomb law, double viscous) {
  law.viscous = viscous;
  return law;
}

// What is left of the traction without the film is dry friction at the speed of the sliding.
TEST(CoulombWithFilm, TheFilmIsOnTopOfDryFriction) {
  const double c = 3, duration = 0.25, eps = 80;
  for (const Coulomb& dry : {Coulomb{0.5, eps}, Coulomb{0.5, eps, 3.0},
                             changing(0.2, 0.1, By::distance), changing(0.9, 0.1, By::distance),
                             changing(0.2, 0.3, By::speed), changing(0.9, 0.3, By::speed, 6.0)})
    for (const double trial : {5.5, 9.0, 60.0}) {
      const Sliding sliding{0.03, duration};
      const TangentialResponse<2> r = with_film(dry, c).response<2>(Vec<1>(-trial), -10.0, sliding);
      const double moved = slid<2>(Vec<1>(-trial), r, eps), film = c * moved / duration;
      if (r.status == Status::stick) {
        EXPECT_LE(trial, dry.first_limit(10, sliding).value);
        continue;
      }
      EXPECT_GT(moved, 0);
      double mu = 0.5;
      if (dry.kinetic) {
        const double a = dry.speed ? moved / duration : 0.03 + moved;
        mu = *dry.kinetic + (0.5 - *dry.kinetic) * std::exp(-a / dry.speed.value_or(0.1));
      }
      EXPECT_NEAR(-r.traction[0], std::min(10 * mu, dry.cap) + film, 1e-13 * trial);
    }
}

TEST(CoulombWithFilm, BeginsWithoutAJumpAndNeedsATime) {
  const Coulomb law = with_film({0.5, 80.0}, 3);
  EXPECT_EQ(law.response<2>(Vec<1>(5.0), -10.0, {0, 0.5}).status, Status::stick);
  EXPECT_NEAR(law.response<2>(Vec<1>(5.0 + 1e-9), -10.0, {0, 0.5}).traction[0], 5.0, 1e-8);
  EXPECT_EQ(law.response<2>(Vec<1>(9.0), -10.0, {}).traction[0], 5.0);  // no time: dry
  EXPECT_TRUE(needs_duration(FrictionLaw(law)));
  EXPECT_FALSE(needs_duration(FrictionLaw(Coulomb{0.5, 80.0})));
  // As fast as in the last increment.
  EXPECT_EQ(predicted_limit(FrictionLaw(law), 7, -10, {0, 0.5}).value, 7);
  EXPECT_EQ(predicted_limit(FrictionLaw(law), 4, -10, {0, 0.5}).value, 5);
  EXPECT_EQ(text(FrictionLaw(law)), "Coulomb 0.5 and viscous 3 (penalty 80)");
  EXPECT_EQ(fault(FrictionLaw(with_film({0.5, 80.0}, -1))),
            "friction_coulomb: viscous must be >= 0, got -1");
}

// At the first sliding the limit is the static one, without a jump; far out the kinetic one.
TEST(ChangingCoulomb, BeginsStaticAndEndsKinetic) {
  const Coulomb law = changing(0.2, 0.1, By::distance);
  EXPECT_EQ(law.response<2>(Vec<1>(5.0), -10.0, {}).status, Status::stick);
  EXPECT_NEAR(law.response<2>(Vec<1>(5.0 + 1e-9), -10.0, {}).traction[0], 5.0, 1e-7);
  EXPECT_NEAR(law.response<2>(Vec<1>(1000.0), -10.0, {}).traction[0], 2.0, 1e-12);
  EXPECT_EQ(law.response<2>(Vec<1>(3.0), -10.0, {1.0, 0}).status, Status::slip);
}

TEST(Coulomb, CapIsTheLargestTraction) {
  const Coulomb law{0.5, 80.0, 3.0};
  EXPECT_EQ(law.response<2>(Vec<1>(2.9), -10.0).status, Status::stick);
  const TangentialResponse<2> capped = law.response<2>(Vec<1>(-4.0), -10.0);
  EXPECT_EQ(capped.status, Status::slip);
  EXPECT_EQ(capped.traction[0], -3.0);
  EXPECT_EQ(capped.d_normal[0], 0.0);
  EXPECT_EQ(law.response<2>(Vec<1>(4.0), -4.0).traction[0], 2.0);
  EXPECT_EQ(law.response<2>(Vec<1>(4.0), -4.0).d_normal[0], -0.5);
}

TEST(Coulomb, HasNoLimitLeftWhereAHeldPointIsPulled) {
  const TangentialResponse<3> r = Coulomb{0.5, 80.0}.response<3>(Vec2(3, 4), 10.0);
  EXPECT_EQ(r.status, Status::slip);
  EXPECT_EQ(r.traction.norm(), 0.0);
  EXPECT_EQ(r.d_normal.norm() + r.d_predictor.norm(), 0.0);
}

TEST(Tresca, KnowsNoPressure) {
  const Tresca law{3.0, 80.0};
  for (const double normal : {-1000.0, -1e-3, 0.0}) {
    EXPECT_EQ(law.response<2>(Vec<1>(3.0), normal).status, Status::stick);
    EXPECT_EQ(law.response<2>(Vec<1>(-7.0), normal).traction[0], -3.0);
    EXPECT_EQ(law.response<2>(Vec<1>(-7.0), normal).d_normal[0], 0.0);
  }
}

TEST(Rough, NeverSlides) {
  const TangentialResponse<3> r = Rough{80.0}.response<3>(Vec2(1e9, -3), -1e-9);
  EXPECT_EQ(r.status, Status::stick);
  EXPECT_EQ(r.traction, Vec2(1e9, -3));
}

// Where hardly anything presses it is Coulomb's law with its large coefficient, bit by bit.
TEST(Rough, LetsPartWhatIsSheared) {
  const Rough law{80.0, 1e4};
  const Coulomb steep{1e4, 80.0};
  const Vec2 trial(3, -4);
  for (const double normal : {-1.0, -5e-4, -1e-4, -1e-9, 0.0}) {
    const TangentialResponse<3> r = law.response<3>(trial, normal),
                                c = steep.response<3>(trial, normal);
    EXPECT_EQ(r.status, normal <= -5e-4 ? Status::stick : Status::slip) << normal;
    EXPECT_EQ(r.traction, c.traction);
    EXPECT_EQ(r.d_predictor, c.d_predictor);
    EXPECT_EQ(r.d_normal, c.d_normal);
    EXPECT_EQ(law.predicted_limit(5, -normal, {}).value,
              steep.predicted_limit(5, -normal, {}).value);
  }
  EXPECT_EQ(fault(FrictionLaw(Rough{80, 0})), "coefficient = 0, but coefficient > 0 is needed");
}

/// Order of the derivatives by trial and normal traction, all at once.
template <int Dim>
void expect_second_order(const FrictionLaw& law, const Vec<Dim - 1>& trial, double normal,
                         const Sliding& sliding) {
  using V = Eigen::VectorXd;
  const auto f = [&](const V& y) {
    return V(response<Dim>(law, Vec<Dim - 1>(y.head<Dim - 1>()), y[Dim - 1], sliding).traction);
  };
  const TangentialResponse<Dim> at = response<Dim>(law, trial, normal, sliding);
  V y(Dim), d(Dim);
  y << trial, normal;
  d << Vec<Dim - 1>::Constant(0.7), -0.4;
  d[0] = 1;
  const V df = at.d_predictor * d.head<Dim - 1>() + at.d_normal * d[Dim - 1];
  const testing::DerivativeReport r = testing::check_derivative(f, df, y, d, 0.05);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << "order " << r.order << ", " << r.error;
}

TEST(FrictionLaws, DerivativesAreOfSecondOrder) {
  const std::array<FrictionLaw, 15> laws{Coulomb{0.5, 80.0},
                                         Coulomb{0.5, 80.0, 3.0},
                                         changing(0.2, 0.1, By::distance),
                                         changing(0.9, 0.1, By::distance),
                                         changing(0.2, 0.2, By::speed),
                                         changing(0.9, 0.2, By::speed),
                                         changing(0.2, 0.1, By::distance, 3.0),
                                         Tresca{3.0, 80.0},
                                         Rough{80.0},
                                         Rough{80.0, 0.8},
                                         with_film({0.5, 80.0}, 3),
                                         with_film({0.5, 80.0, 3.0}, 3),
                                         with_film(changing(0.2, 0.1, By::distance), 3),
                                         with_film(changing(0.9, 0.2, By::speed), 3),
                                         with_film(changing(0.9, 0.1, By::distance), 60)};
  for (const FrictionLaw& law : laws)
    for (const double size : {1.0, 9.0, 14.0}) {
      const Sliding sliding{0.02, 0.5};
      expect_second_order<2>(law, Vec<1>(size), -10.0, sliding);
      expect_second_order<2>(law, Vec<1>(-size), -10.0, sliding);
      expect_second_order<3>(law, Vec2(0.6 * size, -0.8 * size), -10.0, sliding);
    }
}

TEST(FrictionLaws, DissipationIsTractionTimesDistanceSlid) {
  const std::array<FrictionLaw, 5> laws{Coulomb{0.5, 80.0, 3.0}, changing(0.2, 0.1, By::distance),
                                        Tresca{3.0, 80.0}, Rough{80.0}, with_film({0.5, 80.0}, 3)};
  for (const FrictionLaw& law : laws) {
    const Vec2 trial(6, -8);
    const TangentialResponse<3> r = response<3>(law, trial, -10.0, {0, 0.5});
    const double distance = slid<3>(trial, r, stiffness(law));
    EXPECT_NEAR(dissipated<3>(trial, r, stiffness(law)), r.traction.norm() * distance, 1e-14);
    EXPECT_EQ(distance == 0, law.as<Rough>() != nullptr);
  }
}

// Before the first iteration a sliding point is expected to go on at the limit it had.
TEST(FrictionLaws, PredictedLimits) {
  const FrictionLaw by_distance = changing(0.2, 0.1, By::distance);
  EXPECT_NEAR(predicted_limit(by_distance, 3, -10, {0.1, 0}).value, 2 + 3 * std::exp(-1.0), 1e-13);
  const FrictionLaw by_speed = changing(0.2, 0.1, By::speed);
  EXPECT_NEAR(predicted_limit(by_speed, 3, -10, {0.1, 1}).value, 3, 1e-13);
  EXPECT_NEAR(predicted_limit(by_speed, 1, -10, {0.1, 1}).value, 2, 1e-13);
  EXPECT_NEAR(predicted_limit(by_speed, 9, -10, {0.1, 1}).value, 5, 1e-13);
  EXPECT_EQ(predicted_limit(by_speed, 9, 0, {0.1, 1}).value, 0);
  EXPECT_EQ(predicted_limit(Tresca{3, 80}, 9, -10, {}).value, 3);
  EXPECT_EQ(predicted_limit(Coulomb{0.5, 80.0}, 9, -10, {}).d_pressure, 0.5);
}

TEST(FrictionLaws, SayWhatIsWrongWithThem) {
  EXPECT_EQ(fault(FrictionLaw(Coulomb{0.3, 80})), "");
  EXPECT_EQ(fault(FrictionLaw(Tresca{0, 80})), "");
  EXPECT_EQ(fault(FrictionLaw(Rough{80})), "");
  EXPECT_EQ(fault(FrictionLaw(Rough{0})), "friction_rough: penalty must be > 0, got 0");
  EXPECT_EQ(fault(FrictionLaw(Tresca{-1, 80})), "friction_tresca: limit must be >= 0, got -1");
  EXPECT_EQ(fault(FrictionLaw(Coulomb{0.3, 80, 0})), "friction_coulomb: cap must be > 0, got 0");
  EXPECT_EQ(fault(FrictionLaw(changing(-1, 1, By::speed))),
            "friction_coulomb: kinetic must be >= 0, got -1");
  EXPECT_EQ(fault(FrictionLaw(changing(0.2, 0, By::distance))),
            "friction_coulomb: distance must be > 0, got 0");
  Coulomb law{0.5, 80.0};
  law.kinetic = 0.2;
  EXPECT_EQ(fault(FrictionLaw(law)),
            "how the coefficient changes is missing: add decay: {distance: ...} or {speed: ...}");
  law.distance = law.speed = 1;
  EXPECT_EQ(fault(FrictionLaw(law)), "distance and speed exclude each other");
  law.kinetic.reset();
  EXPECT_EQ(fault(FrictionLaw(law)), "decay goes with a kinetic coefficient, which is missing");
}

TEST(FrictionLaws, SayTheirNumbersInAFewWords) {
  EXPECT_EQ(text(FrictionLaw(Coulomb{0.3, 80})), "Coulomb 0.3 (penalty 80)");
  EXPECT_EQ(text(FrictionLaw(changing(0.2, 1, By::speed))), "Coulomb 0.5 to 0.2 (penalty 80)");
  EXPECT_EQ(text(FrictionLaw(changing(0.2, 1, By::speed, 4))),
            "Coulomb 0.5 to 0.2 up to 4 (penalty 80)");
  EXPECT_EQ(text(FrictionLaw(Coulomb{0.3, 80, 4}).stiffened(2)),
            "Coulomb 0.3 up to 4 (penalty 160)");
  EXPECT_EQ(text(FrictionLaw(Tresca{3, 80})), "Tresca 3 (penalty 80)");
  EXPECT_EQ(text(FrictionLaw(Rough{80})), "rough (penalty 80)");
}

// Points that may part have the steep law of friction in place of none; other laws are their own.
TEST(FrictionLaws, OfPointsThatMayPart) {
  EXPECT_EQ(parting(Rough{80}).as<Rough>()->coefficient, Rough::steep);
  EXPECT_EQ(parting(Rough{80, 3}).as<Rough>()->coefficient, 3);
  EXPECT_EQ(parting(Tresca{3, 80}).as<Tresca>()->limit_traction, 3);
}

}  // namespace
}  // namespace osculate::contact
