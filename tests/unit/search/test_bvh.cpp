#include "osculate/search/bvh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace osculate::search {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

template <class Dimension>
class BvhOf : public ::testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(BvhOf, Dimensions);

template <int Dim>
Vec<Dim> random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  Vec<Dim> p;
  for (int i = 0; i < Dim; ++i) p[i] = coordinate(random);
  return p;
}

/// A mixture: small boxes, points, flat boxes, copies, and now and then empty, infinite and
/// half-infinite ones.
template <int Dim>
std::vector<Box<Dim>> random_boxes(std::size_t count, std::mt19937& random) {
  std::vector<Box<Dim>> boxes;
  for (std::size_t k = 0; k < count; ++k) {
    const unsigned kind = random() % 24;
    Box<Dim> box;
    if (kind != 0) box.extend(random_point<Dim>(random));
    if (kind > 4) box.extend(Vec<Dim>(box.lo + 0.2 * random_point<Dim>(random)));
    if (kind == 1) box.inflate(infinite);
    if (kind == 2) box.hi[0] = infinite;
    if (kind == 3 && !boxes.empty()) box = boxes.back();
    if (kind == 5) box.hi[1] = box.lo[1];
    boxes.push_back(box);
  }
  return boxes;
}

template <int Dim, class Query>
std::vector<Index> collected(const Query& query) {
  std::vector<Index> found;
  query([&](Index k) { found.push_back(k); });
  return found;
}

template <int Dim>
void expect_same_as_brute_force(const Bvh<Dim>& tree, const std::vector<Box<Dim>>& boxes,
                                std::mt19937& random) {
  Box<Dim> window;
  window.extend(random_point<Dim>(random));
  window.extend(Vec<Dim>(window.lo + 0.5 * random_point<Dim>(random)));
  const Vec<Dim> point = 1.5 * random_point<Dim>(random);
  const double radius = 0.3;
  std::vector<Index> overlapping, within;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    if (boxes[k].overlaps(window)) overlapping.push_back(static_cast<Index>(k));
    if (boxes[k].squared_distance(point) <= radius * radius)
      within.push_back(static_cast<Index>(k));
  }
  const auto overlaps = [&](const auto& visit) { tree.for_each_overlap(window, visit); };
  const auto nears = [&](const auto& visit) { tree.for_each_within(point, radius, visit); };
  std::vector<Index> found = collected<Dim>(overlaps);
  EXPECT_EQ(found, collected<Dim>(overlaps));  // the order repeats itself
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, overlapping);  // each once
  found = collected<Dim>(nears);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, within);

  const auto distance = [&](Index k) {
    return boxes[static_cast<std::size_t>(k)].squared_distance(point);
  };
  Nearest expected;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const double d = distance(static_cast<Index>(k));
    if (d < expected.squared_distance)
      expected = {static_cast<Index>(k), d};  // the lowest of equals
  }
  const Nearest nearest = tree.nearest(point, distance);
  EXPECT_EQ(nearest.index, expected.index);
  EXPECT_EQ(nearest.squared_distance, expected.squared_distance);
}

TYPED_TEST(BvhOf, queries_equal_brute_force) {
  constexpr int dim = TypeParam::value;
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    for (const std::size_t count : {1, 2, 4, 5, 9, 33, 200}) {
      const std::vector<Box<dim>> boxes = random_boxes<dim>(count, random);
      const Bvh<dim> tree{boxes};
      EXPECT_EQ(tree.size(), count);
      for (int query = 0; query < 5; ++query) expect_same_as_brute_force(tree, boxes, random);
    }
  }
}

TYPED_TEST(BvhOf, refit_equals_brute_force_whatever_moved) {
  constexpr int dim = TypeParam::value;
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    Bvh<dim> tree{random_boxes<dim>(100, random)};
    const std::vector<Box<dim>> moved = random_boxes<dim>(100, random);
    tree.refit(moved);
    for (int query = 0; query < 5; ++query) expect_same_as_brute_force(tree, moved, random);
    const std::vector<Box<dim>> more = random_boxes<dim>(130, random);
    tree.refit(more);
    EXPECT_EQ(tree.size(), 130U);
    expect_same_as_brute_force(tree, more, random);
  }
}

TYPED_TEST(BvhOf, empty_set_finds_nothing) {
  constexpr int dim = TypeParam::value;
  const Vec<dim> origin = Vec<dim>::Zero();
  const auto never = [](Index) -> double {
    ADD_FAILURE();
    return 0;
  };
  Box<dim> all;
  all.extend(origin);
  all.inflate(infinite);
  for (const Bvh<dim>& tree : {Bvh<dim>{}, Bvh<dim>{std::vector<Box<dim>>{}},
                               Bvh<dim>{std::vector<Box<dim>>(9)}}) {  // the last: empty boxes
    tree.for_each_overlap(all, never);
    tree.for_each_within(origin, infinite, never);
    tree.for_each_nearest(origin, 1, never);
    EXPECT_EQ(tree.nearest(origin, never).index, -1);
  }
}

