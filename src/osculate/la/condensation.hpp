#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "osculate/la/local_pivots.hpp"
#include "osculate/la/sparse_matrix.hpp"

namespace osculate::la {

/// Which systems are condensed. `if_unsymmetric`: those that are unsymmetric anyway.
enum class Condense : unsigned char { never, if_unsymmetric, always };

/// The multipliers of one contact point and the unknowns of its slave node.
struct MultiplierGroup {
  Index first = 0, count = 0;  ///< the multipliers are the unknowns first, first + 1, ...
  std::array<Index, most_node_rows> node{-1, -1, -1};  ///< -1: not free, or none
  friend bool operator==(const MultiplierGroup&, const MultiplierGroup&) = default;
};

/// Eliminates multipliers from a linear system before it is factored, point by point and exactly.
///
/// Formula    [A B; C E] [u; l] = [f; g]: of the rows of a point (those of its slave node in A, B
///            and its own in C, E) as many are taken as it has multipliers, P, such that the block
///            D = K(P, l) is well conditioned. With D l = f_P - K(P, .) u every other row gets
///              K(r, .) - K(r, l) D^-1 K(P, .) ,  f_r - K(r, l) D^-1 f_P
///            In contact P are the rows of the slave node, and the constraints take their places;
///            where l is known by its own row (open points; the part of a shear along the normal)
///            it is that row.
/// Source     Wohlmuth2000, HueberWohlmuth2005, Popp2010 (dual multipliers, condensed)
/// Exact      up to rounding, whatever is condensed. What cannot be stays an unknown: multipliers
///            without a block of their own (the node's rows know other points' multipliers as
///            well, by more than 1e-13 of these columns' largest entry: rounding), or with a pivot
///            below 1e-4 of what they do elsewhere
/// Pattern    of the reduced matrix: depends on that of the whole one, and on which multipliers are
///            condensed and by which nodes' rows, not on the rows that are taken among them. So it
///            stands while points open, close, stick and slip
/// Symmetry   is lost
/// Tested by  tests/unit/la/test_condensation.cpp
class Condensation {
 public:
  /// Reduces the matrix. False where nothing can be condensed; then nothing else may be called.
  ///
  /// Requires   groups by ascending `first`, all their multipliers behind the unknowns of nodes; a
  ///            multiplier or an unknown of a node in one group at most; a multiplier's own row
  ///            knows no multipliers of other groups
  bool reduce(const SparseMatrix& k, std::span<const MultiplierGroup> groups);

  [[nodiscard]] const SparseMatrix& matrix() const { return matrix_; }
  /// Changes with the pattern of `matrix`.
  [[nodiscard]] std::uint64_t pattern_version() const { return version_; }
  [[nodiscard]] Index unknowns() const { return n_; }  ///< of the whole system
  /// Of the whole system, by its place in the reduced one.
  [[nodiscard]] Index unknown(Index place) const {
    return unknowns_[static_cast<std::size_t>(place)];
  }
  [[nodiscard]] Eigen::VectorXd reduced(const Eigen::VectorXd& rhs) const;
  /// Solution of the whole system from that of the reduced one.
  [[nodiscard]] Eigen::VectorXd expanded(const Eigen::VectorXd& solution,
                                         const Eigen::VectorXd& rhs) const;

 private:
  using Square =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_multipliers, most_multipliers>;
  using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_multipliers, 1>;
  template <int Most>
  struct List {
    int count = 0;
    std::array<Index, static_cast<std::size_t>(Most)> items{};
    void push(Index i) { items[static_cast<std::size_t>(count++)] = i; }
    [[nodiscard]] const Index* begin() const { return items.data(); }
    [[nodiscard]] const Index* end() const { return items.data() + count; }
    friend bool operator==(const List&, const List&) = default;
  };
  /// One point: unknowns and rows of the whole system.
  struct Point {
    List<most_node_rows> node;  ///< of the node, that no other point's multipliers are in
    List<most_multipliers> pivot_rows, eliminated, kept;
    Square inverse;  ///< D^-1
  };
  /// K(r, l) of a row of the reduced system that is no pivot row.
  struct Coupling {
    Index place = 0;
    std::size_t point = 0;
    Coefficients entries;
  };

  void set_owners(std::span<const MultiplierGroup> groups, Index n);
  void measure_columns(const SparseMatrix& k);
  [[nodiscard]] bool alone(const SparseMatrix& k, Index row, std::size_t g) const;
  [[nodiscard]] Point chosen(const SparseMatrix& k, std::size_t g) const;
  [[nodiscard]] bool same_structure(const SparseMatrix& k, const std::vector<Point>& next) const;
  void set_structure(const SparseMatrix& k);
  void set_columns(const SparseMatrix& k);
  void set_pattern(const SparseMatrix& k);
  void mark_row(const SparseMatrix& k, Index row, std::vector<Index>& found);
  void mark(Index place, std::vector<Index>& found);
  void finish_marks(std::vector<Index>& found, std::vector<Index>& out);
  void place_rows(const SparseMatrix& k);
  void set_weights(const SparseMatrix& k);
  void set_row(const SparseMatrix& k, Index place);
  void find_couplings(const SparseMatrix& k, Index place);
  [[nodiscard]] bool eliminates(std::size_t g) const { return points_[g].eliminated.count > 0; }

  std::vector<MultiplierGroup> groups_;
  std::vector<Point> points_;  ///< one per group
  Index n_ = 0;
  std::vector<Index> row_start_, column_;  ///< of the whole matrix, when the structure was set
  std::vector<Index> owner_;               ///< group by unknown; -1: no multiplier
  std::vector<double> largest_;            ///< entry of a column in rows of nodes, by unknown
  std::vector<Index> member_;              ///< group by row that it may take; -1: none
  std::vector<Index> place_;               ///< by unknown; -1: eliminated
  std::vector<Index> unknowns_;            ///< by place
  std::vector<Index> row_at_;              ///< of the whole system, by place
  std::vector<Index> columns_;             ///< places that the rows of a point know, point by point
  std::vector<double> weights_;            ///< D^-1 K(P, .), column by column of `columns_`
  std::vector<std::size_t> column_begin_, weight_begin_;  ///< of a point; one more at the end
  std::vector<Coupling> couplings_;
  std::vector<Index> slot_;   ///< working space, by place: of its entry in the running row
  std::vector<bool> marked_;  ///< working space, by place
  SparseMatrix matrix_;
  std::uint64_t version_ = 0;
};

}  // namespace osculate::la
