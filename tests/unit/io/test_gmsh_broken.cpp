#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <random>

#include "osculate/core/error.hpp"
#include "osculate/io/gmsh.hpp"
#include "osculate/mesh/check.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::io {
namespace {

using ::testing::HasSubstr;

const std::string data_dir = OSCULATE_SOURCE_DIR "/tests/unit/io/data/";
const std::string head2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string head4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string nodes2 = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";  // lines 4 to 9
const std::string elements2 = "$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n";

template <class T>
std::string bytes(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

void expect_error(const std::string& content, const std::string& message) {
  try {
    (void)read_gmsh(content, "x.msh");
    ADD_FAILURE() << "accepted; expected: " << message;
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(message));
  }
}

TEST(GmshBroken, Headers) {
  expect_error("", "x.msh: the file is empty");
  expect_error(" \n\n", "x.msh: the file is empty");
  expect_error("hello\n", "x.msh:1: expected the beginning of a section");
  expect_error("$Nodes\n", "x.msh:1: $Nodes: expected '$MeshFormat' first: not a Gmsh mesh");
  expect_error("$NOD\n3\n", "version 1 of the format is not supported; expected 2.2 or 4.1");
  expect_error("$MeshFormat\n4 0 8\n$EndMeshFormat\n", "x.msh:2: $MeshFormat: version 4 of");
  expect_error("$MeshFormat\n3 0 8\n$EndMeshFormat\n", "version 3 of the format");
  expect_error("$MeshFormat\n2.2 2 8\n$EndMeshFormat\n", "the file type must be 0 or 1, not 2");
  expect_error("$MeshFormat\n4.1 0 4\n$EndMeshFormat\n", "the data size must be 8, not 4");
  expect_error("$MeshFormat\n4.1 0 8 7\n$EndMeshFormat\n", "unexpected '7' at the end of the line");
  expect_error("$MeshFormat\n4.1 0 8\n", "the file ends before '$EndMeshFormat'");
  expect_error("$MeshFormat\nabc\n", "expected the version of the format (a number), found 'abc'");
  expect_error(head2, "x.msh: section '$Nodes' is missing");
  expect_error(head2 + head2, "x.msh:4: $MeshFormat: the section is there twice");
  expect_error(head2 + nodes2, "x.msh: section '$Elements' is missing");
  expect_error(head2 + nodes2 + nodes2, "x.msh:10: $Nodes: the section is there twice");
  expect_error(head2 + elements2, "x.msh:4: $Elements: the section must follow $Nodes");
  expect_error(head2 + "$Odd\n1\n", "'$EndOdd' is missing");
}

TEST(GmshBroken, ByteOrder) {
  const std::string begin = "$MeshFormat\n2.2 1 8\n";
  expect_error(begin + std::string("\0\0\0\1", 4) + "\n$EndMeshFormat\n",
               "x.msh: byte 20: $MeshFormat: the file was written on a machine with another byte");
  expect_error(begin + std::string("\2\0\0\0", 4) + "\n$EndMeshFormat\n", "not 2");
  expect_error(begin + "\1", "byte 20: $MeshFormat: the file ends where");
}

TEST(GmshBroken, Nodes) {
  const auto nodes = [](const std::string& text) { return head2 + "$Nodes\n" + text; };
  expect_error(nodes("-3\n"), "x.msh:5: $Nodes: the number of nodes is negative: -3");
  expect_error(nodes("2\n1 0 0 0\n"), "x.msh:7: $Nodes: the file ends where the tag of a node");
  expect_error(nodes("999999999999\n1 0 0 0\n"),
               "x.msh:5: $Nodes: 999999999999 nodes announced, but the rest of the file holds at "
               "most 1");
  expect_error(nodes("1\n1 0 nan 0\n"), "expected a coordinate (a finite number), found 'nan'");
  expect_error(nodes("1\n1 0 inf 0\n"), "found 'inf'");
  expect_error(nodes("1\n1 0 1e999 0\n"), "found '1e999'");
  expect_error(nodes("1\n1 0 1,5 0\n"), "expected a coordinate (a number), found '1,5'");
  expect_error(nodes("1\n1 0 0\n$EndNodes\n"), "x.msh:6: $Nodes: the line ends where a coordinate");
  expect_error(nodes("1\n1 0 0 0 0\n"), "unexpected '0' at the end of the line");
  expect_error(nodes("1\n0 0 0 0\n"), "the tag of a node must be positive, not 0");
  expect_error(nodes("1\n-1 0 0 0\n"), "the tag of a node must be positive, not -1");
  expect_error(nodes("1\n1.5 0 0 0\n"), "expected the tag of a node (a whole number), found '1.5'");
  expect_error(nodes("1\n99999999999 0 0 0\n"), "the tag of a node is too large");
  expect_error(nodes("3\n7 0 0 0\n4 0 0 0\n7 1 0 0\n$EndNodes\n"),
               "x.msh:8: $Nodes: node 7 is there twice");
  expect_error(nodes("3\n7 0 0 0\n7 1 0 0\n4 0 0 0\n$EndNodes\n"),
               "x.msh:7: $Nodes: node 7 is there twice");
  expect_error(nodes("0\n$EndNodes\n"), "the mesh has no nodes");
  expect_error(nodes("1\n1 0 0 0\n2 0 0 0\n$EndNodes\n"), "expected '$EndNodes', found '2 0 0 0'");
}

TEST(GmshBroken, Elements) {
  const auto elements = [](const std::string& text) {
    return head2 + nodes2 + "$Elements\n" + text;
  };
  expect_error(elements("1\n1 2 2 1 1 1 2 4\n"),
               "x.msh:12: $Elements: an element names node 4, which does not exist");
  expect_error(elements("1\n1 7 2 1 1 1 2 3 3 3\n"),
               "x.msh:12: $Elements: element type 7 (5-node pyramid) is not supported; "
               "supported are 15 (point1) 1 (line2)");
  expect_error(elements("1\n1 777 2 1 1 1 2 3\n"), "element type 777 is not supported");
  expect_error(elements("1\n1 -1 2 1 1 1 2 3\n"), "element type -1 is not supported");
  expect_error(elements("1\n1 2 -2 1 1 1 2 3\n"), "the number of tags is negative: -2");
  expect_error(elements("1\n1 2 99999 1 1 1 2 3\n"), "99999 tags announced");
  expect_error(elements("1\n1 2 2 -1 1 1 2 3\n"), "the tag of a physical group is negative: -1");
  expect_error(elements("1\n1 2 2 1 1 1 2\n$EndElements\n"),
               "the line ends where the tag of a node");
  expect_error(elements("1\n1 2 2 1 1 1 2 3 3\n"), "unexpected '3'");
  expect_error(elements("2\n1 2 2 1 1 1 2 3\n$EndElements\n"),
               "expected the number of an element (a whole number), found '$EndElements'");
  expect_error(elements("88888888\n"), "88888888 elements announced");
}

TEST(GmshBroken, Names) {
  const auto names = [](const std::string& text) {
    return head2 + "$PhysicalNames\n" + text + "$EndPhysicalNames\n" + nodes2 + elements2;
  };
  expect_error(names("2\n1 1 \"a\"\n2 1 \"a\"\n"),
               "x.msh:7: $PhysicalNames: the name 'a' is used twice");
  expect_error(names("2\n1 1 \"a\"\n1 1 \"b\"\n"),
               "the group of dimension 1 and tag 1 is there twice");
  expect_error(names("1\n4 1 \"a\"\n"), "the dimension of a group must be 0 to 3, not 4");
  expect_error(names("1\n1 1 a\n"), "expected the name of the group in quotes");
  expect_error(names("1\n1 1 \"\n"), "expected the name of the group in quotes");
  expect_error(names("1\n1 1 \"a\x1b[2J\"\n"), "control characters or is not UTF-8");
  expect_error(names("1\n1 1 \"\xC3\"\n"), "control characters or is not UTF-8");
  expect_error(names("2\n1 1 \"a\"\n"),
               "expected the dimension of a group (a whole number), found '$EndPh");
  expect_error(names("1\n1 7 \"surface_1\"\n"),
               "x.msh: two physical groups have the name 'surface_1'");
}

TEST(GmshBroken, Version4) {
  const std::string entities = "$Entities\n0 0 1 0\n1 0 0 0 1 1 0 1 5 0\n$EndEntities\n";
  const std::string nodes = "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n";
  const std::string elements = "$Elements\n1 1 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n";
  EXPECT_NO_THROW((void)read_gmsh(head4 + entities + nodes + elements, "x.msh"));
  const auto spoiled = [&](const std::string& from, const std::string& to) {
    std::string text = head4 + entities + nodes + elements;
    return text.replace(text.find(from), from.size(), to);
  };
  expect_error(spoiled("1 3 1 3", "1 4 1 3"), "4 nodes announced, but the blocks hold 3");
  expect_error(spoiled("1 3 1 3", "1 77777777777 1 3"), "77777777777 nodes announced");
  expect_error(spoiled("1 3 1 3", "999999 3 1 3"), "999999 blocks of nodes announced");
  expect_error(spoiled("2 1 0 3", "2 1 0 88888888"), "88888888 nodes announced");
  expect_error(spoiled("2 1 0 3", "2 1 0 -3"), "the number of items in a block is negative");
  expect_error(spoiled("2 1 0 3", "4 1 0 3"), "the dimension of an entity must be 0 to 3, not 4");
  expect_error(spoiled("2 1 0 3", "2 1 2 3"), "the parametric flag must be 0 or 1, not 2");
  expect_error(spoiled("2\n3\n0 0 0", "2\n2\n0 0 0"), "x.msh:13: $Nodes: node 2 is there twice");
  expect_error(spoiled("1 1 1 1\n2", "1 2 1 1\n2"), "2 elements announced, but the blocks hold 1");
  expect_error(spoiled("2 1 2 1\n", "1 1 2 1\n"),
               "elements of type 2 (tri3) in an entity of dimension 1");
  expect_error(spoiled("2 1 2 1\n", "2 1 5 1\n"),
               "elements of type 5 (hex8) in an entity of dimension 2");
  expect_error(spoiled("2 1 2 1\n", "2 1 7 1\n"),
               "element type 7 (5-node pyramid) is not supported");
  expect_error(spoiled("1 1 2 3\n", "1 1 2 9\n"), "names node 9, which does not exist");
  expect_error(spoiled("1 5 0\n", "1 0 0\n"), "the tag of a physical group must not be 0");
  expect_error(spoiled("1 5 0\n", "77777 5 0\n"), "77777 tags of physical groups announced");
  expect_error(spoiled("0 0 1 0\n", "0 0 4444444 0\n"), "4444444 entities announced");
}

TEST(GmshBroken, BinaryCountsThatLie) {
  const std::string head =
      "$MeshFormat\n4.1 1 8\n" + bytes<std::int32_t>(1) + "\n$EndMeshFormat\n$Nodes\n";
  const auto counts = [](std::uint64_t a, std::uint64_t b) {
    return bytes(a) + bytes(b) + bytes<std::uint64_t>(1) + bytes<std::uint64_t>(3);
  };
  const std::uint64_t huge = std::uint64_t{1} << 60U;
  expect_error(head + counts(1, huge), "nodes announced, but the rest of the file holds at most 0");
  expect_error(head + counts(1, ~std::uint64_t{0}),
               "a number of nodes or blocks is negative or too");
  expect_error(head + counts(1, 0) + bytes<std::int32_t>(2) + bytes<std::int32_t>(1) +
                   bytes<std::int32_t>(0) + bytes(huge),
               "nodes announced, but the rest");
  const std::string head22 = "$MeshFormat\n2.2 1 8\n" + bytes<std::int32_t>(1) +
                             "\n$EndMeshFormat\n$Nodes\n1\n" + bytes<std::int32_t>(1) +
                             std::string(24, '\0') + "\n$EndNodes\n$Elements\n1\n";
  const auto block = [](std::int32_t count, std::int32_t tags) {
    return bytes<std::int32_t>(15) + bytes(count) + bytes(tags) + std::string(16, '\1');
  };
  expect_error(head22 + block(2, 2), "2 elements of one type announced where 1 are left");
  expect_error(head22 + block(-1, 2), "-1 elements of one type");
  expect_error(head22 + block(1, 2000000000), "2000000000 tags announced");
  expect_error(head22 + block(1, -1), "the number of tags is negative");
}

TEST(GmshBroken, CoordinateOfABinaryFileThatIsNoNumber) {
  std::string content = read_file(data_dir + "blocks_22_binary.msh");
  const std::size_t first = content.find("$Nodes\n") + 10;  // "34\n"
  const double nan = std::numeric_limits<double>::quiet_NaN();
  content.replace(first + 4 + 8, 8, bytes(nan));
  expect_error(content, "a coordinate is not a finite number");
}

// ---- all files cut short, and all files with one byte changed
// ------------------------------------------

class EverySample : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Samples, EverySample,
                         ::testing::Values("blocks_22.msh", "blocks_41.msh", "blocks_22_binary.msh",
                                           "blocks_41_binary.msh", "partitioned_41.msh",
                                           "partitioned_41_binary.msh", "parametric_41.msh",
                                           "mixed_2_41.msh", "solids_1_22_binary.msh",
                                           "solids_3_41.msh"));

