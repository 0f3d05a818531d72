#pragma once
// Runs of the solver with the rigid block on slope and floor, from any place of its way.
#include <optional>
#include <vector>

#include "reference.hpp"

namespace osculate::verification {

/// What of slope and floor the block's nodes are projected onto.
///   generalized  one master: faces and the valley line between them
///   faces        two masters that end at the valley line, and nothing between them
///   overlapping  two masters at the same time, each goes on beyond the valley line
enum class ReentrantVertex { generalized, faces, overlapping };

/// A model of the rigid block with m = g = a = 1. Penalties are those of a node, the same for the
/// normal and the shear.
struct BlockRun {
  BlockState start;           ///< place of the lower front corner, its velocity, angle and rate
  double friction = 0.5;      ///< infinite: rough
  bool smooth_slope = false;  ///< friction on the floor only; not with ReentrantVertex::generalized
  ReentrantVertex reentrant = ReentrantVertex::generalized;
  double penalty = 1e4;
  double viscous = 0;  ///< damper beside the spring
  const char* enforcement = "penalty";
  const char* impact = "plastic";
  int increments = 800;
  double duration = 3.2;
};

/// At rest, the way `slid` up the slope.
[[nodiscard]] BlockState at_rest(double slid);
/// On the slope, which brakes with `slope_friction`, so that the corner is at the valley line after
/// `time_left` with the speed of a block that has slid the way L without friction.
[[nodiscard]] BlockState before_impact(double slid, double slope_friction, double time_left);

/// One converged increment.
struct BlockSample {
  double time = 0;
  Vec2 corner = Vec2::Zero();  ///< the lower front one
  double angle = 0, rate = 0;
  Vec2 force = Vec2::Zero();  ///< of slope and floor on the block
  bool corner_open = true;    ///< the lower front corner has no contact
  bool front_open = true;     ///< the upper front corner has none
};

/// At the start and after each increment; `finished` is false where one found no solution.
struct BlockPath {
  std::vector<BlockSample> samples;
  bool finished = false;
};

[[nodiscard]] BlockPath path_of(const BlockRun& run);

/// The samples between the impact and the second contact.
struct Turning {
  std::size_t begin = 0, end = 0;
  std::optional<double> landed;  ///< time of the second contact
};
[[nodiscard]] Turning turning(const BlockPath& path, double impact);

/// The last increments had one length. (A plastic step leaves a body at rest with half the speed of
/// a fall over the step, so that forces jump where steps change their length.)
[[nodiscard]] bool even_steps(const std::vector<BlockSample>& samples, std::size_t i);

}  // namespace osculate::verification
