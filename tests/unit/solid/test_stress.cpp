#include <Eigen/LU>

#include "section_cases.hpp"

namespace osculate::solid::testing {
namespace {

Mat<2, 2> plane_part(const Vec<4>& s) {
  Mat<2, 2> m;
  m << s[0], s[3], s[3], s[1];
  return m;
}

// Total stress power: the forces of the cell are those of its Cauchy stresses, sigma : grad v over
// the current volume.
TEST(Stress, HasTheNodalForcesAsItsResultant) {
  for_each_section([](const SectionCase& c) {
    if (c.section.formulation != Formulation::full) return;
    const Coordinates x = sample_cell(c.type, 0.12, true), u = sample_displacement(c.type, 0.06);
    const CellStress at = stress_at_points(c.section, c.type, x, u);
    const Coordinates now = c.finite() ? Coordinates(x + u) : x;
    ElementVector force = ElementVector::Zero(2 * x.rows());
    for (int q = 0; q < at.count; ++q) {
      const PointStress& p = at.point[static_cast<std::size_t>(q)];
      const cell::AreaShape s = cell::area_shape(c.type, p.xi);
      const Mat<2, 2> j0 = x.transpose() * s.d.topRows(s.count);
      const Mat<2, 2> j1 = now.transpose() * s.d.topRows(s.count);
      const Coordinates slope = s.d.topRows(s.count) * j1.inverse();
      const double r0 = x.col(0).dot(s.n.head(s.count)), r1 = now.col(0).dot(s.n.head(s.count));
      double growth = j1.determinant() / j0.determinant();
      if (c.axisymmetric()) growth *= r1 / r0;
      if (c.section.assumption == Assumption::plane_stress && c.finite())
        growth *= std::sqrt(1 + 2 * p.strain[2]);
      for (Eigen::Index k = 0; k < x.rows(); ++k) {
        const Vec2 f = plane_part(p.stress) * slope.row(k).transpose();
        force.segment<2>(2 * k) += p.volume * growth * f;
        if (c.axisymmetric()) force[2 * k] += p.volume * growth * p.stress[2] * s.n[k] / r1;
      }
    }
    const ElementVector exact = evaluated(c, x, u).force;
    EXPECT_LT((force - exact).norm(), 1e-13 * exact.norm());
  });
}

TEST(Stress, OutOfPlaneIsZeroInPlaneStressAndTheStrainInPlaneStrain) {
  for_each_section([](const SectionCase& c) {
    const Coordinates x = sample_cell(c.type, 0.12, true), u = sample_displacement(c.type, 0.06);
    const CellStress at = stress_at_points(c.section, c.type, x, u);
    EXPECT_EQ(at.status, Status::ok);
    for (int q = 0; q < at.count; ++q) {
      const PointStress& p = at.point[static_cast<std::size_t>(q)];
      if (c.section.assumption == Assumption::plane_stress) {
        EXPECT_EQ(p.stress[2], 0.0);
        EXPECT_NE(p.strain[2], 0.0);
      }
      if (c.section.assumption == Assumption::plane_strain &&
          c.section.formulation != Formulation::bbar) {
        EXPECT_EQ(p.strain[2], 0.0);
      }
    }
  });
}

// Strain of a linear displacement, in points and nodes, for every formulation.
TEST(Stress, OfALinearDisplacementIsConstant) {
  Mat<2, 2> h;
  h << 0.03, -0.02, 0.05, 0.01;
  for_each_section([&](const SectionCase& c) {
    if (c.axisymmetric()) return;
    const Coordinates x = sample_cell(c.type, 0.15, false), u = x * h.transpose();
    Mat<2, 2> strain = 0.5 * (h + h.transpose());
    if (c.finite()) strain += 0.5 * h.transpose() * h;
    const CellStress at = stress_at_points(c.section, c.type, x, u);
    const NodalStress nodal = nodal_stress(c.section, c.type, x, u);
    const Vec<4> first = at.point[0].stress;
    EXPECT_EQ(nodal.count, cell::info(c.type).nodes);
    for (int q = 0; q < at.count; ++q) {
      const PointStress& p = at.point[static_cast<std::size_t>(q)];
      EXPECT_LT((plane_part(p.strain) - strain).norm(), 1e-15);
      EXPECT_LT((p.stress - first).norm(), 2e-14);
    }
    for (int k = 0; k < nodal.count; ++k) {
      EXPECT_LT((plane_part(nodal.strain[static_cast<std::size_t>(k)]) - strain).norm(), 1e-15);
      EXPECT_LT((nodal.stress[static_cast<std::size_t>(k)] - first).norm(), 1e-13);
    }
  });
}

TEST(Stress, TurnsWithTheBody) {
  Mat<2, 2> q;
  q << std::cos(1.9), -std::sin(1.9), std::sin(1.9), std::cos(1.9);
  for_each_section([&](const SectionCase& c) {
    if (c.axisymmetric() || !c.finite()) return;
    const Coordinates x = sample_cell(c.type, 0.12, true), u = sample_displacement(c.type, 0.06);
    const Coordinates turned = (x + u) * q.transpose() - x;
    const CellStress a = stress_at_points(c.section, c.type, x, u);
    const CellStress b = stress_at_points(c.section, c.type, x, turned);
    for (std::size_t i = 0; i < static_cast<std::size_t>(a.count); ++i) {
      const Mat<2, 2> expected = q * plane_part(a.point[i].stress) * q.transpose();
      EXPECT_LT((plane_part(b.point[i].stress) - expected).norm(), 2e-13);
      EXPECT_LT((b.point[i].strain - a.point[i].strain).norm(), 1e-14);
    }
  });
}

// The material of a bbar cell sees the same change of volume everywhere; what is reported is what
// it sees, not the displacement's own dilatation, which is noise when nearly incompressible.
TEST(Stress, OfBbarHasOneChangeOfVolume) {
  for_each_section([](const SectionCase& c) {
    if (c.section.formulation != Formulation::bbar) return;
    const Coordinates x = sample_cell(c.type, 0.12, true), u = sample_displacement(c.type, 0.06);
    const CellStress at = stress_at_points(c.section, c.type, x, u);
    const auto volume = [&](const PointStress& p) {
      if (!c.finite()) return p.strain.head<3>().sum();
      const Mat<2, 2> stretch = Mat<2, 2>::Identity() + 2 * plane_part(p.strain);
      return std::sqrt(stretch.determinant() * (1 + 2 * p.strain[2]));
    };
    for (int q = 1; q < 4; ++q)
      EXPECT_NEAR(volume(at.point[static_cast<std::size_t>(q)]), volume(at.point[0]), 2e-15);
    double now = 0, before = 0;  // and it is the mean of the real one
    Section plain = c.section;
    plain.formulation = Formulation::full;
    const CellStress real = stress_at_points(plain, c.type, x, u);
    for (std::size_t q = 0; q < 4; ++q) {
      now += real.point[q].volume * volume(real.point[q]);
      before += real.point[q].volume;
    }
    EXPECT_NEAR(volume(at.point[0]), now / before, 2e-15);
  });
}

TEST(Stress, PointsKnowTheirPlaceAndVolume) {
  for_each_section([](const SectionCase& c) {
    const Coordinates x = sample_cell(c.type, 0.15, false);
    const CellStress at = stress_at_points(c.section, c.type, x, Coordinates::Zero(x.rows(), 2));
    double sum = 0;
    Vec2 moment = Vec2::Zero();
    for (int q = 0; q < at.count; ++q) {
      const PointStress& p = at.point[static_cast<std::size_t>(q)];
      sum += p.volume;
      moment += p.volume * p.position;
      EXPECT_EQ(p.stress.norm() + p.strain.norm(), 0.0);
    }
    const ElementVector weights = volume_weights(c.section, c.type, x);
    EXPECT_NEAR(sum, weights.sum(), 1e-14 * sum);
    EXPECT_LT((moment - x.transpose() * weights).norm(), 1e-14 * moment.norm());
  });
}

// Linear stress of pure bending is found again at the nodes of a quadratic cell.
TEST(Stress, LinearStressIsExtrapolatedExactly) {
  const Section s{Assumption::plane_stress, Kinematics::small, Formulation::full, 1,
                  material::LinearElastic{7, 0.3, 0}};
  for (const cell::CellType type :
       {cell::CellType::tri6, cell::CellType::quad8, cell::CellType::quad9}) {
    const Coordinates x = sample_cell(type, 0, false);
    Coordinates u(x.rows(), 2);
    for (Eigen::Index k = 0; k < x.rows(); ++k)  // stress 7 k y along x, nothing else
      u.row(k) << 1e-3 * x(k, 0) * x(k, 1), -0.5e-3 * (x(k, 0) * x(k, 0) + 0.3 * x(k, 1) * x(k, 1));
    const NodalStress at = nodal_stress(s, type, x, u);
    for (std::size_t k = 0; k < static_cast<std::size_t>(at.count); ++k) {
      const Vec<4> exact(7e-3 * x(static_cast<Eigen::Index>(k), 1), 0, 0, 0);
      EXPECT_LT((at.stress[k] - exact).norm(), 1e-15) << cell::info(type).name << k;
    }
  }
}

}  // namespace
}  // namespace osculate::solid::testing
