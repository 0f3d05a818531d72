#pragma once
#include <vector>

#include "osculate/core/types.hpp"
#include "osculate/pairing/node_terms.hpp"

namespace osculate::pairing {

/// Constraint of one contact point whose tractions are unknowns. The unknowns are the multipliers
/// by their penalties, z = lambda / eps_N and Z = t / eps_T [length], so that rows and columns are
/// forces and the matrix keeps the symmetry of the problem.
///
/// Formula    normal = a (N - lambda) , shear = a (t - Lambda) , with the law's N and t around the
///            multipliers and a the reference area (or 1): where the point is in contact the gap
///            and the elastic slip vanish, and the shear obeys its limit; where it is open, lambda
///            and Lambda do
/// Source     AC91 (generalised Newton method of the augmented Lagrangian)
/// Rows       d(normal) = sum normal_row . dx + own.row(0) dz ; d(shear) = sum shear_row dx + own
/// dz Tested by  tests/unit/pairing/test_multipliers.cpp
template <int Dim>
struct ConstraintBlock {
  bool on = false;
  double normal = 0;
  Vec<Dim> shear = Vec<Dim>::Zero();
  double branch_normal = 0;                  ///< of the linearised branch
  Vec<Dim> branch_shear = Vec<Dim>::Zero();  ///< of the linearised branch
  std::vector<NodeGradient<Dim>> normal_row;
  std::vector<NodeMatrix<Dim>> shear_row;
  /// Derivative of the block's forces by the unknowns (z, Z): the first Dim * count rows.
  Eigen::Matrix<double, Eigen::Dynamic, Dim + 1> columns;
  Vec<Dim + 1> scale = Vec<Dim + 1>::Zero();  ///< area times penalties
  Mat<Dim + 1, Dim + 1> own = Mat<Dim + 1, Dim + 1>::Zero();
};

/// The constraint of an open point.
template <int Dim>
void set_open(double area, double normal_penalty, double shear_penalty, double lambda,
              const Vec<Dim>& shear, ConstraintBlock<Dim>& block) {
  block.on = true;
  block.normal = block.branch_normal = -area * lambda;
  block.shear = block.branch_shear = -area * shear;
  block.normal_row.clear();
  block.shear_row.clear();
  block.own.setZero();
  block.scale.setConstant(area * shear_penalty);
  block.scale[0] = area * normal_penalty;
  block.own.diagonal() = -block.scale;
}

}  // namespace osculate::pairing
