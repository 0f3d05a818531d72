#pragma once
// Shared by the parse_*.cpp files; not for users.
#include "osculate/deck/check.hpp"
#include "osculate/deck/description.hpp"

namespace osculate::deck {

// ---- plain values -----------------------------------------------------------------------------

[[nodiscard]] inline Number number_of(const Value& v) { return {v.number, v.mark}; }
[[nodiscard]] inline Name name_of(const Value& v) { return {v.text, v.mark}; }
[[nodiscard]] inline Marked<int> integer_of(const Value& v) { return {v.code, v.mark}; }

/// The enumerator of a choice; its code comes from the specification.
template <class E>
[[nodiscard]] Marked<E> word_of(const Value& v) {
  return {static_cast<E>(v.code), v.mark};
}

[[nodiscard]] Vec2 point_of(const Value& v);
/// Two or three coordinates; z = 0 where it is not given.
[[nodiscard]] Vec3 place_of(const Value& v);
/// At least one segment; consecutive points must differ.
[[nodiscard]] Marked<std::vector<Vec2>> points_of(const Value& v);
[[nodiscard]] Marked<std::vector<double>> numbers_of(const Value& v);

/// The text without its line breaks, for messages.
[[nodiscard]] std::string quoted(const std::string& text);

// ---- branches ---------------------------------------------------------------------------------

/// Where several sets are named in place of one: the set of them all, which this value then names.
void name_unions(Value& v, std::vector<SetDefinition>& sets);
/// What materials remember: each number of the catalogue once, and the materials that have it.
struct RememberedNumber {
  std::string word;            ///< of the history
  std::string_view name, doc;  ///< material::Remembered
  std::string materials;       ///< their keys
};
[[nodiscard]] std::vector<RememberedNumber> remembered_numbers();
/// The one of a quantity from Quantity::remembered on.
[[nodiscard]] inline RememberedNumber remembered_number(Quantity quantity) {
  return remembered_numbers().at(static_cast<std::size_t>(quantity) -
                                 static_cast<std::size_t>(Quantity::remembered));
}
/// The law of a map with at most one of the keys that laws have, beside that of the law of pairs
/// that name none.
[[nodiscard]] GivenLaw<contact::NormalLaw> normal_law_of(const Value& v);
/// The law of a map with one key.
[[nodiscard]] GivenLaw<contact::FrictionLaw> friction_law_of(const Value& v);
[[nodiscard]] GivenLaw<contact::DampingLaw> damping_law_of(const Value& v);
[[nodiscard]] DynamicsDescription parse_dynamics(const Value& v);
/// Contacts and rigid bodies decide what `on` means in the output.
void complete_output(Description& description);
/// The steps that results are asked of.
void check_answers(const Description& description);
/// Whether what is asked for has a column for its imaginary part beside it: it swings in a harmonic
/// step.
[[nodiscard]] bool has_imaginary_column(const HistoryRequest& request,
                                        const Description& description);
/// Columns that the history has without being asked: those of model::energy_quantities, where a
/// step has inertia, in their order, and the time step where one chooses it by its error.
[[nodiscard]] std::vector<std::string> energy_columns(const Description& description);

// ---- references between branches --------------------------------------------------------------

/// Names used twice, names of nothing, contradictions within a step. Throws core::InputError.
void check_references(const Description& description);
void check_steps(const Description& description);
void check_modal_steps(const Description& description);
/// Sections, shapes, displacements and loads that do not exist in a model of this dimension. Throws
/// core::InputError.
void check_dimension(const Description& description);
/// The error for a key or word that only models in space have.
[[nodiscard]] core::InputError only_in_space(const core::SourceMark& mark, std::string_view word);

}  // namespace osculate::deck
