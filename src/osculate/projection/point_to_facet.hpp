#pragma once
#include <span>
#include "osculate/cell/facet_shape.hpp"
#include "osculate/cell/shape.hpp"
#include "osculate/projection/feature.hpp"
namespace osculate::projection { struct FacetFoot{bool converged=false; Vec2 xi{0,0}; double squared_distance=0; Feature feature=Feature::none; int local=-1;};
FacetFoot closest_point(cell::CellType, std::span<const Vec3>, const Vec3&);
FacetFoot closest_point_on_edge(cell::CellType, std::span<const Vec3>, int, const Vec3&);
bool release(cell::CellType, std::span<const Vec3>, const Vec3&, double, FacetFoot&); }
