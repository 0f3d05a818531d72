#include "osculate/cell/volume_shape.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <set>

#include "derivative_check.hpp"
#include "osculate/cell/quadrature.hpp"
#include "osculate/cell/shape.hpp"

namespace osculate::cell {
namespace {

using enum CellType;
constexpr std::array<CellType, 8> volume_types{tet4, tet10, wedge6, wedge15,
                                               hex8, hex20, hex27,  shell18};
const std::array<Vec3, 4> places{Vec3(0.2, 0.3, 0.1), Vec3(-0.7, 0.45, 0.8), Vec3(0.9, -0.95, 0.3),
                                 Vec3(0, 0, 0)};

TEST(VolumeShape, CountsItsNodesAndIsEmptyForOtherCells) {
  for (const CellInfo& cell : all_cells())
    EXPECT_EQ(volume_shape(cell.type, Vec3::Zero()).count, cell.dimension == 3 ? cell.nodes : 0)
        << cell.name;
}

TEST(VolumeShape, IsOneAtItsNodeAndZeroAtTheOthers) {
  for (const CellType type : volume_types)
    for (int i = 0; i < info(type).nodes; ++i) {
      const VolumeShape s = volume_shape(type, volume_node(type, i));
      for (int k = 0; k < s.count; ++k)
        EXPECT_EQ(s.n[k], i == k ? 1.0 : 0.0) << info(type).name << " " << i << " " << k;
    }
}

TEST(VolumeShape, SumsToOneAndItsSlopesToZero) {
  for (const CellType type : volume_types)
    for (const Vec3& xi : places) {
      const VolumeShape s = volume_shape(type, xi);
      EXPECT_NEAR(s.n.sum(), 1.0, 4e-15) << info(type).name;
      EXPECT_LT(s.d.colwise().sum().norm(), 1e-14) << info(type).name;
    }
}

double monomial(const Vec3& x, int p, int q, int r) {
  return std::pow(x.x(), p) * std::pow(x.y(), q) * std::pow(x.z(), r);
}

// shell18 is linear across the thickness.
TEST(VolumeShape, ReproducesThePolynomialsOfItsOrder) {
  for (const CellType type : volume_types)
    for (int p = 0; p <= info(type).order; ++p)
      for (int q = 0; p + q <= info(type).order; ++q)
        for (int r = 0; p + q + r <= info(type).order && (r < 2 || type != shell18); ++r)
          for (const Vec3& xi : places) {
            const VolumeShape s = volume_shape(type, xi);
            double sum = 0;
            for (int k = 0; k < s.count; ++k)
              sum += s.n[k] * monomial(volume_node(type, k), p, q, r);
            EXPECT_NEAR(sum, monomial(xi, p, q, r), 4e-15) << info(type).name;
          }
}

TEST(VolumeShape, SlopesAreTheDerivatives) {
  for (const CellType type : volume_types)
    for (const Vec3& xi : places) {
      const Vec3 along(0.6, -0.8, 0.5);
      const VolumeShape s = volume_shape(type, xi);
      const auto values = [&](const Vec3& at) -> Eigen::VectorXd {
        return volume_shape(type, at).n;
      };
      const testing::DerivativeReport r = testing::check_derivative(values, s.d * along, xi, along);
      EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1)
          << info(type).name << " order " << r.order << " error " << r.error;
    }
}

/// Centre of the reference cell.
Vec3 centre(CellType type) {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < info(type).nodes; ++k) sum += volume_node(type, k);
  return sum / info(type).nodes;
}

TEST(Faces, AreWalkedSoThatTheNormalPointsOutOfTheCell) {
  for (const CellType type : volume_types) {
    const CellInfo& cell = info(type);
    EXPECT_EQ(cell.face_count, cell.corners == 8 ? 6 : cell.corners == 6 ? 5 : 4);
    for (std::size_t f = 0; f < static_cast<std::size_t>(cell.face_count); ++f) {
      const CellFace& face = cell.faces[f];
      const AreaShape s = area_shape(face.type, Vec2(0.2, 0.3));
      Vec3 x = Vec3::Zero();
      Mat<3, 2> r = Mat<3, 2>::Zero();
      for (int k = 0; k < s.count; ++k) {
        const Vec3 node = volume_node(type, face.nodes[static_cast<std::size_t>(k)]);
        x += s.n[k] * node;
        r += node * s.d.row(k);
      }
      const Vec3 normal = r.col(0).cross(r.col(1));
      EXPECT_GT(normal.normalized().dot(x - centre(type)), 0.14) << cell.name << " face " << f;
    }
  }
}

