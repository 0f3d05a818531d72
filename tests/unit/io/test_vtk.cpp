#include "osculate/io/vtk.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <limits>

#include "osculate/io/atomic_file.hpp"
#include "osculate/io/gmsh.hpp"
#include "osculate/mesh/generate.hpp"

namespace osculate::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// ---- a reader that knows nothing of the writer
// -----------------------------------------------------

std::string attribute(const std::string& tag, const std::string& name) {
  const std::size_t begin = tag.find(" " + name + "=\"");
  if (begin == std::string::npos) return {};
  const std::size_t value = begin + name.size() + 3;
  return tag.substr(value, tag.find('"', value) - value);
}

/// The first tag that holds the text.
std::string tag_with(const std::string& content, const std::string& text) {
  const std::size_t at = content.find(text);
  if (at == std::string::npos) return {};
  const std::size_t begin = content.rfind('<', at);
  return content.substr(begin, content.find('>', at) - begin);
}

std::uint64_t u64(const std::string& data, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t k = 0; k < 8; ++k)
    value |= std::uint64_t{static_cast<unsigned char>(data.at(at + k))} << (8 * k);
  return value;
}

std::string unpacked(const std::string& data, std::size_t at) {
  const std::uint64_t blocks = u64(data, at);
  const std::uint64_t size = u64(data, at + 8);
  const std::uint64_t last = u64(data, at + 16);
  std::size_t place = at + 24 + 8 * blocks;
  std::string result;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::uint64_t used = u64(data, at + 24 + 8 * b);
    uLongf expected = b + 1 == blocks && last != 0 ? last : size;
    std::string block(expected, '\0');
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(block.data()), &expected,
                         reinterpret_cast<const Bytef*>(data.data() + place), used),
              Z_OK);
    EXPECT_EQ(expected, block.size());
    result += block;
    place += used;
  }
  return result;
}

template <class T>
std::vector<T> array(const std::string& content, const std::string& name, const char* type) {
  const std::string tag = tag_with(content, "Name=\"" + name + "\"");
  EXPECT_EQ(attribute(tag, "type"), type) << name;
  EXPECT_EQ(attribute(tag, "format"), "appended");
  const std::size_t start = content.find('_', content.find("<AppendedData encoding=\"raw\">")) + 1;
  const std::size_t at = start + std::stoul(attribute(tag, "offset"));
  const std::string file = tag_with(content, "type=\"UnstructuredGrid\"");
  EXPECT_EQ(attribute(file, "header_type"), "UInt64");
  EXPECT_EQ(attribute(file, "byte_order"), "LittleEndian");
  const bool is_packed = attribute(file, "compressor") == "vtkZLibDataCompressor";
  const std::string data =
      is_packed ? unpacked(content, at) : content.substr(at + 8, u64(content, at));
  std::vector<T> values(data.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), data.data(), values.size() * sizeof(T));
  return values;
}

struct Sample {
  mesh::Mesh mesh;
  std::vector<Field> points, cells;
};

Sample sample(int n) {
  Sample s;
  mesh::BoxSpec spec;
  spec.name = "b";
  spec.x = {0, 2};
  spec.y = {0, 1};
  spec.nx = spec.ny = {n};
  spec.type = cell::CellType::quad8;
  append_box(s.mesh, spec);
  Field u{"U", 3, {}, {}};
  for (std::size_t i = 0; i < 3 * s.mesh.nodes.size(); ++i)
    u.values.push_back(std::sin(static_cast<double>(i)));
  u.values[1] = std::numeric_limits<double>::quiet_NaN();
  s.points.push_back(u);
  std::size_t cells = 0;
  for (const mesh::Block& block : s.mesh.blocks) cells += static_cast<std::size_t>(block.size());
  s.cells.push_back({"S<\"&", 2, std::vector<double>(2 * cells, 0.25), {"XX", "YY"}});
  return s;
}

