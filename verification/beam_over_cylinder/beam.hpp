#pragma once
// The model of KSVD 5.1.
#include <numbers>

#include "../case.hpp"
#include "../model3.hpp"

namespace osculate::verification {

constexpr double beam_length = 24, beam_height = 0.25, beam_width = 1, cylinder_radius = 2,
                 tip_pull = 9, beam_modulus = 1e4;

/// What differs between the runs.
struct BeamModel {
  bool quadratic = false;
  int elements = 24;
  double poisson = 0.3;
  double penalty = 1e4;
  contact::TangentForm tangent;
  bool cylinder_master = false;                ///< the beam's nodes are the slaves
  double from = 0, to = 2 * std::numbers::pi;  ///< part of the cylinder, clockwise from its top
  int chords = 49;                             ///< of that part
  int increments = 90;
};

/// Beam of solid-shells (bottom at z = 0, one through the thickness and across the width) over a
/// rigid cylinder of chords; clamped at x = 0, the bottom nodes of the free end move by -tip_pull.
[[nodiscard]] model::Model3 beam_model(const BeamModel& options);

/// The run on refined meshes over a smooth cylinder against the inextensible elastica.
void add_elastica(const CaseContext& context, CaseResult& result);

}  // namespace osculate::verification
