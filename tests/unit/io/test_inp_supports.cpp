// What supports and conditions of nodes of shells and beams act on: relations that wait for a
// support, shares of a shell's side.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "osculate/io/inp/deck_mesh.hpp"

namespace osculate::io::inp {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

DeckMesh solids_of(const std::string& text) { return deck_mesh(read_cards(text, "a.inp")); }

const std::string beam_nodes =
    "*NODE, NSET=N\n1, 0, 0, 0\n2, 1.5, 0, 0\n3, 3, 0, 0\n*ELEMENT, TYPE=B32, ELSET=E\n1, 1, 2, "
    "3\n";
const std::string plate_nodes =
    "*NODE, NSET=N\n1, 0, 0, 1\n2, 2, 0, 1\n3, 2, 3, 1\n4, 0, 3, 1\n5, 1, 0, 1\n6, 2, 1.5, 1\n"
    "7, 1, 3, 1\n8, 0, 1.5, 1\n*ELEMENT, TYPE=S8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n";

/// Relations that begin with the step that holds a shell's node in their direction, or a rotation
/// of a beam's node, where the deck does; all stretch and turn as the section does.
TEST(InpSupports, HeldSectionsOfSecondOrderStayStraight) {
  const auto beam = [](const std::string& section, const std::string& held) {
    return solids_of(beam_nodes + "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=" + section +
                     "\n0, 1, 0\n" + held);
  };
  const auto waiting = [](const DeckMesh& deck) {
    std::vector<mesh::Relation> out;
    for (const mesh::Relation& relation : deck.mesh.relations)
      if (relation.from.node >= 0) out.push_back(relation);
    return out;
  };
  EXPECT_THAT(waiting(beam("RECT\n0.4, 0.2", "*BOUNDARY\n1, 1, 3\n*CLOAD\n1, 6, 2.\n")), IsEmpty());
  EXPECT_THAT(waiting(beam("PIPE\n0.2, 0.05", "*BOUNDARY\n1, 1, 6\n")), IsEmpty());
  const DeckMesh clamped = beam("RECT\n0.4, 0.2", "*BOUNDARY\n2, 1, 3\n1, 5\n");
  const Index turns = clamped.mesh.find_set("rotations of node 1")->nodes.at(0);
  ASSERT_THAT(waiting(clamped), SizeIs(3 * 4));
  for (const mesh::Relation& relation : waiting(clamped))
    EXPECT_EQ(relation.from, (mesh::Relation::Support{turns, -1}));
  const DeckMesh shell =
      solids_of(plate_nodes +
                "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.25\n*BOUNDARY\n1, 2, 3\n"
                "3, 4, 6\n5, 1, 3\n*STEP\n*STATIC\n*BOUNDARY\n2, 1\n*END STEP\n");
  std::set<std::pair<Index, int>> held;
  for (const mesh::Relation& relation : waiting(shell)) {
    EXPECT_EQ(relation.from.direction, relation.terms[0].direction);
    held.emplace(relation.from.node, relation.from.direction);
  }
  // none at the middle of an edge, none by rotations
  EXPECT_THAT(held, ElementsAre(std::pair(0, 1), std::pair(0, 2), std::pair(1, 0)));
  for (const DeckMesh* const deck : {&clamped, &shell})
    for (const mesh::Relation& relation : waiting(*deck)) {
      ASSERT_THAT(relation.terms, SizeIs(3));
      Vec3 sum = Vec3::Zero();
      for (const mesh::Relation::Term& term : relation.terms)
        sum += term.factor * deck->mesh.nodes[static_cast<std::size_t>(term.node)];
      EXPECT_NEAR(sum.norm(), 0, 1e-12);
    }
}

/// What conditions between nodes and supports along axes act on is the mean of bottom and top, and
/// nothing holds the middle where axes are held.
TEST(InpSupports, ConditionsActOnBottomAndTopOfShells) {
  const std::string section = "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.25\n";
  const auto shares = [](const DeckMesh& deck, Index node) {
    std::size_t terms = 0, waiting = 0;
    for (const mesh::Relation& relation : deck.mesh.relations) {
      if (relation.terms[0].node == node) terms = relation.terms.size();
      waiting += relation.from.node == node ? 1 : 0;
    }
    return std::pair(terms, waiting);
  };
  const DeckMesh joined = solids_of(
      plate_nodes + section +
      "*EQUATION\n3\n1, 3, 1., 2, 3, -1.,\n8, 3, 2.\n2\n3, 1, 1., 7, 1, 1.\n*BOUNDARY\n4, 2\n");
  EXPECT_EQ(shares(joined, 0), std::pair(std::size_t{3}, std::size_t{0}));
  EXPECT_EQ(shares(joined, 1), std::pair(std::size_t{3}, std::size_t{0}));
  EXPECT_EQ(shares(joined, 2), std::pair(std::size_t{3}, std::size_t{0}));
  EXPECT_EQ(shares(joined, 3), std::pair(std::size_t{4}, std::size_t{1}));
  const DeckMesh turned = solids_of(
      plate_nodes + section +
      "*NSET, NSET=T\n1, 2\n*TRANSFORM, NSET=T\n1, 1, 0, -1, 1, 0\n*BOUNDARY\n1, 1\n3, 1\n");
  EXPECT_EQ(shares(turned, 0), std::pair(std::size_t{3}, std::size_t{0}));
  EXPECT_EQ(shares(turned, 1), std::pair(std::size_t{4}, std::size_t{0}));
  EXPECT_EQ(shares(turned, 2), std::pair(std::size_t{4}, std::size_t{1}));
}

}  // namespace
}  // namespace osculate::io::inp
