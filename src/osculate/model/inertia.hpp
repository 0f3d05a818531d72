#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "osculate/model/bulk.hpp"
#include "osculate/model/material_memory.hpp"
#include "osculate/solid/energy.hpp"

namespace osculate::model {

/// The masses of a model: of cells by pairs of nodes, of nodes, of rigid bodies by their centre.
///
/// Units      mass (force / acceleration)
/// Tested by  tests/unit/model/test_dynamics.cpp, tests/unit/deck/test_dynamics_supports.cpp
template <int Dim>
class BasicInertia {
 public:
  BasicInertia(const BasicModel<Dim>& model, bool lumped);

  /// Mass matrix of a cell, cells counted through all sections in order, with the nodes of it.
  /// Behind the cells stand the masses of nodes.
  struct CellMass {
    std::vector<Index> nodes;
    Eigen::MatrixXd mass;
  };
  [[nodiscard]] const std::vector<CellMass>& cells() const { return cells_; }

  /// M w over the primary dofs. Rotations of bodies in space are left out.
  [[nodiscard]] Eigen::VectorXd multiply(const Eigen::VectorXd& w) const;
  /// The same with one acceleration for all points of space (gravity).
  [[nodiscard]] Eigen::VectorXd times(const Vec<Dim>& acceleration) const;
  /// Mass of a dof of a rigid body in the direction of itself.
  [[nodiscard]] Mat<body::motions<Dim>, body::motions<Dim>> body_mass(std::size_t body) const;
  [[nodiscard]] bool body_has_mass(std::size_t body) const { return bodies_[body].mass > 0; }
  [[nodiscard]] double total() const;
  /// Norm of the diagonal of M.
  [[nodiscard]] double size() const;

 private:
  struct Body {
    double mass;
    Mat<body::rotations<Dim>, body::rotations<Dim>> inertia;
  };
  Index nodes_;
  std::vector<CellMass> cells_;
  std::vector<Body> bodies_;
};

/// What the stiffness of a cell becomes in a step in time.
///
/// Formula    stiffness K + damping C + mass M , factors of the time scheme
template <int Dim>
struct CellInertia {
  const BasicInertia<Dim>& inertia;
  const std::vector<Eigen::MatrixXd>& damped;  ///< C of the cells; empty: none
  double stiffness, damping, mass;
  void add_to(std::size_t cell, Eigen::Ref<Eigen::MatrixXd> tangent) const;
};

/// Stored and dissipated in a cell, whose points remember their share of `memory`.
template <int Dim>
[[nodiscard]] solid::CellEnergy energy_of_cell(const BasicModel<Dim>& model,
                                               const BasicBulkSection<Dim>& section,
                                               const mesh::CellRef& ref, const CellMemory& where,
                                               const Eigen::VectorXd& u,
                                               std::span<const double> memory);
/// Stored and dissipated in all cells, whose points remember `memory`.
template <int Dim>
[[nodiscard]] solid::CellEnergy bulk_energy(const BasicModel<Dim>& model, const Eigen::VectorXd& u,
                                            std::span<const double> memory);

}  // namespace osculate::model
