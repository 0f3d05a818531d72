#include "osculate/contact/law/catalogue.hpp"

#include <fmt/format.h>

namespace osculate::contact {
namespace {

bool positive(double value) { return value > 0 && std::isfinite(value); }
bool not_negative(double value) { return value >= 0 && std::isfinite(value); }

std::string fault_of(const NormalPenalty& law) {
  if (positive(law.stiffness)) return {};
  return fmt::format("normal_penalty must be > 0, got {:g}", law.stiffness);
}

std::string fault_of(const NormalExponential& law) {
  if (positive(law.pressure) && positive(law.clearance)) return {};
  return fmt::format(
      "an exponential law needs a pressure > 0 and a clearance > 0, got {:g} and {:g}",
      law.pressure, law.clearance);
}

std::string fault_of(const NormalTable& law) {
  if (law.points.size() < 2) return "a table of pressures needs at least two points";
  if (law.points.front()[1] != 0) return "the first pressure of a table must be 0";
  if (!std::isfinite(law.points.front()[0]))
    return "a table of pressures has a value that is not finite";
  for (std::size_t i = 1; i < law.points.size(); ++i) {
    const std::array<double, 2>&a = law.points[i - 1], &b = law.points[i];
    if (!std::isfinite(b[0]) || !std::isfinite(b[1]))
      return "a table of pressures has a value that is not finite";
    if (!(b[0] > a[0])) return fmt::format("overclosures must grow: {:g} follows {:g}", b[0], a[0]);
    if (!(b[1] >= a[1]))
      return fmt::format("pressures must not fall: {:g} follows {:g}", b[1], a[1]);
  }
  if (!(law.points.back()[1] > 0)) return "a table needs a pressure > 0";
  return {};
}

std::string fault_of(const Coulomb& law) {
  if (!not_negative(law.mu) || !positive(law.stiffness))
    return fmt::format("friction needs mu >= 0 and a stiffness > 0, got {:g} and {:g}", law.mu,
                       law.stiffness);
  if (!(law.cap > 0)) return fmt::format("the cap of friction must be > 0, got {:g}", law.cap);
  if (law.change && (!not_negative(law.change->kinetic) || !positive(law.change->scale)))
    return fmt::format(
        "a change of friction needs a coefficient >= 0 and a scale > 0, got {:g} and "
        "{:g}",
        law.change->kinetic, law.change->scale);
  return {};
}

std::string fault_of(const Tresca& law) {
  if (not_negative(law.limit_traction) && positive(law.stiffness)) return {};
  return fmt::format("friction needs a shear traction >= 0 and a stiffness > 0, got {:g} and {:g}",
                     law.limit_traction, law.stiffness);
}

std::string fault_of(const Rough& law) {
  if (!positive(law.stiffness))
    return fmt::format("friction needs a stiffness > 0, got {:g}", law.stiffness);
  if (law.coefficient > 0) return {};
  return fmt::format("rough points need a coefficient > 0, got {:g}", law.coefficient);
}

std::string fault_of(const Viscous& law) {
  if (not_negative(law.coefficient)) return {};
  return fmt::format("viscous damping needs a coefficient >= 0, got {:g}", law.coefficient);
}

std::string fault_of(const Restitution& law) {
  if (law.value >= 0 && law.value <= 1) return {};
  return fmt::format("a restitution lies between 0 and 1, got {:g}", law.value);
}

}  // namespace

std::string fault(const DampingLaw& law) {
  return std::visit([](const auto& l) { return fault_of(l); }, law);
}

std::string fault(const NormalLaw& law) {
  return std::visit([](const auto& l) { return fault_of(l); }, law);
}

std::string fault(const FrictionLaw& law) {
  return std::visit([](const auto& l) { return fault_of(l); }, law);
}

}  // namespace osculate::contact
