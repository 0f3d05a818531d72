#pragma once
#include "osculate/pairing/sample.hpp"

namespace osculate::pairing {

/// A slave node over the master, with what its derivatives need.
template <int Dim>
struct NodeContact {
  ContactSample<Dim> sample;
  Vec<Dim> apart = Vec<Dim>::Zero();  ///< x - y, where y is the sample's foot
  bool sliding = false;               ///< there is friction and a last place
  ContactTimeFraction time_fraction;
  Vec<Dim> way = Vec<Dim>::Zero();               ///< y - y_old
  Vec<Dim> shear_multiplier = Vec<Dim>::Zero();  ///< multiplier of the shear
  Response<Dim> response;

  /// A traction in space; without an argument that of the branch that is linearised.
  [[nodiscard]] Vec<Dim> traction(const contact::Traction<Dim>& t) const {
    return t.normal.traction * sample.normal + sample.frame * t.tangential.traction;
  }
  [[nodiscard]] Vec<Dim> traction() const { return traction(response.traction); }
};

}  // namespace osculate::pairing
