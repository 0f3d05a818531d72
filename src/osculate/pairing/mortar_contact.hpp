#pragma once
#include "osculate/contact/point_terms.hpp"
#include "osculate/pairing/trial.hpp"

namespace osculate::pairing {

/// A slave node over the master, with what its derivatives need.
template <int Dim>
struct NodeContact {
  Vec<Dim> foot, apart;  ///< y and x - y
  Vec<Dim> normal;       ///< out of the master
  Mat<Dim, Dim - 1> frame;
  double gap = 0;
  contact::NormalResponse normal_law;
  bool sliding = false;  ///< there is friction and a last place
  ContactShare share;
  Vec<Dim> way = Vec<Dim>::Zero();  ///< y - y_old
  Vec<Dim - 1> trial = Vec<Dim - 1>::Zero();
  double stiffness = 0;                ///< eps_T
  Vec<Dim> around = Vec<Dim>::Zero();  ///< multiplier of the shear
  contact::TangentialResponse<Dim> law, linearised;

  /// Traction of the branch that is linearised.
  [[nodiscard]] Vec<Dim> traction() const {
    return normal_law.traction * normal + frame * linearised.traction;
  }
};

}  // namespace osculate::pairing
