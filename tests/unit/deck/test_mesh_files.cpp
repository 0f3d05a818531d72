#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/mesh/check.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// files.yaml with other files.
std::string files_model(const std::string& files) {
  std::string text = test_file("files.yaml");
  const std::size_t begin = text.find("files: ") + 7;
  return text.replace(begin, text.find('\n', begin) - begin, files);
}

/// MSH 2.2 of a box [0, 4] x [0, 2] in cells of size 1 (nodes numbered by tens), with groups
/// block, bottom and top.
std::string msh(double scale = 1) {
  std::string nodes, cells;
  int count = 0;
  const auto tag = [](int i, int j) { return std::to_string(10 * (5 * j + i + 1)); };
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 5; ++i)
      nodes +=
          tag(i, j) + " " + std::to_string(scale * i) + " " + std::to_string(scale * j) + " 0\n";
  for (int i = 0; i < 4; ++i)
    for (const int j : {0, 2})
      cells += std::to_string(++count) + " 1 2 " + (j == 0 ? "2 2 " : "3 3 ") + tag(i, j) + " " +
               tag(i + 1, j) + "\n";
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 4; ++i)
      cells += std::to_string(++count) + " 3 2 1 1 " + tag(i, j) + " " + tag(i + 1, j) + " " +
               tag(i + 1, j + 1) + " " + tag(i, j + 1) + "\n";
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 \"block\"\n1 2 "
         "\"bottom\"\n1 3 \"top\"\n$EndPhysicalNames\n$Nodes\n15\n" +
         nodes + "$EndNodes\n$Elements\n" + std::to_string(count) + "\n" + cells + "$EndElements\n";
}

class MeshFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ + "box.msh") << msh();
    std::ofstream(folder_ + "metres.msh") << msh(0.001);
  }
  [[nodiscard]] Description read(const std::string& text) const {
    return parse_model(text, folder_ + "model.yaml");
  }
  [[nodiscard]] std::string refused(const std::string& text) const {
    try {
      const Description d = read(text);
      (void)build_any(d, load_mesh(d));
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return {};
  }
  std::string folder_ = ::testing::TempDir() + "osculate_mesh_files/";
};

TEST_F(MeshFiles, SeveralAndGeneratedPartsInOneModel) {
  const Description d = read(test_file("files.yaml"));
  const Built built = build(d, load_mesh(d));
  const mesh::Mesh& mesh = built.model.mesh;
  EXPECT_THAT(mesh::check_mesh(mesh), IsEmpty());
  EXPECT_EQ(mesh.nodes.size(), 7u + 15 + 15);
  EXPECT_EQ(mesh.find_set("low")->cells, mesh.find_set("low.block")->cells);
  EXPECT_EQ(mesh.find_set("rail")->cells.size(), 6u);
  // Turned upside down: what was its top stands on the other one.
  for (const Index n : mesh.find_set("high.top")->nodes)
    EXPECT_NEAR(mesh.nodes[static_cast<std::size_t>(n)].y(), 2, 1e-12);
  for (const Index n : mesh.find_set("high.bottom")->nodes)
    EXPECT_NEAR(mesh.nodes[static_cast<std::size_t>(n)].y(), 4, 1e-12);
}

TEST_F(MeshFiles, Mistakes) {
  const auto refuses = [this](const std::string& files, const std::string& message) {
    EXPECT_THAT(refused(files_model(files)), HasSubstr("model.yaml:4: mesh.files" + message));
  };
  refuses("{low: box.msh, high: box.msh, rail: box.msh}",
          ".rail: mesh 'rail': there is already a set of that name");
  refuses("{low: box.msh, high: none.msh}", ".high: ");
  refuses("{low: box.msh, high: box.step}",
          ".high: expected a mesh file, Gmsh (.msh), Abaqus or CalculiX (.inp) or STL (.stl), got "
          "'box.step'");
  refuses("{low: box.msh, high: {file: box.msh, scale: 0}}", ".high.scale: must be > 0, got 0");
  refuses("{low: box.msh, high: {move: [1, 1]}}", ".high: ");
  refuses("{low: box.msh, low.top: box.msh}", ": 'low.top' cannot be a name");
  EXPECT_THAT(refused(files_model("{low: box.msh}")), HasSubstr("unknown set 'high'"));
  EXPECT_THAT(refused("osculate: 1\nmesh: {}\nsteps: [{name: s, increments: 1}]\n"),
              HasSubstr("model.yaml:2: mesh: "));
}

TEST_F(MeshFiles, AFileInSpaceInAPlaneModel) {
  std::ofstream(folder_ + "tet.msh")
      << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
         "$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n";
  EXPECT_THAT(
      refused(files_model("{low: box.msh, high: box.msh, nut: tet.msh}")),
      HasSubstr("model.yaml:4: mesh.files.nut: the mesh of 'tet.msh' has volume cells, and this "
                "model is plane: no section has the element solid or solid_shell"));
  // It may be moved out of the plane too.
  EXPECT_THAT(refused(files_model("{low: box.msh, high: {file: box.msh, move: [0, 2, 1]}}")),
              HasSubstr("mesh.files.high.file: node 10 has z = 1; plane problems need z = 0"));
}

}  // namespace
}  // namespace osculate::deck
