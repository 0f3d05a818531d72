#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "measure.hpp"
#include "osculate/mesh/check.hpp"
#include "osculate/mesh/quality.hpp"

namespace osculate::mesh::testing {
namespace {

// ---- balls --------------------------------------------------------------------------------------

Mesh ball(CellType type, int n, std::array<int, 3> sides = {1, 1, 1}) {
  BallSpec spec;
  spec.name = "b";
  spec.center = {1, -2, 3};
  spec.radius = 2;
  spec.core = spec.layers = n;
  spec.sides = sides;
  spec.type = type;
  return generated(append_ball, spec);
}

class Ball : public ::testing::TestWithParam<CellType> {};
INSTANTIATE_TEST_SUITE_P(Types, Ball,
                         ::testing::Values(CellType::hex8, CellType::hex20, CellType::hex27),
                         type_name);

TEST_P(Ball, IsSoundInEveryOctant) {
  for (int k = 0; k < 8; ++k) {
    const std::array<int, 3> octant{k % 2 == 0 ? 1 : -1, k / 2 % 2 == 0 ? 1 : -1, k < 4 ? 1 : -1};
    const Mesh mesh = ball(GetParam(), 2, octant);
    EXPECT_THAT(check_mesh(mesh), IsEmpty());
    EXPECT_THAT(mesh.find_set("b")->cells, SizeIs(8 + 3 * 8));
    EXPECT_THAT(mesh.find_set("b.surface")->cells, SizeIs(3 * 4));
    EXPECT_THAT(mesh.find_set("b.plane_y")->cells, SizeIs(4 + 2 * 4));
    for (const Index node : mesh.find_set("b.surface")->nodes) {
      const Vec3 arm = at(mesh, node) - Vec3(1, -2, 3);
      EXPECT_NEAR(arm.norm(), 2, 1e-15);
      for (int c = 0; c < 3; ++c) EXPECT_GE(arm[c] * octant[static_cast<std::size_t>(c)], 0);
    }
    for (const Index node : mesh.find_set("b.plane_y")->nodes) EXPECT_EQ(at(mesh, node).y(), -2);
    EXPECT_EQ(at(mesh, mesh.find_set("b.center")->nodes[0]), Vec3(1, -2, 3));
    EXPECT_EQ(at(mesh, mesh.find_set("b.pole_z")->nodes[0]), Vec3(1, -2, 3 + 2.0 * octant[2]));
    const Vec3 out = area_of_set(mesh, "b.surface");
    const Vec3 in = area_of_set(mesh, "b.plane_x") + area_of_set(mesh, "b.plane_y") +
                    area_of_set(mesh, "b.plane_z");
    EXPECT_LE((out + in).norm(), 1e-13);
    for (int c = 0; c < 3; ++c) EXPECT_GT(out[c] * octant[static_cast<std::size_t>(c)], 0);
    EXPECT_THAT(surface_facets(mesh, *mesh.find_set("b")).warnings, IsEmpty());
  }
}

TEST_P(Ball, VolumeConvergesWithTheOrderOfTheCells) {
  const double exact = std::numbers::pi / 6 * 8;
  const double coarse = std::abs(volume_of_set(ball(GetParam(), 4), "b") - exact);
  const double fine = std::abs(volume_of_set(ball(GetParam(), 8), "b") - exact);
  EXPECT_NEAR(std::log2(coarse / fine), cell::info(GetParam()).order == 1 ? 2 : 4, 0.1);
}

// By symmetry a half is two quarters of two octants.
TEST_P(Ball, HalvesQuartersAndTheWholeAreOctantsJoined) {
  const double octant = volume_of_set(ball(GetParam(), 2), "b");
  const double skin = surface_of_set(ball(GetParam(), 2), "b.surface");
  for (const std::array<int, 3> sides :
       {std::array{0, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 1, -1}, {1, 0, 1}}) {
    const auto both = static_cast<std::size_t>(std::count(sides.begin(), sides.end(), 0));
    const double octants = std::pow(2, both);
    const Mesh mesh = ball(GetParam(), 2, sides);
    EXPECT_THAT(check_mesh(mesh), IsEmpty());
    EXPECT_NEAR(volume_of_set(mesh, "b"), octants * octant, 1e-12);
    EXPECT_NEAR(surface_of_set(mesh, "b.surface"), octants * skin, 1e-12);
    EXPECT_GT(quality(mesh, mesh.find_set("b")->cells).worst_shape, 0.5);
    const Surface all = surface_facets(mesh, *mesh.find_set("b"));
    EXPECT_THAT(all.warnings, IsEmpty());
    std::size_t flat = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string axis(1, "xyz"[k]);
      const Set* const plane = mesh.find_set("b.plane_" + axis);
      EXPECT_EQ(plane == nullptr, sides[k] == 0);
      flat += plane ? plane->cells.size() : 0;
      const Vec3 pole = at(mesh, mesh.find_set("b.pole_" + axis)->nodes.at(0));
      EXPECT_EQ(pole[static_cast<Eigen::Index>(k)],
                Vec3(1, -2, 3)[static_cast<Eigen::Index>(k)] + (sides[k] < 0 ? -2 : 2));
      EXPECT_EQ(mesh.find_set("b.pole_minus_" + axis) == nullptr, sides[k] != 0);
    }
    EXPECT_EQ(all.facets.size(), flat + mesh.find_set("b.surface")->cells.size());
  }
  EXPECT_EQ(at(ball(GetParam(), 2, {0, 0, 0}), 0), Vec3(1, -2, 3));
}

TEST(Balls, BiasRefinesTowardsTheSurface) {
  BallSpec spec;
  spec.name = "b";
  spec.layers = 4;
  spec.layer_bias = 0.125;
  spec.sides = {1, 1, 1};
  Mesh mesh;
  append_ball(mesh, spec);
  std::vector<double> z;
  for (const Vec3& x : mesh.nodes)
    if (x.x() == 0 && x.y() == 0 && x.z() > 0.49) z.push_back(x.z());
  ASSERT_THAT(z, SizeIs(5));
  EXPECT_NEAR((z[4] - z[3]) / (z[1] - z[0]), 0.125, 1e-13);
  EXPECT_EQ(z[4], 1);
}

TEST(Balls, BadInputIsRefused) {
  const auto refused = [](const std::function<void(BallSpec&)>& spoil, const char* message) {
    BallSpec good;
    good.name = "b";
    expect_refusal(append_ball, good, spoil, "ball 'b': ", message);
  };
  refused([](BallSpec& s) { s.type = CellType::tet4; }, "cannot be made of tet4 cells");
  refused([](BallSpec& s) { s.radius = 0; }, "positive number, not 0");
  refused([](BallSpec& s) { s.center.x() = std::nan(""); }, "the center must be finite");
  refused([](BallSpec& s) { s.sides = {1, 2, 1}; }, "not 2");
  refused([](BallSpec& s) { s.core = 0; }, "0 elements in the core");
  refused([](BallSpec& s) { s.layer_bias = -1; }, "bias -1 in the layers");
  refused([](BallSpec& s) { s.core = 2000; }, "nodes; at most");
}

// ---- discs and cylinders ------------------------------------------------------------------------

DiscSpec disc_spec(CellType type, int n, int quarters) {
  DiscSpec spec;
  spec.name = "d";
  spec.center = {1, -2, 0};
  spec.radius = 2;
  spec.from = 30;
  spec.quarters = quarters;
  spec.core = spec.layers = n;
  spec.type = type;
  if (cell::info(type).dimension == 3) {
    spec.center.z() = 3;
    spec.heights = {-1, 0, 3};
    spec.elements = {1, n};
  }
  return spec;
}

Mesh disc(const DiscSpec& spec) { return generated(append_disc, spec); }

class Disc : public ::testing::TestWithParam<CellType> {};
INSTANTIATE_TEST_SUITE_P(Types, Disc, ::testing::ValuesIn(area_types), type_name);
class Cylinder : public ::testing::TestWithParam<CellType> {};
INSTANTIATE_TEST_SUITE_P(Types, Cylinder,
                         ::testing::Values(CellType::wedge6, CellType::wedge15, CellType::hex8,
                                           CellType::hex20, CellType::hex27, CellType::shell18),
                         type_name);

TEST_P(Disc, IsSoundInEveryNumberOfQuarters) {
  for (int quarters = 1; quarters <= 4; ++quarters) {
    const Mesh mesh = disc(disc_spec(GetParam(), 2, quarters));
    EXPECT_THAT(check_mesh(mesh), IsEmpty());
    const Set& all = *mesh.find_set("d");
    EXPECT_GT(quality(mesh, all.cells).worst_shape, cell::is_triangle(GetParam()) ? 0.4 : 0.6);
    for (const Index node : mesh.find_set("d.outer")->nodes)
      EXPECT_NEAR((at(mesh, node) - Vec3(1, -2, 0)).norm(), 2, 1e-14);
    std::size_t sides = 0;
    for (const char* const name : {"d.outer", "d.from", "d.to"}) {
      const Set* const set = mesh.find_set(name);
      EXPECT_EQ(set == nullptr, quarters == 4 && std::string(name) != "d.outer") << name;
      if (!set) continue;
      sides += set->cells.size();
      const Boundary boundary = orient_boundary(mesh, *set);
      EXPECT_THAT(boundary.errors, IsEmpty());
      for (const BoundaryFacet& facet : boundary.facets) EXPECT_FALSE(facet.flipped) << name;
    }
    EXPECT_EQ(mesh.find_set("d.outer")->cells.size(), 4u * static_cast<std::size_t>(quarters));
    EXPECT_EQ(boundary_facets(mesh, all).facets.size(), sides);
    EXPECT_EQ(at(mesh, mesh.find_set("d.center")->nodes.at(0)), Vec3(1, -2, 0));
    const double angle = std::numbers::pi / 6;
    const Vec3 first = at(mesh, mesh.find_set("d.pole_0")->nodes.at(0));
    EXPECT_NEAR((first - Vec3(1 + 2 * std::cos(angle), -2 + 2 * std::sin(angle), 0)).norm(), 0,
                1e-14);
    EXPECT_EQ(mesh.find_set("d.pole_270") == nullptr, quarters < 3);
  }
}

TEST_P(Disc, AreaConvergesWithTheOrderOfTheCells) {
  const auto error = [](int n) {
    return std::abs(surface_of_set(disc(disc_spec(GetParam(), n, 4)), "d") - std::numbers::pi * 4);
  };
  EXPECT_NEAR(std::log2(error(4) / error(8)), cell::info(GetParam()).order == 1 ? 2 : 4, 0.1);
}

TEST_P(Cylinder, IsSoundInEveryNumberOfQuartersAndAlongEachAxis) {
  for (int k = 0; k < 12; ++k) {
    const int quarters = 1 + k % 4, along = k / 4;
    DiscSpec spec = disc_spec(GetParam(), 2, quarters);
    spec.along = along;
    const Mesh mesh = disc(spec);
    EXPECT_THAT(check_mesh(mesh), IsEmpty()) << quarters << along;
    EXPECT_GT(quality(mesh, mesh.find_set("d")->cells).worst_shape, 0.4);
    const Surface all = surface_facets(mesh, *mesh.find_set("d"));
    EXPECT_THAT(all.warnings, IsEmpty());
    Vec3 closed = Vec3::Zero();
    std::size_t facets = 0;
    for (const char* const name : {"d.outer", "d.from", "d.to", "d.bottom", "d.top"}) {
      const Set* const set = mesh.find_set(name);
      const bool cut = std::string(name) == "d.from" || std::string(name) == "d.to";
      EXPECT_EQ(set == nullptr, quarters == 4 && cut);
      if (!set) continue;
      closed += area_of_set(mesh, name);
      facets += set->cells.size();
    }
    EXPECT_LE(closed.norm(), 1e-12);
    EXPECT_EQ(facets, all.facets.size());
    for (const Index node : mesh.find_set("d.outer")->nodes) {
      Vec3 arm = at(mesh, node) - spec.center;
      arm[along] = 0;
      EXPECT_NEAR(arm.norm(), 2, 1e-14);
    }
    for (const Index node : mesh.find_set("d.top")->nodes)
      EXPECT_EQ(at(mesh, node)[along], spec.center[along] + 3);
    EXPECT_GT(area_of_set(mesh, "d.top")[along], 0);
    EXPECT_THAT(mesh.find_set("d.axis")->cells, SizeIs(3));
    EXPECT_THAT(mesh.find_set("d.pole_90")->cells, SizeIs(3));
  }
}

TEST_P(Cylinder, VolumeAndSidesConvergeWithTheOrderOfTheCells) {
  constexpr double pi = std::numbers::pi;
  const bool flat = GetParam() == CellType::shell18;  // facets around it have corners only
  const auto error = [&](int n, const char* set, double exact) {
    DiscSpec spec = disc_spec(GetParam(), n, 3);
    spec.elements = {1, 2};
    const Mesh mesh = disc(spec);
    const bool whole = std::string(set) == "d";
    return std::abs((whole ? volume_of_set(mesh, set) : surface_of_set(mesh, set)) - exact);
  };
  const double order = cell::info(GetParam()).order == 1 ? 2 : 4;
  const auto rate = [&](const char* set, double exact) {
    return std::log2(error(4, set, exact) / error(8, set, exact));
  };
  EXPECT_NEAR(rate("d", 0.75 * pi * 4 * 4), order, 0.1);
  EXPECT_NEAR(rate("d.top", 0.75 * pi * 4), order, 0.1);
  if (!flat) {
    EXPECT_NEAR(rate("d.outer", 0.75 * 2 * pi * 2 * 4), order, 0.1);
  }
  EXPECT_LE(error(2, "d.from", 2 * 4), 1e-12);
}

TEST(Discs, ASecondPartLeavesTheFirstAsItIs) {
  Mesh mesh = disc(disc_spec(CellType::quad4, 2, 4));
  const Mesh first = mesh;
  DiscSpec spec = disc_spec(CellType::quad4, 3, 2);
  spec.name = "e";
  append_disc(mesh, spec);
  EXPECT_THAT(mesh.find_set("e")->cells, SizeIs(2 * 27));
  EXPECT_EQ(mesh.find_set("e.center")->nodes.at(0), static_cast<Index>(first.nodes.size()));
  EXPECT_TRUE(std::equal(first.blocks[0].connectivity.begin(), first.blocks[0].connectivity.end(),
                         mesh.blocks[0].connectivity.begin()));
}

TEST(Discs, BadInputIsRefused) {
  const auto refused = [](const std::function<void(DiscSpec&)>& spoil, const char* message) {
    expect_refusal(append_disc, disc_spec(CellType::hex8, 2, 4), spoil, "disc 'd': ", message);
  };
  refused([](DiscSpec& s) { s.type = CellType::tet4; }, "cannot be made of tet4 cells");
  refused([](DiscSpec& s) { s.heights.clear(); }, "of hex8 cells; expected tri3");
  refused([](DiscSpec& s) { s.type = CellType::quad4; }, "expected wedge6");
  refused([](DiscSpec& s) { s.radius = -1; }, "positive number, not -1");
  refused([](DiscSpec& s) { s.center.x() = std::nan(""); }, "must be finite");
  refused([](DiscSpec& s) { s.quarters = 5; }, "1 to 4 quarters, not 5");
  refused([](DiscSpec& s) { s.core = 0; }, "0 elements in the core");
  refused([](DiscSpec& s) { s.layer_bias = -1; }, "bias -1 in the layers");
  refused([](DiscSpec& s) { s.heights = {0, 0}; }, "the axis must increase");
  refused([](DiscSpec& s) { s.core = 9000; }, "nodes; at most");
}

}  // namespace
}  // namespace osculate::mesh::testing
