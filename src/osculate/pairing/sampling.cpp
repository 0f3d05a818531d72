#include "osculate/pairing/point_normal.hpp"

#include <numeric>
#include <optional>

#include "osculate/cell/quadrature.hpp"
#include "osculate/core/error.hpp"
#include "osculate/pairing/area_element.hpp"
#include "osculate/pairing/cut_facets.hpp"

namespace osculate::pairing {
namespace {

/// Weighted places of a facet's reference cell.
template <int Dim>
struct Rule {
  std::vector<Vec<Dim - 1>> places;
  std::vector<double> weights;

  void add(const Vec<Dim - 1>& place, double weight) {
    constexpr double same = 1e-12;
    for (std::size_t i = 0; i < places.size(); ++i)
      if ((places[i] - place).norm() < same) {
        weights[i] += weight;
        return;
      }
    places.push_back(place);
    weights.push_back(weight);
  }
};

Rule<2> line_rule(const Sampling& s) {
  const cell::Quadrature1D q = s.rule == Sampling::Rule::gauss ? cell::gauss_legendre(s.points)
                                                               : cell::gauss_lobatto(s.points);
  Rule<2> rule;
  const double part = 2.0 / s.subdomains;
  for (int d = 0; d < s.subdomains; ++d)
    for (std::size_t i = 0; i < q.points.size(); ++i)
      rule.add(Vec<1>(-1 + part * (d + 0.5 * (1 + q.points[i]))), q.weights[i] / s.subdomains);
  return rule;
}

Rule<3> square_rule(const Sampling& s) {
  const Rule<2> line = line_rule(s);
  Rule<3> rule;
  for (std::size_t i = 0; i < line.places.size(); ++i)
    for (std::size_t j = 0; j < line.places.size(); ++j)
      rule.add(Vec2(line.places[i][0], line.places[j][0]), line.weights[i] * line.weights[j]);
  return rule;
}

Rule<3> whole_triangle(const Sampling& s) {
  Rule<3> rule;
  if (s.rule == Sampling::Rule::lobatto) {
    if (s.points > 3)
      throw core::GeometryError(
          "triangles have no Lobatto rule of more than 3 points; use gauss or subdomains");
    const double corner = s.points == 2 ? 1.0 / 6 : 1.0 / 40;
    for (const Vec2& place : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}) rule.add(place, corner);
    if (s.points == 2) return rule;
    for (const Vec2& place : {Vec2(0.5, 0), Vec2(0.5, 0.5), Vec2(0, 0.5)})
      rule.add(place, 1.0 / 15);
    rule.add(Vec2(1.0 / 3, 1.0 / 3), 9.0 / 40);
    return rule;
  }
  constexpr int most_symmetric = 3;
  if (s.points <= most_symmetric) {
    const cell::Quadrature2D q = cell::gauss_triangle(2 * s.points - 1);
    for (std::size_t i = 0; i < q.points.size(); ++i) rule.add(q.points[i], q.weights[i]);
    return rule;
  }
  const cell::Quadrature1D q = cell::gauss_legendre(s.points);
  for (std::size_t i = 0; i < q.points.size(); ++i)
    for (std::size_t j = 0; j < q.points.size(); ++j) {
      const double u = 0.5 * (1 + q.points[i]);
      rule.add(Vec2(u, 0.5 * (1 + q.points[j]) * (1 - u)),
               0.25 * q.weights[i] * q.weights[j] * (1 - u));
    }
  return rule;
}

/// The rule on each of n^2 equal triangles.
Rule<3> triangle_rule(const Sampling& s) {
  const Rule<3> whole = whole_triangle(s);
  Rule<3> rule;
  const int n = s.subdomains;
  const auto add = [&](const Vec2& origin, double direction) {
    for (std::size_t i = 0; i < whole.places.size(); ++i)
      rule.add((origin + direction * whole.places[i]) / n, whole.weights[i] / (n * n));
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      add(Vec2(i, j), 1);
      if (i + j + 2 <= n) add(Vec2(i + 1, j + 1), -1);
    }
  return rule;
}

cell::LineShape shape_at(const Facet& facet, const Vec<1>& xi) { return facet_shape(facet, xi[0]); }
cell::FacetShape shape_at(const SurfaceFacet& facet, const Vec2& xi) {
  return facet_shape(facet, xi);
}

Vec2 normal_at(const Facet& facet, const Vec<1>& xi, std::span<const Vec2> x) {
  const Vec2 tangent = facet_jet(facet, xi[0], x).r1;
  return tangent.norm() > 0 ? turn(tangent.normalized()) : Vec2(0, 0);
}
Vec3 normal_at(const SurfaceFacet& facet, const Vec2& xi, std::span<const Vec3> x) {
  return facet_normal(facet, xi, x);
}

/// The rules of the facets' reference cells.
template <int Dim>
struct Rules;
template <>
struct Rules<2> {
  Rule<2> line;
  explicit Rules(const Sampling& s) : line(line_rule(s)) {}
  [[nodiscard]] const Rule<2>& of(const Facet&) const { return line; }
};
template <>
struct Rules<3> {
  Rule<3> square, triangle;
  Rules(const Sampling& s, bool triangles) : square(square_rule(s)) {
    if (triangles) triangle = triangle_rule(s);
  }
  [[nodiscard]] const Rule<3>& of(const SurfaceFacet& facet) const {
    return cell::is_triangle(facet.type) ? triangle : square;
  }
};

Rules<2> rules_for(const SlaveSide<2>&, const Sampling& s) { return Rules<2>(s); }
Rules<3> rules_for(const SlaveSide<3>& side, const Sampling& s) {
  bool triangles = s.cut;
  for (const SurfaceFacet& facet : side.boundary.facets)
    triangles = triangles || cell::is_triangle(facet.type);
  return {s, triangles};
}

/// Adds the rule's places on a part, with weights in the cell.
void add_part(const CellPart<2>& part, const Rules<2>& rules, Rule<2>& out) {
  const double middle = 0.5 * (part.corners[0][0] + part.corners[1][0]);
  const double half = 0.5 * (part.corners[1][0] - part.corners[0][0]);
  for (std::size_t q = 0; q < rules.line.places.size(); ++q)
    out.add(Vec<1>(middle + half * rules.line.places[q][0]), half * rules.line.weights[q]);
}
void add_part(const CellPart<3>& part, const Rules<3>& rules, Rule<3>& out) {
  const cell::CellType type = part.count == 3 ? cell::CellType::tri3 : cell::CellType::quad4;
  const Rule<3>& rule = part.count == 3 ? rules.triangle : rules.square;
  for (std::size_t q = 0; q < rule.places.size(); ++q) {
    const cell::FacetShape s = cell::facet_shape(type, rule.places[q], 1);
    Vec2 at = Vec2::Zero(), along_1 = Vec2::Zero(), along_2 = Vec2::Zero();
    for (std::size_t k = 0; k < static_cast<std::size_t>(part.count); ++k) {
      at += s.n[0][k] * part.corners[k];
      along_1 += s.n[1][k] * part.corners[k];
      along_2 += s.n[2][k] * part.corners[k];
    }
    out.add(at, rule.weights[q] * (along_1.x() * along_2.y() - along_1.y() * along_2.x()));
  }
}

template <int Dim>
double sum_of_weights(const Rule<Dim>& rule) {
  return std::accumulate(rule.weights.begin(), rule.weights.end(), 0.0);
}

template <int Dim>
Rule<Dim> rule_of_parts(const std::vector<CellPart<Dim>>& parts, const Rules<Dim>& rules,
                        const Rule<Dim>& whole) {
  Rule<Dim> rule;
  for (const CellPart<Dim>& part : parts) add_part(part, rules, rule);
  const double scale = sum_of_weights(whole) / sum_of_weights(rule);
  for (double& weight : rule.weights) weight *= scale;
  return rule;
}

template <int Dim>
void add_points(const Rule<Dim>& rule, std::size_t f, bool inside, SlaveSide<Dim>& side) {
  const auto& facet = side.boundary.facets[f];
  for (std::size_t q = 0; q < rule.places.size(); ++q) {
    SlavePoint<Dim> point;
    point.facet = static_cast<Index>(f);
    point.xi = rule.places[q];
    point.weight = rule.weights[q];
    point.inside = inside;
    point.count = facet.count;
    const auto shape = shape_at(facet, point.xi);
    for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k) {
      point.nodes[k] = facet.nodes[k];
      point.shape[k] = shape.n[0][k];
    }
    side.points.push_back(point);
  }
}

}  // namespace

