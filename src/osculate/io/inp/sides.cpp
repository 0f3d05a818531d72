#include "osculate/io/inp/sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "osculate/core/text.hpp"

namespace osculate::io::inp {
namespace {

using Nodes = std::array<Index, mesh::most_facet_nodes>;

/// The nodes of a face or edge of a cell: outwards, or with a body numbered counterclockwise on
/// the right.
cell::CellType side_nodes(const mesh::Block& block, Index cell, const Side& side, Nodes& nodes) {
  const cell::CellInfo& info = cell::info(block.type);
  const Index* const from = block.cell(cell);
  const auto at = static_cast<std::size_t>(side.local);
  if (side.kind == Side::Kind::reversed) {
    std::copy_n(from, info.nodes, nodes.begin());
    mesh::reverse_area(block.type, {nodes.data(), static_cast<std::size_t>(info.nodes)});
    return block.type;
  }
  if (side.kind == Side::Kind::face) {
    const cell::CellFace& face = info.faces[at];
    for (std::size_t k = 0; k < static_cast<std::size_t>(cell::info(face.type).nodes); ++k)
      nodes[k] = from[face.nodes[k]];
    return face.type;
  }
  const auto& edge = info.edges[at];
  nodes[0] = from[edge[1]];
  nodes[1] = from[edge[0]];
  if (edge[2] >= 0) nodes[2] = from[edge[2]];
  return info.edge_type;
}

bool comes_first(const mesh::CellRef& a, const mesh::CellRef& b) {
  return std::pair(a.block, a.cell) < std::pair(b.block, b.cell);
}

/// Of two that are sorted.
std::vector<mesh::CellRef> combined(Combination how, const std::vector<mesh::CellRef>& a,
                                    const std::vector<mesh::CellRef>& b) {
  std::vector<mesh::CellRef> out;
  const auto to = std::back_inserter(out);
  if (how == Combination::unite)
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), to, comes_first);
  if (how == Combination::difference)
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), to, comes_first);
  if (how == Combination::intersection)
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), to, comes_first);
  return out;
}

}  // namespace

mesh::CellRef Sides::facet(cell::CellType type, std::span<const Index> nodes,
                           mesh::CellRef parent) {
  mesh::FaceKey corners{-1, -1, -1, -1};
  std::copy_n(nodes.begin(), cell::info(type).corners, corners.begin());
  std::sort(corners.begin(), corners.end());
  const auto [found, is_new] = known_.try_emplace({corners, {parent.block, parent.cell}});
  if (!is_new) return found->second;
  const Index at = block_of_type(mesh_, type);
  const std::vector<std::int64_t>& parents =
      mesh_.blocks[static_cast<std::size_t>(parent.block)].numbers;
  mesh::Block& block = mesh_.blocks[static_cast<std::size_t>(at)];
  found->second = {at, block.size()};
  if (!parents.empty()) {
    const std::int64_t number = parents[static_cast<std::size_t>(parent.cell)];
    block.numbers.push_back(number);
  }
  block.connectivity.insert(block.connectivity.end(), nodes.begin(), nodes.end());
  return found->second;
}

void Sides::add_side(const SurfaceEntry& entry, Index element, std::vector<mesh::CellRef>& cells) {
  const auto& [type, ref, variant, deck_nodes, family, others, layered] =
      numbering_.elements[static_cast<std::size_t>(element)];
  if (!others.empty() && !layered)
    fail(deck_, entry.set.at,
         fmt::format("element {} is a hollow beam: its sides are not supported",
                     mesh::cell_number(mesh_, ref)));
  const bool as_it_is = deck_nodes.empty() && !entry.of_load;
  const bool layer = !deck_nodes.empty() && family == Family::plane;
  const Family as = family == Family::plane && !layer ? Family::solid : family;
  const Side side =
      find_side(*type, as_it_is ? entry.side : solid_side(entry.side, entry.of_load, as));
  if (side.kind == Side::Kind::none)
    fail(deck_, entry.set.at,
         fmt::format("element {} of {} has no side {}; expected {}", mesh::cell_number(mesh_, ref),
                     layer ? std::string("the plane") : fmt::format("type {}", type->name),
                     shown(entry.side),
                     layer ? fmt::format("{0}1 to {0}{1}", entry.of_load ? 'P' : 'S',
                                         cell::info(type->cell).corners / 2)
                           : side_names(*type)));
  if (side.kind == Side::Kind::whole) return cells.push_back(ref);
  // of layers the bottom is that of the first, the top that of the last, the sides are those of all
  std::vector<mesh::CellRef> all{ref};
  all.insert(all.end(), others.begin(), others.end());
  const bool top = side.local == find_side(*type, "S2").local;
  if (side.local == find_side(*type, "S1").local) all.resize(1);
  if (top) all.erase(all.begin(), all.end() - 1);
  for (const mesh::CellRef& one : all) {
    Nodes nodes{};
    const cell::CellType made =
        side_nodes(mesh_.blocks[static_cast<std::size_t>(one.block)], one.cell, side, nodes);
    cells.push_back(
        facet(made, std::span(nodes).first(static_cast<std::size_t>(cell::info(made).nodes)), one));
  }
}

template <class Facets>
void Sides::add_facets(const SurfaceEntry& entry, const Facets& facets,
                       std::vector<mesh::CellRef>& cells) {
  if (!facets.errors.empty()) fail(deck_, entry.set.at, facets.errors.front());
  for (const auto& one : facets.facets)
    if (!is_side_of_layer(one.nodes().first(static_cast<std::size_t>(cell::info(one.type).corners)),
                          one.parent))
      cells.push_back(facet(one.type, one.nodes(), one.parent));
}

