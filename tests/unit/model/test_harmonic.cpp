// The frequencies of harmonic steps, and the parts of swings.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "osculate/model/harmonic.hpp"

namespace osculate::model {
namespace {

Eigen::VectorXd squares_of(std::initializer_list<double> frequencies) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(frequencies.size()));
  Eigen::Index i = 0;
  for (const double f : frequencies) out[i++] = std::pow(2 * std::numbers::pi * f, 2);
  return out;
}

/// Numbers of CalculiX 2.20 for its deck beamdy8: 12000 to 14000 with 5 points, a vibration at
/// 13096.03.
TEST(Harmonic, SweepGathersAtVibrations) {
  Harmonic range;
  range.from = 12000;
  range.to = 14000;
  range.points = 5;
  const std::vector<double> f = sweep(range, squares_of({13096.03106, 19319.52, 76839.71}));
  const std::vector<double> there{12000,    12113.0553, 12548.0155, 12982.9758, 13096.0311,
                                  13189.28, 13548.02,   13906.76,   14000};
  ASSERT_EQ(f.size(), there.size());
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f[i], there[i], i < 5 ? 1e-4 : 6e-3) << i;
}

TEST(Harmonic, SweepOfOneFrequencyAndOfEqualDistances) {
  Harmonic range;
  range.from = range.to = 7;
  EXPECT_EQ(sweep(range, squares_of({3, 7, 9})), std::vector<double>{7});
  range.to = 11;
  range.bias = 1;
  range.points = 3;
  // one at the lower end, two at one place
  const std::vector<double> f = sweep(range, squares_of({7, 9, 9}));
  const std::vector<double> there{7, 8, 9, 10, 11};
  ASSERT_EQ(f.size(), there.size());
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f[i], there[i], 1e-12);
  range.points = 2;
  EXPECT_EQ(sweep(range, squares_of({})).size(), 2U);
}

/// What is zero or below is no frequency.
TEST(Harmonic, SweepPassesOverUnstableVibrations) {
  Harmonic range;
  range.to = 4;
  range.points = 2;
  Eigen::VectorXd squares(2);
  squares << -100, 1e-30;
  EXPECT_EQ(sweep(range, squares).size(), 2U);
}

/// u(t) = Re(q exp(i w t)): rates are those of that.
TEST(Harmonic, PartsAreThoseOfASwing) {
  HarmonicMotion motion{0.3, Eigen::VectorXcd::Constant(1, {2, -5}),
                        Eigen::VectorXcd::Constant(1, {-1, 4})};
  const double w = 2 * std::numbers::pi * 0.3;
  const VibrationMotion real = part_of(motion, false), imaginary = part_of(motion, true);
  EXPECT_DOUBLE_EQ(real.place[0], 2);
  EXPECT_DOUBLE_EQ(imaginary.place[0], -5);
  EXPECT_DOUBLE_EQ(real.rate[0], 5 * w);  // i w (2 - 5 i) = 5 w + 2 i w
  EXPECT_DOUBLE_EQ(imaginary.rate[0], 2 * w);
  EXPECT_DOUBLE_EQ(imaginary.acceleration[0], 5 * w * w);
  EXPECT_DOUBLE_EQ(real.carried_rate[0], -4 * w);
  EXPECT_DOUBLE_EQ(imaginary.carried_rate[0], -w);
  EXPECT_DOUBLE_EQ(real.carried_acceleration[0], w * w);
}

}  // namespace
}  // namespace osculate::model
