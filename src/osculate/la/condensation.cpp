#include "osculate/la/condensation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace osculate::la {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

double value_at(const SparseMatrix& k, Index row, Index column) {
  const auto first = k.column.begin() + k.row_start[at(row)];
  const auto last = k.column.begin() + k.row_start[at(row) + 1];
  const auto found = std::lower_bound(first, last, column);
  return found != last && *found == column
             ? k.value[at(static_cast<Index>(found - k.column.begin()))]
             : 0.0;
}

double largest_in_row(const SparseMatrix& k, Index row) {
  double largest = 0;
  for (Index e = k.row_start[at(row)]; e < k.row_start[at(row) + 1]; ++e)
    largest = std::max(largest, std::abs(k.value[at(e)]));
  return largest;
}

/// Entries of the first `nodes` rows (of the slave node) and the others (the multipliers' own) for
/// the choice of pivots. A multiplier's column is scaled such that its largest entry is one, those
/// in the rows of other nodes (`largest`) included: a pivot is then the inverse of what rows are
/// multiplied by. Own rows are scaled by all their entries, and count for less, so that the node's
/// are taken where both would do.
template <class Rows>
LocalBlock scaled_block(const SparseMatrix& k, const Rows& rows, int nodes, Index first,
                        std::span<const double> largest) {
  constexpr double own_share = 0.25;
  LocalBlock out(rows.count, static_cast<Eigen::Index>(largest.size()));
  for (int i = 0; i < rows.count; ++i)
    for (Index j = 0; j < out.cols(); ++j) out(i, j) = value_at(k, rows.items[at(i)], first + j);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_multipliers, 1> scale(out.cols());
  for (Index j = 0; j < out.cols(); ++j) {
    const double size = std::max(largest[at(j)], out.col(j).cwiseAbs().maxCoeff());
    scale[j] = size > 0 ? 1 / size : 1.0;
    out.col(j) *= scale[j];
  }
  for (int i = nodes; i < rows.count; ++i)
    if (const double size = largest_in_row(k, rows.items[at(i)]) * scale[i - nodes]; size > 0)
      out.row(i) *= own_share / size;
  return out;
}

}  // namespace

// ---- what is condensed --------------------------------------------------------------------------

void Condensation::set_owners(std::span<const MultiplierGroup> groups, Index n) {
  if (n_ == n && std::ranges::equal(groups_, groups)) return;
  groups_.assign(groups.begin(), groups.end());
  points_.clear();
  n_ = n;
  owner_.assign(at(n), -1);
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (Index i = 0; i < groups_[g].count; ++i)
      owner_[at(groups_[g].first + i)] = static_cast<Index>(g);
}

void Condensation::measure_columns(const SparseMatrix& k) {
  const Index first = groups_.front().first;
  largest_.assign(at(k.n), 0.0);
  for (Index row = 0; row < first; ++row)
    for (Index e = k.row_start[at(row) + 1] - 1; e >= k.row_start[at(row)]; --e) {
      const Index column = k.column[at(e)];
      if (column < first) break;
      largest_[at(column)] = std::max(largest_[at(column)], std::abs(k.value[at(e)]));
    }
}

/// Whether the row knows no multipliers of other groups.
bool Condensation::alone(const SparseMatrix& k, Index row, std::size_t g) const {
  constexpr double rounding = 1e-13;
  for (Index e = k.row_start[at(row) + 1] - 1; e >= k.row_start[at(row)]; --e) {
    const std::size_t column = at(k.column[at(e)]);
    if (k.column[at(e)] < groups_.front().first) break;
    if (owner_[column] < 0 || owner_[column] == static_cast<Index>(g)) continue;
    if (!(std::abs(k.value[at(e)]) <= rounding * largest_[column])) return false;
  }
  return true;
}

