// Masses of cells: exact moments, rigid motions, lumping.
#include "osculate/solid/mass.hpp"

#include <Eigen/Eigenvalues>
#include <memory>
#include <numbers>
#include <vector>

#include "section_cases.hpp"
#include "volume_cases.hpp"

namespace osculate::solid::testing {
namespace {

/// Unit square, or its triangle x + y <= 1, with the nodes of the type.
Coordinates<2> plain_area(cell::CellType type) {
  Coordinates<2> x(cell::info(type).nodes, 2);
  const bool quad = cell::info(type).corners == 4;
  for (int k = 0; k < x.rows(); ++k) {
    const Vec2 xi = cell::area_node(type, k);
    x.row(k) = (quad ? Vec2(0.5 * (xi + Vec2(1, 1))) : xi).transpose();
  }
  return x;
}

// The moments of the square and of the triangle up to the second order.
TEST(Mass, OfAreaCellsHasTheirMoments) {
  for (const cell::CellType type : area_types) {
    Section<2> section;
    section.thickness = 2;
    const Coordinates<2> x = plain_area(type);
    const NodeMass m = consistent_mass(section, type, x);
    const bool quad = cell::info(type).corners == 4;
    const double area = quad ? 1 : 0.5, first = quad ? 0.5 : 1.0 / 6,
                 second = quad ? 1.0 / 3 : 1.0 / 12;
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(x.rows()), px = x.col(0);
    EXPECT_NEAR(one.dot(m * one), 2 * area, 1e-14);
    EXPECT_NEAR(one.dot(m * px), 2 * first, 1e-14);
    EXPECT_NEAR(px.dot(m * px), 2 * second, 1e-14);
    EXPECT_LT((m - m.transpose()).norm(), 1e-15);
    EXPECT_GT(m.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
  }
}

// A ring: x is the radius, int 2 pi x dA over the unit square is pi.
TEST(Mass, OfARingIsOfItsWholeCircumference) {
  Section<2> section;
  section.assumption = Assumption::axisymmetric;
  const NodeMass m =
      consistent_mass(section, cell::CellType::quad4, plain_area(cell::CellType::quad4));
  EXPECT_NEAR(m.sum(), std::numbers::pi, 1e-14);
}

// int 1 dV of any cell is that of its weights; linear fields are integrated as with a finer rule.
TEST(Mass, OfVolumeCellsIsThatOfTheirWeights) {
  for (const cell::CellType type : volume_types) {
    const Coordinates<3> x = sample_volume(type, 0.05, false);
    const NodeMass m = consistent_mass(Section<3>{}, type, x);
    EXPECT_NEAR(m.sum(), volume_weights(Section<3>{}, type, x).sum(),
                2e-15 * std::abs(m.sum()) + 1e-12);
    EXPECT_LT((m - m.transpose()).norm(), 1e-15);
    EXPECT_GT(m.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
  }
}

TEST(Mass, LumpedKeepsTheMassAndIsPositive) {
  for (const cell::CellType type : volume_types) {
    const Coordinates<3> x = sample_volume(type, 0.05, false);
    const NodeMass m = consistent_mass(Section<3>{}, type, x), lumped = lumped_mass(m);
    EXPECT_NEAR(lumped.sum(), m.sum(), 1e-14 * m.sum());
    EXPECT_GT(lumped.diagonal().minCoeff(), 0);
    EXPECT_EQ((lumped - NodeMass(lumped.diagonal().asDiagonal())).norm(), 0.0);
  }
}

/// A restarted analysis computes them elsewhere in memory.
TEST(Mass, LumpedOnesHaveTheSameBitsWhereverTheyAreComputed) {
  constexpr std::size_t places = 4;
  struct alignas(32) Place {
    std::byte bytes[sizeof(NodeMass) + 8 * places];
  };
  const auto memory = std::make_unique<Place>();
  for (const cell::CellType type : area_types) {
    const NodeMass m = consistent_mass(Section<2>{}, type, plain_area(type));
    std::vector<Eigen::VectorXd> diagonals;
    for (std::size_t k = 0; k < places; ++k) {
      auto* const placed = new (memory->bytes + 8 * k) NodeMass(m);
      diagonals.emplace_back(lumped_mass(*placed).diagonal());
      std::destroy_at(placed);
    }
    for (const Eigen::VectorXd& d : diagonals) EXPECT_EQ(d, diagonals.front());
  }
}

}  // namespace
}  // namespace osculate::solid::testing