TEST(Faces, OfOtherCellsAreNone) {
  for (const CellInfo& cell : all_cells())
    if (cell.dimension < 3) {
      EXPECT_EQ(cell.face_count, 0) << cell.name;
    } else {
      EXPECT_EQ(cell.edge_count, 0) << cell.name;
    }
}

// On a face only the nodes of the face count, with the shape functions of the area cell in its
// order: neighbours meet without a gap.
TEST(Faces, HaveTheShapeOfTheAreaCell) {
  for (const CellType type : volume_types) {
    const CellInfo& cell = info(type);
    const int faces = type == shell18 ? 2 : cell.face_count;
    for (std::size_t f = 0; f < static_cast<std::size_t>(faces); ++f) {
      const CellFace& face = cell.faces[f];
      const AreaShape s = area_shape(face.type, Vec2(0.37, 0.21));
      Vec3 xi = Vec3::Zero();
      for (int k = 0; k < s.count; ++k)
        xi += s.n[k] * volume_node(type, face.nodes[static_cast<std::size_t>(k)]);
      Vec<max_volume_nodes> rest = volume_shape(type, xi).n;
      for (int k = 0; k < s.count; ++k) rest[face.nodes[static_cast<std::size_t>(k)]] -= s.n[k];
      EXPECT_LT(rest.norm(), 1e-15) << cell.name << " face " << f;
    }
  }
}

TEST(Faces, OfTheSidesOfAShellAreThoseOfItsCorners) {
  for (std::size_t f = 2; f < 6; ++f) {
    const CellFace& face = info(shell18).faces[f];
    EXPECT_EQ(face.type, quad4);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_LT(face.nodes[k] % 9, 4);
    }
  }
}

