#pragma once
#include <string>

namespace osculate::api {

struct StartedModel {
  std::string text;     ///< the model file
  std::string refused;  ///< why `check` does not accept it, a mistake of the mesh; empty: it does
};

/// A commented model file to begin with, for a mesh: its sets, a section a body, steel, a static
/// step, supports and contact where groups of facets of two bodies face each other. Gaps are
/// measured by `check` itself, with a contact pair for each two groups that are near each other.
///
/// Input      model: path the text is meant for, to whose folder the mesh is relative
/// Errors     core::InputError: a mesh that cannot be read, or has no cells a body could be made of
/// Tested by  tests/unit/api/test_init.cpp, tests/system/test_init.py
[[nodiscard]] StartedModel start_model(const std::string& mesh, const std::string& model);

}  // namespace osculate::api
