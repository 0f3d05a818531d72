#pragma once
#include <string>
#include <string_view>

#include "osculate/mesh/mesh.hpp"

namespace osculate::io {

/// A format of mesh files.
struct MeshFormat {
  std::string_view name, extension;  ///< with its dot, in small letters
  /// Whether content that has no extension to tell by is of this format.
  bool (*looks_so)(std::string_view content);
  /// `name` appears in messages. Throws core::InputError with file and line.
  mesh::Mesh (*read)(std::string_view content, const std::string& name);
};

/// All there are in words: `Gmsh (.msh), ... or STL (.stl)`.
[[nodiscard]] std::string mesh_format_names();

/// By the extension of the name, else by the content; null: no format.
[[nodiscard]] const MeshFormat* mesh_format_of(const std::string& name, std::string_view content);

/// Reads a mesh in the format it has; where none is found, as the first one (which says what it
/// expected).
///
/// Tested by  tests/unit/io/test_stl.cpp, test_inp.cpp, tests/fuzz/fuzz_gmsh.cpp
[[nodiscard]] mesh::Mesh read_mesh(const std::string& path);
[[nodiscard]] mesh::Mesh read_mesh(std::string_view content, const std::string& name);

}  // namespace osculate::io
