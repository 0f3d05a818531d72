// Rows and columns of multipliers that are unknowns (pairing/constraint.hpp).
#include <algorithm>
#include <cmath>

#include "osculate/model/system_impl.hpp"
#include "osculate/pairing/point_penalty.hpp"

namespace osculate::model {
template <int Dim>
void BasicSystem<Dim>::Impl::add_to_multipliers(State& s, const Eigen::VectorXd& du,
                                                double factor) const {
  for (std::size_t p = 0; p < first_multiplier.size(); ++p) {
    if (first_multiplier[p] < 0) continue;
    const pairing::PairDefinition<Dim>& pair = model.pairs[p].definition;
    Index row = first_multiplier[p];
    std::vector<contact::Multiplier<Dim>>& points = s.multipliers[p].points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const pairing::PointPenalty penalty = pairing::point_penalty(pair, i);
      points[i].normal += factor * penalty.normal * du[row++];
      if (!pairing::has_shear(pair)) continue;
      points[i].shear += factor * penalty.shear * du.segment<Dim>(row);
      row += Dim;
    }
  }
}

template <int Dim>
double BasicSystem<Dim>::Impl::add_constraint_row(Index unknown, const Eigen::VectorXd* inc) {
  const double largest = assembler.add_row(unknown, path_dofs, path_values);
  if (!inc) return largest;
  double along = 0;
  for (std::size_t j = 0; j < path_dofs.size(); ++j) along += path_values[j] * (*inc)[path_dofs[j]];
  const Index row = unknown - dofs.unknowns();
  constraint[row] += along;
  branch_constraint[row] += along;
  return largest;
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_constraint_tangent(const pairing::ContactBlock<Dim>& block,
                                                    bool shear, Index first,
                                                    const Eigen::VectorXd* inc) {
  const pairing::ConstraintBlock<Dim>& c = block.constraint;
  const Index count = shear ? Dim + 1 : 1;
  constexpr double negligible = 1e-10;
  for (Index row = 0; row < count; ++row) {
    path_dofs.clear();
    path_values.clear();
    const auto add = [&](Index node, const auto& values) {
      for (int i = 0; i < Dim; ++i) {
        path_dofs.push_back(dofs.node_dof(node, i));
        path_values.push_back(values[i]);
      }
    };
    if (row == 0)
      for (const pairing::NodeGradient<Dim>& g : c.normal_row) add(g.node, g.value);
    else
      for (const pairing::NodeMatrix<Dim>& g : c.shear_row)
        add(g.node, Vec<Dim>(g.value.row(row - 1).transpose()));
    double largest = add_constraint_row(first + row, inc);
    for (Index column = 0; column < count; ++column)
      if (const double own = c.own(row, column); own != 0.0) {
        builder.add(first + row, first + column, own);
        largest = std::max(largest, std::abs(own));
      }
    // Both sides are prescribed in this direction: the traction stays what it is.
    if (largest <= negligible * c.scale[row]) builder.add(first + row, first + row, -c.scale[row]);
  }
  if (!block.active()) return;
  contact_dofs.clear();
  for (int k = 0; k < Dim * block.count; ++k)
    contact_dofs.push_back(dofs.node_dof(block.nodes[static_cast<std::size_t>(k / Dim)], k % Dim));
  for (Index column = 0; column < count; ++column)
    assembler.add_column(contact_dofs, {c.columns.col(column).data(), contact_dofs.size()},
                         first + column);
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_constraints(std::size_t pair, bool with_tangent,
                                             const Eigen::VectorXd* inc) {
  if (first_multiplier[pair] < 0) return;
  const bool shear = pairing::has_shear(model.pairs[pair].definition);
  const Index count = multipliers_per_point(model.pairs[pair]);
  Index first = first_multiplier[pair];
  for (std::size_t i = 0; i < model.pairs[pair].definition.slave.points.size(); ++i) {
    const pairing::ContactBlock<Dim>& block = contact[pair].blocks[i];
    const Index row = first - dofs.unknowns();
    constraint[row] += block.constraint.normal;
    branch_constraint[row] += block.constraint.branch_normal;
    if (shear) {
      constraint.segment<Dim>(row + 1) += block.constraint.shear;
      branch_constraint.segment<Dim>(row + 1) += block.constraint.branch_shear;
    }
    if (with_tangent) add_constraint_tangent(block, shear, first, inc);
    first += count;
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::soften() {
  constexpr double share = 1e-8;
  const la::SparseMatrix& k = builder.finish();
  const auto value_at = [&](Index row, Index column) {
    const auto first = k.column.begin() + k.row_start[static_cast<std::size_t>(row)];
    const auto last = k.column.begin() + k.row_start[static_cast<std::size_t>(row) + 1];
    const auto at = std::lower_bound(first, last, column);
    return at != last && *at == column ? k.value[static_cast<std::size_t>(at - k.column.begin())]
                                       : 0.0;
  };
  std::vector<double> compliance(static_cast<std::size_t>(unknowns - dofs.unknowns()));
  for (Index u = dofs.unknowns(); u < unknowns; ++u)
    for (Index at = k.row_start[static_cast<std::size_t>(u)];
         at < k.row_start[static_cast<std::size_t>(u) + 1]; ++at) {
      const Index j = k.column[static_cast<std::size_t>(at)];
      const double stiffness = j < dofs.unknowns() ? std::abs(value_at(j, j)) : 0.0;
      if (stiffness > 0)
        compliance[static_cast<std::size_t>(u - dofs.unknowns())] +=
            k.value[static_cast<std::size_t>(at)] * value_at(j, u) / stiffness;
    }
  for (std::size_t i = 0; i < compliance.size(); ++i)
    if (compliance[i] != 0.0) {
      const Index u = dofs.unknowns() + static_cast<Index>(i);
      builder.add(u, u, -share * compliance[i]);
    }
}

template struct BasicSystem<2>::Impl;
template struct BasicSystem<3>::Impl;

}  // namespace osculate::model
