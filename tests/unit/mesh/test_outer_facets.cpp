// What the edges of areas and the faces of volumes do alike.
#include <gtest/gtest.h>

#include "facet_sample.hpp"

namespace osculate::mesh::testing {
namespace {

class OuterFacetsOf : public ::testing::TestWithParam<CellType> {
 protected:
  /// Calls with Edges or Faces.
  static void check(const auto& what) {
    cell::info(GetParam()).dimension == 2 ? what(Edges{}) : what(Faces{});
  }
};
INSTANTIATE_TEST_SUITE_P(Areas, OuterFacetsOf, ::testing::ValuesIn(area_types), type_name);
INSTANTIATE_TEST_SUITE_P(Volumes, OuterFacetsOf, ::testing::ValuesIn(volume_types), type_name);

TEST_P(OuterFacetsOf, NormalsOfTheSidesPointOutwards) {
  check([](auto of) {
    for (const bool inside_out : {false, true}) {
      Mesh mesh = box_mesh<decltype(of)>(GetParam());
      if (inside_out) of.turn_inside_out(mesh);
      for (const auto& [name, outward] : of.sides(inside_out)) {
        const auto side = of.oriented(mesh, *mesh.find_set(name));
        EXPECT_THAT(side.errors, IsEmpty());
        ASSERT_EQ(side.facets.size(), mesh.find_set(name)->cells.size());
        for (const auto& facet : side.facets) {
          EXPECT_NEAR(of.normal(mesh, facet).dot(outward), 1, 4e-16) << name;
          EXPECT_TRUE(facet.has_parent());
          // the generator directs edges itself; a mirror turns faces
          EXPECT_EQ(facet.flipped, of.dim == 3 && inside_out);
          if (of.dim == 3) {
            EXPECT_EQ(handedness(mesh, facet.parent), inside_out ? -1 : 1);
          }
        }
      }
    }
  });
}

TEST_P(OuterFacetsOf, DirectionAndFirstNodeOfTheFileDoNotMatter) {
  check([](auto of) {
    Mesh mesh = box_mesh<decltype(of)>(GetParam());
    const Set top = *mesh.find_set("b.top");
    const auto before = of.oriented(mesh, top);
    of.reverse(mesh, top.cells[1]);
    const auto reversed = of.oriented(mesh, top);
    EXPECT_THAT(reversed.errors, IsEmpty());
    ASSERT_EQ(before.facets.size(), reversed.facets.size());
    for (std::size_t f = 0; f < before.facets.size(); ++f) {
      EXPECT_EQ(before.facets[f].node, reversed.facets[f].node);
      EXPECT_EQ(before.facets[f].next, reversed.facets[f].next);
      EXPECT_EQ(reversed.facets[f].flipped, f == 1);
    }
    if constexpr (of.dim == 3) {
      const cell::CellInfo& info = cell::info(before.facets[0].type);
      const std::span<Index> third = nodes_of(mesh, top.cells[2]);
      std::rotate(third.begin(), third.begin() + 1, third.begin() + info.corners);
      if (info.order == 2)
        std::rotate(third.begin() + info.corners, third.begin() + info.corners + 1,
                    third.begin() + 2 * info.corners);
      const Surface after = orient_surface(mesh, top);
      EXPECT_THAT(after.errors, IsEmpty());
      EXPECT_EQ(before.facets[1].node, after.facets[1].node);
      EXPECT_TRUE(after.facets[1].flipped);
      EXPECT_FALSE(after.facets[2].flipped);
      EXPECT_EQ(after.facets[2].node[0], before.facets[2].node[1]);
      for (const SurfaceFacet& facet : after.facets) EXPECT_GT(of.normal(mesh, facet).z(), 0.9);
    }
  });
}

/// One chain that ends where it starts.
void expect_neighbours(const Boundary& boundary) {
  ASSERT_THAT(boundary.facets, SizeIs(10));
  Index f = 0;
  std::set<Index> seen;
  for (std::size_t k = 0; k < boundary.facets.size(); ++k) {
    seen.insert(f);
    const BoundaryFacet& facet = boundary.facets[static_cast<std::size_t>(f)];
    const BoundaryFacet& next = boundary.facets[static_cast<std::size_t>(facet.next)];
    EXPECT_EQ(facet.node[1], next.node[0]);
    EXPECT_EQ(next.prev, f);
    f = facet.next;
  }
  EXPECT_EQ(f, 0);
  EXPECT_THAT(seen, SizeIs(10));
}
void expect_neighbours(const Surface& surface) {
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    const SurfaceFacet& facet = surface.facets[f];
    const std::span<const Index> c = facet.corners();
    for (std::size_t k = 0; k < c.size(); ++k) {
      ASSERT_GE(facet.next[k], 0);
      const SurfaceFacet& other = surface.facets[static_cast<std::size_t>(facet.next[k])];
      EXPECT_THAT(other.next, ::testing::Contains(static_cast<Index>(f)));
      EXPECT_THAT(other.corners(), ::testing::Contains(c[k]));
      EXPECT_THAT(other.corners(), ::testing::Contains(c[(k + 1) % c.size()]));
    }
  }
}

TEST_P(OuterFacetsOf, FreeOnesCloseAroundTheBodyAndHaveNeighboursEverywhere) {
  check([](auto of) {
    for (const bool inside_out : {false, true}) {
      Mesh mesh = box_mesh<decltype(of)>(GetParam());
      if (inside_out) of.turn_inside_out(mesh);
      const auto all = of.free(mesh, *mesh.find_set("b"));
      EXPECT_THAT(all.errors, IsEmpty());
      EXPECT_THAT(all.warnings, IsEmpty());
      EXPECT_NEAR(of.enclosed(mesh, all), 2, of.dim == 2 ? 8e-16 : 1.6e-15);
      expect_neighbours(all);
    }
  });
}

TEST_P(OuterFacetsOf, SidesAndFreeFacetsAgree) {
  check([](auto of) {
    using Of = decltype(of);
    const Mesh mesh = box_mesh<Of>(GetParam());
    std::set<std::vector<Index>> sides;
    for (const auto& side : of.sides(false))
      sides.merge(keys<Of>(of.oriented(mesh, *mesh.find_set(side.first)).facets));
    EXPECT_EQ(sides, keys<Of>(of.free(mesh, *mesh.find_set("b")).facets));
  });
}

TEST_P(OuterFacetsOf, NodesOfASideGiveTheSide) {
  check([](auto of) {
    using Of = decltype(of);
    const Mesh mesh = box_mesh<Of>(GetParam());
    const auto table = of.table(mesh);
    const Set& top = *mesh.find_set("b.top");
    const auto by_nodes = of.of_nodes(mesh, table, top.nodes);
    EXPECT_THAT(by_nodes.warnings, IsEmpty());
    EXPECT_EQ(keys<Of>(by_nodes.facets), keys<Of>(of.oriented(mesh, table, top).facets));
  });
}

TEST_P(OuterFacetsOf, FacetThatIsThereTwiceIsAnError) {
  check([](auto of) {
    Mesh mesh = box_mesh<decltype(of)>(GetParam());
    Set& top = set_of(mesh, "b.top");
    top.cells.push_back(top.cells[0]);
    EXPECT_THAT(of.oriented(mesh, top).errors, ElementsAre(HasSubstr("is there twice")));
  });
}

TEST_P(OuterFacetsOf, PartsHangTogether) {
  check([](auto of) {
    Mesh mesh = box_mesh<decltype(of)>(GetParam());
    of.append(mesh, "c", 5, 6, 1, 2, GetParam());
    std::vector<CellRef> cells = mesh.find_set("c")->cells;
    const std::size_t second = cells.size();
    cells.insert(cells.end(), mesh.find_set("b")->cells.begin(), mesh.find_set("b")->cells.end());
    for (const Link link : {Link::node, Link::side}) {
      const auto parts = connected_parts(mesh, cells, link);
      ASSERT_THAT(parts, SizeIs(2));
      EXPECT_THAT(parts[0], SizeIs(second));
    }
  });
}

template <class Of>
class OuterFacets : public ::testing::Test {};
using EdgesAndFaces = ::testing::Types<Edges, Faces>;
TYPED_TEST_SUITE(OuterFacets, EdgesAndFaces);

TYPED_TEST(OuterFacets, NodeThatIsOnNoneIsNamed) {
  const Mesh mesh = box_mesh<TypeParam>();
  std::vector<Index> nodes = mesh.find_set("b.top")->nodes;
  nodes.push_back(0);
  const auto found = TypeParam::of_nodes(mesh, TypeParam::table(mesh), nodes);
  EXPECT_THAT(found.facets, SizeIs(TypeParam::dim == 2 ? 3 : 6));
  EXPECT_THAT(
      found.warnings,
      ElementsAre(TypeParam::dim == 2
                      ? "node 1 (0, 0) belongs to no free edge whose nodes are all in the set"
                      : "node 1 (0, 0, 0) is on no free face with all its nodes in the "
                        "set"));
}

TYPED_TEST(OuterFacets, SetsOfMostDimensionsAreSurfaces) {
  const Mesh mesh = box_mesh<TypeParam>();
  const auto table = TypeParam::table(mesh);
  const Set nodes{"n", 0, {}, mesh.find_set("b.left")->nodes};
  const std::size_t left = TypeParam::dim == 2 ? 2 : 4, all = TypeParam::dim == 2 ? 10 : 32;
  EXPECT_THAT(surface_of(mesh, table, nodes).facets, SizeIs(left));
  EXPECT_THAT(surface_of(mesh, table, *mesh.find_set("b.left")).facets, SizeIs(left));
  EXPECT_THAT(surface_of(mesh, table, *mesh.find_set("b")).facets, SizeIs(all));
}

// Two bodies glued along a side through common nodes.
TYPED_TEST(OuterFacets, FreedomIsJudgedByTheTable) {
  const Mesh mesh = box_mesh<TypeParam>(TypeParam::linear, 2, 1);
  const Set left{"l", TypeParam::dim, {{0, 0}}, {}};
  const std::size_t sides = 2 * TypeParam::dim;
  for (const auto& found :
       {TypeParam::free(mesh, left), TypeParam::free(mesh, TypeParam::table(mesh), left)})
    EXPECT_THAT(found.facets, SizeIs(sides - 1));
  const auto alone = TypeParam::free(mesh, TypeParam::table(mesh, left.cells), left);
  EXPECT_THAT(alone.facets, SizeIs(sides));
}

// The side between the two cells of a box.
TYPED_TEST(OuterFacets, SideInsideABodyIsAnError) {
  constexpr bool plane = TypeParam::dim == 2;
  Mesh mesh = box_mesh<TypeParam>(TypeParam::linear, 2, 1);
  if (plane)
    mesh.blocks.push_back({CellType::line2, {1, 4}});
  else
    mesh.blocks.push_back({CellType::quad4, {1, 4, 10, 7}});
  const Set set{
      "middle", TypeParam::dim - 1, {{static_cast<Index>(mesh.blocks.size()) - 1, 0}}, {}};
  const auto found = TypeParam::oriented(mesh, set);
  EXPECT_THAT(found.facets, IsEmpty());
  EXPECT_THAT(
      found.errors,
      ElementsAre(plane ? "set 'middle': line from node 2 (1, 0) to node 5 (1, 1) lies inside a "
                          "body: it is an edge of 2 cells"
                        : "set 'middle': quad4 on nodes 2 5 11 8 at node 2 (1, 0, 0) lies inside a "
                          "body: it is a face of 2 cells"));
}

TYPED_TEST(OuterFacets, MessagesDoNotPileUp) {
  const Mesh mesh = box_mesh<TypeParam>();
  Set set{"many", TypeParam::dim - 1, {}, {}};
  for (int i = 0; i < 100; ++i) set.cells.push_back(mesh.find_set("b.top")->cells[0]);
  EXPECT_THAT(TypeParam::oriented(mesh, set).errors, SizeIs(11));
}

}  // namespace
}  // namespace osculate::mesh::testing
