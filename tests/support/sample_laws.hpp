#pragma once
#include "osculate/material/catalogue.hpp"

namespace osculate::testing {

/// Gives a material the elastic constants; those of rubber have terms of every kind.
template <class T>
void set_elastic(T& law, double young, double poisson) {
  if constexpr (requires { law.young; }) {
    law.young = young;
    law.poisson = poisson;
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

}  // namespace osculate::testing
