#include "osculate/model/condition_rows.hpp"

#include <Eigen/SparseCore>
#include <Eigen/SparseQR>
#include <cmath>
#include <utility>

#include "osculate/model/assembler.hpp"

namespace osculate::model {
namespace {

struct Entry {
  Index column;
  double value;
};
/// Derivatives of conditions, of size 1 each; one of which nothing is free has none.
using Rows = std::vector<std::vector<Entry>>;

/// Rows of which no other one has a part in one of their unknowns are independent; without them
/// others are, and so on.
class Peeled {
 public:
  Peeled(const Rows& rows, Index columns)
      : rows_(rows),
        users_(static_cast<std::size_t>(columns)),
        left_(users_.size(), 0),
        is_left_(rows.size(), true) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const Entry& entry : rows[i])
        if (std::abs(entry.value) > nothing) {
          users_[at(entry.column)].push_back(i);
          ++left_[at(entry.column)];
        }
    std::vector<std::size_t> next(rows.size());
    for (std::size_t i = 0; i < next.size(); ++i) next[i] = i;
    while (!next.empty()) {
      const std::size_t i = next.back();
      next.pop_back();
      if (is_left_[i] && stands_alone(i)) leave(i, next);
    }
  }
  [[nodiscard]] std::vector<std::size_t> rest() const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < is_left_.size(); ++i)
      if (is_left_[i] && !rows_[i].empty()) out.push_back(i);
    return out;
  }

 private:
  static constexpr double nothing = 1e-9, fair = 1e-3;
  static std::size_t at(Index column) { return static_cast<std::size_t>(column); }
  [[nodiscard]] bool stands_alone(std::size_t i) const {
    for (const Entry& entry : rows_[i])
      if (left_[at(entry.column)] == 1 && std::abs(entry.value) >= fair) return true;
    return false;
  }
  void leave(std::size_t i, std::vector<std::size_t>& next) {
    is_left_[i] = false;
    for (const Entry& entry : rows_[i]) {
      if (std::abs(entry.value) <= nothing || --left_[at(entry.column)] != 1) continue;
      for (const std::size_t user : users_[at(entry.column)])
        if (is_left_[user]) next.push_back(user);
    }
  }

  const Rows& rows_;
  std::vector<std::vector<std::size_t>> users_;  ///< rows, of each column
  std::vector<Index> left_;                      ///< how many of them are left
  std::vector<bool> is_left_;
};

/// Of some rows those that are sums of others, by an orthogonal basis.
std::vector<std::size_t> sums_of_others(const Rows& rows, const std::vector<std::size_t>& some,
                                        Index columns) {
  constexpr double dependent = 1e-6;
  constexpr std::size_t too_many = 2000;
  if (some.size() < 2 || some.size() > too_many) return {};
  std::vector<int> number(static_cast<std::size_t>(columns), -1);
  int count = 0;
  std::vector<Eigen::Triplet<double, int>> entries;
  for (std::size_t k = 0; k < some.size(); ++k)
    for (const Entry& entry : rows[some[k]]) {
      int& column = number[static_cast<std::size_t>(entry.column)];
      if (column < 0) column = count++;
      entries.emplace_back(column, static_cast<int>(k), entry.value);
    }
  Eigen::SparseMatrix<double> transposed(count, static_cast<int>(some.size()));
  transposed.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(dependent);
  qr.compute(transposed);
  std::vector<std::size_t> out;
  for (Eigen::Index k = qr.rank(); k < transposed.cols(); ++k)
    out.push_back(some[static_cast<std::size_t>(qr.colsPermutation().indices()[k])]);
  return out;
}

template <int Dim>
NodeConstraintValue<Dim> value_of(const NodeConstraint& c, const BasicModel<Dim>& model,
                                  const BasicState<Dim>& state) {
  std::vector<Vec<Dim>> reference, now;
  for (const Index node : c.nodes) {
    reference.push_back(model.reference[static_cast<std::size_t>(node)]);
    now.push_back(reference.back() + state.u.template segment<Dim>(Dim * node));
  }
  return evaluate<Dim>(c, reference, now,
                       c.body >= 0 ? &state.rigid[static_cast<std::size_t>(c.body)] : nullptr,
                       Eigen::VectorXd::Zero(rows<Dim>(c)));
}

