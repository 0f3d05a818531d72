#include "osculate/pairing/mortar.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "osculate/pairing/closest.hpp"
#include "osculate/pairing/friction_branch.hpp"
#include "osculate/pairing/mortar_basis.hpp"

namespace osculate::pairing {
namespace {

using contact::PointHistory;
using contact::Status;
using contact::TangentialResponse;

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

/// Of several layers of master the nearest: cells are taken by distance while the facet has room.
template <int Dim>
void drop_covered(std::vector<MortarCell<Dim>>& cells, std::size_t& count) {
  constexpr double room = 1 + 1e-3;
  double cover = 0;
  for (std::size_t c = 0; c < count; ++c) cover += cells[c].cover;
  if (cover <= room) return;
  std::stable_sort(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(count),
                   [](const MortarCell<Dim>& a, const MortarCell<Dim>& b) {
                     return std::abs(a.distance) < std::abs(b.distance);
                   });
  cover = 0;
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

/// Cells of slave facet `f`, without derivatives; returns how many.
template <int Dim>
std::size_t find_cells(const MortarSides<Dim>& sides, const SlaveSide<Dim>& slave, std::size_t f,
                       Points<Dim> x, MortarEvaluation<Dim>& out) {
  std::vector<Index>& near = out.overlaps[f];
  near.clear();
  if (!usable<Dim>(out.slots[f], out.normals)) return 0;
  out.tree.for_each_overlap(reach_of(slave, f, x), [&](Index m) { near.push_back(m); });
  std::sort(near.begin(), near.end());
  std::size_t count = 0;
  for (const Index m : near) {
    if (out.cells.size() <= count) out.cells.emplace_back();
    if (mortar_cell(sides, static_cast<Index>(f), out.slots[f], m, x, false, out.cells[count]))
      ++count;
  }
  drop_covered(out.cells, count);
  near.clear();
  for (std::size_t c = 0; c < count; ++c) near.push_back(out.cells[c].master);
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
      const double m = matrices.m(j, static_cast<Eigen::Index>(l));
      node.other += m * x[at(matrices.masters[l])];
      add_weight(node.masters, matrices.masters[l], m);
    }
  }
}

template <int Dim>
MortarSides<Dim> sides_of(const PairDefinition<Dim>& pair, Points<Dim> reference,
                          const MortarEvaluation<Dim>& out) {
  return {&pair.slave.boundary,
          &pair.master,
          {pair.weight == Weight::current_area, pair.area, reference},
          out.normals};
}

/// D and M of slave facet `f` from its first `count` cells.
template <int Dim>
void matrices_of(const PairDefinition<Dim>& pair, std::size_t f, std::size_t count,
                 bool derivatives, MortarEvaluation<Dim>& out) {
  constexpr double rounding = 1e-6;
  double cover = 0;
  for (std::size_t c = 0; c < count; ++c) cover += out.cells[c].cover;
  mortar_facet<Dim>(std::span(out.cells).first(count), pair.master,
                    multiplier_basis(pair.slave.boundary.facets[f], cover > 1 - rounding),
                    derivatives, out.facet);
}

template <int Dim>
void refresh(const PairDefinition<Dim>& pair, Points<Dim> x, Points<Dim> reference,
             bool with_tangent, MortarEvaluation<Dim>& out) {
  const std::size_t n = pair.slave.nodes.size();
  set_slots(pair.slave, out.slots);
  out.normals.resize(n);
  out.nodes.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    nodal_normal(pair.slave, i, x, with_tangent, out.normals[i]);
    MortarNode<Dim>& node = out.nodes[i];
    node.area = 0;
    node.own.setZero();
    node.other.setZero();
    for (MortarPlace* const place : {&node.slaves, &node.masters}) {
      place->nodes.clear();
      place->weights.clear();
    }
    node.facet = -1;
    node.rates.clear();
  }
  const std::size_t before = out.boxes.size();
  facet_boxes(pair.master, x, out.boxes);
  if (before == out.boxes.size() && before > 0)
    out.tree.refit(out.boxes);
  else
    out.tree = Tree<Dim>(out.boxes);
  out.overlaps.resize(pair.slave.boundary.facets.size());
  const MortarSides<Dim> sides = sides_of(pair, reference, out);
  for (std::size_t f = 0; f < out.overlaps.size(); ++f) {
    const std::size_t count = find_cells(sides, pair.slave, f, x, out);
    if (count == 0) continue;
    matrices_of(pair, f, count, false, out);
    add_facet<Dim>(out.facet, pair.slave.boundary.facets[f], out.slots[f], out.overlaps[f][0], x,
                   out.nodes);
  }
}

