#pragma once
#include <array>
#include <span>
#include <string>

#include "osculate/model/model.hpp"

namespace osculate::model {

inline constexpr int max_cell_dofs = 18;
using CellVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_cell_dofs, 1>;
using CellMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_cell_dofs, max_cell_dofs>;

/// Internal force and tangent of one bulk cell.
struct BulkBlock {
  bool ok = true;
  std::string message;
  int dof_count = 0;
  std::array<Dof, max_cell_dofs> dofs{};
  CellVector force;
  CellMatrix tangent;
};

/// Evaluates one cell at the nodal displacements `u`.
void evaluate_cell(const Model& model, const BulkSection& section, const mesh::CellRef& cell,
                   const Eigen::VectorXd& u, bool with_tangent, BulkBlock& out);

/// External nodal forces of a pressure on one boundary edge, and their derivative (follower load).
void pressure_block(const Model& model, const solid::Section& section,
                    std::span<const Index> nodes, const Eigen::VectorXd& u, double pressure,
                    BulkBlock& out);

}  // namespace osculate::model
