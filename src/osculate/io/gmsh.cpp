#include "osculate/io/gmsh.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>
#include <system_error>

#include "osculate/core/error.hpp"
#include "osculate/io/gmsh/raw.hpp"
#include "osculate/io/readable.hpp"
#include "osculate/io/utf8.hpp"

namespace osculate::io {
namespace {

using gmsh::Cursor;
using gmsh::RawMesh;

enum class Version { two, four };

/// The byte that tells the byte order: an int of value 1.
void check_byte_order(Cursor& cursor) {
  cursor.set_binary(true);
  const std::int64_t one = cursor.integer("the number 1");
  if (one == 0x01000000)
    cursor.fail("the file was written on a machine with another byte order; save it as text");
  if (one != 1)
    cursor.fail(fmt::format("expected the number 1 to tell the byte order, not {}", one));
}

Version read_format(Cursor& cursor) {
  cursor.skip_blank_lines();
  const double version = cursor.text_real("the version of the format");
  const std::int64_t type = cursor.text_integer("the file type");
  const std::int64_t size = cursor.text_integer("the data size");
  if (version != 2.2 && version != 4.1)
    cursor.fail(
        fmt::format("version {} of the format is not supported; expected 2.2 or 4.1 "
                    "(gmsh FILE -save -format msh41)",
                    version));
  if (type != 0 && type != 1)
    cursor.fail(fmt::format("the file type must be 0 or 1, not {}", type));
  if (size != 8) cursor.fail(fmt::format("the data size must be 8, not {}", size));
  cursor.end_line();
  if (type == 1) check_byte_order(cursor);
  cursor.end_section();
  return version == 2.2 ? Version::two : Version::four;
}

std::string read_name(const Cursor& cursor, std::string_view line) {
  const bool quoted = line.size() >= 2 && line.front() == '"' && line.back() == '"';
  if (!quoted) cursor.fail("expected the name of the group in quotes at the end of the line");
  const std::string_view name = line.substr(1, line.size() - 2);
  if (!is_plain_text(name))
    cursor.fail("the name of the group has control characters or is not UTF-8");
  return std::string(name);
}

void read_names(Cursor& cursor, RawMesh& raw) {
  const std::int64_t n = cursor.text_count("the number of groups");
  std::set<std::string> used;
  for (std::int64_t i = 0; i < n; ++i) {
    cursor.skip_blank_lines();
    const std::int64_t dimension = cursor.text_integer("the dimension of a group");
    if (dimension < 0 || dimension > 3)
      cursor.fail(fmt::format("the dimension of a group must be 0 to 3, not {}", dimension));
    const std::int64_t tag = cursor.text_integer("the tag of a group");
    const std::string name = read_name(cursor, cursor.rest_of_line());
    if (name.empty()) continue;
    if (!used.insert(name).second)
      cursor.fail(
          fmt::format("the name '{}' is used twice; the names of physical groups must "
                      "differ, also across dimensions",
                      name));
    if (!raw.names.try_emplace({static_cast<int>(dimension), tag}, name).second)
      cursor.fail(
          fmt::format("the group of dimension {} and tag {} is there twice", dimension, tag));
  }
}

void read_section(Cursor& cursor, const std::string& section, Version version, RawMesh& raw) {
  const bool two = version == Version::two;
  if ((section == "Nodes" && raw.has_nodes) || (section == "Elements" && raw.has_cells))
    cursor.fail("the section is there twice");
  if (section == "Elements" && !raw.has_nodes) cursor.fail("the section must follow $Nodes");
  if (section == "MeshFormat") cursor.fail("the section is there twice");
  if (section == "PhysicalNames") {
    read_names(cursor, raw);
  } else if (section == "Nodes") {
    two ? gmsh::read_nodes_2(cursor, raw) : gmsh::read_nodes_4(cursor, raw);
  } else if (section == "Elements") {
    two ? gmsh::read_elements_2(cursor, raw) : gmsh::read_elements_4(cursor, raw);
  } else if (section == "Entities" && !two) {
    gmsh::read_entities_4(cursor, raw);
  } else if (section == "PartitionedEntities" && !two) {
    gmsh::read_partitioned_entities_4(cursor, raw);
  } else {
    return cursor.skip_section();
  }
  cursor.end_section();
}

/// Moves behind $MeshFormat.
Version read_header(Cursor& cursor, std::string_view content) {
  if (content.find_first_not_of(" \t\r\n") == std::string_view::npos)
    cursor.fail_at(Cursor::nowhere, "the file is empty");
  std::string section;
  while (cursor.next_section(section)) {
    if (section == "MeshFormat") return read_format(cursor);
    if (section == "NOD")
      cursor.fail(
          "version 1 of the format is not supported; expected 2.2 or 4.1 "
          "(gmsh FILE -save -format msh41)");
    if (section != "Comments") cursor.fail("expected '$MeshFormat' first: not a Gmsh mesh");
    cursor.skip_section();
  }
  cursor.fail_at(Cursor::nowhere, "section '$MeshFormat' is missing: not a Gmsh mesh");
}

}  // namespace

mesh::Mesh read_gmsh(std::string_view content, const std::string& name) {
  if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
  Cursor cursor(content, name);
  const Version version = read_header(cursor, content);
  RawMesh raw;
  std::string section;
  while (cursor.next_section(section)) read_section(cursor, section, version, raw);
  if (!raw.has_nodes) cursor.fail_at(Cursor::nowhere, "section '$Nodes' is missing");
  if (!raw.has_cells) cursor.fail_at(Cursor::nowhere, "section '$Elements' is missing");
  return gmsh::build_mesh(cursor, std::move(raw));
}

mesh::Mesh read_gmsh(const std::string& path) { return read_gmsh(read_file(path), path); }

std::string read_file(const std::string& path) {
  const auto fail = [&path](const std::string& message) {
    throw core::InputError({path, 0, ""}, message);
  };
  std::error_code error;
  const std::filesystem::file_status status = readable_status(path);
  if (!std::filesystem::is_regular_file(status) && !std::filesystem::is_fifo(status))
    fail("is not a file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (!file) fail(std::string("cannot read: ") + std::strerror(errno));
  std::string content;
  const std::uintmax_t expected = std::filesystem::file_size(path, error);
  if (!error && expected > 0) content.resize(expected + 1);
  std::size_t size = 0;
  for (;;) {
    constexpr std::size_t piece = std::size_t{1} << 20U;
    if (size == content.size()) content.resize(size + piece);
    const std::size_t got = std::fread(content.data() + size, 1, content.size() - size, file.get());
    if (std::ferror(file.get()) != 0) fail(std::string("cannot read: ") + std::strerror(errno));
    if (got == 0) break;
    size += got;
  }
  content.resize(size);
  return content;
}

}  // namespace osculate::io
