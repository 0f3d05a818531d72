// Rubber that relaxes: against closed solutions, quadrature and its laws at once and at small
// strain.
#include "osculate/material/relaxing.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <functional>

#include "derivative_check.hpp"
#include "osculate/material/energy.hpp"
#include "osculate/material/law.hpp"
#include "point_in_time.hpp"
#include "sample_laws.hpp"

namespace osculate::material {
namespace {

const Relaxation both{{{0.3, 0.5}, {0.4, 20}}, {{0.25, 3}}};
const Relaxation alike{{{0.3, 0.5}, {0.4, 20}}, {{0.3, 0.5}, {0.4, 20}}};
using State = std::array<double, 17 + 2 * 9>;

const Strain3 first(0.32, -0.16, 0.12, 0.30, -0.15, 0.28);
const Strain3 second(-0.14, 0.29, 0.12, -0.32, 0.16, 0.13);
const Strain3 along(0.5, -0.3, 0.2, 0.7, -0.4, 0.6);

template <class T>
Law elastic(double poisson) {
  T law;
  testing::set_elastic(law, 100, poisson);
  return law;
}
const std::vector<Law>& at_once() {
  static const std::vector<Law> all{elastic<NeoHooke>(0.4), elastic<Rubber>(0.4),
                                    elastic<Ogden>(0.4), elastic<Hyperfoam>(0.2),
                                    elastic<ArrudaBoyce>(0.4)};
  return all;
}
Relaxation series_of(const Law& law) { return relaxes_alike(law) ? alike : both; }

struct Sample : testing::PointInTime<std::tuple_size_v<State>> {
  explicit Sample(const Law& base) : PointInTime{*relaxing(base, series_of(base))} {}

