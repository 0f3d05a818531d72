#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "osculate/search/box.hpp"

namespace osculate::search {

/// The nearest object of a query; index -1 if there is none within the bound.
struct Nearest {
  Index index = -1;
  double squared_distance = std::numeric_limits<double>::infinity();
};

/// Bounding volume hierarchy: boxes in, candidate indices out. Built once by median splits,
/// refitted between iterations. Queries do not allocate, may run on several threads at once, and
/// visit in an order that depends on the boxes alone. Unbounded boxes (at the time of building)
/// stand beside the tree and are visited first, so that they do not blunt it.
///
/// Requires   boxes without NaN; empty boxes are never found
/// Tested by  tests/unit/search/test_bvh.cpp (against brute force)
template <int Dim>
class Bvh {
 public:
  Bvh() = default;
  explicit Bvh(std::span<const Box<Dim>> boxes) {
    order_.resize(boxes.size());
    std::iota(order_.begin(), order_.end(), 0);
    const auto bounded = [&](Index k) { return boxes[at(k)].bounded() || boxes[at(k)].empty(); };
    const auto first =
        std::stable_partition(order_.begin(), order_.end(), [&](Index k) { return !bounded(k); });
    unbounded_ = static_cast<Index>(first - order_.begin());
    if (first != order_.end()) build(boxes, unbounded_, static_cast<Index>(order_.size()));
    refit(boxes);
  }
  [[nodiscard]] std::size_t size() const { return order_.size(); }
  [[nodiscard]] std::size_t node_count() const { return nodes_.size(); }
  [[nodiscard]] const Box<Dim>& node_box(Index i) const { return nodes_[at(i)].box; }

  /// From the leaves to the root: leaf(i, objects) for every leaf i, inner(i, left, right) for
  /// every other node; a caller's own data of the nodes (cones, flags) are filled so.
  template <class Leaf, class Inner>
  void fold(const Leaf& leaf, const Inner& inner) const {
    for (std::size_t i = nodes_.size(); i-- > 0;) {
      const Node& node = nodes_[i];
      const auto self = static_cast<Index>(i);
      if (node.right < 0)
        leaf(self, std::span(order_).subspan(at(node.begin), at(node.end - node.begin)));
      else
        inner(self, self + 1, node.right);
    }
  }

  /// Offers every object whose box lies within `reach` (a squared distance that may shrink on the
  /// way) and whose nodes are all `wanted(i)`; nearer children first.
  template <class Wanted, class Offer>
  void for_each_wanted(const Vec<Dim>& point, const double& reach, const Wanted& wanted,
                       const Offer& offer) const {
    descend(point, reach, wanted, offer);
  }

  /// New boxes of the same objects; the tree keeps its shape (another number of boxes builds anew).
  void refit(std::span<const Box<Dim>> boxes) {
    if (boxes.size() != order_.size()) {
      *this = Bvh(boxes);
      return;
    }
    boxes_.resize(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) boxes_[k] = boxes[at(order_[k])];
    for (std::size_t i = nodes_.size(); i-- > 0;) {
      Node& node = nodes_[i];
      node.box = {};
      if (node.right < 0) {
        for (Index k = node.begin; k < node.end; ++k) node.box.extend(boxes_[at(k)]);
      } else {
        node.box.extend(nodes_[i + 1].box);
        node.box.extend(nodes_[at(node.right)].box);
      }
    }
  }

  /// visit(index) for every object whose box overlaps the given one.
  template <class Visit>
  void for_each_overlap(const Box<Dim>& box, const Visit& visit) const {
    const auto wanted = [&](const Box<Dim>& other) { return other.overlaps(box); };
    for_each_where(wanted, visit);
  }

  /// visit(index) for every object whose box comes within `radius` of the point.
  template <class Visit>
  void for_each_within(const Vec<Dim>& point, double radius, const Visit& visit) const {
    const auto wanted = [&](const Box<Dim>& other) {
      return !other.empty() && other.squared_distance(point) <= radius * radius;
    };
    for_each_where(wanted, visit);
  }

  /// Visits every object whose box may hold a point nearer than the bound. `visit(index)` returns
  /// the object's distance from the point; objects up to `tie` beyond the best are visited too, so
  /// that the caller sees all that are equally near. Nothing farther than `bound` is visited.
  template <class Visit>
  void for_each_nearest(const Vec<Dim>& point, double tie, const Visit& visit,
                        double bound = std::numeric_limits<double>::infinity()) const {
    for_each_nearest_wanted(
        point, tie, [](Index) { return true; }, visit, bound);
  }

  /// The same without the branches that are not `wanted(i)`.
  template <class Wanted, class Visit>
  void for_each_nearest_wanted(const Vec<Dim>& point, double tie, const Wanted& wanted,
                               const Visit& visit, double bound) const {
    double best = std::numeric_limits<double>::infinity();
    double reach = bound * bound;
    const auto offer = [&](Index index) {
      best = std::min({best, visit(index), bound});
      constexpr double rounding = 1 + 4 * std::numeric_limits<double>::epsilon();
      reach = (best + tie) * (best + tie) * rounding;  // a little more than the square
    };
    descend(point, reach, wanted, offer);
  }

