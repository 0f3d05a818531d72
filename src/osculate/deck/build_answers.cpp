// What the files of CalculiX need of a model: facets that forces go through, nodes of rigid bodies.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/build_context.hpp"
#include "osculate/model/bulk.hpp"

namespace osculate::deck {
namespace {

std::span<const mesh::Edge> sides_at(const mesh::EdgeTable& table, std::span<const Index> corners) {
  return table.find(corners[0], corners[1]);
}
std::span<const mesh::Face> sides_at(const mesh::FaceTable& table, std::span<const Index> corners) {
  return table.find(corners);
}

template <int Dim>
Vec<Dim> centre_of(const model::BasicModel<Dim>& m, std::span<const Index> nodes) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const Index n : nodes) sum += m.reference[static_cast<std::size_t>(n)];
  return sum / static_cast<double>(nodes.size());
}

/// The mean normal of the corners, not of unit length: k x t in the plane.
Vec2 normal_of(const model::Model& m, std::span<const Index> corners) {
  const auto at = [&](std::size_t k) { return m.reference[static_cast<std::size_t>(corners[k])]; };
  return turn(Vec2(at(1) - at(0)));
}
Vec3 normal_of(const model::Model3& m, std::span<const Index> corners) {
  const auto at = [&](std::size_t k) { return m.reference[static_cast<std::size_t>(corners[k])]; };
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 2; k < corners.size(); ++k) sum += (at(k - 1) - at(0)).cross(at(k) - at(0));
  return sum;
}

void turn_round(cell::CellType type, std::vector<Index>& nodes) {
  if (cell::info(type).dimension == 1)
    std::swap(nodes[0], nodes[1]);
  else
    mesh::reverse_area(type, nodes);
}

/// Of the cells at a facet that whose outward normal is the facet's; on a boundary the only one.
template <int Dim>
CutFacet cut_facet(const BuildContext<Dim>& c, const Name& on, const mesh::CellRef& ref) {
  const model::BasicModel<Dim>& m = c.model();
  const model::CellNodes facet = model::cell_nodes(m.mesh, ref);
  const auto corners = facet.nodes.first(static_cast<std::size_t>(cell::info(facet.type).corners));
  const auto sides = sides_at(c.sides, corners);
  if (sides.empty() || sides.size() > 2)
    throw core::InputError(
        on.mark, fmt::format("SOF: the facet at {} of set '{}' is none of the cells of a section",
                             mesh::describe_node(m.mesh, corners[0]), on.value));
  const Vec<Dim> normal = normal_of(m, corners), at = centre_of<Dim>(m, corners);
  CutFacet out{sides[0].cell, {0, {facet.nodes.begin(), facet.nodes.end()}, facet.type}};
  const auto outwards = [&](const auto& side) {
    return normal.dot(at - centre_of<Dim>(m, model::cell_nodes(m.mesh, side.cell).nodes));
  };
  const auto best = std::ranges::max_element(sides, {}, outwards);
  out.cell = best->cell;
  if (outwards(*best) < 0) turn_round(facet.type, out.side.nodes);
  out.side.section = c.section_of_cell.at({out.cell.block, out.cell.cell});
  return out;
}

template <int Dim>
std::vector<CutFacet> cut_of_set(const BuildContext<Dim>& c, const Name& on) {
  const mesh::Set& set = c.set(on);
  if (set.dimension != Dim - 1 || set.cells.empty())
    throw core::InputError(on.mark, fmt::format("SOF: set '{}' has no {}, through which a force "
                                                "goes",
                                                on.value, Dim == 2 ? "lines" : "facets"));
  std::vector<CutFacet> cut;
  for (const mesh::CellRef& ref : set.cells) cut.push_back(cut_facet(c, on, ref));
  return cut;
}

template <int Dim>
void add_body_nodes(BuildContext<Dim>& c, const std::vector<Name>& sets, BodyNode what) {
  for (const Name& on : sets) {
    const std::vector<Index>& nodes = c.set(on).nodes;
    if (nodes.size() != 1)
      throw core::InputError(
          on.mark, fmt::format("set '{}' has {} nodes, expected one", on.value, nodes.size()));
    if (!c.built.body_nodes.try_emplace(nodes[0], what).second)
      throw core::InputError(on.mark, fmt::format("{} stands for another motion already",
                                                  mesh::describe_node(c.model().mesh, nodes[0])));
  }
}

}  // namespace

template <int Dim>
void build_answers(BuildContext<Dim>& c) {
  for (const AnswerRequest& request : c.description.output.dat) {
    const bool cuts = std::ranges::find(request.of, Answer::sof) != request.of.end();
    for (const Name& on : request.on) {
      (void)c.set(on);
      if (cuts) c.built.cuts[on.value] = cut_of_set(c, on);
    }
  }
  for (const auto& [node, axes] : c.axes) c.built.node_axes[node] = axes.axes;
  for (const Rigid& rigid : c.description.rigid) {
    const Index body = c.rigid_index.at(rigid.name.value);
    add_body_nodes(c, rigid.reference_node, {body, false});
    add_body_nodes(c, rigid.rotation_node, {body, true});
  }
}

template void build_answers(BuildContext<2>&);
template void build_answers(BuildContext<3>&);

}  // namespace osculate::deck