/// The corners that a node of VTK's cell lies between, from VTK's own definition of its cells.
std::vector<std::vector<int>> vtk_edges(CellType type) {
  if (type == tet10) return {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  if (type == wedge15)
    return {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
  std::vector<std::vector<int>> list{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                     {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  if (type == hex27)
    list.insert(list.end(), {{0, 3, 7, 4},
                             {1, 2, 6, 5},
                             {0, 1, 5, 4},
                             {3, 2, 6, 7},
                             {0, 1, 2, 3},
                             {4, 5, 6, 7},
                             {0, 1, 2, 3, 4, 5, 6, 7}});
  return list;
}

TEST(VtkOrder, PutsTheMiddleNodesWhereVtkExpectsThem) {
  for (const CellType type : {tet10, wedge15, hex20, hex27}) {
    const CellInfo& cell = info(type);
    const std::span<const std::int8_t> order = vtk_nodes(type);
    const auto expected = vtk_edges(type);
    const auto corners = static_cast<std::size_t>(cell.corners);
    ASSERT_EQ(order.size(), static_cast<std::size_t>(cell.nodes));
    ASSERT_EQ(order.size(), corners + expected.size());
    for (std::size_t k = 0; k < corners; ++k) EXPECT_EQ(order[k], static_cast<int>(k));
    for (std::size_t e = 0; e < expected.size(); ++e) {
      Vec3 between = Vec3::Zero();
      for (const int corner : expected[e])
        between += volume_node(type, corner) / static_cast<double>(expected[e].size());
      EXPECT_LT((volume_node(type, order[corners + e]) - between).norm(), 1e-15)
          << cell.name << " " << e;
    }
  }
}

TEST(VtkOrder, NamesEachNodeOnce) {
  for (const CellInfo& cell : all_cells()) {
    const std::span<const std::int8_t> order = vtk_nodes(cell.type);
    EXPECT_EQ(std::set<int>(order.begin(), order.end()).size(), order.size()) << cell.name;
    EXPECT_EQ(order.size(), cell.type == shell18 ? 8U : static_cast<std::size_t>(cell.nodes));
    for (const int k : order) EXPECT_TRUE(k >= 0 && k < cell.nodes);
  }
  for (std::size_t k = 0; k < 8; ++k)  // the corners of shell18 are those of hex8
    EXPECT_EQ(volume_node(shell18, vtk_nodes(shell18)[k]), volume_node(hex8, static_cast<int>(k)));
}

TEST(CellTable, IsOrderedByTypeAndFindsItsCells) {
  ASSERT_EQ(all_cells().size(), cell_type_count);
  for (std::size_t i = 0; i < cell_type_count; ++i) {
    const CellInfo& cell = all_cells()[i];
    EXPECT_EQ(static_cast<std::size_t>(cell.type), i);
    EXPECT_EQ(find_cell(cell.name), &cell);
    EXPECT_EQ(find_gmsh_cell(cell.gmsh_type), cell.gmsh_type == 0 ? nullptr : &cell);
  }
}

double integral(const Quadrature3D& rule, int p, int q, int r) {
  double sum = 0;
  for (std::size_t i = 0; i < rule.points.size(); ++i)
    sum += rule.weights[i] * monomial(rule.points[i], p, q, r);
  return sum;
}
double line_integral(int power) { return power % 2 == 1 ? 0.0 : 2.0 / (power + 1); }
double triangle_integral(int p, int q) {
  return std::tgamma(p + 1.0) * std::tgamma(q + 1.0) / std::tgamma(p + q + 3.0);
}
double tet_integral(int p, int q, int r) {
  return std::tgamma(p + 1.0) * std::tgamma(q + 1.0) * std::tgamma(r + 1.0) /
         std::tgamma(p + q + r + 4.0);
}

TEST(GaussHex, IsTheTensorRule) {
  for (const auto& [n, m] :
       {std::array{1, 1}, std::array{2, 2}, std::array{3, 3}, std::array{3, 2}}) {
    const Quadrature3D rule = n == m ? gauss_hex(n) : gauss_hex(n, m);
    ASSERT_EQ(rule.points.size(), static_cast<std::size_t>(n * n * m));
    for (int p = 0; p <= 2 * n - 1; ++p)
      for (int q = 0; q <= 2 * n - 1; ++q)
        for (int r = 0; r <= 2 * m - 1; ++r)
          EXPECT_NEAR(integral(rule, p, q, r),
                      line_integral(p) * line_integral(q) * line_integral(r), 2e-14)
              << p << q << r;
    EXPECT_GT(std::abs(integral(rule, 0, 0, 2 * m) - 4 * line_integral(2 * m)), 1e-2);
  }
}

TEST(GaussTetrahedron, IsExactToItsDegreeAndNotBeyond) {
  const std::size_t sizes[] = {1, 4, 15, 15, 15};
  for (int degree = 1; degree <= 5; ++degree) {
    const Quadrature3D rule = gauss_tetrahedron(degree);
    EXPECT_EQ(rule.points.size(), sizes[degree - 1]);
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      EXPECT_GT(rule.weights[i], 0);
      EXPECT_GT(std::min(rule.points[i].minCoeff(), 1 - rule.points[i].sum()), 0);
    }
    double beyond = 0;
    for (int p = 0; p <= degree + 1; ++p)
      for (int q = 0; p + q <= degree + 1; ++q)
        for (int r = 0; p + q + r <= degree + 1; ++r) {
          const double error = std::abs(integral(rule, p, q, r) - tet_integral(p, q, r));
          if (p + q + r <= degree)
            EXPECT_LT(error, 1e-16) << degree << p << q << r;
          else
            beyond = std::max(beyond, error);
        }
    if (degree != 3 && degree != 4) {
      EXPECT_GT(beyond, 1e-7) << degree;
    }
  }
}

TEST(GaussWedge, IsTheProductOfTriangleAndLine) {
  for (const int degree : {1, 2, 4, 5})
    for (const int n : {1, 2, 3}) {
      const Quadrature3D rule = gauss_wedge(degree, n);
      for (int p = 0; p <= degree; ++p)
        for (int q = 0; p + q <= degree; ++q)
          for (int r = 0; r <= 2 * n - 1; ++r)
            EXPECT_NEAR(integral(rule, p, q, r), triangle_integral(p, q) * line_integral(r), 1e-15)
                << degree << n << p << q << r;
    }
}

}  // namespace
}  // namespace osculate::cell
