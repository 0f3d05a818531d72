#include "osculate/material/curves.hpp"

#include <gtest/gtest.h>

namespace osculate::material {
namespace {

const core::Table cold{{400, 0}, {600, 0.1}}, warm{{200, 0}, {300, 0.02}, {500, 0.05}};
const core::Curves both{{0, cold}, {100, warm}};

TEST(Curves, AreStraightBetweenTheirPointsAndConstantBeyond) {
  EXPECT_DOUBLE_EQ(piece_at(warm, 0).at(0.01), 250);
  EXPECT_DOUBLE_EQ(piece_at(warm, 0.02).at(0.03), 300 + 0.01 * 200 / 0.03);
  EXPECT_EQ(piece_at(warm, 0.05).at(7), 500);
  EXPECT_EQ(piece_at(warm, 0.05).slope, 0);
  EXPECT_EQ(piece_at(warm, 0.01).end, 0.02);
}

// CalculiX 2.20, at 50 degrees a bar of these numbers with 200 000 as Young's modulus and a strain
// of 0.02: 363.6364 with a plastic strain of 0.01818182.
TEST(Curves, BetweenTwoTemperaturesAreTheirMeanAtTheSameStrain) {
  const double middle = 50, quarter = 25;
  EXPECT_NEAR(piece_at(both, &middle, 0.018).at(0.01818182), 363.6364, 1e-4);
  for (const double strain : {0.0, 0.013, 0.02, 0.04, 0.05, 0.08, 0.2}) {
    const CurvePiece p = piece_at(both, &quarter, strain);
    EXPECT_NEAR(p.at(strain),
                0.75 * piece_at(cold, strain).at(strain) + 0.25 * piece_at(warm, strain).at(strain),
                1e-12);
    EXPECT_LE(p.start, strain);
    EXPECT_GT(p.end, strain);
    // to its end it is the same curve, and there another one begins
    if (p.end >= 1) continue;
    EXPECT_NEAR(p.at(p.end), piece_at(both, &quarter, p.end).at(p.end), 1e-12);
  }
}

TEST(Curves, BeyondTheTemperaturesAreTheLastOnes) {
  const double below = -10, above = 200, first = 0, last = 100;
  EXPECT_EQ(piece_at(both, &below, 0.01).at(0.01), piece_at(cold, 0.01).at(0.01));
  EXPECT_EQ(piece_at(both, &first, 0.01).at(0.01), piece_at(cold, 0.01).at(0.01));
  EXPECT_EQ(piece_at(both, &last, 0.01).at(0.01), piece_at(warm, 0.01).at(0.01));
  EXPECT_EQ(piece_at(both, &above, 0.01).at(0.01), piece_at(warm, 0.01).at(0.01));
  EXPECT_EQ(piece_at(both, nullptr, 0.01).at(0.01), piece_at(cold, 0.01).at(0.01));
}

TEST(Curves, FallAtMostAsSteeplyAsTheirSteepestPiece) {
  EXPECT_EQ(steepest_fall(both), 0);
  EXPECT_DOUBLE_EQ(steepest_fall({{0, cold}, {9, {{4, 0}, {3, 0.5}, {2, 0.75}}}}), 4);
}

}  // namespace
}  // namespace osculate::material
