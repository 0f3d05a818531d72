#include "osculate/pairing/moving_facet.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "osculate/pairing/closest.hpp"

namespace osculate::pairing {
namespace {

constexpr double beyond = 1.1;            ///< of half a range: 5 % of the range at either end
constexpr double beyond_triangle = 1.35;  ///< barycentric coordinates down to -0.117

double power_of(double base, int exponent) {
  return exponent == 0 ? 1.0 : std::pow(base, exponent);
}

double bernstein(int degree, int i, double t) {
  double choose = 1;
  for (int k = 0; k < i; ++k) choose *= static_cast<double>(degree - k) / (k + 1);
  return choose * power_of(t, i) * power_of(1 - t, degree - i);
}

// ---- lines --------------------------------------------------------------------------------------

std::vector<double> values_at(const Facet& facet, double xi) {
  const cell::LineShape shape = facet_shape(facet, xi);
  return {shape.n[0].begin(), shape.n[0].begin() + facet.count};
}

int degree_of(const Facet& facet) {
  return facet.bezier ? static_cast<int>(facet.bezier->degree) : facet.count - 1;
}

Net net_of(const Facet& facet) {
  const int n = degree_of(facet);
  Eigen::MatrixXd basis(n + 1, n + 1), value(n + 1, facet.count);
  for (int i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n;
    const std::vector<double> shape = values_at(facet, beyond * (2 * t - 1));
    for (int j = 0; j <= n; ++j) basis(i, j) = bernstein(n, j, t);
    for (int k = 0; k < facet.count; ++k) value(i, k) = shape[static_cast<std::size_t>(k)];
  }
  Net net{basis.partialPivLu().solve(value), {}};
  for (int j = 0; j < n; ++j) net.tangents[0].push_back({j + 1, j});
  return net;
}

double lever_of(const Facet& facet) {
  double most = 1;
  constexpr int samples = 64;
  for (int i = 0; i <= samples; ++i) {
    double sum = 0;
    for (const double n : values_at(facet, beyond * (2.0 * i / samples - 1))) sum += std::abs(n);
    most = std::max(most, sum);
  }
  return facet.count > 2 ? 1.02 * most : most;  // between the samples
}

bool is_polynomial(const Facet& facet) { return !facet.shape; }
/// Number of what facets of the same shape functions share; -1: nothing.
int type_of(const Facet& facet) { return facet.bezier ? -1 : facet.count; }

// ---- faces --------------------------------------------------------------------------------------

std::vector<double> values_at(const SurfaceFacet& facet, const Vec2& xi) {
  const cell::FacetShape shape = facet_shape(facet, xi, 0);
  return {shape.n[0].begin(), shape.n[0].begin() + facet.count};
}

Vec2 place_in(bool triangle, const Vec2& t) {
  if (!triangle) return beyond * (2 * t - Vec2::Ones());
  const Vec2 middle = Vec2::Constant(1.0 / 3);
  return middle + beyond_triangle * (t - middle);
}

Vec2 inside_of(bool triangle, const Vec2& t) { return triangle ? t : Vec2(2 * t - Vec2::Ones()); }

/// Numbers of the control points: (i, j) of a square or, i + j <= n, of a triangle.
std::vector<std::array<int, 2>> grid_of(bool triangle, int n) {
  std::vector<std::array<int, 2>> out;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= (triangle ? n - i : n); ++j) out.push_back({i, j});
  return out;
}

double bernstein(bool triangle, int n, const std::array<int, 2>& at, const Vec2& t) {
  if (!triangle) return bernstein(n, at[0], t[0]) * bernstein(n, at[1], t[1]);
  double choose = 1;
  const int rest = n - at[0] - at[1];
  for (int k = 2; k <= n; ++k) choose *= k;
  for (const int part : {at[0], at[1], rest})
    for (int k = 2; k <= part; ++k) choose /= k;
  return choose * power_of(t[0], at[0]) * power_of(t[1], at[1]) * power_of(1 - t[0] - t[1], rest);
}

Net net_of(const SurfaceFacet& facet) {
  const bool triangle = cell::is_triangle(facet.type);
  const int n = facet.count > 4 ? 2 : 1;
  const std::vector<std::array<int, 2>> grid = grid_of(triangle, n);
  const auto size = static_cast<Eigen::Index>(grid.size());
  Eigen::MatrixXd basis(size, size), value(size, facet.count);
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::array<int, 2>& at = grid[static_cast<std::size_t>(i)];
    const Vec2 t(static_cast<double>(at[0]) / n, static_cast<double>(at[1]) / n);
    const std::vector<double> shape = values_at(facet, place_in(triangle, t));
    for (Eigen::Index j = 0; j < size; ++j)
      basis(i, j) = bernstein(triangle, n, grid[static_cast<std::size_t>(j)], t);
    for (int k = 0; k < facet.count; ++k) value(i, k) = shape[static_cast<std::size_t>(k)];
  }
  Net net{basis.partialPivLu().solve(value), {}};
  const auto number = [&](int i, int j) {
    const auto found = std::ranges::find(grid, std::array<int, 2>{i, j});
    return found == grid.end() ? -1 : static_cast<int>(found - grid.begin());
  };
  for (const auto& [i, j] : grid)
    for (std::size_t d = 0; d < 2; ++d)
      if (const int next = d == 0 ? number(i + 1, j) : number(i, j + 1); next >= 0)
        net.tangents[d].push_back({next, number(i, j)});
  return net;
}

