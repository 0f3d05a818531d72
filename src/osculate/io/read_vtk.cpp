#include "osculate/io/read_vtk.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <string_view>

#include "osculate/core/error.hpp"
#include "osculate/io/gmsh.hpp"

namespace osculate::io {
namespace {

/// The value of an attribute of a tag; empty: it has none.
std::string value_in_tag(std::string_view tag, const std::string& name) {
  const std::string begin = " " + name + "=\"";
  const std::size_t at = tag.find(begin);
  if (at == std::string_view::npos) return {};
  const std::size_t from = at + begin.size();
  return std::string(tag.substr(from, tag.find('"', from) - from));
}

/// Tags of a name in a text, one after the other.
template <class Use>
void for_tags(std::string_view text, const std::string& name, const Use& use) {
  const std::string begin = "<" + name + " ";
  for (std::size_t at = 0; (at = text.find(begin, at)) != std::string_view::npos;) {
    const std::size_t end = text.find('>', at);
    if (end == std::string_view::npos) return;
    use(text.substr(at, end - at));
    at = end;
  }
}

/// The raw data behind the header of a file.
class Appended {
 public:
  Appended(std::string_view bytes, bool packed, const std::string& path)
      : bytes_(bytes), packed_(packed), path_(path) {}

  [[nodiscard]] std::vector<double> numbers(std::uint64_t offset) const {
    const std::string data =
        packed_ ? unpacked(offset) : std::string(part(offset + 8, word(offset)));
    std::vector<double> out(data.size() / sizeof(double));
    if (!out.empty()) std::memcpy(out.data(), data.data(), out.size() * sizeof(double));
    return out;
  }

 private:
  [[nodiscard]] std::string_view part(std::uint64_t at, std::uint64_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at)
      throw core::InputError({path_, 0, ""}, "the file ends too early");
    return bytes_.substr(at, size);
  }
  [[nodiscard]] std::uint64_t word(std::uint64_t at) const {
    std::uint64_t out = 0;
    std::memcpy(&out, part(at, sizeof out).data(), sizeof out);
    return out;
  }
  /// Packets of zlib behind their number, their size, that of the last one, and what each takes.
  [[nodiscard]] std::string unpacked(std::uint64_t offset) const {
    const std::uint64_t packets = word(offset), most = word(offset + 8);
    (void)part(offset, 24 + 8 * std::min<std::uint64_t>(packets, bytes_.size()));
    std::uint64_t at = offset + 24 + 8 * packets;
    std::string out, buffer(std::min<std::uint64_t>(most, std::uint64_t{1} << 24U), '\0');
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> opener(
        libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
    if (!opener) throw std::bad_alloc();
    for (std::uint64_t i = 0; i < packets; ++i) {
      const std::string_view packet = part(at, word(offset + 24 + 8 * i));
      std::size_t size = 0;
      if (libdeflate_zlib_decompress(opener.get(), packet.data(), packet.size(), buffer.data(),
                                     buffer.size(), &size) != LIBDEFLATE_SUCCESS)
        throw core::InputError({path_, 0, ""}, "its packed data are damaged");
      out.append(buffer, 0, size);
      at += packet.size();
    }
    return out;
  }

  std::string_view bytes_;
  bool packed_;
  const std::string& path_;
};

}  // namespace

std::vector<Field> read_vtu_fields(const std::string& path) {
  const std::string content = read_file(path);
  const std::string_view all(content);
  const std::size_t data = all.find("<AppendedData encoding=\"raw\">");
  const std::size_t begin = data == std::string_view::npos ? data : all.find('_', data);
  if (begin == std::string_view::npos ||
      all.find("header_type=\"UInt64\"") == std::string_view::npos)
    throw core::InputError({path, 0, ""}, "this is no VTU file with raw appended data");
  const bool packed = all.substr(0, data).find("vtkZLibDataCompressor") != std::string_view::npos;
  const Appended appended(all.substr(begin + 1), packed, path);
  std::vector<Field> fields;
  for (const char* const place : {"PointData", "CellData"}) {
    const std::size_t from = all.find(fmt::format("<{}>", place)),
                      to = all.find(fmt::format("</{}>", place));
    if (from >= to || to > data) continue;
    for_tags(all.substr(from, to - from), "DataArray", [&](std::string_view tag) {
      if (value_in_tag(tag, "type") != "Float64" || value_in_tag(tag, "format") != "appended")
        return;
      const std::uint64_t offset = std::strtoull(value_in_tag(tag, "offset").c_str(), nullptr, 10);
      fields.push_back({value_in_tag(tag, "Name"),
                        std::atoi(value_in_tag(tag, "NumberOfComponents").c_str()),
                        appended.numbers(offset),
                        {}});
    });
  }
  return fields;
}

std::vector<PvdDataSet> read_pvd(const std::string& path) {
  const std::string content = read_file(path);
  std::vector<PvdDataSet> sets;
  for_tags(content, "DataSet", [&](std::string_view tag) {
    sets.push_back({std::strtod(value_in_tag(tag, "timestep").c_str(), nullptr),
                    value_in_tag(tag, "name"), value_in_tag(tag, "file")});
  });
  return sets;
}

}  // namespace osculate::io
