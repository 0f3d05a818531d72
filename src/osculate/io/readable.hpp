#pragma once
#include <filesystem>
#include <string>

namespace osculate::io {

/// What a path leads to, if it is there and no folder.
///
/// Throws     core::InputError
/// Tested by  tests/unit/io/test_gmsh_broken.cpp
[[nodiscard]] std::filesystem::file_status readable_status(const std::string& path);

}  // namespace osculate::io
