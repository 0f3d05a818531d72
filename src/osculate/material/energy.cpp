#include "osculate/material/energy.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace osculate::material {
namespace {

Mat<3, 3> cauchy_green(const Strain& e) {
  Mat<3, 3> c = Mat<3, 3>::Identity();
  c.diagonal() += 2 * e.head<3>();
  c(0, 1) = c(1, 0) = e[3];
  return c;
}
Mat<3, 3> cauchy_green(const Strain3& e) {
  Mat<3, 3> c = Mat<3, 3>::Identity();
  c.diagonal() += 2 * e.head<3>();
  c(0, 1) = c(1, 0) = e[3];
  c(1, 2) = c(2, 1) = e[4];
  c(0, 2) = c(2, 0) = e[5];
  return c;
}

template <class StrainType>
double energy(const LinearElastic& law, const StrainType& strain) {
  return 0.5 * respond(law, strain).stress.dot(strain);
}
template <class StrainType>
double energy(const StVenantKirchhoff& law, const StrainType& strain) {
  return 0.5 * respond(law, strain).stress.dot(strain);
}
template <class StrainType>
double energy(const NeoHooke& law, const StrainType& strain) {
  const Lame k = lame(law.young, law.poisson);
  const double det = cauchy_green(strain).determinant();
  if (!(det > 0)) return std::numeric_limits<double>::infinity();
  const double log_j = 0.5 * std::log(det);
  return k.mu * strain.template head<3>().sum() - k.mu * log_j + 0.5 * k.lambda * log_j * log_j;
}

}  // namespace

double stored_energy(const Law& law, const Strain& strain) {
  return std::visit([&](const auto& l) { return energy(l, strain); }, law);
}
double stored_energy(const Law& law, const Strain3& strain) {
  return std::visit([&](const auto& l) { return energy(l, strain); }, law);
}

}  // namespace osculate::material
