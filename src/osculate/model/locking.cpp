#include "osculate/model/locking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "osculate/model/bulk.hpp"
#include "osculate/solid/energy.hpp"

namespace osculate::model {
namespace {

/// The same section with another formulation, or as it is where that is not made for its cells.
template <class Section, class Formulation>
Section with(Section section, Formulation formulation, cell::CellType type) {
  Section other = section;
  other.formulation = formulation;
  return solid::unsupported(other, type).empty() ? other : section;
}

double poisson_of(const material::Law& law) { return material::unloaded(law).poisson; }

}  // namespace

template <int Dim>
void measure_locking(const BasicModel<Dim>& model, const Eigen::VectorXd& u,
                     std::vector<Locking>& found) {
  using Section = SolidSection<Dim>;
  using Formulation = decltype(Section::formulation);
  constexpr cell::CellType wanted = Dim == 2 ? cell::CellType::quad4 : cell::CellType::hex8;
  found.resize(model.sections.size());
  for (std::size_t s = 0; s < model.sections.size(); ++s) {
    const BasicBulkSection<Dim>& section = model.sections[s];
    found[s].section = section.name;
    if (section.section.formulation != Formulation::full) continue;
    if (!material::memory_of(section.section.law).empty()) continue;  // no energy of its own
    const Section enhanced = with(section.section, Formulation::enhanced, wanted);
    // Elsewhere volume changes are those of bending, as they should be.
    constexpr double nearly_incompressible = 0.45, visible = 1e-6;
    const bool keeps_volume = poisson_of(section.section.law) > nearly_incompressible;
    const Section bbar =
        with(section.section, keeps_volume ? Formulation::bbar : Formulation::full, wanted);
    for (const mesh::CellRef& ref : section.cells) {
      const CellNodes cell = cell_nodes(model.mesh, ref);
      if (cell.type != wanted) continue;
      const SolidCoordinates<Dim> reference = reference_of(model, cell.nodes),
                                  moved = displacement_of<Dim>(u, cell.nodes);
      found[s].floor += solid::strain_energy(section.section, cell.type, reference,
                                             SolidCoordinates<Dim>(visible * reference));
      const double energy = solid::strain_energy(section.section, cell.type, reference, moved);
      const double left = solid::strain_energy(enhanced, cell.type, reference, moved);
      const double mean = solid::strain_energy(bbar, cell.type, reference, moved);
      if (!std::isfinite(energy)) continue;
      found[s].energy += energy;
      found[s].enhanced += std::min(left, energy);
      found[s].bbar += std::min(mean, energy);
    }
  }
}

std::string locks(const Locking& found) {
  if (!found.large()) return {};
  const bool volume = found.bbar < found.enhanced;
  const double left = volume ? found.bbar : found.enhanced;
  return fmt::format(
      "warning: section '{}': {:.2g} % of the strain energy is in strains that first-order cells "
      "cannot avoid (they lock, {}): the body is too stiff; give it formulation: {}, second-order "
      "cells, or more cells",
      found.section, 100 * (1 - left / found.energy),
      volume ? "being nearly incompressible" : "in bending", volume ? "bbar" : "enhanced");
}

template void measure_locking(const BasicModel<2>&, const Eigen::VectorXd&, std::vector<Locking>&);
template void measure_locking(const BasicModel<3>&, const Eigen::VectorXd&, std::vector<Locking>&);

}  // namespace osculate::model
