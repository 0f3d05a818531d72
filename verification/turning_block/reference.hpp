#pragma once
// The rigid block of KSCPP 5.2: it slides down a slope of 45 degrees, its lower front corner meets
// the valley line, and it turns over this corner until its front face meets the floor. The
// mathematics is in docs/turning_block.md.
#include <vector>

#include "osculate/core/types.hpp"

namespace osculate::verification {

/// A homogeneous square block, at rest until it is let go with its corner `slid` up the slope.
///
/// Frame      origin at the valley line, x along the floor away from the slope, y up
/// Requires   slid > 0, 0 <= slope_friction < 1, friction >= 0 and finite
struct TurningBlock {
  double edge = 1;            ///< a
  double mass = 1;            ///< per thickness, as all forces
  double gravity = 9.81;      ///< g
  double slid = 0.3;          ///< L: way of the block along the slope from rest to the valley
  double friction = 0.5;      ///< mu of the floor
  double slope_friction = 0;  ///< of the slope; the paper has none
};

/// The corner that meets the valley line, and how far the block has turned about it: angle 0 while
/// it slides (the centre of mass then is above the corner), pi / 4 with the front face on the
/// floor.
struct BlockState {
  double time = 0;
  Vec2 corner = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();  ///< of the corner
  double angle = 0;
  double rate = 0;  ///< of the angle
};

[[nodiscard]] Vec2 centre(const TurningBlock& block, const BlockState& state);
[[nodiscard]] Vec2 centre_velocity(const TurningBlock& block, const BlockState& state);
[[nodiscard]] double kinetic_energy(const TurningBlock& block, const BlockState& state);
[[nodiscard]] double potential_energy(const TurningBlock& block, const BlockState& state);

// Closed forms. All but the first three are for a corner that sticks.

/// t = sqrt(2 L / b), b = g (1 - slope_friction) / sqrt(2)
[[nodiscard]] double impact_time(const TurningBlock& block);
/// v = sqrt(2 L b)
[[nodiscard]] double impact_speed(const TurningBlock& block);
/// phi' after the plastic impact: 3 v / (4 a), or 3 mu v / a where mu < 1/4 lets the corner slip.
[[nodiscard]] double rate_after_impact(const TurningBlock& block);
/// phi'^2 = phi'_0^2 + 3 g / (sqrt(2) a) (1 - cos(phi))
[[nodiscard]] double turning_rate(const TurningBlock& block, double angle);
/// From the impact until the angle is reached: an elliptic integral of the first kind.
[[nodiscard]] double turning_time(const TurningBlock& block, double angle);
/// What floor and slope together do to the block. Along the line from the corner to the centre it
/// is m g (5 cos(phi) - 3) / 2 - (9/16) m g L / a, across -m g sin(phi) / 4.
[[nodiscard]] Vec2 turning_reaction(const TurningBlock& block, double angle);

// Thresholds of L / a for a slope without friction (otherwise: of (1 - slope_friction) L / a).

/// The corner neither slips nor leaves the floor below this one, for mu >= 1/4.
/// Formula    (4/9) (5 sqrt(2) - 6) - (2 sqrt(2) / 9) (1 - mu) / (1 + mu); mu may be infinite
[[nodiscard]] double longest_without_slip(double friction);
/// Its inverse, not below the 1/4 that the impact asks for; infinite above `longest_without_slip`.
[[nodiscard]] double friction_without_slip(double slid_over_edge);
/// The corner is off the floor at once above this one: 16/9, or 1 / (9 mu^2) where it slips at
/// impact. Nothing else ever makes it leave the floor.
[[nodiscard]] double shortest_jump(double friction);

enum class BlockPhase { sliding, sticking, slipping, flying };

enum class BlockEnd {
  second_contact,  ///< front face, or front upper corner, on the floor
  at_the_slope,    ///< the corner came back to the valley line: not followed further
  still_upright    ///< after 50 sqrt(a / g): without friction the block balances on its corner
};

/// One stretch of the motion in one phase, with states at equal steps but for the last.
struct BlockStage {
  BlockPhase phase = BlockPhase::sliding;
  int direction = 0;  ///< of slipping: +1 away from the slope
  std::vector<BlockState> states;
};

struct BlockMotion {
  TurningBlock block;
  std::vector<BlockStage> stages;
  std::vector<Vec2> impulses;  ///< on the block at the valley, and where it lands after a jump
  BlockEnd end = BlockEnd::second_contact;
};

/// Follows the block from rest to its second contact. `step`: of the classical Runge-Kutta rule, in
/// sqrt(a / g); with the default times and rates are good to 1e-11 of their size.
[[nodiscard]] BlockMotion follow(const TurningBlock& block, double step = 2e-3);

/// At any time from 0 to the end; after the impact, where the time is that of an impact.
[[nodiscard]] BlockState state_at(const BlockMotion& motion, double time);
/// Force of slope and floor on the block; R_t is its x, R_n its y.
[[nodiscard]] Vec2 reaction_at(const BlockMotion& motion, double time);

/// What happens on the way, at the impact and before the second contact.
enum class TurningKind { turns, slips, slips_at_impact, jumps };
[[nodiscard]] TurningKind turning_kind(double slid_over_edge, double friction);

/// The second impact, at the front upper corner, plastic as the first.
struct SecondImpact {
  double rate = 0;               ///< of turning over that corner; 0: the face lies
                                 ///< on the floor, negative: it falls there (after a jump)
  Vec2 velocity = Vec2::Zero();  ///< of that corner
  Vec2 impulse = Vec2::Zero();   ///< on the block
};

/// Requires   the state at the end of a motion with `BlockEnd::second_contact`
[[nodiscard]] SecondImpact second_impact(const TurningBlock& block, const BlockState& state);

}  // namespace osculate::verification
