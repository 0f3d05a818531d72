#pragma once
#include <string>

#include "osculate/deck/bind.hpp"

namespace osculate::deck {

/// The keys of the model file with the members of the description that their values go to: the one
/// list that validation, reading, JSON schema and `osculate doc` share.
[[nodiscard]] BoundKeys<Description> model_keys();
[[nodiscard]] Spec model_spec(const BoundKeys<Description>& keys);
[[nodiscard]] Spec model_spec();

// Its branches, one file each, in the order in which they are read: sections need the materials.
[[nodiscard]] BoundKey<Description> mesh_key();
[[nodiscard]] BoundKey<Description> sets_key();
[[nodiscard]] BoundKey<Description> materials_key();
[[nodiscard]] BoundKey<Description> sections_key();
[[nodiscard]] BoundKey<Description> rigid_key();
[[nodiscard]] BoundKey<Description> contact_key();
[[nodiscard]] BoundKey<Description> amplitudes_key();
[[nodiscard]] BoundKey<Description> axes_key();
[[nodiscard]] BoundKey<Description> equations_key();
/// Equations that begin with a step.
[[nodiscard]] BoundKey<Step> begun_equations_key();
[[nodiscard]] BoundKey<Description> equal_key();
/// One term of an equation, and of the elongation of a spring.
[[nodiscard]] BoundKeys<EquationTerm> term_keys();
[[nodiscard]] std::vector<BoundKey<Description>> spring_keys();
/// Conditions of nodes beside equations, couplings, sections under pretension, cyclic symmetry.
[[nodiscard]] std::vector<BoundKey<Description>> constraint_keys();
[[nodiscard]] BoundKey<Description> initial_velocity_key();
[[nodiscard]] BoundKey<Description> initial_temperature_key();
/// Stresses and strains of bodies before the first step.
[[nodiscard]] std::vector<BoundKey<Description>> initial_state_keys();
[[nodiscard]] BoundKey<Description> steps_key();
[[nodiscard]] BoundKey<Description> solver_key();
[[nodiscard]] BoundKey<Description> output_key();

[[nodiscard]] BoundKey<Step> contact_changes_key();
/// `sampling` and `initial` of a contact pair.
[[nodiscard]] BoundKey<Contact> sampling_key();
[[nodiscard]] BoundKey<Contact> initial_gaps_key();
/// How long a step lasts, and for whom.
[[nodiscard]] std::vector<BoundKey<Step>> time_keys();
/// Cells, materials and equations that change when a step begins.
[[nodiscard]] std::vector<BoundKey<Step>> body_change_keys();
/// Sets of nodes or rigid bodies, and which of their displacements.
[[nodiscard]] BoundKeys<Release> displacements_of(std::string doc);
/// Of `output`: results in the files of CalculiX.
[[nodiscard]] BoundKey<Output> frd_key();
[[nodiscard]] BoundKey<Output> dat_key();

[[nodiscard]] Spec dynamics_spec();
[[nodiscard]] BoundKey<Step> modal_key();
[[nodiscard]] BoundKey<Step> buckling_key();
[[nodiscard]] BoundKey<Step> harmonic_key();
/// What goes with `buckling` in a step; its increments.
void check_buckling(const Value& step, Step& s);
/// What goes with `modal`, or with `harmonic`, in a step.
void check_modal(const Value& step, Step& s);
[[nodiscard]] Spec gravity_spec();
/// A displacement or rotation.
[[nodiscard]] Spec component_spec(std::string doc);
/// The name of a set, or a list of names.
[[nodiscard]] Spec set_or_sets(std::string doc, const std::string& example);
/// The set that something is of.
template <class T>
[[nodiscard]] BoundKey<T> on_key(std::string doc, const std::string& example) {
  return need(&T::on, "on", set_or_sets(std::move(doc), example));
}
/// Two points that give axes: one of two keys.
[[nodiscard]] std::vector<BoundKey<material::Orientation>> orientation_keys();
/// The same, and how they are turned about one of them.
[[nodiscard]] std::vector<BoundKey<material::Orientation>> turned_orientation_keys();
/// Where the axes of a section's material point.
[[nodiscard]] BoundKey<Section> orientation_key();
/// Keys of the materials of small strains, and of those that remember: one after the other.
[[nodiscard]] std::string small_strain_materials();
[[nodiscard]] std::string remembering_materials();
/// One key a law of the catalogue.
[[nodiscard]] std::vector<Key> normal_law_keys();
[[nodiscard]] std::vector<Key> friction_law_keys();
[[nodiscard]] std::vector<Key> damping_law_keys();

/// Two coordinates.
[[nodiscard]] Spec point_spec(std::string doc);
/// Three coordinates.
[[nodiscard]] Spec place_spec(std::string doc);
/// A list of points, at least `least` of them.
[[nodiscard]] Spec points_spec(std::string doc, std::size_t least);

}  // namespace osculate::deck
