#pragma once
#include "case.hpp"

namespace osculate::verification {

// One function per case folder.
[[nodiscard]] CaseResult critical_displacement(const CaseContext& context);
[[nodiscard]] CaseResult sliding_block(const CaseContext& context);

}  // namespace osculate::verification