Condensation::Point Condensation::chosen(const SparseMatrix& k, std::size_t g) const {
  constexpr double least_pivot = 1e-4;
  const MultiplierGroup& group = groups_[g];
  Point p;
  List<most_local_rows> rows;
  for (const Index u : group.node)
    if (u >= 0 && alone(k, u, g)) p.node.push(u);
  for (const Index u : p.node) rows.push(u);
  for (Index i = 0; i < group.count; ++i) rows.push(group.first + i);
  LocalPivots pivots;
  if (p.node.count > 0)
    pivots =
        local_pivots(scaled_block(k, rows, p.node.count, group.first,
                                  std::span(largest_).subspan(at(group.first), at(group.count))),
                     least_pivot);
  std::array<bool, most_local_rows> taken{};
  std::array<bool, most_multipliers> gone{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(pivots.count); ++i)
    taken[static_cast<std::size_t>(pivots.rows[i])] =
        gone[static_cast<std::size_t>(pivots.columns[i])] = true;
  for (int i = 0; i < rows.count; ++i)
    if (taken[at(i)]) p.pivot_rows.push(rows.items[at(i)]);
  for (Index i = 0; i < group.count; ++i)
    (gone[at(i)] ? p.eliminated : p.kept).push(group.first + i);
  Square block(pivots.count, pivots.count);
  for (int i = 0; i < pivots.count; ++i)
    for (int j = 0; j < pivots.count; ++j)
      block(i, j) = value_at(k, p.pivot_rows.items[at(i)], p.eliminated.items[at(j)]);
  if (pivots.count > 0) p.inverse = block.inverse();
  return p;
}

bool Condensation::same_structure(const SparseMatrix& k, const std::vector<Point>& next) const {
  return std::ranges::equal(points_, next,
                            [](const Point& a, const Point& b) {
                              return a.node == b.node && a.eliminated == b.eliminated;
                            }) &&
         row_start_ == k.row_start && column_ == k.column;
}

bool Condensation::reduce(const SparseMatrix& k, std::span<const MultiplierGroup> groups) {
  if (groups.empty()) return false;
  set_owners(groups, k.n);
  measure_columns(k);
  std::vector<Point> next(groups_.size());
  for (std::size_t g = 0; g < next.size(); ++g) next[g] = chosen(k, g);
  if (std::ranges::none_of(next, [](const Point& p) { return p.eliminated.count > 0; }))
    return false;
  const bool stands = same_structure(k, next);
  points_ = std::move(next);
  if (!stands) set_structure(k);
  place_rows(k);
  set_weights(k);
  couplings_.clear();
  for (Index place = 0; place < matrix_.n; ++place) set_row(k, place);
  return true;
}

// ---- pattern ------------------------------------------------------------------------------------

void Condensation::set_structure(const SparseMatrix& k) {
  row_start_ = k.row_start;
  column_ = k.column;
  member_.assign(at(k.n), -1);
  place_.assign(at(k.n), 0);
  for (std::size_t g = 0; g < points_.size(); ++g) {
    if (!eliminates(g)) continue;
    for (const Index u : points_[g].node) member_[at(u)] = static_cast<Index>(g);
    for (Index i = 0; i < groups_[g].count; ++i)
      member_[at(groups_[g].first + i)] = static_cast<Index>(g);
    for (const Index u : points_[g].eliminated) place_[at(u)] = -1;
  }
  unknowns_.clear();
  for (Index u = 0; u < k.n; ++u) {
    if (place_[at(u)] < 0) continue;
    place_[at(u)] = static_cast<Index>(unknowns_.size());
    unknowns_.push_back(u);
  }
  matrix_.n = static_cast<Index>(unknowns_.size());
  slot_.assign(unknowns_.size(), 0);
  marked_.assign(unknowns_.size(), false);
  set_columns(k);
  set_pattern(k);
  ++version_;
}

void Condensation::mark(Index place, std::vector<Index>& found) {
  if (place < 0 || marked_[at(place)]) return;
  marked_[at(place)] = true;
  found.push_back(place);
}

void Condensation::mark_row(const SparseMatrix& k, Index row, std::vector<Index>& found) {
  for (Index e = k.row_start[at(row)]; e < k.row_start[at(row) + 1]; ++e)
    mark(place_[at(k.column[at(e)])], found);
}

/// Appends what was marked, sorted, and unmarks it.
void Condensation::finish_marks(std::vector<Index>& found, std::vector<Index>& out) {
  std::sort(found.begin(), found.end());
  for (const Index place : found) marked_[at(place)] = false;
  out.insert(out.end(), found.begin(), found.end());
  found.clear();
}

