#include "osculate/io/vtk.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zlib.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <limits>

#include "osculate/io/atomic_file.hpp"
#include "osculate/io/gmsh.hpp"
#include "osculate/mesh/generate.hpp"
#include "osculate/mesh/generate_space.hpp"

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

TEST(VtuFile, BytesDoNotDependOnThreads) {
  const Sample s = sample(150);  // fields of several packets, which several threads pack
  ASSERT_GT(s.points[0].values.size() * sizeof(double), std::size_t{4} << 18U);
  const std::string path = temp("threads.vtu");
  write_vtu(path, data_of(s), true, 1);
  const std::string by_one = read_file(path);
  write_vtu(path, data_of(s), true, 3);
  EXPECT_EQ(read_file(path), by_one);
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

// ---- in space -----------------------------------------------------------------------------------

/// Nodes of VTK's quadratic cells between which corners they lie, as in the format's description.
using Edges = std::vector<std::pair<int, int>>;
const Edges hex_edges{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                      {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
const Edges wedge_edges{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
const Edges tet_edges{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

TEST(VtuFile, VolumesAreInTheOrderOfVtk) {
  struct Case {
    cell::CellType type;
    int vtk, corners, nodes;
    Edges edges;
  };
  using enum cell::CellType;
  const std::vector<Case> cases{{tet4, 10, 4, 4, {}},          {tet10, 24, 4, 10, tet_edges},
                                {wedge6, 13, 6, 6, {}},        {wedge15, 26, 6, 15, wedge_edges},
                                {hex8, 12, 8, 8, {}},          {hex20, 25, 8, 20, hex_edges},
                                {hex27, 29, 8, 27, hex_edges}, {shell18, 12, 8, 8, {}}};
  // middle nodes of triquadratic hexahedra: -x, +x, -y, +y, -z, +z
  const std::array<std::array<int, 4>, 6> sides{
      {{0, 3, 4, 7}, {1, 2, 5, 6}, {0, 1, 4, 5}, {2, 3, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}}};
  for (const Case& c : cases) {
    mesh::SolidBoxSpec spec;
    spec.name = "b";
    spec.breaks = {{{0, 2}, {0, 1}, {0, 0.5}}};
    spec.elements = {{{1}, {1}, {1}}};
    spec.type = c.type;
    mesh::Mesh mesh;
    append_solid_box(mesh, spec);
    const std::string path = temp("volumes.vtu");
    write_vtu(path, {mesh.nodes, std::span(mesh.blocks).first(1), {}, {}});
    const std::string content = read_file(path);
    const auto cells = array<std::int64_t>(content, "connectivity", "Int64");
    const auto offsets = array<std::int64_t>(content, "offsets", "Int64");
    const auto count = static_cast<std::size_t>(mesh.blocks[0].size());
    ASSERT_EQ(offsets.size(), count);
    ASSERT_EQ(cells.size(), count * static_cast<std::size_t>(c.nodes));
    EXPECT_EQ(offsets.back(), static_cast<std::int64_t>(cells.size()));
    for (const std::uint8_t type : array<std::uint8_t>(content, "types", "UInt8"))
      EXPECT_EQ(type, c.vtk);
    for (std::size_t i = 0; i < count; ++i) {
      const auto x = [&](int k) -> const Vec3& {
        return mesh.nodes[static_cast<std::size_t>(
            cells[i * static_cast<std::size_t>(c.nodes) + static_cast<std::size_t>(k)])];
      };
      for (std::size_t e = 0; e < c.edges.size(); ++e)
        EXPECT_EQ(x(c.corners + static_cast<int>(e)),
                  Vec3(0.5 * (x(c.edges[e].first) + x(c.edges[e].second))));
      const Vec3 a = x(1) - x(0);
      const Vec3 b = x(c.corners == 8 ? 3 : 2) - x(0);
      const Vec3 up = x(c.corners == 8 ? 4 : 3) - x(0);
      EXPECT_GT(a.cross(b).dot(up), 0);
      if (c.nodes != 27) continue;
      for (std::size_t s = 0; s < 6; ++s) {
        Vec3 mean = Vec3::Zero();
        for (const int k : sides[s]) mean += 0.25 * x(k);
        EXPECT_EQ(x(20 + static_cast<int>(s)), mean);
      }
      EXPECT_EQ(x(26), Vec3(1, 0.5, 0.25));
    }
    std::filesystem::remove(path);
  }
}

TEST(VtuFile, NamesAreTheNumbersOfTheirBytes) {
  const Sample s = sample(1);
  VtuData data = data_of(s);
  const std::array names{NameList{"Bodies", {"ab", "", "\xc3\xa4"}}};
  data.names = names;
  const std::string path = temp("names.vtu");
  write_vtu(path, data);
  const std::string content = read_file(path);
  EXPECT_THAT(content, HasSubstr("<FieldData>"));
  EXPECT_THAT(content, HasSubstr("<DataArray type=\"String\" Name=\"Bodies\" NumberOfTuples=\"3\" "
                                 "format=\"ascii\">97 98 0 0 195 164 0 </DataArray>"));
  std::filesystem::remove(path);
}

TEST(VtuFields, VectorsAndTensorsNameTheirComponents) {
  const std::vector<Vec3> u{{1, 2, 3}, {4, 5, 6}};
  const Field vector = vector_field("U", u);
  EXPECT_EQ(vector.components, 3);
  EXPECT_THAT(vector.values, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(vector.component_names, ElementsAre("X", "Y", "Z"));
  const std::vector<std::array<double, 6>> s{{1, 2, 3, 4, 5, 6}};
  const Field tensor = tensor_field("S", s);
  EXPECT_EQ(tensor.components, 6);
  EXPECT_THAT(tensor.values, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(tensor.component_names, ElementsAre("XX", "YY", "ZZ", "XY", "YZ", "XZ"));
  EXPECT_EQ(scalar_field("p", {7}).components, 1);
}

TEST(SurfacePart, HasItsOwnNodesAndTheirFields) {
  mesh::Mesh mesh;
  mesh::SolidBoxSpec spec;
  spec.name = "b";
  spec.breaks = {{{0, 2}, {0, 1}, {0, 1}}};
  spec.elements = {{{2}, {1}, {1}}};
  spec.type = cell::CellType::wedge6;
  append_solid_box(mesh, spec);
  const mesh::Surface surface = surface_facets(mesh, *mesh.find_set("b"));
  std::vector<mesh::SurfaceFacet> chosen;  // the right side and the top
  for (const mesh::SurfaceFacet& facet : surface.facets) {
    const auto on = [&](int axis, double value) {
      return std::ranges::all_of(facet.nodes(), [&](Index n) {
        return mesh.nodes[static_cast<std::size_t>(n)][axis] == value;
      });
    };
    if (on(0, 2) || on(2, 1)) chosen.push_back(facet);
  }
  const SurfacePart part = surface_part(mesh.nodes, chosen, std::vector<Index>{0, 8});
  EXPECT_THAT(part.nodes, ElementsAre(0, 2, 5, 6, 7, 8, 9, 10, 11));
  ASSERT_EQ(part.blocks.size(), 3U);
  EXPECT_EQ(part.blocks[0].type, cell::CellType::point1);
  EXPECT_THAT(part.blocks[0].connectivity, ElementsAre(0));
  EXPECT_EQ(part.blocks[1].type, cell::CellType::tri3);
  EXPECT_EQ(part.blocks[1].size(), 4);
  EXPECT_EQ(part.blocks[2].type, cell::CellType::quad4);
  EXPECT_EQ(part.blocks[2].size(), 1);
  std::size_t next = 0;
  for (const mesh::Block& block : part.blocks)
    for (const mesh::SurfaceFacet& facet : chosen) {
      if (facet.type != block.type) continue;
      for (const Index node : facet.nodes())
        EXPECT_EQ(part.points[static_cast<std::size_t>(
                      block.connectivity[next++ % block.connectivity.size()])],
                  mesh.nodes[static_cast<std::size_t>(node)]);
      if (next == block.connectivity.size()) next = 0;
    }
  const Field whole = vector_field("X", mesh.nodes);
  const Field field = on_part(whole, part);
  EXPECT_EQ(field.components, 3);
  EXPECT_EQ(field.values, vector_field("X", part.points).values);
  const std::string path = temp("surface.vtu");
  write_vtu(path, {part.points, part.blocks, std::array{field}, {}});
  EXPECT_THAT(array<std::uint8_t>(read_file(path), "types", "UInt8"),
              ElementsAre(1, 5, 5, 5, 5, 9));
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

TEST(Pvd, GrowsInItsPlaceAndIsWholeAfterEachFrame) {
  const std::string path = temp("grown.pvd"), whole = temp("whole.pvd");
  const std::vector<PvdEntry> entries{
      {0, "body", "0.vtu"}, {1, "body", "1.vtu"}, {1, "c", "1c.vtu"}, {2, "body", "2.vtu"}};
  const std::span all(entries);
  PvdFile grown(path, all.first(1));
  std::filesystem::create_hard_link(path, path + ".same");  // a new file would not be seen there
  for (const std::size_t until : {3u, 4u}) {
    grown.add(all.subspan(until == 3 ? 1 : 3, until == 3 ? 2 : 1));
    write_pvd(whole, all.first(until));
    EXPECT_EQ(read_file(path + ".same"), read_file(whole));
  }
  for (const std::string& name : {path, whole, path + ".same"}) std::filesystem::remove(name);
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
    EXPECT_EQ(std::string(error.what()), folder + ": cannot write: Is a directory");
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

TEST(Pvd, StaysWholeOnAFullDisk) {
  const std::string path = temp("full.pvd");
  PvdFile grown(path, std::vector<PvdEntry>{{0, "body", "0.vtu"}});
  const std::string before = read_file(path);
  const std::vector<PvdEntry> more{{1, "body", "1.vtu"}, {1, "c", "1c.vtu"}};
  {
    const FullDisk full(before.size() + 20);
    EXPECT_THROW(grown.add(more), WriteError);
  }
  EXPECT_EQ(read_file(path), before);
  grown.add(more);
  EXPECT_THAT(read_file(path), ::testing::EndsWith("</Collection>\n</VTKFile>\n"));
  std::filesystem::remove(path);
}

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
