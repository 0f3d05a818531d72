#pragma once
#include <array>
#include <span>
#include <vector>

#include "osculate/core/types.hpp"
#include "osculate/search/box.hpp"

namespace osculate::projection {

/// Highest degree of a piece in each direction.
inline constexpr int max_piece_degree = 7;

/// The directions of a set of vectors: all within `angle` (radians) of the axis; pi = anything.
template <int Dim>
struct Cone {
  Vec<Dim> axis = Vec<Dim>::UnitX();
  double angle = 4;
  [[nodiscard]] bool narrow() const { return angle < 1.5; }
};

/// A part of a facet or of a knot span as a rational Bezier patch over the unit square (a curve in
/// the plane: over the unit interval, t unused). Homogeneous control points (w r, w); (i, j) stands
/// at first + i (degree[1] + 1) + j. Its surface lies in the convex hull of the points.
template <int Dim>
struct Piece {
  Index cell = -1;                      ///< the facet or knot span it is a part of
  Index first = 0;                      ///< its first control point
  std::array<std::int8_t, 2> degree{};  /// s, t
  bool rational = false;
  bool bent = false;      ///< its normals are not within a narrow cone
  bool triangle = false;  ///< a plane triangle: three control points, xi its own coordinates
  /// Number of the cell's edge (in the plane: corner) that the side s = 0, s = 1, t = 0, t = 1 is
  /// a part of; -1 where the surface goes on smoothly.
  std::array<std::int8_t, 4> side{-1, -1, -1, -1};
  std::array<Vec2, 4> xi{};  ///< cell coordinates at (0, 0), (1, 0), (0, 1), (1, 1)

  [[nodiscard]] std::size_t points() const {
    return triangle ? 3 : static_cast<std::size_t>((degree[0] + 1) * (degree[1] + 1));
  }
  /// Cell coordinates of (s, t): bilinear, exact on the sides.
  [[nodiscard]] Vec2 cell_xi(const Vec2& st) const {
    return (1 - st[1]) * ((1 - st[0]) * xi[0] + st[0] * xi[1]) +
           st[1] * ((1 - st[0]) * xi[2] + st[0] * xi[3]);
  }
};

template <int Dim>
using ControlPoint = Vec<Dim + 1>;

template <int Dim>
using Control = std::span<const ControlPoint<Dim>>;

template <int Dim>
[[nodiscard]] Control<Dim> control_of(const Piece<Dim>& piece,
                                      const std::vector<ControlPoint<Dim>>& all) {
  return {all.data() + piece.first, piece.points()};
}

/// Position and derivatives with respect to (s, t).
template <int Dim>
struct PieceJet {
  Vec<Dim> r = Vec<Dim>::Zero();
  std::array<Vec<Dim>, 2> r1{Vec<Dim>::Zero(), Vec<Dim>::Zero()};
  std::array<Vec<Dim>, 3> r2{Vec<Dim>::Zero(), Vec<Dim>::Zero(), Vec<Dim>::Zero()};
};

/// Requires   a piece that is not a `triangle`
template <int Dim>
[[nodiscard]] PieceJet<Dim> jet(const Piece<Dim>& piece, Control<Dim> control, const Vec2& st);

/// Box round the control points.
template <int Dim>
[[nodiscard]] search::Box<Dim> box_of(const Piece<Dim>& piece, Control<Dim> control);

/// Cone of all normals: tangent cones of the control net, combined as by Sederberg and Meyers
/// (Comput. Aided Geom. Design 5, 1988).
template <int Dim>
[[nodiscard]] Cone<Dim> normal_cone(const Piece<Dim>& piece, Control<Dim> control);

/// Cone of the directions from a side into the piece.
template <int Dim>
[[nodiscard]] Cone<Dim> inward_cone(const Piece<Dim>& piece, Control<Dim> control,
                                    std::size_t side);

/// Control points of a side, as a curve. Not of a `triangle`.
template <int Dim>
[[nodiscard]] std::vector<ControlPoint<Dim>> side_control(const Piece<Dim>& piece,
                                                          Control<Dim> control, std::size_t side);

/// Cone of the directions along a side (in the plane: of the curve).
template <int Dim>
[[nodiscard]] Cone<Dim> along_cone(const Piece<Dim>& piece, Control<Dim> control, std::size_t side);

/// Both halves of a piece that is not a `triangle`, across the direction 0 (s) or 1 (t).
template <int Dim>
void cut(const Piece<Dim>& piece, const std::vector<ControlPoint<Dim>>& control, int direction,
         std::array<Piece<Dim>, 2>& halves, std::array<std::vector<ControlPoint<Dim>>, 2>& points);
/// The direction in which it is longer.
template <int Dim>
[[nodiscard]] int longer_direction(const Piece<Dim>& piece, Control<Dim> control);

/// The smallest cone round both.
template <int Dim>
[[nodiscard]] Cone<Dim> join(const Cone<Dim>& a, const Cone<Dim>& b);

/// Pieces with their control points.
template <int Dim>
struct PieceSet {
  std::vector<Piece<Dim>> pieces;
  std::vector<ControlPoint<Dim>> control;
};

/// Adds the piece, cut in halves until its normals stay within a narrow cone (or it cannot be made
/// narrow by `max_cuts` cuts each way).
template <int Dim>
void add_pieces(const Piece<Dim>& piece, std::vector<ControlPoint<Dim>> control,
                PieceSet<Dim>& set);

}  // namespace osculate::projection
