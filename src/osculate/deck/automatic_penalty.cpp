// `penalty: auto`: the stiffness of a contact from that of the bodies behind it.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/deck/build_contact_parts.hpp"
#include "osculate/model/bulk.hpp"

namespace osculate::deck {
namespace {

/// Stiffness per area of the layer of cells behind one side, averaged over its area. All zero: the
/// side is rigid.
struct Layer {
  double normal = 0;  ///< E / height
  double shear = 0;   ///< G / height
  double size = 0;    ///< height of the cells
  double area = 0;
};

template <int Dim>
void find_cells(BuildContext<Dim>& c) {
  if (!c.cells_of_node.empty()) return;
  c.cells_of_node.resize(c.model().reference.size());
  for (const model::BasicBulkSection<Dim>& section : c.model().sections)
    for (const mesh::CellRef& ref : section.cells)
      for (const Index n : model::cell_nodes(c.model().mesh, ref).nodes)
        c.cells_of_node[static_cast<std::size_t>(n)].push_back(ref);
}

template <int Dim>
Vec<Dim> middle(const BuildContext<Dim>& c, const std::span<const Index> nodes) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const Index n : nodes) sum += c.model().reference[static_cast<std::size_t>(n)];
  return sum / static_cast<double>(nodes.size());
}

template <int Dim>
void add(const BuildContext<Dim>& c, const mesh::CellRef& ref, double height, double area,
         Layer& layer) {
  const auto section = c.section_of_cell.find({ref.block, ref.cell});
  if (section == c.section_of_cell.end() || !(height > 0) || !(area > 0)) return;
  const Section& s = c.description.sections[static_cast<std::size_t>(section->second)];
  const Material* const material = c.description.find_material(s.material.value);
  if (!material) return;
  const double young = material->young.value;
  layer.normal += area * young / height;
  layer.shear += area * young / (2 * (1 + material->poisson.value)) / height;
  layer.size += area * height;
  layer.area += area;
}

/// Corners of a facet, and its normal times its area.
std::span<const Index> corners(const pairing::Facet& f) { return {f.nodes.data(), 2}; }
std::span<const Index> corners(const pairing::SurfaceFacet& f) {
  return {f.nodes.data(), static_cast<std::size_t>(pairing::edge_count(f))};
}
Vec2 area_vector(const BuildContext<2>& c, std::span<const Index> n) {
  const auto x = [&](std::size_t k) { return c.model().reference[static_cast<std::size_t>(n[k])]; };
  return turn(Vec2(x(1) - x(0)));
}
Vec3 area_vector(const BuildContext<3>& c, std::span<const Index> n) {
  const auto x = [&](std::size_t k) { return c.model().reference[static_cast<std::size_t>(n[k])]; };
  const Vec3 sum = n.size() == 3 ? Vec3((x(1) - x(0)).cross(x(2) - x(0)))
                                 : Vec3((x(2) - x(0)).cross(x(3) - x(1)));
  return 0.5 * sum;
}

/// The height of the cell behind a facet is twice the distance of its middle.
template <int Dim>
Layer layer_behind(const BuildContext<Dim>& c, const pairing::Boundary<Dim>& side) {
  Layer layer;
  for (const auto& facet : side.facets) {
    if (facet.shape) continue;
    const std::span<const Index> n = corners(facet);
    const auto is_rigid = [&](Index k) {
      return c.model().body_of_node[static_cast<std::size_t>(k)] >= 0;
    };
    if (std::all_of(n.begin(), n.end(), is_rigid)) continue;
    for (const mesh::CellRef& ref : c.cells_of_node[static_cast<std::size_t>(n[0])]) {
      const std::span<const Index> nodes = model::cell_nodes(c.model().mesh, ref).nodes;
      const auto inside = [&](Index k) {
        return std::find(nodes.begin(), nodes.end(), k) != nodes.end();
      };
      if (!std::all_of(n.begin(), n.end(), inside)) continue;
      const Vec<Dim> normal = area_vector(c, n);
      const double area = normal.norm();
      if (!(area > 0)) continue;
      const double distance = std::abs(normal.dot(middle(c, nodes) - middle(c, n))) / area;
      add(c, ref, 2 * distance, area, layer);
    }
  }
  return layer;
}

