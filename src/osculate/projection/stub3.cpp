#include "osculate/projection/point_to_facet.hpp"
#include "osculate/projection/point_to_surface.hpp"
namespace osculate::geometry { SurfaceJet jet(const Surface&, const Vec2&) { return {}; } }
namespace osculate::projection {
FacetFoot closest_point(cell::CellType, std::span<const Vec3>, const Vec3&) { return {}; }
FacetFoot closest_point_on_edge(cell::CellType, std::span<const Vec3>, int, const Vec3&) { return {}; }
bool release(cell::CellType, std::span<const Vec3>, const Vec3&, double, FacetFoot&) { return false; }
SurfaceFoot closest_point(const geometry::Surface&, const Vec3&) { return {}; }
}