TYPED_TEST(BvhOf, infinite_boxes_are_always_found) {
  constexpr int dim = TypeParam::value;
  std::mt19937 random(3);
  std::vector<Box<dim>> boxes = random_boxes<dim>(60, random);
  boxes[17] = {Vec<dim>::Constant(-infinite), Vec<dim>::Constant(infinite)};
  const Bvh<dim> tree{boxes};
  for (int k = 0; k < 50; ++k) {
    const Vec<dim> p = std::pow(10.0, k) * random_point<dim>(random);
    const auto distance = [&](Index i) {  // the line is nearer than everything else
      return i == 17 ? 0.0 : 1 + boxes[static_cast<std::size_t>(i)].squared_distance(p);
    };
    EXPECT_EQ(tree.nearest(p, distance).index, 17);
    const std::vector<Index> found =
        collected<dim>([&](const auto& visit) { tree.for_each_within(p, 0.0, visit); });
    EXPECT_EQ(std::count(found.begin(), found.end(), 17), 1);
  }
}

TEST(Bvh, nearest_takes_the_lowest_of_equals_and_respects_the_bound) {
  std::vector<Box<2>> boxes(50);
  for (std::size_t k = 0; k < boxes.size(); ++k)  // on a circle: all equally far, far from alike
    boxes[k].extend(Vec2(k % 2 == 0 ? 3 : -3, k % 4 < 2 ? 4 : -4));
  boxes[0] = boxes[1] = Box<2>{Vec2(50, 50), Vec2(51, 51)};
  const Bvh<2> tree{boxes};
  const auto distance = [&](Index k) {
    return boxes[static_cast<std::size_t>(k)].squared_distance(Vec2(0, 0));
  };
  EXPECT_EQ(tree.nearest(Vec2(0, 0), distance).index, 2);
  EXPECT_EQ(tree.nearest(Vec2(0, 0), distance, 25.0).index, 2);  // the bound counts as inside
  EXPECT_EQ(tree.nearest(Vec2(0, 0), distance, 24.999).index, -1);
}

TEST(Bvh, ties_are_all_visited) {
  std::vector<Box<2>> boxes(64);
  for (std::size_t k = 0; k < boxes.size(); ++k) boxes[k].extend(Vec2(static_cast<double>(k), 0));
  const Bvh<2> tree{boxes};
  std::vector<Index> near;
  tree.for_each_nearest(Vec2(31.5, 2), 1e-9, [&](Index k) {
    const double d = std::hypot(static_cast<double>(k) - 31.5, 2);
    if (d < std::hypot(0.5, 2) + 1e-9) near.push_back(k);
    return d;
  });
  std::sort(near.begin(), near.end());
  EXPECT_EQ(near, (std::vector<Index>{31, 32}));
}

TEST(Bvh, nothing_beyond_the_bound_is_visited) {
  std::vector<Box<2>> boxes(64);
  for (std::size_t k = 0; k < boxes.size(); ++k) boxes[k].extend(Vec2(static_cast<double>(k), 0));
  const Bvh<2> tree{boxes};
  std::vector<Index> seen;
  const auto refused = [&](Index k) {
    seen.push_back(k);
    return std::numeric_limits<double>::infinity();
  };
  tree.for_each_nearest(Vec2(31.5, 0), 1e-9, refused, 1.6);
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(seen, (std::vector<Index>{30, 31, 32, 33}));
}

TEST(Bvh, nearest_looks_at_few_of_many_boxes_also_beside_an_infinite_one) {
  constexpr int side = 100;
  std::vector<Box<2>> boxes;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) boxes.push_back({Vec2(i, j), Vec2(i + 0.9, j + 0.9)});
  boxes.push_back({Vec2(-infinite, -infinite), Vec2(infinite, infinite)});
  const Bvh<2> tree{boxes};
  int calls = 0;
  const Nearest found = tree.nearest(Vec2(41.93, 17.3), [&](Index k) {
    ++calls;
    return k == side * side
               ? 1e9
               : boxes[static_cast<std::size_t>(k)].squared_distance(Vec2(41.93, 17.3));
  });
  EXPECT_EQ(found.index, 41 * side + 17);
  EXPECT_LE(calls, 10);
}

TEST(Bvh, a_million_equal_boxes_stay_within_the_stack) {
  const std::vector<Box<2>> boxes(1'000'000, Box<2>{Vec2(1, 1), Vec2(1, 1)});
  const Bvh<2> tree{boxes};
  std::size_t count = 0;
  tree.for_each_overlap(boxes[0], [&](Index) { ++count; });
  EXPECT_EQ(count, boxes.size());
}

}  // namespace
}  // namespace osculate::search
