#pragma once
// Eight cells at once, where the processor has registers for them.
#include <array>

#include "osculate/core/pack.hpp"

namespace osculate::solid {

/// What the forces of hex8 of neo-Hooke in finite strain need beside their numbers: plain values,
/// since batch_wide.cpp is compiled for other processors than its callers.
struct EightCells {
  bool one_point = false;  ///< else all points
  bool mean = false;       ///< with the mean dilatation
  double young = 0, poisson = 0;
  std::array<double, 2> moduli{};  ///< of the modes, one point
};
/// What two batches of four have or get.
template <class T>
using TwoFours = std::array<T*, 2>;

/// Whether batch_wide.cpp was compiled for such processors.
extern const bool built_for_eight;
/// Whether this is one: AVX-512 F, DQ, VL, BW and CD.
[[nodiscard]] bool has_eight_lanes();

/// The forces of two batches of four, bit by bit those of `batch_forces`.
///
/// Requires   has_eight_lanes()
/// Returns    false: one of the cells has no answer, or is turned inside out
/// Tested by  tests/unit/solid/test_batch.cpp
[[nodiscard]] bool forces_of_eight(const EightCells& of, const TwoFours<const core::Pack>& numbers,
                                   const TwoFours<const core::Pack>& u,
                                   const TwoFours<core::Pack>& force);

}  // namespace osculate::solid
