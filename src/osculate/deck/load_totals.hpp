#pragma once
// Shared by the build_*.cpp files; not for users.
#include "osculate/deck/build_context.hpp"

namespace osculate::deck {

/// Resultant of a load of the undeformed model, times its value 1. Bodies are at their reference
/// points. In axisymmetric models the x of the force is radial, summed up round the circumference.
///
/// Tested by  tests/unit/deck/test_load_totals.cpp
template <int Dim>
[[nodiscard]] Resultant resultant(const model::BasicModel<Dim>& m,
                                  const std::vector<std::pair<model::Dof, double>>& unit);
/// Of a pressure.
template <int Dim>
[[nodiscard]] Resultant resultant(const model::BasicModel<Dim>& m,
                                  const std::vector<model::PressureLoad::Facet>& facets);
/// Mass, and its first moment about the origin, of all bodies.
struct Masses {
  double mass = 0;
  Vec3 moment = Vec3::Zero();
};
template <int Dim>
[[nodiscard]] Masses masses(const model::BasicModel<Dim>& m);
/// Of an acceleration of them all.
[[nodiscard]] Resultant weight(const Masses& masses, const Vec3& acceleration);

}  // namespace osculate::deck
