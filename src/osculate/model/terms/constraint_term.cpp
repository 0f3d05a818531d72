#include "osculate/model/terms/constraint_term.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "osculate/model/condition_rows.hpp"
#include "osculate/pairing/point_penalty.hpp"

namespace osculate::model {
namespace {

/// Whether the tractions of a pair are unknowns.
template <int Dim>
[[nodiscard]] bool constrained(const BasicContactPair<Dim>& pair) {
  return pairing::by_multipliers(pair.definition);
}

/// Unknowns of one point of a pair whose multipliers are unknowns.
template <int Dim>
[[nodiscard]] Index multipliers_per_point(const BasicContactPair<Dim>& pair) {
  return pairing::has_shear(pair.definition) ? Dim + 1 : 1;
}

}  // namespace

template <int Dim>
ConstraintTerm<Dim>::ConstraintTerm(const BasicModel<Dim>& m, Index displacements)
    : model(m), begin(displacements), end(displacements) {
  for (const BasicContactPair<Dim>& pair : model.pairs) {
    first.push_back(constrained(pair) ? end : -1);
    if (constrained(pair))
      end += multipliers_per_point(pair) * static_cast<Index>(pair.definition.slave.points.size());
  }
  of_nodes = end;
  for (const NodeConstraint& c : model.node_constraints) end += rows<Dim>(c);
}

template <int Dim>
void ConstraintTerm<Dim>::move(BasicState<Dim>& s, const Eigen::VectorXd& du, double factor) const {
  for (std::size_t p = 0; p < first.size(); ++p) {
    if (first[p] < 0) continue;
    const pairing::PairDefinition<Dim>& pair = model.pairs[p].definition;
    Index row = first[p];
    std::vector<contact::Multiplier<Dim>>& points = s.multipliers[p].points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const pairing::PointPenalty penalty = pairing::point_penalty(pair, i);
      points[i].normal += factor * penalty.normal * du[row++];
      if (!pairing::has_shear(pair)) continue;
      points[i].shear += factor * penalty.shear * du.segment<Dim>(row);
      row += Dim;
    }
  }
  s.constraint_forces += factor * du.segment(of_nodes, end - of_nodes);
}

namespace {

template <int Dim>
void add_curvature(const NodeConstraintValue<Dim>& g, std::span<const Dof> d, Assembly<Dim>& to) {
  constexpr int turns = body::rotations<Dim>;
  const auto of_nodes = static_cast<std::size_t>(g.gradient.cols());
  if (g.curvature.size() > 0)
    to.add_stiffness(d.first(of_nodes), Eigen::MatrixXd(to.share * g.curvature));
  if (g.mixed.size() == 0) return;
  const std::span<const Dof> turning = d.last(turns);
  to.add_stiffness(turning, Eigen::MatrixXd(to.share * g.body_curvature));
  for (std::size_t i = 0; i < of_nodes; i += Dim) {
    std::array<Dof, Dim + turns> pair{};
    std::copy_n(d.begin() + static_cast<std::ptrdiff_t>(i), Dim, pair.begin());
    std::copy(turning.begin(), turning.end(), pair.begin() + Dim);
    Mat<Dim + turns, Dim + turns> k = Mat<Dim + turns, Dim + turns>::Zero();
    k.template topRightCorner<Dim, turns>() =
        to.share * g.mixed.template middleRows<Dim>(static_cast<Eigen::Index>(i));
    k.template bottomLeftCorner<turns, Dim>() = k.template topRightCorner<Dim, turns>().transpose();
    to.add_stiffness(pair, k);
  }
}

}  // namespace

