// Fields come back from VTU files with the bits they were written with.
#include "osculate/io/read_vtk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "osculate/core/error.hpp"
#include "osculate/mesh/generate.hpp"

namespace osculate::io {
namespace {

/// One triangle with a vector at its nodes, and with a field that takes several packets (of 2^18
/// bytes) at its cells if there are many.
std::string written(const std::string& name, bool compress, std::size_t cells) {
  std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh::Block block;
  block.type = cell::CellType::tri3;
  for (std::size_t i = 0; i < cells; ++i)
    block.connectivity.insert(block.connectivity.end(), {0, 1, 2});
  std::vector<double> waves;
  for (std::size_t i = 0; i < cells; ++i) waves.push_back(std::sin(static_cast<double>(i)));
  const std::vector<Field> at_points{vector_field("U", points)},
      at_cells{scalar_field("wave", waves)};
  const std::string path = (std::filesystem::temp_directory_path() / name).string();
  write_vtu(path, {points, {&block, 1}, at_points, at_cells}, compress);
  return path;
}

TEST(ReadVtk, FieldsComeBackWithTheirBits) {
  for (const bool compress : {false, true})
    for (const std::size_t cells : {1u, 70000u}) {
      const std::string path = written("osculate_read_vtk.vtu", compress, cells);
      const std::vector<Field> fields = read_vtu_fields(path);
      ASSERT_GE(fields.size(), 2u);
      EXPECT_EQ(fields.front().name, "U");
      EXPECT_EQ(fields.front().components, 3);
      EXPECT_EQ(fields.front().values, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}));
      EXPECT_EQ(fields.back().name, "wave");
      ASSERT_EQ(fields.back().values.size(), cells);
      for (std::size_t i = 0; i < cells; ++i)
        ASSERT_EQ(fields.back().values[i], std::sin(static_cast<double>(i)));
    }
}

/// Every shorter file is refused; none is read beyond its end.
TEST(ReadVtk, FilesThatEndTooEarlyAreRefused) {
  for (const bool compress : {false, true}) {
    const std::string path = written("osculate_read_vtk_short.vtu", compress, 3);
    std::ifstream file(path, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(file), {}};
    const std::size_t data = whole.find("<AppendedData");
    for (std::size_t size : {std::size_t{0}, data / 2, data + 31, data + 60}) {
      std::ofstream(path, std::ios::binary) << whole.substr(0, size);
      EXPECT_THROW((void)read_vtu_fields(path), core::InputError) << size;
    }
  }
}

TEST(ReadVtk, APvdFileListsItsDataSets) {
  const std::string path =
      (std::filesystem::temp_directory_path() / "osculate_read_vtk.pvd").string();
  write_pvd(path, std::vector<PvdEntry>{{0.25, "bodies", "b_0.vtu"}, {0.5, "floor", "c_1.vtu"}});
  const std::vector<PvdDataSet> sets = read_pvd(path);
  ASSERT_EQ(sets.size(), 2u);
  EXPECT_EQ(sets[0].time, 0.25);
  EXPECT_EQ(sets[0].name, "bodies");
  EXPECT_EQ(sets[1].file, "c_1.vtu");
}

}  // namespace
}  // namespace osculate::io
