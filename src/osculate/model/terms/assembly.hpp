#pragma once
#include <span>
#include <vector>

#include "osculate/model/assembler.hpp"
#include "osculate/model/evaluated.hpp"

namespace osculate::model {

/// What the terms of the system add to: forces, and if wanted the tangent. With a prescribed
/// increment, the tangent times it is added to what is predicted.
///
/// Tested by  tests/unit/model/test_system.cpp, test_contact_tangent.cpp
template <int Dim>
struct Assembly {
  const BasicDofSpace<Dim>& dofs;
  BasicAssembler<Dim>& assembler;
  la::MatrixBuilder& builder;
  Evaluated<Dim>& into;
  bool with_tangent = false;
  const Eigen::VectorXd* inc = nullptr;  ///< the prescribed increment; null: nothing is predicted
  double share = 1;  ///< of internal and external forces in the balance of a step in time
  std::vector<Dof> path_dofs{};       ///< columns of the next outer product or row
  std::vector<double> path_values{};  ///< one for each, or Dim
  std::vector<Dof> row_dofs{};

  template <class Block>
  void add_stiffness(std::span<const Dof> block_dofs, const Block& k, std::size_t corner = 0) {
    assembler.add_block(block_dofs, k, corner);
    predict(block_dofs, k);
  }
  /// The tangent times the prescribed increment alone.
  template <class Block>
  void predict(std::span<const Dof> block_dofs, const Block& k) {
    if (!inc) return;
    for (std::size_t j = 0; j < block_dofs.size(); ++j) {
      const double du = (*inc)[block_dofs[j]];
      if (du == 0.0) continue;
      for (std::size_t i = 0; i < block_dofs.size(); ++i)
        into.predicted[block_dofs[i]] +=
            k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * du;
    }
  }
  /// The dofs of the nodes of a contact block, until the next one.
  [[nodiscard]] std::span<const Dof> rows_of(const pairing::ContactBlock<Dim>& block) {
    row_dofs.clear();
    for (int k = 0; k < Dim * block.count; ++k)
      row_dofs.push_back(dofs.node_dof(block.nodes[static_cast<std::size_t>(k / Dim)], k % Dim));
    return row_dofs;
  }
  void begin_path() {
    path_dofs.clear();
    path_values.clear();
  }
  void add_to_path(Index node, const Vec<Dim>& values) {
    for (int i = 0; i < Dim; ++i) {
      path_dofs.push_back(dofs.node_dof(node, i));
      path_values.push_back(values[i]);
    }
  }
  /// A path of vectors: a column of `values` for each direction of the node.
  void add_vectors_to_path(Index node, const Mat<Dim, Dim>& values) {
    for (int i = 0; i < Dim; ++i) path_dofs.push_back(dofs.node_dof(node, i));
    path_values.insert(path_values.end(), values.data(), values.data() + Dim * Dim);
  }
  /// rows * path . dx, with one row for each of `of` in `rows` and a column for each value of the
  /// path's dofs.
  template <class Rows>
  void add_outer(std::span<const Dof> of, const Rows& rows) {
    const auto columns = static_cast<Eigen::Index>(path_dofs.size());
    const Eigen::Map<const Eigen::MatrixXd> path(path_values.data(), rows.cols(), columns);
    assembler.add_outer(of, rows, path_dofs, path);
    if (!inc) return;
    Eigen::VectorXd along = Eigen::VectorXd::Zero(rows.cols());
    for (Eigen::Index j = 0; j < columns; ++j)
      along += (*inc)[path_dofs[static_cast<std::size_t>(j)]] * path.col(j);
    for (std::size_t i = 0; i < of.size(); ++i)
      into.predicted[of[i]] += rows.row(static_cast<Eigen::Index>(i)).dot(along);
  }
  /// path . dx in the row of a multiplier. Largest entry of the row.
  double add_row(Index unknown) {
    const double largest = assembler.add_row(unknown, path_dofs, path_values);
    if (!inc) return largest;
    const double along = along_path();
    const Index row = unknown - dofs.unknowns();
    into.constraint[row] += along;
    into.branch_constraint[row] += along;
    return largest;
  }
  /// path . inc
  [[nodiscard]] double along_path() const {
    double along = 0;
    for (std::size_t j = 0; j < path_dofs.size(); ++j)
      along += path_values[j] * (*inc)[path_dofs[j]];
    return along;
  }
};

}  // namespace osculate::model
