// Nodal areas of surfaces in space.
#include <gtest/gtest.h>

#include "derivative_check.hpp"
#include "pair_sample3.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;

pairing::SlaveSide<3> one_facet(CellType type, std::vector<Vec3>& x, double bend) {
  std::vector<Index> nodes;
  for (int k = 0; k < cell::info(type).nodes; ++k) {
    const Vec2 p = cell::area_node(type, k);
    x.emplace_back(2 * p.x(), p.y(), bend * p.x() * p.x());
    nodes.push_back(k);
  }
  pairing::FacetSurface surface;
  surface.facets.push_back(pairing::surface_facet(type, nodes));
  pairing::connect(surface);
  return pairing::make_slave_side(surface);
}

std::vector<double> areas_of(CellType type) {
  std::vector<Vec3> x;
  const pairing::SlaveSide<3> slave = one_facet(type, x, 0.0);
  std::vector<double> areas;
  pairing::nodal_areas(slave, x, {}, areas, nullptr);
  return areas;
}

TEST(NodalAreas3, AreConsistentWhereThatIsPositive) {
  for (const double a : areas_of(CellType::quad4)) EXPECT_NEAR(a, 2.0, 1e-14);
  for (const double a : areas_of(CellType::tri3)) EXPECT_NEAR(a, 1.0 / 3, 1e-14);
  const std::vector<double> nine = areas_of(CellType::quad9);
  EXPECT_NEAR(nine[0], 8.0 / 36, 1e-14);
  EXPECT_NEAR(nine[4], 8.0 * 4 / 36, 1e-14);
  EXPECT_NEAR(nine[8], 8.0 * 16 / 36, 1e-14);
}

// int N^2 over the reference cell: tri6 1/60 and 4/45 per corner and middle, so shares 3/57 and
// 16/57; quad8 2/15 and 32/45 (corners 6/45), so shares 3/76 and 16/76.
TEST(NodalAreas3, ArePositiveForTri6AndQuad8) {
  const std::vector<double> six = areas_of(CellType::tri6);
  const std::vector<double> eight = areas_of(CellType::quad8);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(six[k], 3.0 / 57, 1e-14);
    EXPECT_NEAR(six[k + 3], 16.0 / 57, 1e-14);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(eight[k], 8 * 3.0 / 76, 1e-14);
    EXPECT_NEAR(eight[k + 4], 8 * 16.0 / 76, 1e-14);
  }
}

TEST(NodalAreas3, GradientIsTheDerivative) {
  for (const CellType type :
       {CellType::tri3, CellType::tri6, CellType::quad4, CellType::quad8, CellType::quad9}) {
    std::vector<Vec3> x;
    const pairing::SlaveSide<3> slave = one_facet(type, x, 0.2);
    Eigen::VectorXd d(3 * static_cast<Eigen::Index>(x.size()));
    for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = std::sin(2.0 + static_cast<double>(i));
    const auto areas = [&](const Eigen::VectorXd& v) {
      std::vector<double> a;
      pairing::nodal_areas(slave, unflatten3(v), {}, a, nullptr);
      return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(a.data(), d.size() / 3));
    };
    std::vector<double> a;
    std::vector<std::vector<pairing::NodeGradient<3>>> gradient;
    pairing::nodal_areas(slave, x, {}, a, &gradient);
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(d.size() / 3);
    for (std::size_t i = 0; i < gradient.size(); ++i)
      for (const pairing::NodeGradient<3>& g : gradient[i])
        expected[static_cast<Eigen::Index>(i)] += g.value.dot(d.segment<3>(3 * g.node));
    const DerivativeReport r = check_derivative(areas, expected, flatten3(x), d, 1e-3);
    EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1)
        << cell::info(type).name << " " << r.order << " " << r.error;
  }
}

}  // namespace
}  // namespace osculate::testing
