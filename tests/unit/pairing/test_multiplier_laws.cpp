// Every law of contact around multipliers, unknown or corrected, in every branch; and that a point
// that slides is not taken for one that sticks, however soft the penalty is.
#include <gtest/gtest.h>

#include "expect_derivative.hpp"
#include "law_sample.hpp"
#include "mortar_sample.hpp"
#include "multiplier_sample.hpp"
#include "segment_sample.hpp"

namespace osculate::testing {
namespace {

using pairing::Enforcement;

constexpr double duration = 0.5;

class MultiplierLaw : public ::testing::TestWithParam<std::size_t> {
 protected:
  [[nodiscard]] const Law& law() const { return laws()[GetParam()]; }
  void SetUp() override {
    if (!contact::augmentable(law().normal)) GTEST_SKIP() << "a law that is met by itself";
  }
};

/// The tractions N = lambda + eps_N gap are those that the law's state asks for.
template <int Dim>
MultiplierSample<Dim> with_multipliers(const Law& law, ContactSample<Dim> s) {
  set_law(law, s);
  MultiplierSample<Dim> m = unknown_tractions<Dim>(s, -40, law.carried);
  m.duration = duration;
  return m;
}

/// Unknown tractions: derivative by positions and multipliers. Corrected ones: by positions.
template <int Dim>
void expect_second_order(const Law& law, const ContactSample<Dim>& sample,
                         const pairing::Enforcement& enforcement, double h) {
  SCOPED_TRACE(law.name);
  MultiplierSample<Dim> m = with_multipliers(law, sample);
  m.pair.enforcement = enforcement;
  const Eigen::VectorXd whole = m.packed();
  const Eigen::Index size =
      pairing::is<pairing::ByMultipliers>(enforcement) ? m.size() : Dim * m.nodes();
  const auto filled = [&](const Eigen::VectorXd& y) {
    Eigen::VectorXd v = whole;
    v.head(size) = y;
    return v;
  };
  const auto branch = [&](const Eigen::VectorXd& y) {
    return branches<Dim>(m.pair, law, m.evaluation(filled(y), false), duration);
  };
  const Eigen::VectorXd v = whole.head(size);
  ASSERT_EQ(branch(v).front(), static_cast<int>(law.status));
  expect_derivative(
      [&](const Eigen::VectorXd& y) { return Eigen::VectorXd(m.residual(filled(y)).head(size)); },
      m.tangent(whole).topLeftCorner(size, size), branch, v, h, 2);
}

const std::array<Enforcement, 2> both{pairing::ByMultipliers{}, pairing::ByAugmentedLagrange{}};

TEST_P(MultiplierLaw, AtANode) {
  for (const Enforcement& enforcement : both)
    for (const double bend : {0.0, 0.02}) {
      PairSample s =
          make_sample({.nodes_per_facet = bend > 0 ? 3 : 2, .bend = bend, .depth = law().depth});
      s.pair.weight = pairing::Weight::current_area;
      expect_second_order(law(), s, enforcement, 1e-3);
    }
}

TEST_P(MultiplierLaw, AtANodeInSpace) {
  for (const Enforcement& enforcement : both) {
    PairSample3 s = make_sample3({.bend = 0.03, .depth = law().depth});
    s.pair.weight = pairing::Weight::current_area;
    expect_second_order(law(), s, enforcement, 1e-3);
  }
}

TEST_P(MultiplierLaw, AtGaussPoints) {
  const pairing::Sampling gauss{pairing::Sampling::Rule::gauss, 2, 1};
  const Enforcement corrected = pairing::ByAugmentedLagrange{};
  expect_second_order(law(),
                      segment_sample({.bend = 0.02, .depth = law().depth, .sampling = gauss}),
                      corrected, 5e-4);
  expect_second_order(law(),
                      segment_sample3({.bend = 0.01, .depth = law().depth, .sampling = gauss}),
                      corrected, 2e-4);
}

TEST_P(MultiplierLaw, OfMortar) {
  for (const Enforcement& enforcement : both) {
    expect_second_order(law(), make_mortar2({.depth = law().depth, .bend = 0.01, .uneven = 0.2}),
                        enforcement, 1e-4);
    expect_second_order(law(), make_mortar3({.depth = law().depth}), enforcement, 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(All, MultiplierLaw, ::testing::Range(std::size_t{0}, laws().size()));

/// A point that slid by s under falling friction and has the multiplier t = L(s) of that meets its
/// constraint, with penalties from far too soft to be the trial of a sliding point to stiff ones.
TEST(MultiplierOfFallingFriction, SlidesHoweverSoftThePenalty) {
  constexpr double lambda = -50, way = 0.03, scale = 0.02;
  for (const auto by : {ChangeBy::distance, ChangeBy::speed})
    for (const double penalty : {1e-3, 1.0, 80.0, 1e5}) {
      PairSample s = make_sample({.angle = 0, .depth = 0});
      s.pair.weight = pairing::Weight::node;
      s.pair.friction = changing(0.5, 0.2, by, scale, penalty);
      s.committed = pairing::initial_state<2>(s.pair, s.x);
      s.committed.points[0].active = true;
      s.x[s.x.size() - 2].x() += way;
      MultiplierSample<2> m = unknown_tractions<2>(s, lambda, 0);
      m.duration = duration;
      const double a = by == ChangeBy::distance ? way : way / duration;
      m.multipliers[0].shear = Vec2((0.2 + 0.3 * std::exp(-a / scale)) * -lambda, 0);
      const pairing::PairEvaluation<2> e = m.evaluation(m.packed(), false);
      EXPECT_EQ(e.points[0].status, contact::Status::slip) << penalty;
      EXPECT_NEAR(e.blocks[0].constraint.shear.norm(), 0, 1e-10) << penalty;
      EXPECT_NEAR(e.points[0].history.slid, way, 1e-12) << penalty;
    }
}

}  // namespace
}  // namespace osculate::testing