// ---- tractions of the nodes ---------------------------------------------------------------------

/// A slave node in contact, with what its derivatives need.
template <int Dim>
struct NodeContact {
  Vec<Dim> foot, apart;  ///< y and x - y
  Vec<Dim> normal;       ///< out of the master
  Mat<Dim, Dim - 1> frame;
  double gap = 0;
  contact::NormalResponse normal_law;
  bool sliding = false;  ///< there is friction and a last place
  ContactShare share;
  Vec<Dim> way = Vec<Dim>::Zero();  ///< y - y_old
  Vec<Dim - 1> trial = Vec<Dim - 1>::Zero();
  TangentialResponse<Dim> law, linearised;
};

template <int Dim>
Vec<Dim> place_in_space(const MortarPlace& place, Points<Dim> x) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (std::size_t l = 0; l < place.nodes.size(); ++l)
    sum += place.weights[l] * x[at(place.nodes[l])];
  return sum;
}

template <int Dim>
NodeContact<Dim> place_node(const MortarNode<Dim>& node, const NodalNormal<Dim>& normal) {
  NodeContact<Dim> c;
  c.foot = node.other / node.area;
  c.apart = node.own / node.area - c.foot;
  c.normal = -normal.value;
  c.frame = normal.frame;
  c.gap = c.normal.dot(c.apart);
  return c;
}

template <int Dim>
void set_friction(const contact::Coulomb& law, const PointHistory<Dim>& history,
                  const MortarPlace& last, Points<Dim> x, const BranchHint<Dim>& hint,
                  NodeContact<Dim>& c) {
  if (history.active) c.trial = history.traction;
  c.sliding = !last.nodes.empty();
  if (c.sliding) {
    c.share = contact_share(history, c.gap);
    c.way = c.foot - place_in_space<Dim>(last, x);
    c.trial += law.stiffness * c.share.value * (c.frame.transpose() * c.way);
  }
  const double normal = c.normal_law.traction;
  c.law = law.template response<Dim>(c.trial, normal);
  c.linearised = linearised_branch<Dim>(law, c.law, c.trial, normal, c.frame, hint);
}

template <int Dim>
void report(const PairDefinition<Dim>& pair, const PointHistory<Dim>& old,
            const MortarNode<Dim>& node, const NodeContact<Dim>& c, PointResult<Dim>& result) {
  result.gap = c.gap;
  result.foot = c.foot;
  result.normal = c.normal;
  result.frame = c.frame;
  PointHistory<Dim>& h = result.history;
  h.facet = node.facet;
  h.feature = projection::Feature::face;
  h.gap = c.gap;
  h.active = c.normal_law.active;
  if (!h.active) return;
  result.status = pair.friction ? c.law.status : Status::slip;
  result.normal_traction = c.normal_law.traction;
  if (!pair.friction) return;
  result.branch = branch_of<Dim>(c.linearised, c.frame);
  result.shear_traction = c.law.traction;
  result.slip_increment = c.share.value * (c.frame.transpose() * c.way);
  h.traction = c.law.traction;
  h.slipping = c.law.status == Status::slip;
  h.slip = result.slip_increment;
  if (old.active) h.slip += old.slip;
  h.friction_work += node.area * pair.friction->template dissipated<Dim>(c.trial, c.law);
}

template <int Dim>
void set_forces(const MortarNode<Dim>& node, const NodeContact<Dim>& c, MortarBlock<Dim>& block) {
  const std::size_t own = node.slaves.nodes.size();
  block.slave_count = static_cast<int>(own);
  block.nodes = node.slaves.nodes;
  block.nodes.insert(block.nodes.end(), node.masters.nodes.begin(), node.masters.nodes.end());
  const auto rows = Dim * static_cast<Eigen::Index>(block.nodes.size());
  const Vec<Dim> push = c.normal_law.traction * c.normal;
  const Vec<Dim> lawful = push + c.frame * c.law.traction,
                 linear = push + c.frame * c.linearised.traction;
  block.branched = c.law.traction != c.linearised.traction;
  block.force.resize(rows);
  block.branch_force.resize(rows);
  block.path_rows.resize(rows, Dim);
  for (std::size_t k = 0; k < block.nodes.size(); ++k) {
    const double weight = k < own ? node.slaves.weights[k] : -node.masters.weights[k - own];
    const auto row = Dim * static_cast<Eigen::Index>(k);
    block.force.template segment<Dim>(row) = weight * lawful;
    block.branch_force.template segment<Dim>(row) = weight * linear;
    block.path_rows.template middleRows<Dim>(row) = weight * Mat<Dim, Dim>::Identity();
  }
}