VtuData data_of(const Sample& s) { return {s.mesh.nodes, s.mesh.blocks, s.points, s.cells}; }

std::string temp(const std::string& name) { return ::testing::TempDir() + "/" + name; }

class Vtu : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Packed, Vtu, ::testing::Bool());

TEST_P(Vtu, EverythingIsReadBack) {
  // 150 x 150: several packets of 256 kB, the last one incomplete
  for (const int n : {1, 3, 150}) {
    const Sample s = sample(n);
    const std::string path = temp(GetParam() ? "everything_packed.vtu" : "everything.vtu");
    write_vtu(path, data_of(s), GetParam());
    const std::string content = read_file(path);
    const std::vector<double> points = array<double>(content, "Points", "Float64");
    ASSERT_EQ(points.size(), 3 * s.mesh.nodes.size());
    EXPECT_EQ(std::memcmp(points.data(), s.mesh.nodes.data(), 8 * points.size()), 0);
    const std::vector<double> u = array<double>(content, "U", "Float64");
    ASSERT_EQ(u.size(), s.points[0].values.size());
    EXPECT_EQ(std::memcmp(u.data(), s.points[0].values.data(), 8 * u.size()), 0);
    EXPECT_EQ(array<double>(content, "S&lt;&quot;&amp;", "Float64"), s.cells[0].values);
    std::vector<std::int64_t> connectivity;
    std::vector<std::int64_t> offsets;
    std::vector<std::uint8_t> types;
    for (const mesh::Block& block : s.mesh.blocks) {
      const bool is_area = block.type == cell::CellType::quad8;
      connectivity.insert(connectivity.end(), block.connectivity.begin(), block.connectivity.end());
      for (Index c = 0; c < block.size(); ++c) {
        offsets.push_back((offsets.empty() ? 0 : offsets.back()) + (is_area ? 8 : 3));
        types.push_back(is_area ? 23 : 21);
      }
    }
    EXPECT_EQ(array<std::int64_t>(content, "connectivity", "Int64"), connectivity);
    EXPECT_EQ(array<std::int64_t>(content, "offsets", "Int64"), offsets);
    EXPECT_EQ(array<std::uint8_t>(content, "types", "UInt8"), types);
    const std::string piece = tag_with(content, "NumberOfCells");
    EXPECT_EQ(attribute(piece, "NumberOfPoints"), std::to_string(s.mesh.nodes.size()));
    EXPECT_EQ(attribute(piece, "NumberOfCells"), std::to_string(types.size()));
    std::filesystem::remove(path);
  }
}

TEST_P(Vtu, ArraysOfExactlyOnePacketAreReadBack) {
  // 2^18 bytes of values = 2^15 points
  const std::vector<Vec3> points(std::size_t{1} << 15U, Vec3(1, 2, 3));
  const std::vector<Field> fields{{"f", 1, std::vector<double>(points.size(), 0.5), {}}};
  const std::string path = temp(GetParam() ? "packet_packed.vtu" : "packet.vtu");
  write_vtu(path, {points, {}, fields, {}}, GetParam());
  const std::string content = read_file(path);
  EXPECT_EQ(array<double>(content, "f", "Float64"), fields[0].values);
  EXPECT_TRUE(array<std::int64_t>(content, "offsets", "Int64").empty());
  std::filesystem::remove(path);
}

TEST(VtuFile, PackingMakesItSmaller) {
  const Sample s = sample(100);
  const std::string path = temp("size.vtu");
  write_vtu(path, data_of(s), false);
  const auto plain = std::filesystem::file_size(path);
  write_vtu(path, data_of(s), true);
  EXPECT_LT(std::filesystem::file_size(path), plain / 2);
  std::filesystem::remove(path);
}

