#pragma once
#include <string_view>

#include "osculate/projection/cells.hpp"

namespace osculate::projection {

/// A linear inequality that the normal directions v (unit vectors) of a feature obey: v . t <= s.
template <int Dim>
struct Barrier {
  Vec<Dim> t = Vec<Dim>::Zero();
  double s = 0;
};

enum class FeatureKind : std::uint8_t {
  face,   ///< with one normal on the side asked for
  edge,   ///< a border, with the quarter of its normal plane; a sharp edge, with its wedge
  point,  ///< a corner or end, with its cone
  rim  ///< a border, corner or end once more, with the outermost directions of its quarter: there
       ///< the normal directions of the side end, without going over into others
};

/// The cell a feature belongs to, and where in it.
template <int Dim>
struct Owner {
  Index cell = -1;
  unsigned edges = 0, corners = 0;  ///< bits of the cell's edges and corners that it reaches
  search::Box<2> range;             ///< of the cell's coordinates
  Cone<Dim> normal;
};

/// A part of a face, border, edge or corner, from which normals leave to one side.
template <int Dim>
struct ReachFeature {
  FeatureKind kind = FeatureKind::face;
  std::vector<Vec<Dim>> hull;  ///< it lies in their convex hull
  search::Box<Dim> box;
  Vec<Dim> center = Vec<Dim>::Zero();
  double radius = 0;
  Cone<Dim> directions;             ///< round all v; without meaning unless narrow
  std::vector<Barrier<Dim>> sees;   ///< of v on the side asked for
  std::vector<Barrier<Dim>> seen;   ///< of v on any side
  std::vector<Vec<Dim>> outermost;  ///< rim: the outermost directions are between these two
  double spread = 0;                ///< rim: and within this angle of them
  std::vector<Owner<Dim>> owners;
  Piece<Dim> piece;  ///< of the first owner; points have none
  std::vector<ControlPoint<Dim>> control;
  std::size_t side = 0;              ///< edge: of the piece
  std::vector<Barrier<Dim>> others;  ///< edge: of the other faces
  std::array<Index, 2> child{-1, -1};
};

/// Why nothing can be proved.
enum class Gap : std::uint8_t {
  none,
  irregular,  ///< facets of opposite orientation, or more than two
  kink,       ///< an edge or corner opens to the other side: the reach is zero
  notch,      ///< a re-entrant corner of the border: the reach is zero there
  pole,       ///< places without a normal
  touch,      ///< parts that the bounds cannot separate: they touch, or nearly
  effort,     ///< the search was given up
  size,       ///< too many parts
  shape       ///< an analytic shape without a formula here
};
[[nodiscard]] std::string_view name(Gap gap);

template <int Dim>
struct ReachFeatures {
  std::vector<ReachFeature<Dim>> list;
  Gap gap = Gap::none;
};

/// All features of one side (+1 above, -1 below) of the surface, joints up to the angle `kink`
/// taken as smooth. Sharp edges are those that open to the side.
template <int Dim>
[[nodiscard]] ReachFeatures<Dim> features_of(const CellComplex<Dim>& all, int side, double kink);

/// The two halves of a feature; false where it cannot be divided. A face is cut across its longer
/// direction, or across the one that is given.
template <int Dim>
[[nodiscard]] bool halve(const CellComplex<Dim>& all, int side, const ReachFeature<Dim>& feature,
                         std::array<ReachFeature<Dim>, 2>& halves, int direction = -1);

/// Both belong to cells that share an edge, a corner or themselves, reach what they share, and
/// their normals lie in one narrow cone: together they are a graph over the plane across its axis,
/// and no line between them is along a normal.
template <int Dim>
[[nodiscard]] bool one_graph(const CellComplex<Dim>& all, const ReachFeature<Dim>& a,
                             const ReachFeature<Dim>& b);
/// They meet, graph or not.
template <int Dim>
[[nodiscard]] bool meet(const CellComplex<Dim>& all, const ReachFeature<Dim>& a,
                        const ReachFeature<Dim>& b);

}  // namespace osculate::projection
