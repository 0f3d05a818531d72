#pragma once
#include "osculate/core/types.hpp"

namespace osculate::pairing {

/// A node and the derivative of a scalar with respect to its position.
template <int Dim>
struct NodeGradient {
  Index node;
  Vec<Dim> value;
};

/// A node and the derivative of a vector with respect to its position.
template <int Dim>
struct NodeMatrix {
  Index node;
  Mat<Dim, Dim> value;
};

}  // namespace osculate::pairing
