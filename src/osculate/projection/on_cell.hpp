#pragma once
#include "osculate/projection/cells.hpp"
#include "osculate/projection/piece_minima.hpp"

namespace osculate::projection {

/// Where a minimum lies on its cell.
struct OnCell {
  Index cell = -1;
  Vec2 xi{0, 0};
  std::array<bool, 4> pressed{};  ///< by the number of the cell's edge (plane: corner)
  int corner = -1;                ///< pulled beyond this corner
  int edge = -1;                  ///< pulled beyond this edge
  /// The same without being pulled beyond it.
  int touched_corner = -1, touched_edge = -1;
  [[nodiscard]] bool inside() const { return corner < 0 && edge < 0; }
};

template <int Dim>
[[nodiscard]] OnCell locate(const CellComplex<Dim>& all, const Piece<Dim>& piece,
                            const PieceMinimum<Dim>& m);

/// A minimum over its own cell that is one over all cells that share its place.
template <int Dim>
[[nodiscard]] bool minimum_of_all(const CellComplex<Dim>& all, const OnCell& on,
                                  const Vec<Dim>& point, const Vec<Dim>& foot);

/// The same place on the cell that comes first in the order of the input.
template <int Dim>
[[nodiscard]] OnCell first_owner(const CellComplex<Dim>& all, const OnCell& on);

/// Sum of the normals of all cells that share the place; at corners weighted by their angles
/// (Baerentzen and Aanaes, IEEE Trans. Vis. Comput. Graph. 11, 2005): its sign tells inside from
/// outside at the closest point.
template <int Dim>
[[nodiscard]] Vec<Dim> shared_normal(const CellComplex<Dim>& all, const OnCell& on);

/// 1 - zeta k of the feature: positive inside its projection domain.
template <int Dim>
[[nodiscard]] double bend_at(const CellComplex<Dim>& all, const OnCell& on, const Vec<Dim>& gap);

}  // namespace osculate::projection
