#pragma once

namespace osculate::testing {

/// Whether AddressSanitizer watches. A test takes it ten to twenty times as long, and it finds what
/// it looks for in the first samples: what another build sees in full, it may see a part of.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace osculate::testing
