#include "osculate/io/vtk.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <memory>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "osculate/core/pieces.hpp"
#include "osculate/io/atomic_file.hpp"

namespace osculate::io {
namespace {

constexpr std::size_t packet = std::size_t{1} << 18U;

void append_u64(std::string& out, std::uint64_t value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// An array of the appended part of a file.
struct Array {
  const char* data = nullptr;
  std::size_t size = 0;
  std::size_t place = 0;  ///< in the header, where its offset belongs
};

/// What a file says before the numbers, and where these are.
struct Document {
  std::string header;
  std::vector<Array> arrays;
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
};

template <class T>
void add_array(Document& doc, const char* type, const std::string& attributes,
               std::span<const T> values) {
  doc.header += fmt::format("        <DataArray type=\"{}\" {} format=\"appended\" offset=\"", type,
                            attributes);
  doc.arrays.push_back(
      {reinterpret_cast<const char*>(values.data()), values.size_bytes(), doc.header.size()});
  doc.header += "\"/>\n";
}

/// Every array behind its size.
std::vector<std::string> plain(std::span<const Array> arrays) {
  std::vector<std::string> out(arrays.size());
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    append_u64(out[a], arrays[a].size);
    if (arrays[a].size > 0) out[a].append(arrays[a].data, arrays[a].size);
  }
  return out;
}

using Compressor = std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)>;

/// One after the other, as zlib has it.
void pack(std::span<const std::string_view> parts, std::span<std::string> out) {
  constexpr int fastest = 1;
  const Compressor compressor(libdeflate_alloc_compressor(fastest), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string room;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    room.resize(libdeflate_zlib_compress_bound(compressor.get(), parts[i].size()));
    const std::size_t size = libdeflate_zlib_compress(compressor.get(), parts[i].data(),
                                                      parts[i].size(), room.data(), room.size());
    out[i].assign(room, 0, size);
  }
}

/// Every array as packets of zlib, VTK's table of their sizes before them.
std::vector<std::string> packed(std::span<const Array> arrays, int threads) {
  std::vector<std::string_view> parts;
  for (const Array& array : arrays)
    for (std::size_t at = 0; at < array.size; at += packet)
      parts.emplace_back(array.data + at, std::min(packet, array.size - at));
  std::vector<std::string> packets(parts.size());
  constexpr std::size_t at_a_time = 4;  // 4 ms, to which a thread and a compressor add 0.1
  core::for_pieces(parts.size(), at_a_time, threads, [&](std::size_t begin, std::size_t end) {
    pack(std::span(parts).subspan(begin, end - begin),
         std::span(packets).subspan(begin, end - begin));
  });
  std::vector<std::string> out(arrays.size());
  for (std::size_t a = 0, next = 0; a < arrays.size(); ++a) {
    const std::size_t count = (arrays[a].size + packet - 1) / packet, end = next + count;
    append_u64(out[a], count);
    append_u64(out[a], packet);
    append_u64(out[a], arrays[a].size % packet);
    for (std::size_t i = next; i < end; ++i) append_u64(out[a], packets[i].size());
    for (; next < end; ++next) out[a] += std::exchange(packets[next], {});
  }
  return out;
}

/// The header, with the offset of each array put into its place.
std::string with_offsets(const Document& doc, std::span<const std::string> arrays) {
  std::string out;
  std::size_t from = 0;
  std::uint64_t offset = 0;
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    out.append(doc.header, from, doc.arrays[a].place - from);
    out += fmt::to_string(offset);
    offset += arrays[a].size();
    from = doc.arrays[a].place;
  }
  return out.append(doc.header, from);
}

void add_fields(Document& doc, const char* element, std::span<const Field> fields,
                std::size_t tuples) {
  doc.header += fmt::format("      <{}>\n", element);
  for (const Field& field : fields) {
    const bool fits = field.components >= 1 &&
                      field.values.size() == tuples * static_cast<std::size_t>(field.components);
    const bool named = field.component_names.empty() ||
                       field.component_names.size() == static_cast<std::size_t>(field.components);
    if (!fits || !named)
      throw std::invalid_argument(fmt::format("field '{}' has {} values for {} tuples of {}",
                                              field.name, field.values.size(), tuples,
                                              field.components));
    std::string attributes = fmt::format("Name=\"{}\" NumberOfComponents=\"{}\"",
                                         escape_xml(field.name), field.components);
    for (std::size_t k = 0; k < field.component_names.size(); ++k)
      attributes += fmt::format(" ComponentName{}=\"{}\"", k, escape_xml(field.component_names[k]));
    add_array<double>(doc, "Float64", attributes, field.values);
  }
  doc.header += fmt::format("      </{}>\n", element);
}

