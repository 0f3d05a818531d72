// Parts, instances and the assembly, as Abaqus/CAE writes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "osculate/core/error.hpp"
#include "osculate/io/inp.hpp"
#include "osculate/mesh/check.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const std::string brick =
    "*Heading\n** PARTS\n*Part, name=Part-1\n*Node\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n"
    "4, 0., 1., 0.\n5, 0., 0., 1.\n6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.\n"
    "*Element, type=C3D8R\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*Nset, nset=Set-1, generate\n 1, 8, 1\n"
    "*Elset, elset=Set-1\n 1,\n*Nset, nset=Top\n5, 6, 7, 8\n** Section: Section-1\n"
    "*Solid Section, elset=Set-1, material=Material-1\n,\n*End Part\n";

/// Two of them, the second one moved by (2, 0, 0), then turned about the axis from (0, 0, 0) to
/// (0, 0, 1) by 90 degrees; a reference point of the assembly.
const std::string assembly =
    brick +
    "*Assembly, name=Assembly\n*Instance, name=Part-1-1, part=Part-1\n*End Instance\n"
    "*Instance, name=Part-1-2, part=PART-1\n 2., 0., 0.\n 2., 0., 0., 2., 0., 1., 90.\n"
    "*End Instance\n*Node\n 1, 5., 5., 5.\n*Nset, nset=RP\n 1,\n"
    "*Nset, nset=Both, instance=Part-1-1\n 1,\n*Nset, nset=Both, instance=Part-1-2\n Top, 1\n"
    "*Elset, elset=_Surf-1_S2, internal, instance=Part-1-1\n 1,\n"
    "*Elset, elset=_Surf-1_S2, internal, instance=Part-1-2, generate\n 1, 1, 1\n"
    "*Surface, type=ELEMENT, name=Surf-1\n_Surf-1_S2, S2\n"
    "*Surface, type=ELEMENT, name=Surf-2\nPart-1-2.Set-1, S1\npart-1-1.1, S1\n"
    "*Nset, nset=Mixed\nPart-1-2.8, Part-1-1.Top\n*End Assembly\n";

std::vector<Vec3> places(const mesh::Mesh& mesh, const std::string& set) {
  std::vector<Vec3> all;
  for (const Index node : mesh.find_set(set)->nodes) all.push_back(mesh.nodes[std::size_t(node)]);
  return all;
}

