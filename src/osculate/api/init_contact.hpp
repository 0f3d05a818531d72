#pragma once
// Which groups of facets of a mesh may touch; shared by the sources of this layer, not for users.
#include <functional>
#include <string>
#include <vector>

#include "osculate/api/init_survey.hpp"

namespace osculate::api {

/// Two groups of facets that face each other, as `check` measures it.
struct FacingPair {
  std::string name;
  const Touchable* master = nullptr;
  const Touchable* slave = nullptr;
  int points = 0, facing = 0;        ///< of the slave, and those over faces of the master
  double smallest = 0, largest = 0;  ///< gap
  std::string doubt;                 ///< why it may be none; empty: it is one
};

/// Master or slave as a model file names it.
[[nodiscard]] std::string side_name(const Touchable& side);
/// A name as YAML has it.
[[nodiscard]] std::string yaml_text(const std::string& name);
/// The entry of `contact`.
[[nodiscard]] std::string contact_entry(const FacingPair& pair);

/// Those that face each other; the ones without doubt first. `model` makes a whole model file of
/// the entries of `contact`; `path` is its name.
[[nodiscard]] std::vector<FacingPair> facing_pairs(
    const MeshSurvey& found, const std::string& path,
    const std::function<std::string(const std::string& contact)>& model);

}  // namespace osculate::api
