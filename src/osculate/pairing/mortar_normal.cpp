#include "osculate/pairing/mortar_normal.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "osculate/cell/shape.hpp"

namespace osculate::pairing {
namespace {

template <class Facet>
std::size_t local_node(const Facet& facet, Index node) {
  const auto* const begin = facet.nodes.begin();
  return static_cast<std::size_t>(std::find(begin, begin + facet.count, node) - begin);
}

double line_node(int count, std::size_t k) {
  if (k < 2) return k == 0 ? -1.0 : 1.0;
  return -1.0 + 2.0 * static_cast<double>(k - 1) / (count - 1);
}

/// Divides the sum of the facets' normals by its size.
template <int Dim>
bool normalise(bool gradients, NodalNormal<Dim>& out) {
  constexpr double opposite = 1e-6;
  const double size = out.value.norm();
  if (!(size > opposite)) {
    out.value.setZero();
    out.gradient.clear();
    return false;
  }
  out.value /= size;
  if (!gradients) return true;
  const Mat<Dim, Dim> across =
      (Mat<Dim, Dim>::Identity() - out.value * out.value.transpose()) / size;
  for (NodeMatrix<Dim>& g : out.gradient) g.value = (across * g.value).eval();
  return true;
}

template <int Dim>
void clear(NodalNormal<Dim>& out) {
  out.value.setZero();
  out.frame.setZero();
  out.gradient.clear();
  for (auto& column : out.frame_gradient) column.clear();
}

Mat<3, 3> cross_matrix(const Vec3& v) {
  Mat<3, 3> m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// e_1 = a_p / |a_p| with a_p = a - n (n . a), a = r_,1 of the facet; e_2 = -n x e_1.
void add_frame(const SurfaceFacet& facet, const Vec2& xi, std::span<const Vec3> x, bool gradients,
               NodalNormal<3>& out) {
  const cell::FacetShape shape = facet_shape(facet, xi);
  const Vec3 a = facet_jet(facet, shape, x).r1[0], n = out.value;
  const Vec3 across = a - n * n.dot(a);
  const double size = across.norm();
  const Vec3 first = across / size;
  out.frame.col(0) = first;
  out.frame.col(1) = first.cross(n);
  if (!gradients) return;
  const Mat<3, 3> unit = (Mat<3, 3>::Identity() - first * first.transpose()) / size;
  const Mat<3, 3> by_normal = -unit * (n.dot(a) * Mat<3, 3>::Identity() + n * a.transpose());
  const Mat<3, 3> by_along = unit * (Mat<3, 3>::Identity() - n * n.transpose());
  const auto add = [&](Index node, const Mat<3, 3>& of_first, const Mat<3, 3>& of_normal) {
    out.frame_gradient[0].push_back({node, of_first});
    out.frame_gradient[1].push_back(
        {node, cross_matrix(first) * of_normal - cross_matrix(n) * of_first});
  };
  for (const NodeMatrix<3>& g : out.gradient) add(g.node, by_normal * g.value, g.value);
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
    add(facet.nodes[k], shape.n[1][k] * by_along, Mat<3, 3>::Zero());
}

}  // namespace

void nodal_normal(const SlaveSide<2>& slave, std::size_t i, std::span<const Vec2> x, bool gradients,
                  NodalNormal<2>& out) {
  clear(out);
  for (const Index f : slave.facets_of[i]) {
    const Facet& facet = slave.boundary.facets[static_cast<std::size_t>(f)];
    const double xi = line_node(facet.count, local_node(facet, slave.nodes[i]));
    const cell::LineShape shape = facet_shape(facet, xi);
    const Vec2 along = facet_jet(facet, shape, x).r1;
    const double size = along.norm();
    if (!(size > 0)) continue;
    const Vec2 tangent = along / size, normal = turn(tangent);
    out.value += normal;
    if (!gradients) continue;
    const Mat<2, 2> turning = -tangent * normal.transpose() / size;
    for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
      out.gradient.push_back({facet.nodes[k], shape.n[1][k] * turning});
  }
  if (!normalise(gradients, out)) return;
  out.frame = turn(out.value);
  Mat<2, 2> quarter;
  quarter << 0, -1, 1, 0;
  for (const NodeMatrix<2>& g : out.gradient)
    out.frame_gradient[0].push_back({g.node, quarter * g.value});
}

void nodal_normal(const SlaveSide<3>& slave, std::size_t i, std::span<const Vec3> x, bool gradients,
                  NodalNormal<3>& out) {
  clear(out);
  for (const Index f : slave.facets_of[i]) {
    const SurfaceFacet& facet = slave.boundary.facets[static_cast<std::size_t>(f)];
    const auto k = static_cast<int>(local_node(facet, slave.nodes[i]));
    const cell::FacetShape shape = facet_shape(facet, cell::area_node(facet.type, k));
    const geometry::SurfaceJet jet = facet_jet(facet, shape, x);
    const Vec3 across = jet.r1[0].cross(jet.r1[1]);
    const double size = across.norm();
    if (!(size > 0)) continue;
    const Vec3 normal = across / size;
    out.value += normal;
    if (!gradients) continue;
    const Mat<3, 3> unit = (Mat<3, 3>::Identity() - normal * normal.transpose()) / size;
    const Mat<3, 3> by_first = -unit * cross_matrix(jet.r1[1]),
                    by_second = unit * cross_matrix(jet.r1[0]);
    for (std::size_t l = 0; l < static_cast<std::size_t>(facet.count); ++l)
      out.gradient.push_back(
          {facet.nodes[l], shape.n[1][l] * by_first + shape.n[2][l] * by_second});
  }
  if (!normalise(gradients, out)) return;
  const SurfaceFacet& first =
      slave.boundary.facets[static_cast<std::size_t>(slave.facets_of[i][0])];
  const auto k = static_cast<int>(local_node(first, slave.nodes[i]));
  add_frame(first, cell::area_node(first.type, k), x, gradients, out);
}

}  // namespace osculate::pairing
