#include "osculate/material/energy.hpp"

namespace osculate::material {
namespace {

template <class StrainType>
double energy(const Law& law, const StrainType& strain, [[maybe_unused]] const double* state) {
  const auto of = [&]<class T>(const T& l) {
    if constexpr (Remembers<T>)
      return energy_of(l, in_space(strain), state);
    else
      return energy_of(l, strain);
  };
  return std::visit(of, law);
}

}  // namespace

double stored_energy(const Law& law, const Strain& strain, const double* state) {
  return energy(law, strain, state);
}
double stored_energy(const Law& law, const Strain3& strain, const double* state) {
  return energy(law, strain, state);
}

double dissipated_energy(const Law& law, const double* state) {
  const auto of = [&]<class T>([[maybe_unused]] const T& l) -> double {
    if constexpr (Remembers<T>) return dissipated_by(l, state);
    return 0;
  };
  return std::visit(of, law);
}

}  // namespace osculate::material
