#include "osculate/deck/linear_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/memory.hpp"
#include "osculate/la/iterative.hpp"
#include "osculate/model/factor_estimate.hpp"

namespace osculate::deck {
namespace {

/// Bodies that are nearly incompressible take multigrid many iterations.
template <int Dim>
bool keeps_volume(const model::BasicModel<Dim>& model) {
  constexpr double nearly = 0.49;
  return std::ranges::any_of(model.sections, [](const auto& of) {
    return material::unloaded(of.section.law).poisson > nearly;
  });
}

}  // namespace

template <int Dim>
void choose_linear_solver(Linear asked, const FactorLimits& limits, BasicBuilt<Dim>& built) {
  if (asked == Linear::direct || !model::factors_tangents(built.model.steps)) return;
  if (asked == Linear::automatic) {
    const double triangles = model::needs_unsymmetric(built.model) ? 2 : 1;
    const double entries = model::factor_entries(built.model);
    const double unknowns = static_cast<double>(Dim * built.model.mesh.nodes.size());
    const double needed = model::factor_bytes(triangles * entries);
    if (limits.memory > 0 && needed > limits.memory)
      built.linear_note =
          fmt::format("multigrid, as factors of the tangent would take about {} of {}",
                      core::memory_text(needed), core::memory_text(limits.memory));
    else if (2 * entries > limits.entries ||
             (triangles * entries > limits.of_unknown * unknowns && !keeps_volume(built.model)))
      built.linear_note =
          fmt::format("multigrid, as factors of the tangent would have about {:.2g} entries",
                      triangles * entries);
    else
      return;
  } else {
    built.linear_note = "multigrid";
  }
  built.options.linear_solver = la::make_iterative_solver;
  built.options.by_multigrid = true;
}

template void choose_linear_solver(Linear, const FactorLimits&, Built&);
template void choose_linear_solver(Linear, const FactorLimits&, Built3&);

}  // namespace osculate::deck
