// Shells from second-order Gmsh meshes, against generated ones of shell18 cells.
#include <fstream>

#include "osculate/cell/volume_shape.hpp"
#include "osculate/mesh/generate_space.hpp"
#include "osculate/model/analysis.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

constexpr const char* shell =
    "osculate: 1\n"
    "mesh: MESH\n"
    "materials: {m: {neo_hooke: {E: 1000, nu: 0.3}}}\n"
    "sections: [{on: b, material: m, element: solid_shell}]\n"
    "steps:\n"
    "  - {name: s, increments: 2, prescribe: [{on: b.left, ux: 0, uy: 0, uz: 0}],\n"
    "     pressure: [{on: b.top, value: 0.05}], traction: [{on: b.right, tx: 0.3}]}\n";

mesh::Mesh box_of(cell::CellType type) {
  mesh::Mesh mesh;
  mesh::SolidBoxSpec box;
  box.name = "b";
  box.breaks = {{{0, 2}, {0, 1}, {0, 0.1}}};
  box.elements = {{{4}, {3}, {1}}};
  box.type = type;
  mesh::append_solid_box(mesh, box);
  return mesh;
}

/// Every second cell is numbered with y, z, x in the places of x, y, z.
void turn_cells(mesh::Block& block) {
  const auto count = static_cast<std::size_t>(cell::info(block.type).nodes);
  for (std::size_t c = 0; c < block.connectivity.size(); c += 2 * count) {
    const std::vector<Index> old(
        block.connectivity.begin() + static_cast<std::ptrdiff_t>(c),
        block.connectivity.begin() + static_cast<std::ptrdiff_t>(c + count));
    for (int k = 0; k < 27; ++k) {
      const Vec3 p = cell::volume_node(block.type, k);
      for (int from = 0; from < 27; ++from)
        if (cell::volume_node(block.type, from) == Vec3(p.y(), p.z(), p.x()))
          block.connectivity[c + static_cast<std::size_t>(k)] = old[static_cast<std::size_t>(from)];
    }
  }
}

/// Gmsh 2.2, one physical group a set of cells.
void write_gmsh(const mesh::Mesh& mesh, const std::string& path) {
  std::ofstream file(path);
  file.precision(17);
  std::string names, elements;
  int groups = 0, count = 0;
  for (const mesh::Set& set : mesh.sets) {
    if (set.dimension < 2) continue;
    names += fmt::format("{} {} \"{}\"\n", set.dimension, ++groups, set.name);
    for (const mesh::CellRef& ref : set.cells) {
      const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
      const int type = block.type == cell::CellType::hex27 ? 12 : 10;
      elements += fmt::format("{} {} 2 {} {}", ++count, type, groups, groups);
      for (int k = 0; k < cell::info(block.type).nodes; ++k)
        elements += fmt::format(" {}", block.cell(ref.cell)[k] + 1);
      elements += "\n";
    }
  }
  file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n"
       << groups << "\n"
       << names << "$EndPhysicalNames\n$Nodes\n"
       << mesh.nodes.size() << "\n";
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    file << n + 1 << " " << mesh.nodes[n].transpose() << "\n";
  file << "$EndNodes\n$Elements\n" << count << "\n" << elements << "$EndElements\n";
}

struct Answer {
  Built3 built;
  model::AnalysisResult3 result;
};

Answer answer_of(const std::string& mesh) {
  const Description description = parse_model(edited(shell, "MESH", mesh), "model.yaml");
  Answer answer{build3(description, load_mesh(description)), {}};
  answer.result = model::run(answer.built.model, answer.built.options, model::AnalysisObserver3{});
  return answer;
}

TEST(ShellMeshes, SecondOrderHexahedraOfGmshGiveTheAnswerOfShell18) {
  const std::string path = ::testing::TempDir() + "/shell_hex27.msh";
  mesh::Mesh mesh = box_of(cell::CellType::hex27);
  for (mesh::Block& block : mesh.blocks)
    if (block.type == cell::CellType::hex27) turn_cells(block);
  write_gmsh(mesh, path);
  const Answer wanted = answer_of(
      "{generate: {b: {box: {x: [0, 2], y: [0, 1], z: [0, 0.1], elements: [4, 3, 1], type: "
      "shell18}}}}");
  const Answer found = answer_of(path);
  ASSERT_EQ(wanted.result.outcome, solve::Outcome::converged) << wanted.result.message;
  ASSERT_EQ(found.result.outcome, solve::Outcome::converged) << found.result.message;
  EXPECT_EQ(found.result.unknowns, wanted.result.unknowns);
  double largest = 0;
  int met = 0;
  const model::Model3 &a = wanted.built.model, &b = found.built.model;
  for (std::size_t i = 0; i < a.reference.size(); ++i)
    for (std::size_t j = 0; j < b.reference.size(); ++j) {
      if ((a.reference[i] - b.reference[j]).norm() > 1e-9) continue;
      ++met;
      const auto u = [](const Answer& of, std::size_t n) -> Vec3 {
        return of.result.state.u.segment<3>(3 * static_cast<Eigen::Index>(n));
      };
      EXPECT_LT((u(wanted, i) - u(found, j)).norm(), 1e-9);
      largest = std::max(largest, u(wanted, i).norm());
    }
  EXPECT_EQ(met, static_cast<int>(a.reference.size()));
  EXPECT_GT(largest, 0.05);
}

TEST(ShellMeshes, NeighboursThatKeepTheNodesAreRefused) {
  const std::string model =
      "osculate: 1\n"
      "mesh: {generate: {b: {box: {x: [0, 2], y: [0, 1], z: [0, 0.1], elements: [4, 3, 1], type: "
      "hex27}}}}\n"
      "materials: {m: {neo_hooke: {E: 1000, nu: 0.3}}}\n"
      "sections: [{on: b, material: m, element: solid_shell}]\n"
      "steps: [{name: s, increments: 1, prescribe: [{on: b.left, ux: 0}]}]\n";
  const Description description = parse_model(model, "model.yaml");
  mesh::Mesh mesh = load_mesh(description);
  mesh.sets.push_back(*mesh.find_set("b"));
  mesh.sets.back().name = "half";
  mesh.sets.back().cells.resize(6);
  const Description half = parse_model(edited(model, "on: b,", "on: half,"), "model.yaml");
  try {
    (void)build3(half, mesh);
    ADD_FAILURE();
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("halfway through the thickness of a shell, belongs"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace osculate::deck
