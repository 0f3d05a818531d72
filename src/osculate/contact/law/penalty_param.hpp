#pragma once
#include <string_view>

#include "osculate/core/param.hpp"

namespace osculate::contact {

inline constexpr std::string_view penalty_unit = "force/length^3 (force/length with weight: node)";
inline constexpr core::Automatic from_compression{
    "Stiffness.", "From the stiffness of the bodies.",
    "ten times the stiffness against compression of the cells behind the contact; points with much "
    "stiffer or softer cells have more or less; the normal one follows the pressure in statics"};
inline constexpr core::Automatic from_shear{
    "Stiffness.", "From the stiffness of the bodies.",
    "ten times the stiffness against shear of the cells behind the contact; points with much "
    "stiffer or softer cells have more or less; the normal one follows the pressure in statics"};

/// The stiffness of a law, which the program finds from the bodies unless it is given.
///
/// Tested by  tests/unit/deck/test_contact_laws.cpp
template <class T>
[[nodiscard]] constexpr core::Param<T> penalty_param(std::string_view key, std::string_view doc,
                                                     const core::Automatic& automatic) {
  return {.key = key,
          .unit = penalty_unit,
          .doc = doc,
          .slot = &T::stiffness,
          .range = {.lower = 0},
          .example = "2.1e6",
          .automatic = &automatic};
}

/// The same of a law of friction.
template <class T>
[[nodiscard]] constexpr core::Param<T> shear_penalty_param() {
  return penalty_param<T>("penalty", "Stiffness against sliding while the point sticks.",
                          from_shear);
}

}  // namespace osculate::contact
