#include "osculate/material/rubber.hpp"

#include <cmath>

namespace osculate::material {

ByInvariants by_invariants(const Rubber& c, const Invariants& v) {
  const double a = v.bar_first, b = v.bar_second, j = std::expm1(v.log_j);
  ByInvariants w;
  w.energy = c.c10 * a + c.c01 * b + c.c20 * a * a + c.c11 * a * b + c.c02 * b * b +
             c.c30 * a * a * a + c.c21 * a * a * b + c.c12 * a * b * b + c.c03 * b * b * b;
  w.d1 = c.c10 + 2 * c.c20 * a + c.c11 * b + 3 * c.c30 * a * a + 2 * c.c21 * a * b + c.c12 * b * b;
  w.d2 = c.c01 + c.c11 * a + 2 * c.c02 * b + c.c21 * a * a + 2 * c.c12 * a * b + 3 * c.c03 * b * b;
  w.d11 = 2 * c.c20 + 6 * c.c30 * a + 2 * c.c21 * b;
  w.d12 = c.c11 + 2 * c.c21 * a + 2 * c.c12 * b;
  w.d22 = 2 * c.c02 + 2 * c.c12 * a + 6 * c.c03 * b;
  const double square = j * j;
  double power = 1;  // (J - 1)^(2 k - 2)
  int n = 2;
  for (const double d : {c.d1, c.d2, c.d3}) {
    if (d > 0) {
      w.volume += power * square / d;
      w.dj += n * power * j / d;
      w.djj += n * (n - 1) * power / d;
    }
    power *= square;
    n += 2;
  }
  return w;
}

Isotropic unloaded(const Rubber& law) { return isotropic_of(2 * (law.c10 + law.c01), 2 / law.d1); }

}  // namespace osculate::material
