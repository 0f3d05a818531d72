#pragma once
#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osculate/core/param.hpp"
#include "osculate/model/dof_space.hpp"

namespace osculate::model {

/// What is apart, and stiff as soon as it has come together.
///
/// Formula    F = K g (1/2 - atan(g / e) / pi) , g = clearance + q , e = pi T / K : K g + T far
///            inside, T far outside
/// Source     GAPUNI of CalculiX (ccx 2.20 User's Manual, *GAP), measured to seven digits on one
///            element; the law of contact::NormalTensile, which has the formula
/// Units      clearance: length, K force/length, T force
struct SpringGap {
  double clearance = 0;
  double stiffness = 0;  ///< K
  double tension = 0;    ///< T, above zero
};

/// A force that depends on one elongation q, and a damper beside it.
///
/// Formula    of two nodes  q = |x2 - x1| - |X2 - X1| , along the line that joins them, or (if it
///            does not turn) q = e . (u2 - u1) , e along that of the reference configuration;
///            of displacements  q = sum factor u ;
///            F = k q , or by straight lines between the points of a table, constant beyond its
///            ends, or that of a gap; plus c dq/dt in steps with inertia
/// Units      force over length; k force/length, c force time/length
struct Spring {
  std::string name{};
  std::array<Index, 2> ends{-1, -1};  ///< nodes that it joins; -1: it has terms
  bool turns = true;                  ///< with the line between the nodes
  std::vector<Equation::Term> terms{};
  double stiffness = 0;
  core::Table table{};  ///< elongation (increasing), force; empty: linear
  std::optional<SpringGap> gap{};
  double damping = 0;

  [[nodiscard]] bool joins() const { return ends[0] >= 0; }
};

/// Force, its slope and the energy stored since the elongation was zero.
///
/// Tested by  tests/unit/model/test_spring.cpp
struct SpringResponse {
  double force = 0, slope = 0, stored = 0;
};
[[nodiscard]] SpringResponse response(const Spring& spring, double elongation);

/// The elongation, its gradient, and its curvature (empty: none) by the dofs.
///
/// Formula    dq/dx = (-n, n) , d2q/dx2 = (1 - n n) / |x2 - x1| with the signs of the nodes; n the
///            unit vector from the first node to the second
struct SpringMotion {
  double elongation = 0;
  std::vector<Dof> dofs;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd curvature;
};

/// `value` of a dof. Nodes at one place have the direction they had at first.
///
/// Tested by  tests/unit/model/test_spring.cpp
template <int Dim>
[[nodiscard]] SpringMotion motion_of(const Spring& spring, std::span<const Vec<Dim>> reference,
                                     std::span<const Vec<Dim>> x,
                                     const std::function<double(Dof)>& value);

}  // namespace osculate::model
