#pragma once
// The linear pieces that facets of a mortar pair are integrated in; for sources of this layer.
#include <array>
#include <span>

#include "osculate/cell/shape.hpp"

namespace osculate::pairing::mortar_pieces {

/// Corners of a triangle (the last one is -1) or quadrilateral by local nodes.
using Piece = std::array<int, 4>;

[[nodiscard]] inline std::span<const Piece> pieces_of(cell::CellType type) {
  static constexpr std::array<Piece, 1> tri3{{{0, 1, 2, -1}}}, quad4{{{0, 1, 2, 3}}};
  static constexpr std::array<Piece, 4> tri6{
      {{0, 3, 5, -1}, {3, 1, 4, -1}, {5, 4, 2, -1}, {3, 4, 5, -1}}};
  static constexpr std::array<Piece, 5> quad8{
      {{0, 4, 7, -1}, {1, 5, 4, -1}, {2, 6, 5, -1}, {3, 7, 6, -1}, {4, 5, 6, 7}}};
  static constexpr std::array<Piece, 4> quad9{
      {{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}}};
  switch (type) {
    case cell::CellType::tri3:
      return tri3;
    case cell::CellType::tri6:
      return tri6;
    case cell::CellType::quad8:
      return quad8;
    case cell::CellType::quad9:
      return quad9;
    default:
      return quad4;
  }
}

[[nodiscard]] inline std::size_t corners_of(const Piece& piece) { return piece[3] < 0 ? 3 : 4; }

/// Middle of a piece in the facet's coordinates: where the search for a place starts.
[[nodiscard]] inline Vec2 middle_of(cell::CellType type, const Piece& piece) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t k = 0; k < corners_of(piece); ++k) sum += cell::area_node(type, piece[k]);
  return sum / static_cast<double>(corners_of(piece));
}

}  // namespace osculate::pairing::mortar_pieces
