#pragma once
// The parts of the case, one a file.
#include "../case.hpp"

namespace osculate::verification {

/// Projection onto faces alone, onto overlapping faces, and the generalised one (KSCPP Fig. 12).
void add_projections(CaseResult& out);
/// Where the corner slips, lifts off and jumps, over the way L and the friction.
void add_map(CaseResult& out);
/// The vibration of the penalty's spring, and what takes it out.
void add_vibration(CaseResult& out);
/// One impact with every means of enforcing contact.
void add_side_by_side(CaseResult& out);

}  // namespace osculate::verification
