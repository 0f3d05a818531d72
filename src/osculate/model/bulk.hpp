#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "osculate/model/model.hpp"

namespace osculate::model {

/// Internal force and tangent of one bulk cell, or the force of a pressure on one edge.
struct BulkBlock {
  bool ok = true;
  std::string message;
  int dof_count = 0;
  std::array<Dof, 2 * solid::max_nodes> dofs{};
  solid::ElementResult result;
};

/// Evaluates one cell at the nodal displacements `u`.
void evaluate_cell(const Model& model, const BulkSection& section, const mesh::CellRef& cell,
                   const Eigen::VectorXd& u, bool with_tangent, BulkBlock& out);

/// External nodal forces of a pressure on one boundary edge, and their derivative (follower load).
void pressure_block(const Model& model, const solid::Section& section, std::span<const Index> nodes,
                    const Eigen::VectorXd& u, double pressure, BulkBlock& out);

/// Share of each node in a unit body force over a cell / a unit traction over an edge.
[[nodiscard]] std::vector<double> cell_weights(const Model& model, const BulkSection& section,
                                               const mesh::CellRef& cell);
[[nodiscard]] std::vector<double> edge_weights(const Model& model, const solid::Section& section,
                                               std::span<const Index> nodes);
[[nodiscard]] double smallest_jacobian(const Model& model, const mesh::CellRef& cell);

/// Reference coordinates and displacements of some nodes.
[[nodiscard]] solid::Coordinates reference_of(const Model& model, std::span<const Index> nodes);
[[nodiscard]] solid::Coordinates displacement_of(const Eigen::VectorXd& u,
                                                 std::span<const Index> nodes);
/// Nodes and type of a cell.
struct CellNodes {
  cell::CellType type;
  std::span<const Index> nodes;
};
[[nodiscard]] CellNodes cell_nodes(const Model& model, const mesh::CellRef& cell);

}  // namespace osculate::model
