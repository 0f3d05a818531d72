#pragma once
#include <span>

namespace osculate {

/// The layer of cells behind a piece of surface; the default is rigid.
struct Layer {
  double young = 0;  ///< of the unloaded material; 0: rigid
  double poisson = 0;
  double height = 0;  ///< of the cells: twice the distance of their middle from the surface
  double area = 1;    ///< of the piece, to average over several
};

/// Penalties per area.
struct Penalties {
  double normal = 0, shear = 0;
};

/// Penalties that are as stiff as the bodies need: so that the penetration is a tenth of what the
/// layers behind the contact are squeezed by (docs/decisions/020-automatic-penalty.md).
///
/// Formula    eps_N = 10 / (h_s / E_s + h_m / E_m) , eps_T the same with G = E / (2 (1 + nu)) ;
///            E / h of a side is the average over the areas of its pieces; a side without layers,
///            or of rigid ones, gives nothing
/// Errors     Refused where both sides are rigid, and for layers that cannot be
/// Tested by  tests/unit/embed/test_automatic_penalty.cpp
[[nodiscard]] Penalties automatic_penalties(std::span<const Layer> slave,
                                            std::span<const Layer> master);

/// What the penalties are multiplied by at a point behind which the stiffness is `ratio` times that
/// of the whole contact (for Contact::factors): 1 while the ratio is between 1/3 and 3.
///
/// Formula    ratio / 3 above, 3 ratio below: continuous, and never farther from the ratio than 3
[[nodiscard]] double penalty_factor(double ratio);

}  // namespace osculate
