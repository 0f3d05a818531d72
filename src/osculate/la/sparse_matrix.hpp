#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "osculate/core/ranks.hpp"
#include "osculate/core/types.hpp"

namespace osculate::la {

/// Compressed rows, columns sorted inside a row.
///
/// Shapes     row_start: n + 1 (or empty when n = 0);  column, value: one per stored entry
struct SparseMatrix {
  Index n = 0;
  std::vector<Index> row_start, column;
  std::vector<double> value;
  /// Null: all of the matrix is here. Otherwise some of its rows, whole ones, each on one of these
  /// processes, and here those of the others are empty; vectors are whole everywhere.
  const core::Ranks* ranks = nullptr;
  /// Not null: rows that `touched` does not name have the values of any other matrix of the same
  /// mark (and pattern).
  std::shared_ptr<const char> mark{};
  std::vector<Index> touched{};  ///< each once
};

/// Entries on all processes.
[[nodiscard]] double entry_count(const SparseMatrix& k);

/// A place in a matrix.
struct MatrixPlace {
  Index row = 0, column = 0;
};

/// K x, row by row in the order of the columns.
///
/// Requires   x.size() == k.n
[[nodiscard]] Eigen::VectorXd multiply(const SparseMatrix& k, const Eigen::VectorXd& x);

/// The same of a symmetric matrix, of which the upper triangle counts for both.
[[nodiscard]] Eigen::VectorXd multiply_symmetric(const SparseMatrix& k, const Eigen::VectorXd& x);

/// The entries between some unknowns, numbered in their order.
///
/// Requires   c sorted, each once, below k.n
void take_out(const SparseMatrix& k, std::span<const Index> c, SparseMatrix& out);

/// How well x solves K x = b.
///
/// Formula    |b - K x| / |b| in the Euclidean norm; 0 for b = 0 and x = 0
/// Errors     infinite where anything is not a number
/// Tested by  tests/unit/la/test_mumps.cpp
[[nodiscard]] double relative_residual(const SparseMatrix& k, const Eigen::VectorXd& x,
                                       const Eigen::VectorXd& b);

/// Assembles a matrix whose pattern only ever grows, so that the symbolic analysis stands as long
/// as possible. The diagonal is always in the pattern. Sums are made in the order of the calls of
/// `add`, whether or not an entry was in the pattern before: the same calls give the same bits.
///
/// Requires   0 <= row, column < n in `add`; unknowns below n elsewhere (negative ones are skipped)
/// Tested by  tests/unit/la/test_matrix_builder.cpp
class MatrixBuilder {
 public:
  explicit MatrixBuilder(Index n);
  /// Some rows of the matrix of several processes: what is reserved or added elsewhere is left out.
  /// `mine` has one for each row.
  MatrixBuilder(Index n, const core::Ranks* ranks, std::vector<bool> mine);
  /// Adds all pairs of these unknowns to the pattern to come.
  void reserve_block(std::span<const Index> unknowns);
  void reserve_block(std::span<const Index> rows, std::span<const Index> columns);
  /// Sets all values to zero; the pattern stays (that of entries kept aside included).
  void clear();
  /// The same in some rows alone: what was added to others is still there.
  void clear(std::span<const Index> rows);
  /// Remembers all values as they stand; zero is that of what the pattern grows by.
  void keep_values();
  /// Sets all values to those that were kept, in the rows that have been touched since; false:
  /// there are none.
  [[nodiscard]] bool restore_values();
  void forget_values();
  /// Entries outside the pattern are kept aside until `finish`.
  void add(Index row, Index column, double value);
  /// Adds a dense block, entry by entry as `add` does, but searches hardly at all: columns that are
  /// neighbours in the block are neighbours in the row, and rows of one node have the same columns.
  ///
  /// Shapes     entry (i, j) of the block is values[i + j * stride]
  /// Requires   unknowns distinct; rows and columns of negative ones are left out, and so are zeros
  ///            that are not in the pattern
  void add_block(std::span<const Index> unknowns, const double* values, std::ptrdiff_t stride);
  void add_block(std::span<const Index> rows, std::span<const Index> columns, const double* values,
                 std::ptrdiff_t stride);
  /// Adds the product of two factors in the same way, the first with a row for each of `rows`, the
  /// second with a column for each of `columns`; columns may be named more than once.
  void add_product(std::span<const Index> rows, const Eigen::Ref<const Eigen::MatrixXd>& first,
                   std::span<const Index> columns, const Eigen::Ref<const Eigen::MatrixXd>& second);
  /// Merges what was kept aside and returns the matrix.
  const SparseMatrix& finish();
  /// Places by which entries have made the pattern grow so far, each once (all merged). The same
  /// reservations and these give another builder the same pattern.
  [[nodiscard]] const std::vector<MatrixPlace>& grown() const { return grown_; }
  /// Adds such places to the pattern.
  void grow_by(std::span<const MatrixPlace> places);
  /// Changes when the pattern grew. Growth that waits for `finish` counts already, so it does not
  /// matter which of the two is called first.
  [[nodiscard]] std::uint64_t pattern_version() const {
    return version_ + (waits() || !aside_.empty() ? 1 : 0);
  }

 private:
  using Place = MatrixPlace;
  struct Entry {
    Place at;
    double value;
  };
  /// Rows and columns that were reserved together.
  struct Block {
    std::size_t rows, columns, end;  ///< in block_unknowns_: rows to columns, columns to end
  };
  [[nodiscard]] bool here(Index row) const {
    return row >= 0 && (mine_.empty() || mine_[static_cast<std::size_t>(row)]);
  }
  [[nodiscard]] double* find(Index row, Index column);
  [[nodiscard]] bool has(std::span<const Index> rows, std::span<const Index> columns);
  [[nodiscard]] bool waits() const { return !blocks_.empty() || !pending_.empty(); }
  void order(std::span<const Index> columns);
  void begin_touching();
  void touch(Index row) {
    if (kept_.empty() || touched_[static_cast<std::size_t>(row)]) return;
    touched_[static_cast<std::size_t>(row)] = true;
    matrix_.touched.push_back(row);
  }
  [[nodiscard]] bool are_in_places(std::span<const Index> row) const;
  void find_places(std::span<const Index> row);
  /// Adds `row_`.
  void add_to_row(Index row);
  void merge();
  void grow();

  SparseMatrix matrix_;
  std::vector<double> kept_;           ///< by `keep_values`; empty: none
  std::vector<bool> touched_;          ///< by row, since then; `matrix_` lists them
  std::shared_ptr<const char> mark_;   ///< of what was kept; `matrix_` has none once all is cleared
  std::vector<bool> mine_;             ///< by row; empty: all
  std::vector<Block> blocks_;          ///< reserved, not yet in the pattern
  std::vector<Index> block_unknowns_;  ///< of these
  std::vector<Place> pending_;         ///< likewise, one by one
  std::vector<Entry> aside_;           ///< added outside the pattern, in the order of the calls
  std::vector<Place> grown_;           ///< in the order of the growth
  std::uint64_t version_ = 1;
  std::vector<std::size_t> order_;  ///< of the columns of a block
  std::vector<Index> sorted_;       ///< these columns
  std::vector<Index> places_;       ///< of them in the row before, -1 of those outside the pattern
  bool all_found_ = false;          ///< whether none is
  std::vector<double> row_;         ///< of the block, in this order
  std::vector<double> factor_;      ///< second one of a product, likewise
};

}  // namespace osculate::la
