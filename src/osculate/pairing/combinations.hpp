#pragma once
#include <span>
#include <string_view>

#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// Choices on the axes of a contact pair that do not go with every other one.
enum class Trait : std::uint8_t {
  own_surface,        ///< a surface with itself, or all bodies
  two_pass,           ///< both sides are slaves in turn
  quadrature,         ///< sampled at quadrature points of the slave's facets
  mortar,             ///< integrated over the slave's facets
  edges,              ///< sampled where sharp edges cross too
  named_edges,        ///< the same of a pair that is named, not of all bodies
  points_only,        ///< the slave is a set of points without facets
  analytic_master,    ///< a shape without nodes
  smoothed_master,    ///< a smooth surface through the nodes
  long_lines,         ///< facets in the plane with more than 4 nodes
  gap_law,            ///< the pressure is a function of the gap by itself
  damping,            ///< of the normal law
  held,               ///< any separation but `allowed`
  held_from_start,    ///< tied_normal, tied
  keeps_gap,          ///< held from the start without a force of their gaps
  tied,               ///< without slip too
  slides,             ///< friction that has a limit
  relieved_overlap,   ///< initial overlaps that are ramped, or do not count
  given_clearance,    ///< initial gaps that are given
  corrected,          ///< augmented Lagrangian or multipliers
  multipliers,        ///< the tractions are unknowns
  nodal_weight,       ///< weight: node
  full_residual,      ///< residual: full
  covariant_tangent,  ///< another tangent than the consistent one
  printed_history,    ///< history: chord, per_facet
  explicit_time,      ///< a step of central differences
  count
};

/// The traits of a pair as a set.
class Traits {
 public:
  constexpr void add(Trait t, bool there = true) {
    if (there) bits_ |= 1u << static_cast<unsigned>(t);
  }
  [[nodiscard]] constexpr bool has(Trait t) const {
    return (bits_ >> static_cast<unsigned>(t) & 1u) != 0;
  }

 private:
  std::uint32_t bits_ = 0;
};

/// Two choices that do not go together. The first one is what a user would change, and where a
/// reader of model files tells it.
struct Refusal {
  Trait told_at, other;
  std::string_view why;
};

/// The one table of what does not go together; all else does. The reader of model files, `prepare`,
/// the evaluator for other codes, explicit analyses and docs/combinations.md read it.
///
/// Tested by  tests/unit/pairing/test_combinations.cpp, tests/conformance/test_combinations.cpp
[[nodiscard]] std::span<const Refusal> refusals();
/// The first refusal that concerns a pair with these traits.
[[nodiscard]] const Refusal* refusal(const Traits& traits);

/// Traits of a pair as it is defined.
template <int Dim>
[[nodiscard]] Traits traits_of(const PairDefinition<Dim>& pair);

/// The sentence of two choices that do not go together.
[[nodiscard]] std::string_view why_not(Trait told_at, Trait other);

/// What a trait is called in the documentation.
[[nodiscard]] std::string_view name_of(Trait trait);

}  // namespace osculate::pairing
