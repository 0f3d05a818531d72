#pragma once
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "osculate/cell/shape.hpp"
#include "osculate/geometry/surface_catalogue.hpp"

namespace osculate::testing {

struct NamedSurface {
  std::string name;
  geometry::Surface surface;
};

inline std::vector<double> clamped_knots(int degree, int points) {
  const int inner = points - degree - 1;
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, 0.0);
  for (int i = 1; i <= inner; ++i) knots.push_back(i + 0.2 * std::sin(1.0 * i));
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, inner + 1.0);
  return knots;
}

/// Wavy rational patch over about 0..points in x and y.
inline geometry::NurbsPatch nurbs_hills(std::array<int, 2> degree, std::array<int, 2> points) {
  geometry::NurbsPatch patch;
  patch.degree = degree;
  patch.count = points;
  patch.knots = {clamped_knots(degree[0], points[0]), clamped_knots(degree[1], points[1])};
  for (int i = 0; i < points[0]; ++i)
    for (int j = 0; j < points[1]; ++j) {
      patch.control.emplace_back(0.9 * i + 0.1 * std::sin(3.0 * j),
                                 1.1 * j + 0.1 * std::cos(2.0 * i),
                                 0.7 * std::sin(2.1 * i + 1.3 * j));
      patch.weights.push_back(1.0 + 0.4 * std::sin(1.7 * i - 0.9 * j));
    }
  return patch;
}

/// Full cylinder about the z-axis in four quadratic pieces, z from 0 to `height`, solid.
inline geometry::NurbsPatch nurbs_cylinder(double r, double height) {
  const double w = std::numbers::sqrt2 / 2;
  const std::array<std::array<double, 2>, 9> ring{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}}};
  geometry::NurbsPatch patch;
  patch.degree = {2, 1};
  patch.count = {9, 2};
  patch.knots = {{{0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, {0, 0, 1, 1}}};
  for (std::size_t i = 0; i < ring.size(); ++i)
    for (double z : {0.0, height}) {
      patch.control.emplace_back(r * ring[i][0], r * ring[i][1], z);
      patch.weights.push_back(i % 2 == 0 ? 1 : w);
    }
  return patch;
}

/// A bent and warped facet of about unit size.
inline std::vector<Vec3> bent_facet_nodes(cell::CellType type, double bend) {
  std::vector<Vec3> nodes;
  for (int k = 0; k < cell::info(type).nodes; ++k) {
    const Vec2 p = cell::area_node(type, k);
    nodes.emplace_back(1.2 * p.x() + 0.1 * p.y() + 0.05 * std::sin(3.0 * k), 0.9 * p.y(),
                       bend * (p.x() * p.x() - 0.6 * p.y() * p.y() + 0.8 * p.x() * p.y()));
  }
  return nodes;
}

/// At least one surface of every entry of the catalogue.
inline std::vector<NamedSurface> sample_surfaces() {
  using namespace geometry;
  const Vec3 c(0.4, -0.7, 0.2), axis(1, -2, 0.5);
  std::vector<NamedSurface> all{
      {"plane", Plane{c, axis}},
      {"sphere", Sphere{c, 1.3, false, axis}},
      {"spherical hole", Sphere{c, 1.3, true, axis}},
      {"cylinder", Cylinder{.point = c, .axis = axis, .radius = 0.8}},
      {"bore", Cylinder{.point = c, .axis = axis, .radius = 0.8, .inside = true, .length = 2.5}},
      {"cone", Cone{.apex = c, .axis = axis, .half_angle = 0.6}},
      {"conical hole",
       Cone{.apex = c, .axis = axis, .half_angle = 0.6, .inside = true, .from = 0.8, .to = 3}},
      {"torus", Torus{c, axis, 2.0, 0.7, false}},
      {"toroidal hole", Torus{c, axis, 2.0, 0.7, true}},
      {"hills 1 2", nurbs_hills({1, 2}, {4, 5})},
      {"hills 3 2", nurbs_hills({3, 2}, {6, 4})},
      {"hills 4 3", reversed(nurbs_hills({4, 3}, {5, 6}))},
      {"NURBS cylinder", nurbs_cylinder(1.5, 2)}};
  using cell::CellType;
  for (const CellType type :
       {CellType::tri3, CellType::tri6, CellType::quad4, CellType::quad8, CellType::quad9})
    all.push_back(
        {std::string(cell::info(type).name), lagrange_surface(type, bent_facet_nodes(type, 0.2))});
  return all;
}

/// lo and hi with infinite ends cut off and the apex of a cone left out.
inline std::array<Vec2, 2> finite_range(const geometry::Surface& surface) {
  std::array<Vec2, 2> range{geometry::lo(surface), geometry::hi(surface)};
  if (const auto* cone = std::get_if<geometry::Cone>(&surface))
    range[0].y() = std::max(cone->from, 0.5);
  for (Eigen::Index i = 0; i < 2; ++i) {
    if (!std::isfinite(range[0][i])) range[0][i] = -3;
    if (!std::isfinite(range[1][i])) range[1][i] = 5;
  }
  return range;
}

/// Places as parts of the parameter range: inside a triangle too, on no joint, off the middle of a
/// sphere's two charts.
inline constexpr std::array<std::array<double, 2>, 7> surface_places{{{0.137, 0.391},
                                                                      {0.21, 0.61},
                                                                      {0.57, 0.12},
                                                                      {0.07, 0.874},
                                                                      {0.83, 0.09},
                                                                      {0.33, 0.34},
                                                                      {0.12, 0.13}}};

/// body(surface, xi) at several places of every surface.
template <class Body>
void at_surface_places(const Body& body) {
  for (const NamedSurface& sample : sample_surfaces()) {
    SCOPED_TRACE(sample.name);
    const std::array<Vec2, 2> range = finite_range(sample.surface);
    for (const auto& t : surface_places) {
      const Vec2 xi = range[0] + Vec2(t[0], t[1]).cwiseProduct(range[1] - range[0]);
      SCOPED_TRACE(::testing::Message() << xi.transpose());
      body(sample.surface, xi);
    }
  }
}

/// Derivative of a vector along one parameter by central differences of two steps: second order, or
/// exact.
template <class F>
bool is_derivative(const F& f, const Vec3& derivative, const Vec2& xi, Eigen::Index along,
                   double h = 1e-3) {
  const double scale = std::max(derivative.norm(), 1.0);
  const auto error = [&](double s) {
    const Vec2 step = s * Vec2::Unit(along);
    return (Vec3((f(Vec2(xi + step)) - f(Vec2(xi - step))) / (2 * s)) - derivative).norm() / scale;
  };
  const double e1 = error(h), e2 = error(h / 2);
  return std::max(e1, e2) < 2e-11 || std::abs(std::log2(e1 / e2) - 2.0) < 0.1;
}

}  // namespace osculate::testing