void Condensation::set_columns(const SparseMatrix& k) {
  std::vector<Index> found;
  columns_.clear();
  column_begin_.assign(1, 0);
  weight_begin_.assign(1, 0);
  for (std::size_t g = 0; g < points_.size(); ++g) {
    if (eliminates(g)) {
      for (const Index row : points_[g].node) mark_row(k, row, found);
      for (Index i = 0; i < groups_[g].count; ++i) mark_row(k, groups_[g].first + i, found);
      finish_marks(found, columns_);
    }
    weight_begin_.push_back(weight_begin_.back() + (columns_.size() - column_begin_.back()) *
                                                       at(points_[g].eliminated.count));
    column_begin_.push_back(columns_.size());
  }
  weights_.resize(weight_begin_.back());
}

void Condensation::set_pattern(const SparseMatrix& k) {
  std::vector<Index> found;
  matrix_.row_start.assign(1, 0);
  matrix_.column.clear();
  const auto mark_point = [&](Index g) {
    for (std::size_t c = column_begin_[at(g)]; c < column_begin_[at(g) + 1]; ++c)
      mark(columns_[c], found);
  };
  for (const Index u : unknowns_) {
    if (member_[at(u)] >= 0) {
      mark_point(member_[at(u)]);
    } else {
      mark_row(k, u, found);
      Index last = -1;
      for (Index e = k.row_start[at(u)]; e < k.row_start[at(u) + 1]; ++e) {
        const Index column = k.column[at(e)];
        if (place_[at(column)] >= 0 || owner_[at(column)] == last) continue;
        last = owner_[at(column)];
        mark_point(last);
      }
    }
    finish_marks(found, matrix_.column);
    matrix_.row_start.push_back(static_cast<Index>(matrix_.column.size()));
  }
  matrix_.value.assign(matrix_.column.size(), 0.0);
}

// ---- values -------------------------------------------------------------------------------------

/// Which row stands where. The rows of a point that are not taken go to the places of its unknowns
/// such that what stands on the diagonal is large.
void Condensation::place_rows(const SparseMatrix& k) {
  row_at_ = unknowns_;
  for (std::size_t g = 0; g < points_.size(); ++g) {
    if (!eliminates(g)) continue;
    const Point& p = points_[g];
    List<most_local_rows> rows, places;
    const auto add = [&](Index row) {
      if (std::find(p.pivot_rows.begin(), p.pivot_rows.end(), row) == p.pivot_rows.end())
        rows.push(row);
    };
    for (const Index u : p.node) {
      add(u);
      places.push(u);
    }
    for (Index i = 0; i < groups_[g].count; ++i) add(groups_[g].first + i);
    for (const Index u : p.kept) places.push(u);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_local_rows, most_local_rows> size(
        rows.count, places.count);
    for (int i = 0; i < rows.count; ++i) {
      const double largest = largest_in_row(k, rows.items[at(i)]);
      for (int j = 0; j < places.count; ++j) {
        constexpr double stays = 2;  // rows that have a place of their own
        const double share =
            std::abs(value_at(k, rows.items[at(i)], places.items[at(j)])) / largest;
        size(i, j) = rows.items[at(i)] == places.items[at(j)] ? stays
                     : std::isfinite(share)                   ? share
                                                              : 0.0;
      }
    }
    for (int done = 0; done < rows.count; ++done) {
      Eigen::Index i = 0, j = 0;
      size.maxCoeff(&i, &j);
      row_at_[at(place_[at(places.items[static_cast<std::size_t>(j)])])] =
          rows.items[static_cast<std::size_t>(i)];
      size.row(i).setConstant(-1);
      size.col(j).setConstant(-1);
    }
  }
}

void Condensation::set_weights(const SparseMatrix& k) {
  std::fill(weights_.begin(), weights_.end(), 0.0);
  for (std::size_t g = 0; g < points_.size(); ++g) {
    if (!eliminates(g)) continue;
    const Point& p = points_[g];
    const std::size_t begin = column_begin_[g], count = column_begin_[g + 1] - begin;
    for (std::size_t c = 0; c < count; ++c) slot_[at(columns_[begin + c])] = static_cast<Index>(c);
    Eigen::Map<Eigen::MatrixXd> w(weights_.data() + weight_begin_[g], p.eliminated.count,
                                  static_cast<Eigen::Index>(count));
    for (int i = 0; i < p.pivot_rows.count; ++i) {
      const Index row = p.pivot_rows.items[at(i)];
      for (Index e = k.row_start[at(row)]; e < k.row_start[at(row) + 1]; ++e) {
        const Index place = place_[at(k.column[at(e)])];
        if (place >= 0) w.col(slot_[at(place)]) += p.inverse.col(i) * k.value[at(e)];
      }
    }
  }
}

