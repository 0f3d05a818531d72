#include "osculate/embed/collect.hpp"

namespace osculate::embed {
namespace {

template <int Dim>
Index row_of(const pairing::ContactBlock<Dim>& block, int k) {
  return Dim * block.nodes[static_cast<std::size_t>(k / Dim)] + k % Dim;
}

template <int Dim>
void add_tangent(const pairing::ContactBlock<Dim>& block, std::vector<Entry>& out) {
  for (int i = 0; i < Dim * block.count; ++i) {
    const Index row = row_of(block, i);
    for (int j = 0; block.has_tangent() && j < Dim * block.count; ++j)
      out.push_back({row, row_of(block, j), block.tangent(i, j)});
    for (const pairing::NodeMatrix<Dim>& g : block.path())
      for (int d = 0; d < Dim; ++d)
        out.push_back({row, Dim * g.node + d, block.path_rows.row(i).dot(g.value.col(d))});
    for (const pairing::NodeGradient<Dim>& g : block.area)
      for (int d = 0; d < Dim; ++d)
        out.push_back({row, Dim * g.node + d, block.area_rows[i] * g.value[d]});
  }
}

template <int Dim>
void add_force(const pairing::ContactBlock<Dim>& block, Evaluation<Dim>& e) {
  for (int i = 0; i < Dim * block.count; ++i) {
    const auto row = static_cast<std::size_t>(row_of(block, i));
    e.force[row] += block.force[i];
    e.branch_force[row] += block.branched ? block.branch_force[i] : block.force[i];
  }
  e.branched = e.branched || block.branched;
}

template <int Dim>
ContactPoint<Dim> point_of(const pairing::PointResult<Dim>& p) {
  ContactPoint<Dim> out;
  const contact::PointHistory<Dim>& h = p.history;
  out.status = static_cast<Status>(p.status);
  out.feature = static_cast<Feature>(h.feature);
  out.facet = h.facet;
  out.edge = h.edge;
  out.xi = to_array<Dim - 1>(h.xi);
  out.gap = p.gap;
  out.normal_traction = p.normal_traction;
  out.shear_traction = to_array<Dim>(p.shear());
  out.slip = to_array<Dim>(p.frame * p.slip_increment);
  out.foot = to_array<Dim>(p.foot);
  out.normal = to_array<Dim>(p.normal);
  out.weight = p.weight;
  out.stored = p.stored;
  out.friction_work = h.friction_work;
  out.damping_work = h.damping_work;
  out.outside_domain = p.outside_domain;
  return out;
}

/// Value, rows and columns of the constraint of one point, whose first unknown is `first`.
template <int Dim>
void add_constraint(const pairing::ContactBlock<Dim>& block, Index first, Index count,
                    bool with_tangent, Constraints& out) {
  const pairing::ConstraintBlock<Dim>& c = block.constraint;
  const auto at = [first](Index i) { return static_cast<std::size_t>(first + i); };
  out.value[at(0)] = c.normal;
  out.branch_value[at(0)] = c.branch_normal;
  for (Index i = 1; i < count; ++i) {
    out.value[at(i)] = c.shear[i - 1];
    out.branch_value[at(i)] = c.branch_shear[i - 1];
  }
  if (!with_tangent) return;
  for (const pairing::NodeGradient<Dim>& g : c.normal_row)
    for (int d = 0; d < Dim; ++d) out.rows.push_back({first, Dim * g.node + d, g.value[d]});
  for (const pairing::NodeMatrix<Dim>& g : c.shear_row)
    for (int i = 0; i < Dim; ++i)
      for (int d = 0; d < Dim; ++d)
        out.rows.push_back({first + 1 + i, Dim * g.node + d, g.value(i, d)});
  for (Index i = 0; i < count; ++i)
    for (Index j = 0; j < count; ++j)
      if (c.own(i, j) != 0.0) out.own.push_back({first + i, first + j, c.own(i, j)});
  for (int k = 0; k < Dim * block.count; ++k)
    for (Index j = 0; j < count; ++j)
      out.columns.push_back({row_of(block, k), first + j, c.columns(k, j)});
}

}  // namespace

template <int Dim>
void collect(bool with_tangent, Evaluation<Dim>& e) {
  const pairing::PairDefinition<Dim>& pair = e.of->pair;
  const pairing::PairEvaluation<Dim>& contact = e.contact;
  e.force.assign(Dim * e.x.size(), 0.0);
  e.branch_force = e.force;
  e.branched = false;
  e.tangent.clear();
  for (const pairing::ContactBlock<Dim>& block : contact.blocks) {
    if (!block.active()) continue;
    add_force(block, e);
    if (with_tangent) add_tangent(block, e.tangent);
  }
  e.points.clear();
  for (const pairing::PointResult<Dim>& point : contact.points)
    e.points.push_back(point_of<Dim>(point));
  Constraints& c = e.constraints;
  for (std::vector<Entry>* const list : {&c.rows, &c.columns, &c.own}) list->clear();
  const bool unknown = pairing::by_multipliers(pair);
  const Index count = unknown ? unknowns_per_point(pair) : 0;
  c.value.assign(static_cast<std::size_t>(count) * contact.points.size(), 0.0);
  c.branch_value = c.value;
  for (std::size_t i = 0; unknown && i < contact.points.size(); ++i)
    add_constraint(contact.blocks[i], count * static_cast<Index>(i), count, with_tangent, c);
}

template void collect(bool, Evaluation<2>&);
template void collect(bool, Evaluation<3>&);

}  // namespace osculate::embed
