#pragma once
#include <variant>

#include "osculate/contact/law/coulomb.hpp"
#include "osculate/contact/law/damping.hpp"
#include "osculate/contact/law/law.hpp"
#include "osculate/contact/law/normal_exponential.hpp"
#include "osculate/contact/law/normal_penalty.hpp"
#include "osculate/contact/law/normal_table.hpp"
#include "osculate/contact/law/rough.hpp"
#include "osculate/contact/law/tresca.hpp"

namespace osculate::contact {

// The laws there are.
struct NormalLaws : std::variant<NormalPenalty, NormalExponential, NormalTable> {
  using variant::variant;
};
struct FrictionLaws : std::variant<Coulomb, Tresca, Rough> {
  using variant::variant;
};
struct DampingLaws : std::variant<Viscous, Restitution> {
  using variant::variant;
};

}  // namespace osculate::contact