  [[nodiscard]] double stored(const Strain3& e) const {
    return stored_energy(law, e, {now.data()});
  }
};

Mat<3, 3> tensor(const Vec<6>& v, double shear) {
  Mat<3, 3> t;
  t << v[0], shear * v[3], shear * v[5], shear * v[3], v[1], shear * v[4], shear * v[5],
      shear * v[4], v[2];
  return t;
}
Vec<6> components(const Mat<3, 3>& t, double shear) {
  return {t(0, 0), t(1, 1), t(2, 2), shear * t(0, 1), shear * t(1, 2), shear * t(0, 2)};
}
/// DEV(A) and A : C / 3 of a strain.
struct Split {
  Mat<3, 3> deviator;
  double mean;
};
Split split(const Mat<3, 3>& a, const Strain3& e) {
  const Mat<3, 3> c = Mat<3, 3>::Identity() + 2 * tensor(e, 0.5);
  const double mean = a.cwiseProduct(c).sum() / 3;
  return {a - mean * c.inverse(), mean};
}
Mat<3, 3> inverse_of(const Strain3& e) {
  return (Mat<3, 3>::Identity() + 2 * tensor(e, 0.5)).inverse();
}
double left_at(const core::Table& series, double time) {
  double left = 1;
  for (const auto& [share, tau] : series) left -= share * -std::expm1(-time / tau);
  return left;
}

TEST(Relaxing, AtOnceIsTheLawItself) {
  for (const Law& base : at_once()) {
    Sample point(base);
    const Stress3 s = point.commit(first, 0);
    const Response3 known = response(base, first);
    EXPECT_LT((s - known.stress).norm(), 1e-13 * s.norm()) << key_of(base);
    State next{};
    const Response3 again = point.at(first, 0, next);
    EXPECT_LT((again.tangent - known.tangent).norm(), 1e-13 * known.tangent.norm());
    EXPECT_LT((again.stress - s).norm(), 1e-13 * s.norm());
    EXPECT_NEAR(dissipated_energy(point.law, point.now.data()), 0, 1e-13 * s.norm());
    EXPECT_NEAR(point.stored(first), stored_energy(base, first), 1e-13 * s.norm());
    EXPECT_TRUE(point.commit(second, 1e-9).allFinite());
    EXPECT_LT(dissipated_energy(point.law, point.now.data()), 1e-7 * s.norm());
    EXPECT_GT(dissipated_energy(point.law, point.now.data()), 0);
  }
}

// However long the increments are.
TEST(Relaxing, OfAHeldStrainRelaxesByItsSeries) {
  for (const Law& base : at_once())
    for (const int parts : {1, 7}) {
      Sample point(base);
      (void)point.commit(first, 0);
      const Relaxation series = series_of(base);
      const Response3 whole = response(base, first);
      const Split of = split(tensor(whole.stress, 1), first);
      double time = 0;
      for (const double to : {0.1, 2.0, 50.0, 1000.0}) {
        Stress3 s = Stress3::Zero();
        for (int i = 0; i < parts; ++i) s = point.commit(first, (to - time) / parts);
        time = to;
        const Mat<3, 3> known = left_at(series.shear, time) * of.deviator +
                                left_at(series.bulk, time) * of.mean * inverse_of(first);
        EXPECT_LT((s - components(known, 1)).norm(), 1e-13 * whole.stress.norm())
            << key_of(base) << time;
      }
    }
}

// Each term loses the energy that its share of the law had.
TEST(Relaxing, OfAHeldStrainLosesTheEnergyOfItsTerms) {
  Rubber rubber = std::get<Rubber>(elastic<Rubber>(0.4));
  Rubber shape = rubber;
  shape.d1 = 1e300;
  const double of_shape = energy_of(shape, first), whole = energy_of(rubber, first);
  Sample point{Law(rubber)};
  (void)point.commit(first, 0);
  for (const double to : {0.3, 8.0, 500.0}) {
    Sample then = point;
    (void)then.commit(first, to);
    double lost = 0;
    for (const auto& [g, tau] : both.shear) lost += g * of_shape * -std::expm1(-2 * to / tau);
    for (const auto& [k, tau] : both.bulk)
      lost += k * (whole - of_shape) * -std::expm1(-2 * to / tau);
    EXPECT_NEAR(dissipated_energy(then.law, then.now.data()), lost, 1e-12 * whole);
    EXPECT_NEAR(then.stored(first), whole - lost, 1e-12 * whole);
  }
}

/// Derivative by the shear y of T of neo-Hooke's law with the shear modulus 1 in simple shear,
/// I - (3 + y^2) / 3 C^-1 , C^-1 = [1 + y^2, -y; -y, 1].
Mat<3, 3> slope_of_shear(double y) {
  Mat<3, 3> inverse = Mat<3, 3>::Identity(), slope = Mat<3, 3>::Zero();
  inverse.topLeftCorner<2, 2>() << 1 + y * y, -y, -y, 1;
  slope.topLeftCorner<2, 2>() << 2 * y, -1, -1, 0;
  return -2 * y / 3 * inverse - (3 + y * y) / 3 * slope;
}
/// int G(t - s) dT/ds ds at a rate, by Simpson's rule.
Mat<3, 3> hereditary(double rate, double time) {
  constexpr int parts = 20000;
  Mat<3, 3> sum = Mat<3, 3>::Zero();
  for (int i = 0; i <= parts; ++i) {
    const double s = time * i / parts, weight = i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * left_at(both.shear, time - s) * slope_of_shear(rate * s);
  }
  return sum * rate * time / (3 * parts);
}
Strain3 sheared(double y) { return {0, 0.5 * y * y, 0, y, 0, 0}; }

TEST(Relaxing, ShearAtARateIsTheHereditaryIntegralToSecondOrder) {
  Rubber law;
  law.c10 = 0.5;
  law.d1 = 0.01;
  const double time = 3, rate = 0.7;
  const Split known = split(hereditary(rate, time), sheared(rate * time));
  const auto error = [&](int parts) {
    Sample point{Law(law)};
    Stress3 s = Stress3::Zero();
    for (int i = 1; i <= parts; ++i)
      s = point.commit(sheared(rate * time * i / parts), time / parts);
    return (s - components(known.deviator, 1)).norm() / s.norm();
  };
  const double fine = error(160);
  EXPECT_LT(fine, 2e-4);
  EXPECT_NEAR(std::log2(error(80) / fine), 2, 0.03);
}

TEST(Relaxing, IsOfSecondOrderWhereStrainsChangeUnevenly) {
  for (const Law& base : at_once()) {
    const auto stress_after = [&](int parts) {
      Sample point(base);
      Stress3 s = Stress3::Zero();
      for (int i = 1; i <= parts; ++i) {
        const double t = static_cast<double>(i) / parts;
        s = point.commit(0.5 * std::sin(2 * t) * first + t * t * second, 3.0 / parts);
      }
      return s;
    };
    const Stress3 exact = stress_after(4096);
    const double coarse = (stress_after(32) - exact).norm(),
                 fine = (stress_after(64) - exact).norm();
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.05) << key_of(base);
  }
}

TEST(Relaxing, HasAConsistentTangent) {
  for (const Law& base : at_once())
    for (const double duration : {0.0, 0.3, 40.0}) {
      Sample point(base);
      (void)point.commit(first, 0.7);
      State next{};
      const Response3 here = point.at(second, duration, next);
      const auto of = [&](const Strain3& x) -> Eigen::VectorXd {
        return point.at(x, duration, next).stress;
      };
      const auto d = testing::check_derivative(of, here.tangent * along, second, along, 1e-3);
      EXPECT_TRUE(d.exact || std::abs(d.order - 2) < 0.1)
          << key_of(base) << " " << d.order << " " << d.error;
      EXPECT_LT((here.tangent - here.tangent.transpose()).norm(), 1e-14 * here.tangent.norm());
    }
}

// The stress is the derivative of what is stored, where no time passes.
TEST(Relaxing, StoresWhatItGivesBackAtOnce) {
  for (const Law& base : at_once()) {
    Sample point(base);
    (void)point.commit(first, 0.7);
    State next{};
    const auto stored = [&](const Strain3& x) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(1, point.stored(x));
    };
    const double slope = point.at(second, 0, next).stress.dot(along);
    const auto d =
        testing::check_derivative(stored, Eigen::VectorXd::Constant(1, slope), second, along, 1e-3);
    EXPECT_TRUE(d.exact || std::abs(d.order - 2) < 0.1)
        << key_of(base) << " " << d.order << " " << d.error;
    const double before = dissipated_energy(point.law, point.now.data());
    const double energy = point.stored(second);
    (void)point.commit(second, 0);
    EXPECT_NEAR(dissipated_energy(point.law, point.now.data()), before, 1e-13 * energy);
    EXPECT_NEAR(point.stored(second), energy, 1e-13 * energy);
  }
}

