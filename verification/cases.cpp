#include "cases.hpp"

namespace osculate::verification {

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases{
      {"beam_over_cylinder", "The solid-shell beam of KSVD 5.1 is bent over a rigid cylinder",
       false, beam_over_cylinder},
      {"beam_over_sphere",
       "The solid-shell beam of KSVD 5.2 is bent and twisted over a rigid sphere", false,
       beam_over_sphere},
      {"cattaneo_mindlin", "Partial slip of equal bodies, 8 elements over the half-width", false,
       cattaneo_mindlin},
      {"cattaneo_mindlin_fine", "The same with 64 elements over the half-width", true,
       cattaneo_mindlin_fine},
      {"closest_points", "Random points find their closest points, features and margins", false,
       closest_points},
      {"closest_points_many", "The same with 100 000 points for every curve and surface", true,
       closest_points_many},
      {"closed_loop", "A block dragged in a closed loop: path dependence and dissipated work",
       false, closed_loop},
      {"contact_patch", "Blocks in contact transmit a uniform pressure unchanged", false,
       contact_patch},
      {"contact_patch_space", "Blocks in space in contact transmit a uniform pressure unchanged",
       false, contact_patch_space},
      {"critical_displacement", "A sheared layer starts to slide as a whole where eq. (90) says",
       false, critical_displacement},
      {"drag_in_space", "Friction in space: quadratic convergence, covariant tangent beside it",
       false, drag_in_space},
      {"hertz_ball",
       "A ball on a half-space in space gives Hertz's pressure with 3 elements over the radius",
       false, hertz_ball},
      {"hertz_line", "A circle on a half-plane gives Hertz's pressure for the computed force",
       false, hertz_line},
      {"hertz_sphere", "A sphere on a half-space follows F = 4/3 E* sqrt(R) d^1.5", false,
       hertz_sphere},
      {"hyperbolic_surface",
       "The projection domain of KSCPP 5.1 has its corner C', from a facet, a patch and a mesh",
       false, hyperbolic_surface},
      {"incline", "A block on a slope rests below the friction angle and slides above it", false,
       incline},
      {"large_rotation", "The consistent tangent converges quadratically under large rotation",
       false, large_rotation},
      {"projection_domains",
       "Domains of corners, edges, arcs and planar points are those of KSCPP, and the reach", false,
       projection_domains},
      {"sliding_block", "The block of KS2D 7.1 is pressed, sheared forward and back", false,
       sliding_block},
      {"solid_shell", "Solid-shells pass the patch tests and the classical thin shells", false,
       solid_shell},
      {"solid_shell_fine", "The same under large displacements on fine meshes", true,
       solid_shell_fine},
  };
  return cases;
}

}  // namespace osculate::verification
