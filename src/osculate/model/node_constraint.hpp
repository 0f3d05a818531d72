#pragma once
#include <span>
#include <string>
#include <vector>

#include "osculate/body/rigid_body.hpp"
#include "osculate/core/types.hpp"

namespace osculate::model {

/// A condition on the places of nodes, of any displacement and rotation, that forces without work
/// fulfil: multipliers.
///
/// plane        the last of four nodes stays in the plane of the others (in space)
/// line         the last of three nodes stays on the line of the others
/// distance     two nodes keep their distance
/// mean_motion  the weighted mean of the nodes' motion, by least squares, is that of a rigid body:
///              what acts on the body is shared out over the nodes
struct NodeConstraint {
  enum class Kind { plane, line, distance, mean_motion };
  Kind kind = Kind::distance;
  std::string name{};  ///< of the set of nodes, for messages
  std::vector<Index> nodes;
  std::vector<double> weights{};  ///< of mean_motion
  Index body = -1;                ///< of mean_motion
  double stiffness = 1;           ///< force per length that multipliers are measured by
};

/// Number of multipliers.
template <int Dim>
[[nodiscard]] int rows(const NodeConstraint& constraint);

/// Value, gradient and curvature of the constraint's functions G, which vanish.
///
/// Formula    plane     G = s (x4 - x1) . (x2 - x1) x (x3 - x1) / |(X2 - X1) x (X3 - X1)|
///            line      G_k = s e_k . (x3 - x1) x (x2 - x1) / |X2 - X1| , e_k across the line
///            distance  G = s (|x2 - x1|^2 - L^2) / (2 L)
///            mean      G_c = s (x_b - c - R (X_b - C)) , G_r = s sum w R A x (x - c) / a ,
///                      A = X - C , C = sum w X , c = sum w x , sum w = 1 , a^2 = sum w A . A ;
///                      of a small rotation G_c = s (x_b - c - (1 + [theta]) (X_b - C)) ,
///                      G_r = s sum w A x (x - c - theta x A) / a
/// Units      forces; s: stiffness
/// Tested by  tests/unit/model/test_node_constraint.cpp
template <int Dim>
struct NodeConstraintValue {
  static constexpr int motions = body::motions<Dim>;
  Eigen::VectorXd value;                  ///< one number per row
  Eigen::MatrixXd gradient;               ///< a row each; Dim columns per node
  Eigen::MatrixXd of_body;                ///< gradient with respect to the body's motion
  Eigen::MatrixXd curvature;              ///< of lambda . G, by the nodes; empty: none
  Eigen::MatrixXd mixed, body_curvature;  ///< by nodes and rotations, by rotations; empty: none
};
template <int Dim>
[[nodiscard]] NodeConstraintValue<Dim> evaluate(const NodeConstraint& constraint,
                                                std::span<const Vec<Dim>> reference,
                                                std::span<const Vec<Dim>> x,
                                                const body::BasicRigidMotion<Dim>* motion,
                                                const Eigen::VectorXd& lambda);

}  // namespace osculate::model
