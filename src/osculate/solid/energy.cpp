#include "osculate/solid/energy.hpp"

#include <limits>

#include "osculate/material/energy.hpp"
#include "osculate/solid/point_axes.hpp"
#include "osculate/solid/reduced.hpp"

namespace osculate::solid {

template <int Dim>
std::array<CellEnergy, max_points<Dim>> point_energies(const Section<Dim>& section,
                                                       cell::CellType type,
                                                       const Coordinates<Dim>& reference,
                                                       const CellStress<Dim>& cell,
                                                       const material::Memory& memory) {
  std::array<CellEnergy, max_points<Dim>> energies{};
  const PointAxes<Dim> placed(section, type, reference);
  const material::Memory here = placed.in(memory);
  for (std::size_t q = 0; q < static_cast<std::size_t>(cell.count); ++q) {
    const double* const state = memory.at(q).committed;
    Vec<components<Dim>> strain = cell.point[q].strain;
    strain.template tail<components<Dim> - 3>() *= 2;
    energies[q].stored = material::stored_energy(section.law, strain, here.at(q));
    if (state) energies[q].dissipated = material::dissipated_energy(section.law, state);
  }
  return energies;
}

template <int Dim>
CellEnergy cell_energy(const Section<Dim>& section, cell::CellType type,
                       const Coordinates<Dim>& reference, const Coordinates<Dim>& displacement,
                       const material::Memory& memory) {
  const CellStress<Dim> cell = stress_at_points(section, type, reference, displacement, memory);
  if (cell.status != Status::ok) return {std::numeric_limits<double>::infinity()};
  const auto points = point_energies<Dim>(section, type, reference, cell, memory);
  CellEnergy energy;
  for (std::size_t q = 0; q < static_cast<std::size_t>(cell.count); ++q) {
    energy.stored += cell.point[q].volume * points[q].stored;
    energy.dissipated += cell.point[q].volume * points[q].dissipated;
  }
  if (section.formulation == Formulation::reduced && type == corner_cell<Dim>) {
    CornerPoint<Dim> p;
    if (fill_mean_point<Dim>(section, reference, displacement, p))
      energy.stored += hourglass<Dim>(section, reference, displacement, p, false).energy;
  }
  if constexpr (Dim == 3) {
    if (has_faint_stiffness(section, type)) {
      const auto resistance = faint_stiffness(section, type, reference);
      energy.stored += 0.5 * (displacement.transpose() * resistance * displacement).trace();
    }
  }
  return energy;
}

template std::array<CellEnergy, max_points<2>> point_energies(const Section<2>&, cell::CellType,
                                                              const Coordinates<2>&,
                                                              const CellStress<2>&,
                                                              const material::Memory&);
template std::array<CellEnergy, max_points<3>> point_energies(const Section<3>&, cell::CellType,
                                                              const Coordinates<3>&,
                                                              const CellStress<3>&,
                                                              const material::Memory&);
template CellEnergy cell_energy(const Section<2>&, cell::CellType, const Coordinates<2>&,
                                const Coordinates<2>&, const material::Memory&);
template CellEnergy cell_energy(const Section<3>&, cell::CellType, const Coordinates<3>&,
                                const Coordinates<3>&, const material::Memory&);

}  // namespace osculate::solid
