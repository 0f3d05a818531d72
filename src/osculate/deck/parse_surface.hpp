#pragma once
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "osculate/deck/source_tree.hpp"
#include "osculate/deck/spec.hpp"
#include "osculate/projection/target.hpp"

namespace osculate::deck {

/// A surface in the plane (a curve) or in space.
using AnyTarget = std::variant<projection::Target<2>, projection::Target<3>>;

/// What a surface file, or a set of a mesh, holds.
struct SurfaceInput {
  AnyTarget target;
  std::vector<std::string>
      warnings;  ///< of a Gmsh mesh: facets turned round, edges of three facets
  [[nodiscard]] int dimension() const { return target.index() == 0 ? 2 : 3; }
};

/// The keys of a surface file (YAML or JSON): a mesh, or one shape.
[[nodiscard]] Spec surface_spec();
/// JSON schema of a surface file, and what a key of it means.
[[nodiscard]] std::string surface_schema();
[[nodiscard]] std::string explain_surface_key(std::string_view key);
[[nodiscard]] std::string surface_reference();

/// Larger than those of a model file: a surface file may hold a mesh.
inline constexpr TextLimits surface_limits{std::size_t{256} << 20U, 4'000'000, 48};

/// The text of a surface file. Polylines become meshes of line2; the facets of a mesh are numbered
/// across types in the order of the file.
///
/// Errors     core::InputError with file, line and key
/// Tested by  tests/unit/deck/test_surface.cpp, test_broken_surfaces.cpp,
/// tests/fuzz/fuzz_surface.cpp
[[nodiscard]] AnyTarget parse_surface(std::string_view text, const std::string& file,
                                      const TextLimits& limits = surface_limits);

/// `surface.yaml` (or JSON), `mesh.msh:set`, or `mesh.msh`: the whole boundary.
///
/// A mesh with volumes, or with a node off the plane z = 0, lies in space: areas, the free faces of
/// volumes, or of nodes. Any other lies in the plane: lines, the free edges of areas, or of nodes.
/// Oriented as contact surfaces of a model are (mesh/surface.hpp, mesh/boundary.hpp). Facets are
/// numbered in the order of the set; nodes that no facet uses are left out.
///
/// Errors     core::InputError; names the nearest set
[[nodiscard]] SurfaceInput read_surface(const std::string& named);

}  // namespace osculate::deck
