#include "osculate/pairing/mortar.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "osculate/pairing/closest.hpp"
#include "osculate/pairing/mortar_basis.hpp"
#include "osculate/pairing/mortar_node.hpp"
#include "osculate/pairing/point_block.hpp"
#include "osculate/pairing/report.hpp"

namespace osculate::pairing {
namespace {

using contact::PointHistory;
using contact::Status;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// ---- which master facets a slave facet lies over ------------------------------------------------

template <int Dim>
void set_slots(const SlaveSide<Dim>& slave, std::vector<std::vector<std::size_t>>& slots) {
  if (slots.size() == slave.boundary.facets.size()) return;
  std::unordered_map<Index, std::size_t> slot;
  for (std::size_t i = 0; i < slave.nodes.size(); ++i) slot.emplace(slave.nodes[i], i);
  slots.clear();
  for (const auto& facet : slave.boundary.facets) {
    slots.emplace_back();
    for (std::size_t k = 0; k < at(facet.count); ++k)
      slots.back().push_back(slot.at(facet.nodes[k]));
  }
}

/// Boxes of the slave's facets, wider by their diagonal on all sides: nothing that is farther away
/// than a facet is long takes part.
template <int Dim>
search::Box<Dim> reach_of(const SlaveSide<Dim>& slave, std::size_t f, Points<Dim> x) {
  const auto& facet = slave.boundary.facets[f];
  search::Box<Dim> box;
  for (std::size_t k = 0; k < at(facet.count); ++k) box.extend(x[at(facet.nodes[k])]);
  box.inflate((box.hi - box.lo).norm());
  return box;
}

/// Part of the slave facet that its first `count` cells cover.
template <int Dim>
double cover_of(const std::vector<MortarCell<Dim>>& cells, std::size_t count) {
  double cover = 0;
  for (std::size_t c = 0; c < count; ++c) cover += cells[c].cover;
  return cover;
}

/// Facets whose normals are within 60 degrees of opposite. One that stands across the other, as the
/// side of a punch, is not what lies over it, however near its foot is.
template <int Dim, class AnyFacet>
bool face_each_other(const AnyFacet& slave, const AnyFacet& master, Points<Dim> x) {
  return middle_normal(slave, x).dot(middle_normal(master, x)) <= facing_cosine;
}

/// Of several layers of master the nearest: cells are taken by distance while the facet has room.
template <int Dim>
void drop_covered(std::vector<MortarCell<Dim>>& cells, std::size_t& count) {
  constexpr double room = 1 + 1e-3;
  if (cover_of<Dim>(cells, count) <= room) return;
  std::sort(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(count),
            [](const MortarCell<Dim>& a, const MortarCell<Dim>& b) {
              const double far_a = std::abs(a.distance), far_b = std::abs(b.distance);
              return far_a != far_b ? far_a < far_b : a.master < b.master;
            });
  double cover = 0;
  std::size_t kept = 0;
  while (kept < count && cover + cells[kept].cover <= room) cover += cells[kept++].cover;
  count = kept;
}

/// A slave facet can be used when its nodes have normals.
template <int Dim>
bool usable(std::span<const std::size_t> local, const std::vector<NodalNormal<Dim>>& normals) {
  return std::all_of(local.begin(), local.end(),
                     [&](std::size_t i) { return normals[i].value.squaredNorm() > 0; });
}

/// Cells of slave facet `f`; returns how many.
template <int Dim>
std::size_t find_cells(const MortarSides<Dim>& sides, const SlaveSide<Dim>& slave, std::size_t f,
                       Points<Dim> x, bool derivatives, PairEvaluation<Dim>& out) {
  std::vector<Index>& near = out.mortar.overlaps[f];
  near.clear();
  if (!usable<Dim>(out.mortar.slots[f], out.mortar.normals)) return 0;
  out.tree.for_each_overlap(reach_of(slave, f, x), [&](Index m) { near.push_back(m); });
  std::sort(near.begin(), near.end());
  std::size_t count = 0;
  for (const Index m : near) {
    if (!face_each_other<Dim>(slave.boundary.facets[f], sides.master->facets[at(m)], x)) continue;
    if (out.mortar.cells.size() <= count) out.mortar.cells.emplace_back();
    if (mortar_cell(sides, static_cast<Index>(f), out.mortar.slots[f], m, x, derivatives,
                    out.mortar.cells[count]))
      ++count;
  }
  drop_covered(out.mortar.cells, count);
  constexpr double nothing = 1e-5;  // of a facet: the dual functions of less are all rounding
  if (cover_of<Dim>(out.mortar.cells, count) < nothing) count = 0;
  near.clear();
  for (std::size_t c = 0; c < count; ++c) near.push_back(out.mortar.cells[c].master);
  return count;
}

// ---- D and M of the nodes -----------------------------------------------------------------------

void add_weight(MortarPlace& place, Index node, double weight) {
  const std::size_t k = slot_of(place.nodes, node);
  if (k == place.weights.size()) place.weights.push_back(0);
  place.weights[k] += weight;
}

template <int Dim, class Facet>
void add_facet(const MortarFacet<Dim>& matrices, const Facet& facet,
               std::span<const std::size_t> local, Index master, Points<Dim> x,
               std::vector<MortarNode<Dim>>& nodes) {
  const Sheet::ConstView over_master = matrices.m.view();
  for (Eigen::Index j = 0; j < matrices.d.size(); ++j) {
    MortarNode<Dim>& node = nodes[local[static_cast<std::size_t>(j)]];
    node.area += matrices.d[j];
    if (node.facet < 0) node.facet = master;
    for (Eigen::Index k = 0; k < matrices.s.cols(); ++k) {
      const Index by = facet.nodes[static_cast<std::size_t>(k)];
      if (matrices.s(j, k) == 0) continue;
      node.own += matrices.s(j, k) * x[at(by)];
      add_weight(node.slaves, by, matrices.s(j, k));
    }
    for (std::size_t l = 0; l < matrices.masters.size(); ++l) {
      const double m = over_master(j, static_cast<Eigen::Index>(l));
      node.other += m * x[at(matrices.masters[l])];
      add_weight(node.masters, matrices.masters[l], m);
    }
  }
}

template <int Dim>
MortarSides<Dim> sides_of(const PairDefinition<Dim>& pair, const PairEvaluation<Dim>& out) {
  return {&pair.slave.boundary,
          &pair.master,
          {pair.weight == Weight::current_area, pair.area,
           std::get<ByMortar<Dim>>(pair.sampler).reference},
          out.mortar.normals};
}

/// D and M of slave facet `f` from its first `count` cells.
template <int Dim>
void matrices_of(const PairDefinition<Dim>& pair, std::size_t f, std::size_t count,
                 bool derivatives, PairEvaluation<Dim>& out) {
  constexpr double rounding = 1e-6;
  const double cover = cover_of<Dim>(out.mortar.cells, count);
  mortar_facet<Dim>(std::span(out.mortar.cells).first(count), pair.master,
                    multiplier_basis(pair.slave.boundary.facets[f], cover > 1 - rounding),
                    derivatives, out.mortar.facets[f]);
}

/// Empties a place. It keeps some room: how many nodes it has may depend on rounding.
void empty(MortarPlace& place) {
  constexpr std::size_t room = 32;
  place.nodes.clear();
  place.weights.clear();
  place.nodes.reserve(room);
  place.weights.reserve(room);
}

/// Whether node `i` was in contact in the last iteration, or at the end of the last increment: then
/// it most likely still is.
template <int Dim>
bool was_in_contact(const PairState<Dim>& committed, const ActiveSet<Dim>& active_set,
                    std::size_t i) {
  return committed.points[i].active ||
         (i < active_set.branch.size() && active_set.branch[i].branch != contact::Branch::none);
}

template <int Dim>
void refresh(const PairDefinition<Dim>& pair, Points<Dim> x, const PairState<Dim>& committed,
             const ActiveSet<Dim>& active_set, bool with_tangent, PairEvaluation<Dim>& out) {
  const std::size_t n = pair.slave.nodes.size();
  set_slots(pair.slave, out.mortar.slots);
  out.mortar.normals.resize(n);
  out.mortar.nodes.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    nodal_normal(pair.slave, i, x, with_tangent, out.mortar.normals[i]);
    MortarNode<Dim>& node = out.mortar.nodes[i];
    node.area = 0;
    node.own.setZero();
    node.other.setZero();
    for (MortarPlace* const place : {&node.slaves, &node.masters}) empty(*place);
    node.facet = -1;
    node.rates.clear();
  }
  const std::size_t before = out.boxes.size();
  facet_boxes(pair.master, x, out.boxes);
  if (before == out.boxes.size() && before > 0)
    out.tree.refit(out.boxes);
  else
    out.tree = Tree<Dim>(out.boxes);
  const std::size_t facets = pair.slave.boundary.facets.size();
  out.mortar.overlaps.resize(facets);
  out.mortar.facets.resize(facets);
  out.mortar.has_rates.assign(facets, false);
  const MortarSides<Dim> sides = sides_of(pair, out);
  for (std::size_t f = 0; f < facets; ++f) {
    const std::vector<std::size_t>& local = out.mortar.slots[f];
    const bool rates = with_tangent && std::any_of(local.begin(), local.end(), [&](std::size_t i) {
                         return was_in_contact(committed, active_set, i);
                       });
    const std::size_t count = find_cells(sides, pair.slave, f, x, rates, out);
    if (count == 0) continue;
    matrices_of(pair, f, count, rates, out);
    out.mortar.has_rates[f] = rates;
    add_facet<Dim>(out.mortar.facets[f], pair.slave.boundary.facets[f], out.mortar.slots[f],
                   out.mortar.overlaps[f][0], x, out.mortar.nodes);
  }
}

// ---- evaluation ---------------------------------------------------------------------------------

template <int Dim>
bool in_contact(std::span<const std::size_t> local, const std::vector<PointResult<Dim>>& points) {
  return std::any_of(local.begin(), local.end(),
                     [&](std::size_t i) { return points[i].status != Status::open; });
}

/// Derivatives of the matrices of slave facet `f`, which came into contact unexpectedly.
template <int Dim>
void add_derivatives(const PairDefinition<Dim>& pair, const MortarSides<Dim>& sides, std::size_t f,
                     Points<Dim> x, PairEvaluation<Dim>& out) {
  std::size_t count = 0;
  for (const Index m : out.mortar.overlaps[f]) {
    if (out.mortar.cells.size() <= count) out.mortar.cells.emplace_back();
    if (mortar_cell(sides, static_cast<Index>(f), out.mortar.slots[f], m, x, true,
                    out.mortar.cells[count]))
      ++count;
  }
  matrices_of(pair, f, count, true, out);
}

/// Blocks of the facets, and all rates of the nodes.
template <int Dim>
void add_tangents(const PairDefinition<Dim>& pair, Points<Dim> x, PairEvaluation<Dim>& out) {
  const MortarSides<Dim> sides = sides_of(pair, out);
  std::size_t used = pair.slave.nodes.size();
  for (std::size_t f = 0; f < out.mortar.overlaps.size(); ++f) {
    if (out.mortar.overlaps[f].empty() || !in_contact<Dim>(out.mortar.slots[f], out.points))
      continue;
    if (!out.mortar.has_rates[f]) add_derivatives(pair, sides, f, x, out);
    const auto& facet = pair.slave.boundary.facets[f];
    const std::span<const Index> slaves(facet.nodes.data(), at(facet.count));
    add_rates<Dim>(out.mortar.facets[f], slaves, out.mortar.slots[f], x, out.mortar.nodes);
    if (out.blocks.size() <= used) out.blocks.emplace_back();
    set_facet_tangent<Dim>(out.mortar.facets[f], slaves, out.mortar.slots[f], out.mortar.tractions,
                           out.blocks[used++]);
  }
  for (std::size_t k = used; k < out.blocks.size(); ++k) out.blocks[k].count = 0;
}

/// Parts of a node's area smaller than this are nothing.
template <int Dim>
bool covered(const MortarNode<Dim>& node, const NodalNormal<Dim>& normal, double full) {
  constexpr double nothing = 1e-8;
  return node.facet >= 0 && node.area > nothing * full && normal.value.squaredNorm() > 0;
}

/// Place of slave node `i` at the end of the last increment.
template <int Dim>
const MortarPlace& last_place(const PairState<Dim>& committed, std::size_t i) {
  static const MortarPlace none;
  return committed.places.empty() ? none : committed.places[i];
}

/// Place and traction of slave node `i`.
template <int Dim>
NodeContact<Dim> project_and_evaluate(const PairDefinition<Dim>& pair, Points<Dim> x,
                                      const PairState<Dim>& committed,
                                      const ActiveSet<Dim>& active_set,
                                      const PairMultipliers<Dim>* multipliers, std::size_t i,
                                      PairEvaluation<Dim>& out) {
  PointContext<Dim> context = context_of(pair, active_set, multipliers, i);
  const MortarNode<Dim>& node = out.mortar.nodes[i];
  const PointHistory<Dim>& history = committed.points[i];
  ContactBlock<Dim>& block = out.blocks[i];
  clear_block(block);
  block.nodes.clear();
  block.tangent.resize(0, 0);
  out.points[i] = open_result(history, node.area);
  start_constraint(pair, context, i, block);
  if (!covered<Dim>(node, out.mortar.normals[i], pair.reference_areas[i])) return {};
  NodeContact<Dim> c = project_node<Dim>(node, out.mortar.normals[i]);
  out.mortar.places[i] = node.masters;
  for (double& weight : out.mortar.places[i].weights) weight /= node.area;
  context.way = way_of_gap(pair, active_set, history, node.facet, c.sample.gap);
  if (evaluate_node<Dim>(pair, x, history, last_place<Dim>(committed, i), node, context, i, c, out))
    out.mortar.tractions[i] = c.traction();
  return c;
}

}  // namespace

