// `initial: adjust`: slave nodes onto the master, before anything is computed.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "osculate/deck/build_contact_parts.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/model/bulk.hpp"

namespace osculate::deck {
namespace {

template <int Dim>
void refuse_rigid(const BuildContext<Dim>& c, const Contact& contact,
                  const std::vector<Index>& nodes) {
  for (const Index n : nodes)
    if (c.model().body_of_node[static_cast<std::size_t>(n)] >= 0)
      throw core::InputError(
          contact.initial.mark,
          fmt::format("the slave '{}' is rigid, its nodes cannot be moved one by "
                      "one: use ramp, or move the body",
                      contact.slave.value));
}

/// A cell that a moved node has turned inside out.
template <int Dim>
void check_cells(const BuildContext<Dim>& c, const core::SourceMark& mark,
                 const std::vector<bool>& moved) {
  for (const model::BasicBulkSection<Dim>& section : c.model().sections)
    for (const mesh::CellRef& ref : section.cells) {
      const std::span<const Index> nodes = model::cell_nodes(c.model().mesh, ref).nodes;
      const auto found = std::find_if(nodes.begin(), nodes.end(),
                                      [&](Index n) { return moved[static_cast<std::size_t>(n)]; });
      if (found == nodes.end() || model::smallest_jacobian(c.model(), ref) > 0) continue;
      throw core::InputError(
          mark,
          fmt::format("moving the slave nodes onto the master turns the cell at {} inside out: the "
                      "overlap is deeper than the cell",
                      mesh::describe_node(c.model().mesh, *found)));
    }
}

template <int Dim>
void move(BuildContext<Dim>& c, Index node, const Vec<Dim>& to) {
  c.model().reference[static_cast<std::size_t>(node)] = to;
  c.model().mesh.nodes[static_cast<std::size_t>(node)].template head<Dim>() = to;
}

double tolerance_of(const Contact& contact) {
  return contact.initial_nodes ? std::numeric_limits<double>::max() : contact.initial_tolerance;
}

template <int Dim>
void adjust(BuildContext<Dim>& c, const Contact& contact) {
  pairing::PairDefinition<Dim> pair;
  pair.master = boundary_of(c, contact.master);
  pair.slave = slave_of(c, contact);
  face_slave(c, contact, contact.master, pair.slave.nodes, pair.master);
  pair.weight = pairing::Weight::node;
  if (contact.search_depth) pair.depth = contact.search_depth->value;
  refuse_rigid(c, contact, pair.slave.nodes);
  std::vector<model::MovedNode<Dim>> all =
      model::onto_master(pair, c.model().reference, tolerance_of(contact));
  if (contact.initial_nodes) {
    const std::vector<Index>& only = c.set(*contact.initial_nodes).nodes;
    std::erase_if(all, [&](const model::MovedNode<Dim>& one) {
      return std::find(only.begin(), only.end(), one.node) == only.end();
    });
  }
  move_onto_master(c, all, fmt::format("'{}'", contact.name.value), contact.initial.mark);
}

}  // namespace

template <int Dim>
void move_onto_master(BuildContext<Dim>& c, const std::vector<model::MovedNode<Dim>>& all,
                      std::string_view what, const core::SourceMark& mark) {
  std::vector<bool> moved(c.model().reference.size());
  double farthest = 0;
  for (const model::MovedNode<Dim>& one : all) {
    moved[static_cast<std::size_t>(one.node)] = true;
    farthest = std::max(farthest, one.way);
    move<Dim>(c, one.node, one.to);
  }
  check_cells(c, mark, moved);
  c.built.notes.push_back(
      fmt::format("{}: {} slave nodes moved onto the master before the first step, by up to {:.4g}",
                  what, all.size(), farthest));
}

template <int Dim>
void adjust_overlaps(BuildContext<Dim>& c) {
  for (const Contact& contact : c.description.contact) {
    if (contact.initial.value != InitialWord::adjust) continue;
    if (contact.all || contact.master.value == contact.slave.value)
      throw core::InputError(contact.initial.mark,
                             "adjust needs a pair with a slave that is moved and a master that "
                             "stays: name the pair");
    adjust(c, contact);
  }
}

template void move_onto_master(BuildContext<2>&, const std::vector<model::MovedNode<2>>&,
                               std::string_view, const core::SourceMark&);
template void move_onto_master(BuildContext<3>&, const std::vector<model::MovedNode<3>>&,
                               std::string_view, const core::SourceMark&);
template void adjust_overlaps(BuildContext<2>&);
template void adjust_overlaps(BuildContext<3>&);

}  // namespace osculate::deck
