#include "osculate/model/shares.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "osculate/mesh/partition.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/model/material_memory.hpp"

namespace osculate::model {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Calls visit(unknown) for all unknowns that a dof follows from in some configuration.
template <int Dim, class Visit>
void for_each_behind(const BasicDofSpace<Dim>& dofs, Dof dof, const Visit& visit) {
  if (const Index unknown = dofs.unknown_of(dof); unknown >= 0) return visit(unknown);
  if (const Index e = dofs.equation_of(dof); e >= 0) {
    const std::vector<Equation::Term>& terms = dofs.equations()[at(e)].terms;
    for (std::size_t t = 1; t < terms.size(); ++t) for_each_behind(dofs, terms[t].dof, visit);
    return;
  }
  const Index body = dof < Dim * dofs.nodes() ? dofs.body_of(dof / Dim) : -1;
  for (int k = 0; body >= 0 && k < body::motions<Dim>; ++k)
    for_each_behind(dofs, dofs.body_dof(body, k), visit);
}

template <int Dim>
int owner_of(const BasicDofSpace<Dim>& dofs, const std::vector<int>& owner, Dof dof, int count) {
  const Dof beyond = dof - Dim * dofs.nodes();
  return beyond < 0 ? owner[at(dof / Dim)] : beyond / body::motions<Dim> % count;
}

/// Nodes of a slave point and of the facet that it is near to; nodes of a rigid body
/// would join all points that it touches.
template <int Dim>
void add_joints(const BasicModel<Dim>& model, const BasicContactPair<Dim>& contact,
                const pairing::PairState<Dim>& state, std::vector<std::vector<Index>>& joints) {
  const pairing::PairDefinition<Dim>& pair = contact.definition;
  for (std::size_t i = 0; i < std::min(pair.slave.points.size(), state.points.size()); ++i) {
    const contact::PointHistory<Dim>& h = state.points[i];
    const double height = i < contact.heights.size() ? contact.heights[i] : contact.height;
    const bool is_near = h.active || (height > 0 && std::abs(h.gap) < height);
    if (h.facet < 0 || !is_near) continue;
    const auto follows_body = [&](Index node) {
      return at(node) < model.body_of_node.size() && model.body_of_node[at(node)] >= 0;
    };
    std::vector<Index> joint;
    const auto add = [&](const auto& of) {
      std::copy_if(of.nodes.begin(), of.nodes.begin() + of.count, std::back_inserter(joint),
                   std::not_fn(follows_body));
    };
    add(pair.slave.points[i]);
    add(pair.master.facets[at(h.facet)]);
    if (!joint.empty()) joints.push_back(std::move(joint));
  }
}

template <int Dim>
std::vector<std::vector<Index>> all_joints(const BasicModel<Dim>& model,
                                           std::span<const pairing::PairState<Dim>> contact) {
  std::vector<std::vector<Index>> joints;
  for (std::size_t p = 0; p < std::min(model.pairs.size(), contact.size()); ++p)
    add_joints(model, model.pairs[p], contact[p], joints);
  return joints;
}

template <int Dim>
std::vector<int> owners_of(const BasicModel<Dim>& model,
                           const std::vector<std::vector<Index>>& joints, int parts) {
  std::vector<std::vector<Index>> cells;
  for_each_cell(model, [&](const auto&, const mesh::CellRef& cell, const CellMemory&) {
    const std::span<const Index> nodes = cell_nodes(model.mesh, cell).nodes;
    cells.emplace_back(nodes.begin(), nodes.end());
  });
  return mesh::node_parts(cells, joints, static_cast<Index>(model.reference.size()), parts);
}

/// Joints of the process that sees most of them.
double most_seen(const std::vector<std::vector<Index>>& joints, const std::vector<int>& owner,
                 int parts) {
  std::vector<double> seen(static_cast<std::size_t>(parts), 0);
  std::vector<int> by;
  for (const std::vector<Index>& joint : joints) {
    by.clear();
    for (const Index node : joint) by.push_back(owner[at(node)]);
    std::ranges::sort(by);
    const auto end = std::unique(by.begin(), by.end());
    for (auto process = by.begin(); process != end; ++process)
      ++seen[static_cast<std::size_t>(*process)];
  }
  return std::ranges::max(seen);
}

}  // namespace

