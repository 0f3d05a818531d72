#include "osculate/solid/energy.hpp"

#include <limits>

#include "osculate/material/energy.hpp"

namespace osculate::solid {
namespace {

material::Strain engineering(const Vec<4>& strain) {
  material::Strain e = strain;
  e[3] *= 2;
  return e;
}
material::Strain3 engineering(const Vec<6>& strain) {
  material::Strain3 e = strain;
  e.tail<3>() *= 2;
  return e;
}

template <class CellStressType>
CellEnergy sum(const material::Law& law, const CellStressType& cell,
               const material::Memory& memory) {
  if (cell.status != Status::ok) return {std::numeric_limits<double>::infinity()};
  CellEnergy energy;
  for (std::size_t q = 0; q < static_cast<std::size_t>(cell.count); ++q) {
    const auto& p = cell.point[q];
    const double* const state = memory.at(q).committed;
    energy.stored += p.volume * material::stored_energy(law, engineering(p.strain), state);
    if (state) energy.dissipated += p.volume * material::dissipated_energy(law, state);
  }
  return energy;
}

}  // namespace

CellEnergy cell_energy(const Section& section, cell::CellType type, const Coordinates& reference,
                       const Coordinates& displacement, const material::Memory& memory) {
  return sum(section.law, stress_at_points(section, type, reference, displacement, memory), memory);
}
CellEnergy cell_energy(const VolumeSection& section, cell::CellType type,
                       const Coordinates3& reference, const Coordinates3& displacement,
                       const material::Memory& memory) {
  return sum(section.law, stress_at_points(section, type, reference, displacement, memory), memory);
}

double strain_energy(const Section& section, cell::CellType type, const Coordinates& reference,
                     const Coordinates& displacement) {
  return cell_energy(section, type, reference, displacement, {}).stored;
}
double strain_energy(const VolumeSection& section, cell::CellType type,
                     const Coordinates3& reference, const Coordinates3& displacement) {
  return cell_energy(section, type, reference, displacement, {}).stored;
}

}  // namespace osculate::solid
