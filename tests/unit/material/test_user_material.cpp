// A material that is a routine of the user: what it is given, that it equals the built-in laws, and
// what happens where it is wrong.
#include "osculate/material/user_material.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "../../../examples/user_material/metal.c"
#include "derivative_check.hpp"
#include "osculate/material/energy.hpp"
#include "osculate/material/law.hpp"
#include "osculate/material/radial_return.hpp"
#include "sample_laws.hpp"

namespace osculate::material {
namespace {

using ::testing::HasSubstr;

const Strain3 first{{0.012, -0.006, 0.004, 0.010, -0.005, 0.008}};
const Strain3 second{{-0.004, 0.009, 0.002, -0.012, 0.006, 0.003}};
const Strain3 along{{0.5, -0.3, 0.2, 0.7, -0.4, 0.6}};

UserMaterial user(osculate_user_material* routine, std::vector<double> constants, int state = 0) {
  UserMaterial law;
  law.constants = std::move(constants);
  law.state = state;
  const auto wrong = law.use(routine);
  EXPECT_FALSE(wrong.has_value()) << wrong->why;
  return law;
}
UserMaterial metal() { return user(umat_, {200, 0.3, 1, 20}, 7); }
const J2Plasticity built_in{200, 0.3, 0, 1, 20, 0};

/// A point that is driven from strain to strain.
struct Driven {
  Law law;
  std::vector<double> now = std::vector<double>(memory_of(law).size());
  double duration = 0.5;

