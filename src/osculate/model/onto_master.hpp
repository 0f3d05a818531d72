#pragma once
#include <vector>

#include "osculate/pairing/pair.hpp"

namespace osculate::model {

/// A slave node that is put onto the master before anything is computed.
template <int Dim>
struct MovedNode {
  Index node = -1;
  Vec<Dim> to = Vec<Dim>::Zero();  ///< its foot point
  double way = 0;
};

/// The slave's nodes that are inside the master, or no farther from it than `tolerance`; prepares
/// the pair, whose points are nodes.
///
/// Tested by  tests/unit/deck/test_initial_overlap.cpp
template <int Dim>
[[nodiscard]] std::vector<MovedNode<Dim>> onto_master(pairing::PairDefinition<Dim>& pair,
                                                      const std::vector<Vec<Dim>>& reference,
                                                      double tolerance);

}  // namespace osculate::model
