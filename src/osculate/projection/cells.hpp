#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "osculate/projection/piece.hpp"
#include "osculate/projection/target.hpp"

namespace osculate::projection {

/// A facet of a mesh or a knot span of a NURBS curve or patch. Corners run counterclockwise; edge k
/// joins corners k and k + 1 (in the plane a "border" is a corner, in space an edge).
struct Cell {
  Index facet = 0;  ///< number in the answer
  cell::CellType type = cell::CellType::line2;
  std::array<Index, cell::max_facet_nodes> nodes{};
  std::array<Index, 2> span{-1, -1};            ///< of a NURBS curve or patch
  std::array<Index, 4> vertex{-1, -1, -1, -1};  ///< corners that are the same have the same number
  std::array<Index, 4> group{-1, -1, -1, -1};   ///< of the edge: all cells that share it
};

/// Cell `cell` at its corner or edge `local`.
struct CellPart {
  Index cell = -1;
  std::int8_t local = 0;
};

/// Lists of variable length, one after another.
struct PartLists {
  std::vector<CellPart> parts;
  std::vector<Index> start{0};
  [[nodiscard]] std::span<const CellPart> of(Index list) const {
    const auto k = static_cast<std::size_t>(list);
    return {parts.data() + start[k], static_cast<std::size_t>(start[k + 1] - start[k])};
  }
};

template <int Dim>
using Spline = std::conditional_t<Dim == 2, geometry::NurbsCurve, geometry::NurbsPatch>;

/// A composed curve or surface: cells, what they share, and their pieces.
template <int Dim>
struct CellComplex {
  std::vector<Cell> cells;
  std::vector<Vec<Dim>> nodes;
  std::optional<Spline<Dim>> spline;
  PartLists at_vertex;  ///< cells at a vertex, by their corner
  PartLists at_edge;    ///< cells at an edge (space)
  PieceSet<Dim> set;

  [[nodiscard]] const Cell& cell(Index k) const { return cells[static_cast<std::size_t>(k)]; }
};

/// Errors     core::InputError naming the facet and what is wrong with it
template <int Dim>
[[nodiscard]] CellComplex<Dim> make_complex(const FacetMesh<Dim>& mesh);
[[nodiscard]] CellComplex<2> make_complex(const geometry::NurbsCurve& curve);
[[nodiscard]] CellComplex<3> make_complex(const geometry::NurbsPatch& patch);

/// Shapes that are made of pieces; nothing for analytic ones.
[[nodiscard]] std::optional<CellComplex<2>> complex_of(const geometry::Curve& curve);
[[nodiscard]] std::optional<CellComplex<3>> complex_of(const geometry::Surface& surface);

/// The Lagrange curve as a Bezier curve over -1..1, which it is.
[[nodiscard]] geometry::NurbsCurve as_nurbs(const geometry::LagrangeCurve& curve);
/// The same arc, run through in the same direction (by other parameters).
[[nodiscard]] geometry::NurbsCurve as_nurbs(const geometry::Arc& arc);

/// Corners of a cell: 2 in the plane, 3 or 4 in space.
[[nodiscard]] int corner_count(const Cell& cell);
template <int Dim>
[[nodiscard]] Vec2 corner_xi(const CellComplex<Dim>& all, const Cell& cell, int corner);

/// Position and derivatives with respect to the cell's coordinates (up to the second).
template <int Dim>
[[nodiscard]] PieceJet<Dim> cell_jet(const CellComplex<Dim>& all, const Cell& cell, const Vec2& xi);

/// Place of the same point of a shared edge on another cell.
[[nodiscard]] Vec2 across_edge(const CellComplex<3>& all, const CellPart& from, const Vec2& xi,
                               const CellPart& to);

/// The directions along the two edges at a corner, into the cell (in the plane: the one).
template <int Dim>
[[nodiscard]] std::array<Vec<Dim>, 2> corner_directions(const CellComplex<Dim>& all,
                                                        const CellPart& corner);
/// An edge that has shrunk to a point (not one that comes back to where it began).
[[nodiscard]] bool collapsed(const CellComplex<3>& all, const Cell& cell, int edge);
/// Cell coordinates of its middle.
template <int Dim>
[[nodiscard]] Vec2 middle_xi(const CellComplex<Dim>& all, const Cell& cell);
/// Unit normal; zero where there is none.
template <int Dim>
[[nodiscard]] Vec<Dim> cell_normal(const PieceJet<Dim>& jet);

}  // namespace osculate::projection
