#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "osculate/model/bulk.hpp"

namespace osculate::model {

/// Stiffness matrices of cells whose forces are linear in the displacements (small strains of a
/// linear law): made once, when the cell is first evaluated, and kept as one triangle. What does
/// not fit into `most_bytes` is evaluated anew each time, as are all other cells.
///
/// Forces of implicit analyses are those of the strains all the same in thin cells, of whose
/// bending the stored matrix has no digits left. Explicit ones take the product, but of
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
  /// Takes the memory; cells that are evaluated before are not kept. `needs_none(number)`: cells
  /// that nobody will ask for. `elsewhere(number)`: those of other processes, which count among
  /// what has to fit, so that what is kept does not depend on how many processes there are. What is
  /// kept already stays only where that does not change.
  template <class None, class Elsewhere>
  void reserve(const None& needs_none, const Elsewhere& elsewhere) {
    std::vector<std::size_t> begin(length_.size(), nowhere);
    std::size_t size = 0, of_all = 0;
    for (std::size_t n = 0; n < length_.size(); ++n) {
      if (length_[n] == 0 || needs_none(n) || (of_all + length_[n]) * sizeof(double) > most_bytes)
        continue;
      of_all += length_[n];
      if (elsewhere(n)) continue;
      begin[n] = size;
      size += length_[n];
    }
    if (begin == begin_ && size == values_.size()) return;
    begin_ = std::move(begin);
    made_.assign(length_.size(), not_made);
    values_ = std::vector<double>(size);
  }
  void reserve() {
    const auto none = [](std::size_t) { return false; };
    reserve(none, none);
  }
  /// Whether the matrix of a cell is stored, or will be.
  [[nodiscard]] bool kept(std::size_t number) const {
    return number < begin_.size() && begin_[number] != nowhere;
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
  enum Made : char { not_made, compact, slender };
  /// Stores the matrix of a cell if that has not been done; false: the cell has no answer.
  [[nodiscard]] bool make(std::size_t number, const BasicModel<Dim>& model,
                          const BasicBulkSection<Dim>& section, const mesh::CellRef& cell,
                          const Eigen::VectorXd& u, const material::Memory& memory,
                          BasicBulkBlock<Dim>& out);
  void multiply(std::size_t number, const BasicModel<Dim>& model,
                const BasicBulkSection<Dim>& section, const mesh::CellRef& cell,
                const Eigen::VectorXd& u, BasicBulkBlock<Dim>& out) const;
  std::vector<std::uint32_t> length_;  ///< of a cell's triangle; 0: it has none
  std::vector<std::size_t> begin_;     ///< of a cell's triangle in `values_`, column by column
  std::vector<Made> made_;
  std::vector<double> values_;
};

}  // namespace osculate::model
