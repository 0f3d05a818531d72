// Stresses and strains at the points and nodes of every cell, in the plane and in space.
#include <Eigen/LU>
#include <Eigen/QR>

#include "cell_cases.hpp"

namespace osculate::solid::testing {
namespace {

class CellStresses : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Of, CellStresses, ::testing::Values(Kind::plane, Kind::space), kind_name);

// Total stress power: the forces of the cell are those of its Cauchy stresses, sigma : grad v over
// the current volume.
TEST_P(CellStresses, HaveTheNodalForcesAsTheirResultant) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (!c.full()) return;
    const Eigen::MatrixXd x = curved(c), u = motion(c);
    const Eigen::MatrixXd now = c.finite() ? Eigen::MatrixXd(x + u) : x;
    Eigen::MatrixXd force = 0 * x;
    for (const PointValues& p : point_values(c, x, u).at) {
      const ShapeValues s = shape(c, p.xi);
      const Eigen::MatrixXd j0 = x.transpose() * s.d, j1 = now.transpose() * s.d;
      const double r0 = x.col(0).dot(s.n), r1 = now.col(0).dot(s.n);
      double volume = p.volume * j1.determinant() / j0.determinant();
      if (c.axisymmetric()) volume *= r1 / r0;
      if (c.plane_stress() && c.finite()) volume *= std::sqrt(1 + 2 * p.strain[2]);
      force += volume * s.d * j1.inverse() * tensor(c, p.stress);
      if (c.axisymmetric()) force.col(0) += volume * p.stress[2] / r1 * s.n;
    }
    const Eigen::VectorXd exact = evaluated(c, x, u).force;
    EXPECT_LT((flat(force) - exact).norm(), 1e-13 * exact.norm());
  });
}

