#pragma once
#include <array>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "osculate/deck/description.hpp"
#include "osculate/model/analysis.hpp"
#include "osculate/model/model.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::deck {

/// Force, and moment about the origin.
struct Resultant {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
};

/// What one load of one step adds up to in the undeformed model.
struct LoadTotal {
  std::string kind;       ///< key of the step: `pressure`
  std::string on;         ///< empty: gravity, which acts on all masses
  std::string values;     ///< `fx 1, fy -3`
  std::string amplitude;  ///< empty: a ramp
  bool kept = false;      ///< unchanged since an earlier step
  Resultant whole;        ///< at the end of the step; with an amplitude where that is 1
  Resultant end;          ///< at the end of the step
};

/// A facet through which a force is summed up, and the cell on whose nodes it acts.
struct CutFacet {
  mesh::CellRef cell;
  model::PressureLoad::Facet side;  ///< its normal points out of the cell
};

/// A node whose results in the files of CalculiX are those of a rigid body.
struct BodyNode {
  Index body = -1;
  bool rotation = false;
};

/// Everything a run needs, built from a description and its mesh.
template <int Dim>
struct BasicBuilt {
  model::BasicModel<Dim> model;
  model::AnalysisOptions options;
  std::vector<model::HistoryRequest> history;
  std::map<std::string, std::vector<CutFacet>> cuts;  ///< of the sets that SOF is asked for
  std::map<Index, BodyNode> body_nodes;
  std::map<Index, Mat<Dim, Dim>> node_axes;  ///< of nodes that `axes` names, by columns
  /// Of each step with vibrations: frequencies that the files of CalculiX list.
  std::map<Index, std::array<double, 2>> listed_frequencies;
  std::vector<std::vector<LoadTotal>> loads;  ///< of each step
  std::vector<std::string> warnings;          ///< plain sentences, shown by `check` and `run`
  std::vector<std::string> notes;             ///< what was decided for the user, shown there too
  std::vector<std::string> input_notes;       ///< the same of the files that were read
  std::string linear_note;                    ///< where linear systems are solved by multigrid: why
};

using Built = BasicBuilt<2>;
using Built3 = BasicBuilt<3>;
/// A model of the plane or one in space.
using AnyBuilt = std::variant<Built, Built3>;

/// 3 for a model in space (a section has the element `solid` or `solid_shell`), otherwise 2.
[[nodiscard]] int dimension(const Description& description);

/// Reads or generates the mesh. Throws core::InputError.
[[nodiscard]] mesh::Mesh load_mesh(const Description& description);

/// Matches the description with its mesh: sets, bodies, surfaces, loads. Throws core::InputError
/// naming file, line and key for everything that does not fit; `build` also for a model in space,
/// `build3` for one of the plane.
[[nodiscard]] Built build(const Description& description, mesh::Mesh mesh);
[[nodiscard]] Built3 build3(const Description& description, mesh::Mesh mesh);
[[nodiscard]] AnyBuilt build_any(const Description& description, mesh::Mesh mesh);

/// read_model, load_mesh and build (build_any) in one call.
[[nodiscard]] Built build_file(const std::string& path);
[[nodiscard]] AnyBuilt build_any_file(const std::string& path);

}  // namespace osculate::deck
