#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "osculate/la/mumps.hpp"
#include "osculate/la/preconditioned.hpp"

namespace osculate::la {

/// What goes through the iterations of la::Iterative, which decides when, and what to believe.
///
/// Contract   the bits of a solution depend on the matrix, the places, and the matrices since the
///            last `build` alone (and on how rows are dealt out to processes)
class Engine {
 public:
  Engine() = default;
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Prepares for a matrix. False: it cannot be, as where a body is free to move.
  virtual bool build(const SparseMatrix& k, Symmetry symmetry, const Places& places) = 0;
  /// Prepares for a matrix of the same unknowns with the coarser models of the last one built. What
  /// is exact has its own factors, or those of an earlier matrix that was alike there. False: it
  /// has to be built.
  virtual bool refresh(const SparseMatrix& k, Symmetry symmetry, const Places& places) = 0;
  /// Whether the last `refresh` found factors that serve on.
  [[nodiscard]] virtual bool keeps_factors() const = 0;
  /// Prepares anew for the matrix of the last `refresh`.
  virtual bool build_again(const Places& places) = 0;
  /// Returns    as PreconditionedSolutions
  virtual Nearby solve(const PreconditionedLimits& limits,
                       Eigen::VectorXd& rhs_in_solution_out) = 0;
  /// A x
  [[nodiscard]] virtual Eigen::VectorXd times(const Eigen::VectorXd& x) = 0;
  /// Sizes of the diagonal entries of the matrix.
  [[nodiscard]] virtual Eigen::VectorXd diagonal() const = 0;
  /// The matrix, both triangles.
  [[nodiscard]] virtual SparseMatrix matrix() const = 0;
};

/// la::Multigrid, with factors of what is exact; `direct` is how several processes factor.
[[nodiscard]] std::unique_ptr<Engine> make_multigrid_engine(const MumpsOptions& direct);

}  // namespace osculate::la