TEST(Stress, OutOfPlaneIsZeroInPlaneStressAndTheStrainInPlaneStrain) {
  for_each_section([](const SectionCase& c) {
    const Coordinates<2> x = sample_cell(c.type, 0.12, true), u = sample_displacement(c.type, 0.06);
    const CellStress<2> at = stress_at_points(c.section, c.type, x, u);
    EXPECT_EQ(at.status, Status::ok);
    for (int q = 0; q < at.count; ++q) {
      const PointStress<2>& p = at.point[static_cast<std::size_t>(q)];
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
TEST_P(CellStresses, OfALinearDisplacementAreConstant) {
  const bool plane = GetParam() == Kind::plane;
  Eigen::MatrixXd h(2, 2);
  h << 0.03, -0.02, 0.05, 0.01;
  if (!plane) {
    h.resize(3, 3);
    h << 0.03, -0.02, 0.01, 0.05, 0.01, -0.03, 0.02, -0.01, 0.025;
  }
  for_each_cell(GetParam(), [&](const CellCase& c) {
    if (c.axisymmetric()) return;
    const Eigen::MatrixXd x = straight(c), u = x * h.transpose();
    Eigen::MatrixXd strain = 0.5 * (h + h.transpose());
    if (c.finite()) strain += 0.5 * h.transpose() * h;
    const CellValues points = point_values(c, x, u), nodes = nodal_values(c, x, u);
    const Eigen::VectorXd first = points.at[0].stress;
    EXPECT_EQ(nodes.at.size(), static_cast<std::size_t>(cell::info(c.type()).nodes));
    for (const PointValues& p : points.at) {
      EXPECT_LT((tensor(c, p.strain) - strain).norm(), plane ? 1e-15 : 2e-15);
      EXPECT_LT((p.stress - first).norm(), 2e-14);
    }
    for (const PointValues& k : nodes.at) {
      EXPECT_LT((tensor(c, k.strain) - strain).norm(), plane ? 1e-15 : 4e-15);
      EXPECT_LT((k.stress - first).norm(), 1e-13);
    }
  });
}

TEST_P(CellStresses, TurnWithTheBody) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (c.axisymmetric() || !c.finite()) return;
    const Eigen::MatrixXd x = curved(c), u = motion(c), q = rotation(c, 1.9);
    const CellValues a = point_values(c, x, u);
    // About its middle: places that move far are rounded more.
    const Eigen::RowVectorXd middle = (x + u).colwise().mean();
    const Eigen::MatrixXd turned =
        (((x + u).rowwise() - middle) * q.transpose()).rowwise() + middle;
    const CellValues b = point_values(c, x, turned - x);
    const double rounding = c.kind == Kind::plane ? 2e-13 : 1e-13 * stiffness_scale(c, x);
    for (std::size_t i = 0; i < a.at.size(); ++i) {
      const Eigen::MatrixXd expected = q * tensor(c, a.at[i].stress) * q.transpose();
      EXPECT_LT((tensor(c, b.at[i].stress) - expected).norm(), rounding);
      EXPECT_LT((b.at[i].strain - a.at[i].strain).norm(), 1e-14);
    }
  });
}

// The material of a bbar cell sees a change of volume that is constant or linear in the body: that
// which is nearest to the real one. What is reported is what it sees, not the displacement's own
// dilatation, which is noise when nearly incompressible.
TEST_P(CellStresses, OfBbarHaveTheNearestChangeOfVolumeOfFewTerms) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (!c.bbar()) return;
    const Eigen::MatrixXd x = curved(c), u = motion(c);
    const auto change = [&](const PointValues& p) {
      if (!c.finite()) return p.strain.head<3>().sum();
      const Eigen::MatrixXd e = tensor(c, p.strain);
      const Eigen::MatrixXd stretch = Eigen::MatrixXd::Identity(c.dim(), c.dim()) + 2 * e;
      const double across = c.dim() == 2 ? 1 + 2 * p.strain[2] : 1.0;
      return std::sqrt(stretch.determinant() * across);
    };
    const CellValues seen = point_values(c, x, u), real = point_values(c.as_full(), x, u);
    const auto count = static_cast<Eigen::Index>(seen.at.size());
    const cell::CellInfo& info = cell::info(c.type());
    const bool linear = info.order == 2 && info.corners == 1 << c.dim();
    Eigen::MatrixXd terms(count, linear ? 1 + c.dim() : 1);
    Eigen::VectorXd of_body(count), root(count);
    for (Eigen::Index q = 0; q < count; ++q) {
      const PointValues& p = real.at[static_cast<std::size_t>(q)];
      terms(q, 0) = 1;
      if (linear) terms.row(q).tail(c.dim()) = p.position.transpose();
      of_body[q] = change(p);
      root[q] = std::sqrt(p.volume);
    }
    const Eigen::VectorXd factors =
        (root.asDiagonal() * terms).eval().colPivHouseholderQr().solve(root.asDiagonal() * of_body);
    for (Eigen::Index q = 0; q < count; ++q)
      EXPECT_NEAR(change(seen.at[static_cast<std::size_t>(q)]), terms.row(q).dot(factors),
                  linear ? 2e-14 : 2e-15);
  });
}

TEST_P(CellStresses, PointsKnowTheirPlaceAndVolume) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    const Eigen::MatrixXd x = straight(c);
    double sum = 0;
    Eigen::VectorXd moment = Eigen::VectorXd::Zero(c.dim());
    for (const PointValues& p : point_values(c, x, 0 * x).at) {
      sum += p.volume;
      moment += p.volume * p.position;
      EXPECT_EQ(p.stress.norm() + p.strain.norm(), 0.0);
    }
    const Eigen::VectorXd all = weights(c, x);
    EXPECT_NEAR(sum, all.sum(), 1e-14 * sum);
    if (c.type() == cell::CellType::wedge6 && c.reduced()) return;  // one point a triangle
    EXPECT_LT((moment - x.transpose() * all).norm(), 1e-14 * moment.norm());
  });
}

