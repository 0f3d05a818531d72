#pragma once
#include "case.hpp"

namespace osculate::verification {

// One function per case folder.
[[nodiscard]] CaseResult bar_impact(const CaseContext& context);
[[nodiscard]] CaseResult beam_over_cylinder(const CaseContext& context);
[[nodiscard]] CaseResult beam_over_sphere(const CaseContext& context);
[[nodiscard]] CaseResult bouncing_ball(const CaseContext& context);
[[nodiscard]] CaseResult cattaneo_mindlin(const CaseContext& context);
[[nodiscard]] CaseResult cattaneo_mindlin_fine(const CaseContext& context);
[[nodiscard]] CaseResult closest_points(const CaseContext& context);
[[nodiscard]] CaseResult closest_points_many(const CaseContext& context);
[[nodiscard]] CaseResult closed_loop(const CaseContext& context);
[[nodiscard]] CaseResult contact_laws(const CaseContext& context);
[[nodiscard]] CaseResult contact_patch_space(const CaseContext& context);
[[nodiscard]] CaseResult enforcement(const CaseContext& context);
[[nodiscard]] CaseResult explicit_bar(const CaseContext& context);
[[nodiscard]] CaseResult free_top(const CaseContext& context);
[[nodiscard]] CaseResult graded_cells(const CaseContext& context);
[[nodiscard]] CaseResult hard_problems(const CaseContext& context);
[[nodiscard]] CaseResult hard_problems_all(const CaseContext& context);
[[nodiscard]] CaseResult hertz_ball(const CaseContext& context);
[[nodiscard]] CaseResult hertz_sphere(const CaseContext& context);
[[nodiscard]] CaseResult hyperbolic_surface(const CaseContext& context);
[[nodiscard]] CaseResult impact_law(const CaseContext& context);
[[nodiscard]] CaseResult crossed_edges(const CaseContext& context);
[[nodiscard]] CaseResult hertz_line(const CaseContext& context);
[[nodiscard]] CaseResult buckling(const CaseContext& context);
[[nodiscard]] CaseResult vibrations(const CaseContext& context);
[[nodiscard]] CaseResult cyclic_modes(const CaseContext& context);
[[nodiscard]] CaseResult large_rotation(const CaseContext& context);
[[nodiscard]] CaseResult projection_domains(const CaseContext& context);
[[nodiscard]] CaseResult scaled_bar(const CaseContext& context);
[[nodiscard]] CaseResult self_contact(const CaseContext& context);
[[nodiscard]] CaseResult sliding_block(const CaseContext& context);
[[nodiscard]] CaseResult ironing(const CaseContext& context);
[[nodiscard]] CaseResult smoothed_circle(const CaseContext& context);
[[nodiscard]] CaseResult soft_impact(const CaseContext& context);
[[nodiscard]] CaseResult spinning_disc(const CaseContext& context);
[[nodiscard]] CaseResult time_order(const CaseContext& context);
[[nodiscard]] CaseResult time_steps(const CaseContext& context);
[[nodiscard]] CaseResult turning_block(const CaseContext& context);
[[nodiscard]] CaseResult strip_into_channel(const CaseContext& context);
[[nodiscard]] CaseResult snap_through(const CaseContext& context);
[[nodiscard]] CaseResult solid_shell(const CaseContext& context);
[[nodiscard]] CaseResult solid_shell_fine(const CaseContext& context);
[[nodiscard]] CaseResult user_material(const CaseContext& context);

}  // namespace osculate::verification
