#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "osculate/core/error.hpp"
#include "osculate/mesh/mesh.hpp"

namespace osculate::mesh {

/// A structured box of volume cells.
struct SolidBoxSpec {
  std::string name;
  std::array<std::vector<double>, 3> breaks;  ///< at least two each, increasing: x, y, z
  std::array<std::vector<int>, 3> elements;   ///< per interval
  std::array<std::vector<double>, 3> bias;    ///< per interval: length of the last element / of the
                                              ///< first; empty = 1
  cell::CellType type = cell::CellType::hex8;
  double angle = 0;     ///< degrees, turns the finished box about the axis through `about`
  Vec3 about{0, 0, 0};  ///< a point of that axis
  Vec3 axis{0, 0, 1};   ///< its direction, of any length
};

/// Adds a box to the mesh: volume set `name`; area sets `name.left/.right` (smallest and largest
/// x),
/// `.front/.back` (y), `.bottom/.top` (z), their normals outwards; line sets of the twelve edges,
/// `name.bottom_front` and so on (bottom or top before front or back before left or right), in the
/// direction of growing coordinates; node sets of the eight corners, `name.bottom_front_left` and
/// so on. Wedges stand on bottom and top; their triangles, and tetrahedra, have the diagonals of
/// the rectangles from the smallest to the largest coordinates. Further nodes lie in the middle.
///
/// shell18: the thickness is along z; the four sides around it have quad4 cells on the corners, but
/// all nodes.
///
/// Errors     core::InputError at `mark`; the mesh is then unchanged. Nothing is allocated for more
///            than max_nodes nodes.
/// Tested by  tests/unit/mesh/test_generate_solid.cpp
void append_solid_box(Mesh& mesh, const SolidBoxSpec& spec, const core::SourceMark& mark = {});

/// A ball, or octants of one: a cube of elements in its middle and caps of layers around that.
struct BallSpec {
  std::string name;
  Vec3 center{0, 0, 0};
  double radius = 1;
  int core = 2;    ///< elements along each edge of the inner cube in one octant
  int layers = 2;  ///< elements from the cube to the surface
  double core_bias = 1, layer_bias = 1;  ///< length of the outermost element / of the innermost
  /// Which side of the center in x, y and z: 1, -1, or 0 for both.
  std::array<int, 3> sides{0, 0, 0};
  cell::CellType type = cell::CellType::hex8;  ///< hex8, hex20, hex27
};

/// Adds a ball: volume set `name`; area sets `name.surface` and, on the planes that cut it,
/// `name.plane_x` (x = center), `.plane_y`, `.plane_z`; node sets of one node `name.center`,
/// `.pole_x`, `.pole_y`, `.pole_z` and, where there are both sides, `.pole_minus_x` and so on. All
/// nodes of the surface lie on the sphere.
///
/// Tested by  tests/unit/mesh/test_generate_round.cpp
void append_ball(Mesh& mesh, const BallSpec& spec, const core::SourceMark& mark = {});

/// A disc in quarters: a square of elements in its middle and layers around that; with heights, a
/// cylinder.
struct DiscSpec {
  std::string name;
  Vec3 center{0, 0, 0};
  double radius = 1;
  double from = 0;                       ///< degrees, counterclockwise about the axis
  int quarters = 4;                      ///< 1 to 4
  int core = 2;                          ///< elements along half an edge of the inner square
  int layers = 2;                        ///< elements from the square to the rim
  double core_bias = 1, layer_bias = 1;  ///< length of the outermost element / of the innermost
  std::vector<double> heights;  ///< breakpoints along the axis, from the center; empty: a disc
  std::vector<int> elements;    ///< along the axis, per interval
  std::vector<double> bias;     ///< per interval: length of the last element / of the first
  int along = 2;  ///< coordinate axis of the cylinder (0 x, 1 y, 2 z); the angle counts from the
                  ///< next one (of z: x)
  /// tri3, tri6, quad4, quad8, quad9; of a cylinder wedge6, wedge15, hex8, hex20, hex27, shell18.
  cell::CellType type = cell::CellType::quad4;
};

/// Adds a disc: area set `name`; line sets `name.outer` and, of a part, `.from` and `.to` (the
/// radii at its first and last angle), directed with the body on the right; node sets of one node
/// `name.center` and, on the rim, `.pole_0`, `.pole_90` and so on (degrees from `from`). Or a
/// cylinder: volume set `name`; area sets `.outer`, `.bottom`, `.top` (along the axis), `.from`,
/// `.to`; line sets `.axis` and `.pole_0` and so on, upwards. All nodes of the rim lie on the
/// circle.
///
/// Tested by  tests/unit/mesh/test_generate_round.cpp
void append_disc(Mesh& mesh, const DiscSpec& spec, const core::SourceMark& mark = {});

/// A flat parallelogram of area cells.
struct GridSpec {
  std::string name;
  Vec3 origin{0, 0, 0};
  Vec3 u{1, 0, 0}, v{0, 1, 0};  ///< its sides; the normal is u x v
  std::array<int, 2> elements{1, 1};
  cell::CellType type = cell::CellType::quad4;
};

/// Adds a flat patch: area set `name`; line sets `name.left` (origin + v), `.right`, `.bottom`
/// (origin + u), `.top` along growing u or v; node sets of one node `name.bottom_left`,
/// `.bottom_right`, `.top_right`, `.top_left`.
///
/// Tested by  tests/unit/mesh/test_generate_surface.cpp
void append_grid(Mesh& mesh, const GridSpec& spec, const core::SourceMark& mark = {});

/// The surface of a cylinder, all round or a part of it.
struct TubeSpec {
  std::string name;
  Vec3 start{0, 0, 0}, end{0, 0, 1};  ///< ends of the axis
  double radius = 1;
  /// Direction of the angle zero (its part across the axis); absent: z, or x if the axis is nearer
  /// to z than 45 degrees.
  std::optional<Vec3> zero;
  double from = 0, to = 360;          ///< degrees round the axis (right-handed from start to end)
  std::array<int, 2> elements{8, 1};  ///< around and along
  cell::CellType type = cell::CellType::quad4;
  bool inside = false;  ///< the body is around the tube: the normal points to the axis
};

/// Adds a tube: area set `name`; line sets `name.start`, `name.end` (the rings at the ends) and, if
/// it is not closed, `name.from`, `name.to` (the sides along the axis). All nodes lie on the
/// cylinder; the first one on each ring is exactly at `from`.
///
/// Tested by  tests/unit/mesh/test_generate_surface.cpp
void append_tube(Mesh& mesh, const TubeSpec& spec, const core::SourceMark& mark = {});

/// The surface of a ball: the surface of a cube of cells, blown up.
struct SphereSpec {
  std::string name;
  Vec3 center{0, 0, 0};
  double radius = 1;
  int elements = 4;  ///< along each edge of the cube; 6 n^2 in all
  cell::CellType type = cell::CellType::quad4;
  bool inside = false;  ///< the body is around the sphere: the normal points to the center
};

/// Adds a sphere: area set `name`. All nodes lie on it, equally spaced in angle along the middle
/// lines of the cube's sides; the six points on the axes are nodes if the number of elements is
/// even or the cells are quad9.
///
/// Tested by  tests/unit/mesh/test_generate_surface.cpp
void append_sphere(Mesh& mesh, const SphereSpec& spec, const core::SourceMark& mark = {});

}  // namespace osculate::mesh
