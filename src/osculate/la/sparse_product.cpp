#include "osculate/la/sparse_product.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace osculate::la {
namespace {

/// Consecutive columns of a row.
struct Run {
  Index column, count, value;  ///< the last: where the values begin
};

class Runs {
 public:
  explicit Runs(const CompressedRows& b) {
    for (Index i = 0; i < b.rows(); ++i) {
      for (Index e = b.outerIndexPtr()[i]; e < b.outerIndexPtr()[i + 1]; ++e) {
        const Index column = b.innerIndexPtr()[e];
        if (run_.size() > of_row_.back() && run_.back().column + run_.back().count == column)
          ++run_.back().count;
        else
          run_.push_back({column, 1, e});
      }
      of_row_.push_back(run_.size());
      as_before_.push_back(i > 0 &&
                           std::ranges::equal(of(i - 1), of(i), [](const Run& x, const Run& y) {
                             return x.column == y.column && x.count == y.count;
                           }));
    }
  }
  [[nodiscard]] std::span<const Run> of(Index row) const {
    const std::size_t first = of_row_[as_size(row)];
    return {run_.data() + first, of_row_[as_size(row) + 1] - first};
  }
  /// Whether this row and the two that follow, which there are, have their columns in common.
  [[nodiscard]] bool three_alike(Index row) const {
    return as_before_[as_size(row) + 1] != 0 && as_before_[as_size(row) + 2] != 0;
  }

 private:
  std::vector<Run> run_;
  std::vector<std::size_t> of_row_{0};
  std::vector<char> as_before_;
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

/// to += factor b, one summand after the other, in as many columns: no loop is left to the
/// compiler.
template <int Columns, std::size_t... K>
void add_columns(const double* factor, const std::array<const double*, sizeof...(K)>& b, Index c,
                 double* to, std::index_sequence<K...> /*summands*/) {
  using Some = Eigen::Array<double, Columns, 1>;
  Eigen::Map<Some> of(to + c);
  Some sum = of;
  ((sum += factor[K] * Eigen::Map<const Some>(b[K] + c)), ...);
  of = sum;
}

/// Likewise in `count` columns, of which a coarser model's node has six, in the plane three.
template <std::size_t Summands>
void add_to(const double* factor, const std::array<const double*, Summands>& b, Index count,
            double* to) {
  constexpr auto summands = std::make_index_sequence<Summands>{};
  Index c = 0;
  for (; c + 4 <= count; c += 4) add_columns<4>(factor, b, c, to, summands);
  for (; c + 2 <= count; c += 2) add_columns<2>(factor, b, c, to, summands);
  if (c < count) add_columns<1>(factor, b, c, to, summands);
}

/// Sums of a few rows that know in which blocks of columns they are not zero.
class SumsOfRows {
 public:
  static constexpr Index most = 3;
  explicit SumsOfRows(Index columns)
      : width_((columns / size + 1) * size),
        sum_(as_size(most * width_), 0.0),
        met_(as_size(columns / size + 1), 0) {}
  /// Adds rows of b from `row` on, which have their columns in common, times factors: of each of
  /// these rows one for each sum, those of the next one behind `stride` others.
  template <Index Sums, std::size_t Summands>
  void add(const double* factors, Index stride, const Runs& runs, Index row, const double* b) {
    std::array<std::array<double, Summands>, Sums> factor;
    for (std::size_t i = 0; i < Sums; ++i)
      for (std::size_t k = 0; k < Summands; ++k) factor[i][k] = factors[i + k * as_size(stride)];
    std::array<const Run*, Summands> run;
    for (std::size_t k = 0; k < Summands; ++k) run[k] = runs.of(row + static_cast<Index>(k)).data();
    for (std::size_t left = runs.of(row).size(); left > 0; --left) {
      const auto [column, count, first] = *run[0];
      std::array<const double*, Summands> from;
      for (std::size_t k = 0; k < Summands; ++k) from[k] = b + run[k]++->value;
      for (std::size_t i = 0; i < Sums; ++i)
        add_to<Summands>(factor[i].data(), from, count, sum_.data() + i * as_size(width_) + column);
      for (Index block = column / size; block <= (column + count - 1) / size; ++block)
        if (std::exchange(met_[as_size(block)], 1) == 0) blocks_.push_back(block);
    }
  }
  /// Takes what is not zero of the first rows, and begins with the next ones.
  void take(Index rows, Rows& out) {
    std::ranges::sort(blocks_);
    for (Index i = 0; i < rows; ++i) {
      for (const Index block : blocks_)
        for (Index c = block * size; c < (block + 1) * size; ++c)
          if (const double value = std::exchange(sum_[as_size(i * width_ + c)], 0.0); value != 0) {
            out.column.push_back(c);
            out.value.push_back(value);
          }
      out.end.push_back(static_cast<Index>(out.column.size()));
    }
    for (const Index block : blocks_) met_[as_size(block)] = 0;
    blocks_.clear();
  }

