#pragma once
#include <limits>
#include <vector>

#include "osculate/projection/cells.hpp"
#include "osculate/projection/projector.hpp"

namespace osculate::projection {

/// A smooth piece of a composed curve or surface: a facet, a knot span, a chart. In the plane only
/// the first parameter counts. Infinite shapes are cut to a piece of about their own size.
struct SmoothPiece {
  Vec2 lo{-1, 0}, hi{1, 0};
  bool triangle = false;  ///< 0 <= xi, xi1 + xi2 <= 1
};

/// What one place of it looks like.
template <int Dim>
struct SurfacePlace {
  Vec<Dim> r = Vec<Dim>::Zero(), n = Vec<Dim>::Zero();
  std::array<double, 2> k{0, 0};  ///< larger and smaller curvature; in the plane twice the same
  double sine = 0;                ///< of the angle between the coordinate lines
  bool valid = false;             ///< false where there is no normal
};

/// Where two pieces meet, or a border (piece[1] = -1). In the plane side 0 is the beginning of a
/// piece and 1 its end; piece[0] arrives and piece[1] leaves. In space side k runs from corner k to
/// corner k + 1, the piece on its left.
struct Joint {
  std::array<int, 2> piece{-1, -1}, side{0, 0};
  bool regular = true;  ///< false: more than two pieces, or neighbours of opposite orientation
};

/// One corner of one piece.
struct PieceCorner {
  int piece = 0, corner = 0;
};

template <int Dim>
struct NearestPlace {
  double squared_distance = std::numeric_limits<double>::infinity();
  Vec<Dim> r = Vec<Dim>::Zero();
  int piece = -1;
  Vec2 xi{0, 0};
};

/// A whole curve or surface as its smooth pieces and how they meet: the cells of its projector, or
/// the charts of an analytic shape.
///
/// Requires   facets that share nodes where they meet; a knot line is a joint even where it is
///            smooth
/// Errors     core::InputError naming the facet, node or value that cannot be used
/// Tested by  tests/unit/projection/test_reach.cpp
template <int Dim>
class Composed {
 public:
  using Jet = std::conditional_t<Dim == 2, geometry::CurveJet<2>, geometry::SurfaceJet>;

  explicit Composed(Target<Dim> target);

  [[nodiscard]] const std::vector<SmoothPiece>& pieces() const { return pieces_; }
  [[nodiscard]] Jet jet(int piece, const Vec2& xi) const;
  [[nodiscard]] SurfacePlace<Dim> place(int piece, const Vec2& xi) const;
  [[nodiscard]] const std::vector<Joint>& joints() const { return joints_; }
  /// In space: the pieces round each corner (in the plane the joints are the corners).
  [[nodiscard]] const std::vector<std::vector<PieceCorner>>& corners() const { return corners_; }
  /// Nearest place within the bound, proved as by Projector; piece -1 if there is none.
  [[nodiscard]] NearestPlace<Dim> nearest(
      const Vec<Dim>& point, double squared_bound = std::numeric_limits<double>::infinity()) const;
  [[nodiscard]] double size() const { return size_; }  ///< diagonal of the box round all pieces
  [[nodiscard]] const Target<Dim>& target() const { return projector_.target(); }
  /// Null for analytic shapes.
  [[nodiscard]] const CellComplex<Dim>* cells() const { return projector_.cells(); }

 private:
  void take_cells();
  void join_cells();
  void cut_shape();
  void measure();

  Projector<Dim> projector_;
  std::vector<SmoothPiece> pieces_;
  std::vector<Joint> joints_;
  std::vector<std::vector<PieceCorner>> corners_;
  double size_ = 0;
};

template <>
SurfacePlace<2> Composed<2>::place(int piece, const Vec2& xi) const;
template <>
SurfacePlace<3> Composed<3>::place(int piece, const Vec2& xi) const;

/// Parameters at the part t of a side of a piece in space, and of its corners.
[[nodiscard]] Vec2 piece_corner(const SmoothPiece& piece, int corner);
[[nodiscard]] Vec2 on_side(const SmoothPiece& piece, int side, double t);
[[nodiscard]] inline int corner_count(const SmoothPiece& piece) { return piece.triangle ? 3 : 4; }

}  // namespace osculate::projection
