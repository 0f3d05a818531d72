// The tree of a master with a candidate filter: what it passes over, the projection would have
// refused.
#include <gtest/gtest.h>

#include <random>

#include "own_surface_sample.hpp"

namespace osculate::testing {
namespace {

using pairing::BranchOutline;
using pairing::FacetOutline;

template <int Dim>
struct Refreshed {
  std::vector<search::Box<Dim>> boxes;
  pairing::FilterBuffers<Dim> buffers;
  pairing::Tree<Dim> tree;
  explicit Refreshed(const ContactSample<Dim>& s) {
    pairing::facet_boxes(s.pair.master, s.x, boxes);
    pairing::refresh<Dim>(s.pair.filter, s.pair.master, s.x, boxes, true, buffers, tree);
  }
};

/// Facets of every branch.
template <int Dim>
std::vector<std::vector<Index>> contents(const pairing::Tree<Dim>& tree) {
  std::vector<std::vector<Index>> all(tree.node_count());
  tree.fold(
      [&](Index i, std::span<const Index> facets) {
        all[static_cast<std::size_t>(i)].assign(facets.begin(), facets.end());
      },
      [&](Index i, Index left, Index right) {
        for (const Index child : {left, right})
          for (const Index f : all[static_cast<std::size_t>(child)])
            all[static_cast<std::size_t>(i)].push_back(f);
      });
  return all;
}

PairSample3 bent_walls(cell::CellType type) {
  PairSample3 s = own_walls(hairpin(), type);
  move(s, [](const Vec2& p) { return closed_hairpin(p, 0.33); });
  return s;
}

PairSample bent_outline(int nodes_per_facet) {
  PairSample s = own_surface(hairpin(), nodes_per_facet);
  move(s, [](const Vec2& p) { return closed_hairpin(p, 0.33); });
  return s;
}

TEST(CandidateTree, BranchesBoundTheHeightAndTheNormalsOfTheirFacets) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  for (const cell::CellType type : {cell::CellType::tri3, cell::CellType::quad4}) {
    const PairSample3 s = bent_walls(type);
    const Refreshed<3> r(s);
    const std::vector<std::vector<Index>> facets = contents<3>(r.tree);
    int narrow = 0;
    for (std::size_t i = 0; i < facets.size(); ++i) {
      const BranchOutline<3>& branch = r.buffers.branches[i];
      if (std::isinf(branch.bulge)) continue;
      narrow += facets[i].size() > 4 ? 1 : 0;
      for (int k = 0; k < 20; ++k) {
        Vec3 p, direction;
        for (double& v : p) v = 3 * normal(generator);
        for (double& v : direction) v = normal(generator);
        direction.normalize();
        for (const Index f : facets[i]) {
          const FacetOutline<3>& o = r.buffers.outlines[static_cast<std::size_t>(f)];
          EXPECT_LE((p - o.middle).dot(o.normal), branch.highest(p) + 1e-12);
          const double product = direction.dot(branch.axis), there = direction.dot(o.normal);
          if (product > branch.facing) {
            EXPECT_GE(there, pairing::facing_cosine);
          }
          if (product > branch.same_way) {
            EXPECT_GT(there, pairing::same_way_cosine);
          }
        }
      }
    }
    EXPECT_GT(narrow, 3);  // the sides of a thin arm are in different branches
  }
}

TEST(CandidateTree, ProductBeyondWhichAConeIsWithinALimit) {
  const double a = pairing::product_within(-0.5, 0.2), degree = M_PI / 180;
  EXPECT_NEAR(a, std::cos(120 * degree - 0.2), 1e-8);
  EXPECT_NEAR(pairing::product_within(0.5, 0), 0.5, 1e-8);
  EXPECT_GT(pairing::product_within(0.5, 60 * degree), 1);
}

/// Places of all slave nodes with and without the branches and the outlines of the facets; with
/// `memory` the nodes had places beside the present ones.
template <int Dim>
int same_places(const ContactSample<Dim>& s, bool memory) {
  const Refreshed<Dim> r(s);
  std::vector<FacetOutline<Dim>> unknown = r.buffers.outlines;
  for (FacetOutline<Dim>& o : unknown) o.bulge = std::numeric_limits<double>::infinity();
  int found = 0;
  std::vector<Vec<Dim>> normals;
  pairing::nodal_normals(s.pair.slave, s.x, normals);
  for (std::size_t i = 0; i < s.pair.slave.nodes.size(); ++i) {
    pairing::ProjectionQuery<Dim> query;
    query.point = s.x[static_cast<std::size_t>(s.pair.slave.nodes[i])];
    query.slave_normal = normals[i];
    pairing::NodeFilter<Dim> rules =
        pairing::node_filter<Dim>(s.pair.filter, s.pair.slave, r.buffers, i, query.point);
    if (memory) rules.last = query.point + Vec<Dim>::Constant(0.2 + 0.01 * static_cast<double>(i));
    query.filter = &rules;
    const pairing::Projection<Dim> quick = pairing::closest(s.pair.master, r.tree, s.x, query);
    rules.branches = {};
    rules.outlines = unknown;
    const pairing::Projection<Dim> all = pairing::closest(s.pair.master, r.tree, s.x, query);
    EXPECT_EQ(quick.facet, all.facet) << i;
    EXPECT_EQ(quick.xi, all.xi) << i;
    EXPECT_EQ(quick.distance, all.distance) << i;
    EXPECT_EQ(quick.feature, all.feature) << i;
    found += all.facet >= 0 ? 1 : 0;
  }
  return found;
}
template <int Dim>
int same_places(const ContactSample<Dim>& s) {
  same_places(s, true);
  return same_places(s, false);
}

TEST(CandidateTree, NoPlaceIsLostWithIt) {
  for (const int nodes : {2, 3}) EXPECT_GT(same_places(bent_outline(nodes)), 10);
  for (const cell::CellType type :
       {cell::CellType::tri3, cell::CellType::tri6, cell::CellType::quad4, cell::CellType::quad9})
    EXPECT_GT(same_places(bent_walls(type)), 30);
}

TEST(CandidateTree, NoPlaceOfAnotherSurfaceIsLostWithIt) {
  for (const cell::CellType type : {cell::CellType::tri3, cell::CellType::quad4}) {
    PairSample3 s = own_walls(outline({{0, 0}, {0, 0.4}, {6, 0.4}, {6, 0}}, 0.25), type);
    s.pair.filter.own = false;
    const auto count = static_cast<Index>(s.x.size());
    for (Index n = 0; n < count; ++n)  // a second plate on top of it
      s.x.push_back(s.x[static_cast<std::size_t>(n)] + Vec3(0.07, 0.39, 0.03));
    pairing::FacetSurface upper = s.pair.master;
    for (pairing::SurfaceFacet& facet : upper.facets)
      for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
        facet.nodes[k] += count;
    pairing::connect(upper);
    s.pair.slave = pairing::make_slave_side(upper);
    pairing::prepare(s.pair, s.x);
    EXPECT_GT(same_places(s), 20);
  }
}

}  // namespace
}  // namespace osculate::testing
