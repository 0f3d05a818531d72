#pragma once
#include "osculate/la/mumps.hpp"

namespace osculate::la {

/// How several processes solve together.
struct SharedSolvers {
  SharedMumps mumps{};
};

/// What the library of several processes (libosculate-mpi) hands out: they have begun then.
struct RanksLibrary {
  const core::Ranks* ranks = nullptr;  ///< of this process, until it ends
  SharedSolvers solvers{};
};
/// The name of the function that hands it out, `void f(RanksLibrary&)`.
constexpr const char* begin_ranks = "osculate_begin_ranks";

}  // namespace osculate::la
