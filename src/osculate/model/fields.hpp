#pragma once
#include <string>
#include <vector>

#include "osculate/model/system.hpp"

namespace osculate::model {

/// Results at the nodes of the mesh (frame nodes left out), averaged over the cells that meet
/// there.
struct NodalFields {
  std::vector<Vec2> displacement, reaction;
  std::vector<std::array<double, 4>> stress;  ///< Cauchy: xx, yy, zz, xy
  std::vector<std::array<double, 4>> strain;  ///< small or Green-Lagrange: xx, yy, zz, xy
  std::vector<double> mises;
};

[[nodiscard]] NodalFields nodal_fields(const System& system, const Model& model,
                                       const State& state);

}  // namespace osculate::model
