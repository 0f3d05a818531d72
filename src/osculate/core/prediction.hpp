#pragma once
#include <cstdint>

namespace osculate {

/// What the first iteration of an increment takes the friction of points in contact for.
///   as_before   what slid goes on sliding, all else sticks
///   sticking    all points stick: what can be solved where sliding points alone hold a body
///   sliding     what slid goes on sliding; points without shear slide without friction: a rope
///   that
///               is laid on a drum without tension has no pressure, and so no friction, to begin
///               with
enum class Prediction : std::uint8_t { as_before, sticking, sliding };

}  // namespace osculate
