#pragma once
// The lists of contact laws. A new law is a header of its own and one entry here.
#include <variant>

#include "osculate/contact/law/coulomb.hpp"
#include "osculate/contact/law/damping.hpp"
#include "osculate/contact/law/law.hpp"
#include "osculate/contact/law/normal_decaying.hpp"
#include "osculate/contact/law/normal_exponential.hpp"
#include "osculate/contact/law/normal_penalty.hpp"
#include "osculate/contact/law/normal_table.hpp"
#include "osculate/contact/law/normal_tensile.hpp"
#include "osculate/contact/law/rate_and_state.hpp"
#include "osculate/contact/law/rough.hpp"
#include "osculate/contact/law/tresca.hpp"
#include "osculate/contact/law/user_laws.hpp"
#include "osculate/contact/law/viscous_friction.hpp"

namespace osculate::contact {

// The laws there are. The first normal law is that of pairs that name none.
struct NormalLaws : std::variant<NormalPenalty, NormalExponential, NormalTable, NormalDecaying,
                                 NormalTensile, UserNormal> {
  using variant::variant;
};
struct FrictionLaws
    : std::variant<Coulomb, Tresca, Rough, RateAndState, ViscousFriction, UserFriction> {
  using variant::variant;
};
struct DampingLaws : std::variant<Viscous, Restitution> {
  using variant::variant;
};

}  // namespace osculate::contact
