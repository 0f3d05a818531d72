#include "osculate/deck/linear_choice.hpp"

#include <fmt/format.h>

#include "osculate/core/memory.hpp"
#include "osculate/la/iterative.hpp"
#include "osculate/model/factor_estimate.hpp"

namespace osculate::deck {

template <int Dim>
void choose_linear_solver(Linear asked, double memory, BasicBuilt<Dim>& built) {
  if (asked == Linear::direct || !model::factors_tangents(built.model.steps)) return;
  if (asked == Linear::automatic) {
    const double both = model::needs_unsymmetric(built.model) ? 2 : 1;  // triangles
    const double needed = model::factor_bytes(both * model::factor_entries(built.model));
    if (!(memory > 0) || needed <= memory) return;
    built.linear_note =
        fmt::format("multigrid, as factors of the tangent would take about {} of {}",
                    core::memory_text(needed), core::memory_text(memory));
  } else {
    built.linear_note = "multigrid";
  }
  built.options.linear_solver = la::make_iterative_solver;
}

template void choose_linear_solver(Linear, double, Built&);
template void choose_linear_solver(Linear, double, Built3&);

}  // namespace osculate::deck
