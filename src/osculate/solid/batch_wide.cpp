// Compiled for processors with AVX-512 (CMakeLists.txt), and called on these alone. Nothing of it
// may be shared with other sources: all that is not inlined has BasicPack<8> in its name.
#include "osculate/solid/batch_wide.hpp"

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#include "osculate/material/pointwise_laws.hpp"
#include "osculate/solid/batch_points.hpp"

namespace osculate::solid {
namespace {

using core::Pack;
using Wide = core::BasicPack<8>;
constexpr int dofs_of_hex8 = 24, numbers_of_hex8 = 21;

template <int Count>
void join(const TwoFours<const Pack>& fours, Wide* out) {
  for (int k = 0; k < Count; ++k)
    out[k].v = __builtin_shufflevector(fours[0][k].v, fours[1][k].v, 0, 1, 2, 3, 4, 5, 6, 7);
}

}  // namespace

const bool built_for_eight = true;

bool forces_of_eight(const EightCells& of, const TwoFours<const Pack>& numbers,
                     const TwoFours<const Pack>& u, const TwoFours<Pack>& force) {
  Wide n[numbers_of_hex8], along[dofs_of_hex8], out[dofs_of_hex8];
  join<numbers_of_hex8>(numbers, n);
  join<dofs_of_hex8>(u, along);
  const material::NeoHooke law{of.young, of.poisson, 0};
  bool answered = false;
  if (of.one_point)
    answered = batches::one_point_forces<3>(law, true, of.moduli, 1.0, n, along, out);
  else if (of.mean)
    answered = batches::points_forces<true, 3>(law, 1.0, n, along, out);
  else
    answered = batches::points_forces<false, 3>(law, 1.0, n, along, out);
  for (int k = 0; k < dofs_of_hex8; ++k) {
    force[0][k].v = __builtin_shufflevector(out[k].v, out[k].v, 0, 1, 2, 3);
    force[1][k].v = __builtin_shufflevector(out[k].v, out[k].v, 4, 5, 6, 7);
  }
  return answered;
}

}  // namespace osculate::solid
#else
namespace osculate::solid {

const bool built_for_eight = false;
bool forces_of_eight(const EightCells&, const TwoFours<const core::Pack>&,
                     const TwoFours<const core::Pack>&, const TwoFours<core::Pack>&) {
  return false;
}

}  // namespace osculate::solid
#endif
