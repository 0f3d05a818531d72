#include "osculate/la/compressed_rows.hpp"

#include <algorithm>
#include <limits>
#include <new>
#include <numeric>
#include <utility>
#include <vector>

namespace osculate::la {

void multiply(const CompressedRows& a, const Eigen::VectorXd& x, core::Crew& crew,
              Eigen::VectorXd& y) {
  constexpr std::size_t worth_it = 500;
  y.resize(a.rows());
  const Index* const start = a.outerIndexPtr();
  const Index* const column = a.innerIndexPtr();
  const double* const value = a.valuePtr();
  const std::size_t rows = as_size(static_cast<Index>(a.rows()));
  crew.share_runs(rows, worth_it, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double sum = 0;
      for (Index e = start[i]; e < start[i + 1]; ++e) sum += value[e] * x[column[e]];
      y[static_cast<Index>(i)] = sum;
    }
  });
}

namespace {

/// Calls take(row, column, value) as `for_each_entry` does, of an unsymmetric matrix: rows by
/// several threads.
template <class Take>
void for_each_entry(const SparseMatrix& k, core::Crew& crew, const Take& take) {
  constexpr std::size_t worth_it = 500;
  crew.share_runs(as_size(k.n), worth_it, [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<Index>(begin); i < static_cast<Index>(end); ++i)
      for (Index e = k.row_start[as_size(i)]; e < k.row_start[as_size(i) + 1]; ++e)
        if (const Index j = k.column[as_size(e)]; k.value[as_size(e)] != 0 || i == j)
          take(i, j, k.value[as_size(e)]);
  });
}

}  // namespace

