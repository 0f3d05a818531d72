#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "osculate/model/model.hpp"

namespace osculate::model {

/// Internal force and tangent of one bulk cell, or the force of a pressure on one edge.
template <int Dim>
struct BasicBulkBlock {
  bool ok = true;
  std::string message;
  int dof_count = 0;
  std::array<Dof, Dim * solid::max_nodes<Dim>> dofs{};
  solid::ElementResult<Dim> result;
};

/// What a cell of a type has of its section: cells without the section's formulation are plain,
/// and, where nobody asked for it, those of second order whose volume ratio would be constant.
template <int Dim>
[[nodiscard]] solid::Section<Dim> section_on(const BasicBulkSection<Dim>& section,
                                             cell::CellType type);

/// The dofs of the nodes of a cell or facet.
template <int Dim>
void set_dofs(std::span<const Index> nodes, BasicBulkBlock<Dim>& out);

/// Evaluates one cell at the nodal displacements `u`; `memory` is that of its points.
template <int Dim>
void evaluate_cell(const BasicModel<Dim>& model, const BasicBulkSection<Dim>& section,
                   const mesh::CellRef& cell, const Eigen::VectorXd& u,
                   const material::Memory& memory, bool with_tangent, BasicBulkBlock<Dim>& out);

/// A state of the bodies, as far as their stresses go.
struct Strained {
  const Eigen::VectorXd& u;        ///< displacements of the nodes
  std::span<const double> memory;  ///< of all points, temperatures and expansions included
};
/// What stresses of a cell of small strain do to its stiffness, in place of the tangent: those of
/// `at`, less those of `less` (null: none). `out.ok` is false where there are no stresses.
///
/// Formula    solid::stress_stiffness
/// Requires   small kinematics
template <int Dim>
void stressed_cell(const BasicModel<Dim>& model, const BasicBulkSection<Dim>& section,
                   const mesh::CellRef& cell, const Eigen::VectorXd& u,
                   const material::Memory& memory, const Eigen::VectorXd* less,
                   const material::Memory& memory_of_less, BasicBulkBlock<Dim>& out);

/// External nodal forces of a pressure on one boundary facet, and their derivative (follower load).
template <int Dim>
void pressure_block(const BasicModel<Dim>& model, const PressureLoad::Facet& facet,
                    const Eigen::VectorXd& u, double pressure, BasicBulkBlock<Dim>& out);

/// Centrifugal forces of a cell at the displacements `u` (null: none), of the square 1 of the
/// angular velocity, and with `u` their derivative, which is symmetric.
///
/// Formula    CentrifugalLoad
template <int Dim>
void centrifugal_block(const BasicModel<Dim>& model, const CentrifugalLoad& load,
                       const CentrifugalLoad::Cell& cell, const Eigen::VectorXd* u,
                       BasicBulkBlock<Dim>& out);

/// Share of each node in a unit body force over a cell.
template <int Dim>
[[nodiscard]] std::vector<double> cell_weights(const BasicModel<Dim>& model,
                                               const BasicBulkSection<Dim>& section,
                                               const mesh::CellRef& cell);
/// Share of each node in a unit traction over an edge (2D) or a face (3D).
template <int Dim>
[[nodiscard]] std::vector<double> side_weights(const BasicModel<Dim>& model,
                                               const solid::Section<Dim>& section,
                                               cell::CellType type, std::span<const Index> nodes);
template <int Dim>
[[nodiscard]] double smallest_jacobian(const BasicModel<Dim>& model, const mesh::CellRef& cell);

/// Reference coordinates and displacements of some nodes.
template <int Dim>
[[nodiscard]] solid::Coordinates<Dim> reference_of(const BasicModel<Dim>& model,
                                                   std::span<const Index> nodes);
template <int Dim>
[[nodiscard]] solid::Coordinates<Dim> displacement_of(const Eigen::VectorXd& u,
                                                      std::span<const Index> nodes);
/// Where a cell is free of strain, and how far its nodes are from there. With small kinematics its
/// shape stays that of the undeformed body.
template <int Dim>
struct CellPlaces {
  solid::Coordinates<Dim> reference, displacement;
};
template <int Dim>
[[nodiscard]] CellPlaces<Dim> places_of(const BasicModel<Dim>& model,
                                        const BasicBulkSection<Dim>& section,
                                        std::span<const Index> nodes, const Eigen::VectorXd& u,
                                        const material::Memory& memory);
/// Nodes and type of a cell.
struct CellNodes {
  cell::CellType type;
  std::span<const Index> nodes;
};
[[nodiscard]] CellNodes cell_nodes(const mesh::Mesh& mesh, const mesh::CellRef& cell);

/// Which displacements of a model are unknowns.
template <int Dim>
[[nodiscard]] BasicDofSpace<Dim> dof_space(const BasicModel<Dim>& model);

using BulkBlock = BasicBulkBlock<2>;
using BulkBlock3 = BasicBulkBlock<3>;

}  // namespace osculate::model
