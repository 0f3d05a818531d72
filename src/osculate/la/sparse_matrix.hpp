#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "osculate/core/types.hpp"

namespace osculate::la {

/// Compressed rows, columns sorted inside a row.
struct SparseMatrix {
  Index n = 0;
  std::vector<Index> row_start, column;
  std::vector<double> value;
};

[[nodiscard]] Eigen::VectorXd multiply(const SparseMatrix& k, const Eigen::VectorXd& x);

/// Assembles a matrix whose pattern only ever grows, so that the symbolic analysis stands as long
/// as possible. The diagonal is always in the pattern. Sums are made in the order of the calls.
class MatrixBuilder {
 public:
  explicit MatrixBuilder(Index n);
  /// Adds all pairs of these unknowns (negative ones are skipped) to the pattern to come.
  void reserve_block(std::span<const Index> unknowns);
  /// Sets all values to zero; the pattern stays.
  void clear();
  /// Entries outside the pattern are kept aside until `finish`.
  void add(Index row, Index column, double value);
  /// Merges what was kept aside and returns the matrix.
  const SparseMatrix& finish();
  /// Changes when the pattern grew.
  [[nodiscard]] std::uint64_t pattern_version() const { return version_; }

 private:
  struct Entry {
    Index row, column;
    double value;
  };
  void merge();

  SparseMatrix matrix_;
  std::vector<Entry> aside_;
  std::uint64_t version_ = 1;
};

}  // namespace osculate::la
