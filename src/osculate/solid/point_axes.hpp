#pragma once
#include "osculate/solid/element.hpp"

namespace osculate::solid {

/// The axes of the material at the points of a cell, where its law depends on them: those of the
/// undeformed body at the place of the point.
///
/// Tested by  tests/unit/solid/test_orientation.cpp
template <int Dim>
class PointAxes {
 public:
  PointAxes(const Section<Dim>& section, cell::CellType type, const Coordinates<Dim>& reference);
  /// The memory of the points, with their axes; as it is, where the law needs none. It points into
  /// this object.
  [[nodiscard]] material::Memory in(material::Memory memory) const {
    if (any_) memory.axes = values_.data();
    return memory;
  }

 private:
  bool any_;
  std::array<double, 9 * static_cast<std::size_t>(max_points<Dim>)> values_;
};

/// Stiffness of the undeformed material at the points of a cell, in the global axes: in the plane
/// with all four components.
template <int Dim>
[[nodiscard]] std::vector<Mat<components<Dim>, components<Dim>>> unloaded_stiffness(
    const Section<Dim>& section, cell::CellType type, const Coordinates<Dim>& reference);

}  // namespace osculate::solid
