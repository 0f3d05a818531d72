#include "targets.hpp"

#include <cmath>
#include <map>
#include <numbers>

namespace osculate::verification {
namespace {

using cell::CellType;
using projection::FacetMesh;
using projection::MeshFacet;
using projection::Shape;
using projection::Target;

constexpr double pi = std::numbers::pi;

SampleTarget<2> polyline() {
  FacetMesh<2> mesh;
  mesh.nodes = {{0, 0}, {1, 0.3}, {2, -0.4}, {2.5, 1}, {1, 1.5}, {0.3, 0.8}};
  for (Index k = 0; k < 5; ++k) mesh.facets.push_back({CellType::line2, {k, k + 1}});
  return {"polyline", mesh, 40, false};
}

SampleTarget<2> quadratic_segment() {
  FacetMesh<2> mesh;
  mesh.nodes = {{-1, 0}, {1, 0.2}, {0.1, 1.0}};
  mesh.facets.push_back({CellType::line3, {0, 1, 2}});
  return {"quadratic segment", mesh, 200, true};
}

SampleTarget<2> nurbs_arc() {
  geometry::NurbsCurve arc;  // three quarters of a circle
  const double w = std::sqrt(0.5);
  arc.degree = 2;
  arc.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 3};
  arc.control = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}};
  arc.weights = {1, w, 1, w, 1, w, 1};
  return {"NURBS arc", Shape<2>(arc), 100, false};
}

SampleTarget<3> one_facet(std::string name, CellType type, std::vector<Vec3> nodes) {
  FacetMesh<3> mesh;
  MeshFacet facet{type, {}};
  for (std::size_t k = 0; k < nodes.size(); ++k) facet.nodes[k] = static_cast<Index>(k);
  mesh.nodes = std::move(nodes);
  mesh.facets.push_back(facet);
  return {std::move(name), mesh, 150, true};
}

SampleTarget<3> hyperbolic() {
  std::vector<Vec3> nodes;
  const double x[9] = {0, 1, 1, 0, 0.5, 1, 0.5, 0, 0.5}, y[9] = {0, 0, 1, 1, 0, 0.5, 1, 0.5, 0.5};
  for (int k = 0; k < 9; ++k) nodes.push_back({x[k], y[k], 0.5 * (x[k] * x[k] - y[k] * y[k])});
  return one_facet("hyperbolic surface", CellType::quad9, nodes);
}

/// Bicubic-biquadratic, 3 x 2 spans, with weights between 0.6 and 1.4.
SampleTarget<3> nurbs_patch() {
  geometry::NurbsPatch patch;
  patch.degree = {3, 2};
  patch.knots = {std::vector<double>{0, 0, 0, 0, 0.3, 0.6, 1, 1, 1, 1},
                 std::vector<double>{0, 0, 0, 0.5, 1, 1, 1}};
  patch.count = {6, 4};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 4; ++j) {
      const double a = std::sin(3.7 * i + 1.3 * j * j + 0.4), b = std::sin(2.1 * i * j + 5.1 * j);
      patch.control.push_back({0.2 * i + 0.03 * b, j / 3.0 + 0.03 * a, 0.3 * a});
      patch.weights.push_back(1 + 0.4 * b);
    }
  return {"NURBS patch", Shape<3>(patch), 30, false};
}