double lever_of(const SurfaceFacet& facet) {
  const bool triangle = cell::is_triangle(facet.type);
  constexpr int samples = 16;
  double most = 1;
  for (int i = 0; i <= samples; ++i)
    for (int j = 0; j <= (triangle ? samples - i : samples); ++j) {
      double sum = 0;
      const Vec2 t(static_cast<double>(i) / samples, static_cast<double>(j) / samples);
      const Vec2 xi = facet.patch ? inside_of(triangle, t) : place_in(triangle, t);
      for (const double n : values_at(facet, xi)) sum += std::abs(n);
      most = std::max(most, sum);
    }
  if (facet.patch) return 1.3 * most;  // rational: also a little beyond its borders
  return facet.count > 4 ? 1.05 * most : most;
}

bool is_polynomial(const SurfaceFacet& facet) { return is_plain(facet); }
int type_of(const SurfaceFacet& facet) { return facet.patch ? -1 : static_cast<int>(facet.type); }

// ---- both ---------------------------------------------------------------------------------------

template <int Dim, class AnyFacet>
Eigen::Matrix<double, Eigen::Dynamic, Dim> nodes_of_moving(const AnyFacet& facet,
                                                           std::span<const Vec<Dim>> x) {
  Eigen::Matrix<double, Eigen::Dynamic, Dim> out(facet.count, Dim);
  for (int k = 0; k < facet.count; ++k)
    out.row(k) = x[static_cast<std::size_t>(facet.nodes[static_cast<std::size_t>(k)])].transpose();
  return out;
}

template <int Dim>
std::vector<MovingVector<Dim>> tangents_of(
    const Net& net, std::size_t direction,
    const Eigen::Matrix<double, Eigen::Dynamic, Dim>& nodes) {
  std::vector<MovingVector<Dim>> out;
  for (const auto& [to, from] : net.tangents[direction]) {
    const Eigen::RowVectorXd w = net.weight.row(to) - net.weight.row(from);
    out.push_back({(w * nodes).transpose(), w.cwiseAbs().sum()});
  }
  return out;
}

