#pragma once
// Volumes of rigid bodies from what bounds them.
#include <optional>
#include <span>
#include <string>

#include "osculate/body/inertia.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/surface.hpp"
#include "osculate/model/model.hpp"

namespace osculate::model {

/// Boundary facets: edges of area cells in the plane, faces of volume cells in space.
template <int Dim>
using Side = std::conditional_t<Dim == 2, mesh::BoundaryFacet, mesh::SurfaceFacet>;

/// The volume that a rigid body encloses, or why it encloses none ("has an open surface").
template <int Dim>
struct EnclosedVolume {
  std::optional<body::VolumeMoments<Dim>> moments;
  std::string why;
};

/// Volume, centre and second moments within a boundary: the `whole` one of cells, or facets of a
/// set, which may not be closed; `flip` turns the normals of facets without cells.
///
/// Sign       a boundary whose normal points into what it encloses is a hole: no volume
/// Limits     exact for facets up to second order and volumes bounded by them; where one part of a
///            surface crosses another, what lies between them counts twice
/// Tested by  tests/unit/deck/test_body_moments.cpp
template <int Dim>
[[nodiscard]] EnclosedVolume<Dim> enclosed_volume(const BasicModel<Dim>& model,
                                                  const std::vector<Side<Dim>>& sides, bool whole,
                                                  bool flip);
/// The same of an analytic shape; of closed curves, of a polyline (`closed`) in the plane.
template <int Dim>
[[nodiscard]] EnclosedVolume<Dim> enclosed_volume(const BasicRigidBody<Dim>& body, bool closed);

}  // namespace osculate::model