template <int Dim>
void sample(SlaveSide<Dim>& side, const Sampling& sampling, const CutBy<Dim>& by) {
  if (sampling.rule == Sampling::Rule::nodes) {
    sample_nodes(side);
    return;
  }
  for (const std::vector<Index>& facets : side.facets_of)
    if (facets.empty())
      throw core::GeometryError(
          "nodes without facets have no other contact points than themselves");
  const Rules<Dim> rules = rules_for(side, sampling);
  std::optional<FacetCutter<Dim>> cutter;
  if (sampling.cut) cutter.emplace(side.boundary, *by.master, by.x);
  side.points.clear();
  for (std::size_t f = 0; f < side.boundary.facets.size(); ++f) {
    const Rule<Dim>& whole = rules.of(side.boundary.facets[f]);
    const bool inside = sampling.rule == Sampling::Rule::gauss;
    std::vector<CellPart<Dim>> parts;
    if (cutter) parts = cutter->parts(static_cast<Index>(f));
    add_points(parts.empty() ? whole : rule_of_parts(parts, rules, whole), f, inside, side);
  }
}

template <int Dim>
void point_areas(const SlaveSide<Dim>& side, std::type_identity_t<std::span<const Vec<Dim>>> x,
                 const AreaRule& rule, std::vector<double>& areas,
                 std::type_identity_t<std::vector<std::vector<NodeGradient<Dim>>>*> gradients) {
  if (!rule.given.empty()) {
    areas = rule.given;
    if (gradients) gradients->assign(side.points.size(), {});
    return;
  }
  if (sampled_at_nodes(side)) {
    nodal_areas(side, x, rule, areas, gradients);
    return;
  }
  areas.resize(side.points.size());
  if (gradients) gradients->resize(side.points.size());
  for (std::size_t i = 0; i < side.points.size(); ++i) {
    const SlavePoint<Dim>& point = side.points[i];
    const auto& facet = side.boundary.facets[static_cast<std::size_t>(point.facet)];
    const AreaElement<Dim> element = area_element(facet, shape_at(facet, point.xi), x, rule);
    areas[i] = point.weight * element.value;
    if (!gradients) continue;
    (*gradients)[i].clear();
    for (std::size_t k = 0; k < static_cast<std::size_t>(point.count); ++k)
      (*gradients)[i].push_back({point.nodes[k], point.weight * element.gradient[k]});
  }
}

