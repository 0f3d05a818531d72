#pragma once
// Inside of the public library; included by its sources only.
#include "osculate/contact/law/law.hpp"
#include "osculate/laws.hpp"

namespace osculate::embed {

/// A number of a law, or the points of one that is a table, by where it stands in model files below
/// `normal`, `friction` or `normal: damping`.
struct LawKey {
  std::string path, law, number;
  bool table = false;
};
/// Those of all laws of a kind, law by law.
[[nodiscard]] std::vector<LawKey> law_keys(const NormalLaw& kind);
[[nodiscard]] std::vector<LawKey> law_keys(const FrictionLaw& kind);
[[nodiscard]] std::vector<LawKey> law_keys(const DampingLaw& kind);

/// The laws of a host as those of the kernel. `may_part`: nothing holds the points.
[[nodiscard]] contact::NormalLaw law_of(const NormalLaw& law);
[[nodiscard]] contact::FrictionLaw law_of(const FrictionLaw& law, bool may_part);
[[nodiscard]] contact::DampingLaw law_of(const DampingLaw& law);

}  // namespace osculate::embed