/// Rows of the conditions behind those of the unknowns: `count` of them.
template <int Dim>
la::SparseMatrix rows_of_conditions(const BasicModel<Dim>& model, const BasicDofSpace<Dim>& dofs,
                                    const std::vector<bool>& prescribed,
                                    const BasicState<Dim>& state, Index count) {
  la::MatrixBuilder builder(dofs.unknowns() + count);
  BasicAssembler<Dim> assembler(dofs, builder);
  assembler.set_prescribed(prescribed);
  std::vector<Vec<Dim>> x(model.reference.size());
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] = model.reference[n] + state.u.template segment<Dim>(Dim * static_cast<Eigen::Index>(n));
  assembler.set_configuration(x, state.rigid);
  Index at = dofs.unknowns();
  for (const NodeConstraint& c : model.node_constraints) {
    const NodeConstraintValue<Dim> g = value_of(c, model, state);
    const std::vector<Dof> d = dofs_of(c, dofs);
    for (Eigen::Index row = 0; row < g.value.size(); ++row) {
      const Eigen::VectorXd by = derivatives(g, row);
      assembler.add_row(at++, d, {by.data(), d.size()});
    }
  }
  return builder.finish();
}

}  // namespace

template <int Dim>
std::vector<Dof> dofs_of(const NodeConstraint& c, const BasicDofSpace<Dim>& dofs) {
  std::vector<Dof> out;
  for (const Index node : c.nodes)
    for (int i = 0; i < Dim; ++i) out.push_back(dofs.node_dof(node, i));
  for (int i = 0; c.body >= 0 && i < body::motions<Dim>; ++i)
    out.push_back(dofs.body_dof(c.body, i));
  return out;
}

template <int Dim>
Eigen::VectorXd derivatives(const NodeConstraintValue<Dim>& g, Eigen::Index row) {
  Eigen::VectorXd out(g.gradient.cols() + g.of_body.cols());
  out << g.gradient.row(row).transpose(),
      g.of_body.size() > 0 ? Eigen::VectorXd(g.of_body.row(row)) : Eigen::VectorXd();
  return out;
}

template <int Dim>
std::vector<double> held_conditions(const BasicModel<Dim>& model, const BasicDofSpace<Dim>& dofs,
                                    const std::vector<bool>& prescribed,
                                    const BasicState<Dim>& state) {
  constexpr double holds = 1e6;
  std::vector<double> stiffness;
  for (const NodeConstraint& c : model.node_constraints)
    stiffness.insert(stiffness.end(), static_cast<std::size_t>(model::rows<Dim>(c)), c.stiffness);
  const auto count = static_cast<Index>(stiffness.size());
  std::vector<double> held(stiffness.size(), 0.0);
  if (count < 2) return held;
  const la::SparseMatrix k = rows_of_conditions(model, dofs, prescribed, state, count);
  Rows rows(stiffness.size());
  std::vector<double> square(stiffness.size(), 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t row = i + static_cast<std::size_t>(dofs.unknowns());
    const auto each = [&](const auto& take) {
      for (Index e = k.row_start[row]; e < k.row_start[row + 1]; ++e)
        if (const double value = k.value[static_cast<std::size_t>(e)]; value != 0.0)
          take(k.column[static_cast<std::size_t>(e)], value);
    };
    each([&](Index, double value) { square[i] += value * value; });
    each([&](Index column, double value) {
      rows[i].push_back({column, value / std::sqrt(square[i])});
    });
  }
  const Peeled peeled(rows, k.n);
  for (const std::size_t i : sums_of_others(rows, peeled.rest(), k.n))
    held[i] = holds * square[i] / stiffness[i];
  return held;
}

template std::vector<Dof> dofs_of(const NodeConstraint&, const BasicDofSpace<2>&);
template std::vector<Dof> dofs_of(const NodeConstraint&, const BasicDofSpace<3>&);
template Eigen::VectorXd derivatives(const NodeConstraintValue<2>&, Eigen::Index);
template Eigen::VectorXd derivatives(const NodeConstraintValue<3>&, Eigen::Index);
template std::vector<double> held_conditions(const Model&, const BasicDofSpace<2>&,
                                             const std::vector<bool>&, const BasicState<2>&);
template std::vector<double> held_conditions(const Model3&, const BasicDofSpace<3>&,
                                             const std::vector<bool>&, const BasicState<3>&);

}  // namespace osculate::model