TEST(InpParts, InstancesAreMovedThenTurned) {
  const mesh::Mesh mesh = read_inp(assembly, "a.inp");
  EXPECT_EQ(mesh.nodes.size(), 17u);
  const std::vector<Vec3> turned = places(mesh, "Part-1-2.Set-1");
  ASSERT_THAT(turned, SizeIs(8));
  // (x + 2, y, z) turned about (2, 0): (2 - y, x, z).
  EXPECT_NEAR((turned[0] - Vec3(2, 0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((turned[1] - Vec3(2, 1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((turned[2] - Vec3(1, 1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((turned[7] - Vec3(1, 0, 1)).norm(), 0, 1e-15);
  EXPECT_THAT(places(mesh, "RP"), ElementsAre(Vec3(5, 5, 5)));
  EXPECT_EQ(places(mesh, "Part-1-1.Top")[0], Vec3(0, 0, 1));
}

TEST(InpParts, SetsAndSurfacesOfTheAssembly) {
  const mesh::Mesh mesh = read_inp(assembly, "a.inp");
  EXPECT_THAT(mesh.find_set("Both")->nodes, SizeIs(6));
  EXPECT_THAT(mesh.find_set("Mixed")->nodes, SizeIs(5));
  EXPECT_THAT(mesh.find_set("_Surf-1_S2")->cells, SizeIs(2));
  for (const char* const name : {"Surf-1", "Surf-2"}) {
    const double level = name == std::string("Surf-1") ? 1 : 0;
    EXPECT_THAT(mesh.find_set(name)->cells, SizeIs(2));
    for (const Vec3& x : places(mesh, name)) EXPECT_EQ(x.z(), level);
    const mesh::Surface surface =
        mesh::surface_of(mesh, mesh::face_table(mesh), *mesh.find_set(name));
    EXPECT_THAT(surface.errors, IsEmpty());
  }
  EXPECT_THAT(mesh.find_set("part-1-2.SET-1")->cells, SizeIs(1));
  EXPECT_EQ(mesh.find_set("Set-1"), nullptr);
}

TEST(InpParts, NumbersAreThoseOfTheDeckWhereTheyDiffer) {
  // Three nodes are number 1, so that all are numbered in their order: instances, then the rest.
  const mesh::Mesh mesh = read_inp(assembly, "a.inp");
  EXPECT_THAT(mesh.numbers, IsEmpty());
  EXPECT_EQ(mesh.find_set("RP")->nodes, std::vector<Index>{16});
  std::string one = assembly.substr(0, assembly.find("*Instance, name=Part-1-2"));
  const mesh::Mesh single = read_inp(one + "*Node\n 100, 5., 5., 5.\n*End Assembly\n", "a.inp");
  EXPECT_THAT(single.numbers, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 100));
  EXPECT_THAT(single.blocks[0].numbers, ElementsAre(1));
}

TEST(InpParts, NodesAndElementsOfAnInstanceItself) {
  const mesh::Mesh mesh = read_inp(
      "*PART, NAME=P\n*END PART\n*ASSEMBLY\n*INSTANCE, NAME=I, PART=P\n1, 0, 0\n*NODE\n1, 0\n2, "
      "1\n3, "
      "0, 1\n*ELEMENT, TYPE=S3, ELSET=E\n1, 1, 2, 3\n*END INSTANCE\n*END ASSEMBLY\n",
      "a.inp");
  EXPECT_EQ(mesh.nodes[0], Vec3(1, 0, 0));
  EXPECT_THAT(mesh.find_set("i.e")->cells, SizeIs(1));
}

TEST(InpParts, WhatIsWrongIsSaid) {
  const auto refuses = [](const std::string& from, const std::string& to,
                          const std::string& message) {
    std::string text = assembly;
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    try {
      (void)read_inp(text, "a.inp");
      ADD_FAILURE() << "accepted; expected: " << message;
    } catch (const core::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(message));
    }
  };
  refuses("part=PART-1", "part=Part-2", "*INSTANCE: unknown part 'Part-2'; did you mean 'Part-1'?");
  refuses("name=Part-1-2", "name=part-1-1", "*INSTANCE: the instance 'part-1-1' is there twice");
  refuses("*End Part\n", "", "*INSTANCE: stands inside of *PART of line 3, whose end is missing");
  refuses("*End Part\n", "*End Part\n*End Part\n", "*ENDPART: there is no *PART that it could end");
  refuses("*End Part\n", "*End Part\n*Part, name=PART-1\n*End Part\n",
          "*PART: the part 'PART-1' is there twice (see line 3)");
  refuses("part=Part-1\n", "library=old\n", "*INSTANCE: instances of other analyses are not read");
  refuses("90.\n", "x\n", "expected the angle of the rotation (a finite number), found 'x'");
  refuses("2., 0., 1., 90.", "2., 0., 0., 90.", "expected two different points of the axis");
  refuses("90.\n", "90.\n1.\n", "expected one line of translation, one of rotation");
  refuses(" 2., 0., 0.\n 2., 0., 0., 2.,", "1.7e308\n-1.7e308, 0., 0., -1.7e308,",
          "its place is too far away for a number");
  refuses("instance=Part-1-1\n", "instance=Part-1-3\n",
          "*NSET: unknown instance 'Part-1-3'; did you mean 'Part-1-1'?");
  refuses("Part-1-1.Top", "Part-1-1.Topp",
          "unknown set of nodes in the instance 'Part-1-1' 'Topp'; did you mean 'Top'?");
  refuses("Part-1-2.8", "Part-1-2.9", "node 9 does not exist");
  refuses("*End Assembly\n", "*Part, name=Q\n", "'*END PART' is missing");
  std::string loose = brick;
  try {
    (void)read_inp(loose, "a.inp");
    ADD_FAILURE();
  } catch (const core::InputError& error) {
    EXPECT_STREQ(error.what(), "a.inp:3: no *INSTANCE places the parts");
  }
}

}  // namespace
}  // namespace osculate::io
