// Malformed Abaqus and CalculiX decks, each with its message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "osculate/core/error.hpp"
#include "osculate/io/inp.hpp"
#include "osculate/mesh/check.hpp"

namespace osculate::io {
namespace {

using ::testing::HasSubstr;

/// Lines 1 to 8; `behind` follows on line 9.
std::string with(const std::string& behind) {
  return "*NODE, NSET=Nall\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n"
         "*ELEMENT, TYPE=C3D4, ELSET=Eall\n1, 1, 2, 3, 4\n**\n" +
         behind;
}

struct Broken {
  std::string deck, message;
};

void expect_refusals(const std::vector<Broken>& all) {
  for (const Broken& broken : all) {
    try {
      (void)read_inp(broken.deck, "a.inp");
      ADD_FAILURE() << "accepted; expected: " << broken.message;
    } catch (const core::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(broken.message));
    }
  }
}

TEST(InpBroken, Nodes) {
  expect_refusals(
      {{"*NODE\n", "a.inp: there are no nodes (*NODE)"},
       {"*NODE\n1, 0\n", "a.inp: there are no elements (*ELEMENT)"},
       {with("*NODE\n3, 5, 5, 5\n"), "a.inp:10: node 3 is there twice, first in a.inp:4"},
       {with("*NODE\n-5, 0\n"),
        "a.inp:10: expected the number of a node (a whole number from 1 to 2147483647), found "
        "'-5'"},
       {with("*NODE\n0, 0\n"), "found '0'"},
       {with("*NODE\n99999999999, 0\n"), "found '99999999999'"},
       {with("*NODE\n5.5, 0\n"), "found '5.5'"},
       {with("*NODE\n5, zero\n"),
        "a.inp:10: expected a coordinate (a finite number), found 'zero'"},
       {with("*NODE\n5, nan\n"), "found 'nan'"},
       {with("*NODE\n5, 1e999\n"), "found '1e999'"},
       {with("*NODE\n5, 0, 0, 0, 0, 0, 0, 7\n"), "unexpected '7' at the end of the line"},
       {with("*NODE, SYSTEM=S\n5, 0\n"), "a.inp:9: *NODE: expected SYSTEM=R or C, found 'S'"},
       {with("*NODE, NSET=\n5, 0\n"), "a.inp:9: *NODE: expected 'NSET=' with a name"},
       {with("*NGEN\n1, 4\n"), "a.inp:9: *NGEN: makes or moves nodes and elements"},
       {with("*SYSTEM\n"), "a.inp:9: *SYSTEM: makes or moves nodes"}});
}

TEST(InpBroken, Elements) {
  expect_refusals(
      {{with("*ELEMENT\n2, 1, 2, 3, 4\n"), "a.inp:9: *ELEMENT: expected 'TYPE=' with a type"},
       {with("*ELEMENT, TYPE=C3D9\n"),
        "a.inp:9: *ELEMENT: elements of type 'C3D9' are not supported; supported are C3D4, C3D6"},
       {with("*ELEMENT, TYPE=CONN3D2\n2, 1, 2\n"), "elements of type 'CONN3D2' are not supported"},
       {with("*ELEMENT, TYPE=C3D4\n2, 1, 2, 3, 5\n"),
        "a.inp:10: element 2 names node 5, which does not exist"},
       {with("*ELEMENT, TYPE=C3D4\n2, 1, 2, 3\n"),
        "a.inp:10: element 2 has 3 nodes where C3D4 needs 4"},
       {with("*ELEMENT, TYPE=C3D10\n2, 1, 2, 3,\n4\n*NSET, NSET=X\n"),
        "a.inp:10: element 2 has 4 nodes where C3D10 needs 10"},
       {with("*ELEMENT, TYPE=C3D4\n2, 1, 2, 3, 4, 5\n"),
        "a.inp:10: element 2 has more than the 4 nodes of C3D4"},
       {with("*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n"),
        "a.inp:10: element 1 is there twice, first in a.inp:7"},
       {with("*ELEMENT, TYPE=C3D4\n2, 1, -2, 3, 4\n"), "expected the number of a node"},
       {with("*ELEMENT, TYPE=C3D4\n2, 1,, 3, 4\n"), "found ''"},
       {with("*ELEMENT, TYPE=C3D4\n2 1 2 3 4\n"), "found '2 1 2 3 4'"},
       {with("*ELEMENT, TYPE=C3D4\nx, 1, 2, 3, 4\n"),
        "a.inp:10: expected the number of an element"}});
}

TEST(InpBroken, Sets) {
  expect_refusals(
      {{with("*NSET\n1\n"), "a.inp:9: *NSET: expected 'NSET=' with a name"},
       {with("*ELSET, NSET=A\n1\n"), "a.inp:9: *ELSET: expected 'ELSET=' with a name"},
       {with("*NSET, NSET=A\n1, 9\n"), "a.inp:10: node 9 does not exist"},
       {with("*ELSET, ELSET=A\n9\n"), "a.inp:10: element 9 does not exist"},
       {with("*NSET, NSET=A\n-1\n"), "a.inp:10: expected a number (a whole number from 1"},
       {with("*NSET, NSET=A\nNal\n"), "a.inp:10: unknown set of nodes 'Nal'; did you mean 'Nall'?"},
       {with("*ELSET, ELSET=A\nNall\n"), "unknown set of elements 'Nall'; did you mean 'Eall'?"},
       {with("*NSET, NSET=A, ELSET=Nall\n"), "a.inp:9: unknown set of elements 'Nall'"},
       {with("*NSET, NSET=A\nB\n*NSET, NSET=B\na\n"), "the set 'A' contains itself"},
       {with("*ELSET, ELSET=A\nA\n"), "a.inp:10: the set 'A' contains itself"},
       {with("*NSET, NSET=A, GENERATE\n1\n"),
        "a.inp:10: the line ends where the last number is expected"},
       {with("*NSET, NSET=A, GENERATE\n4, 1\n"), "the last number, 1, is below the first one, 4"},
       {with("*NSET, NSET=A, GENERATE\n1, 4, 0\n"), "expected the step of the numbers"},
       {with("*NSET, NSET=A, GENERATE\n1, 4, 1, 1\n"), "unexpected '1' at the end of the line"},
       {with("*NSET, NSET=A, GENERATE\n7, 9\n"), "a.inp:10: none of the nodes from 7 to 9 exists"},
       {with("*NSET, NSET=A, INSTANCE=I\n1\n"), "*NSET: unknown instance 'I'; there are none"},
       {with("*NSET, NSET=\x01\n1\n"), "the name has control characters or is not UTF-8"},
       {with("*NSET, NSET=" + std::string(201, 'a') + "\n1\n"),
        "a name has more than 200 characters"},
       {with("*NSET, NSET=Eall\n1\n*ELSET, ELSET=Eall.nodes\nEall\n"),
        "two sets have the name 'Eall.nodes'"}});
  std::string chain;
  for (int k = 0; k < 200; ++k)
    chain += "*NSET, NSET=A" + std::to_string(k) + "\nA" + std::to_string(k + 1) + "\n";
  expect_refusals({{with(chain), "too many sets within each other"}});
}

TEST(InpBroken, Surfaces) {
  expect_refusals(
      {{with("*SURFACE\nEall, S1\n"), "a.inp:9: *SURFACE: expected 'NAME=' with a name"},
       {with("*SURFACE, NAME=A\nEal, S1\n"),
        "a.inp:10: unknown set of elements 'Eal'; did you mean 'Eall'?"},
       {with("*SURFACE, NAME=A\n7, S1\n"), "a.inp:10: element 7 does not exist"},
       {with("*SURFACE, NAME=A\nEall, S5\n"),
        "a.inp:10: element 1 of type C3D4 has no side 'S5'; expected S1 to S4"},
       {with("*SURFACE, NAME=A\nEall, S1, S2\n"), "unexpected 'S2' at the end of the line"},
       {with("*SURFACE, NAME=A\n, S2\n"), "expected a number or the name of a set"},
       {with("*SURFACE, NAME=A, COMBINE=UNION\nB, C\n"),
        "a.inp:10: unknown surface of elements 'B'"},
       {with("*SURFACE, NAME=A, COMBINE=SUM\nB, C\n"),
        "expected COMBINE=UNION, DIFFERENCE or INTERSECTION, found 'SUM'"},
       {with("*SURFACE, NAME=A, TYPE=NODE, COMBINE=UNION\nB, C\n"),
        "COMBINE is read of surfaces of elements, not of nodes"},
       {with("*SURFACE, NAME=A, COMBINE=UNION\nA\n"), "the surface 'A' is made of itself"},
       {with("*SURFACE, NAME=A, COMBINE=UNION\nB\n*SURFACE, NAME=B, COMBINE=UNION\nA\n"),
        "is made of itself"},
       {with("*SURFACE, NAME=B\nEall, S1\n*SURFACE, NAME=A, COMBINE=DIFFERENCE\nB\n"),
        "*SURFACE: expected two names of surfaces"},
       {with("*SURFACE, NAME=B\nEall, S1\n*SURFACE, NAME=A, COMBINE=DIFFERENCE\nB, B\n"),
        "the surface 'A' has no facets"},
       {with("*SURFACE, NAME=B\nEall, S1\n*SURFACE, NAME=B, COMBINE=UNION\nB\n"),
        "the surface 'B' is there already"},
       {with("*SURFACE, NAME=A, TYPE=NODE\nEall\n"), "unknown set of nodes 'Eall'"},
       {with("*ELEMENT, TYPE=B31, ELSET=B\n2, 1, 2\n*SURFACE, NAME=A\nB, S1\n"),
        "element 2 of type B31 has no side 'S1'; expected none"},
       {with("*ELEMENT, TYPE=S3, ELSET=B\n2, 1, 2, 3\n*SURFACE, NAME=A\nEall, S2\nB, E1\n"),
        "the surface 'A' has edges and faces; expected one of them"}});
}

TEST(InpBroken, EveryTruncationAndManyChangesEndInAMeshOrInAMessage) {
  const std::string whole = with(
      "*NSET, NSET=A, GENERATE\n1, 3, 2\n*NSET, NSET=B\nA, 4\n*ELSET, ELSET=C\nEall\n*SURFACE, "
      "NAME=S\nC, S1\n1\n*PART, NAME=P\n*NODE\n1, 0\n*END PART\n*INSTANCE, NAME=I, PART=P\n1, "
      "0, 0\n0, 0, 0, 0, 0, 1, 30.\n*END INSTANCE\n*NSET, NSET=D, INSTANCE=I\n1\n*NSET, "
      "NSET=E\nI.1, D\n");
  std::size_t read = 0;
  const auto attempt = [&](const std::string& text) {
    try {
      const mesh::Mesh mesh = read_inp(text, "a.inp");
      for (const mesh::Finding& finding : mesh::check_mesh(mesh))
        EXPECT_NE(finding.flaw, mesh::Flaw::bad_index) << text;
      ++read;
    } catch (const core::InputError&) {
    }
  };
  for (std::size_t size = 0; size <= whole.size(); ++size) attempt(whole.substr(0, size));
  std::mt19937 random(1);
  const std::string letters = "*,.= \n\"0129-+eSAPI\t";
  for (int k = 0; k < 4000; ++k) {
    std::string text = whole;
    for (int change = 0; change < 3; ++change)
      text[random() % text.size()] = letters[random() % letters.size()];
    attempt(text);
  }
  EXPECT_GT(read, 100u);
}

}  // namespace
}  // namespace osculate::io