 private:
  static constexpr Index size = 8;
  Index width_;
  std::vector<double> sum_;
  std::vector<char> met_;
  std::vector<Index> blocks_;
};

/// As many as threads work at once: they are long, and come back empty.
class SumsOfThreads {
 public:
  explicit SumsOfThreads(Index columns) : columns_(columns) {}
  std::unique_ptr<SumsOfRows> take() {
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    if (free_.empty()) return std::make_unique<SumsOfRows>(columns_);
    std::unique_ptr<SumsOfRows> out = std::move(free_.back());
    free_.pop_back();
    return out;
  }
  void put_back(std::unique_ptr<SumsOfRows> sums) {
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    free_.push_back(std::move(sums));
  }

 private:
  Index columns_;
  std::mutex one_at_a_time_;
  std::vector<std::unique_ptr<SumsOfRows>> free_;
};

/// Some rows of a group, from `first` on.
template <Index Count>
void add_rows(const GroupedRows& a, std::size_t group, Index first, const Runs& runs,
              const double* b, SumsOfRows& sums, Rows& out) {
  const Index stride = a.groups()[group + 1] - a.groups()[group];
  const double* factors = a.values(group).data() + first;
  for (const GroupedRows::Run& run : a.runs(group))
    for (Index k = 0; k < run.count;) {
      const Index row = run.first + k;
      Index rows = 1;
      if (k + 3 <= run.count && runs.three_alike(row)) {
        sums.add<Count, 3>(factors, stride, runs, row, b);
        rows = 3;
      } else {
        sums.add<Count, 1>(factors, stride, runs, row, b);
      }
      k += rows;
      factors += static_cast<std::ptrdiff_t>(stride) * rows;
    }
  sums.take(Count, out);
}

/// Room for so many entries, and where there is none for as many times that as are expected.
void make_room(std::size_t entries, double expected, CompressedRows& out) {
  constexpr auto most = static_cast<double>(std::numeric_limits<Index>::max());
  // Not NotEnoughMemory, which all processes are short of.
  if (static_cast<double>(entries) > most) throw std::bad_alloc();
  if (static_cast<Eigen::Index>(entries) <= out.data().size()) return;
  const double all = std::min(most, std::max(1.0, expected) * static_cast<double>(entries));
  out.resizeNonZeros(std::max(static_cast<Index>(entries), static_cast<Index>(all)));
}

}  // namespace

/// Pieces of groups by several threads. Some rows wait beside the result at a time, which has room
/// for as many entries as these make expect: memory that nothing is written to is none.
CompressedRows product(const GroupedRows& a, const CompressedRows& b, core::Crew& crew) {
  constexpr Index least = 24, of_thread = 8, waves = 8;
  constexpr double spare = 1.1;
  const auto groups = static_cast<Index>(a.groups().size() - 1);
  const Index at_once = of_thread * crew.threads();
  const Index length = std::max(least, groups / (waves * at_once) + 1);
  const Runs runs(b);
  CompressedRows out(a.rows(), b.cols());
  Index* const end = out.outerIndexPtr();
  std::vector<Rows> piece(as_size(at_once));
  SumsOfThreads of_threads(static_cast<Index>(b.cols()));
  for (Index from = 0; from < groups; from += at_once * length) {
    const std::size_t pieces = as_size(std::min(at_once, (groups - from + length - 1) / length));
    const auto begin = [&](std::size_t p) {
      return as_size(std::min(groups, from + static_cast<Index>(p) * length));
    };
    const auto first_row = [&](std::size_t p) { return a.groups()[begin(p)]; };
    crew.share(pieces, [&](std::size_t p) {
      std::unique_ptr<SumsOfRows> sums = of_threads.take();
      piece[p].clear();
      for (std::size_t g = begin(p); g < begin(p + 1); ++g) {
        const Index size = a.groups()[g + 1] - a.groups()[g];
        Index i = 0;
        for (; i + 3 <= size; i += 3) add_rows<3>(a, g, i, runs, b.valuePtr(), *sums, piece[p]);
        for (; i < size; ++i) add_rows<1>(a, g, i, runs, b.valuePtr(), *sums, piece[p]);
      }
      of_threads.put_back(std::move(sums));
    });
    std::vector<std::size_t> first{as_size(end[first_row(0)])};
    for (std::size_t p = 0; p < pieces; ++p) first.push_back(first[p] + piece[p].value.size());
    const double done = std::max<double>(1, first_row(pieces));
    make_room(first.back(), spare * static_cast<double>(a.rows()) / done, out);
    crew.share(pieces, [&](std::size_t p) {
      std::ranges::copy(piece[p].column, out.innerIndexPtr() + first[p]);
      std::ranges::copy(piece[p].value, out.valuePtr() + first[p]);
      Index* next = end + first_row(p);
      for (const Index e : piece[p].end) *++next = static_cast<Index>(first[p]) + e;
    });
  }
  out.resizeNonZeros(end[a.rows()]);
  return out;
}

}  // namespace osculate::la
