#pragma once
// Shared by the build_*.cpp files; not for users.
#include <optional>
#include <string>

#include "osculate/body/inertia.hpp"
#include "osculate/deck/build_context.hpp"

namespace osculate::deck {

/// The volume that a rigid body encloses, or why it encloses none ("has an open surface").
template <int Dim>
struct EnclosedVolume {
  std::optional<body::VolumeMoments<Dim>> moments;
  std::string why;
};

/// Volume, centre and second moments of a rigid body: of the analytic shape; of the closed polyline
/// or curve; of the closed surface of the set, or of the cells of a set of areas (in space:
/// volumes).
///
/// Sign       a boundary whose normal points into what it encloses is a hole: no volume
/// Limits     exact for facets up to second order and volumes bounded by them; where one part of a
///            surface crosses another, what lies between them counts twice
/// Tested by  tests/unit/deck/test_body_moments.cpp
template <int Dim>
[[nodiscard]] EnclosedVolume<Dim> enclosed_volume(const BuildContext<Dim>& c, const Rigid& rigid,
                                                  const model::BasicRigidBody<Dim>& body);

}  // namespace osculate::deck
