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

TEST(SmallStrain, FiniteKinematicsHaveNoLimit) {
  auto section = elastic<2>(100);
  section.kinematics = solid::Kinematics::finite;
  EXPECT_EQ(measured<2>(turned_by<2>(1.5), section).section, "none");
}

}  // namespace
}  // namespace osculate::model
