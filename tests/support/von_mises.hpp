#pragma once
#include <cmath>

#include "osculate/material/response.hpp"

namespace osculate::support {

/// Formula    sqrt(3/2 dev(s) : dev(s))
[[nodiscard]] inline double mises(const material::Stress3& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * s.tail<3>().squaredNorm());
}

}  // namespace osculate::support