template <int Dim>
void ConstraintTerm<Dim>::add_one(const NodeConstraint& c, Index at, const BasicState<Dim>& s,
                                  std::span<const Vec<Dim>> x, Assembly<Dim>& to) const {
  std::vector<Vec<Dim>> reference, now;
  for (const Index node : c.nodes) {
    reference.push_back(model.reference[static_cast<std::size_t>(node)]);
    now.push_back(x[static_cast<std::size_t>(node)]);
  }
  const Eigen::VectorXd lambda = s.constraint_forces.segment(at - of_nodes, rows<Dim>(c));
  const NodeConstraintValue<Dim> g =
      evaluate<Dim>(c, reference, now,
                    c.body >= 0 ? &s.rigid[static_cast<std::size_t>(c.body)] : nullptr, lambda);
  const std::vector<Dof> d = dofs_of(c, to.dofs);
  for (Eigen::Index row = 0; row < g.value.size(); ++row) {
    const Index unknown = at + static_cast<Index>(row);
    Eigen::VectorXd gradient = derivatives(g, row);
    for (std::size_t k = 0; k < d.size(); ++k)
      to.into.forces.internal[d[k]] += lambda[row] * gradient[static_cast<Eigen::Index>(k)];
    to.into.constraint[unknown - begin] += g.value[row];
    to.into.branch_constraint[unknown - begin] += g.value[row];
    if (!to.with_tangent) continue;
    to.path_dofs = d;
    to.path_values.assign(gradient.begin(), gradient.end());
    constexpr double negligible = 1e-10;
    const double largest = to.add_row(unknown);
    // All that it depends on is prescribed: the multiplier stays what it is.
    if (largest <= negligible * gradient.norm()) to.builder.add(unknown, unknown, -c.stiffness);
    if (const double d = held.empty() ? 0 : held[static_cast<std::size_t>(unknown - of_nodes)];
        d > 0)
      to.builder.add(unknown, unknown, -d);
    gradient *= to.share;
    to.assembler.add_column(d, {gradient.data(), d.size()}, unknown);
  }
  if (to.with_tangent) add_curvature(g, d, to);
}

template <int Dim>
void ConstraintTerm<Dim>::hold(const BasicState<Dim>& committed, const BasicDofSpace<Dim>& dofs,
                               const std::vector<bool>& prescribed) {
  if (end - of_nodes < 2) return;
  std::vector<double> at;
  for (const NodeConstraint& c : model.node_constraints) {
    for (const Index node : c.nodes)
      for (int i = 0; i < Dim; ++i) at.push_back(committed.u[dofs.node_dof(node, i)]);
    for (int i = 0; c.body >= 0 && i < body::motions<Dim>; ++i)
      at.push_back(committed.rigid[static_cast<std::size_t>(c.body)].component(i));
  }
  if (at == held_at) return;
  held_at = std::move(at);
  held = held_conditions(model, dofs, prescribed, committed);
}

template <int Dim>
void ConstraintTerm<Dim>::add_nodes(const BasicState<Dim>& s, std::span<const Vec<Dim>> x,
                                    Assembly<Dim>& to) const {
  Index at = of_nodes;
  for (const NodeConstraint& c : model.node_constraints) {
    add_one(c, at, s, x, to);
    at += rows<Dim>(c);
  }
}

template <int Dim>
void ConstraintTerm<Dim>::add_tangent(const pairing::ContactBlock<Dim>& block, bool shear, Index at,
                                      Assembly<Dim>& to) const {
  const pairing::ConstraintBlock<Dim>& c = block.constraint;
  const Index count = shear ? Dim + 1 : 1;
  constexpr double negligible = 1e-10;
  for (Index row = 0; row < count; ++row) {
    to.begin_path();
    if (row == 0)
      for (const pairing::NodeGradient<Dim>& g : c.normal_row) to.add_to_path(g.node, g.value);
    else
      for (const pairing::NodeMatrix<Dim>& g : c.shear_row)
        to.add_to_path(g.node, Vec<Dim>(g.value.row(row - 1).transpose()));
    double largest = to.add_row(at + row);
    for (Index column = 0; column < count; ++column)
      if (const double own = c.own(row, column); own != 0.0) {
        to.builder.add(at + row, at + column, own);
        largest = std::max(largest, std::abs(own));
      }
    // Both sides are prescribed in this direction: the traction stays what it is.
    if (largest <= negligible * c.scale[row]) to.builder.add(at + row, at + row, -c.scale[row]);
  }
  if (!block.active()) return;
  const std::span<const Dof> d = to.rows_of(block);
  for (Index column = 0; column < count; ++column)
    to.assembler.add_column(d, {c.columns.col(column).data(), d.size()}, at + column);
}

