#include "osculate/material/orthotropic.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

namespace osculate::material {
namespace {

/// Strains along the axes of unit stresses along them.
Mat<3, 3> compliance(const Orthotropic& c) {
  Mat<3, 3> s;
  s << 1 / c.e1, -c.nu12 / c.e1, -c.nu13 / c.e1,  //
      -c.nu12 / c.e1, 1 / c.e2, -c.nu23 / c.e2,   //
      -c.nu13 / c.e1, -c.nu23 / c.e2, 1 / c.e3;
  return s;
}

}  // namespace

Tangent3 stiffness(const Orthotropic& law) {
  Tangent3 d = Tangent3::Zero();
  const Mat<3, 3> along = compliance(law).inverse();
  d.topLeftCorner<3, 3>() = 0.5 * (along + along.transpose());
  d.diagonal().tail<3>() << law.g12, law.g23, law.g13;
  return d;
}

namespace {

std::optional<core::Fault> orthotropic_fault(const Orthotropic& c) {
  const auto needed = [](std::string_view what, std::string_view key) {
    return core::Fault{
        fmt::format("{} is needed: else the stiffness is not positive definite", what), key, {}};
  };
  if (!(c.nu12 * c.nu12 * c.e2 < c.e1)) return needed("nu12^2 < E1 / E2", "nu12");
  if (!(c.nu13 * c.nu13 * c.e3 < c.e1)) return needed("nu13^2 < E1 / E3", "nu13");
  if (!(c.nu23 * c.nu23 * c.e3 < c.e2)) return needed("nu23^2 < E2 / E3", "nu23");
  if (first_not_positive(stiffness(c)))
    return needed("nu12^2 E2 / E1 + nu13^2 E3 / E1 + nu23^2 E3 / E2 + 2 nu12 nu13 nu23 E3 / E1 < 1",
                  {});
  return std::nullopt;
}

}  // namespace

std::optional<core::Fault> Orthotropic::fault() const {
  constexpr int between = 7;  // these conditions are not linear in the constants
  return fault_over_temperature(*this, between,
                                [](const Orthotropic& c) { return orthotropic_fault(c); });
}

}  // namespace osculate::material
