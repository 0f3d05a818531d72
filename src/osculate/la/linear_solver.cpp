#include "osculate/la/linear_solver.hpp"

#include "osculate/la/condensed.hpp"

namespace osculate::la {

std::unique_ptr<LinearSolver> make_default_solver() { return std::make_unique<Condensed>(); }

}  // namespace osculate::la
