#pragma once
#include <string>
#include <string_view>

#include "osculate/mesh/mesh.hpp"

namespace osculate::io {

/// Reads the triangles of an STL file, text or binary: the surface of a rigid obstacle, say.
///
/// Corners with the same coordinates are one node; triangles with two corners in one place, which
/// have no area, are left out. One set for each solid, with its name, else `surface`; solids of one
/// name are one set. Normals are those of the order of the corners, not those that the file gives.
///
/// Errors     core::InputError with file and line (binary: triangle) for everything that is wrong
/// Tested by  tests/unit/io/test_stl.cpp, tests/fuzz/fuzz_gmsh.cpp
[[nodiscard]] mesh::Mesh read_stl(std::string_view content, const std::string& name);

/// Whether content is STL: it begins with `solid` and a facet follows, or its length is that of its
/// number of triangles.
[[nodiscard]] bool looks_like_stl(std::string_view content);

}  // namespace osculate::io
