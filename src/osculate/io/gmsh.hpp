#pragma once
#include <string>
#include <string_view>

#include "osculate/mesh/mesh.hpp"

namespace osculate::io {

/// Reads a Gmsh mesh: MSH 2.2 or 4.1, text or binary.
///
/// Nodes are ordered by their tag, nodes and cells keep their numbers; there is one block per cell
/// type; one set per physical group, ordered by dimension and tag: named by the file, else
/// `point_7`, `line_7`, `surface_7`, `volume_7`. Cells without physical group are in no set. A
/// group with a negative tag holds the lines or areas reversed, as in Gmsh (MSH 2 files hold them
/// so already). Partitions, periodicity, post-processing views and the like are skipped.
///
/// Errors     core::InputError with file and line (binary: byte) for everything that is wrong: no
///            such file, other versions, foreign byte order, a file that ends early, counts that
///            cannot be true, coordinates that are no number, node tags used twice or not there,
///            element types we do not know, two sets of one name. Never needs more than about
///            twenty times the memory of the file.
/// Tested by  tests/unit/io/test_gmsh.cpp, test_gmsh_broken.cpp, tests/fuzz/fuzz_gmsh.cpp
[[nodiscard]] mesh::Mesh read_gmsh(const std::string& path);

/// The same for the content of a file; `name` appears in messages.
[[nodiscard]] mesh::Mesh read_gmsh(std::string_view content, const std::string& name);

/// The content of a file; core::InputError if it cannot be read or is a folder or device.
[[nodiscard]] std::string read_file(const std::string& path);

}  // namespace osculate::io
