#include "osculate/mesh/compactness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "osculate/mesh/generate_space.hpp"

namespace osculate::mesh {
namespace {

void add_box(Mesh& mesh, const std::string& name, const Vec3& size, cell::CellType type) {
  SolidBoxSpec spec;
  spec.name = name;
  for (int k = 0; k < 3; ++k) {
    spec.breaks[static_cast<std::size_t>(k)] = {100, 100 + size[k]};
    spec.elements[static_cast<std::size_t>(k)] = {2};
  }
  spec.type = type;
  append_solid_box(mesh, spec);
}

double of(const Mesh& mesh, const std::string& name) {
  return least_compactness(mesh, mesh.find_set(name)->cells);
}

TEST(Compactness, OfBoxes) {
  for (const cell::CellType type :
       {cell::CellType::hex8, cell::CellType::tet10, cell::CellType::wedge6}) {
    Mesh mesh;
    add_box(mesh, "cube", {2, 2, 2}, type);
    add_box(mesh, "plate", {20, 20, 1}, type);
    EXPECT_NEAR(of(mesh, "cube"), std::pow(6, -1.5), 1e-12);
    EXPECT_NEAR(of(mesh, "plate"), 400 / std::pow(880, 1.5), 1e-12);
    std::vector<CellRef> both = mesh.find_set("cube")->cells;
    const std::vector<CellRef>& plate = mesh.find_set("plate")->cells;
    both.insert(both.end(), plate.begin(), plate.end());
    EXPECT_EQ(least_compactness(mesh, both), of(mesh, "plate"));
  }
}

// A ball of many cells, to the second order of their size.
TEST(Compactness, OfABall) {
  const double exact = 1 / (6 * std::sqrt(std::numbers::pi));
  const auto off = [&](int n) {
    BallSpec spec;
    spec.name = "b";
    spec.core = spec.layers = n;
    Mesh mesh;
    append_ball(mesh, spec);
    return of(mesh, "b") / exact - 1;
  };
  const double ratio = off(4) / off(8);
  EXPECT_GT(ratio, 3.8);
  EXPECT_LT(ratio, 4.2);
}

TEST(Compactness, IsOneWhereThereIsNoVolume) { EXPECT_EQ(least_compactness({}, {}), 1); }

}  // namespace
}  // namespace osculate::mesh