  /// The object of the smallest `squared_distance(index)` within the bound (which counts as
  /// inside); the lowest index among those that are exactly equal, whatever the shape of the tree.
  template <class SquaredDistance>
  [[nodiscard]] Nearest nearest(const Vec<Dim>& point, const SquaredDistance& squared_distance,
                                double bound = std::numeric_limits<double>::infinity()) const {
    Nearest found;
    double reach = bound;
    const auto offer = [&](Index index) {
      const double d = squared_distance(index);
      const bool tie = d == found.squared_distance && index < found.index;
      if (d > bound || !(d < found.squared_distance || tie)) return;
      found = {index, d};
      constexpr double rounding = 1 + 1e-12;  // of the caller's distance against the box's
      reach = std::min(bound, d * rounding);
    };
    descend(
        point, reach, [](Index) { return true; }, offer);
    return found;
  }

 private:
  struct Node {
    Box<Dim> box;
    Index begin = 0, end = 0;
    Index right = -1;  ///< second child; the first one follows its parent; -1 = leaf
  };
  static constexpr std::size_t stack_size = 64;  // median splits: depth <= log2(n) + 1 <= 32

  static constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  static double center(const Box<Dim>& box, int axis) {
    const double middle = 0.5 * box.lo[axis] + 0.5 * box.hi[axis];
    return std::isfinite(middle) ? middle : 0.0;
  }

  void build(std::span<const Box<Dim>> boxes, Index begin, Index end) {
    constexpr Index leaf = 4;
    const std::size_t self = nodes_.size();
    nodes_.push_back({{}, begin, end, -1});
    if (end - begin <= leaf) return;
    Box<Dim> centers;
    for (Index k = begin; k < end; ++k) {
      Vec<Dim> c;
      for (int i = 0; i < Dim; ++i) c[i] = center(boxes[at(order_[at(k)])], i);
      centers.extend(c);
    }
    int axis = 0;
    (centers.hi - centers.lo).maxCoeff(&axis);
    const Index middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](Index a, Index b) {
                       const double ca = center(boxes[at(a)], axis);
                       const double cb = center(boxes[at(b)], axis);
                       return ca != cb ? ca < cb : a < b;
                     });
    build(boxes, begin, middle);
    nodes_[self].right = static_cast<Index>(nodes_.size());
    build(boxes, middle, end);
  }

  /// In the order of the tree.
  template <class Wanted, class Visit>
  void for_each_where(const Wanted& wanted, const Visit& visit) const {
    for (Index k = 0; k < unbounded_; ++k)
      if (wanted(boxes_[at(k)])) visit(order_[at(k)]);
    if (nodes_.empty()) return;
    std::array<Index, stack_size> stack{};
    std::size_t top = 1;  // the root
    while (top > 0) {
      const Index i = stack[--top];
      const Node& node = nodes_[at(i)];
      if (!wanted(node.box)) continue;
      if (node.right >= 0) {
        stack[top++] = node.right;
        stack[top++] = i + 1;
        continue;
      }
      for (Index k = node.begin; k < node.end; ++k)
        if (wanted(boxes_[at(k)])) visit(order_[at(k)]);
    }
  }

  /// Offers every object whose box lies within `reach`, which may shrink on the way; nearer
  /// children first.
  template <class Wanted, class Offer>
  void descend(const Vec<Dim>& point, const double& reach, const Wanted& wanted,
               const Offer& offer) const {
    const auto beyond_search = [&](const Box<Dim>& box) {
      return box.empty() || box.squared_distance(point) > reach;
    };
    for (Index k = 0; k < unbounded_; ++k)
      if (!beyond_search(boxes_[at(k)])) offer(order_[at(k)]);
    if (nodes_.empty()) return;
    struct Branch {
      Index node;
      double squared_distance;
    };
    const auto branch = [&](Index i) {
      const Box<Dim>& box = nodes_[at(i)].box;
      return Branch{
          i, box.empty() ? std::numeric_limits<double>::infinity() : box.squared_distance(point)};
    };
    std::array<Branch, stack_size> stack;
    std::size_t top = 0;
    stack[top++] = branch(0);
    while (top > 0) {
      const auto [i, squared_distance] = stack[--top];
      const Node& node = nodes_[at(i)];
      if (squared_distance > reach || node.box.empty() || !wanted(i)) continue;
      if (node.right >= 0) {
        const Branch left = branch(i + 1), right = branch(node.right);
        const bool left_first = left.squared_distance <= right.squared_distance;
        stack[top++] = left_first ? right : left;
        stack[top++] = left_first ? left : right;
        continue;
      }
      for (Index k = node.begin; k < node.end; ++k)
        if (!beyond_search(boxes_[at(k)])) offer(order_[at(k)]);
    }
  }

  std::vector<Node> nodes_;
  std::vector<Index> order_;     ///< the unbounded ones first, then the leaves from left to right
  std::vector<Box<Dim>> boxes_;  ///< in that order
  Index unbounded_ = 0;
};

}  // namespace osculate::search
