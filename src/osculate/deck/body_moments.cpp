// What bounds a rigid body, for its volume.
#include "osculate/deck/body_moments.hpp"

namespace osculate::deck {
namespace {

auto free_sides(const model::Model& m, const mesh::Set& set) {
  return mesh::boundary_facets(m.mesh, mesh::edge_table(m.mesh, set.cells), set);
}
auto free_sides(const model::Model3& m, const mesh::Set& set) {
  return mesh::surface_facets(m.mesh, mesh::face_table(m.mesh, set.cells), set);
}

/// The whole boundary of a set of cells, or the facets of a set of them.
template <int Dim>
std::vector<Side<Dim>> sides_of(const BuildContext<Dim>& c, const SetShape& shape,
                                const mesh::Set& set) {
  if (set.dimension < Dim) return oriented_facets(c, shape.set);
  auto surface = free_sides(c.model(), set);
  if (!surface.errors.empty()) throw core::InputError(shape.set.mark, surface.errors.front());
  return std::move(surface.facets);
}

}  // namespace

template <int Dim>
model::EnclosedVolume<Dim> enclosed_volume(const BuildContext<Dim>& c, const Rigid& rigid,
                                           const model::BasicRigidBody<Dim>& body) {
  const auto* const shape = std::get_if<SetShape>(&rigid.shape);
  if (body.shape || !shape) {
    const auto* const polyline = std::get_if<PolylineShape>(&rigid.shape);
    return model::enclosed_volume(body, polyline && polyline->closed);
  }
  const mesh::Set& set = c.set(shape->set);
  if (set.dimension < Dim - 1)
    return {std::nullopt, Dim == 2 ? "is a set without lines" : "is a set without areas"};
  return model::enclosed_volume(c.model(), sides_of(c, *shape, set), set.dimension == Dim,
                                rigid.flip.value_or(false));
}

template model::EnclosedVolume<2> enclosed_volume(const BuildContext<2>&, const Rigid&,
                                                  const model::RigidBody&);
template model::EnclosedVolume<3> enclosed_volume(const BuildContext<3>&, const Rigid&,
                                                  const model::RigidBody3&);

}  // namespace osculate::deck
