#pragma once
#include <cstddef>

namespace osculate::testing {

/// Calls of malloc of the whole process so far; always 0 where a sanitizer has its own.
[[nodiscard]] std::size_t allocation_count();

}  // namespace osculate::testing
