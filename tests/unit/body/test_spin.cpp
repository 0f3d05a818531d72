#include "osculate/body/spin.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "derivative_check.hpp"

namespace osculate::body {
namespace {

/// Generalised alpha with spectral radius r at high frequencies (Chung, Hulbert 1993).
RotationScheme dissipative(double h, double r) {
  const double alpha_m = (2 * r - 1) / (r + 1), alpha_f = r / (r + 1);
  const double gamma = 0.5 - alpha_m + alpha_f, root = 0.5 + gamma;
  return {h, alpha_m, 0.25 * root * root, gamma};
}
RotationScheme conserving(double h) { return {h, 0.5, 0.25, 0.5}; }
RotationScheme trapezoidal(double h) { return {h, 0.0, 0.25, 0.5}; }

Mat<3, 3> three_moments() { return Vec3(1, 2, 3).asDiagonal(); }
/// The same body in a reference frame that is not its own.
Mat<3, 3> full_inertia() {
  const Mat<3, 3> r = rotation_matrix({0.4, -0.9, 0.7});
  return r * three_moments() * r.transpose();
}

struct Top {
  Mat<3, 3> inertia = three_moments();
  RigidMotion3 motion;
  RotationRates<3> rates;
};

Top top_with(const Mat<3, 3>& inertia, const Vec3& w) {
  Top top{inertia, {}, {}};
  top.rates = initial_rates(inertia, top.motion, w, Vec3::Zero());
  return top;
}

/// A step under a moment fixed in space, by Newton on the rotation vector as the system would.
Top step(const Top& top, const RotationScheme& scheme, const Vec3& load = Vec3::Zero()) {
  Top next = top;
  next.motion.rotation += predicted_turn(top.motion, top.rates, scheme.step);
  const double unit = angular_momentum(top.inertia, top.motion, top.rates).norm() / scheme.step;
  for (int i = 0; i < 30; ++i) {
    const InertiaMoment<3> now =
        inertia_moment(top.inertia, top.rates, scheme, top.motion, next.motion);
    next.rates = now.rates;
    const Vec3 rest = now.moment - load;
    if (rest.norm() < 4e-16 * (unit + load.norm())) break;
    const RotationForce<3> force = rotation_force(next.motion, rest, now.gradient);
    const Vec3 change = force.tangent.inverse() * force.force;
    next.motion.rotation -= change;
    if (change.norm() < 1e-16) break;
  }
  next.rates = inertia_moment(top.inertia, top.rates, scheme, top.motion, next.motion).rates;
  next.motion = rebased(next.motion, 0.0);
  return next;
}

double energy(const Top& top) { return rotation_energy(top.inertia, top.rates); }
Vec3 momentum(const Top& top) { return angular_momentum(top.inertia, top.motion, top.rates); }

/// sn, cn, dn of u with modulus k, by the arithmetic-geometric mean.
Vec3 jacobi(double u, double k) {
  std::vector<double> a{1}, c{k};
  double b = std::sqrt(1 - k * k);
  while (std::abs(c.back()) > 1e-17) {
    const double mean = 0.5 * (a.back() + b), half = 0.5 * (a.back() - b);
    b = std::sqrt(a.back() * b);
    a.push_back(mean);
    c.push_back(half);
  }
  const std::size_t n = a.size() - 1;
  double phi = std::ldexp(a[n] * u, static_cast<int>(n));
  for (std::size_t i = n; i > 0; --i) phi = 0.5 * (phi + std::asin(c[i] / a[i] * std::sin(phi)));
  const double sn = std::sin(phi);
  return {sn, std::cos(phi), std::sqrt(1 - k * k * sn * sn)};
}

/// Euler's free top with moments of inertia i1 < i2 < i3 in Jacobi's elliptic functions (Landau,
/// Lifshitz, Mechanics, section 37), for L^2 > 2 E i2: the axis of momentum goes round axis 3.
struct EulerTop {
  Vec3 amplitude;  ///< of cn, sn, dn
  double rate, modulus;
  [[nodiscard]] Vec3 at(double t) const {
    const Vec3 j = jacobi(rate * t, modulus);
    return amplitude.cwiseProduct(Vec3(j[1], j[0], j[2]));
  }
  /// Of w_1 and w_2; w_2 changes its sign every half of it.
  [[nodiscard]] double period() const { return 4 * std::comp_ellint_1(modulus) / rate; }
};

EulerTop euler_top(const Vec3& i, double w1, double w3) {
  const double twice_e = i[0] * w1 * w1 + i[2] * w3 * w3;
  const double l2 = i[0] * i[0] * w1 * w1 + i[2] * i[2] * w3 * w3;
  const double a = twice_e * i[2] - l2, b = l2 - twice_e * i[0];
  // w_1 = cn, w_2 = -sn, w_3 = dn solve i1 w_1' = (i2 - i3) w_2 w_3 and so on for w_1, w_3 > 0.
  return {Vec3(w1, std::sqrt(a / (i[1] * (i[2] - i[1]))), w3),
          std::sqrt((i[2] - i[1]) * b / i.prod()),
          std::sqrt((i[1] - i[0]) * a / ((i[2] - i[1]) * b))};
}

double slope(double coarse, double fine) { return std::log2(coarse / fine); }

TEST(EulerTop, SolvesEulersEquations) {
  const Vec3 i(1, 2, 3);
  const EulerTop exact = euler_top(i, 0.5, 1.1);
  for (const double t : {0.0, 0.7, 3.0, 9.0}) {
    const Vec3 w = exact.at(t), jw = i.cwiseProduct(w);
    const auto report = testing::check_derivative(
        [&](const Vec<1>& at) { return Eigen::VectorXd(i.cwiseProduct(exact.at(at[0]))); },
        jw.cross(w), Vec<1>(t), Vec<1>(1.0));
    EXPECT_NEAR(report.order, 2, 0.05) << t << " " << report.error;
  }
  EXPECT_LT((exact.at(exact.period()) - exact.at(0)).norm(), 1e-14);
}

/// Free or not, with or without a base, in whatever frame the inertia is.
TEST(Spin, TangentOfTheMomentIsItsDerivative) {
  const Mat<3, 3> inertia = full_inertia();
  const RotationRates<3> rates{{0.8, -0.5, 1.1}, {0.3, 0.7, -0.2}, {-0.4, 0.9, 0.6}};
  const Vec3 d(0.4, 0.9, -0.3);
  RigidMotion3 from{Vec3::Zero(), Vec3::Zero(), Vec3(0.9, 1.7, -1.2)};
  for (const bool base : {false, true}) {
    if (base) from = rebased(from, 0.0);
    for (const RotationScheme& scheme :
         {conserving(0.3), trapezoidal(0.7), dissipative(0.5, 0.4), dissipative(0.2, 0.0)}) {
      const auto force = [&](const Vec3& theta) {
        RigidMotion3 to = from;
        to.rotation = theta;
        const InertiaMoment<3> m = inertia_moment(inertia, rates, scheme, from, to);
        return rotation_force(to, m.moment, m.gradient);
      };
      for (const double size : {0.0, 0.2, 1.3}) {
        const Vec3 theta = from.rotation + size * Vec3(0.48, -0.6, 0.64);
        const auto report = testing::check_derivative(
            [&](const Vec3& v) { return Eigen::VectorXd(force(v).force); },
            force(theta).tangent * d, theta, d);
        EXPECT_NEAR(report.order, 2, 0.05) << base << " " << size << " " << report.error;
      }
    }
  }
}

TEST(Spin, RatesFollowNewmarksFormulas) {
  const RotationRates<3> rates{{0.8, -0.5, 1.1}, {0.3, 0.7, -0.2}, {-0.4, 0.9, 0.6}};
  const RotationScheme s = dissipative(0.2, 0.6);
  const Mat<3, 3> r = rotation_matrix({0.9, 1.7, -1.2}), inertia = full_inertia();
  const Vec3 turn(0.3, -0.2, 0.5);
  const InertiaMoment<3> out = inertia_moment(inertia, r, rates, s, turn);
  const Vec3 in_body =
      s.step * rates.velocity +
      s.step * s.step * ((0.5 - s.beta) * rates.acceleration + s.beta * out.rates.acceleration);
  EXPECT_LT((in_body - r.transpose() * turn).norm(), 1e-15);
  const Vec3 velocity = rates.velocity + s.step * ((1 - s.gamma) * rates.acceleration +
                                                   s.gamma * out.rates.acceleration);
  EXPECT_LT((velocity - out.rates.velocity).norm(), 1e-15);
  const Vec3 gained = rotation_matrix(turn) * r * inertia * velocity - r * inertia * rates.velocity;
  const Vec3 given = s.step * ((1 - s.gamma) * rates.moment + s.gamma * out.rates.moment);
  EXPECT_LT((gained - given).norm(), 5e-15);
  const Vec3 weighted = (1 - s.alpha_m) * out.rates.moment + s.alpha_m * rates.moment;
  EXPECT_LT((weighted - out.moment).norm(), 1e-15);
}

/// A contact moment C at the end of the step beside the others, with half or all of its way.
TEST(Spin, ContactAtTheEndOfTheStepEntersByItsImpulse) {
  const RotationRates<3> rates{{0.8, -0.5, 1.1}, {0.3, 0.7, -0.2}, {-0.4, 0.9, 0.6}};
  const RigidMotion3 from{Vec3::Zero(), Vec3::Zero(), Vec3(0.9, 0.7, -1.2)};
  RigidMotion3 to = from;
  to.rotation += Vec3(0.2, -0.3, 0.1);
  const Mat<3, 3> inertia = full_inertia(), r = from.orientation();
  const Vec3 contact(0.7, -0.2, 1.3), turn = turn_between(from, to);
  for (const double way : {0.5, 1.0}) {
    const RotationScheme s = dissipative(0.2, 0.6);
    const double h = s.step;
    const InertiaMoment<3> plain = inertia_moment(inertia, rates, s, from, to);
    const RotationRates<3> now = with_contact(plain.rates, inertia, s, to, contact, way);
    const Vec3 b = inertia.inverse() * (to.orientation().transpose() * contact);
    const Vec3 in_body =
        h * rates.velocity +
        h * h * ((0.5 - s.beta) * rates.acceleration + s.beta * now.acceleration + way * b);
    EXPECT_LT((in_body - r.transpose() * turn).norm(), 1e-14);
    const Vec3 velocity =
        rates.velocity + h * ((1 - s.gamma) * rates.acceleration + s.gamma * now.acceleration + b);
    EXPECT_LT((velocity - now.velocity).norm(), 1e-14);
    const Vec3 gained = to.orientation() * inertia * now.velocity - r * inertia * rates.velocity;
    const Vec3 given = h * ((1 - s.gamma) * rates.moment + s.gamma * now.moment + contact);
    EXPECT_LT((gained - given).norm(), 1e-14);
    const double scale = s.beta / (1 - s.alpha_m) / way;
    const Vec3 others = (1 - s.alpha_m) * now.moment + s.alpha_m * rates.moment;
    EXPECT_LT((scale * plain.moment - contact - scale * others).norm(), 1e-13);
  }
}

TEST(Spin, ContactInThePlane) {
  const RotationScheme s = dissipative(0.3, 0.5);
  const RotationRates<3> rates{{0, 0, 1.1}, {0, 0, -0.2}, {0, 0, -0.6}};
  const RotationRates<2> flat{Vec<1>(1.1), Vec<1>(-0.2), Vec<1>(-0.6)};
  const RotationRates<3> space =
      with_contact(rates, three_moments(), s, RigidMotion3{}, {0, 0, 0.7}, 0.5);
  const RotationRates<2> plane =
      with_contact(flat, Mat<1, 1>(3.0), s, RigidMotion{}, Vec<1>(0.7), 0.5);
  EXPECT_NEAR(space.velocity[2], plane.velocity[0], 1e-15);
  EXPECT_NEAR(space.acceleration[2], plane.acceleration[0], 1e-15);
  EXPECT_NEAR(space.moment[2], plane.moment[0], 1e-15);
}

TEST(Spin, MomentAndForceDoTheSameWork) {
  const RigidMotion3 motion{Vec3::Zero(), Vec3::Zero(), Vec3(0.9, 1.7, -1.2)};
  const Vec3 moment(0.3, 0.1, 0.7), d(0.4, 0.9, -0.3);
  const Vec3 force = rotation_force(motion, moment, Mat<3, 3>::Zero()).force;
  EXPECT_LT((moment_of(motion, force) - moment).norm(), 1e-15);
  EXPECT_NEAR(force.dot(d), moment.dot(rotation_tangent(motion.rotation) * d), 1e-15);
}

TEST(Spin, StartsByEulersEquations) {
  const RigidMotion3 motion{Vec3::Zero(), Vec3::Zero(), Vec3(0.4, 0.9, -0.3)};
  const Vec3 velocity(0.5, 0.2, -0.8), moment(0.3, 0.1, 0.7);
  const Mat<3, 3> inertia = full_inertia();
  const RotationRates<3> rates = initial_rates(inertia, motion, velocity, moment);
  EXPECT_LT((spin(motion, rates) - velocity).norm(), 1e-15);
  const Vec3 w = rates.velocity, gyroscopic = w.cross(inertia * w);
  const Vec3 rest =
      inertia * rates.acceleration + gyroscopic - motion.orientation().transpose() * moment;
  EXPECT_LT(rest.norm(), 1e-15);
  EXPECT_EQ(rates.moment, moment);
}

TEST(Spin, RateOfTheRotationVector) {
  const RigidMotion3 motion{Vec3::Zero(), Vec3::Zero(), Vec3(0.4, 0.9, -1.3)};
  const Vec3 velocity(0.5, 0.2, -0.8), rate = rotation_rate(motion, velocity);
  // R' = [w] R
  const Mat<3, 3> spinning = cross_matrix(velocity) * motion.orientation();
  const auto report = testing::check_derivative(
      [&](const Vec<1>& t) {
        const Mat<3, 3> r = rotation_matrix(motion.rotation + t[0] * rate);
        return Eigen::VectorXd(Eigen::Map<const Vec<9>>(r.data()));
      },
      Eigen::Map<const Vec<9>>(spinning.data()), Vec<1>(0.0), Vec<1>(1.0));
  EXPECT_NEAR(report.order, 2, 0.05) << report.error;
  EXPECT_EQ(rotation_rate(RigidMotion{}, Vec<1>(0.3))[0], 0.3);
}

TEST(Spin, OfAPlaneBody) {
  const Mat<1, 1> inertia(2.5);
  const RigidMotion motion{Vec2(1, 0), Vec2(0, 0), 7.0};
  const RotationRates<2> rates = initial_rates(inertia, motion, Vec<1>(0.8), Vec<1>(0.5));
  EXPECT_DOUBLE_EQ(rates.acceleration[0], 0.2);
  EXPECT_EQ(rates.moment[0], 0.5);
  EXPECT_EQ(spin(motion, rates)[0], 0.8);
  EXPECT_DOUBLE_EQ(angular_momentum(inertia, motion, rates)[0], 2.0);
  EXPECT_DOUBLE_EQ(rotation_energy(inertia, rates), 0.8);
  EXPECT_DOUBLE_EQ(predicted_turn(motion, rates, 0.1)[0], 0.1 * 0.8 + 0.5 * 0.01 * 0.2);
  EXPECT_EQ(moment_of(motion, Vec<1>(0.3))[0], 0.3);
  // A constant moment is met exactly: the angle by a parabola.
  RigidMotion to = motion;
  to.angle += predicted_turn(motion, rates, 0.1)[0];
  const InertiaMoment<2> now = inertia_moment(inertia, rates, trapezoidal(0.1), motion, to);
  EXPECT_NEAR(now.moment[0], 0.5, 1e-12);
  EXPECT_NEAR(now.rates.velocity[0], 0.82, 1e-14);
}

/// About a principal axis that is normal to the plane, space is the plane.
TEST(Spin, ReducesToThePlane) {
  const RotationScheme s = dissipative(0.3, 0.5);
  const RotationRates<3> rates{{0, 0, 1.1}, {0, 0, -0.2}, {0, 0, -0.6}};
  const RotationRates<2> flat{Vec<1>(1.1), Vec<1>(-0.2), Vec<1>(-0.6)};
  const InertiaMoment<3> space =
      inertia_moment(three_moments(), Mat<3, 3>(Mat<3, 3>::Identity()), rates, s, Vec3(0, 0, 0.25));
  const InertiaMoment<2> plane = inertia_moment(Mat<1, 1>(3.0), flat, s, Vec<1>(0.25));
  EXPECT_LT((space.moment - Vec3(0, 0, plane.moment[0])).norm(), 1e-14);
  EXPECT_NEAR(space.gradient(2, 2), plane.gradient(0, 0), 1e-13);
  EXPECT_NEAR(space.rates.acceleration[2], plane.rates.acceleration[0], 1e-14);
  EXPECT_NEAR(space.rates.moment[2], plane.rates.moment[0], 1e-14);
}

/// Which base the rotation vector stands on is a matter of coordinates.
TEST(Spin, DoesNotDependOnTheBase) {
  const RotationRates<3> rates{{0.8, -0.5, 1.1}, {0.3, 0.7, -0.2}, {-0.4, 0.9, 0.6}};
  RigidMotion3 from{Vec3::Zero(), Vec3::Zero(), Vec3(0.9, 0.7, -1.2)}, to = from;
  to.rotation += Vec3(0.2, -0.3, 0.1);
  const RigidMotion3 moved = rebased(from, 0.0);
  RigidMotion3 there = moved;
  there.rotation = turn_between(from, to);
  const InertiaMoment<3> a = inertia_moment(full_inertia(), rates, conserving(0.2), from, to);
  const InertiaMoment<3> b = inertia_moment(full_inertia(), rates, conserving(0.2), moved, there);
  EXPECT_LT((a.moment - b.moment).norm(), 1e-13);
  EXPECT_LT((a.gradient - b.gradient).norm(), 1e-12);
}

/// Steps of a tenth of a turn and more: momentum in space and energy stay to round-off.
TEST(FreeTop, ConservesMomentumAndEnergyAtAnyStep) {
  for (const double h : {0.05, 0.5, 1.0}) {
    Top top = top_with(full_inertia(), {0.9, 0.3, 0.8});
    const Vec3 l = momentum(top);
    const double e = energy(top);
    for (int i = 0; i < 1000; ++i) top = step(top, conserving(h));
    EXPECT_LT((momentum(top) - l).norm(), 1e-12 * l.norm()) << h;
    EXPECT_NEAR(energy(top), e, 1e-12 * e) << h;
  }
}

/// With numerical dissipation the momentum stays as well, and the energy with the share that
/// Newmark's family carries in the accelerations goes down by exactly what the scheme takes.
TEST(FreeTop, DissipationTakesNoMomentumAndGivesNoEnergy) {
  for (const double r : {0.9, 0.5, 0.0}) {
    const RotationScheme s = dissipative(0.4, r);
    const double share = s.step * s.step * (s.beta - 0.5 * s.gamma);
    Top top = top_with(full_inertia(), {0.9, 0.3, 0.8});
    const Vec3 l = momentum(top);
    const auto carried = [&](const Top& t) {
      const Vec3& a = t.rates.acceleration;
      return energy(t) + 0.5 * share * a.dot(t.inertia * a);
    };
    for (int i = 0; i < 300; ++i) {
      const Top next = step(top, s);
      const Vec3 change = next.rates.acceleration - top.rates.acceleration;
      const double taken = share * (s.gamma - 0.5) * change.dot(top.inertia * change);
      EXPECT_NEAR(carried(top) - carried(next), taken, 1e-14 * carried(top));
      EXPECT_GE(taken, 0);
      top = next;
    }
    EXPECT_LT((momentum(top) - l).norm(), 1e-12 * l.norm()) << r;
  }
}

/// The work of a moment over the turn of a step is what the energy gains.
TEST(ConservingSpin, GainsTheWorkOfTheMoment) {
  Top top = top_with(full_inertia(), {0.9, 0.3, 0.8});
  for (int i = 0; i < 50; ++i) {
    const Vec3 load(std::cos(0.3 * i), 0.4, std::sin(0.7 * i));
    const Top next = step(top, conserving(0.3), load);
    const Vec3 turn =
        rotation_vector(next.motion.orientation() * top.motion.orientation().transpose());
    EXPECT_NEAR(energy(next) - energy(top), load.dot(turn), 1e-13 * energy(next)) << i;
    const Vec3 gained = momentum(next) - momentum(top);
    EXPECT_LT((gained - 0.3 * load).norm(), 1e-14 * momentum(next).norm()) << i;
    top = next;
  }
}

/// With a contact moment at the end of the step and half its way, it does its work over the turn.
TEST(ConservingSpin, GainsTheWorkOfAContactMoment) {
  const RotationScheme s = trapezoidal(0.3);
  Top top = top_with(full_inertia(), {0.9, 0.3, 0.8});
  for (int i = 0; i < 20; ++i) {
    const Vec3 contact(0.2 * std::cos(0.3 * i), 0.4, std::sin(0.7 * i));
    // 2 beta inertia = contact: without other moments
    Top next = step(top, s, 2 * contact);
    const Vec3 turn =
        rotation_vector(next.motion.orientation() * top.motion.orientation().transpose());
    next.rates = with_contact(next.rates, top.inertia, s, next.motion, contact, 0.5);
    EXPECT_LT(next.rates.moment.norm(), 1e-13);
    EXPECT_NEAR(energy(next) - energy(top), contact.dot(turn), 1e-13 * energy(next)) << i;
    EXPECT_LT((momentum(next) - momentum(top) - 0.3 * contact).norm(), 1e-13);
    top = next;
  }
}

/// Against Jacobi's elliptic functions.
TEST(FreeTop, AngularVelocityIsOfSecondOrder) {
  const EulerTop exact = euler_top({1, 2, 3}, 0.5, 1.1);
  const double end = 0.7 * exact.period();
  for (const double r : {1.0, 0.7, 0.0}) {
    const auto error = [&](int count) {
      Top top = top_with(three_moments(), exact.at(0));
      const double h = end / count;
      for (int i = 0; i < count; ++i) top = step(top, r == 1.0 ? conserving(h) : dissipative(h, r));
      return (top.rates.velocity - exact.at(end)).norm();
    };
    const double coarse = error(400), fine = error(800);
    EXPECT_NEAR(slope(coarse, fine), 2, 0.05) << r << " " << coarse << " " << fine;
    EXPECT_LT(fine, 1e-3);
  }
}

/// Orientation: dR/dt = R [w(t)] with the exact w, by Magnus' fourth-order formula.
Mat<3, 3> exact_orientation(const EulerTop& exact, double end) {
  constexpr int count = 4000;
  const double h = end / count, offset = std::sqrt(3.0) / 6;
  Mat<3, 3> r = Mat<3, 3>::Identity();
  for (int i = 0; i < count; ++i) {
    const Vec3 a = exact.at((i + 0.5 - offset) * h), b = exact.at((i + 0.5 + offset) * h);
    r = r * rotation_matrix(0.5 * h * (a + b) + std::sqrt(3.0) / 12 * h * h * a.cross(b));
  }
  return r;
}

TEST(FreeTop, OrientationIsOfSecondOrder) {
  const EulerTop exact = euler_top({1, 2, 3}, 0.5, 1.1);
  const double end = 0.7 * exact.period();
  const Mat<3, 3> target = exact_orientation(exact, end);
  // the momentum in space is constant along the exact solution
  const Vec3 l0 = three_moments() * exact.at(0), l1 = target * three_moments() * exact.at(end);
  ASSERT_LT((l1 - l0).norm(), 1e-11);
  for (const double r : {1.0, 0.7, 0.0}) {
    const auto error = [&](int count) {
      Top top = top_with(three_moments(), exact.at(0));
      const double h = end / count;
      for (int i = 0; i < count; ++i) top = step(top, r == 1.0 ? conserving(h) : dissipative(h, r));
      return rotation_vector(top.motion.orientation() * target.transpose()).norm();
    };
    const double coarse = error(400), fine = error(800);
    EXPECT_NEAR(slope(coarse, fine), 2, 0.05) << r << " " << coarse << " " << fine;
  }
}

/// A body spun about its middle axis turns over at the times of the elliptic functions.
TEST(FreeTop, FlipsAboutItsMiddleAxisInTime) {
  // w_1, w_3 at the moment when w_2 is zero; between the flips it spins about axis 2 nearly
  const EulerTop exact = euler_top({1, 2, 3}, 1.0, 0.58);
  ASSERT_GT(exact.modulus, 0.99);
  const auto flip = [&](int count) {  // time of the fourth change of sign of w_2 after the start
    const double h = 2.2 * exact.period() / count;
    Top top = top_with(three_moments(), exact.at(0));
    int changes = 0;
    double before = -1;
    for (int i = 0; i < count; ++i) {
      const Top next = step(top, conserving(h));
      const double a = top.rates.velocity[1], b = next.rates.velocity[1];
      if (i > 0 && a * b < 0 && ++changes == 4) {
        // quadratic in time by the rates at both ends: exact to third order
        const double da = top.rates.acceleration[1];
        const double c = (b - a) / (h * h) - da / h;
        before =
            i * h +
            (c == 0 ? -a / da : 2 * a / (-da - std::copysign(std::sqrt(da * da - 4 * a * c), da)));
      }
      top = next;
    }
    return before;
  };
  const double coarse = std::abs(flip(1500) - 2 * exact.period());
  const double fine = std::abs(flip(3000) - 2 * exact.period());
  EXPECT_LT(fine, 2e-3 * exact.period());
  EXPECT_NEAR(slope(coarse, fine), 2, 0.1) << coarse << " " << fine;
}

}  // namespace
}  // namespace osculate::body