CompressedRows compressed(const SparseMatrix& k, Symmetry symmetry, core::Crew& crew) {
  const auto each = [&](const auto& take) {
    if (symmetry == Symmetry::unsymmetric)
      for_each_entry(k, crew, take);
    else
      for_each_entry(k, symmetry, take);  // rows from above, so that columns are in order
  };
  std::vector<Index> next(as_size(k.n) + 1, 0);
  each([&](Index i, Index, double) { ++next[as_size(i) + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  CompressedRows a(k.n, k.n);
  a.resizeNonZeros(next.back());
  std::ranges::copy(next, a.outerIndexPtr());
  each([&](Index i, Index j, double value) {
    const Index at = next[as_size(i)]++;
    a.innerIndexPtr()[at] = j;
    a.valuePtr()[at] = value;
  });
  return a;
}

SparseMatrix stored(const CompressedRows& a) {
  SparseMatrix k;
  k.n = static_cast<Index>(a.rows());
  k.row_start.assign(a.outerIndexPtr(), a.outerIndexPtr() + k.n + 1);
  k.column.assign(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros());
  k.value.assign(a.valuePtr(), a.valuePtr() + a.nonZeros());
  return k;
}

namespace {

/// Consecutive columns of a row.
struct Run {
  Index column, count, value;  ///< the last: where the values begin
};

struct Runs {
  std::vector<Run> run;
  std::vector<std::size_t> of_row{0};

  explicit Runs(const CompressedRows& b) {
    for (Index i = 0; i < b.rows(); ++i) {
      for (Index e = b.outerIndexPtr()[i]; e < b.outerIndexPtr()[i + 1]; ++e) {
        const Index column = b.innerIndexPtr()[e];
        if (run.size() > of_row.back() && run.back().column + run.back().count == column)
          ++run.back().count;
        else
          run.push_back({column, 1, e});
      }
      of_row.push_back(run.size());
    }
  }
};

/// Some rows of a product.
struct Rows {
  std::vector<Index> end, column;  ///< of each row, and of each entry
  std::vector<double> value;
  void clear() {
    end.clear();
    column.clear();
    value.clear();
  }
};

/// Room for so many entries, and where there is none for as many times that as are expected.
void make_room(std::size_t entries, double expected, CompressedRows& out) {
  constexpr auto most = static_cast<double>(std::numeric_limits<Index>::max());
  // Not NotEnoughMemory, which all processes are short of.
  if (static_cast<double>(entries) > most) throw std::bad_alloc();
  if (static_cast<Eigen::Index>(entries) <= out.data().size()) return;
  const double all = std::min(most, std::max(1.0, expected) * static_cast<double>(entries));
  out.resizeNonZeros(std::max(static_cast<Index>(entries), static_cast<Index>(all)));
}

/// A sum of rows that knows in which blocks of columns it is not zero.
class SumOfRows {
 public:
  explicit SumOfRows(Index columns)
      : sum_(as_size(columns / size + 1) * size, 0.0), met_(as_size(columns / size + 1), 0) {}
  void add(double factor, const Run& run, const double* values) {
    double* const to = sum_.data() + run.column;
    const double* const from = values + run.value;
    Index c = 0;
    using OfNode = Eigen::Matrix<double, 6, 1>;  // no loop is left to the compiler
    for (; c + 6 <= run.count; c += 6)
      Eigen::Map<OfNode>(to + c) += factor * Eigen::Map<const OfNode>(from + c);
    for (; c < run.count; ++c) to[c] += factor * from[c];
    for (Index b = run.column / size; b <= (run.column + run.count - 1) / size; ++b)
      if (std::exchange(met_[as_size(b)], 1) == 0) blocks_.push_back(b);
  }
  /// Takes what is not zero, and begins with the next one.
  void take(Rows& out) {
    std::ranges::sort(blocks_);
    for (const Index b : blocks_) {
      met_[as_size(b)] = 0;
      for (Index c = b * size; c < (b + 1) * size; ++c)
        if (const double value = std::exchange(sum_[as_size(c)], 0.0); value != 0) {
          out.column.push_back(c);
          out.value.push_back(value);
        }
    }
    blocks_.clear();
    out.end.push_back(static_cast<Index>(out.column.size()));
  }

 private:
  static constexpr Index size = 8;
  std::vector<double> sum_;
  std::vector<char> met_;
  std::vector<Index> blocks_;
};

}  // namespace

/// Row by row, where columns of `b` come in runs, as those of a coarser model's nodes do. By
/// several threads; the bits are those of one. Some rows wait beside the result at a time, which
/// has room for as many entries as these make expect: memory that nothing is written to is none.
CompressedRows product(const CompressedRows& a, const CompressedRows& b, core::Crew& crew) {
  constexpr Index least = 64, of_thread = 8, waves = 8;
  constexpr double spare = 1.1;
  const auto rows = static_cast<Index>(a.rows());
  const Index at_once = of_thread * crew.threads();
  const Index length = std::max(least, rows / (waves * at_once) + 1);
  const Runs runs(b);
  CompressedRows out(rows, b.cols());
  Index* const end = out.outerIndexPtr();
  std::vector<Rows> piece(as_size(at_once));
  for (Index from = 0; from < rows; from += at_once * length) {
    const std::size_t pieces = as_size(std::min(at_once, (rows - from + length - 1) / length));
    const auto begin = [&](std::size_t p) {
      return std::min(rows, from + static_cast<Index>(p) * length);
    };
    crew.share(pieces, [&](std::size_t p) {
      SumOfRows sum(static_cast<Index>(b.cols()));
      piece[p].clear();
      for (Index i = begin(p); i < begin(p + 1); ++i) {
        for (CompressedRows::InnerIterator entry(a, i); entry; ++entry) {
          const std::size_t k = as_size(static_cast<Index>(entry.col()));
          for (std::size_t r = runs.of_row[k]; r < runs.of_row[k + 1]; ++r)
            sum.add(entry.value(), runs.run[r], b.valuePtr());
        }
        sum.take(piece[p]);
      }
    });
    std::vector<std::size_t> first{as_size(end[from])};
    for (std::size_t p = 0; p < pieces; ++p) first.push_back(first[p] + piece[p].value.size());
    make_room(first.back(), spare * static_cast<double>(rows) / begin(pieces), out);
    crew.share(pieces, [&](std::size_t p) {
      std::ranges::copy(piece[p].column, out.innerIndexPtr() + first[p]);
      std::ranges::copy(piece[p].value, out.valuePtr() + first[p]);
      Index* next = end + begin(p);
      for (const Index e : piece[p].end) *++next = static_cast<Index>(first[p]) + e;
    });
  }
  out.resizeNonZeros(end[rows]);
  return out;
}

}  // namespace osculate::la
