// Penalties that the program has chosen follow the pressure.
#include "contact_tools.hpp"
#include "osculate/model/penetration.hpp"

namespace osculate::model {
namespace {

TEST(WantedStiffening, IsTwiceWhatIsMissingWithinLimits) {
  EXPECT_EQ(wanted_stiffening(0, 1), 1);
  EXPECT_EQ(wanted_stiffening(penetration_target, 1), 1);
  EXPECT_DOUBLE_EQ(wanted_stiffening(2 * penetration_target, 1), 4);
  EXPECT_EQ(wanted_stiffening(1, 1), 10);
  EXPECT_EQ(wanted_stiffening(1, 500), 2);
  EXPECT_EQ(wanted_stiffening(1, 1000), 1);
}

template <class Dimension>
class PenetrationOf : public ::testing::Test {};
TYPED_TEST_SUITE(PenetrationOf, Dimensions, DimensionNames);

/// A block of rubber that is pressed by a tool, whose penalty is the stiffness of a cell.
template <int Dim>
BasicModel<Dim> pressed(const Tool<Dim>& tool, bool automatic) {
  PairChoices choices;
  choices.eps_n = 100;
  BasicModel<Dim> m = block_under(tool, rubber<Dim>(100), choices);
  m.pairs[0].automatic = automatic;
  m.pairs[0].height = 0.5;
  drive_body(m, either<Dim>({0, -0.2, 0}, {0, 0, -0.2, 0, 0, 0}));
  return m;
}

TYPED_TEST(PenetrationOf, MeetsItsTargetWhereThePenaltyIsTheProgrammes) {
  constexpr int Dim = TypeParam::value;
  for (const Tool<Dim>& tool : tools<Dim>()) {
    SCOPED_TRACE(tool.name);
    for (const bool automatic : {true, false}) {
      const BasicModel<Dim> m = pressed(tool, automatic);
      double largest = 0, stiffening = 1;
      (void)run_to_end(m, [&](const Converged<Dim>& c) {
        const auto& contact = c.system.contact()[0];
        largest = std::max(largest, mean_share(m.pairs[0], contact));
        EXPECT_GE(contact.stiffening, stiffening);
        stiffening = contact.stiffening;
      });
      if (automatic) {
        EXPECT_LE(largest, penetration_target);
        EXPECT_GT(stiffening, 2);
      } else {
        EXPECT_GT(largest, 2 * penetration_target);
        EXPECT_EQ(stiffening, 1);
      }
    }
  }
}

}  // namespace
}  // namespace osculate::model
