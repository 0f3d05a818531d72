#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "osculate/core/crew.hpp"
#include "osculate/model/inertia.hpp"
#include "osculate/model/linear_cells.hpp"
#include "osculate/model/material_memory.hpp"
#include "osculate/model/shares.hpp"
#include "osculate/model/state.hpp"
#include "osculate/model/terms/assembly.hpp"
#include "osculate/solve/newton.hpp"

namespace osculate::model {

/// Which cells an evaluation is of: `constant` ones have the same stiffness in all of a step
/// (is_constant).
enum class Cells : std::uint8_t { all, constant, others };

/// The bodies: internal forces and stiffness of all cells, which are computed in parallel and added
/// in order.
///
/// Tested by  tests/unit/model/test_system.cpp, tests/unit/deck/test_linear_cells.cpp
template <int Dim>
struct BulkTerm {
  using State = BasicState<Dim>;
  struct Job {
    const BasicBulkSection<Dim>* section;
    mesh::CellRef cell;
    CellMemory memory;
  };

  const BasicModel<Dim>& model;
  int threads;
  core::Crew crew;
  std::vector<Job> jobs;
  LinearCells<Dim> linear;  ///< by job
  std::vector<char> stays;  ///< by job: constant ones
  std::vector<BasicBulkBlock<Dim>> blocks;
  Cells which = Cells::all;                   ///< what `add` is of
  std::vector<std::size_t> constant, others;  ///< numbers of jobs
  double seconds = 0;
  const core::Ranks* ranks = nullptr;  ///< who share the cells; null: all are evaluated here
  Shares shares;
  Eigen::VectorXd* diagonal =
      nullptr;  ///< gets those of tangents added, in size; none: nobody asks

  BulkTerm(const BasicModel<Dim>& m, const BasicDofSpace<Dim>& dofs, int thread_count);
  /// The places of all cells in the matrix.
  /// Places for the entries of all cells, but for those of unknowns that are `prescribed`, which
  /// have none.
  void reserve(const BasicDofSpace<Dim>& dofs, const std::vector<bool>& prescribed,
               la::MatrixBuilder& builder) const;
  /// Matrices of linear cells will be kept, of those that are evaluated here.
  void keep_linear();
  /// A cell at the nodal displacements `u` after what its points remember; nothing (no dofs) of one
  /// that is not there. Different cells may be evaluated at once. `next` may be empty; `duration`
  /// of the increment.
  void evaluate(std::size_t job, const Eigen::VectorXd& u, std::span<const double> memory,
                std::span<double> next, double duration, bool with_tangent,
                BasicBulkBlock<Dim>& out) {
    const Job& j = jobs[job];
    if (j.memory.removed) {
      out.ok = true;
      out.dof_count = 0;
      return;
    }
    linear.evaluate(job, model, *j.section, j.cell, u, j.memory.of(memory, next, duration),
                    with_tangent, out);
  }
  /// Adds what `which` says; all cells begin a matrix anew. False: a cell cannot be evaluated,
  /// `out` says why. `inertia` may be null.
  bool add(const State& committed, const State& trial, double duration,
           const CellInertia<Dim>* inertia, Assembly<Dim>& to, solve::Evaluation& out);
  /// After evaluations that were shared: what the points of all cells remember.
  void exchange_memory(const core::Ranks& among, std::span<const std::size_t> own,
                       std::vector<double>& memory) const;
  /// What stresses do to the stiffness, of cells of small strain (those of finite strain have it in
  /// their tangent): those of `at`, less those of `less` (null: none).
  ///
  /// Formula    solid::stress_stiffness
  /// Tested by  tests/unit/deck/test_vibrations.cpp, test_buckling.cpp
  void add_stresses(const Strained& at, const Strained* less, Assembly<Dim>& to);

 private:
  /// Numbers of jobs, in their order.
  struct Numbers {
    const std::vector<std::size_t>* some;  ///< null: all
    std::size_t count;
    [[nodiscard]] std::size_t operator[](std::size_t i) const { return some ? (*some)[i] : i; }
  };
  [[nodiscard]] Numbers cells_here() const;
  /// Evaluates cells in parallel, tile by tile, and hands them over in order: take(job, block).
  /// `failed`: the first that cannot be evaluated, and `out` says why; nothing more is handed over.
  template <class WithTangent, class Take>
  bool evaluate_in_order(const Numbers& cells, const State& committed, const State& trial,
                         double duration, Evaluated<Dim>& into, solve::Evaluation& out,
                         std::size_t& failed, const WithTangent& with_tangent, const Take& take);
  bool add_cells(const State& committed, const State& trial, double duration,
                 const CellInertia<Dim>* inertia, Assembly<Dim>& to, solve::Evaluation& out,
                 std::size_t& failed);
  [[nodiscard]] bool all_added(std::size_t failed, Assembly<Dim>& to, solve::Evaluation& out);
};

extern template struct BulkTerm<2>;
extern template struct BulkTerm<3>;

}  // namespace osculate::model
