#pragma once
#include <span>
#include <string>
#include <string_view>

#include "osculate/deck/description.hpp"
#include "osculate/deck/source_tree.hpp"

namespace osculate::deck {

/// Reads and validates the text of a model file: YAML, keys, types, ranges, and all references
/// that can be judged without the mesh. The first mistake is thrown as core::InputError; no other
/// exception leaves this function.
///
/// Requires   `file_name` as the user named it; a mesh path is taken relative to its folder
/// Tested by  tests/unit/deck/test_broken_models.cpp, test_broken_references.cpp,
/// test_good_models.cpp,
///            test_yaml.cpp, test_mutation.cpp
[[nodiscard]] Description parse_model(std::string_view text, std::string file_name,
                                      std::span<const Setting> settings = {});
/// The same for a document that was read before.
[[nodiscard]] Description parse_model(SourceNode root, std::string file_name,
                                      std::span<const Setting> settings = {});

/// The same for a file.
[[nodiscard]] Description read_model(const std::string& path,
                                     std::span<const Setting> settings = {});

/// The error for a set that the mesh does not have: `unknown set 'topp'; did you mean 'top'?`,
/// at the place where the name was read.
[[nodiscard]] core::InputError unknown_set(const Name& on, std::span<const std::string> sets);

}  // namespace osculate::deck
