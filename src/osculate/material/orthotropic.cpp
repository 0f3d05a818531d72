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

std::optional<core::Fault> Orthotropic::fault() const {
  const auto needed = [](std::string_view what, std::string_view key) {
    return core::Fault{
        fmt::format("{} is needed: else the stiffness is not positive definite", what), key, {}};
  };
  if (!(nu12 * nu12 * e2 < e1)) return needed("nu12^2 < E1 / E2", "nu12");
  if (!(nu13 * nu13 * e3 < e1)) return needed("nu13^2 < E1 / E3", "nu13");
  if (!(nu23 * nu23 * e3 < e2)) return needed("nu23^2 < E2 / E3", "nu23");
  if (first_not_positive(stiffness(*this)))
    return needed("nu12^2 E2 / E1 + nu13^2 E3 / E1 + nu23^2 E3 / E2 + 2 nu12 nu13 nu23 E3 / E1 < 1",
                  {});
  return std::nullopt;
}

}  // namespace osculate::material
