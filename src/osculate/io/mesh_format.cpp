#include "osculate/io/mesh_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "osculate/core/text.hpp"
#include "osculate/io/gmsh.hpp"
#include "osculate/io/inp.hpp"
#include "osculate/io/stl.hpp"

namespace osculate::io {
namespace {

bool looks_like_gmsh(std::string_view content) { return content.starts_with("$"); }

constexpr std::array<MeshFormat, 3> formats{
    {{"Gmsh", ".msh", looks_like_gmsh, read_gmsh},
     {"Abaqus or CalculiX", ".inp", looks_like_inp, read_inp},
     {"STL", ".stl", looks_like_stl, read_stl}}};

}  // namespace

std::string mesh_format_names() {
  std::vector<std::string> all;
  for (const MeshFormat& format : formats)
    all.push_back(fmt::format("{} ({})", format.name, format.extension));
  return core::join_with(all, "or");
}

const MeshFormat* mesh_format_of(const std::string& name, std::string_view content) {
  std::string extension = std::filesystem::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const MeshFormat& format : formats)
    if (format.extension == extension) return &format;
  for (const MeshFormat& format : formats)
    if (format.looks_so(content)) return &format;
  return nullptr;
}

mesh::Mesh read_mesh(std::string_view content, const std::string& name) {
  const MeshFormat* const format = mesh_format_of(name, content);
  return (format ? *format : formats.front()).read(content, name);
}
mesh::Mesh read_mesh(const std::string& path) { return read_mesh(read_file(path), path); }

}  // namespace osculate::io
