#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "osculate/core/error.hpp"
#include "osculate/mesh/mesh.hpp"

namespace osculate::mesh {

/// Most nodes of a mesh that is generated.
inline constexpr std::int64_t max_nodes = 50'000'000;

/// A side of a box bent to a circular arc.
///
/// Formula    the side moves inwards by sign(r) (|r| - sqrt(r^2 - (x - at)^2)), the opposite side
///            stays, nodes between them move in proportion to their distance from it
/// Sign       radius > 0: convex, the side bulges outwards and x = at protrudes most; < 0: concave
struct Crown {
  enum class Side : std::uint8_t { bottom, top };
  Side side = Side::bottom;
  double radius = 0;
  double at = 0;
};

/// A structured box with straight breakpoint lines.
struct BoxSpec {
  std::string name;
  std::vector<double> x, y;            ///< at least two breakpoints each, increasing
  std::vector<int> nx, ny;             ///< elements per interval
  std::vector<double> bias_x, bias_y;  ///< per interval: length of the last element / of the first;
                                       ///< empty = 1
  cell::CellType type = cell::CellType::quad4;  ///< tri3, tri6, quad4, quad8, quad9
  std::optional<Crown> crown;
  double angle = 0;  ///< degrees, counterclockwise, applied last
  Vec2 about{0, 0};  ///< centre of that rotation
};

/// A line mesh through points; closed if the last point equals the first.
struct LineSpec {
  std::string name;
  std::vector<Vec2> points;
  std::vector<int> elements;                    ///< per interval
  cell::CellType type = cell::CellType::line2;  ///< line2, line3
};

/// Adds a box to the mesh: area set `name`; line sets `name.left/.right/.bottom/.top`, directed
/// with the body on the right (normal k x rho_xi outwards); node sets of one node
/// `name.bottom_left`, `name.bottom_right`, `name.top_right`, `name.top_left`. Without a crown,
/// further nodes of quadratic cells lie in the middle between corners; all nodes of a crown lie on
/// its arc.
///
/// Errors     core::InputError at `mark`; the mesh is then unchanged. Nothing is allocated for more
///            than max_nodes nodes.
/// Tested by  tests/unit/mesh/test_generate.cpp
void append_box(Mesh& mesh, const BoxSpec& spec, const core::SourceMark& mark = {});

/// Adds a line mesh, directed from the first to the last point: line set `name`, node sets
/// `name.start`, `name.end` (the same node if closed).
void append_line(Mesh& mesh, const LineSpec& spec, const core::SourceMark& mark = {});

}  // namespace osculate::mesh
