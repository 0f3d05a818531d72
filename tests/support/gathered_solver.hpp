#pragma once
// Mumps of one process, for matrices that several have in parts: each puts the whole together,
// which has the bits of one alone, and so have its factors.
#include <memory>
#include <vector>

#include "osculate/la/mumps.hpp"

namespace osculate::testing {

/// The rows of all, on all.
[[nodiscard]] inline la::SparseMatrix gathered(const la::SparseMatrix& k) {
  const auto n = static_cast<std::size_t>(k.n);
  std::vector<double> length(n);
  for (std::size_t i = 0; i < n; ++i) length[i] = k.row_start[i + 1] - k.row_start[i];
  k.ranks->sum(length);
  la::SparseMatrix whole;
  whole.n = k.n;
  whole.row_start = {0};
  for (const double l : length)
    whole.row_start.push_back(whole.row_start.back() + static_cast<Index>(l));
  const auto entries = static_cast<std::size_t>(whole.row_start.back());
  std::vector<double> columns(entries, core::Ranks::nothing);
  whole.value.assign(entries, core::Ranks::nothing);
  for (std::size_t i = 0; i < n; ++i) {
    const auto to = static_cast<std::size_t>(whole.row_start[i]);
    const auto from = static_cast<std::size_t>(k.row_start[i]);
    for (std::size_t e = from; e < static_cast<std::size_t>(k.row_start[i + 1]); ++e) {
      columns[to + e - from] = k.column[e];
      whole.value[to + e - from] = k.value[e];
    }
  }
  k.ranks->sum(columns);
  k.ranks->sum(whole.value);
  whole.column.assign(columns.begin(), columns.end());
  return whole;
}

class GatheredSolver final : public la::LinearSolver {
 public:
  la::FactorReport factor(const la::SparseMatrix& k, std::uint64_t version,
                          la::Symmetry symmetry) override {
    return solver_.factor(k.ranks ? gathered(k) : k, version, symmetry);
  }
  la::SolveStatus solve(Eigen::VectorXd& x) override { return solver_.solve(x); }
  la::SolveStatus solve_once(Eigen::VectorXd& x) override { return solver_.solve_once(x); }
  la::SolveStatus solve(Eigen::MatrixXd& x) override { return solver_.solve(x); }
  [[nodiscard]] double seconds() const override { return solver_.seconds(); }

 private:
  la::Mumps solver_;
};

}  // namespace osculate::testing
