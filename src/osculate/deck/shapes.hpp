#pragma once
// The shapes that rigid bodies and surfaces may have; not for users.
#include "osculate/deck/bind.hpp"

namespace osculate::deck {

using ShapeKey = OneOf<RigidShape>;

/// The shapes that need no mesh: those of the plane, then those of space; composite ones are for
/// rigid bodies.
[[nodiscard]] std::vector<ShapeKey> shape_keys(bool with_composite);
/// Curves joined to one surface.
[[nodiscard]] ShapeKey composite_key();

}  // namespace osculate::deck
