#include <Eigen/LU>

#include "volume_cases.hpp"

namespace osculate::solid::testing {
namespace {

// Total stress power: the forces of the cell are those of its Cauchy stresses, sigma : grad v over
// the current volume.
TEST(VolumeStress, HasTheNodalForcesAsItsResultant) {
  for_each_volume([](const VolumeCase& c) {
    if (c.section.formulation != VolumeFormulation::full) return;
    const Coordinates3 x = sample_volume(c.type, 0.08, true), u = sample_motion(c.type, 0.04);
    const CellStress3 at = stress_at_points(c.section, c.type, x, u);
    const Coordinates3 now = c.finite() ? Coordinates3(x + u) : x;
    VolumeVector force = VolumeVector::Zero(3 * x.rows());
    for (int q = 0; q < at.count; ++q) {
      const PointStress3& p = at.point[static_cast<std::size_t>(q)];
      const cell::VolumeShape s = cell::volume_shape(c.type, p.xi);
      const Mat<3, 3> j0 = x.transpose() * s.d.topRows(s.count);
      const Mat<3, 3> j1 = now.transpose() * s.d.topRows(s.count);
      const Coordinates3 slope = s.d.topRows(s.count) * j1.inverse();
      const double volume = p.volume * j1.determinant() / j0.determinant();
      for (Eigen::Index k = 0; k < x.rows(); ++k)
        force.segment<3>(3 * k) += volume * tensor(p.stress) * slope.row(k).transpose();
    }
    const VolumeVector exact = evaluated(c, x, u).force;
    EXPECT_LT((force - exact).norm(), 1e-13 * exact.norm());
  });
}

// Strain of a linear displacement, in points and nodes, for every formulation.
TEST(VolumeStress, OfALinearDisplacementIsConstant) {
  Mat<3, 3> h;
  h << 0.03, -0.02, 0.01, 0.05, 0.01, -0.03, 0.02, -0.01, 0.025;
  for_each_volume([&](const VolumeCase& c) {
    const Coordinates3 x = sample_volume(c.type, 0.1, false), u = x * h.transpose();
    Mat<3, 3> strain = 0.5 * (h + h.transpose());
    if (c.finite()) strain += 0.5 * h.transpose() * h;
    const CellStress3 at = stress_at_points(c.section, c.type, x, u);
    const NodalStress3 nodal = nodal_stress(c.section, c.type, x, u);
    const Vec<6> first = at.point[0].stress;
    EXPECT_EQ(nodal.count, cell::info(c.type).nodes);
    for (int q = 0; q < at.count; ++q) {
      const PointStress3& p = at.point[static_cast<std::size_t>(q)];
      EXPECT_LT((tensor(p.strain) - strain).norm(), 2e-15);
      EXPECT_LT((p.stress - first).norm(), 2e-14);
    }
    for (int k = 0; k < nodal.count; ++k) {
      EXPECT_LT((tensor(nodal.strain[static_cast<std::size_t>(k)]) - strain).norm(), 4e-15);
      EXPECT_LT((nodal.stress[static_cast<std::size_t>(k)] - first).norm(), 1e-13);
    }
  });
}

TEST(VolumeStress, TurnsWithTheBody) {
  const Mat<3, 3> q = turn3(1.9);
  for_each_volume([&](const VolumeCase& c) {
    if (!c.finite()) return;
    const Coordinates3 x = sample_volume(c.type, 0.08, true), u = sample_motion(c.type, 0.04);
    const Coordinates3 turned = (x + u) * q.transpose() - x;
    const CellStress3 a = stress_at_points(c.section, c.type, x, u);
    const CellStress3 b = stress_at_points(c.section, c.type, x, turned);
    for (std::size_t i = 0; i < static_cast<std::size_t>(a.count); ++i) {
      const Mat<3, 3> expected = q * tensor(a.point[i].stress) * q.transpose();
      EXPECT_LT((tensor(b.point[i].stress) - expected).norm(), 1e-13 * stiffness_scale(c, x));
      EXPECT_LT((b.point[i].strain - a.point[i].strain).norm(), 1e-14);
    }
  });
}

// The material of a bbar cell sees the same change of volume everywhere: the mean of the real one.
TEST(VolumeStress, OfBbarHasOneChangeOfVolume) {
  for_each_volume([](const VolumeCase& c) {
    if (c.section.formulation != VolumeFormulation::bbar) return;
    const Coordinates3 x = sample_volume(c.type, 0.08, true), u = sample_motion(c.type, 0.04);
    const auto volume = [&](const PointStress3& p) {
      if (!c.finite()) return p.strain.head<3>().sum();
      return std::sqrt((Mat<3, 3>::Identity() + 2 * tensor(p.strain)).determinant());
    };
    const CellStress3 at = stress_at_points(c.section, c.type, x, u);
    VolumeSection plain = c.section;
    plain.formulation = VolumeFormulation::full;
    const CellStress3 real = stress_at_points(plain, c.type, x, u);
    double now = 0, before = 0;
    for (std::size_t q = 0; q < 8; ++q) {
      EXPECT_NEAR(volume(at.point[q]), volume(at.point[0]), 2e-15);
      now += real.point[q].volume * volume(real.point[q]);
      before += real.point[q].volume;
    }
    EXPECT_NEAR(volume(at.point[0]), now / before, 2e-15);
  });
}

TEST(VolumeStress, PointsKnowTheirPlaceAndVolume) {
  for_each_volume([](const VolumeCase& c) {
    const Coordinates3 x = sample_volume(c.type, 0.1, false);
    const CellStress3 at = stress_at_points(c.section, c.type, x, Coordinates3::Zero(x.rows(), 3));
    double sum = 0;
    Vec3 moment = Vec3::Zero();
    for (int q = 0; q < at.count; ++q) {
      const PointStress3& p = at.point[static_cast<std::size_t>(q)];
      sum += p.volume;
      moment += p.volume * p.position;
      EXPECT_EQ(p.stress.norm() + p.strain.norm(), 0.0);
    }
    const VolumeVector weights = volume_weights(c.type, x);
    EXPECT_NEAR(sum, weights.sum(), 1e-14 * sum);
    EXPECT_LT((moment - x.transpose() * weights).norm(), 1e-14 * moment.norm());
  });
}

// Linear stress of pure bending is found again at the nodes of a quadratic cell.
TEST(VolumeStress, LinearStressIsExtrapolatedExactly) {
  using enum cell::CellType;
  const VolumeSection s{Kinematics::small, VolumeFormulation::full,
                        material::LinearElastic{7, 0.3, 0}};
  for (const cell::CellType type : {tet10, wedge15, hex20, hex27}) {
    const Coordinates3 x = sample_volume(type, 0, false);
    Coordinates3 u(x.rows(), 3);
    for (Eigen::Index k = 0; k < x.rows(); ++k) {  // stress 7 k y along x, nothing else
      const double a = x(k, 0), b = x(k, 1), c = x(k, 2);
      u.row(k) << 1e-3 * a * b, -0.5e-3 * (a * a + 0.3 * (b * b - c * c)), -0.3e-3 * b * c;
    }
    const NodalStress3 at = nodal_stress(s, type, x, u);
    for (std::size_t k = 0; k < static_cast<std::size_t>(at.count); ++k) {
      Vec<6> exact = Vec<6>::Zero();
      exact[0] = 7e-3 * x(static_cast<Eigen::Index>(k), 1);
      EXPECT_LT((at.stress[k] - exact).norm(), 4e-15) << cell::info(type).name << k;
    }
  }
}

}  // namespace
}  // namespace osculate::solid::testing