TEST(VtuFile, FieldsThatDoNotFitAreADefect) {
  Sample s = sample(1);
  s.points[0].values.pop_back();
  const std::string path = temp("never.vtu");
  EXPECT_THROW(write_vtu(path, data_of(s)), std::invalid_argument);
  s = sample(1);
  s.cells[0].component_names.pop_back();
  EXPECT_THROW(write_vtu(path, data_of(s)), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(VtuFile, ComponentsHaveNames) {
  const std::string path = temp("names.vtu");
  write_vtu(path, data_of(sample(1)));
  const std::string tag = tag_with(read_file(path), "ComponentName0");
  EXPECT_EQ(attribute(tag, "ComponentName0"), "XX");
  EXPECT_EQ(attribute(tag, "ComponentName1"), "YY");
  std::filesystem::remove(path);
}

// ---- collections
// -------------------------------------------------------------------------------------

TEST(Pvd, PartsAreNumbered) {
  const std::string path = temp("results.pvd");
  const std::vector<PvdEntry> entries{{0, "body", "r/0.vtu"},
                                      {0, "a&b", "r/0c.vtu"},
                                      {0.1, "body", "r/1.vtu"},
                                      {0.1, "a&b", "r/1c.vtu"}};
  write_pvd(path, entries);
  EXPECT_EQ(
      read_file(path),
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n"
      "    <DataSet timestep=\"0\" group=\"\" part=\"0\" name=\"body\" file=\"r/0.vtu\"/>\n"
      "    <DataSet timestep=\"0\" group=\"\" part=\"1\" name=\"a&amp;b\" file=\"r/0c.vtu\"/>\n"
      "    <DataSet timestep=\"0.10000000000000001\" group=\"\" part=\"0\" name=\"body\" "
      "file=\"r/1.vtu\"/>\n"
      "    <DataSet timestep=\"0.10000000000000001\" group=\"\" part=\"1\" name=\"a&amp;b\" "
      "file=\"r/1c.vtu\"/>\n"
      "  </Collection>\n"
      "</VTKFile>\n");
  std::filesystem::remove(path);
}

// ---- failures of the disk
// ----------------------------------------------------------------------------

TEST(AtomicFile, OldContentStaysUntilCommit) {
  const std::string path = temp("atomic.txt");
  write_file(path, "old");
  {
    AtomicFile file(path);
    file.write("new");
    EXPECT_EQ(read_file(path), "old");
  }
  EXPECT_EQ(read_file(path), "old");
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  {
    AtomicFile file(path);
    file.write("new");
    file.commit();
    EXPECT_THROW(file.write("more"), WriteError);
    EXPECT_THROW(file.commit(), WriteError);
  }
  EXPECT_EQ(read_file(path), "new");
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  std::filesystem::remove(path);
}

TEST(AtomicFile, ReasonsAreNamed) {
  try {
    write_file("/nowhere/x.vtu", "data");
    ADD_FAILURE();
  } catch (const WriteError& error) {
    EXPECT_STREQ(error.what(), "/nowhere/x.vtu: cannot write: No such file or directory");
  }
  const std::string folder = temp("folder.vtu");
  std::filesystem::create_directory(folder);
  try {
    write_file(folder, "data");
    ADD_FAILURE();
  } catch (const WriteError& error) {
    EXPECT_EQ(std::string(error.what()), folder + ": cannot replace: Is a directory");
  }
  EXPECT_FALSE(std::filesystem::exists(folder + ".part"));
  std::filesystem::remove(folder);
}

/// Files of this process cannot grow beyond `bytes` while it lives: a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit small{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit old_{};
  void (*handler_)(int) = nullptr;
};

TEST(AtomicFile, FullDiskKeepsTheOldFile) {
  const Sample s = sample(50);
  const std::string path = temp("full.vtu");
  write_file(path, "old");
  {
    const FullDisk full(100000);
    EXPECT_THROW(write_vtu(path, data_of(s)), WriteError);
  }
  EXPECT_EQ(read_file(path), "old");
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace osculate::io
