#pragma once
#include <vector>

#include "osculate/model/model.hpp"
#include "osculate/model/state.hpp"
#include "osculate/model/terms/assembly.hpp"

namespace osculate::model {

/// The multipliers that are unknowns: rows and columns of the contact pairs that have them
/// (pairing/constraint.hpp), then those of constraints of nodes. They follow the unknowns of the
/// dof space.
///
/// Tested by  tests/unit/model/test_contact.cpp, test_contact_tangent.cpp,
///            test_node_constraint.cpp, tests/unit/deck/test_redundant_multipliers.cpp
template <int Dim>
struct ConstraintTerm {
  const BasicModel<Dim>& model;
  std::vector<Index> first;  ///< by pair; -1: its tractions are no unknowns
  Index begin;               ///< number of unknowns of the dof space
  Index of_nodes = 0;        ///< first one of the constraints of nodes
  Index end;                 ///< of the matrix

  ConstraintTerm(const BasicModel<Dim>& m, Index displacements);
  [[nodiscard]] Index count() const { return end - begin; }
  /// Adds a correction of the unknowns to the multipliers of a state.
  void move(BasicState<Dim>& s, const Eigen::VectorXd& du, double factor) const;
  /// Constraints of a pair whose multipliers are unknowns.
  void add(std::size_t pair, Assembly<Dim>& to) const;
  /// Looks which constraints of nodes follow from others where an attempt begins.
  void hold(const BasicState<Dim>& committed, const BasicDofSpace<Dim>& dofs,
            const std::vector<bool>& prescribed);
  void forget_held() { held_at.clear(); }
  /// Forces and rows of all constraints of nodes, of a state whose nodes are at `x`.
  void add_nodes(const BasicState<Dim>& s, std::span<const Vec<Dim>> x, Assembly<Dim>& to) const;
  /// Compliance of all multipliers in the tangent.
  void soften(la::MatrixBuilder& builder) const;

 private:
  std::vector<double> held;     ///< by constraint of nodes: see held_conditions; empty: not known
  std::vector<double> held_at;  ///< motions of their nodes and bodies, of which that is

  void add_tangent(const pairing::ContactBlock<Dim>& block, bool shear, Index row,
                   Assembly<Dim>& to) const;
  void add_one(const NodeConstraint& c, Index at, const BasicState<Dim>& s,
               std::span<const Vec<Dim>> x, Assembly<Dim>& to) const;
};

extern template struct ConstraintTerm<2>;
extern template struct ConstraintTerm<3>;

}  // namespace osculate::model
