#include "osculate/la/dealt_mumps.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "osculate/la/halo.hpp"
#include "osculate/la/timed.hpp"

namespace osculate::la {
namespace {

/// All rows, on the first process; nothing on the others.
SparseMatrix put_together(const SparseMatrix& k) {
  std::vector<std::vector<double>> to(static_cast<std::size_t>(k.ranks->count()));
  std::vector<double>& rows = to[0];  // of each its number, length, columns and values
  for (Index i = 0; i < k.n; ++i) {
    const Index begin = k.row_start[as_size(i)], end = k.row_start[as_size(i) + 1];
    if (begin == end) continue;
    rows.push_back(i);
    rows.push_back(end - begin);
    rows.insert(rows.end(), k.column.begin() + begin, k.column.begin() + end);
    rows.insert(rows.end(), k.value.begin() + begin, k.value.begin() + end);
  }
  const std::vector<double> all = exchanged(*k.ranks, to);
  SparseMatrix whole;
  if (k.ranks->rank() != 0) return whole;
  const auto visit = [&](const auto& row) {
    for (std::size_t at = 0; at < all.size();) {
      const auto length = static_cast<std::size_t>(all[at + 1]);
      row(static_cast<std::size_t>(all[at]), &all[at + 2], length);
      at += 2 + 2 * length;
    }
  };
  whole.n = k.n;
  whole.row_start.assign(as_size(k.n) + 1, 0);
  visit([&](std::size_t i, const double*, std::size_t length) {
    whole.row_start[i + 1] = static_cast<Index>(length);
  });
  for (std::size_t i = 1; i < whole.row_start.size(); ++i)
    whole.row_start[i] += whole.row_start[i - 1];
  whole.column.resize(as_size(whole.row_start.back()));
  whole.value.resize(whole.column.size());
  visit([&](std::size_t i, const double* columns, std::size_t length) {
    const Index begin = whole.row_start[i];
    std::copy_n(columns, length, whole.column.begin() + begin);
    std::copy_n(columns + length, length, whole.value.begin() + begin);
  });
  return whole;
}

/// Lets the first process work. All are told where it did not come to an end for want of memory.
template <class Work>
void let_the_first(const core::Ranks& ranks, const Work& work) {
  std::string wanting;
  try {
    if (ranks.rank() == 0) work();
  } catch (const NotEnoughMemory& error) {
    wanting = error.what();
  } catch (const std::bad_alloc&) {
    wanting = "not enough memory for the linear solver";
  }
  if (ranks.any(!wanting.empty())) throw NotEnoughMemory(ranks.spread(wanting, 0));
}

void tell(const core::Ranks& ranks, FactorReport& report) {
  std::array<double, 10> numbers{static_cast<double>(report.status),
                                 static_cast<double>(report.bad_row),
                                 static_cast<double>(report.negative_pivots),
                                 report.seconds_analysis,
                                 report.seconds_factor,
                                 report.condition,
                                 static_cast<double>(report.factor_entries),
                                 report.whole ? 1.0 : 0.0,
                                 report.operations,
                                 static_cast<double>(report.weakest.size())};
  ranks.spread(numbers, 0);
  report.status = static_cast<SolveStatus>(static_cast<int>(numbers[0]));
  report.bad_row = static_cast<Index>(numbers[1]);
  report.negative_pivots = static_cast<int>(numbers[2]);
  report.seconds_analysis = numbers[3];
  report.seconds_factor = numbers[4];
  report.condition = numbers[5];
  report.factor_entries = static_cast<std::int64_t>(numbers[6]);
  report.whole = numbers[7] != 0;
  report.operations = numbers[8];
  report.weakest.resize(static_cast<Eigen::Index>(numbers[9]));
  ranks.spread({report.weakest.data(), static_cast<std::size_t>(report.weakest.size())}, 0);
  report.message = ranks.spread(report.message, 0);
}

/// `by`: the solution, of the first process.
template <class Right, class By>
SolveStatus told(const core::Ranks& ranks, Right& rhs, const By& by) {
  SolveStatus status = SolveStatus::failed;
  let_the_first(ranks, [&] { status = by(); });
  auto number = static_cast<int>(status);
  ranks.spread({&number, 1}, 0);
  status = static_cast<SolveStatus>(number);
  if (status == SolveStatus::ok)
    ranks.spread({rhs.data(), static_cast<std::size_t>(rhs.size())}, 0);
  return status;
}

}  // namespace

FactorReport DealtMumps::factor(const SparseMatrix& k, std::uint64_t pattern_version,
                                Symmetry symmetry) {
  const Timed timed(seconds_);
  const bool few = k.ranks && entry_count(k) < fewest_;
  if (few && !told_) mumps_.forget();  // what it had with all of them ends with all of them
  told_ = few ? k.ranks : nullptr;
  if (!few) return mumps_.factor(k, pattern_version, symmetry);
  FactorReport report;
  const SparseMatrix whole = put_together(k);
  let_the_first(*told_, [&] { report = mumps_.factor(whole, pattern_version, symmetry); });
  tell(*told_, report);
  return report;
}

SolveStatus DealtMumps::solve(Eigen::VectorXd& rhs) {
  const Timed timed(seconds_);
  return told_ ? told(*told_, rhs, [&] { return mumps_.solve(rhs); }) : mumps_.solve(rhs);
}

SolveStatus DealtMumps::solve_once(Eigen::VectorXd& rhs) {
  const Timed timed(seconds_);
  return told_ ? told(*told_, rhs, [&] { return mumps_.solve_once(rhs); }) : mumps_.solve_once(rhs);
}

SolveStatus DealtMumps::solve(Eigen::MatrixXd& rhs) {
  const Timed timed(seconds_);
  return told_ ? told(*told_, rhs, [&] { return mumps_.solve(rhs); }) : mumps_.solve(rhs);
}

}  // namespace osculate::la
