#include "osculate/material/energy.hpp"

#include "osculate/material/expansion.hpp"
#include "osculate/material/law.hpp"
#include "osculate/material/over_temperature.hpp"

namespace osculate::material {
namespace {

template <class StrainType>
double energy(const Law& law, const StrainType& strain, const Memory& memory) {
  const Expanded by(finite_strain(law), memory);
  const StrainType elastic = by.elastic(strain);
  const auto of = [&]<class T>(const T& l) {
    if constexpr (Directional<T>)
      return 0.5 * elastic.dot(proportional(stiffness_at(l, memory), elastic).stress);
    else if constexpr (Remembers<T>)
      return energy_of(l, in_space(elastic), memory);
    else if constexpr (OverTemperature<T>)
      return energy_of(at_point(l, memory), elastic);
    else
      return energy_of(l, elastic);
  };
  return by.volume() * std::visit(of, law);
}

}  // namespace

double stored_energy(const Law& law, const Strain& strain, const Memory& memory) {
  return energy(law, strain, memory);
}
double stored_energy(const Law& law, const Strain3& strain, const Memory& memory) {
  return energy(law, strain, memory);
}

double dissipated_energy(const Law& law, const double* state) {
  const auto of = [&]<class T>([[maybe_unused]] const T& l) -> double {
    if constexpr (Remembers<T>) return dissipated_by(l, state);
    return 0;
  };
  return std::visit(of, law);
}

}  // namespace osculate::material
