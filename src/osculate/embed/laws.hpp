#pragma once
// Inside of the public library; included by its sources only.
#include "osculate/contact/law/law.hpp"
#include "osculate/laws.hpp"

namespace osculate::embed {

/// The laws of a host as those of the kernel. `may_part`: nothing holds the points.
[[nodiscard]] contact::NormalLaw law_of(const NormalLaw& law);
[[nodiscard]] contact::FrictionLaw law_of(const FrictionLaw& law, bool may_part);
[[nodiscard]] contact::DampingLaw law_of(const DampingLaw& law);

}  // namespace osculate::embed
