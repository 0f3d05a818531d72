#include "osculate/la/compact_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#ifdef __AVX2__
#include <immintrin.h>
#endif

#include "osculate/la/long_vectors.hpp"

namespace osculate::la {
namespace {

constexpr double most = std::numeric_limits<std::int16_t>::max();
constexpr Index most_rows = 3;    ///< of a bundle
constexpr std::size_t lanes = 8;  ///< that are read at once, of x also behind the last one
constexpr std::size_t bundles_at_least = 64;  ///< while a thread is told of them

// Registers where the processor has them, and inlined where not.
#if defined(__GNUC__) && !defined(__AVX__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif
using Floats __attribute__((vector_size(32))) = float;

/// Eight entries that stand behind each other.
inline Floats entries_at(const std::int16_t* values) {
#ifdef __AVX2__  // g++ takes five instructions where two do
  __m128i read;
  std::memcpy(&read, values, sizeof(read));
  return reinterpret_cast<Floats>(_mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(read)));
#else
  using Short __attribute__((vector_size(16))) = std::int16_t;
  Short read;
  std::memcpy(&read, values, sizeof(read));
  return __builtin_convertvector(read, Floats);
#endif
}

/// The numbers of x that belong to eight entries of columns of so many rows.
template <int Rows>
inline Floats of_columns(const float* x) {
  Floats read;
  std::memcpy(&read, x, sizeof(read));
  return __builtin_shufflevector(read, read, 0, 1 / Rows, 2 / Rows, 3 / Rows, 4 / Rows, 5 / Rows,
                                 6 / Rows, 7 / Rows);
}

/// One step along the columns of a row of entries; what eight entries leave of the last column
/// follows by itself.
template <int Rows>
inline void add(const std::int16_t* values, const float* x, Floats& sum, float& of_last) {
  sum += entries_at(values) * of_columns<Rows>(x);
  if constexpr (Rows == 3) of_last += static_cast<float>(values[8]) * x[2];
}

/// Sums of each row, in registers.
template <int Rows>
void multiply_rows(std::span<const GroupedRows::Run> runs, const std::int16_t* values,
                   const float* x, const double* scale, double unit, double* y) {
  constexpr Index at_once = (lanes + Rows - 1) / Rows;
  Floats first{}, second{};
  float of_first = 0, of_second = 0;
  std::array<float, Rows> others{};
  for (const GroupedRows::Run& run : runs) {
    const float* at = x + run.first;
    Index left = run.count;
    for (; left >= 2 * at_once; left -= 2 * at_once) {
      add<Rows>(values, at, first, of_first);
      add<Rows>(values + Rows * at_once, at + at_once, second, of_second);
      values += std::ptrdiff_t{2} * Rows * at_once;
      at += std::ptrdiff_t{2} * at_once;
    }
    if (left >= at_once) {
      add<Rows>(values, at, first, of_first);
      values += std::ptrdiff_t{Rows} * at_once;
      at += at_once;
      left -= at_once;
    }
    for (; left > 0; --left, ++at, values += Rows)
      for (std::size_t row = 0; row < Rows; ++row)
        others[row] += static_cast<float>(values[row]) * *at;
  }
  first += second;
  others[Rows - 1] += of_first + of_second;
  for (std::size_t row = 0; row < Rows; ++row) {
    float sum = others[row];
    for (std::size_t l = row; l < lanes; l += Rows) sum += first[l];
    y[row] = unit * scale[row] * static_cast<double>(sum);
  }
}

/// The power of two next to a number; 1 for what has none.
double power_near(double value) {
  int exponent = 0;
  if (value > 0 && std::isfinite(value)) std::frexp(value, &exponent);
  return std::ldexp(1.0, exponent);
}

}  // namespace