TEST_P(EverySample, CutAnywhereIsAnInputError) {
  const std::string content = read_file(data_dir + GetParam());
  const std::size_t whole = content.rfind("$EndElements") + std::string("$EndElements").size();
  for (std::size_t length = 0; length < whole; ++length)
    ASSERT_THROW((void)read_gmsh(content.substr(0, length), "x"), core::InputError) << length;
  EXPECT_NO_THROW((void)read_gmsh(content.substr(0, whole), "x"));
}

TEST_P(EverySample, ChangedBytesGiveAMeshOrAnInputError) {
  const std::string content = read_file(data_dir + GetParam());
  std::mt19937 random(7);
  std::size_t accepted = 0;
  for (std::size_t i = 0; i < content.size(); ++i) {
    for (const int change : {1, 0x80, static_cast<int>(random() % 256)}) {
      std::string spoiled = content;
      spoiled[i] = static_cast<char>(spoiled[i] ^ change);
      try {
        const mesh::Mesh mesh = read_gmsh(spoiled, "x");
        ++accepted;
        for (const Vec3& x : mesh.nodes) ASSERT_TRUE(x.allFinite()) << i;
        for (const mesh::Finding& finding : mesh::check_mesh(mesh))
          ASSERT_NE(finding.flaw, mesh::Flaw::bad_index) << i;
        const mesh::FaceTable faces = mesh::face_table(mesh);
        for (const mesh::Set& set : mesh.sets) (void)mesh::surface_of(mesh, faces, set);
      } catch (const core::InputError&) {
      }
    }
  }
  EXPECT_LT(accepted, 3 * content.size());
}

// ---- files
// --------------------------------------------------------------------------------------------

void expect_file_error(const std::string& path, const std::string& message) {
  try {
    (void)read_gmsh(path);
    ADD_FAILURE() << "accepted " << path;
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.what(), path + ": " + message);
  }
}

TEST(GmshBroken, Files) {
  expect_file_error("/nowhere/at/all.msh", "no such file");
  expect_file_error(data_dir, "is a folder, not a file");
  expect_file_error("/dev/zero", "is not a file");
  const std::string path = ::testing::TempDir() + "/unreadable.msh";
  { std::filesystem::remove(path); }
  std::FILE* const file = std::fopen(path.c_str(), "w");
  ASSERT_NE(file, nullptr);
  std::fclose(file);
  expect_file_error(path, "the file is empty");
  ::chmod(path.c_str(), 0);
  if (::geteuid() != 0) expect_file_error(path, "cannot read: Permission denied");
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace osculate::io
