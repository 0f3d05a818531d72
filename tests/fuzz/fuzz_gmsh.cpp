// Whatever the bytes are: a mesh without broken references, or an InputError.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "osculate/core/error.hpp"
#include "osculate/io/mesh_format.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/check.hpp"
#include "osculate/mesh/surface.hpp"

namespace {

/// What comes after reading must also stand any mesh that check_mesh calls usable. The reader
/// lets no NaN and no infinity through; finite coordinates that are too large are check_mesh's.
void use(const osculate::mesh::Mesh& mesh) {
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    use(osculate::io::read_mesh(std::string_view(reinterpret_cast<const char*>(data), size),
                                "fuzz"));
  } catch (const osculate::core::InputError&) {
  }
  return 0;
}
