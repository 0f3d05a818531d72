#pragma once
// Shared by build_contact.cpp and build_contact_all.cpp; not for users.
#include "osculate/deck/build_context.hpp"

namespace osculate::deck {

/// Facets of mesh sides with outward normals; `flip_rigid` puts the body of sides that have no cell
/// behind them on their other side.
template <int Dim>
[[nodiscard]] pairing::Boundary<Dim> boundary_from(const std::vector<Side<Dim>>& sides,
                                                   bool flip_rigid);
/// Boundary of a mesh set, or of a rigid body.
template <int Dim>
[[nodiscard]] pairing::Boundary<Dim> boundary_of(const BuildContext<Dim>& c, const Name& name);

/// Laws and forms from the description, areas; then the pair is part of the model. Errors point at
/// `mark`.
template <int Dim>
void add_pair(BuildContext<Dim>& c, const Contact& contact, const core::SourceMark& mark,
              model::BasicContactPair<Dim> pair);

/// Normal law, friction law, what is held, offset. Errors point at the key.
template <int Dim>
void set_laws(const BuildContext<Dim>& c, const Contact& contact,
              pairing::PairDefinition<Dim>& pair);

/// Counts the points of a prepared pair that are tied; throws where there are none.
template <int Dim>
void note_tied(BuildContext<Dim>& c, const Contact& contact,
               const pairing::PairDefinition<Dim>& pair);

/// Mean length of the facets' edges in the reference configuration, 0 without facets.
template <int Dim>
[[nodiscard]] double mean_size(const pairing::Boundary<Dim>& boundary,
                               const std::vector<Vec<Dim>>& reference);

/// How far a node looks round, in mean facet sizes, where everything may touch everything.
inline constexpr double reach_in_facets = 8;

/// The pairs that `contact: {all: ...}` stands for.
template <int Dim>
void build_contact_all(BuildContext<Dim>& c, const Contact& contact);

/// Replaces the master of a finished pair by the smooth one that the model asks for.
template <int Dim>
void smooth_master(const BuildContext<Dim>& context, const Contact& contact,
                   pairing::PairDefinition<Dim>& pair);

}  // namespace osculate::deck
