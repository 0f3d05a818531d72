#include "osculate/pairing/projected_point.hpp"

#include "osculate/cell/shape.hpp"

namespace osculate::pairing {

using contact::first_slot;
using contact::second_slot;
using projection::Feature;

namespace {

/// Sides that touch without a gap are in contact, also where the rounding of their coordinates has
/// left one (it would differ with the units of the model).
template <int Dim>
void drop_rounding(const Vec<Dim>& point, ProjectedPoint<Dim>& projected) {
  constexpr double rounding = 1e-14;
  double& gap = projected.kinematics.gap;
  if (gap > 0 && gap <= rounding * (point.norm() + projected.foot.norm())) gap = 0;
}

}  // namespace

ProjectedPoint<2> projected_point(const Chain& master, const Projection<2>& p, const Vec2& point,
                                  std::span<const Vec2> x) {
  ProjectedPoint<2> projected;
  projected.projection = p;
  const Facet& facet = master.facets[static_cast<std::size_t>(p.facet)];
  const cell::LineShape shape = facet_shape(facet, p.xi[0]);
  const geometry::CurveJet<2> jet = facet_jet(facet, shape, x);
  projected.foot = jet.r;
  projected.count = facet.count;
  const bool corner = p.feature == Feature::corner;
  projected.kinematics = corner ? contact::corner_kinematics<2>(jet.r, point, p.outward)
                                : contact::face_kinematics(jet, point);
  const std::size_t orders = corner ? 1 : 3;
  for (std::size_t s = 0; s < orders; ++s)
    for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
      projected.shape[s][k] = shape.n[s][k];
  drop_rounding(point, projected);
  return projected;
}

namespace {

/// Derivatives of the shape functions along the straight direction `e` of the reference cell.
std::array<std::array<double, cell::max_shape_nodes>, 4> along(const cell::FacetShape& s,
                                                               const Vec2& e) {
  const double a = e.x(), b = e.y();
  std::array<std::array<double, cell::max_shape_nodes>, 4> n{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(s.count); ++k) {
    n[0][k] = s.n[0][k];
    n[1][k] = a * s.n[1][k] + b * s.n[2][k];
    n[2][k] = a * a * s.n[3][k] + 2 * a * b * s.n[4][k] + b * b * s.n[5][k];
    n[3][k] = a * a * a * s.n[6][k] + 3 * a * a * b * s.n[7][k] + 3 * a * b * b * s.n[8][k] +
              b * b * b * s.n[9][k];
  }
  return n;
}

void project_on_edge(const SurfaceFacet& facet, const cell::FacetShape& shape, const Vec3& point,
                     std::span<const Vec3> x, ProjectedPoint<3>& projected) {
  const std::array<int, 2> ends = edge_corners(facet, projected.projection.local);
  const Vec2 direction =
      0.5 * (cell::area_node(facet.type, ends[1]) - cell::area_node(facet.type, ends[0]));
  const auto n = along(shape, direction);
  geometry::CurveJet<3> jet;
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k) {
    const Vec3& node = x[static_cast<std::size_t>(facet.nodes[k])];
    jet.r += n[0][k] * node;
    jet.r1 += n[1][k] * node;
    jet.r2 += n[2][k] * node;
    jet.r3 += n[3][k] * node;
  }
  projected.shape[first_slot(0)] = n[1];
  projected.shape[second_slot<3>(0, 0)] = n[2];
  projected.kinematics = contact::edge_kinematics(jet, point, projected.projection.outward);
}

}  // namespace

ProjectedPoint<3> projected_point(const FacetSurface& master, const Projection<3>& p,
                                  const Vec3& point, std::span<const Vec3> x, PatchPoints patches,
                                  int order) {
  ProjectedPoint<3> projected;
  projected.projection = p;
  projected.patches = patches;
  const SurfaceFacet& facet = master.facets[static_cast<std::size_t>(p.facet)];
  const bool by_points = facet.patch && p.feature == Feature::face && order < 3;
  const cell::FacetShape shape = facet_shape(facet, p.xi, by_points ? order : 3);
  geometry::SurfaceJet jet;
  if (by_points) {
    GregoryPoints room;
    jet = patch_jet(facet.type, points_of(master, facet, x, patches, room), p.xi);
  } else {
    jet = facet_jet(facet, shape, x);
  }
  projected.foot = jet.r;
  projected.count = facet.count;
  projected.shape[0] = shape.n[0];
  if (p.feature == Feature::corner) {
    projected.kinematics = contact::corner_kinematics<3>(jet.r, point, p.outward);
  } else if (p.feature == Feature::edge && p.local >= 0) {
    project_on_edge(facet, shape, point, x, projected);
  } else {
    projected.kinematics = contact::face_kinematics(jet, point, order > 0);
    for (std::size_t s = 1; s < contact::slots<3>; ++s) projected.shape[s] = shape.n[s];
  }
  drop_rounding(point, projected);
  return projected;
}

}  // namespace osculate::pairing
