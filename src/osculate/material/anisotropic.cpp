#include "osculate/material/anisotropic.hpp"

#include <fmt/format.h>

namespace osculate::material {

/// Components are in the order 11, 22, 33, 12, 23, 13.
Tangent3 stiffness(const Anisotropic& c) {
  Tangent3 d;
  d << c.d1111, c.d1122, c.d1133, c.d1112, c.d1123, c.d1113,  //
      c.d1122, c.d2222, c.d2233, c.d2212, c.d2223, c.d2213,   //
      c.d1133, c.d2233, c.d3333, c.d3312, c.d3323, c.d3313,   //
      c.d1112, c.d2212, c.d3312, c.d1212, c.d1223, c.d1213,   //
      c.d1123, c.d2223, c.d3323, c.d1223, c.d2323, c.d1323,   //
      c.d1113, c.d2213, c.d3313, c.d1213, c.d1323, c.d1313;
  return d;
}

namespace {

std::optional<core::Fault> anisotropic_fault(const Anisotropic& c) {
  constexpr std::array<std::string_view, 6> diagonal{"D1111", "D2222", "D3333",
                                                     "D1212", "D2323", "D1313"};
  const std::optional<int> row = first_not_positive(stiffness(c));
  if (!row) return std::nullopt;
  const std::string_view key = diagonal[static_cast<std::size_t>(*row)];
  return core::Fault{
      fmt::format("{} is too small beside the other constants: the stiffness is not positive "
                  "definite",
                  key),
      key,
      {}};
}

}  // namespace

/// What is positive definite at two temperatures is so between them.
std::optional<core::Fault> Anisotropic::fault() const {
  return fault_over_temperature(*this, 0,
                                [](const Anisotropic& c) { return anisotropic_fault(c); });
}

}  // namespace osculate::material
