// Penalties from the stiffness of the layers behind a contact.
#include <limits>

#include "samples.hpp"

namespace osculate {
namespace {

TEST(AutomaticPenalty, LayersGiveWayOneAfterTheOther) {
  const Layer soft{.young = 100, .poisson = 0.25, .height = 0.5};
  const Layer stiff{.young = 300, .poisson = 0, .height = 1};
  const Layer rigid{};
  const auto of = [](const Layer& s, const Layer& m) {
    return automatic_penalties({&s, 1}, {&m, 1});
  };
  // E / h: 200 and 300; G / h: 40 / 0.5 = 80 and 150.
  EXPECT_DOUBLE_EQ(of(soft, stiff).normal, 10 / (1.0 / 200 + 1.0 / 300));
  EXPECT_DOUBLE_EQ(of(soft, stiff).shear, 10 / (1.0 / 80 + 1.0 / 150));
  EXPECT_DOUBLE_EQ(of(rigid, stiff).normal, 3000);
  EXPECT_DOUBLE_EQ(automatic_penalties({&soft, 1}, {}).normal, 2000);
}

TEST(AutomaticPenalty, PiecesOfASideCountByTheirAreas) {
  const std::vector<Layer> side{{.young = 100, .height = 1, .area = 3},
                                {.young = 500, .height = 1, .area = 1},
                                {.young = 0, .area = 7}};
  EXPECT_DOUBLE_EQ(automatic_penalties(side, {}).normal, 10 * 200);
  EXPECT_DOUBLE_EQ(automatic_penalties(side, {}).shear, 10 * 100);
}

TEST(AutomaticPenalty, FactorsOfPointsAreOneInTheMiddle) {
  for (const double ratio : {0.4, 1.0, 2.9}) EXPECT_EQ(penalty_factor(ratio), 1);
  EXPECT_DOUBLE_EQ(penalty_factor(30), 10);
  EXPECT_DOUBLE_EQ(penalty_factor(0.03), 0.09);
}

TEST(AutomaticPenalty, RefusesWhatCannotBe) {
  const Layer rigid{}, good{.young = 1, .height = 1};
  const auto of = [&](const Layer& layer) {
    return testing::refused([&] { (void)automatic_penalties({&layer, 1}, {&rigid, 1}); });
  };
  EXPECT_EQ(of(good), "");
  EXPECT_EQ(of(rigid), "both sides are rigid: nothing says how stiff the contact is");
  const std::string layer =
      "a layer needs young >= 0, poisson above -1 and at most 1/2, a height "
      "> 0 and an area >= 0, got ";
  EXPECT_EQ(of({.young = -1, .height = 1}), layer + "-1, 0, 1 and 1");
  EXPECT_EQ(of({.young = 1, .poisson = 0.6, .height = 1}), layer + "1, 0.6, 1 and 1");
  EXPECT_EQ(of({.young = 1, .height = 0}), layer + "1, 0, 0 and 1");
  EXPECT_EQ(of({.young = 1, .height = std::numeric_limits<double>::infinity()}),
            layer + "1, 0, inf and 1");
}

}  // namespace
}  // namespace osculate