/// Whether a face is one of those between which plane elements were expanded: all its corners are
/// below, or above.
bool Sides::is_side_of_layer(std::span<const Index> corners, mesh::CellRef parent) {
  if (!layer_cells_) {
    layer_cells_.emplace();
    for (const Element& element : numbering_.elements)
      if (element.deck_family == Family::plane && !element.deck_nodes.empty())
        layer_cells_->emplace(element.cell.block, element.cell.cell);
  }
  if (!layer_cells_->contains({parent.block, parent.cell})) return false;
  const mesh::Block& block = mesh_.blocks[static_cast<std::size_t>(parent.block)];
  const Index* const below = block.cell(parent.cell);
  const Index* const above = below + cell::info(block.type).corners / 2;
  const auto count = std::ranges::count_if(
      corners, [&](Index node) { return std::find(below, above, node) != above; });
  return count == 0 || count == std::ssize(corners);
}

std::vector<mesh::CellRef> Sides::all_cells(int dimension) const {
  std::vector<mesh::CellRef> cells;
  for (const Element& element : numbering_.elements)
    if (cell::info(element.type->cell).dimension == dimension) {
      cells.push_back(element.cell);
      cells.insert(cells.end(), element.others.begin(), element.others.end());
    }
  return cells;
}

/// The free faces of solids, the free edges of plane elements, and shells as they are.
void Sides::add_free(const SurfaceEntry& entry, const std::vector<Index>& elements,
                     std::vector<mesh::CellRef>& cells) {
  mesh::Set solids{"", 3, {}, {}}, areas{"", 2, {}, {}};
  for (const Index element : elements) {
    const auto& [type, ref, variant, deck_nodes, family, others, layered] =
        numbering_.elements[static_cast<std::size_t>(element)];
    if (type->family == Family::solid) solids.cells.push_back(ref);
    solids.cells.insert(solids.cells.end(), others.begin(), others.end());
    if (type->family == Family::plane) areas.cells.push_back(ref);
    if (type->family == Family::surface || type->family == Family::line) cells.push_back(ref);
  }
  if (!solids.cells.empty()) {
    if (!faces_) faces_ = mesh::face_table(mesh_, all_cells(3));
    add_facets(entry, mesh::surface_facets(mesh_, *faces_, solids), cells);
  }
  if (!areas.cells.empty()) {
    if (!edges_) edges_ = mesh::edge_table(mesh_, all_cells(2));
    add_facets(entry, mesh::boundary_facets(mesh_, *edges_, areas), cells);
  }
}

std::vector<mesh::CellRef> Sides::of_parts(const RawSurface& surface, std::uint32_t scope,
                                           Members& members) {
  if (std::ranges::find(open_, &surface) != open_.end())
    fail(deck_, surface.at, fmt::format("the surface {} is made of itself", shown(surface.name)));
  open_.push_back(&surface);
  std::vector<mesh::CellRef> cells;
  for (const SetName& part : surface.parts) {
    const std::uint32_t meant = part.scope == own_scope ? scope : part.scope;
    const Named<RawSurface>& all = raw_.scopes[meant].surfaces;
    const auto found = all.find(capitals(part.name));
    if (found == all.end()) {
      std::vector<std::string> names;
      for (const auto& [key, one] : all) names.push_back(one.name);
      fail(deck_, part.at, core::unknown_name_message("surface of elements", part.name, names));
    }
    std::vector<mesh::CellRef> of_part = of(found->second, meant, members);
    cells = &part == &surface.parts.front() ? std::move(of_part)
                                            : combined(surface.combination, cells, of_part);
  }
  open_.pop_back();
  if (cells.empty())
    fail(deck_, surface.at, fmt::format("the surface {} has no facets", shown(surface.name)));
  return cells;
}

std::vector<mesh::CellRef> Sides::of_entries(const RawSurface& surface, std::uint32_t scope,
                                             Members& members) {
  std::vector<mesh::CellRef> cells;
  for (const SurfaceEntry& entry : surface.entries) {
    const std::uint32_t meant = entry.set.scope == own_scope ? scope : entry.set.scope;
    const std::vector<Index> elements =
        entry.number > 0 ? std::vector{members.element(meant, entry.number, entry.set.at)}
                         : members.of(Kind::elements, meant, entry.set.name, entry.set.at);
    if (entry.side.empty()) {
      add_free(entry, elements, cells);
      continue;
    }
    for (const Index element : elements) add_side(entry, element, cells);
  }
  std::sort(cells.begin(), cells.end(), comes_first);
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

std::vector<mesh::CellRef> Sides::of(const RawSurface& surface, std::uint32_t scope,
                                     Members& members) {
  std::vector<mesh::CellRef> cells = surface.combination == Combination::none
                                         ? of_entries(surface, scope, members)
                                         : of_parts(surface, scope, members);
  const auto dimension = [&](const mesh::CellRef& ref) {
    return cell::info(mesh_.blocks[static_cast<std::size_t>(ref.block)].type).dimension;
  };
  for (const mesh::CellRef& ref : cells)
    if (dimension(ref) != dimension(cells.front()))
      fail(deck_, surface.at,
           fmt::format("the surface '{}' has edges and faces; expected one of them", surface.name));
  return cells;
}

}  // namespace osculate::io::inp