/// Texts as VTK has them: the numbers of their bytes, a zero behind each text.
void add_names(Document& doc, std::span<const NameList> lists) {
  if (lists.empty()) return;
  doc.header += "    <FieldData>\n";
  for (const NameList& list : lists) {
    doc.header += fmt::format(
        "      <DataArray type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">",
        escape_xml(list.name), list.texts.size());
    for (const std::string& text : list.texts) {
      for (const char c : text) doc.header += fmt::format("{} ", static_cast<unsigned char>(c));
      doc.header += "0 ";
    }
    doc.header += "</DataArray>\n";
  }
  doc.header += "    </FieldData>\n";
}

void add_cells(Document& doc, std::span<const mesh::Block> blocks) {
  for (const mesh::Block& block : blocks) {
    const cell::CellInfo& info = cell::info(block.type);
    const std::span<const std::int8_t> order = cell::vtk_nodes(block.type);
    for (Index c = 0; c < block.size(); ++c) {
      for (const std::int8_t k : order) doc.connectivity.push_back(block.cell(c)[k]);
      const std::int64_t last = doc.offsets.empty() ? 0 : doc.offsets.back();
      doc.offsets.push_back(last + static_cast<std::int64_t>(order.size()));
      doc.types.push_back(static_cast<std::uint8_t>(info.vtk_type));
    }
  }
  doc.header += "      <Cells>\n";
  add_array<std::int64_t>(doc, "Int64", "Name=\"connectivity\"", doc.connectivity);
  add_array<std::int64_t>(doc, "Int64", "Name=\"offsets\"", doc.offsets);
  add_array<std::uint8_t>(doc, "UInt8", "Name=\"types\"", doc.types);
  doc.header += "      </Cells>\n";
}

std::size_t cell_count(std::span<const mesh::Block> blocks) {
  std::size_t count = 0;
  for (const mesh::Block& block : blocks) count += static_cast<std::size_t>(block.size());
  return count;
}

}  // namespace

std::string escape_xml(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&apos;";
        break;
      default:
        result += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    }
  }
  return result;
}

void write_vtu(const std::string& path, const VtuData& data, bool compress, int threads) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const std::size_t cells = cell_count(data.blocks);
  Document doc;
  doc.header = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
      "header_type=\"UInt64\"{}>\n"
      "  <UnstructuredGrid>\n",
      std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian",
      compress ? " compressor=\"vtkZLibDataCompressor\"" : "");
  add_names(doc, data.names);
  doc.header += fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                            data.points.size(), cells);
  add_fields(doc, "PointData", data.point_fields, data.points.size());
  add_fields(doc, "CellData", data.cell_fields, cells);
  doc.header += "      <Points>\n";
  const double* const coordinates = data.points.empty() ? nullptr : data.points[0].data();
  add_array<double>(doc, "Float64", "Name=\"Points\" NumberOfComponents=\"3\"",
                    {coordinates, 3 * data.points.size()});
  doc.header += "      </Points>\n";
  add_cells(doc, data.blocks);
  doc.header += "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";
  const std::vector<std::string> arrays =
      compress ? packed(doc.arrays, threads) : plain(doc.arrays);
  AtomicFile file(path);
  file.write(with_offsets(doc, arrays));
  for (const std::string& array : arrays) file.write(array);
  file.write("\n  </AppendedData>\n</VTKFile>\n");
  file.commit();
}

Field scalar_field(std::string name, std::vector<double> values) {
  return {std::move(name), 1, std::move(values), {}};
}

