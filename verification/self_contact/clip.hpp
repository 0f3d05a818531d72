#pragma once
// A clip whose lips close, in the plane and in space.
#include <cmath>
#include <numbers>
#include <vector>

#include "../workers.hpp"
#include "osculate/core/types.hpp"

namespace osculate::verification {

/// Two arms joined by half a ring; built as a straight strip (s along it, r from its inner side)
/// and bent in the mesh. Symmetric about the plane between the arms, nodes included. The lips are
/// either a rounded bulge of each arm, or the ends of square columns that stand on the arms.
struct Clip {
  double arm = 4, inner = 0.5, thick = 0.25;
  double top = 3, bulge = 0.3, width = 0.6;  ///< of the rounded lips
  /// Height of the columns (0: none), and from where to where on the arm they stand; only the rest
  /// of the thickness runs on as arm and ring.
  double column = 0, from = 0, to = 0;
  double young = 100, poisson = 0.3, penalty = 4000, close = 0.26;

  [[nodiscard]] double bend() const { return std::numbers::pi * (inner + 0.5 * thick); }
  [[nodiscard]] double length() const { return 2 * arm + bend(); }
  /// Place of a point of the strip; the lower arm comes first.
  [[nodiscard]] Vec2 at(double s, double r) const;
};

/// Columns of length 0.5 and width 0.8, 0.4 apart. The nodes that their load holds are all that
/// joins them to the arms, and there is no lateral contraction, so they are in uniaxial stress.
[[nodiscard]] Clip clip_with_columns();
/// Contact force per depth of these: E / 2 (1 / l - l) = -penalty g for the stretch l, which
/// follows from the gap g = 2 (inner - close + (1 - l) column).
[[nodiscard]] double column_force(const Clip& clip);

enum class ClipKind {
  own,    ///< the whole surface against itself
  all,    ///< contact: all
  sides,  ///< the inner side of one arm against that of the other
  half    ///< the inner side of the lower half against a rigid plane in the middle, of twice the
          ///< stiffness: the gap there is half of that between the arms
};

struct ClipStudy {
  ClipKind kind = ClipKind::own;
  bool space = false;
  int refine = 1;
  double mu = 0;  ///< not on the plane: between the arms symmetry leaves no slip
};

/// What the end of the run shows.
struct ClipOutcome {
  bool converged = false;
  double closing = 0, contact = 0, area = 0;  ///< force on the loaded nodes; of the contact; area
};

[[nodiscard]] ClipOutcome run_clip(const Clip& clip, const ClipStudy& study,
                                   const Workers& workers);

}  // namespace osculate::verification
