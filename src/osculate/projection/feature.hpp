#pragma once
#include <cstdint>

namespace osculate::projection {

/// What a closest point lies on. Decided once per evaluation and stored; formulas never re-decide.
/// In 2D a curve's interior is `face`, its vertices are `corner`.
enum class Feature : std::uint8_t { none = 0, face = 1, edge = 2, corner = 3 };

}  // namespace osculate::projection
