#pragma once
#include <cstdint>
#include <string_view>

namespace osculate {

/// Of the library that a program is linked with. The headers of one minor version (0.1.x) go with
/// every library of it.
///
/// Tested by  tests/unit/embed/test_state_bytes.cpp
[[nodiscard]] std::string_view library_version();

/// Of the bytes of histories, active sets and multipliers. A library reads its own alone.
inline constexpr std::uint32_t state_format = 1;

}  // namespace osculate
