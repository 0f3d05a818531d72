#pragma once
#include <string>
#include <vector>

#include "osculate/model/model.hpp"

namespace osculate::model {

/// What the prescriptions of one step leave a body of its rigid motions.
struct Support {
  std::string body;               ///< of deformable bodies the section of its first cell
  bool rigid = false;             ///< a rigid body
  std::size_t held = 0;           ///< prescribed displacements of its nodes (or of the rigid body)
  std::vector<std::string> free;  ///< `move along x`, `turn about (0, 1)`; empty: none
  bool all_free = false;          ///< nothing of its motions is held
  std::vector<std::string> contact;  ///< pairs and rigid bodies that may hold it beside that
};

/// By kinematics alone: prescriptions, equations between nodes of one body, nodes of a rigid body
/// that is itself prescribed. Contact and loads are not judged. An axisymmetric body has one rigid
/// motion, along its axis. In the order of the bodies, deformable ones first.
///
/// Tested by  tests/unit/deck/test_supports.cpp
template <int Dim>
[[nodiscard]] std::vector<Support> supports(const BasicModel<Dim>& model, const Step& step);

}  // namespace osculate::model
