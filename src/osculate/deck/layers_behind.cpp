#include "osculate/deck/layers_behind.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "osculate/model/bulk.hpp"
#include "osculate/pairing/closest.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::deck {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

template <int Dim>
void find_cells(BuildContext<Dim>& c) {
  if (!c.cells_of_node.empty()) return;
  c.cells_of_node.resize(c.model().reference.size());
  for (const model::BasicBulkSection<Dim>& section : c.model().sections)
    for (const mesh::CellRef& ref : section.cells)
      for (const Index n : model::cell_nodes(c.model().mesh, ref).nodes)
        c.cells_of_node[at(n)].push_back(ref);
}

template <int Dim>
Vec<Dim> middle(const BuildContext<Dim>& c, const std::span<const Index> nodes) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const Index n : nodes) sum += c.model().reference[at(n)];
  return sum / static_cast<double>(nodes.size());
}

template <int Dim>
void add(const BuildContext<Dim>& c, const mesh::CellRef& ref, double height, double area,
         Layer& sum) {
  const auto section = c.section_of_cell.find({ref.block, ref.cell});
  if (section == c.section_of_cell.end() || !(height > 0) || !(area > 0)) return;
  const Section& s = c.description.sections[at(section->second)];
  const Material* const material = c.description.find_material(s.material.value);
  if (!material) return;
  const auto [young, poisson] = material::unloaded(material->law.value);
  sum.normal += area * young / height;
  sum.shear += area * young / (2 * (1 + poisson)) / height;
  sum.size += area * height;
  sum.area += area;
  sum.thinnest = std::min(sum.thinnest, height);
}

/// Corners of a facet, and its normal times its area.
std::span<const Index> corners(const pairing::Facet& f) { return {f.nodes.data(), 2}; }
std::span<const Index> corners(const pairing::SurfaceFacet& f) {
  return {f.nodes.data(), static_cast<std::size_t>(pairing::edge_count(f))};
}
Vec2 area_vector(const BuildContext<2>& c, std::span<const Index> n) {
  const auto x = [&](std::size_t k) { return c.model().reference[at(n[k])]; };
  return turn(Vec2(x(1) - x(0)));
}
Vec3 area_vector(const BuildContext<3>& c, std::span<const Index> n) {
  const auto x = [&](std::size_t k) { return c.model().reference[at(n[k])]; };
  const Vec3 sum = n.size() == 3 ? Vec3((x(1) - x(0)).cross(x(2) - x(0)))
                                 : Vec3((x(2) - x(0)).cross(x(3) - x(1)));
  return 0.5 * sum;
}

template <int Dim, class Facet>
LayerSum layer_behind(const BuildContext<Dim>& c, const Facet& facet) {
  LayerSum layer;
  if (facet.shape) return layer;
  const std::span<const Index> n = corners(facet);
  const auto is_rigid = [&](Index k) { return c.model().body_of_node[at(k)] >= 0; };
  if (std::all_of(n.begin(), n.end(), is_rigid)) return layer;
  for (const mesh::CellRef& ref : c.cells_of_node[at(n[0])]) {
    const std::span<const Index> nodes = model::cell_nodes(c.model().mesh, ref).nodes;
    const auto inside = [&](Index k) {
      return std::find(nodes.begin(), nodes.end(), k) != nodes.end();
    };
    if (!std::all_of(n.begin(), n.end(), inside)) continue;
    const Vec<Dim> normal = area_vector(c, n);
    const double area = normal.norm();
    if (!(area > 0)) continue;
    const double distance = std::abs(normal.dot(middle(c, nodes) - middle(c, n))) / area;
    add(c, ref, 2 * distance, area, layer.sum);
  }
  return layer;
}

template <int Dim>
LayerSum layer_around(const BuildContext<Dim>& c, Index node) {
  LayerSum layer;
  if (c.model().body_of_node[at(node)] >= 0) return layer;
  for (const mesh::CellRef& ref : c.cells_of_node[at(node)]) {
    const std::span<const Index> nodes = model::cell_nodes(c.model().mesh, ref).nodes;
    const double distance = (middle(c, nodes) - c.model().reference[at(node)]).norm();
    const double height = 2 * distance / std::sqrt(static_cast<double>(Dim));
    add(c, ref, height, std::pow(height, Dim - 1), layer.sum);
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
                                            const pairing::ProjectedPoint<Dim>& placed) const {
    constexpr double nothing = 1e-6;
    const auto& facet = side.facets[at(placed.projection.facet)];
    std::vector<Index> shared;
    bool first = true;
    for (std::size_t k = 0; k < at(placed.count); ++k) {
      if (!(std::abs(placed.shape[0][k]) > nothing)) continue;
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
std::vector<LayerSum> layers_behind(BuildContext<Dim>& c, const pairing::Boundary<Dim>& side) {
  find_cells(c);
  std::vector<LayerSum> layers;
  for (const auto& facet : side.facets) layers.push_back(layer_behind(c, facet));
  return layers;
}

template <int Dim>
std::vector<LayerSum> layers_behind(BuildContext<Dim>& c, const std::vector<Index>& nodes) {
  find_cells(c);
  std::vector<LayerSum> layers;
  for (const Index node : nodes) layers.push_back(layer_around(c, node));
  return layers;
}

template <int Dim>
std::vector<Layer> layers_at_points(BuildContext<Dim>& c, const pairing::SlaveSide<Dim>& slave,
                                    const std::vector<LayerSum>& of_facets) {
  find_cells(c);
  std::vector<Layer> layers;
  std::vector<LayerSum> here;
  for (std::size_t i = 0; i < slave.points.size(); ++i) {
    const pairing::SlavePoint<Dim>& point = slave.points[i];
    here.clear();
    if (!point.is_node()) {
      here.push_back(of_facets[at(point.facet)]);
    } else {
      for (const Index f : slave.facets_of[i]) here.push_back(of_facets[at(f)]);
      if (here.empty()) here.push_back(layer_around(c, point.nodes[0]));
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
    for (const Index f : facets.at_place(pair.master, place(pair.master, p, query.point, x)))
      there.push_back(of_facets[at(f)]);
    layers[i] = beside(there);
  }
  return layers;
}

template std::vector<LayerSum> layers_behind(BuildContext<2>&, const pairing::Chain&);
template std::vector<LayerSum> layers_behind(BuildContext<3>&, const pairing::FacetSurface&);
template std::vector<LayerSum> layers_behind(BuildContext<2>&, const std::vector<Index>&);
template std::vector<LayerSum> layers_behind(BuildContext<3>&, const std::vector<Index>&);
template std::vector<Layer> layers_at_points(BuildContext<2>&, const pairing::SlaveSide<2>&,
                                             const std::vector<LayerSum>&);
template std::vector<Layer> layers_at_points(BuildContext<3>&, const pairing::SlaveSide<3>&,
                                             const std::vector<LayerSum>&);
template std::vector<Layer> layers_facing(const pairing::PairDefinition<2>&,
                                          const std::vector<Vec2>&, const std::vector<LayerSum>&,
                                          const Layer&);
template std::vector<Layer> layers_facing(const pairing::PairDefinition<3>&,
                                          const std::vector<Vec3>&, const std::vector<LayerSum>&,
                                          const Layer&);

}  // namespace osculate::deck