/// Levers of products hold for motions up to `reach`.
std::vector<MovingVector<2>> normals_of_net(const Net& net,
                                            const Eigen::Matrix<double, Eigen::Dynamic, 2>& nodes,
                                            double /*reach*/) {
  std::vector<MovingVector<2>> out = tangents_of<2>(net, 0, nodes);
  for (MovingVector<2>& n : out) n.value = turn(n.value);
  return out;
}
std::vector<MovingVector<3>> normals_of_net(const Net& net,
                                            const Eigen::Matrix<double, Eigen::Dynamic, 3>& nodes,
                                            double reach) {
  std::vector<MovingVector<3>> out;
  const std::vector<MovingVector<3>> along = tangents_of<3>(net, 0, nodes),
                                     across = tangents_of<3>(net, 1, nodes);
  for (const MovingVector<3>& a : along)
    for (const MovingVector<3>& b : across)
      out.push_back({a.value.cross(b.value), a.lever * b.value.norm() + b.lever * a.value.norm() +
                                                 a.lever * b.lever * reach});
  return out;
}

template <int Dim>
projection::Cone<Dim> cone_of_normals(const std::vector<MovingVector<Dim>>& normals, double reach) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const MovingVector<Dim>& n : normals) {
    const double length = n.value.norm();
    if (!(n.lever * reach < length)) return {};
    sum += n.value / length;
  }
  if (!(sum.norm() > 0)) return {};
  projection::Cone<Dim> cone{sum.normalized(), 0};
  for (const MovingVector<Dim>& n : normals) {
    const double length = n.value.norm(), cosine = n.value.dot(cone.axis) / length;
    const double turned = std::asin(n.lever * reach / length);
    cone.angle = std::max(cone.angle, std::acos(std::clamp(cosine, -1.0, 1.0)) + turned);
  }
  constexpr double rounding = 1e-7;
  cone.angle += rounding;
  return cone;
}

template <int Dim>
void set_box(const search::Box<Dim>& hull, const Eigen::Matrix<double, Eigen::Dynamic, Dim>& nodes,
             MovingFacet<Dim>& out) {
  if (out.points.empty()) {  // a rational patch lies in the hull; and a little beyond its borders
    const Eigen::Matrix<double, 1, Dim> middle = nodes.colwise().mean();
    out.box = hull;
    out.box.inflate(0.5 * (nodes.rowwise() - middle).rowwise().norm().maxCoeff());
    return;
  }
  for (const MovingVector<Dim>& p : out.points) out.box.extend(p.value);
}

}  // namespace

template <int Dim>
std::vector<MovingFacet<Dim>> MovingFacets<Dim>::of(
    const Boundary<Dim>& boundary, std::type_identity_t<std::span<const Vec<Dim>>> x,
    double reach) {
  std::vector<search::Box<Dim>> hulls;
  facet_boxes(boundary, x, hulls);
  std::vector<MovingFacet<Dim>> out(boundary.facets.size());
  for (std::size_t f = 0; f < out.size(); ++f) {
    const auto& facet = boundary.facets[f];
    if (facet.shape) {
      out[f].box = hulls[f];
      continue;
    }
    const int type = type_of(facet);
    if (type < 0 || !levers_.contains(type)) levers_[type] = lever_of(facet);
    out[f].lever = levers_[type];
    const auto nodes = nodes_of_moving<Dim>(facet, x);
    if (is_polynomial(facet)) {
      if (type < 0 || !nets_.contains(type)) nets_[type] = net_of(facet);
      const Net& net = nets_[type];
      for (Eigen::Index j = 0; j < net.weight.rows(); ++j)
        out[f].points.push_back(
            {(net.weight.row(j) * nodes).transpose(), net.weight.row(j).cwiseAbs().sum()});
      out[f].normals = normals_of_net(net, nodes, reach);
      out[f].cone = cone_of_normals<Dim>(out[f].normals, reach);
    }
    set_box<Dim>(hulls[f], nodes, out[f]);
  }
  return out;
}

template class MovingFacets<2>;
template class MovingFacets<3>;

}  // namespace osculate::pairing
