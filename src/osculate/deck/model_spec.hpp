#pragma once
#include <string>

#include "osculate/deck/spec.hpp"

namespace osculate::deck {

/// The keys of the model file: the one list that validation, JSON schema and `osculate doc` share.
[[nodiscard]] Spec model_spec();

// Its branches, one file each.
[[nodiscard]] Spec mesh_spec();
/// The name of a set, or a list of names.
[[nodiscard]] Spec set_or_sets(std::string doc, const std::string& example);
[[nodiscard]] Spec parameters_spec();
[[nodiscard]] Spec sets_spec();
[[nodiscard]] Spec materials_spec();
/// Keys of the materials of small strains, and of those that remember: one after the other.
[[nodiscard]] std::string small_strain_materials();
[[nodiscard]] std::string remembering_materials();
[[nodiscard]] Spec sections_spec();
[[nodiscard]] Spec rigid_spec();
[[nodiscard]] Spec contact_spec();
/// One key a law of the catalogue.
[[nodiscard]] std::vector<Key> normal_law_keys();
[[nodiscard]] std::vector<Key> friction_law_keys();
[[nodiscard]] std::vector<Key> damping_law_keys();
[[nodiscard]] Spec amplitudes_spec();
[[nodiscard]] Spec equations_spec();
[[nodiscard]] Spec equal_spec();
[[nodiscard]] Spec steps_spec();
[[nodiscard]] Spec dynamics_spec();
[[nodiscard]] Spec gravity_spec();
[[nodiscard]] Spec initial_velocity_spec();
[[nodiscard]] Spec solver_spec();
[[nodiscard]] Spec output_spec();

/// Two coordinates.
[[nodiscard]] Spec point_spec(std::string doc);
/// Three coordinates.
[[nodiscard]] Spec place_spec(std::string doc);
/// A list of points, at least `least` of them.
[[nodiscard]] Spec points_spec(std::string doc, std::size_t least);

}  // namespace osculate::deck