Field vector_field(std::string name, std::span<const Vec3> values) {
  Field field{std::move(name), 3, {}, {"X", "Y", "Z"}};
  field.values.reserve(3 * values.size());
  for (const Vec3& v : values) field.values.insert(field.values.end(), {v.x(), v.y(), v.z()});
  return field;
}

Field tensor_field(std::string name, std::span<const std::array<double, 6>> values) {
  Field field{std::move(name), 6, {}, {"XX", "YY", "ZZ", "XY", "YZ", "XZ"}};
  field.values.reserve(6 * values.size());
  for (const auto& v : values) field.values.insert(field.values.end(), v.begin(), v.end());
  return field;
}

SurfacePart surface_part(std::span<const Vec3> coordinates,
                         std::span<const mesh::SurfaceFacet> facets, std::span<const Index> nodes) {
  SurfacePart part;
  part.nodes.assign(nodes.begin(), nodes.end());
  for (const mesh::SurfaceFacet& facet : facets)
    part.nodes.insert(part.nodes.end(), facet.nodes().begin(), facet.nodes().end());
  std::sort(part.nodes.begin(), part.nodes.end());
  part.nodes.erase(std::unique(part.nodes.begin(), part.nodes.end()), part.nodes.end());
  std::vector<Index> place(coordinates.size(), -1);
  for (const Index node : part.nodes) {
    place[static_cast<std::size_t>(node)] = static_cast<Index>(part.points.size());
    part.points.push_back(coordinates[static_cast<std::size_t>(node)]);
  }
  std::map<cell::CellType, mesh::Block> blocks;
  std::vector<bool> used(coordinates.size());
  for (const mesh::SurfaceFacet& facet : facets) {
    mesh::Block& block = blocks.try_emplace(facet.type, mesh::Block{facet.type, {}}).first->second;
    for (const Index node : facet.nodes()) {
      block.connectivity.push_back(place[static_cast<std::size_t>(node)]);
      used[static_cast<std::size_t>(node)] = true;
    }
  }
  mesh::Block points{cell::CellType::point1, {}};
  for (const Index node : part.nodes)
    if (!used[static_cast<std::size_t>(node)])
      points.connectivity.push_back(place[static_cast<std::size_t>(node)]);
  if (!points.connectivity.empty()) part.blocks.push_back(std::move(points));
  for (auto& entry : blocks) part.blocks.push_back(std::move(entry.second));
  return part;
}

Field on_part(const Field& field, const SurfacePart& part) {
  Field out{field.name, field.components, {}, field.component_names};
  for (const Index node : part.nodes)
    for (int k = 0; k < field.components; ++k)
      out.values.push_back(field.values.at(static_cast<std::size_t>(node) *
                                               static_cast<std::size_t>(field.components) +
                                           static_cast<std::size_t>(k)));
  return out;
}

namespace {

constexpr const char* pvd_head =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
    "  <Collection>\n";
constexpr const char* pvd_tail = "  </Collection>\n</VTKFile>\n";

std::string pvd_lines(std::span<const PvdEntry> entries,
                      std::map<std::string, std::size_t>& parts) {
  std::string text;
  for (const PvdEntry& entry : entries) {
    const std::size_t part = parts.try_emplace(entry.part, parts.size()).first->second;
    text += fmt::format(
        "    <DataSet timestep=\"{:.17g}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
        entry.time, part, escape_xml(entry.part), escape_xml(entry.file));
  }
  return text;
}

/// Returns how many bytes stand before the tail.
std::size_t begin_pvd(const std::string& path, std::span<const PvdEntry> entries,
                      std::map<std::string, std::size_t>& parts) {
  const std::string text = pvd_head + pvd_lines(entries, parts);
  write_file(path, text + pvd_tail);
  return text.size();
}

}  // namespace

void write_pvd(const std::string& path, std::span<const PvdEntry> entries) {
  std::map<std::string, std::size_t> parts;
  begin_pvd(path, entries, parts);
}

PvdFile::PvdFile(const std::string& path, std::span<const PvdEntry> entries)
    : file_(path, begin_pvd(path, entries, parts_), pvd_tail) {}

void PvdFile::add(std::span<const PvdEntry> entries) { file_.append(pvd_lines(entries, parts_)); }

}  // namespace osculate::io
