#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osculate/core/ranks.hpp"
#include "osculate/model/model.hpp"

namespace osculate::model {

/// How the work on a model is shared: every node has one process that owns it, every unknown too,
/// and a process evaluates the cells that its nodes and unknowns see. Cells between two owners are
/// evaluated by both, so that rows of the matrix and forces on nodes are summed up by one process,
/// in the order of the cells: their bits are those of one process alone.
/// So it is with tangents of contact points (pairing::Workers), whose places on the master are
/// shared in equal numbers, whoever owns their nodes. States, what points report, and loads are the
/// same on all processes.
///
/// Decision   docs/decisions/093-several-processes.md, 112-partners-in-contact.md
/// Tested by  tests/unit/model/test_shares.cpp, tests/ranks
struct Shares {
  std::vector<char> mine;              ///< by node: owned by this process
  std::vector<char> seen;              ///< by node: it moves rows of this process
  std::vector<bool> rows;              ///< by unknown, then multipliers: owned by this process
  std::vector<std::size_t> cells;      ///< evaluated by this process, in the order of BulkTerm
  std::vector<std::size_t> own_cells;  ///< of these, those whose first node it owns
};

/// Who owns the nodes of the cells: parts of about as many nodes, and points that are near their
/// master, with few cells and of these points between them.
///
/// Input      contact: what points remember, by pair; empty: nothing is near anything
/// Returns    one for each node, below `parts`; nodes without cells are dealt out in turn
/// Errors     throws std::bad_alloc
template <int Dim>
[[nodiscard]] std::vector<int> node_owners(const BasicModel<Dim>& model,
                                           std::span<const pairing::PairState<Dim>> contact,
                                           int parts);

/// The same once more, where contact has moved to nodes of few processes, or is torn between them,
/// since `owner` was found, and new owners are better: points near their master are a twentieth as
/// many as nodes or more, and the process that sees most of them sees half as many again as it
/// should, a quarter more than by the new owners. Nothing where the owners may stay.
///
/// Input      unevenness: how many times its even share that process sees at best, as was found
///            last, 1 at first and where it is below half as many again; new owners are looked for
///            from a quarter more on
template <int Dim>
[[nodiscard]] std::optional<std::vector<int>> better_owners(
    const BasicModel<Dim>& model, std::span<const pairing::PairState<Dim>> contact,
    const std::vector<int>& owner, int parts, double& unevenness);

/// What process `rank` has to do.
///
/// Input      owner: of each node, below `count`; multipliers: of the matrix, behind the unknowns
template <int Dim>
[[nodiscard]] Shares shares_of(const BasicModel<Dim>& model, const BasicDofSpace<Dim>& dofs,
                               Index multipliers, const std::vector<int>& owner, int rank,
                               int count);

/// Forces on dofs (of nodes, then of rigid bodies): those that others own come from them.
template <int Dim>
void exchange(const Shares& shares, const core::Ranks& ranks, Eigen::VectorXd& of_dofs);

}  // namespace osculate::model
