// Cells of single shapes.
#include <algorithm>
#include <cmath>

#include "osculate/projection/cells.hpp"

namespace osculate::projection {

std::optional<CellComplex<2>> complex_of(const geometry::Curve& curve) {
  if (const auto* nurbs = std::get_if<geometry::NurbsCurve>(&curve)) return make_complex(*nurbs);
  const auto* lagrange = std::get_if<geometry::LagrangeCurve>(&curve);
  if (lagrange == nullptr) return std::nullopt;
  return make_complex(as_nurbs(*lagrange));
}

std::optional<CellComplex<3>> complex_of(const geometry::Surface& surface) {
  if (const auto* nurbs = std::get_if<geometry::NurbsPatch>(&surface)) return make_complex(*nurbs);
  const auto* lagrange = std::get_if<geometry::LagrangeSurface>(&surface);
  if (lagrange == nullptr) return std::nullopt;
  FacetMesh<3> mesh;
  MeshFacet facet{lagrange->type, {}};
  const std::span<const Vec3> nodes = lagrange->used();
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    mesh.nodes.push_back(nodes[k]);
    facet.nodes[k] = static_cast<Index>(k);
  }
  mesh.facets.push_back(facet);
  return make_complex<3>(mesh);
}

geometry::NurbsCurve as_nurbs(const geometry::Arc& arc) {
  constexpr double quarter = 1.5707963267948966;
  const double whole = arc.to - arc.from;
  const int count = std::max(1, static_cast<int>(std::ceil(whole / quarter - 1e-12)));
  const double start = arc.inside ? arc.from : arc.to;
  const double half = (arc.inside ? 0.5 : -0.5) * whole / count;
  const auto at = [&](double angle, double radius) {
    return Vec2(arc.center + radius * Vec2(std::cos(angle), std::sin(angle)));
  };
  geometry::NurbsCurve out;
  out.degree = 2;
  out.knots = {0, 0, 0};
  out.control = {at(start, arc.radius)};
  out.weights = {1};
  for (int k = 0; k < count; ++k) {
    const double from = start + 2 * half * k, cosine = std::cos(half);
    out.control.push_back(at(from + half, arc.radius / cosine));
    out.control.push_back(at(from + 2 * half, arc.radius));
    out.weights.insert(out.weights.end(), {cosine, 1});
    out.knots.insert(out.knots.end(), 2, k + 1.0);
  }
  out.knots.push_back(count);
  return out;
}

}  // namespace osculate::projection