template <int Dim>
std::vector<int> node_owners(const BasicModel<Dim>& model,
                             std::span<const pairing::PairState<Dim>> contact, int parts) {
  return owners_of(model, all_joints(model, contact), parts);
}

template <int Dim>
std::optional<std::vector<int>> better_owners(const BasicModel<Dim>& model,
                                              std::span<const pairing::PairState<Dim>> contact,
                                              const std::vector<int>& owner, int parts,
                                              double& unevenness) {
  const std::vector<std::vector<Index>> joints = all_joints(model, contact);
  if (20 * joints.size() < owner.size()) return std::nullopt;
  const double even = static_cast<double>(joints.size()) / parts;
  const double now = most_seen(joints, owner, parts) / even;
  if (now < 1.5) unevenness = 1;
  if (now < std::max(1.5, 1.25 * unevenness)) return std::nullopt;
  std::vector<int> next = owners_of(model, joints, parts);
  const double then = most_seen(joints, next, parts) / even;
  unevenness = std::min(now, then);
  if (now < 1.25 * then) return std::nullopt;
  return next;
}

template <int Dim>
Shares shares_of(const BasicModel<Dim>& model, const BasicDofSpace<Dim>& dofs, Index multipliers,
                 const std::vector<int>& owner, int rank, int count) {
  Shares out;
  const Index unknowns = dofs.unknowns();
  out.rows.resize(at(unknowns + multipliers));
  for (Index u = 0; u < unknowns; ++u)
    out.rows[at(u)] = owner_of(dofs, owner, dofs.dof_of_unknown(u), count) == rank;
  for (Index m = 0; m < multipliers; ++m)
    out.rows[at(unknowns + m)] =
        std::int64_t{m} * count / multipliers == rank;  // neighbours together
  for (const int of : owner) out.mine.push_back(of == rank ? 1 : 0);
  out.seen = out.mine;
  for (Index node = 0; node < dofs.nodes(); ++node)
    for (int i = 0; i < Dim && out.seen[at(node)] == 0; ++i)
      for_each_behind(dofs, dofs.node_dof(node, i), [&](Index unknown) {
        if (out.rows[at(unknown)]) out.seen[at(node)] = 1;
      });
  std::size_t number = 0;
  for_each_cell(model, [&](const auto&, const mesh::CellRef& cell, const CellMemory&) {
    const std::span<const Index> nodes = cell_nodes(model.mesh, cell).nodes;
    if (std::ranges::any_of(nodes, [&](Index node) { return out.seen[at(node)] != 0; }))
      out.cells.push_back(number);
    if (out.mine[at(nodes.front())] != 0) out.own_cells.push_back(number);
    ++number;
  });
  return out;
}

template <int Dim>
void exchange(const Shares& shares, const core::Ranks& ranks, Eigen::VectorXd& of_dofs) {
  for (std::size_t node = 0; node < shares.mine.size(); ++node)
    if (shares.mine[node] == 0)
      of_dofs.template segment<Dim>(Dim * static_cast<Eigen::Index>(node))
          .setConstant(core::Ranks::nothing);
  ranks.sum({of_dofs.data(), Dim * shares.mine.size()});
}

template std::vector<int> node_owners(const Model&, std::span<const pairing::PairState<2>>, int);
template std::vector<int> node_owners(const Model3&, std::span<const pairing::PairState<3>>, int);
template std::optional<std::vector<int>> better_owners(const Model&,
                                                       std::span<const pairing::PairState<2>>,
                                                       const std::vector<int>&, int, double&);
template std::optional<std::vector<int>> better_owners(const Model3&,
                                                       std::span<const pairing::PairState<3>>,
                                                       const std::vector<int>&, int, double&);
template Shares shares_of(const Model&, const DofSpace&, Index, const std::vector<int>&, int, int);
template Shares shares_of(const Model3&, const DofSpace3&, Index, const std::vector<int>&, int,
                          int);
template void exchange<2>(const Shares&, const core::Ranks&, Eigen::VectorXd&);
template void exchange<3>(const Shares&, const core::Ranks&, Eigen::VectorXd&);

}  // namespace osculate::model
