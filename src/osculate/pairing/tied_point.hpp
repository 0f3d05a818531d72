#pragma once
#include <array>
#include <vector>

#include "osculate/core/types.hpp"
#include "osculate/projection/feature.hpp"

namespace osculate::pairing {

/// A slave point that is tied to the place of the master it had at the start. Everything is linear
/// in the nodes but for the normal direction of what it keeps in space:
///   apart   w_k x_k: slave point less its place on the master (or, of mortar, x_j - y_j)
///   r_,i    b_ik x_k: base vectors of a facet there, which carry the distance that is kept
template <int Dim>
struct TiedPoint {
  Index point = -1;     ///< number of the contact point
  int slave_count = 0;  ///< of the nodes the first ones are the slave's
  std::vector<Index> nodes;
  std::vector<double> weights;                       ///< w_k, of sum 0
  std::array<std::vector<double>, Dim - 1> carrier;  ///< b_ik, of sum 0
  Vec<Dim> kept = Vec<Dim>::Zero();  ///< components of G along r_,i and their unit normal
  /// Of the last component of `kept`: what is added where initial gaps do not count
  /// (ActiveSet::relief).
  double relieved = 0;
  double side = 1;   ///< -1: the carrier is the slave's, whose normal points back
  Index facet = -1;  ///< of the master, as in a history
  projection::Feature feature = projection::Feature::face;
  Vec<Dim - 1> xi = Vec<Dim - 1>::Zero();
};

}  // namespace osculate::pairing
