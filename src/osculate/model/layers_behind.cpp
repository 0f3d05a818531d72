#include "osculate/model/layers_behind.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "osculate/model/bulk.hpp"
#include "osculate/pairing/closest.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::model {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

template <int Dim>
Vec<Dim> middle(const BasicModel<Dim>& model, const std::span<const Index> nodes) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const Index n : nodes) sum += model.reference[at(n)];
  return sum / static_cast<double>(nodes.size());
}

template <class Cell>
void add(const Cell& cell, double height, double area, Layer& sum) {
  if (!(height > 0) || !(area > 0)) return;
  sum.normal += area * cell.young / height;
  sum.shear += area * cell.shear / height;
  sum.size += area * height;
  sum.area += area;
  sum.thinnest = std::min(sum.thinnest, height);
}

/// Corners of a facet, and its normal times its area.
std::span<const Index> corners(const pairing::Facet& f) { return {f.nodes.data(), 2}; }
std::span<const Index> corners(const pairing::SurfaceFacet& f) {
  return {f.nodes.data(), static_cast<std::size_t>(pairing::edge_count(f))};
}
Vec2 area_vector(const Model& m, std::span<const Index> n) {
  const auto x = [&](std::size_t k) { return m.reference[at(n[k])]; };
  return turn(Vec2(x(1) - x(0)));
}
Vec3 area_vector(const Model3& m, std::span<const Index> n) {
  const auto x = [&](std::size_t k) { return m.reference[at(n[k])]; };
  const Vec3 sum = n.size() == 3 ? Vec3((x(1) - x(0)).cross(x(2) - x(0)))
                                 : Vec3((x(2) - x(0)).cross(x(3) - x(1)));
  return 0.5 * sum;
}

template <int Dim, class Facet>
LayerSum layer_behind(const BasicModel<Dim>& m, const CellsOfNodes<Dim>& cells,
                      const Facet& facet) {
  LayerSum layer;
  if (facet.shape) return layer;
  const std::span<const Index> n = corners(facet);
  const auto is_rigid = [&](Index k) { return m.body_of_node[at(k)] >= 0; };
  if (std::all_of(n.begin(), n.end(), is_rigid)) return layer;
  for (const auto& cell : cells.at[at(n[0])]) {
    const std::span<const Index> nodes = cell_nodes(m.mesh, cell.ref).nodes;
    const auto inside = [&](Index k) {
      return std::find(nodes.begin(), nodes.end(), k) != nodes.end();
    };
    if (!std::all_of(n.begin(), n.end(), inside)) continue;
    const Vec<Dim> normal = area_vector(m, n);
    const double area = normal.norm();
    if (!(area > 0)) continue;
    const double distance = std::abs(normal.dot(middle(m, nodes) - middle(m, n))) / area;
    add(cell, 2 * distance, area, layer.sum);
  }
  return layer;
}

template <int Dim>
LayerSum layer_around(const BasicModel<Dim>& m, const CellsOfNodes<Dim>& cells, Index node) {
  LayerSum layer;
  if (m.body_of_node[at(node)] >= 0) return layer;
  for (const auto& cell : cells.at[at(node)]) {
    const std::span<const Index> nodes = cell_nodes(m.mesh, cell.ref).nodes;
    const double distance = (middle(m, nodes) - m.reference[at(node)]).norm();
    const double height = 2 * distance / std::sqrt(static_cast<double>(Dim));
    add(cell, height, std::pow(height, Dim - 1), layer.sum);
  }
  return layer;
}

/// Facets of a boundary by their nodes.
template <int Dim>
struct FacetsOfNodes {
  std::unordered_map<Index, std::vector<Index>> of_node;

  explicit FacetsOfNodes(const pairing::Boundary<Dim>& side) {
    for (std::size_t f = 0; f < side.facets.size(); ++f)
      for (std::size_t k = 0; k < at(side.facets[f].count); ++k)
        of_node[side.facets[f].nodes[k]].push_back(static_cast<Index>(f));
  }
  /// Those that share the place: they have all nodes that have a part in it.
  [[nodiscard]] std::vector<Index> at_place(const pairing::Boundary<Dim>& side,
                                            const pairing::ProjectedPoint<Dim>& projected) const {
    constexpr double nothing = 1e-6;
    const auto& facet = side.facets[at(projected.projection.facet)];
    std::vector<Index> shared;
    bool first = true;
    for (std::size_t k = 0; k < at(projected.count); ++k) {
      if (!(std::abs(projected.shape[0][k]) > nothing)) continue;
      const std::vector<Index>& around = of_node.at(facet.nodes[k]);
      if (first) shared = around;
      first = false;
      std::erase_if(shared, [&](Index f) {
        return std::find(around.begin(), around.end(), f) == around.end();
      });
    }
    return shared;
  }
};

/// Bodies of `contact: all` that are too far apart to look at each other.
template <int Dim>
bool beyond_search(const pairing::PairDefinition<Dim>& pair, const std::vector<Vec<Dim>>& reference,
                   const std::vector<search::Box<Dim>>& boxes) {
  if (!pair.filter.limited()) return false;
  search::Box<Dim> master, slave;
  for (const search::Box<Dim>& box : boxes) master.extend(box);
  for (const Index node : pair.slave.nodes) slave.extend(reference[at(node)]);
  return master.squared_distance(slave) > pair.filter.distance * pair.filter.distance;
}

}  // namespace

