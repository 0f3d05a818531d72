#pragma once
#include <limits>
#include <string_view>

#include "osculate/contact/law/tangential.hpp"

namespace osculate::contact {

/// No sliding while in contact: t = t_tr.
///
/// Tested by  tests/unit/contact/test_friction_laws.cpp
struct Rough {
  static constexpr std::string_view key = "rough";
  double stiffness = 0;  ///< eps_T

  [[nodiscard]] SlipLimit predicted_limit(double, double, const Sliding&) const {
    return {std::numeric_limits<double>::infinity(), 0, 0};
  }
  template <int Dim>
  [[nodiscard]] TangentialResponse<Dim> response(const Vec<Dim - 1>& trial, double,
                                                 const Sliding& = {}) const {
    return stick_response<Dim>(trial);
  }
};

}  // namespace osculate::contact
