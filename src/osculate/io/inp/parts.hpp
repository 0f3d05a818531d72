#pragma once
#include <vector>

#include "osculate/core/types.hpp"
#include "osculate/io/inp/cards.hpp"

namespace osculate::io::inp {

/// How an instance is put: moved, then turned.
struct Placement {
  Vec3 move = Vec3::Zero(), about = Vec3::Zero(), axis = Vec3::Zero();
  double angle = 0;  ///< radians, right-handed about the axis

  [[nodiscard]] Mat<3, 3> turn() const;
  [[nodiscard]] Vec3 place(const Vec3& x) const { return about + turn() * (x + move - about); }
};

/// From the lines of an `*INSTANCE`.
///
/// Errors     core::InputError: more than two lines, an axis without direction
[[nodiscard]] Placement placement_of(const Deck& deck, const Card& instance);

/// Sections and orientations that stand in parts and instances become those of the instances,
/// behind their `*END INSTANCE`: `ELSET=Set-1` is `ELSET=INSTANCE.Set-1` then, and axes turn with
/// the instance.
///
/// Tested by  tests/unit/io/test_inp_parts.cpp, tests/unit/deck/test_inp_cae.cpp
void give_sections_to_instances(Deck& deck);

}  // namespace osculate::io::inp
