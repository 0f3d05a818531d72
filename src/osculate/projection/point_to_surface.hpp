#pragma once
#include "osculate/geometry/surface_catalogue.hpp"
namespace osculate::projection { struct SurfaceFoot{bool converged=false; Vec2 xi{0,0}; double squared_distance=0; bool at_border=false;};
SurfaceFoot closest_point(const geometry::Surface&, const Vec3&); }
