#pragma once
// Shared by the build_*.cpp files; not for users.
#include "osculate/deck/build_context.hpp"
#include "osculate/model/enclosed_volume.hpp"

namespace osculate::deck {

/// Volume, centre and second moments of a rigid body: of the analytic shape; of the closed polyline
/// or curve; of the closed surface of the set, or of the cells of a set of areas (in space:
/// volumes).
///
/// Tested by  tests/unit/deck/test_body_moments.cpp
template <int Dim>
[[nodiscard]] model::EnclosedVolume<Dim> enclosed_volume(const BuildContext<Dim>& c,
                                                         const Rigid& rigid,
                                                         const model::BasicRigidBody<Dim>& body);

}  // namespace osculate::deck
