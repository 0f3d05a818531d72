#include "osculate/solid/solid_shell.hpp"
#include "volume_cases.hpp"

namespace osculate::solid::testing {
namespace {

// Where the strain is the one of the displacements, so is the stress.
TEST(SolidShellStress, OfALinearDisplacementIsThatOfTheDisplacementCell) {
  Mat<3, 3> h;
  h << 0.03, -0.02, 0.01, 0.05, 0.01, -0.03, 0.02, -0.01, 0.025;
  for_each_shell([&](const VolumeCase& c) {
    VolumeCase plain = c;
    plain.section.formulation = Formulation::full;
    const Coordinates<3> x = sample_shell(c.type, 0.2, 0), u = x * h.transpose();
    const CellStress<3> at = stress_at_points(c.section, c.type, x, u);
    const CellStress<3> exact = stress_at_points(plain.section, c.type, x, u);
    const NodalStress<3> nodal = nodal_stress(c.section, c.type, x, u);
    ASSERT_EQ(at.count, exact.count);
    EXPECT_EQ(at.status, Status::ok);
    for (std::size_t q = 0; q < static_cast<std::size_t>(at.count); ++q) {
      const PointStress<3>&a = at.point[q], &b = exact.point[q];
      EXPECT_EQ(a.xi, b.xi);
      EXPECT_EQ(a.position, b.position);
      EXPECT_NEAR(a.volume, b.volume, 1e-16);
      EXPECT_LT((a.strain - b.strain).norm(), 1e-15);
      EXPECT_LT((a.stress - b.stress).norm(), 1e-14);
    }
    ASSERT_EQ(nodal.count, x.rows());
    for (std::size_t k = 0; k < static_cast<std::size_t>(nodal.count); ++k) {
      EXPECT_LT((nodal.strain[k] - exact.point[0].strain).norm(), 4e-15);
      EXPECT_LT((nodal.stress[k] - exact.point[0].stress).norm(), 4e-14);
    }
  });
}

TEST(SolidShellStress, TurnsWithTheBody) {
  const Mat<3, 3> q = turn3(1.9);
  for_each_shell([&](const VolumeCase& c) {
    if (!c.finite()) return;
    const Coordinates<3> x = sample_shell(c.type, 0.2, 0.06), u = sample_motion(c.type, 0.02);
    const Coordinates<3> turned = (x + u) * q.transpose() - x;
    const CellStress<3> a = stress_at_points(c.section, c.type, x, u);
    const CellStress<3> b = stress_at_points(c.section, c.type, x, turned);
    for (std::size_t i = 0; i < static_cast<std::size_t>(a.count); ++i) {
      const Mat<3, 3> stress = tensor(a.point[i].stress);
      EXPECT_LT((tensor(b.point[i].stress) - q * stress * q.transpose()).norm(),
                1e-13 * stress.norm());
    }
  });
}

// Pure bending with nu = 0.3 in a turned plate: linear through the thickness, no stress across it,
// at the quadrature points and at the nodes.
TEST(SolidShellStress, OfPureBendingIsLinearThroughTheThicknessAndPlane) {
  for_each_shell([](const VolumeCase& c) {
    if (c.finite()) return;
    const Mat<3, 3> q = turn3(0.8);
    const Coordinates<3> x = sample_shell(c.type, 0.1, 0);
    Coordinates<3> u(x.rows(), 3);
    for (Eigen::Index k = 0; k < x.rows(); ++k)
      u.row(k) << -x(k, 2) * x(k, 0), 0, 0.5 * x(k, 0) * x(k, 0);
    const Coordinates<3> turned = x * q.transpose(), moved = u * q.transpose();
    const auto expect_bending = [&](const Vec<6>& stress, double z) {
      const double across = 7 / (1 - 0.09) * -z;
      const Mat<3, 3> local = q.transpose() * tensor(stress) * q;
      const Mat<3, 3> exact = Vec3(across, 0.3 * across, 0).asDiagonal();
      EXPECT_LT((local - exact).norm(), 1e-13) << z;
    };
    const CellStress<3> at = stress_at_points(c.section, c.type, turned, moved);
    for (std::size_t i = 0; i < static_cast<std::size_t>(at.count); ++i)
      expect_bending(at.point[i].stress, 0.05 * at.point[i].xi.z());
    const NodalStress<3> nodal = nodal_stress(c.section, c.type, turned, moved);
    for (Eigen::Index k = 0; k < x.rows(); ++k)
      expect_bending(nodal.stress[static_cast<std::size_t>(k)], x(k, 2));
  });
}

TEST(SolidShellStress, TellsOfMirroredCells) {
  for_each_shell([](const VolumeCase& c) {
    Coordinates<3> x = sample_shell(c.type, 0.2, 0);
    x.col(2) *= -1;
    const Coordinates<3> none = Coordinates<3>::Zero(x.rows(), 3);
    const CellStress<3> at = stress_at_points(c.section, c.type, x, none);
    EXPECT_EQ(at.status, Status::inverted);
    EXPECT_EQ(at.point[0].stress.norm(), 0.0);
  });
}

}  // namespace
}  // namespace osculate::solid::testing