template <int Dim>
Vec<Dim> point_normal(const SlaveSide<Dim>& side, std::type_identity_t<std::span<const Vec<Dim>>> x,
                      std::size_t i) {
  const SlavePoint<Dim>& point = side.points[i];
  if (sampled_at_nodes(side)) return nodal_normal(side, x, i);
  return normal_at(side.boundary.facets[static_cast<std::size_t>(point.facet)], point.xi, x);
}

template <int Dim>
void point_normals(const SlaveSide<Dim>& side, std::type_identity_t<std::span<const Vec<Dim>>> x,
                   std::vector<Vec<Dim>>& normals) {
  if (sampled_at_nodes(side)) {
    nodal_normals(side, x, normals);
    return;
  }
  normals.resize(side.points.size());
  for (std::size_t i = 0; i < side.points.size(); ++i) normals[i] = point_normal<Dim>(side, x, i);
}

template void sample<2>(SlaveSide<2>&, const Sampling&, const CutBy<2>&);
template void sample<3>(SlaveSide<3>&, const Sampling&, const CutBy<3>&);
template void point_areas<2>(const SlaveSide<2>&, std::span<const Vec2>, const AreaRule&,
                             std::vector<double>&, std::vector<std::vector<NodeGradient<2>>>*);
template void point_areas<3>(const SlaveSide<3>&, std::span<const Vec3>, const AreaRule&,
                             std::vector<double>&, std::vector<std::vector<NodeGradient<3>>>*);
template Vec2 point_normal<2>(const SlaveSide<2>&, std::span<const Vec2>, std::size_t);
template Vec3 point_normal<3>(const SlaveSide<3>&, std::span<const Vec3>, std::size_t);
template void point_normals<2>(const SlaveSide<2>&, std::span<const Vec2>, std::vector<Vec2>&);
template void point_normals<3>(const SlaveSide<3>&, std::span<const Vec3>, std::vector<Vec3>&);

}  // namespace osculate::pairing
