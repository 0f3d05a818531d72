#pragma once
#include <span>
#include <vector>

#include "osculate/mesh/surface.hpp"

namespace osculate::mesh {

/// Area of a plane polygon.
[[nodiscard]] double polygon_area(const Mesh& mesh, std::span<const Index> corners);

/// By node its share of the free faces that it is a corner of: a quarter of a quadrangle, a third
/// of a triangle; 0 of other nodes.
///
/// Tested by  tests/unit/mesh/test_node_areas.cpp
[[nodiscard]] std::vector<double> free_areas(const Mesh& mesh, const FaceTable& table);

}  // namespace osculate::mesh
