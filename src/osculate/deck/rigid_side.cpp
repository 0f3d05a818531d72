// A surface of facets with nothing behind them: which side of it is the outer one.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "osculate/deck/build_contact_parts.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/pairing/projected_point.hpp"

namespace osculate::deck {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::vector<Index> neighbours(const pairing::Facet& f) { return {f.prev, f.next}; }
std::vector<Index> neighbours(const pairing::SurfaceFacet& f) {
  return {f.neighbour.begin(), f.neighbour.end()};
}

/// Facets that hang together and have no cell behind any of them.
template <int Dim>
std::vector<std::vector<Index>> bare_parts(const pairing::Boundary<Dim>& boundary,
                                           const std::vector<Side<Dim>>& sides) {
  std::vector<std::vector<Index>> parts;
  std::vector<bool> seen(sides.size());
  for (std::size_t first = 0; first < sides.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = true;
    std::vector<Index> part{static_cast<Index>(first)};
    for (std::size_t i = 0; i < part.size(); ++i)
      for (const Index next : neighbours(boundary.facets[at(part[i])])) {
        if (next < 0 || seen[at(next)]) continue;
        seen[at(next)] = true;
        part.push_back(next);
      }
    const auto has_cell = [&](Index f) { return sides[at(f)].has_parent(); };
    if (std::none_of(part.begin(), part.end(), has_cell)) parts.push_back(std::move(part));
  }
  return parts;
}

/// A slave node and the middle of the cells around it, which is inside the slave.
template <int Dim>
struct Seat {
  Index node;
  Vec<Dim> inside;
};

template <int Dim>
std::vector<Seat<Dim>> seats(const model::BasicModel<Dim>& m, const std::vector<Index>& nodes) {
  std::vector<Index> slot(m.reference.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) slot[at(nodes[i])] = static_cast<Index>(i);
  std::vector<Vec<Dim>> sum(nodes.size(), Vec<Dim>::Zero());
  std::vector<int> count(nodes.size(), 0);
  for (const model::BasicBulkSection<Dim>& section : m.sections)
    for (const mesh::CellRef& ref : section.cells) {
      const std::span<const Index> cell = model::cell_nodes(m.mesh, ref).nodes;
      Vec<Dim> middle = Vec<Dim>::Zero();
      for (const Index n : cell) middle += m.reference[at(n)] / static_cast<double>(cell.size());
      for (const Index n : cell)
        if (slot[at(n)] >= 0) {
          sum[at(slot[at(n)])] += middle;
          ++count[at(slot[at(n)])];
        }
    }
  std::vector<Seat<Dim>> out;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    out.push_back({nodes[i], count[i] ? Vec<Dim>(sum[i] / count[i]) : m.reference[at(nodes[i])]});
  return out;
}

/// How many slave nodes are on each side of a part.
struct Votes {
  int front = 0, behind = 0;
  Index some_front = -1, some_behind = -1;  ///< a node of each
  void add(double distance, Index node) {
    if (distance > 0) {
      ++front;
      some_front = node;
    } else if (distance < 0) {
      ++behind;
      some_behind = node;
    }
  }
};

/// Votes of each slave node about the facet nearest to it; with `beyond_ends` also of those that
/// are beside the surface.
template <int Dim>
std::vector<Votes> votes_of(const pairing::Boundary<Dim>& boundary, const std::vector<Index>& part,
                            const std::vector<Vec<Dim>>& reference,
                            const std::vector<Seat<Dim>>& slave, bool beyond_ends) {
  const std::span<const Vec<Dim>> x(reference);
  std::vector<search::Box<Dim>> boxes;
  facet_boxes(boundary, x, boxes);
  const pairing::Tree<Dim> tree(boxes);
  std::vector<Votes> votes(static_cast<std::size_t>(*std::max_element(part.begin(), part.end())) +
                           1);
  for (const Seat<Dim>& seat : slave) {
    pairing::ProjectionQuery<Dim> query;
    query.point = x[at(seat.node)];
    const pairing::Projection<Dim> p = closest(boundary, tree, x, query);
    if (p.feature == projection::Feature::none || p.facet < 0) continue;
    if (part[at(p.facet)] < 0 || (p.beyond_end && !beyond_ends)) continue;
    const pairing::ProjectedPoint<Dim> placed = projected_point(boundary, p, query.point, x);
    const bool on_face = p.feature == projection::Feature::face;
    const Vec<Dim> normal = on_face ? placed.kinematics.normal : p.outward;
    votes[at(part[at(p.facet)])].add(normal.dot(seat.inside - placed.foot), seat.node);
  }
  return votes;
}

pairing::Facet turned(pairing::Facet facet) {
  std::swap(facet.nodes[0], facet.nodes[1]);
  std::reverse(facet.nodes.begin() + 2, facet.nodes.begin() + std::max(facet.count, 2));
  return pairing::lagrange_facet({facet.nodes.data(), at(facet.count)});
}
pairing::SurfaceFacet turned(pairing::SurfaceFacet facet) {
  mesh::reverse_area(facet.type, {facet.nodes.data(), at(facet.count)});
  return pairing::surface_facet(facet.type, {facet.nodes.data(), at(facet.count)});
}

/// The votes about one part alone, which is nobody's nearest.
template <int Dim>
Votes votes_alone(const pairing::Boundary<Dim>& boundary, const std::vector<Index>& part,
                  const std::vector<Vec<Dim>>& reference, const std::vector<Seat<Dim>>& slave) {
  pairing::Boundary<Dim> alone;
  for (const Index f : part) alone.facets.push_back(boundary.facets[at(f)]);
  pairing::connect(alone);
  const std::vector<Index> one(part.size(), 0);
  const Votes votes = votes_of<Dim>(alone, one, reference, slave, false).front();
  if (votes.front + votes.behind > 0) return votes;
  return votes_of<Dim>(alone, one, reference, slave, true).front();
}

template <int Dim>
void tell_of_both(BuildContext<Dim>& c, const Contact& contact, const Name& master,
                  const Votes& votes) {
  const bool front = votes.front >= votes.behind;
  c.built.warnings.push_back(fmt::format(
      "contact '{}': '{}' has no body behind it, and the slave starts on both sides of it ({} "
      "nodes on one, {} on the other, as {}): the side of most of them is taken; flip: true or "
      "false of the rigid body chooses it",
      contact.name.value, master.value, std::max(votes.front, votes.behind),
      std::min(votes.front, votes.behind),
      mesh::describe_node(c.model().mesh, front ? votes.some_behind : votes.some_front)));
}

}  // namespace

