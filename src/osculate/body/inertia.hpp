#pragma once
#include <optional>
#include <string>

#include "osculate/body/rigid_body.hpp"
#include "osculate/core/types.hpp"
#include "osculate/geometry/catalogue.hpp"
#include "osculate/geometry/surface_catalogue.hpp"

namespace osculate::body {

/// Inertia of a rigid body in its reference configuration.
///
/// Formula    J = integral of rho (|r|^2 I - r r^T) dV ,  r = X - X_c   (plane: of rho |r|^2, about
/// z) Units      of the model; in the plane the density is a mass per area (density times
/// thickness)
template <int Dim>
struct Inertia {
  using Tensor = Mat<rotations<Dim>, rotations<Dim>>;
  double mass = 0;
  Vec<Dim> center = Vec<Dim>::Zero();  ///< centre of mass X_c
  Tensor tensor = Tensor::Zero();      ///< J
};

/// Integrals of 1, r and r r^T over a body, r = x - origin. Choose the origin near the body.
template <int Dim>
struct VolumeMoments {
  Vec<Dim> origin = Vec<Dim>::Zero();
  double volume = 0;
  Vec<Dim> first = Vec<Dim>::Zero();
  Mat<Dim, Dim> second = Mat<Dim, Dim>::Zero();
};

/// Adds a piece of the body: a quadrature point of a cell, or of a thin wall.
template <int Dim>
void add_volume(VolumeMoments<Dim>& moments, const Vec<Dim>& x, double volume);

/// Adds what lies between the origin and a piece of the closed boundary, `outward` = n dA: a
/// quadrature point of a facet. All normals out of the body, or all into it.
///
/// Formula    integral of f dV = integral of f (r . n) dA / (Dim + k) ,  f homogeneous of degree k
///            (divergence theorem)
/// Tested by  tests/unit/body/test_inertia.cpp
template <int Dim>
void add_boundary(VolumeMoments<Dim>& moments, const Vec<Dim>& x, const Vec<Dim>& outward);

/// A whole flat facet of the boundary, exactly: an edge from a to b in the plane, a triangle in
/// space. All facets run round the body in the same sense.
void add_facet(VolumeMoments<2>& moments, const Vec2& a, const Vec2& b);
void add_facet(VolumeMoments<3>& moments, const Vec3& a, const Vec3& b, const Vec3& c);

/// A curve of the boundary, by quadrature: exact to round-off for arcs and moderate NURBS.
void add_curve(VolumeMoments<2>& moments, const geometry::Curve& curve);

/// Mass, centre and inertia of a homogeneous body; the sense of its boundary does not matter.
/// Without a volume: no mass, at the origin.
template <int Dim>
[[nodiscard]] Inertia<Dim> inertia_of(const VolumeMoments<Dim>& moments, double density);

/// What an analytic shape encloses: circle and closed curves; sphere, torus, cylinder and cone with
/// two ends. Nothing for the others, and for holes (`inside`).
[[nodiscard]] std::optional<VolumeMoments<2>> enclosed(const geometry::Curve& curve);
[[nodiscard]] std::optional<VolumeMoments<3>> enclosed(const geometry::Surface& surface);

/// Two bodies as one.
template <int Dim>
[[nodiscard]] Inertia<Dim> joined(const Inertia<Dim>& a, const Inertia<Dim>& b);

/// The tensor about another point than the centre of mass.
///
/// Formula    J + m (|d|^2 I - d d^T) ,  d = point - X_c   (Steiner)
template <int Dim>
[[nodiscard]] typename Inertia<Dim>::Tensor tensor_about(const Inertia<Dim>& inertia,
                                                         const Vec<Dim>& point);

/// What is wrong with it, empty if nothing is: mass and moments must be positive, and no principal
/// moment larger than the sum of the others.
template <int Dim>
[[nodiscard]] std::string validate(const Inertia<Dim>& inertia);

}  // namespace osculate::body
