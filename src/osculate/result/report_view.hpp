#pragma once
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "osculate/mesh/surface.hpp"
#include "osculate/model/failure.hpp"
#include "osculate/model/fields.hpp"
#include "osculate/result/body_numbers.hpp"
#include "osculate/result/rigid_pictures.hpp"

namespace osculate::result {

/// The picture of a model in the report: what is sent once, and once a frame
/// (docs/report_data.md).
template <int Dim>
class ReportView;

/// In the plane: all cells, contact along the slave, rigid bodies as lines.
template <>
class ReportView<2> {
 public:
  explicit ReportView(const model::Model& model);
  [[nodiscard]] nlohmann::json mesh() const;
  /// `u`, `fields`, `contact` and `rigid` of one frame.
  [[nodiscard]] nlohmann::json frame(const model::Reached& reached) const;
  /// The place `u` where an increment failed for good, its free rigid motions on the same points,
  /// and `rigid` there.
  [[nodiscard]] nlohmann::json last_iterate(const model::State& state,
                                            const model::Failure& failure) const;
  [[nodiscard]] std::size_t max_frames() const { return 60; }
  /// Turns the `rigid` of the frames into `rigid` of the report.
  void finish(nlohmann::json& frames, nlohmann::json& report) const;

 private:
  [[nodiscard]] nlohmann::json rigid_json(const model::State& state) const;

  const model::Model& model_;
  BodyNumbers bodies_;
  RigidLines rigid_;
};

/// In space: the free faces of the bodies, the faces of meshed rigid bodies, and quadrilaterals of
/// each analytic surface, on nodes of their own; contact as fields of the slave's nodes. Where
/// twenty frames of them fit the cells and their inner nodes too, for sections.
///
/// Size       all frames together are kept below 8 million values, fourteen a point and frame (a
///            page of 43 MB); when not even two frames fit, there is no picture
/// Tested by  tests/unit/result/test_report_view.cpp
template <>
class ReportView<3> {
 public:
  explicit ReportView(const model::Model3& model);
  [[nodiscard]] nlohmann::json mesh() const;
  [[nodiscard]] nlohmann::json frame(const model::Reached3& reached) const;
  [[nodiscard]] nlohmann::json last_iterate(const model::State3& state,
                                            const model::Failure3& failure) const;
  [[nodiscard]] std::size_t max_frames() const;
  void finish(nlohmann::json&, nlohmann::json&) const {}

 private:
  /// A quadrilateral of an analytic surface, carried by its rigid body.
  struct Patch {
    std::size_t body;
    std::array<Vec3, 4> corners;
  };
  void collect_nodes();
  [[nodiscard]] std::vector<mesh::SurfaceFacet> rigid_faces(std::size_t body) const;
  [[nodiscard]] nlohmann::json volumes_json() const;
  [[nodiscard]] std::size_t points() const { return nodes_.size() + 4 * patches_.size(); }

  const model::Model3& model_;
  BodyNumbers bodies_;
  RigidFaces rigid_;
  std::vector<mesh::SurfaceFacet> body_faces_;
  std::vector<Patch> patches_;
  bool solid_ = false;        ///< inner nodes and cells are sent
  std::vector<Index> nodes_;  ///< of the mesh, sorted
  std::vector<Index> place_;  ///< of each node in `nodes_`, or -1
};

}  // namespace osculate::result
