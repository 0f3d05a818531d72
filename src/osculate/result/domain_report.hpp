#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "osculate/core/types.hpp"
#include "osculate/mesh/mesh.hpp"

namespace osculate::result {

/// What a cell of the picture belongs to: the cell array PART.
enum class DomainPart : std::uint8_t {
  surface = 0,
  sheet_above = 1,  ///< centres of curvature, r + n/k, on the side of the normals
  sheet_below = 2,  ///< the same on the other side
  even_above = 3,   ///< the smallest 1/k of the smooth part, everywhere (KSCPP Table 1)
  even_below = 4,
  edge_above = 5,  ///< wedges of edges; in the plane of corners and ends
  edge_below = 6,
  corner_above = 7,  ///< cones of corners
  corner_below = 8
};

/// What the points of the picture know of the place of the surface they belong to; NaN on wedges
/// and cones, and where there is nothing (no normal, no bound).
struct DomainPlace {
  double larger = 0, smaller = 0, gauss = 0, mean = 0;
  double point_class = 0;  ///< 0 singular, 1 planar, 2 parabolic, 3 hyperbolic, 4 elliptic
  double bound_above = 0, bound_below = 0;  ///< 1/k, as lengths
  double even_above = 0, even_below = 0;
  double sine = 0;  ///< of the angle between the coordinate lines
};

struct DomainPicture {
  std::vector<Vec3> points;
  std::vector<DomainPlace> places;
  std::vector<mesh::Block> blocks;             ///< line2; tri3, quad4
  std::vector<std::vector<DomainPart>> parts;  ///< of the cells of each block
  std::vector<std::vector<Index>> pieces;      ///< facet or knot span of each cell, else -1
};

struct DomainLimit {
  double value = 0;   ///< infinite: without end
  std::string limit;  ///< none, curvature, bottleneck, kink
  Vec3 at = Vec3::Zero(), other = Vec3::Zero();
};
struct DomainSide {
  DomainLimit curvature, bottleneck, reach;
  double proved = 0;     ///< the reach is not smaller (projection/reach_bound.hpp)
  std::string unproved;  ///< why that is not within the tolerance; empty if it is
};

/// Sharp joints of one kind.
struct DomainKinks {
  int count = 0;
  double largest = 0;  ///< degrees
  Vec3 at = Vec3::Zero();
};

/// A planar point among others that are not.
struct FlatPlace {
  Vec3 at = Vec3::Zero();
  std::string form;  ///< of the terms of third order
};

struct DomainReport {
  std::string surface;
  int dimension = 3;
  double tolerance = 0.01;  ///< asked for between the proved and the found reach
  double size = 0;
  int pieces = 0, borders = 0, places = 0;
  std::vector<std::pair<std::string, int>> classes;
  DomainSide above, below;
  DomainKinks ridges, valleys;  ///< convex and re-entrant
  std::vector<FlatPlace> flat;
  double smallest_sine = 1;
  std::vector<std::string> warnings;
  DomainPicture picture;
};

[[nodiscard]] std::string to_text(const DomainReport& report);
[[nodiscard]] std::string to_json(const DomainReport& report);
/// ParaView file; docs/domains.md says how to read it. Throws io::WriteError.
void write_domain(const std::string& path, const DomainPicture& picture);
/// The report page with the surface and its fields.
[[nodiscard]] std::string domain_html(const DomainReport& report);

}  // namespace osculate::result
