#include "osculate/material/law.hpp"

namespace osculate::material {
namespace {

/// Of laws that do not say their stress without its derivative.
template <class T, int N>
StressOf<N> stress_of(const T& law, const Vec<N>& strain) {
  const ResponseOf<N> r = respond(law, strain);
  return {r.ok, r.stress};
}

}  // namespace

bool finite_strain(const Law& law) {
  return std::visit([](const auto& m) { return m.finite_strain; }, law);
}

bool large_strain(const Law& law) {
  return std::visit([](const auto& m) { return m.large_strain; }, law);
}

double density(const Law& law) {
  return std::visit([](const auto& m) { return m.density; }, law);
}

Isotropic unloaded(const Law& law) {
  return std::visit([](const auto& m) { return unloaded(m); }, law);
}

std::string_view key_of(const Law& law) {
  return std::visit([](const auto& m) { return m.key; }, law);
}

std::string range_problem(const Law& law) {
  return std::visit([](const auto& m) { return core::range_problem(m); }, law);
}

Response response(const Law& law, const Strain& strain) {
  return std::visit([&](const auto& m) { return respond(m, strain); }, law);
}

StressOf<4> stress(const Law& law, const Strain& strain) {
  return std::visit([&](const auto& m) { return stress_of(m, strain); }, law);
}

StressOf<6> stress(const Law& law, const Strain3& strain) {
  return std::visit([&](const auto& m) { return stress_of(m, strain); }, law);
}

Response plane_stress_response(const Law& law, const Strain& strain, double* strain_33) {
  double found = 0;
  const Response r =
      std::visit([&](const auto& m) { return respond_plane_stress(m, strain, found); }, law);
  if (strain_33) *strain_33 = found;
  return r;
}

}  // namespace osculate::material
