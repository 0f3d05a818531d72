// Forces alone, beside test_derivatives.cpp: there they are those that the tangents belong to.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "osculate/cell/shape.hpp"
#include "osculate/material/pointwise.hpp"
#include "osculate/solid/element.hpp"
#include "osculate/solid/finite_forces.hpp"

namespace osculate::solid {
namespace {

const material::NeoHooke rubber{100, 0.45, 0};
const material::StVenantKirchhoff steel{100, 0.3, 0};

/// A cell that is turned inside out is told of in both ways.
TEST(FiniteForces, SayWhereACellIsInverted) {
  Section<2> section;
  section.kinematics = Kinematics::finite;
  section.law = rubber;
  Coordinates<2> x(4, 2), u(4, 2);
  for (int i = 0; i < 4; ++i) x.row(i) = cell::area_node(cell::CellType::quad4, i);
  u.setZero();
  u.row(0) << 3, 3;
  for (const bool with_tangent : {false, true}) {
    ElementResult<2> out;
    evaluate(section, cell::CellType::quad4, x, u, with_tangent, out);
    EXPECT_EQ(out.status, Status::inverted);
  }
}

TEST(FiniteForces, StressesAreThoseOfTheResponse) {
  std::mt19937 generator{5};
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  for (const material::Law& law : {material::Law(rubber), material::Law(steel)}) {
    material::Strain plane;
    material::Strain3 space;
    for (double& e : plane) e = uniform(generator);
    for (double& e : space) e = uniform(generator);
    EXPECT_EQ(material::stress(law, plane).stress, material::response(law, plane).stress);
    EXPECT_EQ(material::stress(law, space).stress, material::response(law, space).stress);
  }
  EXPECT_FALSE(material::stress(rubber, material::Strain(-0.6, 0, 0, 0)).ok);
  material::Strain3 crushed = material::Strain3::Zero();
  crushed[1] = -0.6;
  EXPECT_FALSE(material::stress(rubber, crushed).ok);
}

/// Strains at all points of a cell, and their stresses together beside those one by one.
template <int N, int Q>
void expect_stresses_of_the_points(const material::Law& law, double size) {
  std::mt19937 generator{7};
  std::uniform_real_distribution<double> uniform(-size, size);
  material::Pointwise<N, Q> strain, stress;
  for (auto& component : strain)
    for (double& e : component) e = uniform(generator);
  ASSERT_TRUE((material::stresses<N, Q>(law, strain, {}, stress)));
  for (Eigen::Index q = 0; q < Q; ++q) {
    Vec<N> e, s;
    for (std::size_t i = 0; i < N; ++i) {
      e[static_cast<Eigen::Index>(i)] = strain[i][q];
      s[static_cast<Eigen::Index>(i)] = stress[i][q];
    }
    const Vec<N> expected = material::stress(law, e).stress;
    EXPECT_LT((s - expected).norm(), 1e-13 * expected.norm()) << size;
  }
  strain[1][Q - 1] = -0.6;  // crushed at the last point
  EXPECT_EQ((material::stresses<N, Q>(law, strain, {}, stress)), !material::large_strain(law));
}

TEST(FiniteForces, StressesOfAllPointsAreThoseOfEach) {
  for (const material::Law& law : {material::Law(rubber), material::Law(steel)})
    for (const double size : {0.1, 1e-4, 1e-10, 1e-16}) {
      expect_stresses_of_the_points<4, 4>(law, size);
      expect_stresses_of_the_points<6, 8>(law, size);
      expect_stresses_of_the_points<6, 1>(law, size);
    }
}

/// One volume ratio of points that differ by more than the steps to the cube root allow.
TEST(FiniteForces, ThePointsOfACellHaveOneVolumeRatio) {
  for (const double size : {1e-12, 0.1, 0.9}) {
    Lanes<4> volume, growth;
    volume << 1, 2, 1.5, 0.5;
    growth << 0, size, -0.5 * size, 0.3 * size;
    const Lanes<4> ratio = 1 + growth;
    Pointwise<4, 4> strain;  // of equal stretches along the axes
    for (std::size_t i = 0; i < 3; ++i) strain[i] = 0.5 * (ratio.pow(2.0 / 3) - 1);
    strain[3].setZero();
    const OneRatio<2, 4> one(volume, growth, strain);
    const double theta = (volume * ratio).sum() / volume.sum();
    for (const double e : strain[1]) EXPECT_NEAR(1 + 2 * e, std::cbrt(theta * theta), 1e-14);
    EXPECT_NEAR(one.share.sum(), 1, 1e-15);
  }
}

}  // namespace
}  // namespace osculate::solid
