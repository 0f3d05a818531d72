#pragma once
// Shared by build_contact.cpp and build_contact_all.cpp; not for users.
#include "osculate/deck/build_context.hpp"
#include "osculate/model/onto_master.hpp"
#include "osculate/pairing/automatic_stiffness.hpp"
#include "osculate/pairing/facet_size.hpp"

namespace osculate::deck {

/// Facets of mesh sides with outward normals; `flip_rigid` puts the body of sides that have no cell
/// behind them on their other side.
template <int Dim>
[[nodiscard]] pairing::Boundary<Dim> boundary_from(const std::vector<Side<Dim>>& sides,
                                                   bool flip_rigid);
/// Boundary of a mesh set, or of a rigid body.
template <int Dim>
[[nodiscard]] pairing::Boundary<Dim> boundary_of(const BuildContext<Dim>& c, const Name& name);

/// Turns the connected parts of a meshed master that have no cells behind them, and no `flip` of
/// their own, to the side where the slave starts: where the cells behind its nodes are, seen from
/// the nearest place of the part. Says so, and where there are slaves on both sides.
///
/// Tested by  tests/unit/deck/test_rigid_side.cpp
template <int Dim>
void face_slave(BuildContext<Dim>& c, const Contact& contact, const Name& master,
                const std::vector<Index>& slave_nodes, pairing::Boundary<Dim>& boundary);

/// Refuses choices that do not go together: what needs nodes as contact points, or one slave, or a
/// penalty. Throws core::InputError.
void check_axes(const Contact& contact);

/// Sets the contact points of the slave as `sampling` says, and warns of nodes that are no good
/// ones.
///
/// Tested by  tests/unit/deck/test_sampling.cpp
template <int Dim>
void set_points(BuildContext<Dim>& c, const Contact& contact, pairing::PairDefinition<Dim>& pair);

/// The slave that a pair names: facets, or points.
template <int Dim>
[[nodiscard]] pairing::SlaveSide<Dim> slave_of(const BuildContext<Dim>& c, const Contact& contact);

/// Moves the slave nodes of pairs with `initial: adjust` onto their masters, in the reference
/// coordinates, and says how far.
///
/// Tested by  tests/unit/deck/test_initial_overlap.cpp
template <int Dim>
void adjust_overlaps(BuildContext<Dim>& context);

/// Moves nodes in the reference coordinates and says how far (`what` begins the note). Throws
/// core::InputError at `mark` for a cell that is turned inside out.
template <int Dim>
void move_onto_master(BuildContext<Dim>& c, const std::vector<model::MovedNode<Dim>>& all,
                      std::string_view what, const core::SourceMark& mark);

/// Laws and forms from the description, areas; then the pair is part of the model. Errors point at
/// `mark`.
template <int Dim>
void add_pair(BuildContext<Dim>& c, const Contact& contact, const core::SourceMark& mark,
              model::BasicContactPair<Dim> pair);

/// Areas of the slave's points that the model gives; empty: those of its facets. A node without
/// free faces has the mean of the others.
///
/// Tested by  tests/unit/deck/test_given_areas.cpp
template <int Dim>
[[nodiscard]] std::vector<double> given_areas(const BuildContext<Dim>& c, const Contact& contact,
                                              const pairing::PairDefinition<Dim>& pair);

/// Normal law, friction law, what is held, offset. Errors point at the key.
template <int Dim>
void set_laws(const BuildContext<Dim>& c, const Contact& contact,
              pairing::PairDefinition<Dim>& pair);

/// The steps in which a law of a pair acts that it has from a step on: up to the next one that says
/// another `law` of the pair of that name.
template <class Law>
[[nodiscard]] StepRange steps_of_law(const Description& d, const std::string& pair,
                                     std::size_t first, Law ContactChange::*law) {
  for (std::size_t s = first; s < d.steps.size(); ++s)
    for (const ContactChange& change : d.steps[s].contact)
      if (change.pair.value == pair && (change.*law).has_value()) return {first, s};
  return {first};
}

/// Counts the points of a prepared pair that are tied; throws where there are none.
template <int Dim>
void note_tied(BuildContext<Dim>& c, const Contact& contact,
               const pairing::PairDefinition<Dim>& pair);

/// Mean length of the facets' edges in the reference configuration, 0 without facets.
template <int Dim>
[[nodiscard]] double mean_size(const pairing::Boundary<Dim>& boundary,
                               const std::vector<Vec<Dim>>& reference) {
  return pairing::mean_facet_size(boundary, reference);
}

using pairing::search_distance_in_facets;

/// A surface by its nodes, and its facets by theirs, in order. Without facets: those whose nodes it
/// has.
struct SurfaceNodes {
  std::set<Index> nodes;
  std::set<std::vector<Index>> facets;
  [[nodiscard]] bool has(std::vector<Index> facet) const;
};
/// Surfaces that do not touch by `all`: `exclude_surfaces`, pairs of their own, and nodes that are
/// tied with their masters.
template <int Dim>
[[nodiscard]] std::vector<std::array<SurfaceNodes, 2>> not_by_all(const BuildContext<Dim>& c,
                                                                  const Contact& all);
/// What of a master the slave's nodes do not touch, by those.
///
/// Tested by  tests/unit/deck/test_contact_all.cpp
template <int Dim>
[[nodiscard]] pairing::HiddenFacets hidden_facets(
    const std::vector<std::array<SurfaceNodes, 2>>& apart, const std::vector<Index>& slave,
    const pairing::Boundary<Dim>& master);

/// The pairs that `contact: {all: ...}` stands for.
template <int Dim>
void build_contact_all(BuildContext<Dim>& c, const Contact& contact);

/// The stiffnesses that are left to the program, from the cells behind both sides, and the height
/// of these cells; for the pair, and for each of its points.
///
/// Formula    eps_N = 10 / (h_s / E_s + h_m / E_m), eps_T the same with the shear moduli; h the
///            height of the cells behind the facets, E / h averaged over the area of a side; a
///            rigid side gives nothing. weight: node: times the mean area of a slave point.
///            Of a point own_factor(r) times that, r the ratio of the same formula with the cells
///            behind the point and behind the nearest place of the master
/// Tested by  tests/unit/deck/test_automatic_penalty.cpp, test_point_penalties.cpp
template <int Dim>
void set_automatic(BuildContext<Dim>& context, const Contact& contact,
                   model::BasicContactPair<Dim>& pair);

/// Replaces the master of a finished pair by the smooth one that the model asks for.
template <int Dim>
void smooth_master(const BuildContext<Dim>& context, const Contact& contact,
                   pairing::PairDefinition<Dim>& pair);

}  // namespace osculate::deck