/// Triangles between points of the unit sphere (an octahedron cut n times).
SampleTarget<3> sphere_mesh(int n) {
  FacetMesh<3> mesh;
  std::map<std::array<long, 3>, Index> known;
  const auto node = [&](const Vec3& direction) {
    const Vec3 p = direction.normalized();
    const std::array<long, 3> key{std::lround(p[0] * 1e9), std::lround(p[1] * 1e9),
                                  std::lround(p[2] * 1e9)};
    const auto found = known.try_emplace(key, static_cast<Index>(mesh.nodes.size()));
    if (found.second) mesh.nodes.push_back(p);
    return found.first->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const double sx = (octant & 1) != 0 ? -1 : 1, sy = (octant & 2) != 0 ? -1 : 1,
                 sz = (octant & 4) != 0 ? -1 : 1;
    const bool turned = sx * sy * sz < 0;
    const auto at = [&](int i, int j) {
      const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
      return node({sx * (1 - u - v), sy * u, sz * v});
    };
    const auto add = [&](Index a, Index b, Index c) {
      mesh.facets.push_back({CellType::tri3, {a, turned ? c : b, turned ? b : c}});
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }
  return {"sphere of tri3", mesh, 2, false};
}

SampleTarget<3> cylinder_mesh(int around, int along) {
  FacetMesh<3> mesh;
  for (int k = 0; k <= along; ++k)
    for (int i = 0; i < around; ++i) {
      const double a = 2 * pi * i / around + 0.3 * k;  // twisted: bilinear facets that are not flat
      mesh.nodes.push_back({std::cos(a), std::sin(a), 0.5 * k});
    }
  const auto id = [&](int i, int k) { return static_cast<Index>(k * around + i % around); };
  for (int k = 0; k < along; ++k)
    for (int i = 0; i < around; ++i)
      mesh.facets.push_back(
          {CellType::quad4, {id(i, k), id(i + 1, k), id(i + 1, k + 1), id(i, k + 1)}});
  return {"cylinder of quad4", mesh, 6, false};
}

SampleTarget<3> torus_mesh(int around, int tube) {
  FacetMesh<3> mesh;
  for (int i = 0; i < 2 * around; ++i)
    for (int j = 0; j < 2 * tube; ++j) {
      const double a = pi * i / around, b = pi * j / tube;
      mesh.nodes.push_back(
          {(2 + std::cos(b)) * std::cos(a), (2 + std::cos(b)) * std::sin(a), std::sin(b)});
    }
  const auto id = [&](int i, int j) {
    return static_cast<Index>((i % (2 * around)) * 2 * tube + j % (2 * tube));
  };
  for (int i = 0; i < 2 * around; i += 2)
    for (int j = 0; j < 2 * tube; j += 2)
      mesh.facets.push_back({CellType::quad9,
                             {id(i, j), id(i + 2, j), id(i + 2, j + 2), id(i, j + 2), id(i + 1, j),
                              id(i + 2, j + 1), id(i + 1, j + 2), id(i, j + 1), id(i + 1, j + 1)}});
  return {"torus of quad9", mesh, 8, false};
}

}  // namespace

std::vector<SampleTarget<2>> plane_targets() {
  return {polyline(), quadratic_segment(), nurbs_arc()};
}

std::vector<SampleTarget<3>> space_targets() {
  const std::vector<Vec3> quad{{0, 0, 0},     {1, 0, 0},     {1, 1, 0},
                               {0, 1, 0},     {.5, -.1, .3}, {1.1, .5, -.2},
                               {.5, 1.1, .3}, {-.1, .5, .2}, {.5, .5, .6}};
  return {
      one_facet("bilinear", CellType::quad4,
                {{0, 0, 0}, {1, 0.1, 0.3}, {1.1, 1, -0.4}, {-0.1, 0.9, 0.5}}),
      one_facet("biquadratic", CellType::quad9, quad),
      one_facet("serendipity", CellType::quad8, {quad.begin(), quad.begin() + 8}),
      one_facet("triangle", CellType::tri3, {{0, 0, 0}, {1, 0, 0}, {0.2, 1, 0.3}}),
      one_facet("quadratic triangle", CellType::tri6,
                {{0, 0, 0}, {1, 0, 0}, {0.2, 1, 0.3}, {.5, -.1, .3}, {.7, .6, -.2}, {-.1, .5, .3}}),
      hyperbolic(),
      nurbs_patch(),
      sphere_mesh(6),
      cylinder_mesh(16, 6),
      torus_mesh(16, 8)};
}

}  // namespace osculate::verification
