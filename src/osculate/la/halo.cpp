#include "osculate/la/halo.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace osculate::la {
namespace {

/// How many each process sends to this one, where this one sends so many to each.
std::vector<int> counts_from(const core::Ranks& ranks, const std::vector<int>& to) {
  const std::vector<int> ones(to.size(), 1);
  const std::vector<double> given(to.begin(), to.end());
  std::vector<double> taken(to.size());
  ranks.exchange(given, ones, taken, ones);
  return {taken.begin(), taken.end()};
}

void add_entry(Index row, Index column, double value, std::vector<double>& to) {
  to.insert(to.end(), {static_cast<double>(row), static_cast<double>(column), value});
}

/// Of what `add_entry` has made; those of one place are summed up in their order.
CompressedRows from_entries(const std::vector<double>& taken, Index rows, Index columns) {
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (std::size_t e = 0; e < taken.size(); e += 3)
    entries.emplace_back(static_cast<Index>(taken[e]), static_cast<Index>(taken[e + 1]),
                         taken[e + 2]);
  CompressedRows out(rows, columns);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace

std::vector<double> exchanged(const core::Ranks& ranks,
                              const std::vector<std::vector<double>>& to) {
  std::vector<double> values;
  std::vector<int> counts;
  for (const std::vector<double>& of_one : to) {
    values.insert(values.end(), of_one.begin(), of_one.end());
    counts.push_back(static_cast<int>(of_one.size()));
  }
  const std::vector<int> from = counts_from(ranks, counts);
  std::size_t all = 0;
  for (const int count : from) all += static_cast<std::size_t>(count);
  std::vector<double> taken(all);
  ranks.exchange(values, counts, taken, from);
  return taken;
}

Halo::Halo(const core::Ranks* ranks, std::vector<Index> first, std::vector<Index> others)
    : ranks_(ranks), first_(std::move(first)), others_(std::move(others)) {
  const auto me = static_cast<std::size_t>(ranks_ ? ranks_->rank() : 0);
  begin_ = first_[me];
  end_ = first_[me + 1];
  if (!ranks_) return;
  auto next = others_.begin();
  for (std::size_t p = 0; p + 1 < first_.size(); ++p) {
    const auto end = std::lower_bound(next, others_.end(), first_[p + 1]);
    from_.push_back(static_cast<int>(end - next));
    next = end;
  }
  to_ = counts_from(*ranks_, from_);
  const std::vector<double> wanted(others_.begin(), others_.end());
  std::vector<double> asked(static_cast<std::size_t>(std::accumulate(to_.begin(), to_.end(), 0)));
  ranks_->exchange(wanted, from_, asked, to_);
  for (const double unknown : asked) asked_.push_back(static_cast<Index>(unknown) - begin());
}

void Halo::update(Eigen::VectorXd& here) const {
  if (!ranks_) return;
  std::vector<double> given;
  given.reserve(asked_.size());
  for (const Index i : asked_) given.push_back(here[i]);
  ranks_->exchange(given, to_, {here.data() + own(), others_.size()}, from_);
}

void Halo::add_up(Eigen::VectorXd& here) const {
  if (!ranks_) return;
  std::vector<double> taken(asked_.size());
  ranks_->exchange({here.data() + own(), others_.size()}, from_, taken, to_);
  for (std::size_t i = 0; i < asked_.size(); ++i) here[asked_[i]] += taken[i];
}

CompressedRows Halo::rows_of_others(const CompressedRows& own) const {
  CompressedRows rows(static_cast<Index>(others_.size()), own.cols());
  if (!ranks_) return rows;
  std::vector<std::vector<double>> to(to_.size());  // of each row its length, columns and values
  auto asked = asked_.begin();
  for (std::size_t p = 0; p < to.size(); ++p)
    for (int i = 0; i < to_[p]; ++i, ++asked) {
      to[p].push_back(own.outerIndexPtr()[*asked + 1] - own.outerIndexPtr()[*asked]);
      for (CompressedRows::InnerIterator entry(own, *asked); entry; ++entry) {
        to[p].push_back(static_cast<double>(entry.col()));
        to[p].push_back(entry.value());
      }
    }
  const std::vector<double> received = exchanged(*ranks_, to);
  rows.reserve(static_cast<Index>(received.size() / 2));
  std::size_t at = 0;
  for (Index i = 0; i < rows.rows(); ++i) {
    rows.startVec(i);
    for (auto left = static_cast<int>(received[at++]); left > 0; --left, at += 2)
      rows.insertBack(i, static_cast<Index>(received[at])) = received[at + 1];
  }
  rows.finalize();
  return rows;
}

Eigen::VectorXd Halo::gathered(const Eigen::Ref<const Eigen::VectorXd>& own_values) const {
  Eigen::VectorXd all = Eigen::VectorXd::Constant(everywhere(), core::Ranks::nothing);
  all.segment(begin(), own()) = own_values;
  if (ranks_) ranks_->sum({all.data(), static_cast<std::size_t>(all.size())});
  return all;
}

double Halo::norm(const Eigen::VectorXd& here) const {
  if (!ranks_) return here.norm();
  return std::sqrt(ranks_->sum(here.head(own()).squaredNorm()));
}

std::vector<Index> dealt_out(const core::Ranks* ranks, Index mine) {
  if (!ranks) return {0, mine};
  std::vector<double> counts(static_cast<std::size_t>(ranks->count()), 0.0);
  counts[static_cast<std::size_t>(ranks->rank())] = mine;
  ranks->sum(counts);
  std::vector<Index> first{0};
  for (const double count : counts) first.push_back(first.back() + static_cast<Index>(count));
  return first;
}

void put_everywhere(CompressedRows& own_columns, Index first, Index columns) {
  CompressedRows out(own_columns.rows(), columns);
  const Eigen::Index entries = own_columns.nonZeros();
  out.resizeNonZeros(entries);
  std::copy_n(own_columns.outerIndexPtr(), own_columns.rows() + 1, out.outerIndexPtr());
  std::copy_n(own_columns.valuePtr(), entries, out.valuePtr());
  for (Eigen::Index e = 0; e < entries; ++e)
    out.innerIndexPtr()[e] = own_columns.innerIndexPtr()[e] + first;
  own_columns.swap(out);
}

CompressedRows with_rows_of_others(const CompressedRows& own, const Halo& halo) {
  if (!halo.ranks()) return own;
  const CompressedRows others = halo.rows_of_others(own);
  CompressedRows all(own.rows() + others.rows(), own.cols());
  all.reserve(own.nonZeros() + others.nonZeros());
  for (Index i = 0; i < all.rows(); ++i) {
    all.startVec(i);
    const bool is_own = i < own.rows();
    const CompressedRows& from = is_own ? own : others;
    const Index row = is_own ? i : i - static_cast<Index>(own.rows());
    for (CompressedRows::InnerIterator entry(from, row); entry; ++entry)
      all.insertBack(i, static_cast<Index>(entry.col())) = entry.value();
  }
  all.finalize();
  return all;
}

CompressedRows summed_up(CompressedRows& rows, const core::Ranks* ranks,
                         const std::vector<Index>& first) {
  if (!ranks) return taken(rows);
  const auto me = static_cast<std::size_t>(ranks->rank());
  std::vector<std::vector<double>> to(first.size() - 1);
  for (std::size_t p = 0; p < to.size(); ++p)
    for (Index i = first[p]; p != me && i < first[p + 1]; ++i)
      for (CompressedRows::InnerIterator entry(rows, i); entry; ++entry)
        add_entry(i - first[p], static_cast<Index>(entry.col()), entry.value(), to[p]);
  const Index own = first[me + 1] - first[me];
  return rows.middleRows(first[me], own) +
         from_entries(exchanged(*ranks, to), own, static_cast<Index>(rows.cols()));
}

CompressedRows gathered(const CompressedRows& own, const Halo& halo) {
  if (!halo.ranks()) return own;
  Eigen::VectorXd lengths(own.rows());
  for (Index i = 0; i < own.rows(); ++i)
    lengths[i] = own.outerIndexPtr()[i + 1] - own.outerIndexPtr()[i];
  lengths = halo.gathered(lengths);
  CompressedRows all(halo.everywhere(), halo.everywhere());
  Index* const start = all.outerIndexPtr();
  for (Index i = 0; i < halo.everywhere(); ++i)
    start[i + 1] = start[i] + static_cast<Index>(lengths[i]);
  all.resizeNonZeros(start[halo.everywhere()]);
  std::vector<std::pair<Index, double>> row;
  for (Index i = 0; i < own.rows(); ++i) {
    row.clear();
    for (CompressedRows::InnerIterator entry(own, i); entry; ++entry)
      row.emplace_back(halo.number_everywhere(static_cast<Index>(entry.col())), entry.value());
    std::ranges::sort(row, {}, &std::pair<Index, double>::first);
    Index next = start[halo.begin() + i];
    for (const auto& [column, value] : row) {
      all.innerIndexPtr()[next] = column;
      all.valuePtr()[next++] = value;
    }
  }
  for (int p = 0; p < halo.ranks()->count(); ++p) {
    const Index begin = start[halo.begin_of(p)], end = start[halo.begin_of(p + 1)];
    const auto count = as_size(end - begin);
    halo.ranks()->spread({all.innerIndexPtr() + begin, count}, p);
    halo.ranks()->spread({all.valuePtr() + begin, count}, p);
  }
  return all;
}

GroupStarts with_others(GroupStarts own, const Halo& halo) {
  for (Index i = halo.own(); i < halo.here(); ++i) own.push_back(i + 1);
  return own;
}

Halo halo_of(const core::Ranks* ranks, std::vector<Index> first,
             const std::vector<const CompressedRows*>& rows) {
  if (!ranks) return Halo(first.back());
  const auto me = static_cast<std::size_t>(ranks->rank());
  std::vector<Index> others;
  for (const CompressedRows* of : rows) {
    for (Eigen::Index e = 0; e < of->nonZeros(); ++e)
      if (const Index j = of->innerIndexPtr()[e]; j < first[me] || j >= first[me + 1])
        others.push_back(j);
    std::ranges::sort(others);
    others.erase(std::unique(others.begin(), others.end()), others.end());
  }
  return {ranks, std::move(first), std::move(others)};
}

CompressedRows with_columns_here(CompressedRows& rows, const Halo& halo) {
  if (!halo.ranks()) return taken(rows);
  const auto is_own = [&](Index j) { return j >= halo.begin() && j < halo.end(); };
  CompressedRows out(rows.rows(), halo.here());
  out.reserve(rows.nonZeros());
  for (Index i = 0; i < rows.rows(); ++i) {
    out.startVec(i);
    for (CompressedRows::InnerIterator entry(rows, i); entry; ++entry)
      if (const auto j = static_cast<Index>(entry.col()); is_own(j))
        out.insertBack(i, j - halo.begin()) = entry.value();
    auto other = halo.others().begin();
    for (CompressedRows::InnerIterator entry(rows, i); entry; ++entry)
      if (const auto j = static_cast<Index>(entry.col()); !is_own(j)) {
        other = std::lower_bound(other, halo.others().end(), j);
        out.insertBack(i, halo.own() + static_cast<Index>(other - halo.others().begin())) =
            entry.value();
      }
  }
  out.finalize();
  return out;
}

}  // namespace osculate::la
