#include "osculate/la/aggregates.hpp"

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

/// Squares of the norms of the blocks of one row of groups.
class RowOfBlocks {
 public:
  RowOfBlocks(const CompressedRows& a, const GroupStarts& start)
      : a_(a), start_(start), group_of_(as_size(a.rows())), square_(start.size() - 1, 0) {
    for (std::size_t g = 0; g + 1 < start.size(); ++g)
      for (Index i = start[g]; i < start[g + 1]; ++i) group_of_[as_size(i)] = static_cast<Index>(g);
  }
  /// The groups met, `square` is theirs until the next call.
  const std::vector<Index>& visit(Index g) {
    constexpr double touched = 1e-300;
    for (const Index h : met_) square_[as_size(h)] = 0;
    met_.clear();
    for (Index i = start_[as_size(g)]; i < start_[as_size(g) + 1]; ++i)
      for (CompressedRows::InnerIterator entry(a_, i); entry; ++entry) {
        if (entry.value() == 0 || entry.col() >= a_.rows()) continue;
        const Index h = group_of_[as_size(static_cast<Index>(entry.col()))];
        if (square_[as_size(h)] == 0) met_.push_back(h);
        square_[as_size(h)] += entry.value() * entry.value() + touched;
      }
    return met_;
  }
  [[nodiscard]] double square(Index h) const { return square_[as_size(h)]; }

 private:
  const CompressedRows& a_;
  const GroupStarts& start_;
  std::vector<Index> group_of_, met_;
  std::vector<double> square_;
};

Neighbours neighbours(const CompressedRows& a, const GroupStarts& start,
                      std::span<const char> left_out, double strength) {
  RowOfBlocks row(a, start);
  const auto groups = static_cast<Index>(start.size() - 1);
  std::vector<double> own(as_size(groups));
  for (Index g = 0; g < groups; ++g) {
    row.visit(g);
    own[as_size(g)] = row.square(g);
  }
  const double least = strength * strength * strength * strength;
  Neighbours out;
  for (Index g = 0; g < groups; ++g) {
    if (left_out[as_size(g)] == 0)
      for (const Index h : row.visit(g)) {
        const double square = row.square(h);
        if (h != g && left_out[as_size(h)] == 0 &&
            square * square > least * own[as_size(g)] * own[as_size(h)])
          out.group.push_back(h);
      }
    out.start.push_back(static_cast<Index>(out.group.size()));
  }
  return out;
}

}  // namespace

Aggregates aggregate(const CompressedRows& a, const GroupStarts& start,
                     std::span<const char> left_out, double strength) {
  const Neighbours near = neighbours(a, start, left_out, strength);
  const auto groups = static_cast<Index>(start.size() - 1);
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
