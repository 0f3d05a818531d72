#include "osculate/pairing/surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>

#include "osculate/cell/line_shape.hpp"
#include "osculate/cell/linear_facet.hpp"

namespace osculate::pairing {

SurfaceFacet surface_facet(cell::CellType type, std::span<const Index> nodes) {
  SurfaceFacet facet;
  facet.type = type;
  facet.count = static_cast<int>(nodes.size());
  std::copy(nodes.begin(), nodes.end(), facet.nodes.begin());
  return facet;
}

SurfaceFacet shape_facet(geometry::Surface shape, const std::array<Index, 4>& frame) {
  SurfaceFacet facet;
  facet.count = 4;
  std::copy(frame.begin(), frame.end(), facet.nodes.begin());
  facet.shape = std::make_shared<const geometry::Surface>(std::move(shape));
  return facet;
}

int edge_count(const SurfaceFacet& facet) {
  if (facet.shape) return 0;
  return cell::is_triangle(facet.type) ? 3 : 4;
}

std::array<int, 2> edge_corners(const SurfaceFacet& facet, int edge) {
  return {edge, (edge + 1) % edge_count(facet)};
}

namespace {

/// Representative of each facet's connected piece (path halving).
Index root(std::vector<Index>& parent, Index f) {
  while (parent[static_cast<std::size_t>(f)] != f) {
    Index& up = parent[static_cast<std::size_t>(f)];
    up = parent[static_cast<std::size_t>(up)];
    f = up;
  }
  return f;
}

}  // namespace

void connect(FacetSurface& surface) {
  std::map<std::array<Index, 2>, std::array<Index, 2>> open;  // edge -> facet, local edge
  std::vector<Index> parent(surface.facets.size());
  std::iota(parent.begin(), parent.end(), 0);
  surface.facets_at.clear();
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    SurfaceFacet& facet = surface.facets[f];
    facet.neighbour.fill(-1);
    for (int e = 0; e < edge_count(facet); ++e) {
      const std::array<int, 2> ends = edge_corners(facet, e);
      const Index a = facet.nodes[static_cast<std::size_t>(ends[0])];
      const Index b = facet.nodes[static_cast<std::size_t>(ends[1])];
      surface.facets_at[a].push_back(static_cast<Index>(f));
      const std::array<Index, 2> key{std::min(a, b), std::max(a, b)};
      const auto [at, fresh] = open.emplace(key, std::array<Index, 2>{static_cast<Index>(f), e});
      if (fresh) continue;
      const auto other = static_cast<std::size_t>(at->second[0]);
      facet.neighbour[static_cast<std::size_t>(e)] = at->second[0];
      surface.facets[other].neighbour[static_cast<std::size_t>(at->second[1])] =
          static_cast<Index>(f);
      parent[static_cast<std::size_t>(root(parent, static_cast<Index>(f)))] =
          root(parent, at->second[0]);
    }
  }
  for (std::size_t f = 0; f < surface.facets.size(); ++f)
    surface.facets[f].piece = root(parent, static_cast<Index>(f));
}

namespace {

/// Shape functions of rho(xi) - s(eta).
cell::FacetShape difference_shape(const SurfaceFacet& facet, const Vec2& xi) {
  const double way = facet.flipped ? -1.0 : 1.0;
  const cell::LineShape r = cell::lagrange_line(facet.difference[0], xi[0]),
                        s = cell::lagrange_line(facet.difference[1], way * xi[1]);
  constexpr std::array<std::size_t, 4> along_first{0, 1, 3, 6}, along_second{0, 2, 5, 9};
  cell::FacetShape shape;
  shape.count = facet.count;
  const auto first = static_cast<std::size_t>(r.count);
  double sign = -1;
  for (std::size_t d = 0; d < 4; ++d, sign *= way) {
    for (std::size_t k = 0; k < first; ++k) shape.n[along_first[d]][k] = r.n[d][k];
    for (std::size_t k = 0; k < static_cast<std::size_t>(s.count); ++k)
      shape.n[along_second[d]][first + k] = sign * s.n[d][k];
  }
  return shape;
}

}  // namespace

cell::FacetShape facet_shape(const SurfaceFacet& facet, const Vec2& xi, int order) {
  if (facet.difference[0] > 0) return difference_shape(facet, xi);
  if (facet.patch) return gregory_shape(*facet.patch, facet.count, xi, order);
  if (!facet.shape) return cell::facet_shape(facet.type, xi, order);
  const geometry::SurfaceJet jet = geometry::jet(*facet.shape, xi);
  const std::array<const Vec3*, 10> d{&jet.r,     &jet.r1[0], &jet.r1[1], &jet.r2[0], &jet.r2[1],
                                      &jet.r2[2], &jet.r3[0], &jet.r3[1], &jet.r3[2], &jet.r3[3]};
  cell::FacetShape shape;
  shape.count = 4;
  for (std::size_t order = 0; order < d.size(); ++order) {
    shape.n[order][0] = (order == 0 ? 1.0 : 0.0) - d[order]->sum();
    for (std::size_t k = 0; k < 3; ++k)
      shape.n[order][k + 1] = (*d[order])[static_cast<Eigen::Index>(k)];
  }
  return shape;
}

