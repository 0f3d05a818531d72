#include "osculate/la/linear_solver.hpp"

#include "osculate/la/mumps.hpp"

namespace osculate::la {

std::unique_ptr<LinearSolver> make_default_solver() { return std::make_unique<Mumps>(); }

}  // namespace osculate::la