// ---- derivatives --------------------------------------------------------------------------------

template <int Dim>
typename MortarNode<Dim>::Rate& rate_of(MortarNode<Dim>& node, Index by) {
  for (typename MortarNode<Dim>::Rate& r : node.rates)
    if (r.node == by) return r;
  node.rates.emplace_back();
  node.rates.back().node = by;
  for (Mat<Dim, Dim>& m : node.rates.back().frame) m.setZero();
  return node.rates.back();
}

/// Derivatives of d_j, sum_k D_jk x_k and sum_l M_jl x_l of the facet's nodes.
template <int Dim>
void add_rates(const MortarFacet<Dim>& matrices, std::span<const Index> slaves,
               std::span<const std::size_t> local, Points<Dim> x,
               std::vector<MortarNode<Dim>>& nodes) {
  const Eigen::Index n = matrices.d.size();
  for (Eigen::Index j = 0; j < n; ++j) {
    MortarNode<Dim>& node = nodes[local[static_cast<std::size_t>(j)]];
    for (std::size_t c = 0; c < matrices.nodes.size(); ++c) {
      const auto column = Dim * static_cast<Eigen::Index>(c);
      typename MortarNode<Dim>::Rate& rate = rate_of(node, matrices.nodes[c]);
      rate.area += matrices.dd.template block<1, Dim>(j, column).transpose();
      Eigen::Index row = j;
      for (const Index k : slaves) {
        rate.own += x[at(k)] * matrices.ds.template block<1, Dim>(row, column);
        row += n;
      }
      row = j;
      for (const Index l : matrices.masters) {
        rate.other += x[at(l)] * matrices.dm.template block<1, Dim>(row, column);
        row += n;
      }
    }
  }
}

/// The derivatives of D and M times the tractions.
template <int Dim>
void set_facet_tangent(const MortarFacet<Dim>& matrices, std::span<const Index> slaves,
                       std::span<const std::size_t> local, std::span<const Vec<Dim>> tractions,
                       MortarBlock<Dim>& block) {
  block.nodes = matrices.nodes;
  block.slave_count = 0;
  block.branched = false;
  block.path.clear();
  const auto size = Dim * static_cast<Eigen::Index>(block.nodes.size());
  const Eigen::Index n = matrices.d.size();
  block.force.setZero(size);
  block.branch_force.setZero(size);
  block.tangent.setZero(size, size);
  block.path_rows.setZero(size, Dim);
  const auto row_of = [&](Index node) {
    return Dim * static_cast<Eigen::Index>(slot_of(block.nodes, node));
  };
  for (Eigen::Index j = 0; j < n; ++j) {
    const Vec<Dim>& t = tractions[local[static_cast<std::size_t>(j)]];
    if (t.squaredNorm() == 0) continue;
    Eigen::Index row = j;
    for (const Index k : slaves) {
      block.tangent.template middleRows<Dim>(row_of(k)) += t * matrices.ds.row(row);
      row += n;
    }
    row = j;
    for (const Index l : matrices.masters) {
      block.tangent.template middleRows<Dim>(row_of(l)) -= t * matrices.dm.row(row);
      row += n;
    }
  }
}

template <int Dim>
void complete_rates(const MortarPlace& last, const NodalNormal<Dim>& normal,
                    MortarNode<Dim>& node) {
  const auto at_fixed = [&](const MortarPlace& place, auto member) {
    for (std::size_t k = 0; k < place.nodes.size(); ++k)
      (rate_of(node, place.nodes[k]).*member).diagonal().array() += place.weights[k];
  };
  at_fixed(node.slaves, &MortarNode<Dim>::Rate::own);
  at_fixed(node.masters, &MortarNode<Dim>::Rate::other);
  for (std::size_t l = 0; l < last.nodes.size(); ++l)
    rate_of(node, last.nodes[l]).old += last.weights[l];
  for (const NodeMatrix<Dim>& g : normal.gradient) rate_of(node, g.node).normal -= g.value;
  for (std::size_t i = 0; i < normal.frame_gradient.size(); ++i)
    for (const NodeMatrix<Dim>& g : normal.frame_gradient[i])
      rate_of(node, g.node).frame[i] += g.value;
}

