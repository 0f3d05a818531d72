#pragma once
#include "osculate/material/response.hpp"

namespace osculate::material {

/// The response of the plane where the stress across it vanishes: E33 follows.
///
/// Formula    D - D_3 D_3^T / D_33 , S33 = 0
/// Requires   D_33 is not 0
[[nodiscard]] inline Response without_stress_across(Response r) {
  const Tangent full = r.tangent;
  r.tangent -= full.col(2) * full.row(2) / full(2, 2);
  r.tangent.row(2).setZero();
  r.tangent.col(2).setZero();
  r.stress[2] = 0;
  return r;
}

}  // namespace osculate::material
