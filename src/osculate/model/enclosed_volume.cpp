#include "osculate/model/enclosed_volume.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "osculate/cell/facet_shape.hpp"
#include "osculate/cell/line_shape.hpp"
#include "osculate/cell/quadrature.hpp"

namespace osculate::model {
namespace {

constexpr int rule = 5;  ///< Gauss points that are exact for the cube of a quad9 times its normal

template <int Dim>
EnclosedVolume<Dim> nothing(std::string why) {
  return {std::nullopt, std::move(why)};
}

/// A closed boundary, all normals to one side.
template <int Dim>
EnclosedVolume<Dim> inside(const body::VolumeMoments<Dim>& moments) {
  if (moments.volume > 0) return {moments, {}};
  return nothing<Dim>(moments.volume < 0
                          ? "lies outside of its closed boundary (flip: true puts it inside)"
                          : "has a boundary that encloses nothing");
}

void add_side(const Model& m, const mesh::BoundaryFacet& side, body::VolumeMoments<2>& moments) {
  const std::span<const Index> nodes = side.nodes();
  const auto x = [&](std::size_t k) { return m.reference[static_cast<std::size_t>(nodes[k])]; };
  if (nodes.size() == 2) {
    body::add_facet(moments, x(0), x(1));
    return;
  }
  static const cell::Quadrature1D line = cell::gauss_legendre(rule + 1);
  for (std::size_t q = 0; q < line.points.size(); ++q) {
    const cell::LineShape shape =
        cell::lagrange_line(static_cast<int>(nodes.size()), line.points[q]);
    Vec2 r = Vec2::Zero(), r1 = Vec2::Zero();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      r += shape.n[0][k] * x(k);
      r1 += shape.n[1][k] * x(k);
    }
    body::add_boundary<2>(moments, r, Vec2(line.weights[q] * turn(r1)));
  }
}

/// The square's rule, for triangles drawn together along one of its sides.
struct FacetPoint {
  Vec2 xi;
  double weight;
};
FacetPoint facet_point(cell::CellType type, const Vec2& square, double weight) {
  if (!cell::is_triangle(type)) return {square, weight};
  const Vec2 unit = 0.5 * (square + Vec2::Ones());
  return {Vec2(unit.x(), unit.y() * (1 - unit.x())), 0.25 * weight * (1 - unit.x())};
}

void add_side(const Model3& m, const mesh::SurfaceFacet& side, body::VolumeMoments<3>& moments) {
  const std::span<const Index> nodes = side.nodes();
  const auto x = [&](std::size_t k) { return m.reference[static_cast<std::size_t>(nodes[k])]; };
  if (nodes.size() == 3) {
    body::add_facet(moments, x(0), x(1), x(2));
    return;
  }
  static const cell::Quadrature2D square = cell::gauss_quad(rule);
  for (std::size_t q = 0; q < square.points.size(); ++q) {
    const FacetPoint at = facet_point(side.type, square.points[q], square.weights[q]);
    const cell::FacetShape shape = cell::facet_shape(side.type, at.xi, 1);
    Vec3 r = Vec3::Zero(), r1 = Vec3::Zero(), r2 = Vec3::Zero();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      r += shape.n[0][k] * x(k);
      r1 += shape.n[1][k] * x(k);
      r2 += shape.n[2][k] * x(k);
    }
    body::add_boundary<3>(moments, r, Vec3(at.weight * r1.cross(r2)));
  }
}

/// A node where the boundary ends, or -1.
Index open_end(const mesh::BoundaryFacet& side) {
  if (side.next < 0) return side.node[1];
  return side.prev < 0 ? side.node[0] : -1;
}
Index open_end(const mesh::SurfaceFacet& side) {
  for (std::size_t k = 0; k < side.corners().size(); ++k)
    if (side.next[k] < 0) return side.node[k];
  return -1;
}

EnclosedVolume<2> by_curves(const RigidBody& body, bool closed) {
  body::VolumeMoments<2> moments;
  if (!body.parts.empty()) {
    if (!body.closed) return nothing<2>("is an open curve");
    moments.origin = geometry::jet(body.parts[0], geometry::lo(body.parts[0])).r;
    for (const geometry::Curve& part : body.parts) body::add_curve(moments, part);
    return inside(moments);
  }
  if (!closed) return nothing<2>("is an open polyline");
  const std::vector<Vec2>& p = body.polyline;
  moments.origin = p.front();
  for (std::size_t i = 0; i < p.size(); ++i) body::add_facet(moments, p[i], p[(i + 1) % p.size()]);
  return inside(moments);
}

}  // namespace

template <int Dim>
EnclosedVolume<Dim> enclosed_volume(const BasicModel<Dim>& model,
                                    const std::vector<Side<Dim>>& sides, bool whole, bool flip) {
  body::VolumeMoments<Dim> moments;
  if (!sides.empty())
    moments.origin = model.reference[static_cast<std::size_t>(sides.front().node[0])];
  bool on_cells = whole;
  for (const Side<Dim>& side : sides) {
    if (const Index end = open_end(side); end >= 0 && !whole)
      return nothing<Dim>(fmt::format("has a boundary that is not closed, at {}",
                                      mesh::describe_node(model.mesh, end)));
    on_cells = on_cells || side.has_parent();
    add_side(model, side, moments);
  }
  if (flip && !on_cells) {
    moments.volume *= -1;
    moments.first *= -1;
    moments.second *= -1;
  }
  return inside(moments);
}

template <int Dim>
EnclosedVolume<Dim> enclosed_volume(const BasicRigidBody<Dim>& body, bool closed) {
  if (body.shape) {
    EnclosedVolume<Dim> out{body::enclosed(*body.shape), {}};
    if (!out.moments) out.why = "encloses none";
    return out;
  }
  if constexpr (Dim == 2) return by_curves(body, closed);
  return nothing<Dim>("encloses none");
}

template EnclosedVolume<2> enclosed_volume(const Model&, const std::vector<Side<2>>&, bool, bool);
template EnclosedVolume<3> enclosed_volume(const Model3&, const std::vector<Side<3>>&, bool, bool);
template EnclosedVolume<2> enclosed_volume(const RigidBody&, bool);
template EnclosedVolume<3> enclosed_volume(const RigidBody3&, bool);

}  // namespace osculate::model
