#pragma once
#include <array>
#include <vector>

#include "osculate/projection/target.hpp"

namespace osculate::verification {

/// Closest points without any cleverness: samples of every facet, and from every one that is
/// nearer than its neighbours (and not too far to matter) Newton's method, or a pattern search
/// where that fails. Uses the facets' shape functions and nothing else of the projection.
template <int Dim>
class BruteForce {
 public:
  struct Minimum {
    double distance = 0;
    std::size_t chart = 0;
    Vec2 st{0, 0};  ///< on the chart
    Vec<Dim> point = Vec<Dim>::Zero();
    int facet = -1;
    double from_border = 0;  ///< of the facet, in its own coordinates (0: on it)
    int on_sides = 0;        ///< of the facet: 0 inside, 1 on an edge (end in the plane), 2 corner
    bool pulled = false;     ///< well beyond each of them
    bool inner = false;      ///< pulled beyond a side where the facet goes on: no minimum
  };

  BruteForce(const projection::Target<Dim>& target, int grid);

  /// Local minima over single facets up to `beyond` farther than the nearest, nearest first.
  [[nodiscard]] std::vector<Minimum> minima(const Vec<Dim>& point, double beyond) const;
  /// No place close to `place` (a point of the target) is nearer to `point` than that.
  [[nodiscard]] bool holds(const Vec<Dim>& point, const Vec<Dim>& place) const;
  [[nodiscard]] Vec<Dim> lo() const { return lo_; }
  [[nodiscard]] Vec<Dim> hi() const { return hi_; }

 private:
  /// Position and derivatives at a place of the unit square.
  struct Jet {
    Vec<Dim> r, r1, r2, r11, r12, r22;
  };
  struct Chart {
    int facet = 0;
    projection::Shape<Dim> shape;
    std::array<Vec2, 4> corner;  ///< its coordinates at (0, 0), (1, 0), (0, 1), (1, 1)
    std::array<bool, 4> border;  ///< s = 0, s = 1, t = 0, t = 1: a side of the facet
    std::vector<Vec<Dim>> samples;
    double spacing = 0;  ///< largest distance of neighbouring samples
  };
  struct Descent;
  [[nodiscard]] Jet jet(const Chart& chart, const Vec2& st) const;
  void add(Chart chart);
  void add_facets(const projection::FacetMesh<Dim>& mesh);
  [[nodiscard]] Minimum refine(std::size_t number, const Vec2& st, const Vec<Dim>& point) const;

  int grid_;
  std::vector<Chart> charts_;
  Vec<Dim> lo_ = Vec<Dim>::Constant(1e300), hi_ = Vec<Dim>::Constant(-1e300);
};

}  // namespace osculate::verification
