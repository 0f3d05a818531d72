#pragma once
#include <string>
#include <vector>

#include "osculate/deck/description.hpp"
#include "osculate/model/analysis.hpp"
#include "osculate/model/model.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::deck {

/// Everything a run needs, built from a description and its mesh.
struct Built {
  model::Model model;
  model::AnalysisOptions options;
  std::vector<model::HistoryRequest> history;
  std::vector<std::string> warnings;  ///< plain sentences, shown by `check` and `run`
};

/// Reads or generates the mesh. Throws core::InputError.
[[nodiscard]] mesh::Mesh load_mesh(const Description& description);

/// Matches the description with its mesh: sets, bodies, surfaces, loads. Throws core::InputError
/// naming file, line and key for everything that does not fit.
[[nodiscard]] Built build(const Description& description, mesh::Mesh mesh);

/// read_model, load_mesh and build in one call.
[[nodiscard]] Built build_file(const std::string& path);

}  // namespace osculate::deck
