#include "osculate/mesh/compactness.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/mesh/node_areas.hpp"
#include "osculate/mesh/support.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::mesh {
namespace {

double compactness(const Mesh& mesh, std::vector<CellRef> cells) {
  const FaceTable table = face_table(mesh, cells);
  const Vec3 origin = point(mesh, *nodes_of(mesh, cells.front()));
  const Surface surface = surface_facets(mesh, table, {"", 3, std::move(cells), {}});
  double area = 0, volume = 0;
  for (const SurfaceFacet& facet : surface.facets) {
    const std::span<const Index> corners = facet.corners();
    const auto at = [&](std::size_t k) -> Vec3 { return point(mesh, corners[k]) - origin; };
    area += polygon_area(mesh, corners);
    for (std::size_t k = 2; k < corners.size(); ++k)
      volume += at(0).dot(at(k - 1).cross(at(k))) / 6;
  }
  return area > 0 ? std::abs(volume) / (area * std::sqrt(area)) : 0;
}

}  // namespace

double least_compactness(const Mesh& mesh, std::span<const CellRef> cells) {
  double least = 1;
  for (std::vector<CellRef>& body : connected_parts(mesh, cells, Link::side))
    if (info_of(mesh, body.front()).dimension == 3)
      least = std::min(least, compactness(mesh, std::move(body)));
  return least;
}

}  // namespace osculate::mesh