/// Points without facets: the height of a cube whose middle is as far away.
template <int Dim>
Layer layer_behind(const BuildContext<Dim>& c, const std::vector<Index>& points) {
  Layer layer;
  for (const Index n : points) {
    if (c.model().body_of_node[static_cast<std::size_t>(n)] >= 0) continue;
    for (const mesh::CellRef& ref : c.cells_of_node[static_cast<std::size_t>(n)]) {
      const std::span<const Index> nodes = model::cell_nodes(c.model().mesh, ref).nodes;
      const double distance =
          (middle(c, nodes) - c.model().reference[static_cast<std::size_t>(n)]).norm();
      const double height = 2 * distance / std::sqrt(static_cast<double>(Dim));
      add(c, ref, height, std::pow(height, Dim - 1), layer);
    }
  }
  return layer;
}

/// Two layers behind each other give way one after the other; a rigid one does not.
double in_series(double a, double b) { return a > 0 && b > 0 ? a * b / (a + b) : a + b; }

void average(Layer& layer) {
  if (!(layer.area > 0)) return;
  layer.normal /= layer.area;
  layer.shear /= layer.area;
  layer.size /= layer.area;
}

/// Area that belongs to one slave point: what a penalty per area becomes per node.
template <int Dim>
double area_per_point(const BuildContext<Dim>& c, const pairing::PairDefinition<Dim>& pair,
                      const core::SourceMark& mark) {
  pairing::PairDefinition<Dim> measured = pair;
  measured.weight = pairing::Weight::reference_area;
  double sum = 0;
  try {
    pairing::prepare(measured, c.model().reference);
    for (const double area : measured.reference_areas) sum += area;
  } catch (const core::GeometryError&) {
    sum = 0;
  }
  if (!(sum > 0))
    throw core::InputError(mark,
                           "'auto' needs an area for each slave point, and these have none: give a "
                           "number, or facets as the slave");
  return sum / static_cast<double>(measured.reference_areas.size());
}

}  // namespace

template <int Dim>
void set_automatic(BuildContext<Dim>& c, const Contact& contact,
                   model::BasicContactPair<Dim>& out) {
  find_cells(c);
  pairing::PairDefinition<Dim>& pair = out.definition;
  const pairing::Boundary<Dim>& facets = pair.slave.boundary;
  Layer slave = facets.facets.empty() ? layer_behind(c, pair.slave.nodes) : layer_behind(c, facets);
  Layer master = layer_behind(c, pair.master);
  average(slave);
  average(master);
  out.height = slave.size > 0 && master.size > 0 ? std::min(slave.size, master.size)
                                                 : slave.size + master.size;
  out.automatic = contact.automatic;
  const bool shear = contact.friction && contact.friction->automatic;
  if (!contact.automatic && !shear) return;
  const core::SourceMark& mark =
      contact.automatic ? contact.normal_penalty.mark : contact.friction->penalty.mark;
  const double normal = in_series(slave.normal, master.normal);
  if (!(normal > 0))
    throw core::InputError(
        mark,
        fmt::format("'auto' finds no deformable cell behind the facets of '{}': give a number",
                    out.name));
  const double per = pair.weight == pairing::Weight::node ? area_per_point(c, pair, mark) : 1.0;
  if (contact.automatic) pair.normal = contact::NormalPenalty{automatic_factor * normal * per};
  if (shear)
    std::visit(
        [&](auto& law) {
          law.stiffness = automatic_factor * in_series(slave.shear, master.shear) * per;
        },
        *pair.friction);
}

template void set_automatic(BuildContext<2>&, const Contact&, model::ContactPair&);
template void set_automatic(BuildContext<3>&, const Contact&, model::ContactPair3&);

}  // namespace osculate::deck
