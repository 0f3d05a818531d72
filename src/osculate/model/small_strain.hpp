#pragma once
#include <string>
#include <vector>

#include "osculate/model/model.hpp"
#include "osculate/model/state.hpp"

namespace osculate::model {

/// How far a section that is computed with small strains has left what they are for.
struct SmallStrain {
  std::string section;
  double strain = 0;           ///< largest of a cell: norm of the mean Green strain
  double rotation = 0;         ///< largest of a cell [radians]
  bool may_be_finite = false;  ///< its law may be used with finite strains, too
  [[nodiscard]] bool large() const { return strain > 0.1 || rotation > 0.1745; }  // 10 degrees
};

/// Takes a state into account: one entry per section with small strains, in the model's order.
///
/// Formula    F = I + G, G the linear field nearest to the displacements of a cell's nodes;
///            strain |F^T F - I| / 2, rotation the angle of R in F = R U; of cells that have come
///            back new from where they did
/// Tested by  tests/unit/model/test_small_strain.cpp
template <int Dim>
void measure_small_strain(const BasicModel<Dim>& model, const BasicState<Dim>& state,
                          std::vector<SmallStrain>& found);

/// A warning where it has, else empty.
[[nodiscard]] std::string left_small_strain(const SmallStrain& found);

}  // namespace osculate::model