CompactRows::CompactRows(const GroupedRows& a, core::Crew& crew, const Eigen::VectorXd& of_column)
    : of_row_(Eigen::VectorXd::Zero(a.rows())) {
  if (of_column.size() > 0)
    of_column_ = of_column.unaryExpr(&power_near);
  else
    of_column_ = Eigen::VectorXd::Ones(a.columns());
  const GroupStarts& groups = a.groups();
  std::size_t value = 0;
  for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
    const auto first_run = static_cast<Index>(runs_.size());
    Index columns = 0;
    for (const Run& run : a.runs(g)) {
      runs_.push_back(run);
      columns += run.count;
    }
    const Index runs = static_cast<Index>(runs_.size()) - first_run;
    for (Index row = groups[g]; row < groups[g + 1]; row += most_rows) {
      const Index rows = std::min(most_rows, groups[g + 1] - row);
      bundles_.push_back({row, rows, static_cast<Index>(g), first_run, runs, value});
      value += as_size(rows) * as_size(columns);
    }
  }
  values_.assign(value, 0);
  crew.share_runs(bundles_.size(), bundles_at_least, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) take(a, bundles_[b]);
  });
}

void CompactRows::copy(const GroupedRows& from, const std::vector<char>& groups, core::Crew& crew) {
  crew.share_runs(bundles_.size(), bundles_at_least, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      if (groups[as_size(bundles_[b].group)] != 0) take(from, bundles_[b]);
  });
}

void CompactRows::take(const GroupedRows& from, const Bundle& bundle) {
  constexpr double nothing = 1e-290;
  const std::size_t group = as_size(bundle.group);
  const Index all = from.groups()[group + 1] - from.groups()[group];
  const double* const first = from.values(group).data() + (bundle.first_row - from.groups()[group]);
  std::array<double, most_rows> largest{}, factor{};
  const auto each = [&](const auto& work) {
    const double* of = first;
    std::size_t k = 0;
    for (const Run& run : from.runs(group))
      for (Index j = run.first; j < run.first + run.count; ++j, of += all)
        for (Index i = 0; i < bundle.rows; ++i, ++k) work(as_size(i), k, of[i] / of_column_[j]);
  };
  bool numbers = true;
  each([&](std::size_t i, std::size_t, double value) {
    numbers = numbers && std::isfinite(value);
    largest[i] = std::max(largest[i], std::abs(value));
  });
  for (Index i = 0; i < bundle.rows; ++i) {
    const double size = largest[as_size(i)];
    factor[as_size(i)] = size > nothing ? most / size : 0;
    of_row_[bundle.first_row + i] =
        numbers ? size / most : std::numeric_limits<double>::quiet_NaN();
  }
  std::int16_t* const to = values_.data() + bundle.value;
  each([&](std::size_t i, std::size_t k, double value) {
    to[k] = numbers ? static_cast<std::int16_t>(std::lrint(factor[i] * value)) : std::int16_t{0};
  });
}

/// Numbers below one in size. Returns what they are to be multiplied by.
double CompactRows::put_in(const Eigen::VectorXd& x, core::Crew& crew,
                           std::vector<float>& out) const {
  out.resize(static_cast<std::size_t>(x.size()) + lanes);
  const auto of = [&](Eigen::Index first, Eigen::Index size) {
    return x.segment(first, size).array() * of_column_.segment(first, size).array();
  };
  Eigen::VectorXd largest = Eigen::VectorXd::Zero((x.size() + vector_piece - 1) / vector_piece);
  for_vector_pieces(x.size(), &crew, [&](Eigen::Index first, Eigen::Index size) {
    largest[first / vector_piece] = of(first, size).abs().maxCoeff();
  });
  const double unit = power_near(largest.size() > 0 ? largest.maxCoeff() : 0);
  for_vector_pieces(x.size(), &crew, [&](Eigen::Index first, Eigen::Index size) {
    Eigen::Map<Eigen::ArrayXf>(out.data() + first, size) = (of(first, size) / unit).cast<float>();
  });
  return unit;
}

void CompactRows::multiply(const Eigen::VectorXd& x, core::Crew& crew, Eigen::VectorXd& y) const {
  std::vector<float> numbers;
  const double unit = put_in(x, crew, numbers);
  y.resize(of_row_.size());
  crew.share_runs(bundles_.size(), bundles_at_least, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const auto& [first, rows, group, first_run, count, value] = bundles_[b];
      const std::span<const Run> runs(runs_.data() + first_run, as_size(count));
      const auto by = rows == 1   ? &multiply_rows<1>
                      : rows == 2 ? &multiply_rows<2>
                                  : &multiply_rows<3>;
      by(runs, values_.data() + value, numbers.data(), of_row_.data() + first, unit,
         y.data() + first);
    }
  });
}

}  // namespace osculate::la
