#include "osculate/model/locking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "osculate/model/bulk.hpp"
#include "osculate/model/material_memory.hpp"
#include "osculate/solid/energy.hpp"

namespace osculate::model {
namespace {

/// The same section with another formulation, or as it is where that is not made for its cells.
template <int Dim>
solid::Section<Dim> with(const solid::Section<Dim>& section, solid::Formulation formulation,
                         cell::CellType type) {
  solid::Section<Dim> other = section;
  other.formulation = formulation;
  return solid::unsupported(other, type).empty() ? other : section;
}

double poisson_of(const material::Law& law) { return material::unloaded(law).poisson; }

}  // namespace

template <int Dim>
void measure_locking(const BasicModel<Dim>& model, const BasicState<Dim>& state,
                     std::vector<Locking>& found) {
  using Section = solid::Section<Dim>;
  using solid::Formulation;
  constexpr cell::CellType wanted = Dim == 2 ? cell::CellType::quad4 : cell::CellType::hex8;
  found.resize(model.sections.size());
  CellMemory memory;
  for (std::size_t s = 0; s < model.sections.size(); ++s) {
    const BasicBulkSection<Dim>& section = model.sections[s];
    const Section& full = section.section;
    Locking& sum = found[s];
    sum.section = section.name;
    sum.flows = !material::memory_of(full.law).empty();
    // Elsewhere volume changes are those of bending, as they should be.
    constexpr double nearly_incompressible = 0.45, visible = 1e-6;
    const bool keeps_volume = sum.flows || poisson_of(full.law) > nearly_incompressible;
    const Section enhanced = sum.flows ? full : with(full, Formulation::enhanced, wanted);
    const Section bbar = keeps_volume ? with(full, Formulation::bbar, wanted) : full;
    for (std::size_t i = 0; i < section.cells.size(); ++i) {
      const CellNodes cell = cell_nodes(model.mesh, section.cells[i]);
      memory = memory_after(memory, section, i, cell.type);
      if (memory.removed || full.formulation != Formulation::full || cell.type != wanted) continue;
      const CellPlaces<Dim> at =
          places_of(model, section, cell.nodes, state.u, memory.of(state.memory));
      const solid::Coordinates<Dim>&reference = at.reference, &moved = at.displacement;
      const auto energy_in = [&](const Section& of) {
        return solid::cell_energy(of, cell.type, reference, moved, memory.of(state.memory));
      };
      const solid::CellEnergy mean = energy_in(bbar), plain = energy_in(full);
      if (sum.flows && !(mean.dissipated > mean.stored)) continue;
      const double energy = plain.stored + plain.dissipated;
      if (!std::isfinite(energy)) continue;
      sum.floor += solid::strain_energy(full, cell.type, reference,
                                        solid::Coordinates<Dim>(visible * reference));
      sum.energy += energy;
      sum.enhanced += sum.flows ? energy : std::min(energy_in(enhanced).stored, energy);
      sum.bbar += std::min(mean.stored + mean.dissipated, energy);
    }
  }
}

std::string locks(const Locking& found) {
  if (!found.large()) return {};
  const bool volume = found.bbar < found.enhanced;
  const double left = volume ? found.bbar : found.enhanced;
  return fmt::format(
      "warning: section '{}': {:.2g} % of the {} is in strains that first-order cells "
      "cannot avoid (they lock, {}): the body is too stiff; give it formulation: {}, second-order "
      "cells, or more cells",
      found.section, 100 * (1 - left / found.energy),
      found.flows ? "work done on cells that flow" : "strain energy",
      found.flows ? "since flow keeps the volume"
      : volume    ? "being nearly incompressible"
                  : "in bending",
      volume ? "bbar" : "enhanced");
}

template void measure_locking(const BasicModel<2>&, const BasicState<2>&, std::vector<Locking>&);
template void measure_locking(const BasicModel<3>&, const BasicState<3>&, std::vector<Locking>&);

}  // namespace osculate::model