/// Derivative of the traction t_j = N n + E t by the position of one node.
template <int Dim>
Mat<Dim, Dim> traction_rate(const PairDefinition<Dim>& pair, const NodeContact<Dim>& c, double area,
                            const typename MortarNode<Dim>::Rate& r) {
  using Row = Eigen::Matrix<double, 1, Dim>;
  const Mat<Dim, Dim> unit = Mat<Dim, Dim>::Identity();
  const Mat<Dim, Dim> d_foot = (r.other - c.foot * r.area.transpose()) / area;
  const Mat<Dim, Dim> d_apart = (r.own - r.other - c.apart * r.area.transpose()) / area;
  const Row d_gap = c.normal.transpose() * d_apart + c.apart.transpose() * r.normal;
  const Row d_push = c.normal_law.d_traction * d_gap;
  Mat<Dim, Dim> out = c.normal * d_push + c.normal_law.traction * r.normal;
  if (!pair.friction) return out;
  Mat<Dim - 1, Dim> d_trial = Mat<Dim - 1, Dim>::Zero();
  if (c.sliding)
    for (int i = 0; i < Dim - 1; ++i) {
      const Vec<Dim> e = c.frame.col(i);
      d_trial.row(i) = pair.friction->stiffness *
                       (c.share.value * (e.transpose() * (d_foot - r.old * unit) +
                                         c.way.transpose() * r.frame[static_cast<std::size_t>(i)]) +
                        c.share.d_gap * e.dot(c.way) * d_gap);
    }
  const Mat<Dim - 1, Dim> d_shear = c.linearised.d_trial * d_trial + c.linearised.d_normal * d_push;
  out += c.frame * d_shear;
  for (int i = 0; i < Dim - 1; ++i)
    out += c.linearised.traction[i] * r.frame[static_cast<std::size_t>(i)];
  return out;
}

template <int Dim>
bool in_contact(std::span<const std::size_t> local, const std::vector<PointResult<Dim>>& points) {
  return std::any_of(local.begin(), local.end(),
                     [&](std::size_t i) { return points[i].status != Status::open; });
}

/// Blocks of the facets, and all rates of the nodes.
template <int Dim>
void add_tangents(const PairDefinition<Dim>& pair, Points<Dim> x, Points<Dim> reference,
                  MortarEvaluation<Dim>& out) {
  const MortarSides<Dim> sides = sides_of(pair, reference, out);
  std::size_t used = pair.slave.nodes.size();
  for (std::size_t f = 0; f < out.overlaps.size(); ++f) {
    if (out.overlaps[f].empty() || !in_contact<Dim>(out.slots[f], out.points)) continue;
    std::size_t count = 0;
    for (const Index m : out.overlaps[f]) {
      if (out.cells.size() <= count) out.cells.emplace_back();
      if (mortar_cell(sides, static_cast<Index>(f), out.slots[f], m, x, true, out.cells[count]))
        ++count;
    }
    matrices_of(pair, f, count, true, out);
    const auto& facet = pair.slave.boundary.facets[f];
    const std::span<const Index> slaves(facet.nodes.data(), at(facet.count));
    add_rates<Dim>(out.facet, slaves, out.slots[f], x, out.nodes);
    if (out.blocks.size() <= used) out.blocks.emplace_back();
    set_facet_tangent<Dim>(out.facet, slaves, out.slots[f], out.tractions, out.blocks[used++]);
  }
  out.blocks.resize(used);
}

template <int Dim>
void clear(MortarBlock<Dim>& block) {
  block.nodes.clear();
  block.path.clear();
  block.tangent.resize(0, 0);
  block.branched = false;
}

/// Parts of a node's area smaller than this are nothing.
template <int Dim>
bool covered(const MortarNode<Dim>& node, const NodalNormal<Dim>& normal, double full) {
  constexpr double nothing = 1e-8;
  return node.facet >= 0 && node.area > nothing * full && normal.value.squaredNorm() > 0;
}

}  // namespace