// Trapezes of the stress over the strain miss a quarter in steps half as long.
TEST(Relaxing, WorkIsStoredOrDissipated) {
  for (const Law& base : at_once())
    for (const double time : {0.05, 5.0, 400.0}) {
      const auto missed = [&](int parts) {
        Sample point(base);
        Strain3 before = Strain3::Zero();
        Stress3 last = Stress3::Zero();
        double work = 0;
        for (int i = 1; i <= parts; ++i) {
          const double t = static_cast<double>(i) / parts;
          const Strain3 e = t * first + t * t * 0.5 * second;
          const Stress3 s = point.commit(e, time / parts);
          work += 0.5 * (s + last).dot(e - before);
          before = e;
          last = s;
        }
        const double dissipated = dissipated_energy(point.law, point.now.data());
        EXPECT_GT(dissipated, 0);
        EXPECT_GT(point.stored(before), 0);
        return std::abs(work - point.stored(before) - dissipated) / work;
      };
      const double fine = missed(4000);
      EXPECT_LT(fine, 1e-5) << key_of(base) << time;
      EXPECT_NEAR(missed(2000) / fine, 4, 0.3) << key_of(base) << time;
    }
}

// Of small strains it is linear viscoelasticity of the same series, up to the square of the strain.
TEST(Relaxing, IsLinearViscoelasticityOfSmallStrains) {
  for (const Law& base : at_once()) {
    const Isotropic constants = unloaded(base);
    const Relaxation series = series_of(base);
    const Law linear =
        Viscoelastic{constants.young, constants.poisson, 0, series.shear, series.bulk};
    const auto apart = [&](double size) {
      Sample point(base);
      std::vector<double> now(memory_of(linear).size()), next(now.size());
      double worst = 0;
      for (int i = 1; i <= 12; ++i) {
        const Strain3 e = size * (i * first + std::sin(i) * second);
        const Stress3 s = point.commit(e, 0.3 * i);
        const Stress3 small =
            response(linear, e, {now.data(), next.data(), now.size(), 0.3 * i}).stress;
        now.swap(next);
        worst = std::max(worst, (s - small).norm());
      }
      const double lost = dissipated_energy(linear, now.data());
      return std::array{worst, std::abs(dissipated_energy(point.law, point.now.data()) - lost)};
    };
    const auto coarse = apart(2e-3), fine = apart(1e-3);
    EXPECT_NEAR(std::log2(coarse[0] / fine[0]), 2, 0.15) << key_of(base);
    EXPECT_NEAR(std::log2(coarse[1] / fine[1]), 3, 0.2) << key_of(base);
  }
}

