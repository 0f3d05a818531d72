#pragma once
// Contact pairs and rigid tools of many shapes, built by hand.
#include "block.hpp"
#include "osculate/geometry/interpolation.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::model {

struct PairChoices {
  double mu = 0;
  pairing::Weight weight = pairing::Weight::reference_area;
  contact::ResidualForm residual = contact::ResidualForm::surface;
  pairing::Sampling sampling{};
  double eps_n = 500, eps_t = 300;
};

inline pairing::AreaRule area_rule(const solid::Section<2>& section) {
  return {section.thickness, section.assumption == solid::Assumption::axisymmetric};
}
inline pairing::AreaRule area_rule(const solid::Section<3>&) { return {}; }

template <int Dim>
void add_pair(BasicModel<Dim>& m, pairing::Boundary<Dim> master, pairing::Boundary<Dim> slave,
              const PairChoices& choices = {}) {
  BasicContactPair<Dim> pair;
  pair.name = "c";
  pairing::PairDefinition<Dim>& d = pair.definition;
  d.master = std::move(master);
  d.slave = pairing::make_slave_side(std::move(slave));
  pairing::sample(d.slave, choices.sampling);
  d.normal = contact::penalty(choices.eps_n);
  if (choices.mu > 0) d.friction = contact::coulomb(choices.mu, choices.eps_t);
  d.weight = choices.weight;
  d.residual = choices.residual;
  d.area = area_rule(m.sections[0].section);
  pairing::prepare<Dim>(d, m.reference);
  m.pairs.push_back(std::move(pair));
}

/// Facets of the sides that a set of the mesh names.
template <int Dim>
pairing::Boundary<Dim> boundary_of(const BasicModel<Dim>& m, const std::string& set,
                                   bool flip = false) {
  pairing::Boundary<Dim> boundary;
  for (const auto& side : sides_of(m, set)) {
    std::vector<Index> nodes(side.nodes().begin(), side.nodes().end());
    if constexpr (Dim == 2) {
      boundary.facets.push_back(pairing::lagrange_facet(nodes));
    } else {
      if (flip) mesh::reverse_area(side.type, nodes);
      boundary.facets.push_back(pairing::surface_facet(side.type, nodes));
    }
  }
  pairing::connect(boundary);
  return boundary;
}

// ---- rigid bodies, each with the surface that is returned ---------------------------------------

/// A body of nodes alone; its reference is their mean.
template <int Dim>
std::vector<Index> add_nodes(BasicModel<Dim>& m, const std::vector<Vec<Dim>>& points) {
  std::vector<Index> nodes;
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const Vec<Dim>& x : points) {
    nodes.push_back(static_cast<Index>(m.reference.size()));
    m.reference.push_back(x);
    sum += x;
  }
  add_rigid<Dim>(m, sum / static_cast<double>(points.size()), nodes);
  return nodes;
}
template <int Dim>
std::array<Index, Dim + 1> add_frame(BasicModel<Dim>& m, const Vec<Dim>& reference,
                                     const Vec<Dim>& origin = Vec<Dim>::Zero()) {
  std::vector<Vec<Dim>> points{origin};
  for (int d = 0; d < Dim; ++d) points.push_back(origin + Vec<Dim>::Unit(d));
  const std::vector<Index> nodes = add_nodes(m, points);
  m.rigid.back().reference = reference;
  std::array<Index, Dim + 1> frame{};
  std::copy(nodes.begin(), nodes.end(), frame.begin());
  return frame;
}
template <int Dim>
pairing::Boundary<Dim> add_shape(BasicModel<Dim>& m, const RigidShape<Dim>& shape,
                                 const Vec<Dim>& reference,
                                 const Vec<Dim>& origin = Vec<Dim>::Zero()) {
  pairing::Boundary<Dim> boundary;
  boundary.facets.push_back(pairing::shape_facet(shape, add_frame<Dim>(m, reference, origin)));
  pairing::connect(boundary);
  return boundary;
}

/// Straight lines, the body on the right of travel.
inline pairing::Chain add_polyline(Model& m, const std::vector<Vec2>& points) {
  const std::vector<Index> nodes = add_nodes<2>(m, points);
  pairing::Chain chain;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
    chain.facets.push_back(pairing::lagrange_facet(std::array{nodes[i], nodes[i + 1]}));
  pairing::connect(chain);
  return chain;
}

inline pairing::Chain add_bar(Model& m) {
  std::vector<Vec2> points;
  for (int i = 0; i < 4; ++i) points.push_back(Vec2(2.4, 0.93) + i / 3.0 * Vec2(-2.8, -0.02));
  return add_polyline(m, points);
}

