#include "osculate/material/energy.hpp"

namespace osculate::material {

double stored_energy(const Law& law, const Strain& strain) {
  return std::visit([&](const auto& l) { return energy_of(l, strain); }, law);
}
double stored_energy(const Law& law, const Strain3& strain) {
  return std::visit([&](const auto& l) { return energy_of(l, strain); }, law);
}

}  // namespace osculate::material
