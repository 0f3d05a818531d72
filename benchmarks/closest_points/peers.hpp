#pragma once
#include <span>
#include <vector>

#include "osculate/geometry/nurbs_patch.hpp"
#include "osculate/projection/target.hpp"

namespace benchmark {

/// What one program answered: distances (NaN: no answer) and the time of all queries [s].
struct Answers {
  std::vector<double> distance;
  double seconds = 0;
  double build_seconds = 0;
};

using osculate::Vec3;

/// OpenCASCADE: Extrema_ExtPS, initialised once, the nearest of its minima.
Answers with_opencascade(const osculate::geometry::NurbsPatch& patch, std::span<const Vec3> points);

/// CGAL: AABB tree of triangles with accelerated distance queries.
Answers with_cgal(const osculate::projection::FacetMesh<3>& mesh, std::span<const Vec3> points);

double now();  ///< processor time [s]

}  // namespace benchmark
