#pragma once
// Shared by the keys of generated parts; not for users.
#include "osculate/deck/bind.hpp"

namespace osculate::deck {

/// The key of a kind of generated part.
using PartKey = OneOf<decltype(GeneratedPart::shape)>;

// Rectangles, rings and discs, with z boxes and cylinders.
[[nodiscard]] PartKey box_key();
[[nodiscard]] PartKey ring_key();
[[nodiscard]] PartKey disc_key();

/// The number of elements in one interval.
[[nodiscard]] Spec interval_count();
/// A plain value for every interval, or a list that must have one value per interval.
[[nodiscard]] std::vector<int> counts_of(const Value& v, std::size_t intervals);
/// Refuses numbers of elements that no machine could hold.
void require_size(double elements, const core::SourceMark& mark);
[[nodiscard]] double total(const std::vector<int>& counts);

/// Two of the same.
[[nodiscard]] Spec pair_of(std::string doc, const Spec& one);
[[nodiscard]] Spec radius_spec();
/// A direction of any length but zero.
[[nodiscard]] Spec vector_spec(std::string doc);
void require_direction(const Value& v);

}  // namespace osculate::deck
