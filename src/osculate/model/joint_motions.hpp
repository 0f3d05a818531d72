#pragma once
#include <Eigen/Core>
#include <map>
#include <vector>

#include "osculate/la/sparse_matrix.hpp"

namespace osculate::model {

/// Rigid motions of one body, one a column, by its unknowns alone.
struct CompactModes {
  std::vector<Index> unknowns;
  Eigen::MatrixXd z;
};
[[nodiscard]] CompactModes compact(const Eigen::MatrixXd& z);

/// Combinations of rigid motions that the tangent does not resist, one a column.
struct FreeCombinations {
  Eigen::MatrixXd columns;
  Eigen::VectorXd ratios;  ///< resistance over the stiffest unknown
  [[nodiscard]] Eigen::Index count() const { return columns.cols(); }
};

/// The tangent seen by the rigid motions of bodies: blocks Z_a^T K Z_b.
class RigidStiffness {
 public:
  RigidStiffness(const la::SparseMatrix& k, const std::vector<CompactModes>& modes,
                 double stiffest);
  /// Of some bodies together: the right singular vectors whose values are below 1e-6 of the
  /// stiffest unknown.
  [[nodiscard]] FreeCombinations free_of(const std::vector<std::size_t>& bodies) const;
  /// Bodies that stiffness connects, those with others only.
  [[nodiscard]] std::vector<std::vector<std::size_t>> tied() const;
  [[nodiscard]] Eigen::Index motions(std::size_t body) const {
    return blocks_[body].at(body).cols();
  }

 private:
  std::vector<std::map<std::size_t, Eigen::MatrixXd>> blocks_;  ///< by column, then row
  double stiffest_;
};

/// Motions of bodies that contact ties together (fifty at most), of which none of them has all
/// alone.
///
/// Tested by  tests/unit/model/test_joint_motions.cpp, tests/system/test_diagnosis.py
struct JointMotions {
  std::vector<std::size_t> bodies;
  /// By body: what it does in them, orthonormal combinations of its own motions. One that stands
  /// still has none.
  std::vector<Eigen::MatrixXd> motions;
  double ratio = 0;  ///< the largest resistance of them
};
[[nodiscard]] std::vector<JointMotions> joint_motions(const RigidStiffness& stiffness);

}  // namespace osculate::model
