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
double sum(const material::Law& law, const CellStressType& cell) {
  if (cell.status != Status::ok) return std::numeric_limits<double>::infinity();
  double energy = 0;
  for (int q = 0; q < cell.count; ++q) {
    const auto& p = cell.point[static_cast<std::size_t>(q)];
    energy += p.volume * material::stored_energy(law, engineering(p.strain));
  }
  return energy;
}

}  // namespace

double strain_energy(const Section& section, cell::CellType type, const Coordinates& reference,
                     const Coordinates& displacement) {
  return sum(section.law, stress_at_points(section, type, reference, displacement));
}

double strain_energy(const VolumeSection& section, cell::CellType type,
                     const Coordinates3& reference, const Coordinates3& displacement) {
  return sum(section.law, stress_at_points(section, type, reference, displacement));
}

}  // namespace osculate::solid
