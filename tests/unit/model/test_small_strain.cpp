// Sections with small strains that have left what these are for.
#include "osculate/model/small_strain.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "block.hpp"

namespace osculate::model {
namespace {

template <int Dim>
Mat<Dim, Dim> turned_by(double angle) {
  if constexpr (Dim == 2)
    return Eigen::Rotation2Dd(angle).toRotationMatrix();
  else
    return Eigen::AngleAxisd(angle, Vec3(1, 2, -2) / 3).toRotationMatrix();
}

/// Every node of the block moved by F.
template <int Dim>
SmallStrain measured(const Mat<Dim, Dim>& f, const solid::Section<Dim>& section) {
  const auto m = block<Dim>({}, section);
  BasicState<Dim> state;
  Eigen::VectorXd& u = state.u;
  u.resize(Dim * static_cast<Eigen::Index>(m.reference.size()));
  for (std::size_t n = 0; n < m.reference.size(); ++n)
    u.template segment<Dim>(Dim * static_cast<Eigen::Index>(n)) =
        f * m.reference[n] - m.reference[n] + Vec<Dim>::Constant(100);
  std::vector<SmallStrain> found;
  measure_small_strain<Dim>(m, state, found);
  return found.empty() ? SmallStrain{"none"} : found.front();
}

template <int Dim>
void expect_rotations_and_stretches() {
  const auto elastic_section = elastic<Dim>(100);
  for (const double angle : {0.0, 0.01, 0.17, 0.18, 1.5, 3.0}) {
    const SmallStrain found = measured<Dim>(turned_by<Dim>(angle), elastic_section);
    EXPECT_NEAR(found.rotation, angle, angle > 0.05 ? 1e-7 : 1e-5) << angle;
    EXPECT_LT(found.strain, 1e-12) << angle;
    EXPECT_EQ(found.large(), angle > 0.175) << angle;
    EXPECT_EQ(left_small_strain(found).empty(), !found.large());
  }
  Mat<Dim, Dim> stretch = Mat<Dim, Dim>::Identity();
  stretch(0, 0) = 1.2;
  const SmallStrain found = measured<Dim>(turned_by<Dim>(0.1) * stretch, elastic_section);
  EXPECT_NEAR(found.strain, 0.22, 1e-12);  // (1.2^2 - 1) / 2
  EXPECT_NEAR(found.rotation, 0.1, 1e-7);
  EXPECT_NE(left_small_strain(found).find("strains up to 22 % and rotations up to 5.7 degrees"),
            std::string::npos)
      << left_small_strain(found);
}

TEST(SmallStrain, KnowsRotationsAndStretchesInThePlane) { expect_rotations_and_stretches<2>(); }
TEST(SmallStrain, KnowsRotationsAndStretchesInSpace) { expect_rotations_and_stretches<3>(); }

/// Displacements of cells that are bent, and moved as a whole.
template <int Dim>
BasicState<Dim> bent(const BasicModel<Dim>& m, double by, double along) {
  BasicState<Dim> state;
  state.u.resize(Dim * static_cast<Eigen::Index>(m.reference.size()));
  for (std::size_t n = 0; n < m.reference.size(); ++n) {
    Vec<Dim> u = Vec<Dim>::Constant(along);
    for (int i = 0; i < Dim; ++i) {
      u[i] += by * m.reference[n][(i + 1) % Dim] * m.reference[n][0];
      u[i] += 0.3 * by * ((n + static_cast<std::size_t>(i)) % 2 == 0 ? 1 : -1);
    }
    state.u.template segment<Dim>(Dim * static_cast<Eigen::Index>(n)) = u;
  }
  return state;
}

/// In states for which it holds nothing is large.
template <int Dim>
void expect_a_bound() {
  const auto m = block<Dim>({}, elastic<Dim>(100));
  std::vector<SmallStrain> found;
  std::vector<SmallStrainBound<Dim>> bounds, then;
  measure_small_strain<Dim>(m, bent<Dim>(m, 0.01, 0), found, &bounds);
  ASSERT_EQ(bounds.size(), 1U);
  EXPECT_GT(bounds[0].gradient, 0);
  EXPECT_TRUE(bounds[0].holds(bent<Dim>(m, 0.01, 5).u)) << "moved as a whole";
  int held = 0, large = 0;
  for (double by = -0.3; by < 0.3; by += 0.001) {
    const BasicState<Dim> state = bent<Dim>(m, by, 2);
    std::vector<SmallStrain> now;
    measure_small_strain<Dim>(m, state, now, &then);
    large += now[0].large() ? 1 : 0;
    if (!bounds[0].holds(state.u)) continue;
    ++held;
    EXPECT_LE(then[0].gradient, 0.09) << by;
    EXPECT_FALSE(now[0].large()) << by;
  }
  EXPECT_GT(held, 5);
  EXPECT_GT(large, 5);
}

/// Corners that move away from each other: a cell's gradient comes near the bound, as its nodes are
/// all as far from its middle, in the plane and in space.
template <int Dim>
void expect_a_sharp_bound() {
  const auto m = block<Dim>({}, elastic<Dim>(100));
  BasicState<Dim> state;
  state.u.setZero(Dim * static_cast<Eigen::Index>(m.reference.size()));
  std::vector<SmallStrain> found;
  std::vector<SmallStrainBound<Dim>> at_rest, then;
  measure_small_strain<Dim>(m, state, found, &at_rest);
  EXPECT_EQ(at_rest[0].gradient, 0);
  EXPECT_TRUE(at_rest[0].holds(state.u));
  double last = 0;
  for (double by = 0; at_rest[0].holds(state.u); by += 1e-4) {
    ASSERT_LT(by, 1);
    measure_small_strain<Dim>(m, state, found, &then);
    last = then[0].gradient;
    for (std::size_t n = 0; n < m.reference.size(); ++n)
      for (int i = 0; i < Dim; ++i)
        state.u[Dim * static_cast<Eigen::Index>(n) + i] =
            (m.reference[n][i] > m.reference[0][i] + 1e-6 ? by : -by);
  }
  EXPECT_LE(last, 0.09);
  EXPECT_GT(last, 0.045);
}

TEST(SmallStrain, BoundIsNotFarFromWhatThereCanBe) {
  expect_a_sharp_bound<2>();
  expect_a_sharp_bound<3>();
}

TEST(SmallStrain, IsBoundedByHowFarNodesHaveMoved) {
  expect_a_bound<2>();
  expect_a_bound<3>();
}

/// The same is found whichever states are measured, and few of those that are small.
TEST(SmallStrain, IsWatchedWhereItCanBeLarge) {
  const auto m = block<2>({}, elastic<2>(100));
  SmallStrainWatch<2> watch, every;
  std::vector<SmallStrain> found, of_every, last;
  int states = 0;
  for (double by = 0; by < 0.4; by += 0.0004, ++states) {
    watch.take(m, 0, bent<2>(m, by, 3 * by), found);
    every.take(m, states, bent<2>(m, by, 3 * by), of_every);  // as if each were a step
    if (by > 0.03) continue;
    EXPECT_LT(watch.measured(), 8) << by;
    EXPECT_EQ(found[0].strain, 0.0);
  }
  EXPECT_EQ(every.measured(), states);
  EXPECT_TRUE(found[0].large());
  EXPECT_EQ(found[0].strain, of_every[0].strain);
  EXPECT_EQ(found[0].rotation, of_every[0].rotation);
  measure_small_strain<2>(m, bent<2>(m, 0.3999, 1), last);
  EXPECT_NEAR(found[0].strain, last[0].strain, 1e-3);
  SmallStrainWatch<2> later;  // as of a run that goes on
  std::vector<SmallStrain> resumed = found;
  later.take(m, 0, bent<2>(m, 0.01, 0), resumed);
  EXPECT_EQ(resumed[0].strain, found[0].strain);
}

TEST(SmallStrain, FiniteKinematicsHaveNoLimit) {
  auto section = elastic<2>(100);
  section.kinematics = solid::Kinematics::finite;
  EXPECT_EQ(measured<2>(turned_by<2>(1.5), section).section, "none");
}

}  // namespace
}  // namespace osculate::model