template <int Dim>
void ConstraintTerm<Dim>::add(std::size_t pair, Assembly<Dim>& to) const {
  if (first[pair] < 0) return;
  const bool shear = pairing::has_shear(model.pairs[pair].definition);
  const Index count = multipliers_per_point(model.pairs[pair]);
  Index at = first[pair];
  for (std::size_t i = 0; i < model.pairs[pair].definition.slave.points.size(); ++i) {
    const pairing::ContactBlock<Dim>& block = to.into.contact[pair].blocks[i];
    const Index row = at - begin;
    to.into.constraint[row] += block.constraint.normal;
    to.into.branch_constraint[row] += block.constraint.branch_normal;
    if (shear) {
      to.into.constraint.template segment<Dim>(row + 1) += block.constraint.shear;
      to.into.branch_constraint.template segment<Dim>(row + 1) += block.constraint.branch_shear;
    }
    if (to.with_tangent) add_tangent(block, shear, at, to);
    at += count;
  }
}

namespace {

/// Entries of the rows of multipliers among the displacements, one row behind the other, with those
/// across from them and the stiffness of their columns: of all processes, on each.
struct MultiplierRows {
  std::vector<std::size_t> start{0};  ///< of each row, and the end
  std::vector<double> along, across, stiffness;
};

bool is_here(const la::SparseMatrix& k, Index row) {  // the diagonal is in every pattern
  return k.row_start[static_cast<std::size_t>(row)] <
         k.row_start[static_cast<std::size_t>(row) + 1];
}

double value_at(const la::SparseMatrix& k, Index row, Index column) {
  const auto from = k.column.begin() + k.row_start[static_cast<std::size_t>(row)];
  const auto to = k.column.begin() + k.row_start[static_cast<std::size_t>(row) + 1];
  const auto at = std::lower_bound(from, to, column);
  return at != to && *at == column ? k.value[static_cast<std::size_t>(at - k.column.begin())] : 0.0;
}

MultiplierRows multiplier_rows(const la::SparseMatrix& k, Index begin, Index end) {
  const auto together = [&k](std::vector<double>& values) {
    if (k.ranks) k.ranks->sum(values);
  };
  const auto each = [&](const auto& visit) {  // visit(row, column, value) for what is here
    for (Index u = begin; u < end; ++u)
      for (Index e = k.row_start[static_cast<std::size_t>(u)];
           e < k.row_start[static_cast<std::size_t>(u) + 1]; ++e)
        if (const Index j = k.column[static_cast<std::size_t>(e)]; j < begin)
          visit(static_cast<std::size_t>(u - begin), j, k.value[static_cast<std::size_t>(e)]);
  };
  std::vector<double> length(static_cast<std::size_t>(end - begin), 0.0);
  each([&](std::size_t row, Index, double) { length[row] += 1; });
  together(length);
  MultiplierRows out;
  for (const double l : length) out.start.push_back(out.start.back() + static_cast<std::size_t>(l));
  std::vector<double> column(out.start.back(), core::Ranks::nothing);
  out.along = out.across = out.stiffness = column;
  std::vector<std::size_t> next(out.start.begin(), out.start.end() - 1);
  each([&](std::size_t row, Index j, double value) {
    column[next[row]] = j;
    out.along[next[row]++] = value;
  });
  together(column);
  together(out.along);
  for (std::size_t row = 0; row < length.size(); ++row)
    for (std::size_t e = out.start[row]; e < out.start[row + 1]; ++e) {
      const auto j = static_cast<Index>(column[e]);
      if (!is_here(k, j)) continue;
      out.across[e] = value_at(k, j, begin + static_cast<Index>(row));
      out.stiffness[e] = std::abs(value_at(k, j, j));
    }
  together(out.across);
  together(out.stiffness);
  return out;
}

}  // namespace

template <int Dim>
void ConstraintTerm<Dim>::soften(la::MatrixBuilder& builder) const {
  constexpr double share = 1e-8;
  const MultiplierRows rows = multiplier_rows(builder.finish(), begin, end);
  for (std::size_t i = 0; i + 1 < rows.start.size(); ++i) {
    double compliance = 0;
    for (std::size_t e = rows.start[i]; e < rows.start[i + 1]; ++e)
      if (rows.stiffness[e] > 0) compliance += rows.along[e] * rows.across[e] / rows.stiffness[e];
    const Index u = begin + static_cast<Index>(i);
    if (compliance != 0.0) builder.add(u, u, -share * compliance);
  }
}

template struct ConstraintTerm<2>;
template struct ConstraintTerm<3>;

}  // namespace osculate::model
