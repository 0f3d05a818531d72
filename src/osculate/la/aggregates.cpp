#include "osculate/la/aggregates.hpp"

#include <algorithm>

namespace osculate::la {
namespace {

/// Neighbours of groups, row by row.
struct Neighbours {
  std::vector<Index> start{0}, group;

  [[nodiscard]] std::span<const Index> of(Index g) const {
    return std::span(group).subspan(as_size(start[as_size(g)]),
                                    as_size(start[as_size(g) + 1] - start[as_size(g)]));
  }
};

/// The group of each row.
std::vector<Index> groups_of_rows(const GroupStarts& start) {
  std::vector<Index> of(as_size(start.back()));
  for (std::size_t g = 0; g + 1 < start.size(); ++g)
    std::fill(of.begin() + start[g], of.begin() + start[g + 1], static_cast<Index>(g));
  return of;
}

double square_of(double entry) {
  constexpr double touched = 1e-300;
  return entry * entry + touched;
}

/// Square of the norm of a block of the diagonal.
double own_square(const GroupedRows& a, std::size_t g) {
  const Eigen::MatrixXd block = a.diagonal_block(g);
  double square = 0;
  for (Eigen::Index i = 0; i < block.rows(); ++i)
    for (Eigen::Index j = 0; j < block.cols(); ++j)
      if (block(i, j) != 0) square += square_of(block(i, j));
  return square;
}

/// Squares of the norms of the blocks of one row of groups.
class RowOfBlocks {
 public:
  RowOfBlocks(const GroupedRows& a, std::span<const Index> group_of)
      : a_(a), group_of_(group_of), square_(a.groups().size() - 1, 0) {}
  /// The groups met, `square` is theirs until the next call.
  const std::vector<Index>& visit(Index g) {
    for (const Index h : met_) square_[as_size(h)] = 0;
    met_.clear();
    a_.for_each(as_size(g), [&](Index, Index column, double value) {
      if (value == 0 || column >= a_.rows()) return;
      const Index h = group_of_[as_size(column)];
      if (square_[as_size(h)] == 0) met_.push_back(h);
      square_[as_size(h)] += square_of(value);
    });
    return met_;
  }
  [[nodiscard]] double square(Index h) const { return square_[as_size(h)]; }

 private:
  const GroupedRows& a_;
  std::span<const Index> group_of_;
  std::vector<Index> met_;
  std::vector<double> square_;
};

Neighbours neighbours(const GroupedRows& a, std::span<const char> left_out, double strength,
                      core::Crew& crew) {
  constexpr std::size_t worth_it = 200;
  const std::size_t groups = a.groups().size() - 1;
  const std::size_t pieces = std::clamp<std::size_t>(groups / worth_it, 1, 16);
  const auto begin = [&](std::size_t p) { return static_cast<Index>(groups * p / pieces); };
  const std::vector<Index> group_of = groups_of_rows(a.groups());
  std::vector<double> own(groups);
  crew.share(pieces, [&](std::size_t p) {
    for (Index g = begin(p); g < begin(p + 1); ++g) own[as_size(g)] = own_square(a, as_size(g));
  });
  const double least = strength * strength * strength * strength;
  std::vector<Neighbours> piece(pieces);
  crew.share(pieces, [&](std::size_t p) {
    RowOfBlocks row(a, group_of);
    Neighbours& of = piece[p];
    for (Index g = begin(p); g < begin(p + 1); ++g) {
      if (left_out[as_size(g)] == 0)
        for (const Index h : row.visit(g)) {
          const double square = row.square(h);
          if (h != g && left_out[as_size(h)] == 0 &&
              square * square > least * own[as_size(g)] * own[as_size(h)])
            of.group.push_back(h);
        }
      of.start.push_back(static_cast<Index>(of.group.size()));
    }
  });
  Neighbours out;
  for (const Neighbours& of : piece) {
    const Index before = out.start.back();
    for (std::size_t g = 1; g < of.start.size(); ++g) out.start.push_back(before + of.start[g]);
    out.group.insert(out.group.end(), of.group.begin(), of.group.end());
  }
  return out;
}

}  // namespace

Aggregates aggregate(const GroupedRows& a, std::span<const char> left_out, double strength,
                     core::Crew& crew) {
  const Neighbours near = neighbours(a, left_out, strength, crew);
  const auto groups = static_cast<Index>(a.groups().size() - 1);
  Aggregates out{0, std::vector<Index>(as_size(groups), -1)};
  std::vector<Index>& of = out.of_group;
  const auto is_free = [&](Index g) { return left_out[as_size(g)] == 0 && of[as_size(g)] < 0; };
  const auto found = [&](Index g) {
    of[as_size(g)] = out.count++;
    for (const Index h : near.of(g))
      if (of[as_size(h)] < 0) of[as_size(h)] = of[as_size(g)];
  };
  for (Index g = 0; g < groups; ++g) {
    if (!is_free(g) || near.of(g).empty()) continue;
    bool whole = true;
    for (const Index h : near.of(g)) whole = whole && of[as_size(h)] < 0;
    if (whole) found(g);
  }
  const std::vector<Index> first = of;
  for (Index g = 0; g < groups; ++g) {
    if (!is_free(g)) continue;
    for (const Index h : near.of(g))
      if (first[as_size(h)] >= 0) {
        of[as_size(g)] = first[as_size(h)];
        break;
      }
  }
  for (Index g = 0; g < groups; ++g)
    if (is_free(g)) found(g);
  return out;
}

}  // namespace osculate::la
