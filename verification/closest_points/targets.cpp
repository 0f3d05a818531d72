#include "targets.hpp"

#include <cmath>
#include <numbers>

#include "../../tests/support/sample_targets.hpp"

namespace osculate::verification {
namespace {

using cell::CellType;
using projection::FacetMesh;
using projection::MeshFacet;
using projection::Shape;
using projection::Target;

constexpr double pi = std::numbers::pi;

SampleTarget<2> polyline() {
  const std::vector<Vec2> points{{0, 0}, {1, 0.3}, {2, -0.4}, {2.5, 1}, {1, 1.5}, {0.3, 0.8}};
  return {"polyline", testing::polyline(points), 40, false};
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
      {"NURBS patch", Shape<3>(testing::wavy_patch()), 30, false},
      {"sphere of tri3", testing::sphere_mesh(6), 2, false},
      cylinder_mesh(16, 6),
      torus_mesh(16, 8)};
}

}  // namespace osculate::verification
