#pragma once
#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <vector>

#include "osculate/search/box.hpp"

namespace osculate::search {

/// Bounding volume hierarchy: boxes in, candidate indices out. Built once by median splits,
/// refitted between iterations; queries do not allocate and visit in a fixed order.
///
/// Tested by  tests/unit/search/test_bvh.cpp (against brute force)
template <int Dim>
class Bvh {
 public:
  Bvh() = default;
  explicit Bvh(std::span<const Box<Dim>> boxes) {
    order_.resize(boxes.size());
    std::iota(order_.begin(), order_.end(), 0);
    if (!order_.empty()) build(boxes, 0, static_cast<Index>(order_.size()));
    refit(boxes);
  }
  [[nodiscard]] std::size_t size() const { return order_.size(); }

  /// New boxes of the same objects; the tree keeps its shape.
  void refit(std::span<const Box<Dim>> boxes) {
    for (std::size_t i = nodes_.size(); i-- > 0;) {
      Node& node = nodes_[i];
      node.box = {};
      if (node.right < 0) {
        for (Index k = node.begin; k < node.end; ++k)
          node.box.extend(boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]);
      } else {
        node.box.extend(nodes_[i + 1].box);
        node.box.extend(nodes_[static_cast<std::size_t>(node.right)].box);
      }
    }
  }

  /// Visits every object whose box may hold a point nearer than the bound. `visit(index)` returns
  /// the object's distance from the point; objects up to `tie` beyond the best are visited too, so
  /// that the caller sees all that are equally near.
  template <class Visit>
  void for_each_nearest(const Vec<Dim>& point, double tie, const Visit& visit) const {
    if (nodes_.empty()) return;
    double best = std::numeric_limits<double>::infinity();
    std::array<Index, 64> stack{};  // median splits: depth <= log2(n) + 1
    std::size_t top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Index at = stack[--top];
      const Node& node = nodes_[static_cast<std::size_t>(at)];
      if (std::sqrt(node.box.squared_distance(point)) > best + tie) continue;
      if (node.right < 0) {
        for (Index k = node.begin; k < node.end; ++k)
          best = std::min(best, visit(order_[static_cast<std::size_t>(k)]));
        continue;
      }
      const Index left = at + 1;
      const double near_left = nodes_[static_cast<std::size_t>(left)].box.squared_distance(point);
      const double near_right =
          nodes_[static_cast<std::size_t>(node.right)].box.squared_distance(point);
      const bool left_first = near_left <= near_right;
      stack[top++] = left_first ? node.right : left;
      stack[top++] = left_first ? left : node.right;
    }
  }

 private:
  struct Node {
    Box<Dim> box;
    Index begin = 0, end = 0;
    Index right = -1;  ///< second child; the first one follows its parent; -1 = leaf
  };

  static double center(const Box<Dim>& box, int axis) {
    const double middle = 0.5 * (box.lo[axis] + box.hi[axis]);
    return std::isfinite(middle) ? middle : 0.0;
  }

  void build(std::span<const Box<Dim>> boxes, Index begin, Index end) {
    constexpr Index leaf = 4;
    const auto at = static_cast<Index>(nodes_.size());
    nodes_.push_back({{}, begin, end, -1});
    if (end - begin <= leaf) return;
    Box<Dim> centers;
    for (Index k = begin; k < end; ++k) {
      Vec<Dim> c;
      for (int i = 0; i < Dim; ++i)
        c[i] = center(boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])], i);
      centers.extend(c);
    }
    int axis = 0;
    (centers.hi - centers.lo).maxCoeff(&axis);
    const Index middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](Index a, Index b) {
                       const double ca = center(boxes[static_cast<std::size_t>(a)], axis);
                       const double cb = center(boxes[static_cast<std::size_t>(b)], axis);
                       return ca != cb ? ca < cb : a < b;
                     });
    build(boxes, begin, middle);
    nodes_[static_cast<std::size_t>(at)].right = static_cast<Index>(nodes_.size());
    build(boxes, middle, end);
  }

  std::vector<Node> nodes_;
  std::vector<Index> order_;
};

}  // namespace osculate::search