/// Two corners, one on each side of a smooth curve.
inline pairing::Chain add_composite(Model& m) {
  const auto line = [](const Vec2& a, const Vec2& b) {
    return geometry::Curve(geometry::lagrange_curve(std::array{a, b}));
  };
  pairing::Chain chain;
  pairing::add_curves({line({2.5, 1.2}, {1.6, 0.9}),
                       geometry::graph_through({1.6, 1.2, 0.8, 0.4}, {0.9, 0.88, 0.93, 0.9}),
                       line({0.4, 0.9}, {-0.5, 1.3})},
                      false, add_frame<2>(m, {1, 1.075}), chain);
  pairing::connect(chain);
  return chain;
}

/// Four facets whose lowest point is over the middle of the block; `narrow`: not wider than it.
inline pairing::FacetSurface add_dome(Model3& m, bool narrow = false) {
  std::vector<Vec3> points;
  for (const double y : {-0.4, 0.45, 1.4})
    for (const double x : {-0.5, 0.9, 2.6}) {
      const double z = 0.95 + 0.02 * ((x - 1) * (x - 1) + (y - 0.5) * (y - 0.5));
      points.emplace_back(narrow ? std::clamp(x, 0.1, 1.9) : x,
                          narrow ? std::clamp(y, 0.1, 0.9) : y, z);
    }
  const std::vector<Index> nodes = add_nodes<3>(m, points);
  m.rigid.back().reference = {0.9, 0.6, 2};
  pairing::FacetSurface surface;
  for (const std::size_t k : {0u, 1u, 3u, 4u})  // r_1 x r_2 points down
    surface.facets.push_back(pairing::surface_facet(
        cell::CellType::quad4, std::array{nodes[k], nodes[k + 3], nodes[k + 4], nodes[k + 1]}));
  pairing::connect(surface);
  return surface;
}

/// A tool over a block of height 1, which it overlaps by about 0.1, with its number of points in
/// contact.
template <int Dim>
struct Tool {
  std::string name;
  std::function<pairing::Boundary<Dim>(BasicModel<Dim>&)> add;
  int touching = 0;
};

inline std::vector<Tool<2>> tools(Vec2) {
  const auto shape = [](const std::string& name, const geometry::Curve& curve, const Vec2& at) {
    return Tool<2>{name, [=](Model& m) { return add_shape<2>(m, curve, at); }, 3};
  };
  const double degree = std::acos(-1.0) / 180;
  Tool<2> line = shape("line", geometry::InfiniteLine{{1, 0.89}, {0.1, -1}}, {1, 0.89});
  line.touching = 5;
  const std::vector<Vec2> points{{2.5, 1.2}, {1.2, 0.9}, {0.3, 0.95}, {-0.5, 1.3}};
  const geometry::NurbsCurve nurbs{
      2, {0, 0, 0, 1, 1, 1}, {{2.5, 1.3}, {1, 0.4}, {-0.5, 1.3}}, {1, 0.8, 1}};
  return {shape("circle", geometry::Circle{{1, 3.9}, 3}, {1, 3.9}),
          shape("arc", geometry::Arc{{1, 3.9}, 3, 200 * degree, 340 * degree}, {1, 3.9}),
          shape("nurbs", nurbs, {1, 1}),
          line,
          {"polyline", [=](Model& m) { return add_polyline(m, points); }, 3},
          {"composite", [](Model& m) { return add_composite(m); }, 3},
          {"meshed", [](Model& m) { return add_bar(m); }, 5}};
}
inline std::vector<Tool<3>> tools(Vec3) {
  const geometry::Plane plane{Vec3(0.8, 0.4, -0.55), Vec3(0.02, 0.01, -1)};
  return {{"dome", [](Model3& m) { return add_dome(m); }, 9},
          {"plane",
           [=](Model3& m) {
             return add_shape<3>(m, plane, {0.9, 0.6, 2}, {0.2, 0.1, 1.5});
           },
           9}};
}
template <int Dim>
std::vector<Tool<Dim>> tools() {
  return tools(Vec<Dim>{});
}
/// The tool whose points may be slaves; those at its border lie beside or above the block.
inline pairing::Chain add_slaves(Model& m) { return add_bar(m); }
inline pairing::FacetSurface add_slaves(Model3& m) { return add_dome(m, true); }

/// A block under the tool, held at its bottom.
template <int Dim>
BasicModel<Dim> block_under(const Tool<Dim>& tool, const solid::Section<Dim>& section,
                            const PairChoices& choices = {},
                            const std::array<int, 3>& n = {Dim == 2 ? 4 : 2, 2, 2}) {
  BasicModel<Dim> m = block<Dim>({{0, 0, 0}, {2, 1, 1}, n, 0.2}, section);
  hold(m, "block.bottom");
  add_pair<Dim>(m, tool.add(m), boundary_of(m, "block.top"), choices);
  return m;
}

}  // namespace osculate::model
