#pragma once
// The points of a cell in the plane and in space, for what is said of both at once.
#include "osculate/solid/point_strain.hpp"
#include "osculate/solid/volume_point.hpp"

namespace osculate::solid {

/// Nodal values and square matrices of them; at most how many points there are.
template <class AnyPoints>
struct PointsTraits {
  static constexpr std::size_t most = max_points;
  using Vector = ElementVector;
  using Matrix = ElementMatrix;
};
template <>
struct PointsTraits<HexPoints> {
  static constexpr std::size_t most = 8;
  using Vector = HexSizes::Vector;
  using Matrix = HexSizes::Matrix;
};

[[nodiscard]] inline std::size_t count(const Points& points) { return points.count; }
[[nodiscard]] inline std::size_t count(const HexPoints& points) { return points.size(); }
[[nodiscard]] inline const PointGeometry& geometry_at(const Points& points, std::size_t q) {
  return points.geometry[q];
}
[[nodiscard]] inline const HexPoint& geometry_at(const HexPoints& points, std::size_t q) {
  return points[q];
}
[[nodiscard]] inline const PointStrain& strain_at(const Points& points, std::size_t q) {
  return points.strain[q];
}
[[nodiscard]] inline PointStrain& strain_at(Points& points, std::size_t q) {
  return points.strain[q];
}
[[nodiscard]] inline const HexPoint& strain_at(const HexPoints& points, std::size_t q) {
  return points[q];
}
[[nodiscard]] inline HexPoint& strain_at(HexPoints& points, std::size_t q) { return points[q]; }

[[nodiscard]] inline material::Response3 point_response(const VolumeSection& section,
                                                        const material::Strain3& strain,
                                                        const material::Memory& memory) {
  return material::response(section.law, strain, memory);
}

}  // namespace osculate::solid