geometry::SurfaceJet facet_jet(const SurfaceFacet& facet, const cell::FacetShape& shape,
                               std::span<const Vec3> x) {
  geometry::SurfaceJet jet;
  const int highest = is_plain(facet) ? cell::highest_derivative(facet.type) : 3;
  for (std::size_t k = 0; k < static_cast<std::size_t>(shape.count); ++k) {
    const Vec3& node = x[static_cast<std::size_t>(facet.nodes[k])];
    jet.r += shape.n[0][k] * node;
    for (std::size_t d = 0; d < 2; ++d) jet.r1[d] += shape.n[1 + d][k] * node;
    if (highest < 2) continue;
    for (std::size_t d = 0; d < 3; ++d) jet.r2[d] += shape.n[3 + d][k] * node;
    if (highest < 3) continue;
    for (std::size_t d = 0; d < 4; ++d) jet.r3[d] += shape.n[6 + d][k] * node;
  }
  return jet;
}

GregoryPoints patch_points(const SurfaceFacet& facet, std::span<const Vec3> x) {
  GregoryPoints points;
  points.fill(Eigen::Array4d::Zero());
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k) {
    const Vec3& at = x[static_cast<std::size_t>(facet.nodes[k])];
    const Eigen::Array4d node(at.x(), at.y(), at.z(), 0);
    for (std::size_t j = 0; j < gregory_points; ++j) points[j] += facet.patch->weight[j][k] * node;
  }
  return points;
}

const GregoryPoints& points_of(const FacetSurface& surface, const SurfaceFacet& facet,
                               std::span<const Vec3> x, PatchPoints patches, GregoryPoints& room) {
  const auto number = static_cast<std::size_t>(&facet - surface.facets.data());
  if (number < patches.size()) return patches[number];
  room = patch_points(facet, x);
  return room;
}

geometry::SurfaceJet patch_jet(cell::CellType type, const GregoryPoints& points, const Vec2& xi) {
  const GregoryJet jet = gregory_jet(cell::is_triangle(type), points, xi);
  const auto r = [&](std::size_t d) -> Vec3 { return jet[d].head<3>(); };
  geometry::SurfaceJet out;
  out.r = r(0);
  out.r1 = {r(1), r(2)};
  out.r2 = {r(3), r(4), r(5)};
  return out;
}

Vec3 facet_point(const SurfaceFacet& facet, const Vec2& xi, std::span<const Vec3> x) {
  const auto node = [&](std::size_t k) -> const Vec3& {
    return x[static_cast<std::size_t>(facet.nodes[k])];
  };
  if (is_plain(facet) && cell::is_linear_facet(facet.type))
    return cell::linear_facet(facet.type, node, xi)[0];
  const cell::FacetShape shape = facet_shape(facet, xi, 0);
  Vec3 point = Vec3::Zero();
  for (std::size_t k = 0; k < static_cast<std::size_t>(shape.count); ++k)
    point += shape.n[0][k] * node(k);
  return point;
}

namespace {

Vec3 normal_of_plane(const Vec3& r1, const Vec3& r2) {
  const Vec3 normal = r1.cross(r2);
  const double size = normal.norm();
  return size > 0 ? Vec3(normal / size) : Vec3(Vec3::Zero());
}

}  // namespace

Vec3 facet_normal(const SurfaceFacet& facet, const Vec2& xi, std::span<const Vec3> x) {
  const auto node = [&](std::size_t k) -> const Vec3& {
    return x[static_cast<std::size_t>(facet.nodes[k])];
  };
  Vec3 r1 = Vec3::Zero(), r2 = Vec3::Zero();
  if (is_plain(facet) && cell::is_linear_facet(facet.type)) {
    const cell::FacetDerivatives r = cell::linear_facet(facet.type, node, xi);
    r1 = r[1];
    r2 = r[2];
  } else {
    const cell::FacetShape shape = facet_shape(facet, xi, 1);
    for (std::size_t k = 0; k < static_cast<std::size_t>(shape.count); ++k) {
      r1 += shape.n[1][k] * node(k);
      r2 += shape.n[2][k] * node(k);
    }
  }
  return normal_of_plane(r1, r2);
}

Vec3 facet_normal(const FacetSurface& surface, const SurfaceFacet& facet, const Vec2& xi,
                  std::span<const Vec3> x, PatchPoints patches) {
  if (!facet.patch) return facet_normal(facet, xi, x);
  GregoryPoints room;
  const geometry::SurfaceJet jet =
      patch_jet(facet.type, points_of(surface, facet, x, patches, room), xi);
  return normal_of_plane(jet.r1[0], jet.r1[1]);
}

}  // namespace osculate::pairing
