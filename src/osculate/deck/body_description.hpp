#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "osculate/core/types.hpp"
#include "osculate/deck/marked.hpp"
#include "osculate/geometry/catalogue.hpp"
#include "osculate/geometry/nurbs_patch.hpp"
#include "osculate/geometry/surfaces.hpp"
#include "osculate/material/expansion.hpp"
#include "osculate/material/law.hpp"
#include "osculate/material/orientation.hpp"

// The keys `materials`, `sections` and `rigid` of a model file; a part of Description.
namespace osculate::deck {

struct Material {
  Name name;
  Marked<material::Law> law;
  material::Expansion expansion{};
  std::vector<std::pair<std::string_view, core::SourceMark>> marks;  ///< of its parameters

  /// Where a parameter stands; the law, where it has no such parameter.
  [[nodiscard]] const core::SourceMark& mark(std::string_view parameter) const;
};

enum class SectionElement { plane_strain, plane_stress, axisymmetric, solid, solid_shell };
/// True for bodies in space.
[[nodiscard]] constexpr bool is_space(SectionElement e) { return e >= SectionElement::solid; }
enum class Kinematics { small, finite };
enum class Formulation { automatic, full, bbar, enhanced, reduced, beam };

struct Section {
  Name on;
  Name material;
  Marked<SectionElement> element;
  Number thickness;
  Marked<Kinematics> kinematics;  ///< the material's default is already applied
  Marked<Formulation> formulation;
  Marked<material::Orientation> orientation{};  ///< of the axes of its material
};

struct SetShape {
  Name set;
};
struct CircleShape {
  Vec2 center{0, 0};
  Number radius;
  bool inside = false;  ///< the body is outside the circle (a hole)
};
struct ArcShape {
  Vec2 center{0, 0};
  Number radius;
  Number from, to;  ///< degrees, from < to <= from + 360
  bool inside = false;
};
struct PolylineShape {
  Marked<std::vector<Vec2>> points;  ///< consecutive ones differ
  bool closed = false;
};
/// The half plane behind `point`; `normal` (unit) points out of the body.
struct HalfPlaneShape {
  Vec2 point{0, 0};
  Vec2 normal{0, 1};
};
struct NurbsShape {
  Marked<int> degree;
  Marked<std::vector<double>> knots;  ///< non-decreasing, control.size() + degree + 1 of them
  Marked<std::vector<Vec3>> control;  ///< x, y, weight; not pre-multiplied
};
/// Curves of which each begins where the one before ends.
struct CompositeShape {
  std::vector<geometry::Curve> parts;
  bool closed = false;  ///< the first begins where the last ends
};
/// The last ones, those of the geometry, are shapes in space.
using RigidShape =
    std::variant<SetShape, CircleShape, ArcShape, PolylineShape, HalfPlaneShape, NurbsShape,
                 CompositeShape, geometry::Plane, geometry::Sphere, geometry::Cylinder,
                 geometry::Cone, geometry::Torus, geometry::NurbsPatch>;

struct Rigid {
  Name name;
  RigidShape shape;
  std::string kind;  ///< key of the shape
  /// Two coordinates in the plane, three in space; absent: centroid of the set, centre of the
  /// shape.
  std::optional<Marked<std::vector<double>>> reference;
  /// Sets of one node each that stand for its translations and rotations in the files of CalculiX.
  std::vector<Name> reference_node{}, rotation_node{};
  std::optional<bool> flip;  ///< the body is on the other side; absent: where it belongs
  std::optional<Marked<Kinematics>> kinematics;  ///< of its rotation; absent: finite
  std::optional<Number> mass;
  std::optional<Number> density;  ///< instead of the mass; in the plane mass per area
  std::optional<Marked<std::vector<double>>> inertia;  ///< 1, 3 or 6 numbers
  [[nodiscard]] bool meshed() const { return std::holds_alternative<SetShape>(shape); }
};

}  // namespace osculate::deck
