#pragma once
#include "osculate/la/engine.hpp"

namespace osculate::mpi {

/// GMRES of PETSc, preconditioned by its smoothed aggregation (GAMG) with the rigid motions as near
/// null vectors, and by factors of what is exact. Every node has a block of rows, those that are no
/// unknowns by themselves.
///
/// Formula    as la::Iterative
/// Requires   matrices of these processes (la::SparseMatrix::ranks)
/// Errors     std::bad_alloc; std::runtime_error where PETSc says that it was called wrongly
/// Tested by  tests/ranks
[[nodiscard]] la::Engine* make_engine(const core::Ranks& ranks);

/// Before MPI ends.
void end_petsc();

}  // namespace osculate::mpi