template <int Dim>
CellsOfNodes<Dim>::CellsOfNodes(const BasicModel<Dim>& model) : at(model.reference.size()) {
  for (const BasicBulkSection<Dim>& section : model.sections) {
    const auto [young, poisson] = material::unloaded(section.section.law);
    for (const mesh::CellRef& ref : section.cells)
      for (const Index n : cell_nodes(model.mesh, ref).nodes)
        at[static_cast<std::size_t>(n)].push_back({ref, young, young / (2 * (1 + poisson))});
  }
}

Layer beside(std::span<const LayerSum> layers) {
  Layer all;
  for (const LayerSum& l : layers) {
    all.normal += l.sum.normal;
    all.shear += l.sum.shear;
    all.size += l.sum.size;
    all.area += l.sum.area;
    all.thinnest = std::min(all.thinnest, l.sum.thinnest);
  }
  if (!(all.area > 0)) return all;
  all.normal /= all.area;
  all.shear /= all.area;
  all.size /= all.area;
  return all;
}

template <int Dim>
std::vector<LayerSum> layers_behind(const BasicModel<Dim>& m, const CellsOfNodes<Dim>& cells,
                                    const pairing::Boundary<Dim>& side) {
  std::vector<LayerSum> layers;
  for (const auto& facet : side.facets) layers.push_back(layer_behind(m, cells, facet));
  return layers;
}

template <int Dim>
std::vector<LayerSum> layers_behind(const BasicModel<Dim>& m, const CellsOfNodes<Dim>& cells,
                                    const std::vector<Index>& nodes) {
  std::vector<LayerSum> layers;
  for (const Index node : nodes) layers.push_back(layer_around(m, cells, node));
  return layers;
}

template <int Dim>
std::vector<Layer> layers_at_points(const BasicModel<Dim>& m, const CellsOfNodes<Dim>& cells,
                                    const pairing::SlaveSide<Dim>& slave,
                                    const std::vector<LayerSum>& of_facets) {
  std::vector<Layer> layers;
  std::vector<LayerSum> here;
  for (std::size_t i = 0; i < slave.points.size(); ++i) {
    const pairing::SlavePoint<Dim>& point = slave.points[i];
    here.clear();
    if (!point.is_node()) {
      here.push_back(of_facets[at(point.facet)]);
    } else {
      for (const Index f : slave.facets_of[i]) here.push_back(of_facets[at(f)]);
      if (here.empty()) here.push_back(layer_around(m, cells, point.nodes[0]));
    }
    layers.push_back(beside(here));
  }
  return layers;
}

template <int Dim>
std::vector<Layer> layers_facing(const pairing::PairDefinition<Dim>& pair,
                                 const std::vector<Vec<Dim>>& reference,
                                 const std::vector<LayerSum>& of_facets, const Layer& otherwise) {
  const std::span<const Vec<Dim>> x(reference);
  std::vector<Layer> layers(pair.slave.points.size(), otherwise);
  if (pair.filter.own || !(otherwise.area > 0)) return layers;
  std::vector<search::Box<Dim>> boxes;
  facet_boxes(pair.master, x, boxes);
  if (beyond_search(pair, reference, boxes)) return layers;
  const pairing::Tree<Dim> tree(boxes);
  const FacetsOfNodes<Dim> facets(pair.master);
  std::vector<Vec<Dim>> normals;
  pairing::point_normals<Dim>(pair.slave, x, normals);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    pairing::ProjectionQuery<Dim> query;
    query.point = pairing::position<Dim>(pair.slave.points[i], x);
    if (normals[i].squaredNorm() > 0) query.slave_normal = normals[i];
    bool near = !pair.filter.limited();
    if (!near) tree.for_each_within(query.point, pair.filter.distance, [&](Index) { near = true; });
    if (!near) continue;
    const pairing::Projection<Dim> p = closest(pair.master, tree, x, query);
    if (p.feature == projection::Feature::none) continue;
    std::vector<LayerSum> there;
    for (const Index f :
         facets.at_place(pair.master, projected_point(pair.master, p, query.point, x)))
      there.push_back(of_facets[at(f)]);
    layers[i] = beside(there);
  }
  return layers;
}

template struct CellsOfNodes<2>;
template struct CellsOfNodes<3>;
template std::vector<LayerSum> layers_behind(const Model&, const CellsOfNodes<2>&,
                                             const pairing::Chain&);
template std::vector<LayerSum> layers_behind(const Model3&, const CellsOfNodes<3>&,
                                             const pairing::FacetSurface&);
template std::vector<LayerSum> layers_behind(const Model&, const CellsOfNodes<2>&,
                                             const std::vector<Index>&);
template std::vector<LayerSum> layers_behind(const Model3&, const CellsOfNodes<3>&,
                                             const std::vector<Index>&);
template std::vector<Layer> layers_at_points(const Model&, const CellsOfNodes<2>&,
                                             const pairing::SlaveSide<2>&,
                                             const std::vector<LayerSum>&);
template std::vector<Layer> layers_at_points(const Model3&, const CellsOfNodes<3>&,
                                             const pairing::SlaveSide<3>&,
                                             const std::vector<LayerSum>&);
template std::vector<Layer> layers_facing(const pairing::PairDefinition<2>&,
                                          const std::vector<Vec2>&, const std::vector<LayerSum>&,
                                          const Layer&);
template std::vector<Layer> layers_facing(const pairing::PairDefinition<3>&,
                                          const std::vector<Vec3>&, const std::vector<LayerSum>&,
                                          const Layer&);

}  // namespace osculate::model
