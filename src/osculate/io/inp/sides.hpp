#pragma once
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "osculate/io/inp/members.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::io::inp {

/// Adds the facets of element-based surfaces to the mesh as cells of their own, each once: faces
/// of solids as areas with the normal outwards, edges of plane elements as lines with the body on
/// the right, edges of shells as lines; a shell seen from above is its own cell. Of plane elements
/// that were expanded to solids the faces between their two sides. Surfaces that are made of others
/// have the facets of all of them, of the first without those of the second, or of both.
///
/// Errors     core::InputError: sides that an element does not have, surfaces of lines and areas,
///            surfaces made of unknown ones, of themselves or without facets
/// Tested by  tests/unit/io/test_inp_elements.cpp, test_inp.cpp, test_inp_broken.cpp
class Sides {
 public:
  Sides(const Deck& deck, const RawMesh& raw, const Numbering& numbering, mesh::Mesh& mesh)
      : deck_(deck), raw_(raw), numbering_(numbering), mesh_(mesh) {}

  /// The cells of a surface that stands in a scope.
  [[nodiscard]] std::vector<mesh::CellRef> of(const RawSurface& surface, std::uint32_t scope,
                                              Members& members);

 private:
  /// Sorted corners, and the cell that it belongs to.
  using Key = std::pair<mesh::FaceKey, std::pair<Index, Index>>;

  [[nodiscard]] std::vector<mesh::CellRef> of_entries(const RawSurface& surface,
                                                      std::uint32_t scope, Members& members);
  [[nodiscard]] std::vector<mesh::CellRef> of_parts(const RawSurface& surface, std::uint32_t scope,
                                                    Members& members);
  void add_side(const SurfaceEntry& entry, Index element, std::vector<mesh::CellRef>& cells);
  void add_free(const SurfaceEntry& entry, const std::vector<Index>& elements,
                std::vector<mesh::CellRef>& cells);
  mesh::CellRef facet(cell::CellType type, std::span<const Index> nodes, mesh::CellRef parent);
  template <class Facets>
  void add_facets(const SurfaceEntry& entry, const Facets& facets,
                  std::vector<mesh::CellRef>& cells);
  [[nodiscard]] bool is_side_of_layer(std::span<const Index> corners, mesh::CellRef parent);
  [[nodiscard]] std::vector<mesh::CellRef> all_cells(int dimension) const;

  const Deck& deck_;
  const RawMesh& raw_;
  const Numbering& numbering_;
  mesh::Mesh& mesh_;
  std::map<Key, mesh::CellRef> known_;
  std::vector<const RawSurface*> open_;  ///< surfaces whose parts are being looked for
  std::optional<std::set<std::pair<Index, Index>>> layer_cells_;  ///< of plane elements, expanded
  std::optional<mesh::FaceTable> faces_;
  std::optional<mesh::EdgeTable> edges_;
};

}  // namespace osculate::io::inp