/// Of the row at a place, by points. Rows of a point know others' multipliers by rounding only.
void Condensation::find_couplings(const SparseMatrix& k, Index place) {
  const Index row = row_at_[at(place)];
  Index last = -1;
  for (Index e = k.row_start[at(row)]; e < k.row_start[at(row) + 1]; ++e) {
    const Index column = k.column[at(e)];
    const double value = k.value[at(e)];
    if (place_[at(column)] >= 0 || value == 0) continue;
    const Index g = owner_[at(column)];
    if (member_[at(row)] >= 0 && member_[at(row)] != g) continue;
    const Point& p = points_[at(g)];
    if (g != last) couplings_.push_back({place, at(g), Coefficients::Zero(p.eliminated.count)});
    last = g;
    couplings_.back().entries[std::find(p.eliminated.begin(), p.eliminated.end(), column) -
                              p.eliminated.begin()] = value;
  }
}

void Condensation::set_row(const SparseMatrix& k, Index place) {
  const Index row = row_at_[at(place)], begin = matrix_.row_start[at(place)],
              end = matrix_.row_start[at(place) + 1];
  for (Index e = begin; e < end; ++e) {
    slot_[at(matrix_.column[at(e)])] = e;
    matrix_.value[at(e)] = 0;
  }
  for (Index e = k.row_start[at(row)]; e < k.row_start[at(row) + 1]; ++e)
    if (const Index to = place_[at(k.column[at(e)])]; to >= 0)
      matrix_.value[at(slot_[at(to)])] += k.value[at(e)];
  const std::size_t before = couplings_.size();
  find_couplings(k, place);
  for (std::size_t i = before; i < couplings_.size(); ++i) {
    const Coupling& c = couplings_[i];
    const double* w = weights_.data() + weight_begin_[c.point];
    for (std::size_t at_column = column_begin_[c.point]; at_column < column_begin_[c.point + 1];
         ++at_column, w += c.entries.size())
      matrix_.value[at(slot_[at(columns_[at_column])])] -=
          c.entries.dot(Eigen::Map<const Eigen::VectorXd>(w, c.entries.size()));
  }
}

// ---- right-hand sides ---------------------------------------------------------------------------

Eigen::VectorXd Condensation::reduced(const Eigen::VectorXd& rhs) const {
  Eigen::VectorXd out(matrix_.n);
  for (Index place = 0; place < matrix_.n; ++place) out[place] = rhs[row_at_[at(place)]];
  for (const Coupling& c : couplings_) {
    const Point& p = points_[c.point];
    for (int i = 0; i < p.pivot_rows.count; ++i)
      out[c.place] -= c.entries.dot(p.inverse.col(i)) * rhs[p.pivot_rows.items[at(i)]];
  }
  return out;
}

Eigen::VectorXd Condensation::expanded(const Eigen::VectorXd& solution,
                                       const Eigen::VectorXd& rhs) const {
  Eigen::VectorXd out(n_);
  for (Index place = 0; place < matrix_.n; ++place) out[unknowns_[at(place)]] = solution[place];
  for (std::size_t g = 0; g < points_.size(); ++g) {
    if (!eliminates(g)) continue;
    const Point& p = points_[g];
    Coefficients value = Coefficients::Zero(p.eliminated.count);
    for (int i = 0; i < p.pivot_rows.count; ++i)
      value += p.inverse.col(i) * rhs[p.pivot_rows.items[at(i)]];
    const double* w = weights_.data() + weight_begin_[g];
    for (std::size_t c = column_begin_[g]; c < column_begin_[g + 1]; ++c, w += value.size())
      value -= Eigen::Map<const Eigen::VectorXd>(w, value.size()) * solution[columns_[c]];
    for (int i = 0; i < p.eliminated.count; ++i) out[p.eliminated.items[at(i)]] = value[i];
  }
  return out;
}

}  // namespace osculate::la