template <int Dim>
void face_slave(BuildContext<Dim>& c, const Contact& contact, const Name& master,
                const std::vector<Index>& slave_nodes, pairing::Boundary<Dim>& boundary) {
  const Rigid* const rigid =
      c.rigid_index.contains(master.value) ? c.description.find_rigid(master.value) : nullptr;
  const SetShape* const meshed = rigid ? std::get_if<SetShape>(&rigid->shape) : nullptr;
  if (rigid && (!meshed || rigid->flip)) return;
  const std::vector<Side<Dim>> sides = oriented_facets(c, meshed ? meshed->set : master);
  const std::vector<std::vector<Index>> parts = bare_parts<Dim>(boundary, sides);
  if (parts.empty()) return;
  std::vector<Index> part_of(boundary.facets.size(), -1);
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const Index f : parts[p]) part_of[at(f)] = static_cast<Index>(p);
  const std::vector<Vec<Dim>>& x = c.model().reference;
  const std::vector<Seat<Dim>> slave = seats(c.model(), slave_nodes);
  const std::vector<Votes> nearest = votes_of<Dim>(boundary, part_of, x, slave, false);
  std::size_t count = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    Votes votes = nearest[p];
    if (votes.front + votes.behind == 0) votes = votes_alone<Dim>(boundary, parts[p], x, slave);
    if (votes.front > 0 && votes.behind > 0) tell_of_both(c, contact, master, votes);
    if (votes.front >= votes.behind) continue;
    for (const Index f : parts[p]) boundary.facets[at(f)] = turned(boundary.facets[at(f)]);
    count += parts[p].size();
  }
  pairing::connect(boundary);
  if (count > 0)
    c.built.notes.push_back(
        fmt::format("contact '{}': '{}' has no body behind it; {} of its {} facets were turned "
                    "round to face the side where the slave starts",
                    contact.name.value, master.value, count, boundary.facets.size()));
}

template void face_slave(BuildContext<2>&, const Contact&, const Name&, const std::vector<Index>&,
                         pairing::Chain&);
template void face_slave(BuildContext<3>&, const Contact&, const Name&, const std::vector<Index>&,
                         pairing::FacetSurface&);

}  // namespace osculate::deck
