#pragma once
#include <string>
#include <vector>

#include "osculate/model/system.hpp"

namespace osculate::model {

/// A rigid motion of one body that the tangent hardly resists.
struct FreeMotion {
  std::string body;
  Vec2 direction{0, 0};  ///< unit vector of a translation (zero for a pure rotation)
  double rotation = 0;   ///< about the body's centroid, relative to the translation
  Vec2 center{0, 0};
  double stiffness_ratio = 0;  ///< resistance relative to the body's own stiffness
};

/// Rigid-body modes of every deformable body that the tangent of the last evaluation does not
/// resist in its forces: the singular values of Z^T K Z (Z = two translations and a rotation,
/// scaled by the body's size) below 1e-6 of the body's own stiffness.
[[nodiscard]] std::vector<FreeMotion> free_motions(System& system, const Model& model,
                                                   const State& state);

/// `body 'block' is free to move along (0.9578, 0.2873)`, or empty.
[[nodiscard]] std::string free_motion_message(System& system, const Model& model,
                                              const State& state);

}  // namespace osculate::model