// Linear stress of pure bending is found again at the nodes of a quadratic cell.
TEST(Stress, LinearStressIsExtrapolatedExactly) {
  const Section<2> s{Assumption::plane_stress, Kinematics::small, Formulation::full, 1,
                     material::LinearElastic{7, 0.3, 0}};
  for (const cell::CellType type :
       {cell::CellType::tri6, cell::CellType::quad8, cell::CellType::quad9}) {
    const Coordinates<2> x = sample_cell(type, 0, false);
    Coordinates<2> u(x.rows(), 2);
    for (Eigen::Index k = 0; k < x.rows(); ++k)  // stress 7 k y along x, nothing else
      u.row(k) << 1e-3 * x(k, 0) * x(k, 1), -0.5e-3 * (x(k, 0) * x(k, 0) + 0.3 * x(k, 1) * x(k, 1));
    const NodalStress<2> at = nodal_stress(s, type, x, u);
    for (std::size_t k = 0; k < static_cast<std::size_t>(at.count); ++k) {
      const Vec<4> exact(7e-3 * x(static_cast<Eigen::Index>(k), 1), 0, 0, 0);
      EXPECT_LT((at.stress[k] - exact).norm(), 1e-15) << cell::info(type).name << k;
    }
  }
}

TEST(VolumeStress, LinearStressIsExtrapolatedExactly) {
  using enum cell::CellType;
  const Section<3> s{Kinematics::small, Formulation::full, material::LinearElastic{7, 0.3, 0}};
  for (const cell::CellType type : {tet10, wedge15, hex20, hex27}) {
    const Coordinates<3> x = sample_volume(type, 0, false);
    Coordinates<3> u(x.rows(), 3);
    for (Eigen::Index k = 0; k < x.rows(); ++k) {  // stress 7 k y along x, nothing else
      const double a = x(k, 0), b = x(k, 1), c = x(k, 2);
      u.row(k) << 1e-3 * a * b, -0.5e-3 * (a * a + 0.3 * (b * b - c * c)), -0.3e-3 * b * c;
    }
    const NodalStress<3> at = nodal_stress(s, type, x, u);
    for (std::size_t k = 0; k < static_cast<std::size_t>(at.count); ++k) {
      Vec<6> exact = Vec<6>::Zero();
      exact[0] = 7e-3 * x(static_cast<Eigen::Index>(k), 1);
      EXPECT_LT((at.stress[k] - exact).norm(), 4e-15) << cell::info(type).name << k;
    }
  }
}

/// Cells with as many points as corners: between the nodal values the points' own come out again.
template <int Dim, class Shape>
void expect_points_between_nodes(const Section<Dim>& s, cell::CellType type,
                                 const Coordinates<Dim>& x, const Shape& shape) {
  Coordinates<Dim> u = 0 * x;
  for (Eigen::Index k = 0; k < u.size(); ++k)
    u(k) = 1e-3 * std::sin(3.0 * static_cast<double>(k) + 1);
  const CellStress<Dim> at = stress_at_points(s, type, x, u);
  const NodalStress<Dim> nodal = nodal_stress(s, type, x, u);
  ASSERT_EQ(at.count, nodal.count);
  for (std::size_t q = 0; q < static_cast<std::size_t>(at.count); ++q) {
    Vec<components<Dim>> between = Vec<components<Dim>>::Zero();
    const auto n = shape(at.point[q].xi);
    for (std::size_t k = 0; k < static_cast<std::size_t>(nodal.count); ++k)
      between += n[k] * nodal.stress[k];
    EXPECT_LT((between - at.point[q].stress).norm(), 1e-14 * at.point[q].stress.norm()) << q;
  }
}

TEST(Stress, OfFourAndEightPointsGoesThroughThem) {
  const Section<2> plane{Assumption::plane_strain, Kinematics::small, Formulation::bbar, 1,
                         material::LinearElastic{7, 0.3, 0}};
  expect_points_between_nodes<2>(
      plane, cell::CellType::quad4, sample_cell(cell::CellType::quad4, 0, false),
      [](const Vec2& xi) { return cell::area_shape(cell::CellType::quad4, xi).n; });
  const Section<3> space{Kinematics::small, Formulation::bbar, material::LinearElastic{7, 0.3, 0}};
  expect_points_between_nodes<3>(
      space, cell::CellType::hex8, sample_volume(cell::CellType::hex8, 0, false),
      [](const Vec3& xi) { return cell::volume_shape(cell::CellType::hex8, xi).n; });
}

}  // namespace
}  // namespace osculate::solid::testing
