#pragma once
#include <Eigen/Core>
#include <vector>

#include "osculate/core/types.hpp"

namespace osculate::la {

/// Where unknowns are: what a solver that goes over coarser models has to know beside the matrix.
///
/// Shapes     one entry per unknown; none at all: nothing is known, or no use is to be made of it
struct Places {
  int dimension = 0;           ///< of the displacements: 2 or 3
  std::vector<Index> node;     ///< -1: of no node, as multipliers and motions of rigid bodies
  std::vector<int> direction;  ///< of the displacement
  std::vector<Eigen::Vector3d> place;
  std::vector<char> exact;  ///< not 0: of contact, to be solved for without approximation
  int threads = 1;          ///< the bits of a solution do not depend on them

  [[nodiscard]] bool known(Index unknowns) const {
    return dimension > 0 && node.size() == static_cast<std::size_t>(unknowns);
  }
};

}  // namespace osculate::la
