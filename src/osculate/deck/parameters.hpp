#pragma once
#include <span>
#include <string>
#include <vector>

#include "osculate/deck/source_tree.hpp"

namespace osculate::deck {

/// A parameter of the model file with its value; those of the command line replace the file's.
struct Setting {
  std::string name, value;
};

/// Puts values in place of names, everywhere but under `parameters` itself: a plain value that
/// begins with `=` becomes what the rest of it comes to (numbers, names, + - * / and brackets; the
/// name of a text alone is that text), `${...}` within a value what stands in the braces comes to.
///
/// Returns    the parameters with their values, in the order of the file
/// Errors     core::InputError with line and key: unknown names with the nearest one, what is no
///            arithmetic, results that are not finite; a setting of no parameter
/// Tested by  tests/unit/deck/test_parameters.cpp
[[nodiscard]] std::vector<Setting> apply_parameters(SourceNode& root, const std::string& file,
                                                    std::span<const Setting> settings);

}  // namespace osculate::deck
