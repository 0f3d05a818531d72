#pragma once
// Shared by the sources of this layer; not for users.
#include <optional>
#include <type_traits>
#include <vector>

#include "osculate/deck/body_description.hpp"
#include "osculate/geometry/catalogue.hpp"
#include "osculate/geometry/surface_catalogue.hpp"

namespace osculate::deck {

/// A shape in closed form or NURBS with its centre.
template <int Dim>
struct Analytic {
  std::conditional_t<Dim == 2, geometry::Curve, geometry::Surface> shape;
  Vec<Dim> center;
};

/// The curve (in the plane) or surface (in space) that a shape of the model file stands for; with
/// `flip` the body is on its other side. Nothing for meshed sets, polylines and shapes of the other
/// dimension. Not yet validated: ask geometry::validate().
template <int Dim>
[[nodiscard]] std::optional<Analytic<Dim>> analytic_shape(const RigidShape& shape, bool flip);
template <>
[[nodiscard]] std::optional<Analytic<2>> analytic_shape(const RigidShape& shape, bool flip);
template <>
[[nodiscard]] std::optional<Analytic<3>> analytic_shape(const RigidShape& shape, bool flip);

/// The curves of a composite in order of travel; with `flip` the body is on the other side.
[[nodiscard]] std::vector<geometry::Curve> composite_curves(const CompositeShape& shape, bool flip);

}  // namespace osculate::deck
