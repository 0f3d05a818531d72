#pragma once
#include <vector>

#include "osculate/la/halo.hpp"

namespace osculate::la {

/// Unknowns of a matrix of several processes, numbered one process after the other, in their order.
/// Of one process alone (no ranks) nothing is kept: all numbers are those of the unknowns.
///
/// Shapes     number: of each unknown; unknown: of each number; first: as of a Halo
struct Dealt {
  const core::Ranks* ranks = nullptr;
  std::vector<Index> number, unknown, first;
  Index begin = 0, end = 0;  ///< numbers of this process

  /// Whether the row of the unknown is here.
  [[nodiscard]] bool is_here(Index of) const {
    return !ranks || (number[as_size(of)] >= begin && number[as_size(of)] < end);
  }
};

/// As the rows of a matrix are, of which none is empty.
[[nodiscard]] Dealt dealt_as(const SparseMatrix& k);
/// Whether the rows of this matrix are dealt out so.
[[nodiscard]] bool deals(const Dealt& dealt, const SparseMatrix& k);
/// The rows of this process, both triangles, without zeros beside the diagonal.
struct RowsHere {
  CompressedRows a;  ///< with columns of the halo
  Halo halo;
};
[[nodiscard]] RowsHere rows_here(const SparseMatrix& k, Symmetry symmetry, const Dealt& dealt,
                                 core::Crew& crew);
/// The matrix of which they are the rows.
[[nodiscard]] SparseMatrix matrix_of(const CompressedRows& rows, const Halo& halo,
                                     const Dealt& dealt);

}  // namespace osculate::la
