#pragma once
#include <span>
#include <vector>

#include "osculate/la/sparse_matrix.hpp"
#include "osculate/model/dof_space.hpp"

namespace osculate::model {

/// Adds blocks over primary dofs to the matrix of the unknowns: rigid nodes and eliminated dofs
/// are expanded, prescribed rows and columns are left out.
///
/// Tested by  tests/unit/model/test_dof_space.cpp
template <int Dim>
class BasicAssembler {
 public:
  BasicAssembler(const BasicDofSpace<Dim>& dofs, la::MatrixBuilder& matrix)
      : dofs_(dofs), matrix_(matrix) {}

  void set_prescribed(std::vector<bool> prescribed) { prescribed_ = std::move(prescribed); }
  /// By unknown.
  [[nodiscard]] const std::vector<bool>& prescribed() const { return prescribed_; }
  [[nodiscard]] bool prescribed(Index unknown) const {
    return prescribed_[static_cast<std::size_t>(unknown)];
  }
  void set_configuration(std::span<const Vec<Dim>> x,
                         const std::vector<body::BasicRigidMotion<Dim>>& rigid) {
    x_ = x;
    rigid_ = &rigid;
  }

  /// K(i, j) for all pairs of `block_dofs`. Blocks without rigid nodes and equations (those of all
  /// cells but a few) need no expansion.
  ///
  /// Requires   k stored by columns; with `corner`, zero in rows and columns from there on
  template <class Matrix>
  void add_block(std::span<const Dof> block_dofs, const Matrix& k, std::size_t corner = 0) {
    if (direct(block_dofs, unknowns_)) {
      const std::span<const Index> all(unknowns_);
      const auto first = corner > 0 ? all.first(corner) : all;
      matrix_.add_block(first, all, k.data(), k.outerStride());
      if (corner > 0)
        matrix_.add_block(all.subspan(corner), first, k.data() + corner, k.outerStride());
      return;
    }
    expand(block_dofs, rows_, row_end_);
    constexpr std::size_t many = 4;
    if (rows_.size() > many * block_dofs.size()) return add_condensed(k);
    for (std::size_t i = 0; i < block_dofs.size(); ++i)
      for (std::size_t a = i == 0 ? 0 : row_end_[i - 1]; a < row_end_[i]; ++a) {
        if (prescribed(rows_[a].unknown)) continue;
        for (std::size_t j = 0; j < block_dofs.size(); ++j) {
          const double value =
              rows_[a].factor * k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
          if (value == 0.0) continue;
          for (std::size_t b = j == 0 ? 0 : row_end_[j - 1]; b < row_end_[j]; ++b)
            if (!prescribed(rows_[b].unknown))
              matrix_.add(rows_[a].unknown, rows_[b].unknown, value * rows_[b].factor);
        }
      }
  }

  /// rows * columns: a row of the one for each of `row_dofs`, a column of the other for each of
  /// `column_dofs`.
  void add_outer(std::span<const Dof> row_dofs, const Eigen::Ref<const Eigen::MatrixXd>& rows,
                 std::span<const Dof> column_dofs,
                 const Eigen::Ref<const Eigen::MatrixXd>& columns);

  /// Entries of one unknown outside the dof space (a multiplier): its row, its column. The row's
  /// largest entry is returned: 0 where nothing it depends on is free.
  double add_row(Index unknown, std::span<const Dof> column_dofs, std::span<const double> values);
  void add_column(std::span<const Dof> row_dofs, std::span<const double> values, Index unknown);

  /// Unit diagonal (times `scale`) for every prescribed unknown.
  void add_prescribed_diagonal(double scale);

  /// Forces on primary dofs -> forces on unknowns (prescribed ones zero).
  [[nodiscard]] Eigen::VectorXd gather(const Eigen::VectorXd& dof_forces) const;

 private:
  /// A block whose dofs (`rows_`) follow from few unknowns, many each: summed by these first.
  ///
  /// Formula    W^T K W , W the factors of the unknowns in the block's dofs
  void add_condensed(const Eigen::Ref<const Eigen::MatrixXd>& k);

  /// True if every dof is an unknown itself; `unknowns` then are these, -1 for prescribed ones.
  [[nodiscard]] bool direct(std::span<const Dof> block_dofs, std::vector<Index>& unknowns) const;
  void expand(std::span<const Dof> block_dofs, std::vector<Expansion>& out,
              std::vector<std::size_t>& end) const;

  const BasicDofSpace<Dim>& dofs_;
  la::MatrixBuilder& matrix_;
  std::vector<bool> prescribed_;
  std::span<const Vec<Dim>> x_;
  const std::vector<body::BasicRigidMotion<Dim>>* rigid_ = nullptr;
  std::vector<Index> unknowns_, column_unknowns_;
  std::vector<Expansion> rows_, columns_;
  std::vector<std::size_t> row_end_, column_end_;
};

using Assembler = BasicAssembler<2>;
using Assembler3 = BasicAssembler<3>;

}  // namespace osculate::model