TEST(Relaxing, TurnsWithTheMaterial) {
  const Mat<3, 3> q = Eigen::AngleAxisd(0.9, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const auto turned = [&](const Vec<6>& v, double shear) {
    return components(q * tensor(v, 1 / shear) * q.transpose(), shear);
  };
  for (const Law& base : at_once()) {
    Sample one(base), other(base);
    for (const Strain3& e : {first, second, Strain3(0.5 * first)}) {
      const Stress3 a = one.commit(e, 0.6), b = other.commit(turned(e, 2), 0.6);
      EXPECT_LT((turned(a, 1) - b).norm(), 1e-12 * a.norm()) << key_of(base);
      EXPECT_NEAR(dissipated_energy(one.law, one.now.data()),
                  dissipated_energy(other.law, other.now.data()), 1e-12 * a.norm());
    }
  }
}

TEST(Relaxing, PlaneStressIsTheOneOfTheThicknessFound) {
  for (const Law& base : at_once()) {
    const Law law = *relaxing(base, series_of(base));
    State now{};
    for (const Strain& e : {Strain(0.42, -0.14, 0, 0.1), Strain(-0.16, 0.4, 0, -0.2)}) {
      State plane{}, full{};
      Strain whole = e;
      const Response r =
          plane_stress_response(law, e, &whole[2], {now.data(), plane.data(), now.size(), 0.8});
      ASSERT_TRUE(r.ok);
      const Response f = response(law, whole, {now.data(), full.data(), now.size(), 0.8});
      EXPECT_LT(std::abs(f.stress[2]), 1e-12 * f.stress.norm());
      EXPECT_LT((f.stress - r.stress).norm(), 1e-12 * f.stress.norm());
      const Tangent condensed = f.tangent - f.tangent.col(2) * f.tangent.row(2) / f.tangent(2, 2);
      EXPECT_LT((r.tangent - condensed).norm(), 1e-12 * f.tangent.norm());
      EXPECT_EQ(plane, full);
      const Response3 space =
          response(law, Strain3(in_space(whole)), {now.data(), full.data(), now.size(), 0.8});
      EXPECT_EQ(Stress(space.stress.head<4>()), f.stress);
      now = plane;
    }
  }
}

TEST(Relaxing, HasNoAnswerWhereTheLawHasNone) {
  for (const Law& base : at_once()) {
    Sample point(base);
    State next{};
    EXPECT_FALSE(point.at({-0.6, 0, 0, 0, 0, 0}, 1, next).ok);
    EXPECT_EQ(next, State{});
    EXPECT_TRUE(std::isinf(point.stored({-0.6, 0, 0, 0, 0, 0})));
  }
}

TEST(Relaxing, SaysWhatItIs) {
  for (const Law& base : at_once()) {
    const Law law = *relaxing(base, series_of(base));
    EXPECT_EQ(key_of(law), key_of(base));
    EXPECT_EQ(memory_of(law).size(), 35U);
    EXPECT_TRUE(needs_duration(law));
    EXPECT_FALSE(needs_duration(base));
    EXPECT_TRUE(finite_strain(law));
    EXPECT_TRUE(large_strain(law));
    EXPECT_FALSE(linear(law));
    EXPECT_EQ(range_problem(law), "");
    EXPECT_EQ(density(law), density(base));
    EXPECT_EQ(unloaded(law).young, unloaded(base).young);
    EXPECT_EQ(range_problem(*relaxing(base, {})),
              "give `shear` or `bulk`: without, nothing relaxes");
    EXPECT_EQ(relaxes_alike(base), key_of(base) == "neo_hooke" || key_of(base) == "hyperfoam");
  }
  EXPECT_FALSE(relaxing(LinearElastic{1, 0.3, 0}, both));
  EXPECT_FALSE(relaxing(StVenantKirchhoff{1, 0.3, 0}, both));
  EXPECT_EQ(Relaxation().fault()->why, "give `shear` or `bulk`: without, nothing relaxes");
  EXPECT_EQ(Relaxation({{{1, 1}}, {}}).fault()->why,
            "the sum of the shares is less than 1: something remains");
}

}  // namespace
}  // namespace osculate::material
