#include "osculate/pairing/pair.hpp"

#include <chrono>
#include <cmath>

#include "osculate/core/error.hpp"
#include "osculate/pairing/point_block.hpp"

namespace osculate::pairing {

using contact::Branch;
using contact::Kinematics;
using contact::PointHistory;
using contact::PointTerms;
using contact::Status;
using contact::TangentialResponse;
using contact::Traction;
using projection::Feature;

template <int Dim>
void prepare(PairDefinition<Dim>& pair, Points<Dim> reference) {
  nodal_areas(pair.slave, reference, pair.area, pair.reference_areas, nullptr);
  if constexpr (Dim == 3)
    prepare_edges(pair.edges, pair.master, pair.slave, pair.reference_areas, reference);
  if (pair.weight == Weight::node) return;
  for (const double area : pair.reference_areas)
    if (!(area > 0))
      throw core::GeometryError("a slave node has no positive tributary area; use weight: node");
}

namespace {

/// Adds the time since the last call to one of the phases.
class Laps {
 public:
  void add_to(double& seconds) {
    const auto now = std::chrono::steady_clock::now();
    seconds += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

template <int Dim>
ContactShare contact_share(const PointHistory<Dim>& history, double gap) {
  if (history.active || history.facet < 0 || !(history.gap > 0)) return {};
  const double range = history.gap - gap;
  return {-gap / range, -history.gap / (range * range)};
}

template <int Dim>
struct Friction {
  Traction<Dim> traction;
  TangentialResponse<Dim> law;  ///< what the law says; `traction` may be in another branch
  Vec<Dim - 1> slip = Vec<Dim - 1>::Zero();  ///< of the increment, times the share in contact
  double dissipated = 0;                     ///< per area (or per node) in the increment
};

/// What is known of a point's branch before the law is asked.
template <int Dim>
struct BranchHint {
  AssumedBranch<Dim> assumed;
  bool predict = false;
};

template <int Dim>
TangentialResponse<Dim> linearised_branch(const contact::Coulomb& law,
                                          const TangentialResponse<Dim>& response,
                                          const Vec<Dim - 1>& trial, double normal,
                                          const Mat<Dim, Dim - 1>& frame,
                                          const BranchHint<Dim>& hint) {
  if (hint.predict && hint.assumed.branch == Branch::stick)
    return contact::Coulomb::stick<Dim>(trial);  // also on the limit, whatever round-off says
  if (hint.assumed.branch != Branch::slip) return response;
  const Vec<Dim - 1> before = frame.transpose() * hint.assumed.direction;
  const double size = before.norm();
  if (!(size > 0)) return response;
  if (hint.predict) {
    const double limit = law.mu * std::abs(normal);
    const double turning = limit > 0 ? limit / std::max(limit, trial.norm()) : 0.0;
    return law.template slip<Dim>(before / size, normal, turning);
  }
  const bool reversed = response.status == Status::slip && before.dot(trial) < 0;
  return reversed ? contact::Coulomb::stick<Dim>(trial) : response;
}

template <int Dim>
AssumedBranch<Dim> branch_of(const TangentialResponse<Dim>& response,
                             const Mat<Dim, Dim - 1>& frame) {
  if (response.status == Status::stick) return {Branch::stick, Vec<Dim>::Zero()};
  const double size = response.traction.norm();
  if (!(size > 0)) return {Branch::slip, Vec<Dim>::Zero()};
  return {Branch::slip, frame * (response.traction / size)};
}

template <int Dim>
Friction<Dim> tractions(const PairDefinition<Dim>& pair, const PointHistory<Dim>& history,
                        const Placed<Dim>& placed, Points<Dim> x, const BranchHint<Dim>& hint,
                        PathBuffers<Dim>* path) {
  Friction<Dim> f;
  const Kinematics<Dim>& k = placed.kinematics;
  f.traction.normal = pair.normal.response(k.gap);
  if (!f.traction.normal.active || !pair.friction) return f;
  const contact::Coulomb& law = *pair.friction;
  const Trial<Dim> tr =
      trial(pair.master, history, placed, law.stiffness, contact_share(history, k.gap), x, path);
  const double normal = f.traction.normal.traction;
  f.slip = tr.slip;
  f.law = law.template response<Dim>(tr.value, normal);
  f.dissipated = law.template dissipated<Dim>(tr.value, f.law);
  f.traction.tangential = linearised_branch<Dim>(law, f.law, tr.value, normal, k.frame, hint);
  f.traction.stiffness = law.stiffness;
  f.traction.d_trial = tr.variation;
  return f;
}

template <int Dim>
void set_nodes(ContactBlock<Dim>& block, const Boundary<Dim>& master, const Placed<Dim>& placed,
               Index slave) {
  const auto& facet = master.facets[static_cast<std::size_t>(placed.projection.facet)];
  block.count = 1 + placed.count;
  block.nodes[0] = slave;
  for (std::size_t k = 0; k < static_cast<std::size_t>(placed.count); ++k)
    block.nodes[k + 1] = facet.nodes[k];
}

template <int Dim>
void scatter_forces(BlockVector<Dim>& force, int count, const Weights<Dim>& w,
                    const PointTerms<Dim>& terms, double area) {
  for (int k = 0; k < count; ++k) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (std::size_t a = 0; a < terms.f.size(); ++a)
      sum += w[a][static_cast<std::size_t>(k)] * terms.f[a];
    force.template segment<Dim>(Dim * k) = area * sum;
  }
}

template <int Dim>
void scatter_path(ContactBlock<Dim>& block, const Weights<Dim>& w, const PointTerms<Dim>& terms,
                  double area) {
  for (int k = 0; k < block.count; ++k) {
    Mat<Dim, Dim> behind = Mat<Dim, Dim>::Zero();
    for (std::size_t a = 0; a < terms.s.size(); ++a)
      behind += w[a][static_cast<std::size_t>(k)] * terms.s[a];
    block.path_rows.template middleRows<Dim>(Dim * k) = area * behind;
  }
}

template <int Dim>
PointHistory<Dim> next_history(const PairDefinition<Dim>& pair, Points<Dim> x,
                               const PointHistory<Dim>& old, const Placed<Dim>& placed,
                               const Friction<Dim>& f) {
  PointHistory<Dim> h;
  h.facet = placed.projection.facet;
  h.feature = placed.projection.feature;
  h.xi = placed.projection.xi;
  h.gap = placed.kinematics.gap;
  h.active = f.traction.normal.active;
  h.friction_work = old.friction_work;
  if (!h.active) return h;
  h.traction = stored_components(pair.master, placed, f.law.traction, x);
  h.slipping = f.law.status == Status::slip;
  h.slip = f.slip;
  if (old.active) h.slip += old.slip;
  return h;
}

template <int Dim>
double point_weight(const PairDefinition<Dim>& pair, const PairEvaluation<Dim>& work,
                    std::size_t i) {
  switch (pair.weight) {
    case Weight::node:
      return 1.0;
    case Weight::reference_area:
      return pair.reference_areas[i];
    case Weight::current_area:
      return work.areas[i];
  }
  return 1.0;
}

template <int Dim>
void clear(ContactBlock<Dim>& block) {
  block.count = 0;
  block.branched = false;
  block.behind.path.clear();
  block.area.clear();
}

/// Where the point is; false where it is not in contact.
template <int Dim>
bool report_place(const PairDefinition<Dim>& pair, Points<Dim> x, const PointHistory<Dim>& history,
                  const Placed<Dim>& placed, PointResult<Dim>& result) {
  if (placed.projection.feature == Feature::none) return false;
  const Kinematics<Dim>& k = placed.kinematics;
  result.gap = k.gap;
  result.foot = placed.foot;
  result.normal = k.normal;
  result.frame = k.frame;
  result.history = next_history<Dim>(pair, x, history, placed, {});
  if (placed.projection.beyond_end) result.history.gap = result.gap = std::abs(k.gap);
  const bool closed = !placed.projection.beyond_end && k.gap >= -pair.depth && k.gap <= 0;
  result.outside_domain = closed && !contact::inside_domain(k);
  return closed && !result.outside_domain;
}

template <int Dim>
void evaluate_point(const PairDefinition<Dim>& pair, Points<Dim> x,
                    const PointHistory<Dim>& history, const Placed<Dim>& placed,
                    const BranchHint<Dim>& hint, bool with_tangent, std::size_t i,
                    PairEvaluation<Dim>& out) {
  PointResult<Dim>& result = out.points[i];
  ContactBlock<Dim>& block = out.blocks[i];
  result = {};
  clear(block);
  result.weight = point_weight(pair, out, i);
  result.history.friction_work = history.friction_work;
  result.gap = std::numeric_limits<double>::infinity();
  if (!report_place(pair, x, history, placed, result)) return;
  const Kinematics<Dim>& k = placed.kinematics;
  const bool exact = with_tangent && pair.tangent.consistent;
  const Friction<Dim> f =
      tractions<Dim>(pair, history, placed, x, hint, exact ? &block.behind : nullptr);
  result.history = next_history(pair, x, history, placed, f);
  result.history.friction_work += result.weight * f.dissipated;
  result.status = !pair.friction ? Status::slip : f.law.status;
  if (pair.friction) result.branch = branch_of<Dim>(f.traction.tangential, k.frame);
  result.normal_traction = f.traction.normal.traction;
  result.shear_traction = f.law.traction;
  result.slip_increment = f.slip;

  set_nodes(block, pair.master, placed, pair.slave.nodes[i]);
  const Weights<Dim> w = contact_weights(placed);
  const PointTerms<Dim> terms =
      with_tangent ? contact::point_terms(k, f.traction, pair.residual, pair.tangent)
                   : contact::point_forces(k, f.traction, pair.residual);
  scatter_forces(block.branch_force, block.count, w, terms, result.weight);
  block.force = block.branch_force;
  block.branched = pair.friction && f.law.traction != f.traction.tangential.traction;
  if (block.branched) {
    Traction<Dim> lawful = f.traction;
    lawful.tangential = f.law;
    scatter_forces(block.force, block.count, w, contact::point_forces(k, lawful, pair.residual),
                   result.weight);
  }
  if (!with_tangent) return;
  scatter_tangent<Dim>(w, terms, block.count, result.weight, block.tangent);
  scatter_path(block, w, terms, result.weight);
  if (!exact || pair.weight != Weight::current_area) return;
  block.area = out.area_gradients[i];
  scatter_forces(block.area_rows, block.count, w, terms, 1.0);
}

template <int Dim>
void refresh(const PairDefinition<Dim>& pair, Points<Dim> x, bool with_tangent,
             PairEvaluation<Dim>& out) {
  const std::size_t n = pair.slave.nodes.size();
  out.points.resize(n);
  out.blocks.resize(n);
  nodal_normals(pair.slave, x, out.normals);
  if (pair.weight == Weight::current_area)
    nodal_areas(pair.slave, x, pair.area, out.areas, with_tangent ? &out.area_gradients : nullptr);
  const std::size_t before = out.boxes.size();
  facet_boxes(pair.master, x, out.boxes);
  if (before == out.boxes.size() && before > 0)
    out.tree.refit(out.boxes);
  else
    out.tree = Tree<Dim>(out.boxes);
}

// ---- crossings of edges -------------------------------------------------------------------------

/// The pair seen from its crossings: the master is the surface of the edges' differences, with one
/// facet per crossing and then one per history, the slave point is the origin.
PairDefinition<3> pair_of_crossings(const PairDefinition<3>& pair,
                                    const std::vector<Crossing>& found,
                                    std::span<const PointHistory<3>> histories) {
  PairDefinition<3> out;
  out.normal = pair.normal;
  out.friction = pair.friction;
  out.residual = pair.residual;
  out.tangent = pair.tangent;
  out.depth = pair.depth;
  out.weight = pair.weight == Weight::node ? Weight::node : Weight::reference_area;
  const std::size_t nodes = pair.slave.nodes.size();
  out.slave.nodes.assign(nodes + found.size(), -1);
  out.reference_areas.assign(nodes + found.size(), 0.0);
  const auto add = [&](Index master, Index slave, bool flipped) {
    out.master.facets.push_back(crossing_facet(pair.edges.master[static_cast<std::size_t>(master)],
                                               pair.edges.slave[static_cast<std::size_t>(slave)],
                                               flipped));
  };
  for (std::size_t c = 0; c < found.size(); ++c) {
    add(found[c].master, found[c].slave, found[c].flipped);
    out.reference_areas[nodes + c] = pair.edges.areas[static_cast<std::size_t>(found[c].slave)];
  }
  for (const PointHistory<3>& h : histories) add(h.facet, h.edge, h.flipped);
  return out;
}

/// The origin is no node: its rows and columns go.
void drop_origin(ContactBlock<3>& block) {
  if (!block.active()) return;
  const int size = 3 * --block.count;
  std::copy_n(block.nodes.begin() + 1, block.count, block.nodes.begin());
  block.force.head(size) = block.force.segment(3, size).eval();
  block.branch_force.head(size) = block.branch_force.segment(3, size).eval();
  block.tangent.topLeftCorner(size, size) = block.tangent.block(3, 3, size, size).eval();
  block.path_rows.topRows(size) = block.path_rows.middleRows(3, size).eval();
}

/// Histories of the crossings of a committed state.
std::span<const PointHistory<3>> crossing_histories(const PairDefinition<3>& pair,
                                                    const PairState<3>& state) {
  const std::size_t nodes = pair.slave.nodes.size();
  return std::span(state.points).subspan(std::min(nodes, state.points.size()));
}

/// Slave edges with a node in contact.
std::vector<bool> held_edges(const PairDefinition<3>& pair, const PairEvaluation<3>& out) {
  std::vector<bool> held;
  for (const std::array<int, 3>& nodes : pair.edges.slave_nodes)
    held.push_back(std::any_of(nodes.begin(), nodes.end(), [&](int i) {
      return i >= 0 && out.points[static_cast<std::size_t>(i)].status != Status::open;
    }));
  return held;
}

void remember_edges(const PairDefinition<3>& pair, Points<3> x, const Crossing& c,
                    PointResult<3>& result) {
  result.foot = crossing_place(pair.edges.master[static_cast<std::size_t>(c.master)], c.xi[0], x);
  result.history.facet = c.master;
  result.history.edge = c.slave;
  result.history.flipped = c.flipped;
  result.branch.edges = {c.slave, c.master};
}

BranchHint<3> hint_of(const Crossing& c, const Assumed<3>& assumed) {
  for (const AssumedBranch<3>& branch : assumed.branch)
    if (branch.edges == std::array<Index, 2>{c.slave, c.master}) return {branch, assumed.predict};
  return {};
}

/// Appends a point and a block per crossing.
void evaluate_crossings(const PairDefinition<3>& pair, Points<3> x, const PairState<3>& committed,
                        bool with_tangent, PairEvaluation<3>& out, const Assumed<3>& assumed) {
  find_crossings(pair.edges, pair.master, pair.slave.boundary, x, held_edges(pair, out), out.edges);
  const std::vector<Crossing>& found = out.edges.found;
  const std::size_t nodes = pair.slave.nodes.size();
  out.points.resize(nodes + found.size());
  out.blocks.resize(nodes + found.size());
  const std::span<const PointHistory<3>> histories = crossing_histories(pair, committed);
  const PairDefinition<3> differences = pair_of_crossings(pair, found, histories);
  for (std::size_t c = 0; c < found.size(); ++c) {
    const auto facet = static_cast<Index>(c);
    const Placed<3> placed = place_crossing(differences.master.facets[c], facet, found[c].xi, x);
    PointHistory<3> history;
    const int known = history_of_crossing(pair.edges, histories, found, found[c]);
    if (known >= 0) {
      history = histories[static_cast<std::size_t>(known)];
      history.facet = static_cast<Index>(found.size()) + known;
    }
    evaluate_point<3>(differences, x, history, placed, hint_of(found[c], assumed), with_tangent,
                      nodes + c, out);
    drop_origin(out.blocks[nodes + c]);
    remember_edges(pair, x, found[c], out.points[nodes + c]);
  }
}

/// Frame of a crossing's stored traction.
Mat<3, 2> crossing_frame(const PairDefinition<3>& pair, const PointHistory<3>& h, Points<3> x) {
  FacetSurface one;
  one.facets.push_back(crossing_facet(pair.edges.master[static_cast<std::size_t>(h.facet)],
                                      pair.edges.slave[static_cast<std::size_t>(h.edge)],
                                      h.flipped));
  return stored_frame(one, 0, h.xi, x);
}

template <int Dim>
Mat<Dim, Dim - 1> frame_of_history(const PairDefinition<Dim>& pair, const PointHistory<Dim>& h,
                                   Points<Dim> x) {
  if constexpr (Dim == 3)
    if (h.edge >= 0) return crossing_frame(pair, h, x);
  return stored_frame(pair.master, h.facet, h.xi, x);
}

}  // namespace

template <int Dim>
void evaluate(const PairDefinition<Dim>& pair, Points<Dim> x, const PairState<Dim>& committed,
              bool with_tangent, PairEvaluation<Dim>& out, const Assumed<Dim>& assumed) {
  Laps laps;
  refresh(pair, x, with_tangent, out);
  laps.add_to(out.seconds.search);
  for (std::size_t i = 0; i < pair.slave.nodes.size(); ++i) {
    BranchHint<Dim> hint;
    if (!assumed.branch.empty()) hint = {assumed.branch[i], assumed.predict};
    const Placed<Dim> placed = place_point(pair, out, x, i, committed.points[i]);
    laps.add_to(out.seconds.projection);
    evaluate_point(pair, x, committed.points[i], placed, hint, with_tangent, i, out);
    laps.add_to(out.seconds.evaluation);
  }
  if constexpr (Dim == 3) {
    if (!pair.edges.on) return;
    evaluate_crossings(pair, x, committed, with_tangent, out, assumed);
    laps.add_to(out.seconds.evaluation);
  }
}

template <int Dim>
Assumed<Dim> committed_branches(const PairDefinition<Dim>& pair, const PairState<Dim>& committed,
                                Points<Dim> x, bool sticking) {
  Assumed<Dim> assumed;
  assumed.predict = true;
  for (const PointHistory<Dim>& h : committed.points) {
    AssumedBranch<Dim> branch;
    if (h.active) branch.branch = Branch::stick;
    const double size = h.traction.norm();
    if (h.active && h.slipping && size > 0 && !sticking)
      branch = {Branch::slip, frame_of_history(pair, h, x) * (h.traction / size)};
    if (h.edge >= 0) branch.edges = {h.edge, h.facet};
    assumed.branch.push_back(branch);
  }
  return assumed;
}

template <int Dim>
Assumed<Dim> evaluated_branches(const PairEvaluation<Dim>& evaluation) {
  Assumed<Dim> assumed;
  for (const PointResult<Dim>& point : evaluation.points) assumed.branch.push_back(point.branch);
  return assumed;
}

template <int Dim>
PairState<Dim> initial_state(const PairDefinition<Dim>& pair, Points<Dim> x) {
  PairEvaluation<Dim> work;
  refresh(pair, x, false, work);
  PairState<Dim> state;
  state.points.resize(pair.slave.nodes.size());
  for (std::size_t i = 0; i < state.points.size(); ++i) {
    const Placed<Dim> placed = place_point<Dim>(pair, work, x, i, {});
    if (placed.projection.feature == Feature::none) continue;
    PointHistory<Dim>& h = state.points[i];
    h = next_history<Dim>(pair, x, {}, placed, {});
    if (placed.projection.beyond_end) h.gap = std::abs(h.gap);
    h.active = h.gap <= 0 && h.gap >= -pair.depth && contact::inside_domain(placed.kinematics);
  }
  if constexpr (Dim == 3) {
    if (!pair.edges.on) return state;
    // By a whole evaluation: it tells which crossings are the nodes' own contacts.
    evaluate<3>(pair, x, state, false, work);
    for (std::size_t i = state.points.size(); i < work.points.size(); ++i)
      state.points.push_back(work.points[i].history);
  }
  return state;
}

template <int Dim>
PairState<Dim> commit(const PairEvaluation<Dim>& evaluation) {
  PairState<Dim> state;
  state.points.reserve(evaluation.points.size());
  for (const PointResult<Dim>& point : evaluation.points) state.points.push_back(point.history);
  return state;
}

template void prepare<2>(PairDefinition<2>&, Points<2>);
template void prepare<3>(PairDefinition<3>&, Points<3>);
template PairState<2> initial_state<2>(const PairDefinition<2>&, Points<2>);
template PairState<3> initial_state<3>(const PairDefinition<3>&, Points<3>);
template Assumed<2> committed_branches<2>(const PairDefinition<2>&, const PairState<2>&, Points<2>,
                                          bool);
template Assumed<3> committed_branches<3>(const PairDefinition<3>&, const PairState<3>&, Points<3>,
                                          bool);
template Assumed<2> evaluated_branches<2>(const PairEvaluation<2>&);
template Assumed<3> evaluated_branches<3>(const PairEvaluation<3>&);
template void evaluate<2>(const PairDefinition<2>&, Points<2>, const PairState<2>&, bool,
                          PairEvaluation<2>&, const Assumed<2>&);
template void evaluate<3>(const PairDefinition<3>&, Points<3>, const PairState<3>&, bool,
                          PairEvaluation<3>&, const Assumed<3>&);
template PairState<2> commit<2>(const PairEvaluation<2>&);
template PairState<3> commit<3>(const PairEvaluation<3>&);

}  // namespace osculate::pairing
