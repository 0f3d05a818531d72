#include "cases.hpp"

#include <algorithm>

#include "data_case.hpp"

namespace osculate::verification {
namespace {

std::vector<Case> computed_cases() {  // long: the one list
  return {
      {"bar_impact", "An elastic bar flies against a wall and bounces off after the time of a wave",
       false, bar_impact},
      {"beam_over_cylinder", "The solid-shell beam of KSVD 5.1 is bent over a rigid cylinder",
       false, beam_over_cylinder},
      {"beam_over_sphere",
       "The solid-shell beam of KSVD 5.2 is bent and twisted over a rigid sphere", false,
       beam_over_sphere},
      {"bouncing_ball", "A ball bounces twenty times on a penalty, or stays where it falls", false,
       bouncing_ball},
      {"buckling",
       "Columns, a plate and a ring buckle, and pressed strips vibrate, as they do in theory",
       false, buckling},
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
      {"contact_laws", "Each law of contact in a model with a closed solution; tied patch tests",
       false, contact_laws},
      {"contact_patch_space", "Blocks in space in contact transmit a uniform pressure unchanged",
       false, contact_patch_space},
      {"crossed_edges",
       "Rods that touch with crossing edges carry the closed form of the penalty, in any pose",
       false, crossed_edges},
      {"enforcement",
       "Multipliers leave no gap, and the augmented Lagrangian meets its target with any penalty",
       false, enforcement},
      {"explicit_bar", "Central differences with the critical step are exact at the nodes of a bar",
       false, explicit_bar},
      {"free_top",
       "A free top keeps its momentum, gains no energy, and flips as Euler's equations say", false,
       free_top},
      {"graded_cells",
       "Cells of heights 1 to 1000 beside each other: the penetration is small against each of "
       "them",
       false, graded_cells},
      {"hard_problems",
       "Problems that are hard for step control finish with default settings, or say why not",
       false, hard_problems},
      {"hard_problems_all", "All of them, and what each remedy of the step control is worth", true,
       hard_problems_all},
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
      {"impact_law",
       "Bodies leave an impact with e times their speed, or as a spring and a damper say", false,
       impact_law},
      {"large_rotation", "The consistent tangent converges quadratically under large rotation",
       false, large_rotation},
      {"projection_domains",
       "Domains of corners, edges, arcs and planar points are those of KSCPP, and the reach", false,
       projection_domains},
      {"scaled_bar", "Mass for longer time steps: a bar with a point mass, and no weight", false,
       scaled_bar},
      {"self_contact",
       "A clip that closes on itself is the half of it on a plane; contact: all finds the pairs",
       false, self_contact},
      {"sliding_block", "The block of KS2D 7.1 is pressed, sheared forward and back", false,
       sliding_block},
      {"ironing", "A punch is pressed into a soft slab and dragged along it with friction", true,
       ironing},
      {"smoothed_circle",
       "A smooth master takes the ripple off the force on a point that slides on it", false,
       smoothed_circle},
      {"soft_impact", "Explicit and implicit time integration agree on a soft impact", false,
       soft_impact},
      {"spinning_disc", "Friction stops a disc on its face, and makes one on its rim roll", false,
       spinning_disc},
      {"strip_into_channel", "The strip of KS2D 7.2 is drawn into a channel, in all its variants",
       false, strip_into_channel},
      {"snap_through",
       "A truss and a roller over a detent follow their exact curves where the load falls", false,
       snap_through},
      {"solid_shell", "Solid-shells pass the patch tests and the classical thin shells", false,
       solid_shell},
      {"solid_shell_fine", "The same under large displacements on fine meshes", true,
       solid_shell_fine},
      {"time_order",
       "Displacements and velocities are of second order in time with every implicit scheme", false,
       time_order},
      {"time_steps",
       "Errors are in proportion to what is allowed where time steps are chosen by them", false,
       time_steps},
      {"turning_block", "A rigid block slides into a valley and turns over its corner (KSCPP 5.2)",
       false, turning_block},
      {"cyclic_modes",
       "Free vibrations of one sector, by nodal diameters, are those of the whole ring", false,
       cyclic_modes},
      {"vibrations",
       "Free vibrations about a state are those of bars on walls, free bodies, strings", false,
       vibrations},
      {"user_material",
       "A metal that is a routine of the user equals the closed solution and the built-in metal",
       false, user_material},
  };
}

}  // namespace

std::vector<Case> all_cases(const std::string& folder) {
  std::vector<Case> cases = computed_cases();
  for (Case& data : data_cases(folder)) {
    const auto same = std::find_if(cases.begin(), cases.end(),
                                   [&](const Case& c) { return c.name == data.name; });
    if (same == cases.end()) {
      cases.push_back(std::move(data));
      continue;
    }
    same->run = [first = same->run, second = data.run](const CaseContext& context) {
      CaseResult out = first(context);
      for (Row& row : second(context).rows) out.rows.push_back(std::move(row));
      return out;
    };
  }
  std::sort(cases.begin(), cases.end(),
            [](const Case& a, const Case& b) { return a.name < b.name; });
  return cases;
}

}  // namespace osculate::verification