  template <class StrainType>
  auto at(const StrainType& e, std::vector<double>& next) const {
    next.resize(now.size());
    return response(law, e, {now.data(), next.data(), now.size(), duration});
  }
  template <class StrainType>
  auto commit(const StrainType& e) {
    std::vector<double> next;
    const auto r = at(e, next);
    EXPECT_TRUE(r.ok) << complaint(law);
    now = next;
    return r;
  }
};

template <class StrainType>
void expect_same(const Law& own, const Law& there, const std::vector<StrainType>& path) {
  Driven a{own}, b{there};
  for (const StrainType& e : path) {
    const auto r = a.commit(e), s = b.commit(e);
    EXPECT_LT((r.stress - s.stress).norm(), 1e-13 * s.stress.norm());
    EXPECT_LT((r.tangent - s.tangent).norm(), 1e-13 * s.tangent.norm());
  }
  EXPECT_NEAR(a.now[18], b.now[0], 1e-14);
}

TEST(UserMaterial, EqualsTheBuiltInMetal) {
  expect_same<Strain3>(metal(), built_in,
                       {first, second, Strain3(-first), Strain3(2 * along / 50)});
  const auto plane = [](const Strain3& e) { return Strain(e.head<4>()); };
  expect_same<Strain>(metal(), built_in, {plane(first), plane(second), plane(-first)});
  for (const double scale : {1.0, 5.0}) {
    Driven a{metal()}, b{built_in};
    for (const Strain3& e : {first, second}) {
      const Strain flat = scale * e.head<4>();
      double across = 0, across_there = 0;
      std::vector<double> next(a.now.size()), next_there(b.now.size());
      const Response r =
          plane_stress_response(a.law, flat, &across, {a.now.data(), next.data(), next.size(), 1});
      const Response s = plane_stress_response(
          b.law, flat, &across_there, {b.now.data(), next_there.data(), next_there.size(), 1});
      ASSERT_TRUE(r.ok && s.ok);
      EXPECT_NEAR(across, across_there, 1e-13);
      EXPECT_LT((r.stress - s.stress).norm(), 1e-11 * s.stress.norm());
      EXPECT_LT((r.tangent - s.tangent).norm(), 1e-11 * s.tangent.norm());
      a.now = next;
      b.now = next_there;
    }
  }
}

// The stress that it returns is Cauchy's, the built-in law's that of the undeformed volume: T.
TEST(UserMaterial, InFiniteStrainItsStressIsCauchysAndTurnsBack) {
  const Law own = in_finite_strain(metal()), there = in_finite_strain(built_in);
  ASSERT_TRUE(finite_strain(own));
  Driven a{own}, b{there};
  const Strain3 e = 8 * first;
  const Response3 r = a.commit(e), s = b.commit(e);
  Mat<3, 3> c = Mat<3, 3>::Identity();
  c << 1 + 2 * e[0], e[3], e[5], e[3], 1 + 2 * e[1], e[4], e[5], e[4], 1 + 2 * e[2];
  const double volume = std::sqrt(c.determinant());
  EXPECT_LT((r.stress - volume * s.stress).norm(), 1e-13 * s.stress.norm());
  EXPECT_LT((r.tangent - volume * s.tangent).norm(), 1e-12 * s.tangent.norm());
}

/// Neo-Hooke's law by the deformation gradient: sigma = (mu (b - 1) + lambda ln J) / J.
void by_gradient(double* stress, double*, double* ddsdde, double*, double*, double*, double*,
                 double*, double*, double*, double*, double*, double*, double*, double*, double*,
                 double*, double*, char*, int*, int*, int*, int*, double* props, int*, double*,
                 double*, double*, double*, double*, double* dfgrd1, int*, int*, int*, int*, int*,
                 int*, std::size_t) {
  const Lame c = lame(props[0], props[1]);
  const Eigen::Map<const Mat<3, 3>> f(dfgrd1);
  const double j = f.determinant();
  const Mat<3, 3> s = (c.mu * (f * f.transpose() - Mat<3, 3>::Identity()) +
                       c.lambda * std::log(j) * Mat<3, 3>::Identity()) /
                      j;
  const Vec<6> v{s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(0, 2), s(1, 2)};
  Eigen::Map<Vec<6>>{stress} = v;
  Eigen::Map<Mat<6, 6>>{ddsdde} = elastic_predictor(c, Vec<6>::Zero()).tangent;
}

TEST(UserMaterial, TheGradientIsTheStretch) {
  const Law own = in_finite_strain(user(by_gradient, {7, 0.3}));
  for (const Strain3& e : {first, Strain3(20 * first), Strain3(15 * second)}) {
    Driven a{own};
    const Response3 there = response(NeoHooke{7, 0.3, 0}, e);
    EXPECT_LT((a.commit(e).stress - there.stress).norm(), 1e-13 * there.stress.norm());
  }
}

template <class StrainType>
void expect_consistent(const Law& law, const StrainType& before, const StrainType& e,
                       const StrainType& direction) {
  Driven point{law};
  point.commit(before);
  std::vector<double> next;
  const auto here = point.at(e, next);
  const auto stress = [&](const StrainType& x) -> Eigen::VectorXd {
    return point.at(x, next).stress;
  };
  const auto r = testing::check_derivative(stress, here.tangent * direction, e, direction, 1e-4);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << r.order << " " << r.error;
}

// In finite strain DDSDDE is that of J sigma, as Abaqus defines it: metal.c returns that of the
// Kirchhoff stress whose formula it has, so only small strain and pure shear are consistent there.
TEST(UserMaterial, TangentIsConsistent) {
  expect_consistent<Strain3>(metal(), first, second, along);
  expect_consistent<Strain>(metal(), first.head<4>(), second.head<4>(), along.head<4>());
}

// What a routine was given, in the order of UMAT.
struct Seen {
  std::array<double, 6> strain, change, stress;
  double time, duration, temperature, warming, behind_constants;
  int increment, components, states;
  std::string name;
};
Seen seen;
void looks(double* stress, double* statev, double* ddsdde, double* sse, double*, double*, double*,
           double*, double*, double*, double* stran, double* dstran, double* time, double* dtime,
           double* temp, double* dtemp, double*, double*, char* cmname, int*, int*, int* ntens,
           int* nstatv, double* props, int* nprops, double*, double*, double* pnewdt, double*,
           double*, double*, int*, int*, int*, int*, int*, int* kinc, std::size_t length) {
  std::copy_n(stran, 6, seen.strain.begin());
  std::copy_n(dstran, 6, seen.change.begin());
  std::copy_n(stress, 6, seen.stress.begin());
  seen.time = time[1];
  seen.duration = *dtime;
  seen.temperature = *temp;
  seen.warming = *dtemp;
  seen.behind_constants = props[*nprops];
  seen.increment = *kinc;
  seen.components = *ntens;
  seen.states = *nstatv;
  seen.name = std::string(cmname, length);
  for (int i = 0; i < 6; ++i) {
    stress[i] += (i + 1) * dstran[i];
    ddsdde[7 * i] = i + 1;
  }
  if (*nstatv > 0) statev[0] += 1;
  *sse += 2;
  if (*nprops > 0 && props[0] == 1 && dstran[0] > 1) *pnewdt = 0.25;
  if (*nprops > 0 && props[0] == 2 && dstran[0] > 1) stress[3] = std::nan("");
  if (*nprops > 0 && props[0] == 3 && dstran[0] > 1) statev[*nstatv] = 0;
  if (*nprops > 0 && props[0] == 4 && dstran[0] > 1) throw std::runtime_error("no");
}

TEST(UserMaterial, IsGivenTheIncrement) {
  UserMaterial law;
  law.name = "Steel 1";
  law.state = 1;
  EXPECT_FALSE(law.use(looks));
  Driven point{law};
  point.commit(first);
  point.duration = 0.25;
  const double temperature = 120, before = 100;
  std::vector<double> next(point.now.size());
  Memory memory{point.now.data(), next.data(), next.size(), point.duration};
  memory.temperature = &temperature;
  memory.temperature_before = &before;
  ASSERT_TRUE(response(point.law, second, memory).ok);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto k = static_cast<Eigen::Index>(i < 4 ? i : 9 - i);  // 11, 22, 33, 12, 13, 23
    EXPECT_EQ(seen.strain[i], first[k]);
    EXPECT_EQ(seen.change[i], second[k] - first[k]);
    EXPECT_EQ(seen.stress[i], static_cast<double>(i + 1) * first[k]);
  }
  EXPECT_EQ(seen.time, 0.5);
  EXPECT_EQ(seen.duration, 0.25);
  EXPECT_EQ(seen.temperature, 100);
  EXPECT_EQ(seen.warming, 20);
  EXPECT_TRUE(std::isnan(seen.behind_constants));
  EXPECT_EQ(seen.increment, 2);
  EXPECT_EQ(seen.components, 6);
  EXPECT_EQ(seen.states, 1);
  EXPECT_EQ(seen.name, "STEEL 1" + std::string(73, ' '));
  EXPECT_EQ(point.now[18], 1);  // the committed state is not written
  EXPECT_EQ(next[18], 2);
  EXPECT_EQ(stored_energy(point.law, second, {next.data()}), 4);
}

// A committed state asked for its stress: no time passes, and nothing is remembered twice.
TEST(UserMaterial, AStateAgainstItselfIsWhatItWas) {
  Driven point{metal()};
  const Stress3 stress = point.commit(first).stress;
  const std::vector<double> state = point.now;
  point.duration = 0;
  EXPECT_EQ(point.commit(first).stress, stress);
  EXPECT_EQ(std::vector(point.now.begin() + 18, point.now.end()),
            std::vector(state.begin() + 18, state.end()));
  EXPECT_EQ(point.now[17], 1);
}

TEST(UserMaterial, SaysWhyItHasNoAnswer) {
  const auto why = [](double kind) {
    const UserMaterial law = user(looks, {kind}, 1);
    std::vector<double> next(19);
    EXPECT_FALSE(response(law, Strain3(200 * first), {nullptr, next.data(), next.size(), 1}).ok);
    EXPECT_EQ(next, std::vector<double>(19));  // what has no answer is not remembered
    return complaint(law);
  };
  EXPECT_EQ(why(1), "it asked for a shorter increment, PNEWDT = 0.25");
  EXPECT_THAT(why(2), HasSubstr("it returned NaN or infinity (it has 1 constants and 1 state"));
  EXPECT_EQ(why(3), "it wrote behind its 1 state variables");
  EXPECT_EQ(why(4), "it threw an exception");
  EXPECT_EQ(complaint(LinearElastic{1, 0.3, 0}), "");
}

TEST(UserMaterial, IsRefusedWhereItCannotBeUsed) {
  UserMaterial law;
  law.constants = {200};  // nu is missing
  EXPECT_THAT(law.use(umat_)->why,
              HasSubstr("umat_ has no answer for the unloaded material: it returned NaN or "
                        "infinity (it has 1 constants and 0 state variables); it was given 1 "));
  law.constants = {-200, 0.3};
  EXPECT_THAT(law.use(umat_)->why, HasSubstr("DDSDDE is not the stiffness of a solid"));
  law.library = "nowhere.so";
  EXPECT_EQ(law.open("/tmp")->why, "there is no file '/tmp/nowhere.so'");
  EXPECT_EQ(law.open("/tmp")->key, "library");
  law.library = "test_user_material.cpp";
  EXPECT_THAT(law.open(OSCULATE_SOURCE_DIR "/tests/unit/material")->why,
              HasSubstr("cannot be loaded: "));
  law.state = 1.5;
  EXPECT_EQ(core::range_problem(law), "must be a whole number");
  EXPECT_FALSE(response(UserMaterial{}, first).ok);
}

TEST(UserMaterial, RemembersItsStateByName) {
  const auto names = memory_of(user(looks, {}, 112));
  ASSERT_EQ(names.size(), 130u);
  EXPECT_EQ(names[17].name, "");
  EXPECT_EQ(names[18].name, "SDV1");
  EXPECT_EQ(names[27].name, "SDV10");
  EXPECT_EQ(names[129].name, "SDV112");
  EXPECT_TRUE(needs_duration(metal()));
  EXPECT_TRUE(takes_temperature(metal()));
  EXPECT_FALSE(takes_temperature(built_in));
}

// Of a routine that says nothing of its energy: the work, which is the energy of Hooke's law.
TEST(UserMaterial, EnergyIsTheWorkUnlessItSaysSo) {
  Driven point{user(testing::user_hooke, {200, 0.3})};
  point.commit(first);
  point.commit(second);
  const double there = stored_energy(LinearElastic{200, 0.3, 0}, second);
  EXPECT_NEAR(stored_energy(point.law, second, {point.now.data()}), there, 1e-14 * there);
  Driven yields{metal()}, same{built_in};
  for (const Strain3& e : {first, second}) {
    yields.commit(e);
    same.commit(e);
  }
  const double stored = stored_energy(same.law, second, {same.now.data()});
  EXPECT_NEAR(stored_energy(yields.law, second, {yields.now.data()}), stored, 1e-13 * stored);
  EXPECT_NEAR(dissipated_energy(yields.law, yields.now.data()),
              dissipated_energy(same.law, same.now.data()), 1e-15);
}

}  // namespace
}  // namespace osculate::material
