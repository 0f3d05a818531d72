#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/deck/build.hpp"
#include "osculate/io/frd.hpp"
#include "osculate/model/material_memory.hpp"

namespace osculate::result {

/// A model as the files of CalculiX have it: numbers of nodes and cells, and where the cells are.
///
/// Units      forces and volumes of axisymmetric models are those of a sector of 2 degrees there:
///            1/180 of the ring's
template <int Dim>
struct AnswerModel {
  struct Place {
    const model::BasicBulkSection<Dim>* section = nullptr;
    model::CellMemory memory;
  };
  const model::BasicModel<Dim>& model;
  const deck::BasicBuilt<Dim>& built;
  io::FrdMesh mesh;
  std::vector<Place> places;                                ///< by cell of `mesh`
  std::map<std::pair<Index, Index>, std::size_t> place_of;  ///< by block and cell
  std::vector<std::int64_t> node_number;                    ///< of all nodes of the model's mesh
  double sector = 1;
  mesh::ThinElements thin;  ///< shells and beams, and what is told of their nodes

  /// A cell as it is in the running step.
  [[nodiscard]] Place place_in(const model::BasicModel<Dim>& running, std::size_t cell) const;
  explicit AnswerModel(const deck::BasicBuilt<Dim>& of);
  /// The cells of `mesh` as the deck has them: shells and beams by their own nodes. What points to
  /// them lasts as long as this.
  [[nodiscard]] io::FrdMesh as_given() const;
  /// Displacements of a node: of shells and beams the mean over the section.
  ///
  /// Input      u: of all nodes
  [[nodiscard]] Vec3 displacement(const Eigen::VectorXd& u, Index node) const;
  /// Forces of a node from outside: loads and reactions. Inertia is no part of them.
  [[nodiscard]] Vec3 force(const Eigen::VectorXd& nodal_forces, Index node) const;
};

/// Whether results are due: after every n-th increment of the steps asked for and the last of each.
[[nodiscard]] bool is_due(const deck::AnswerRequest& request, std::string_view step,
                          const model::Progress& progress);

/// The tables of one request, as MODEL.dat has them.
///
/// Points of cells count as in CalculiX: along the first local direction first. Plane cells have
/// those of the plane; quadrature is that of the formulation, so that cells of reduced integration
/// there have more points here.
///
/// Tested by  tests/unit/api/test_answers.cpp, tests/system/test_answers.py
template <int Dim>
[[nodiscard]] std::string answer_tables(const AnswerModel<Dim>& answers,
                                        const model::BasicSystem<Dim>& system,
                                        const model::BasicState<Dim>& state,
                                        const deck::AnswerRequest& request, double time);

/// COPEN, CSLIP1, CSLIP2, CPRESS, CSHEAR1, CSHEAR2 of slave nodes (where a node is one of several
/// pairs those of the largest pressure), by node. The shear is along the slip that it resists, the
/// one of the slave on the master, as in CalculiX.
struct NodeContact {
  Index node;
  bool closed;
  std::array<double, 6> values;
};
template <int Dim>
[[nodiscard]] std::vector<NodeContact> node_contacts(const model::BasicSystem<Dim>& system,
                                                     const model::BasicModel<Dim>& model);

}  // namespace osculate::result
