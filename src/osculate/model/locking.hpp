#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "osculate/model/model.hpp"
#include "osculate/model/state.hpp"

namespace osculate::model {

/// How much of a section's energy is in strains that its plain cells cannot help having, and that
/// other formulations of the same cells would not have at the same displacements.
struct Locking {
  std::string section;
  double energy = 0;  ///< of quad4 and hex8 cells with full integration, of thin wedge6 cells, and
                      ///< of those of second order that have a formulation bbar
  double enhanced =
      0;             ///< what is left with enhanced strains; that of `energy` where there are none
  double bbar = 0;   ///< with the mean volume change, where Poisson's ratio is near a half or the
                     ///< cell flows
  double floor = 0;  ///< of strains too small to be told from round-off, in states that may lock
  bool wedges = false;  ///< it has thin wedge6 cells (CalculiX' S3)
  bool flows = false;   ///< the section's law remembers: only cells that flow are in the sums
  bool second = false;  ///< cells of second order are in the sums
  [[nodiscard]] bool large() const {
    return energy > floor && energy - std::min(enhanced, bbar) > 0.15 * energy;
  }
};

/// Takes a state into account: one entry per section, in the model's order.
///
/// Formula    sums of W(u) over cells and states, u the displacements that were found: a share s of
///            the energy that another formulation would not have makes the body stiffer by about
///            1 / (1 - s). Where a law remembers, W is the work: stored, with the same flow in all
///            formulations, and dissipated; of cells that have dissipated more than they store.
///            Those have flown well beyond yield, where the volume changes of a cell that is bent
///            are no longer real. Of wedge6 cells that are less than half as high as long and bend
///            more than they stretch, the energy of the shear between top and bottom, and of the
///            stress across, is one that a plate so thin hardly has
/// Tested by  tests/unit/api/test_locking.cpp
template <int Dim>
void measure_locking(const BasicModel<Dim>& model, const BasicState<Dim>& state,
                     std::vector<Locking>& found);

/// A warning where it is large, else empty.
[[nodiscard]] std::string locks(const Locking& found);

}  // namespace osculate::model
