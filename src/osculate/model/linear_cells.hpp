#pragma once
#include <cstddef>
#include <vector>

#include "osculate/model/bulk.hpp"

namespace osculate::model {

/// Stiffness matrices of cells whose forces are linear in the displacements (small strains of a
/// linear law): made once, when the cell is first evaluated. What does not fit into `most_bytes` is
/// evaluated anew each time, as are all other cells.
///
/// Forces of implicit analyses are those of the cell's strains all the same: of a thin cell the
/// stored matrix has no digits of bending left. Explicit ones take the product, but of
/// solid-shells.
///
/// Formula    f = K (u - u_0) , u_0 the displacement of the first node where the cell feels nothing
///            of it: what all nodes have in common leaves no rounding in the sum of the forces
/// Tested by  tests/unit/deck/test_linear_cells.cpp
template <int Dim>
class LinearCells {
 public:
  static constexpr std::size_t most_bytes = std::size_t{512} << 20U;

  /// The next cell, in the order in which they are numbered.
  void add(const BasicBulkSection<Dim>& section, cell::CellType type);
  /// Takes the memory, once; cells that are evaluated before are not kept.
  void reserve() { values_.resize(size_); }
  /// Whether the matrix of a cell is stored, or will be.
  [[nodiscard]] bool kept(std::size_t number) const {
    return begin_[number] != nowhere && !values_.empty();
  }
  /// As evaluate_cell, of cell `number`. Different cells may be evaluated at once.
  void evaluate(std::size_t number, const BasicModel<Dim>& model,
                const BasicBulkSection<Dim>& section, const mesh::CellRef& cell,
                const Eigen::VectorXd& u, const material::Memory& memory, bool with_tangent,
                BasicBulkBlock<Dim>& out);
  /// The forces alone, by the formula.
  void force(std::size_t number, const BasicModel<Dim>& model, const BasicBulkSection<Dim>& section,
             const mesh::CellRef& cell, const Eigen::VectorXd& u, const material::Memory& memory,
             BasicBulkBlock<Dim>& out);

 private:
  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
  void keep(std::size_t number, const BasicBulkBlock<Dim>& block);
  std::vector<std::size_t> begin_;  ///< of a cell's matrix in `values_`
  std::vector<char> made_;
  std::vector<double> values_;
  std::size_t size_ = 0;  ///< of `values_` when there is memory for them
};

}  // namespace osculate::model
