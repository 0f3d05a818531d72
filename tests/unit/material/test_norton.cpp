// Norton's creep: the implicit equation, its tangent, relaxation, and what is remembered.
#include "osculate/material/norton.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "derivative_check.hpp"
#include "osculate/material/law.hpp"
#include "von_mises.hpp"

namespace osculate::material {
namespace {

using support::mises;

using State = std::array<double, Norton::memory.size()>;

const Norton fourth{.young = 200, .poisson = 0.3, .rate = 1e-3, .exponent = 4};
const Norton viscous{.young = 200, .poisson = 0.3, .rate = 1e-3, .exponent = 1};
const Strain3 first{{0.012, -0.006, 0.004, 0.010, -0.005, 0.008}};
const Strain3 second{{-0.004, 0.009, 0.002, -0.012, 0.006, 0.003}};
const Strain3 along{{0.5, -0.3, 0.2, 0.7, -0.4, 0.6}};

Response3 step(const Law& law, const Strain3& e, double duration, State& state) {
  State next{};
  const Response3 r = response(law, e, {state.data(), next.data(), next.size(), duration});
  EXPECT_TRUE(r.ok);
  state = next;
  return r;
}

TEST(Norton, IsHookesLawWhereNoTimePasses) {
  State state{};
  const Response3 hooke = response(LinearElastic{200, 0.3, 0}, first);
  const Response3 r = step(fourth, first, 0, state);
  EXPECT_LT((r.stress - hooke.stress).norm(), 1e-15 * hooke.stress.norm());
  EXPECT_LT((r.tangent - hooke.tangent).norm(), 1e-15 * hooke.tangent.norm());
  EXPECT_EQ(state, State{});
}

// The rate at the end of the increment, whatever the increment; the volume does not creep.
TEST(Norton, CreepsAtTheRateOfItsStress) {
  for (const Norton& law : {fourth, viscous})
    for (const double duration : {1e-3, 1.0, 1e6}) {
      State state{};
      for (const Strain3& e : {first, second}) {
        const State before = state;
        const double q = mises(step(law, e, duration, state).stress);
        const double grown = state[0] - before[0];
        // q is what rounding leaves of the predictor, which is some 10
        EXPECT_NEAR(q, std::pow(grown / (duration * law.rate), 1 / law.exponent), 1e-13);
        EXPECT_NEAR(state[7] - before[7], q * grown, 1e-13 * grown);
        EXPECT_NEAR(state[1] + state[2] + state[3], 0, 1e-16);
        EXPECT_EQ(dissipated_by(law, state.data()), state[7]);
      }
    }
}

// However fast it flows: no overflow, and the stress that is left is the root.
TEST(Norton, HasAnAnswerForHugeRates) {
  Norton law = fourth;
  law.rate = 1e40;
  law.exponent = 20;
  State state{};
  const double q = mises(step(law, first, 1, state).stress);
  EXPECT_NEAR(std::pow(q / 1e-2, 20), state[0], 1e-9 * state[0]);
}

template <class StrainType>
void expect_consistent(const Law& law, const StrainType& before, const StrainType& e,
                       const StrainType& direction) {
  State from{}, next{};
  (void)response(law, before, {nullptr, from.data(), from.size(), 2.0});
  const auto at = [&](const StrainType& x) {
    return response(law, x, {from.data(), next.data(), next.size(), 0.5});
  };
  const auto here = at(e);
  EXPECT_GT(next[0], from[0]);
  const auto stress = [&](const StrainType& x) -> Eigen::VectorXd { return at(x).stress; };
  const auto r = testing::check_derivative(stress, here.tangent * direction, e, direction, 1e-4);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << r.order << " " << r.error;
  EXPECT_LT((here.tangent - here.tangent.transpose()).norm(), 1e-14 * here.tangent.norm());
}

TEST(Norton, TangentIsConsistent) {
  for (const Norton& small : {fourth, viscous})
    for (const Law& law : {Law(small), in_finite_strain(small)}) {
      expect_consistent<Strain3>(law, first, second, along);
      const auto plane = [](const Strain3& e) { return Strain(e.head<4>()); };
      expect_consistent<Strain>(law, plane(first), plane(second), plane(along));
    }
}

TEST(Norton, PlaneStressIsFreeAcross) {
  State state{}, next{};
  const Strain e{{0.01, -0.004, 0, 0.006}};
  double across = 0;
  const Memory memory{state.data(), next.data(), next.size(), 0.7};
  const Response r = plane_stress_response(fourth, e, &across, memory);
  ASSERT_TRUE(r.ok);
  Strain full = e;
  full[2] = across;
  const Response whole = response(fourth, full, memory);
  EXPECT_NEAR(whole.stress[2], 0, 1e-14 * whole.stress.norm());
  const auto stress = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return plane_stress_response(fourth, Strain(x), nullptr, memory).stress;
  };
  const Eigen::VectorXd d = Strain{{1, -0.5, 0, 0.7}};
  const auto order = testing::check_derivative(stress, r.tangent * d, Eigen::VectorXd(e), d, 1e-4);
  EXPECT_NEAR(order.order, 2, 0.1);
}

// A strain that is held: q(t) = (q_0^(1-n) + (n - 1) 3 G A t)^(1/(1-n)), of first order.
TEST(Norton, RelaxesAsItShould) {
  const double n = fourth.exponent, shear = 200 / 2.6, time = 3;
  const auto after = [&](int increments) {
    State state{};
    double q = 0;
    for (int i = 0; i < increments; ++i)
      q = mises(step(fourth, first, time / increments, state).stress);
    return q;
  };
  State none{};
  const double start = mises(step(fourth, first, 0, none).stress);
  const double exact =
      std::pow(std::pow(start, 1 - n) + (n - 1) * 3 * shear * fourth.rate * time, 1 / (1 - n));
  const double coarse = after(400) - exact, fine = after(800) - exact;
  EXPECT_NEAR(std::log2(coarse / fine), 1, 0.03);
  EXPECT_LT(std::abs(fine), 2e-3 * exact);
}

TEST(Norton, AsksForDurations) {
  EXPECT_TRUE(needs_duration(fourth));
  EXPECT_TRUE(needs_duration(in_finite_strain(fourth)));
  EXPECT_FALSE(needs_duration(J2Plasticity{200, 0.3, 0, 1}));
}

}  // namespace
}  // namespace osculate::material
