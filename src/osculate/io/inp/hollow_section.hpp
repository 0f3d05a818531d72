#pragma once
#include <array>
#include <vector>

#include "osculate/io/inp/thin_sections.hpp"

namespace osculate::io::inp {

/// Places in halves of the size along the first and second axis of a beam's section: its corners
/// counterclockwise from the first axis back and the second one forth, then the middles between
/// them.
inline constexpr std::array<std::array<double, 2>, 8> around{
    {{-1, 1}, {-1, -1}, {1, -1}, {1, 1}, {-1, 0}, {0, -1}, {1, 0}, {0, 1}}};

/// The cells of a hollow section, of second order, in the plane of `around`.
struct HollowSection {
  std::vector<Vec2> points;
  std::vector<std::array<std::size_t, 8>> cells;  ///< points: corners, then middles, as in `around`
  std::vector<bool> is_corner;                    ///< of cells, by point
  /// The mean over the section is that of the points with these shares; that of the corners alone.
  std::vector<double> share, corner_share;
  /// What the reference line, in the middle of the outer sizes, moves by: shares as the stress of
  /// a force that acts there is, N / A + M r / I.
  std::vector<double> axis_share, axis_corner_share;
};

/// Pipe: 16 cells round about, whose edges are parabolas. Box: four walls, four corners.
///
/// Input      section: a pipe or a box; thickness: its sizes along both axes
/// Tested by  tests/unit/io/test_inp_hollow.cpp
[[nodiscard]] HollowSection hollow_section(const ThinSection& section);

/// What the eight points `around` count for a place of the section, and the four corners alone:
/// shape functions of quad8 and quad4.
[[nodiscard]] std::array<double, 8> shares_around(const Vec2& place);
[[nodiscard]] std::array<double, 4> shares_of_corners(const Vec2& place);

}  // namespace osculate::io::inp
