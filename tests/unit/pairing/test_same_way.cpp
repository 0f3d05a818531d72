// Facets that face the same way as a point are passed over without a projection: with the same
// bits.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <tuple>

#include "osculate/pairing/closest.hpp"
#include "osculate/pairing/pair.hpp"
#include "osculate/pairing/same_way.hpp"

namespace osculate::testing {
namespace {

using pairing::FacetSurface;
using pairing::same_way_cosine;

struct Scene {
  FacetSurface surface;
  std::vector<Vec3> x;
};

/// The surface of a block of 4 x 3 x 1 with crooked facets, outward.
Scene block_of(cell::CellType type, double crooked) {
  Scene s;
  std::map<std::tuple<int, int, int>, Index> known;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-crooked, crooked);
  const auto node = [&](const Eigen::Vector3i& at) {
    const auto [found, fresh] =
        known.emplace(std::tuple(at.x(), at.y(), at.z()), static_cast<Index>(s.x.size()));
    if (fresh)
      s.x.emplace_back(Vec3(at.cast<double>()) + Vec3(noise(random), noise(random), noise(random)));
    return found->second;
  };
  const Eigen::Vector3i size(4, 3, 1);
  const auto facet = [&](std::vector<Index> nodes) {
    s.surface.facets.push_back(pairing::surface_facet(type, nodes));
  };
  for (int a = 0; a < 3; ++a)
    for (const bool high : {false, true}) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      for (int i = 0; i < size[b]; ++i)
        for (int j = 0; j < size[c]; ++j) {
          const auto corner = [&](int u, int v) {
            Eigen::Vector3i at;
            at[a] = high ? size[a] : 0;
            at[b] = i + u;
            at[c] = j + v;
            return node(at);
          };
          std::vector<Index> n{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (!high) std::swap(n[1], n[3]);
          if (type == cell::CellType::quad4) {
            facet(n);
          } else {
            facet({n[0], n[1], n[2]});
            facet({n[0], n[2], n[3]});
          }
        }
    }
  pairing::connect(s.surface);
  return s;
}

Vec3 direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

TEST(SameWay, IsSoAtEveryFootOfTheFacet) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1.1, 1.1);
  for (const double crooked : {0.0, 0.05, 0.3}) {
    const Scene s = block_of(cell::CellType::quad4, crooked);
    std::vector<search::Box<3>> boxes;
    pairing::facet_boxes(s.surface, s.x, boxes);
    const pairing::Tree<3> tree(boxes);
    pairing::SameWay<3> same_way;
    same_way.refresh(s.surface, s.x, tree);
    int held = 0, missed = 0;
    for (std::size_t f = 0; f < s.surface.facets.size(); ++f)
      for (int k = 0; k < 200; ++k) {
        const Vec3 slave = direction(random);
        const bool holds = same_way.facets[f].holds(slave);
        held += holds ? 1 : 0;
        bool all = true;
        for (int l = 0; l < 40; ++l) {
          const Vec2 xi(place(random), place(random));
          const double cosine = pairing::facet_normal(s.surface.facets[f], xi, s.x).dot(slave);
          all = all && cosine > same_way_cosine;
          if (holds) {
            EXPECT_GT(cosine, same_way_cosine) << f;
          }
        }
        missed += all && !holds ? 1 : 0;
      }
    EXPECT_GT(held, 500) << crooked;
    if (crooked == 0.0) {
      EXPECT_EQ(missed, 0);
    }
  }
}

template <int Dim>
void expect_same_place(const pairing::Projection<Dim>& a, const pairing::Projection<Dim>& b) {
  EXPECT_EQ(a.feature, b.feature);
  EXPECT_EQ(a.facet, b.facet);
  EXPECT_EQ(a.xi, b.xi);
  EXPECT_EQ(a.local, b.local);
  EXPECT_EQ(a.distance, b.distance);
  EXPECT_EQ(a.outward, b.outward);
  EXPECT_EQ(a.beyond_end, b.beyond_end);
}

