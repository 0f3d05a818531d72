// Surfaces of a model file as cards of a deck.
#include <algorithm>
#include <set>
#include <span>

#include "osculate/deck/to_inp_parts.hpp"
#include "osculate/model/bulk.hpp"

namespace osculate::deck {

template <int Dim>
std::vector<Side<Dim>> InpMesh<Dim>::facets(const Name& on) const {
  auto surface = mesh::surface_of(m_.mesh, table_, set(on));
  if (!surface.errors.empty()) throw core::InputError(on.mark, surface.errors.front());
  return std::move(surface.facets);
}

template <int Dim>
double InpMesh<Dim>::area(const Name& surface) const {
  if (set(surface).dimension != Dim - 1)
    throw core::InputError(surface.mark,
                           "a force in total is written of facets and of nodes, not of bodies");
  double sum = 0;
  for (const Side<Dim>& facet : facets(surface)) {
    const auto section = section_of_.find({facet.parent.block, facet.parent.cell});
    if (section == section_of_.end()) continue;  // refused by `surface`
    const auto all = facet.nodes();
    for (const double weight :
         model::side_weights(m_, m_.sections[section->second].section, facet.type,
                             std::span<const Index>(all.data(), all.size())))
      sum += weight;
  }
  return sum;
}

template <int Dim>
bool InpMesh<Dim>::is_curved(const Name& surface) const {
  return std::ranges::any_of(facets(surface),
                             [](const auto& f) { return cell::info(f.type).order > 1; });
}

template <int Dim>
bool InpMesh<Dim>::share_facets(const Name& one, const Name& other) const {
  const auto places = [&](const Name& on) {
    std::set<std::vector<Index>> all;
    for (const Side<Dim>& facet : facets(on)) {
      const auto nodes = facet.nodes();
      std::vector<Index> sorted(nodes.begin(), nodes.end());
      std::ranges::sort(sorted);
      all.insert(std::move(sorted));
    }
    return all;
  };
  const auto of_one = places(one);
  return std::ranges::any_of(places(other),
                             [&](const auto& facet) { return of_one.contains(facet); });
}

/// `4, S2`.
template <int Dim>
std::string InpMesh<Dim>::side_of(const mesh::CellRef& parent, std::span<const Index> nodes,
                                  const Name& on) const {
  const auto number = number_.find({parent.block, parent.cell});
  if (number == number_.end())
    throw core::InputError(on.mark, fmt::format("'{}' has facets that are no sides of a section's "
                                                "cells: rigid surfaces are not written",
                                                on.value));
  const model::CellNodes cell = model::cell_nodes(m_.mesh, parent);
  const cell::CellInfo& info = cell::info(cell.type);
  const auto is_on = [&](auto local) {
    return std::ranges::find(nodes, cell.nodes[static_cast<std::size_t>(local)]) != nodes.end();
  };
  const auto matches = [&](int side) {
    const auto at = static_cast<std::size_t>(side);
    if constexpr (Dim == 2) return is_on(info.edges[at][0]) && is_on(info.edges[at][1]);
    const cell::CellFace& face = info.faces[at];
    const auto corners = static_cast<std::size_t>(cell::info(face.type).corners);
    return corners == nodes.size() &&
           std::all_of(face.nodes.begin(),
                       face.nodes.begin() + static_cast<std::ptrdiff_t>(corners), is_on);
  };
  const auto& type =
      *io::inp::find_element_type(fmt::format("{}{}", Dim == 2 ? "CPE" : "C3D", cell.nodes.size()));
  const io::inp::ElementType* const own = given_ ? given_->element(number->second) : &type;
  if (!own)
    throw core::InputError(on.mark, fmt::format("'{}' has facets of layers or hollow beams: of "
                                                "these the surfaces of their deck are written",
                                                on.value));
  // the edges of plane elements beside solids are the faces between the two sides of these
  const int before = Dim == 3 && own->family == io::inp::Family::plane ? 2 : 0;
  for (int k = 1 + before; k <= 6; ++k) {
    const io::inp::Side side = io::inp::find_side(type, fmt::format("S{}", k));
    if (side.kind != io::inp::Side::Kind::none && matches(side.local))
      return fmt::format("{}, S{}\n", number->second, k - before);
  }
  throw core::InputError(on.mark, fmt::format("'{}' has a facet that is no side", on.value));
}

template <int Dim>
const std::string& InpMesh<Dim>::surface(const Name& on, bool of_nodes) {
  const char kind = of_nodes ? 'p' : 's';
  const bool known = names_.contains({kind, on.value});
  if (!known)
    if (const auto given =
            given_name(of_nodes ? io::inp::SetKind::node_surface : io::inp::SetKind::surface, on))
      return names_[{kind, on.value}] = *given;
  const std::string& name = plain(of_nodes ? on.value + "_nodes" : on.value, kind);
  if (of_nodes) names_[{kind, on.value}] = name;
  if (known) return name;
  if (of_nodes) {
    sets_ += fmt::format("*SURFACE, NAME={}, TYPE=NODE\n{},\n", name, nodes(on));
    return name;
  }
  std::string lines;
  for (const Side<Dim>& facet : facets(on)) {
    const auto all = facet.nodes();
    const auto corners = static_cast<std::size_t>(cell::info(facet.type).corners);
    lines += side_of(facet.parent, std::span<const Index>(all.data(), corners), on);
  }
  sets_ += fmt::format("*SURFACE, NAME={}, TYPE=ELEMENT\n", name) + lines;
  return name;
}

template <int Dim>
std::string InpMesh<Dim>::sides_at(const Name& on, const std::optional<Vec3>& axis) const {
  const mesh::Set& cut = set(on);
  const std::set<Index> wanted(cut.nodes.begin(), cut.nodes.end());
  std::map<Index, std::vector<mesh::CellRef>> at_node;
  for (const auto& section : m_.sections)
    for (const mesh::CellRef& ref : section.cells)
      for (const Index n : model::cell_nodes(m_.mesh, ref).nodes)
        if (wanted.contains(n)) at_node[n].push_back(ref);
  const auto at = [&](Index n) { return m_.mesh.nodes[static_cast<std::size_t>(n)]; };
  const auto middle = [&](std::span<const Index> nodes) {
    Vec3 sum = Vec3::Zero();
    for (const Index n : nodes) sum += at(n);
    return Vec3(sum / static_cast<double>(nodes.size()));
  };
  std::string lines;
  for (const mesh::CellRef& facet : cut.cells) {
    const mesh::Block& block = m_.mesh.blocks[static_cast<std::size_t>(facet.block)];
    const std::span<const Index> corners(block.cell(facet.cell),
                                         static_cast<std::size_t>(cell::info(block.type).corners));
    Vec3 way = corners.size() == 2 ? Vec3(at(corners[1]) - at(corners[0])).cross(Vec3::UnitZ())
                                   : Vec3(Vec3::Zero());
    for (std::size_t k = 2; k < corners.size(); ++k)
      way -= (at(corners[k - 1]) - at(corners[0])).cross(at(corners[k]) - at(corners[0]));
    if (axis) way = *axis;
    std::optional<mesh::CellRef> best;
    double ahead = 0;
    for (const mesh::CellRef& ref : at_node[corners[0]]) {
      const auto nodes = model::cell_nodes(m_.mesh, ref).nodes;
      const bool whole = std::ranges::all_of(
          corners, [&](Index n) { return std::ranges::find(nodes, n) != nodes.end(); });
      const double here = (middle(nodes) - middle(corners)).dot(way);
      if (!whole || (best && here <= ahead)) continue;
      best = ref;
      ahead = here;
    }
    if (best) lines += side_of(*best, corners, on);
  }
  return lines;
}

template <int Dim>
const std::string& InpMesh<Dim>::surface_ahead(const Name& on, const Vec3& axis) {
  const std::string lines = sides_at(on, axis);
  const std::string& name = plain(on.value + "_ahead", 's');
  sets_ += fmt::format("*SURFACE, NAME={}, TYPE=ELEMENT\n", name) + lines;
  return name;
}

template <int Dim>
const std::string& InpMesh<Dim>::surface_of_cut(const Name& on) {
  if (names_.contains({'s', on.value}) || set(on).dimension != Dim - 1 ||
      given_name(io::inp::SetKind::surface, on))
    return surface(on);
  const std::string lines = sides_at(on, {});
  const std::string& name = plain(on.value, 's');
  sets_ += fmt::format("*SURFACE, NAME={}, TYPE=ELEMENT\n", name) + lines;
  return name;
}

template <int Dim>
const std::string& InpMesh<Dim>::surface_named(const Name& on) const {
  const auto nodes = names_.find({'p', on.value});
  return nodes == names_.end() ? names_.at({'s', on.value}) : nodes->second;
}

template double InpMesh<2>::area(const Name&) const;
template bool InpMesh<2>::is_curved(const Name&) const;
template bool InpMesh<2>::share_facets(const Name&, const Name&) const;
template const std::string& InpMesh<2>::surface(const Name&, bool);
template const std::string& InpMesh<2>::surface_ahead(const Name&, const Vec3&);
template const std::string& InpMesh<2>::surface_of_cut(const Name&);
template const std::string& InpMesh<2>::surface_named(const Name&) const;
template double InpMesh<3>::area(const Name&) const;
template bool InpMesh<3>::is_curved(const Name&) const;
template bool InpMesh<3>::share_facets(const Name&, const Name&) const;
template const std::string& InpMesh<3>::surface(const Name&, bool);
template const std::string& InpMesh<3>::surface_ahead(const Name&, const Vec3&);
template const std::string& InpMesh<3>::surface_of_cut(const Name&);
template const std::string& InpMesh<3>::surface_named(const Name&) const;

}  // namespace osculate::deck
