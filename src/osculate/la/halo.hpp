#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

#include "osculate/core/ranks.hpp"
#include "osculate/la/grouped_rows.hpp"

namespace osculate::la {

/// Lists of numbers, one to each process; what comes back are those for this one, from one process
/// after the other.
[[nodiscard]] std::vector<double> exchanged(const core::Ranks& ranks,
                                            const std::vector<std::vector<double>>& to);

/// Unknowns that are dealt out, numbered one process after the other ("everywhere"), and those that
/// the rows of this process see, numbered its own ones first, then those of others ("here"). One
/// process alone has all of them, by the same number here and everywhere.
///
/// Tested by  tests/unit/la/test_halo.cpp
class Halo {
 public:
  Halo() = default;
  /// Of one process alone.
  explicit Halo(Index unknowns) : first_{0, unknowns}, end_(unknowns) {}
  /// Shapes     first: the number everywhere of the first unknown of each process, and how many
  ///            there are; others: numbers everywhere of unknowns of others, sorted, each once
  Halo(const core::Ranks* ranks, std::vector<Index> first, std::vector<Index> others);

  [[nodiscard]] const core::Ranks* ranks() const { return ranks_; }
  [[nodiscard]] Index own() const { return end_ - begin_; }
  [[nodiscard]] Index here() const { return own() + static_cast<Index>(others_.size()); }
  [[nodiscard]] Index everywhere() const { return first_.back(); }
  [[nodiscard]] Index begin() const { return begin_; }  ///< of the own ones, everywhere
  [[nodiscard]] Index end() const { return end_; }
  /// Of those of a process; behind the last one: how many there are.
  [[nodiscard]] Index begin_of(int process) const {
    return first_[static_cast<std::size_t>(process)];
  }
  [[nodiscard]] const std::vector<Index>& others() const { return others_; }
  [[nodiscard]] Index number_everywhere(Index here) const {
    return here < own() ? begin() + here : others_[as_size(here - own())];
  }

  /// Values of others are those that their owner has.
  void update(Eigen::VectorXd& here) const;
  /// Owners add what others have for them, one after the other.
  void add_up(Eigen::VectorXd& here) const;
  /// Rows of the unknowns of others, from the rows of their owners.
  [[nodiscard]] CompressedRows rows_of_others(const CompressedRows& own) const;
  /// The values of all unknowns everywhere.
  [[nodiscard]] Eigen::VectorXd gathered(const Eigen::Ref<const Eigen::VectorXd>& own) const;
  [[nodiscard]] double norm(const Eigen::VectorXd& here) const;
  [[nodiscard]] double sum(double value) const { return ranks_ ? ranks_->sum(value) : value; }
  [[nodiscard]] bool all(bool holds) const { return ranks_ ? ranks_->all(holds) : holds; }

 private:
  const core::Ranks* ranks_ = nullptr;
  std::vector<Index> first_{0, 0}, others_;
  Index begin_ = 0, end_ = 0;
  std::vector<Index> asked_;    ///< own unknowns that others see, one process after the other
  std::vector<int> from_, to_;  ///< how many of others_ and asked_ are of each process
};

// Sparse rows of several processes. Of one process alone (no ranks) they stay as they are; rows
// that are not const are used up.

/// The number everywhere of the first unknown of each process, and how many there are, where this
/// one has `mine`.
[[nodiscard]] std::vector<Index> dealt_out(const core::Ranks* ranks, Index mine);
/// Columns of own unknowns get their numbers everywhere.
void put_everywhere(CompressedRows& own_columns, Index first, Index columns);
/// Own rows, and below them those of others that are here.
[[nodiscard]] CompressedRows with_rows_of_others(const CompressedRows& own, const Halo& halo);
/// Of rows everywhere the own ones, with what others add to them.
[[nodiscard]] CompressedRows summed_up(CompressedRows& rows, const core::Ranks* ranks,
                                       const std::vector<Index>& first);
/// The halo of what the columns of rows see, which have their numbers everywhere.
[[nodiscard]] Halo halo_of(const core::Ranks* ranks, std::vector<Index> first,
                           const std::vector<const CompressedRows*>& rows);
/// Columns get their numbers here; all are here.
[[nodiscard]] CompressedRows with_columns_here(CompressedRows& rows, const Halo& halo);
/// All rows of a matrix, on every process.
[[nodiscard]] CompressedRows gathered(const CompressedRows& own, const Halo& halo);
/// Groups of own unknowns, and one for each unknown of others.
[[nodiscard]] GroupStarts with_others(GroupStarts own, const Halo& halo);

}  // namespace osculate::la