template <int Dim>
void evaluate_mortar(const PairDefinition<Dim>& pair, Points<Dim> x,
                     const PairState<Dim>& committed, bool with_tangent, PairEvaluation<Dim>& out,
                     const ActiveSet<Dim>& active_set, const PairMultipliers<Dim>* multipliers) {
  refresh<Dim>(pair, x, committed, active_set, with_tangent, out);
  const std::size_t n = pair.slave.nodes.size();
  out.points.assign(n, {});
  out.mortar.places.resize(n);
  for (MortarPlace& place : out.mortar.places) empty(place);
  out.mortar.tractions.assign(n, Vec<Dim>::Zero());
  out.blocks.resize(std::max(n, out.blocks.size()));
  out.mortar.contacts.assign(n, {});
  for (std::size_t i = 0; i < n; ++i) {
    out.mortar.contacts[i] =
        project_and_evaluate<Dim>(pair, x, committed, active_set, multipliers, i, out);
  }
  for (std::size_t k = n; k < out.blocks.size(); ++k) out.blocks[k].count = 0;
  if (!with_tangent) return;
  add_tangents<Dim>(pair, x, out);
  for (std::size_t i = 0; i < n; ++i) {
    if (out.points[i].status == Status::open) continue;
    set_path<Dim>(pair, constraint_weight(pair, i), out.mortar.contacts[i],
                  last_place<Dim>(committed, i), out.mortar.normals[i], out.mortar.nodes[i],
                  out.blocks[i]);
  }
}

