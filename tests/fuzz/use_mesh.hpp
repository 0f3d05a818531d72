#pragma once
#include <cstdlib>

#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/check.hpp"
#include "osculate/mesh/surface.hpp"

/// What comes after reading must also stand any mesh that check_mesh calls usable. The reader
/// lets no NaN and no infinity through; finite coordinates that are too large are check_mesh's.
inline void use_mesh(const osculate::mesh::Mesh& mesh) {
  namespace m = osculate::mesh;
  for (const osculate::Vec3& x : mesh.nodes)
    if (!x.allFinite()) std::abort();
  for (const m::Finding& finding : m::check_mesh(mesh)) {
    if (finding.flaw == m::Flaw::bad_index) std::abort();
    if (finding.flaw == m::Flaw::not_finite) return;
  }
  const m::EdgeTable table = m::edge_table(mesh);
  const m::FaceTable faces = m::face_table(mesh);
  for (const m::Set& set : mesh.sets) {
    (void)m::surface_of(mesh, table, set);
    (void)m::surface_of(mesh, faces, set);
    if (set.dimension >= 2) (void)m::connected_parts(mesh, set.cells, m::Link::side);
  }
}
