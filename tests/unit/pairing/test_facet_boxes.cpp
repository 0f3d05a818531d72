// Boxes of facets hold all of them, however bent, and are no larger than their control points ask.
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "osculate/cell/shape.hpp"
#include "osculate/pairing/closest.hpp"

namespace osculate::pairing {
namespace {

template <int Dim>
bool holds(const search::Box<Dim>& box, const Vec<Dim>& p) {
  constexpr double rounding = 1e-14;
  return (p.array() >= box.lo.array() - rounding).all() &&
         (p.array() <= box.hi.array() + rounding).all();
}

std::vector<Index> numbers(std::size_t count) {
  std::vector<Index> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

TEST(FacetBoxes, HoldLinesOfEveryOrder) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> u(-1, 1);
  for (const std::size_t count : {2U, 3U, 4U})
    for (int i = 0; i < 20; ++i) {
      std::vector<Vec2> x(count);
      for (Vec2& p : x) p = {u(generator), u(generator)};
      Chain chain;
      chain.facets.push_back(lagrange_facet(numbers(count)));
      std::vector<search::Box<2>> boxes;
      facet_boxes(chain, x, boxes);
      for (double xi = -1; xi <= 1; xi += 0.01)
        EXPECT_TRUE(holds<2>(boxes[0], facet_jet(chain.facets[0], xi, x).r)) << count;
    }
}

TEST(FacetBoxes, HoldFacetsOfEveryType) {
  using cell::CellType;
  std::mt19937 generator(6);
  std::uniform_real_distribution<double> u(-1, 1);
  for (const CellType type :
       {CellType::tri3, CellType::quad4, CellType::tri6, CellType::quad8, CellType::quad9})
    for (int i = 0; i < 20; ++i) {
      std::vector<Vec3> x(static_cast<std::size_t>(cell::info(type).nodes));
      for (Vec3& p : x) p = {u(generator), u(generator), u(generator)};
      FacetSurface surface;
      surface.facets.push_back(surface_facet(type, numbers(x.size())));
      std::vector<search::Box<3>> boxes;
      facet_boxes(surface, x, boxes);
      for (double s = 0; s <= 1; s += 0.05)
        for (double t = 0; t <= 1; t += 0.05) {
          const Vec2 xi =
              cell::is_triangle(type) ? Vec2(s, t * (1 - s)) : Vec2(2 * s - 1, 2 * t - 1);
          EXPECT_TRUE(holds<3>(boxes[0], facet_point(surface.facets[0], xi, x)))
              << cell::info(type).name;
        }
    }
}

// With middle nodes in the middle nothing is added to what the corners span.
TEST(FacetBoxes, AreThoseOfTheCornersWhereEdgesAreStraight) {
  const std::vector<Vec3> x{{0, 0, 0}, {2, 0, 0}, {0, 2, 1}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0.5}};
  FacetSurface surface;
  surface.facets.push_back(surface_facet(cell::CellType::tri6, numbers(6)));
  std::vector<search::Box<3>> boxes;
  facet_boxes(surface, x, boxes);
  EXPECT_EQ(boxes[0].lo, Vec3(0, 0, 0));
  EXPECT_EQ(boxes[0].hi, Vec3(2, 2, 1));
}

}  // namespace
}  // namespace osculate::pairing