template <int Dim>
void evaluate_mortar(const PairDefinition<Dim>& pair, Points<Dim> x, Points<Dim> reference,
                     const MortarState<Dim>& committed, bool with_tangent,
                     MortarEvaluation<Dim>& out, const Assumed<Dim>& assumed) {
  refresh<Dim>(pair, x, reference, with_tangent, out);
  const std::size_t n = pair.slave.nodes.size();
  out.points.assign(n, {});
  out.places.assign(n, {});
  out.tractions.assign(n, Vec<Dim>::Zero());
  out.blocks.resize(std::max(n, out.blocks.size()));
  std::vector<NodeContact<Dim>> contacts(n);
  for (std::size_t i = 0; i < n; ++i) {
    const MortarNode<Dim>& node = out.nodes[i];
    PointResult<Dim>& result = out.points[i];
    clear(out.blocks[i]);
    result.gap = std::numeric_limits<double>::infinity();
    result.weight = node.area;
    result.history.friction_work = committed.points[i].friction_work;
    if (!covered<Dim>(node, out.normals[i], pair.reference_areas[i])) continue;
    NodeContact<Dim>& c = contacts[i];
    c = place_node<Dim>(node, out.normals[i]);
    out.places[i] = node.masters;
    for (double& weight : out.places[i].weights) weight /= node.area;
    if (c.gap >= -pair.depth) c.normal_law = pair.normal.response(c.gap);
    BranchHint<Dim> hint;
    if (!assumed.branch.empty()) hint = {assumed.branch[i], assumed.predict};
    if (c.normal_law.active && pair.friction)
      set_friction<Dim>(*pair.friction, committed.points[i], committed.places[i], x, hint, c);
    report<Dim>(pair, committed.points[i], node, c, result);
    if (!c.normal_law.active) continue;
    set_forces<Dim>(node, c, out.blocks[i]);
    out.tractions[i] = c.normal_law.traction * c.normal + c.frame * c.linearised.traction;
  }
  if (!with_tangent) {
    out.blocks.resize(n);
    return;
  }
  add_tangents<Dim>(pair, x, reference, out);
  for (std::size_t i = 0; i < n; ++i) {
    if (out.points[i].status == Status::open) continue;
    complete_rates<Dim>(committed.places[i], out.normals[i], out.nodes[i]);
    for (const typename MortarNode<Dim>::Rate& r : out.nodes[i].rates)
      out.blocks[i].path.push_back(
          {r.node, traction_rate<Dim>(pair, contacts[i], out.nodes[i].area, r)});
  }
}

template <int Dim>
MortarState<Dim> initial_mortar_state(const PairDefinition<Dim>& pair, Points<Dim> x,
                                      Points<Dim> reference) {
  MortarState<Dim> state;
  state.points.resize(pair.slave.nodes.size());
  state.places.resize(state.points.size());
  MortarEvaluation<Dim> work;
  evaluate_mortar<Dim>(pair, x, reference, state, false, work);
  state = commit(work);
  for (PointHistory<Dim>& h : state.points) {
    h.traction.setZero();
    h.slip.setZero();
    h.slipping = false;
    h.friction_work = 0;
  }
  return state;
}

template <int Dim>
MortarState<Dim> commit(const MortarEvaluation<Dim>& evaluation) {
  MortarState<Dim> state;
  for (const PointResult<Dim>& point : evaluation.points) state.points.push_back(point.history);
  state.places = evaluation.places;
  return state;
}

template void evaluate_mortar<3>(const PairDefinition<3>&, Points<3>, Points<3>,
                                 const MortarState<3>&, bool, MortarEvaluation<3>&,
                                 const Assumed<3>&);
template MortarState<3> initial_mortar_state<3>(const PairDefinition<3>&, Points<3>, Points<3>);
template MortarState<3> commit<3>(const MortarEvaluation<3>&);
template void evaluate_mortar<2>(const PairDefinition<2>&, Points<2>, Points<2>,
                                 const MortarState<2>&, bool, MortarEvaluation<2>&,
                                 const Assumed<2>&);
template MortarState<2> initial_mortar_state<2>(const PairDefinition<2>&, Points<2>, Points<2>);
template MortarState<2> commit<2>(const MortarEvaluation<2>&);

}  // namespace osculate::pairing