template <int Dim>
PairState<Dim> initial_mortar_state(const PairDefinition<Dim>& pair, Points<Dim> x) {
  PairState<Dim> state;
  state.points.resize(pair.slave.nodes.size());
  PairEvaluation<Dim> work;
  evaluate_mortar<Dim>(pair, x, state, false, work);
  state = commit(work);
  if (is<TiedNormal>(pair.separation)) {
    for (PointHistory<Dim>& h : state.points)
      if (h.facet >= 0) hold(pair, h);
    evaluate_mortar<Dim>(pair, x, state, false, work);
    state = commit(work);
  }
  for (PointHistory<Dim>& h : state.points) {  // what it remembers has not slipped
    h.traction.setZero();
    h.slip.setZero();
    h.slid = 0;
    h.slipping = false;
    h.friction_work = h.damping_work = 0;
    h.deepest = std::numeric_limits<double>::infinity();
  }
  return state;
}

template <int Dim>
Mat<Dim, Dim - 1> mortar_frame(const PairDefinition<Dim>& pair, std::size_t i, Points<Dim> x) {
  NodalNormal<Dim> normal;
  nodal_normal(pair.slave, i, x, false, normal);
  return normal.frame;
}

template void evaluate_mortar<2>(const PairDefinition<2>&, Points<2>, const PairState<2>&, bool,
                                 PairEvaluation<2>&, const ActiveSet<2>&,
                                 const PairMultipliers<2>*);
template void evaluate_mortar<3>(const PairDefinition<3>&, Points<3>, const PairState<3>&, bool,
                                 PairEvaluation<3>&, const ActiveSet<3>&,
                                 const PairMultipliers<3>*);
template PairState<2> initial_mortar_state<2>(const PairDefinition<2>&, Points<2>);
template PairState<3> initial_mortar_state<3>(const PairDefinition<3>&, Points<3>);
template Mat<2, 1> mortar_frame<2>(const PairDefinition<2>&, std::size_t, Points<2>);
template Mat<3, 2> mortar_frame<3>(const PairDefinition<3>&, std::size_t, Points<3>);

}  // namespace osculate::pairing
