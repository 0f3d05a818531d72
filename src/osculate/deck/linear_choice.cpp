#include "osculate/deck/linear_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/memory.hpp"
#include "osculate/la/iterative.hpp"
#include "osculate/mesh/compactness.hpp"
#include "osculate/model/changing_unknowns.hpp"
#include "osculate/model/factor_estimate.hpp"
#include "osculate/model/unknown_places.hpp"

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

/// Whether nearly all of the tangent stays what it is, so that factors of it serve for long, or all
/// but few unknowns are eliminated (what la::Condensed asks for, but for its multipliers).
template <int Dim>
bool stays_mostly(const model::BasicModel<Dim>& model, const model::BasicDofSpace<Dim>& dofs,
                  double operations) {
  constexpr double worth_it = 3, most = 4000;
  const bool linear = std::ranges::all_of(
      model.sections, [](const auto& section) { return model::is_linear(section); });
  const bool tied = std::ranges::all_of(
      model.pairs, [](const auto& pair) { return pairing::is_tied(pair.definition); });
  if (linear && tied) return true;
  const std::vector<Index> few = model::changing_unknowns(model, dofs, 0);
  const auto count = static_cast<double>(few.size());
  return !few.empty() && count <= most && operations > worth_it * count * count * count / 3;
}

/// Of the unknowns, those that multigrid solves for exactly: factors of their own in each
/// iteration.
template <int Dim>
double share_of_exact(const model::BasicModel<Dim>& model, const model::BasicDofSpace<Dim>& dofs) {
  const la::Places places = model::unknown_places(model, dofs, 0);
  const auto exact = std::ranges::count(places.exact, 1);
  return static_cast<double>(exact) /
         static_cast<double>(std::max<std::size_t>(1, places.exact.size()));
}

template <int Dim>
double most_entries(const model::BasicModel<Dim>& model, double operations,
                    const FactorLimits& limits) {
  const model::BasicDofSpace<Dim> dofs = model::dof_space(model);
  if (stays_mostly(model, dofs, operations) || share_of_exact(model, dofs) > limits.exact)
    return limits.anything;
  std::vector<mesh::CellRef> cells;
  for (const auto& section : model.sections)
    cells.insert(cells.end(), section.cells.begin(), section.cells.end());
  return mesh::least_compactness(model.mesh, cells) < limits.compactness ? limits.anything
                                                                         : limits.compact;
}

/// Whether factors have more entries for each unknown than multigrid is cheaper than.
template <int Dim>
bool too_many_entries(const model::BasicModel<Dim>& model, const model::FactorEstimate& factors,
                      double triangles, const FactorLimits& limits) {
  const double each =
      triangles * factors.entries / static_cast<double>(Dim * model.mesh.nodes.size());
  if (each <= std::min(limits.compact, limits.anything) || keeps_volume(model)) return false;
  return each > limits.anything || each > most_entries(model, factors.operations, limits);
}

}  // namespace

template <int Dim>
void choose_linear_solver(Linear asked, const FactorLimits& limits, BasicBuilt<Dim>& built) {
  if (asked == Linear::direct || !model::factors_tangents(built.model.steps)) return;
  if (asked == Linear::automatic) {
    const double triangles = model::needs_unsymmetric(built.model) ? 2 : 1;
    const model::FactorEstimate factors = model::factor_estimate(built.model);
    const double needed = model::factor_bytes(triangles * factors.entries);
    if (limits.memory > 0 && needed > limits.memory)
      built.linear_note =
          fmt::format("multigrid, as factors of the tangent would take about {} of {}",
                      core::memory_text(needed), core::memory_text(limits.memory));
    else if (2 * factors.entries > limits.entries ||
             too_many_entries(built.model, factors, triangles, limits))
      built.linear_note =
          fmt::format("multigrid, as factors of the tangent would have about {:.2g} entries",
                      triangles * factors.entries);
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