TEST(SameWay, LeavesPlacesAsTheyAre) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-0.5, 1.5);
  for (const cell::CellType type : {cell::CellType::quad4, cell::CellType::tri3})
    for (const double crooked : {0.0, 0.1}) {
      const Scene s = block_of(type, crooked);
      std::vector<search::Box<3>> boxes;
      pairing::facet_boxes(s.surface, s.x, boxes);
      const pairing::Tree<3> tree(boxes);
      pairing::SameWay<3> same_way;
      same_way.refresh(s.surface, s.x, tree);
      int placed = 0;
      for (int k = 0; k < 3000; ++k) {
        pairing::ProjectionQuery<3> query;
        query.point = Vec3(4 * part(random), 3 * part(random), part(random));
        if (k % 3 == 0) query.point = query.point.array().round();  // equally near to several
        query.slave_normal = k % 2 ? direction(random) : Vec3(Vec3::Unit(k % 5 % 3));
        if (k % 7 == 0) query.history = k % static_cast<Index>(s.surface.facets.size());
        const pairing::Projection<3> plain = pairing::closest(s.surface, tree, s.x, query);
        query.same_way = &same_way;
        expect_same_place(plain, pairing::closest(s.surface, tree, s.x, query));
        placed += plain.facet >= 0 ? 1 : 0;
      }
      EXPECT_GT(placed, 2000);
    }
}

TEST(SameWay, LeavesPlacesInThePlaneAsTheyAre) {
  pairing::Chain chain;
  std::vector<Vec2> x;
  constexpr int count = 40;
  for (Index n = 0; n < count; ++n) {
    const double a = -2 * M_PI * n / count;  // the body is on the right
    x.emplace_back(3 * std::cos(a), std::sin(a) + 0.1 * std::sin(7 * a));
    pairing::Facet facet;
    facet.count = 2;
    facet.nodes = {n, (n + 1) % count};
    chain.facets.push_back(facet);
  }
  pairing::connect(chain);
  std::vector<search::Box<2>> boxes;
  pairing::facet_boxes(chain, x, boxes);
  const pairing::Tree<2> tree(boxes);
  pairing::SameWay<2> same_way;
  same_way.refresh(chain, x, tree);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI), part(-4, 4);
  int held = 0;
  for (int k = 0; k < 3000; ++k) {
    const double a = angle(random);
    pairing::ProjectionQuery<2> query;
    query.point = Vec2(part(random), part(random));
    query.slave_normal = Vec2(std::cos(a), std::sin(a));
    const pairing::Projection<2> plain = pairing::closest(chain, tree, x, query);
    query.same_way = &same_way;
    expect_same_place(plain, pairing::closest(chain, tree, x, query));
    for (const auto& facet : same_way.facets) held += facet.holds(*query.slave_normal) ? 1 : 0;
  }
  EXPECT_NEAR(held, 3000 * count / 3, 3000);  // a third of all directions
}

/// Half of the points look away from all of the master: they have no place, and cost nothing.
TEST(SameWay, IsKnownWherePointsHadNoPlace) {
  const Scene plate = block_of(cell::CellType::quad4, 0);
  pairing::PairDefinition<3> pair;
  std::vector<Vec3> x = plate.x;
  for (const pairing::SurfaceFacet& f : plate.surface.facets) {
    const bool upper = pairing::middle_normal(f, plate.x).z() > 0.5;
    if (upper) pair.master.facets.push_back(f);
  }
  for (int i = 0; i < 6; ++i)  // more of them than the few that are looked at anyway
    for (int j = 0; j < 6; ++j) x.emplace_back(5.0 + i, j, 1);
  const auto first = static_cast<Index>(plate.x.size());
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) {
      const Index n = first + 6 * i + j;
      pair.master.facets.push_back(
          pairing::surface_facet(cell::CellType::quad4, std::array{n, n + 6, n + 7, n + 1}));
    }
  pairing::connect(pair.master);
  FacetSurface body = plate.surface;
  const auto shift = static_cast<Index>(x.size());
  for (const Vec3& p : plate.x) x.push_back(p + Vec3(0.1, 0.2, 1.5));
  for (pairing::SurfaceFacet& f : body.facets)
    for (std::size_t k = 0; k < 4; ++k) f.nodes[k] += shift;
  pairing::connect(body);
  pair.slave = pairing::make_slave_side(body);
  pair.normal = contact::penalty(10);
  pairing::prepare<3>(pair, x);
  const pairing::PairState<3> start = pairing::initial_state<3>(pair, x);
  pairing::PairEvaluation<3> work;
  pairing::evaluate<3>(pair, x, start, false, work, {});
  EXPECT_TRUE(work.same_way.fresh);
  int placed = 0, without = 0;
  for (std::size_t i = 0; i < work.points.size(); ++i) {
    const Vec3& normal = work.normals[i];
    if (normal.z() > 0.6) {
      EXPECT_TRUE(work.same_way.branches.front().holds(normal));
      EXPECT_LT(work.points[i].history.facet, 0);
      ++without;
    }
    placed += work.points[i].history.facet >= 0 ? 1 : 0;
  }
  EXPECT_GT(without, 3);
  EXPECT_GT(placed, 10);
}

}  // namespace
}  // namespace osculate::testing
