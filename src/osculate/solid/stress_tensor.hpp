#pragma once
#include "osculate/material/response.hpp"

namespace osculate::solid {

/// The components of a stress as a symmetric matrix; in the plane those of the plane.
[[nodiscard]] inline Mat<2, 2> stress_tensor(const material::Stress& s) {
  Mat<2, 2> t;
  t << s[0], s[3], s[3], s[1];
  return t;
}
[[nodiscard]] inline Mat<3, 3> stress_tensor(const material::Stress3& s) {
  Mat<3, 3> t;
  t << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return t;
}

}  // namespace osculate::solid
