#pragma once
#include "osculate/material/catalogue.hpp"

namespace osculate::testing {

/// Hooke's law as a routine of a user, with E and nu as constants; Cauchy's stress is that of the
/// undeformed volume over J: sigma = D eps / J, J = det of the deformation gradient.
inline void user_hooke(double* stress, double*, double* ddsdde, double*, double*, double*, double*,
                       double*, double*, double*, double* stran, double* dstran, double*, double*,
                       double*, double*, double*, double*, char*, int*, int*, int*, int*,
                       double* props, int*, double*, double*, double*, double*, double*,
                       double* dfgrd1, int*, int*, int*, int*, int*, int*, std::size_t) {
  const material::Lame c = material::lame(props[0], props[1]);
  const double volume = Eigen::Map<const Mat<3, 3>>(dfgrd1).determinant();
  for (int i = 0; i < 6; ++i) {
    stress[i] = 0;
    for (int j = 0; j < 6; ++j) {
      double& d = ddsdde[6 * j + i];
      d = i < 3 && j < 3 ? c.lambda / volume : 0;
      if (i == j) d += (i < 3 ? 2 * c.mu : c.mu) / volume;
      stress[i] += d * (stran[j] + dstran[j]);
    }
  }
}

/// Gives a material the elastic constants; those of rubber have terms of every kind.
template <class T>
void set_elastic(T& law, double young, double poisson) {
  if constexpr (requires { law.young; }) {
    law.young = young;
    law.poisson = poisson;
  } else if constexpr (requires { law.e1; }) {
    law.e1 = law.e2 = law.e3 = young;
    law.nu12 = law.nu13 = law.nu23 = poisson;
    law.g12 = law.g13 = law.g23 = young / (2 * (1 + poisson));
  } else if constexpr (requires { law.d1111; }) {
    const material::Lame c = material::lame(young, poisson);
    law.d1111 = law.d2222 = law.d3333 = c.lambda + 2 * c.mu;
    law.d1122 = law.d1133 = law.d2233 = c.lambda;
    law.d1212 = law.d1313 = law.d2323 = c.mu;
  } else if constexpr (requires { law.alpha1; }) {
    const double mu = young / (2 * (1 + poisson));
    law.mu1 = 0.7 * mu;
    law.alpha1 = 2.5;
    law.mu2 = 0.3 * mu;
    law.alpha2 = -1.5;
    if constexpr (requires { law.d1; })
      law.d1 = 6 * (1 - 2 * poisson) / young;
    else
      law.nu1 = law.nu2 = poisson;
  } else if constexpr (requires { law.lambda_m; }) {
    law.lambda_m = 3;
    const double of_one = 2 * by_invariants(T{1, law.lambda_m, 1, 0}, {}).d1;
    law.mu = young / (2 * (1 + poisson)) / of_one;
    law.d = 6 * (1 - 2 * poisson) / young;
  } else if constexpr (requires { law.routine; }) {
    law.constants = {young, poisson};
    (void)law.use(user_hooke);
  } else {
    const double mu = young / (2 * (1 + poisson)), bulk = young / (3 * (1 - 2 * poisson));
    law.c10 = 0.4 * mu;
    law.c01 = 0.1 * mu;
    law.c20 = 0.02 * mu;
    law.c11 = 0.01 * mu;
    law.d1 = 2 / bulk;
  }
}
template <class T>
void set_elastic(material::Logarithmic<T>& form, double young, double poisson) {
  set_elastic(form.law, young, poisson);
}
template <class T>
void set_elastic(material::Relaxing<T>& form, double young, double poisson) {
  set_elastic(form.law, young, poisson);
  form.series = {{{0.3, 1}, {0.2, 5}}, {{0.3, 1}, {0.2, 5}}};
}
template <class T>
void set_elastic(material::GreenLagrange<T>& form, double young, double poisson) {
  set_elastic(form.law, young, poisson);
}

}  // namespace osculate::testing
