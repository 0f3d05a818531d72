#include "osculate/model/temperatures.hpp"

#include <gtest/gtest.h>

namespace osculate::model {
namespace {

TEST(Temperatures, RampFromTheStepBeforeAndFollowAmplitudes) {
  const Temperatures t{{20, 20, 30}, {{{0, 1}, 120, {}}, {{1}, 50, {{0, 0}, {0.5, 1}, {1, 0.5}}}}};
  EXPECT_EQ(t.at(0.5), (std::vector<double>{70, 50, 30}));  // of a node in two sets the last counts
  EXPECT_EQ(t.at(1), (std::vector<double>{120, 25, 30}));
  EXPECT_TRUE(Temperatures{}.at(0.5).empty());
}

}  // namespace
}  // namespace osculate::model
