#pragma once
#include <utility>

namespace osculate::core {

/// Calls f(0), ..., f(N - 1) with constants: a loop that is always unrolled.
template <int N, class F>
inline void repeat(const F& f) {
  [&]<int... I>(std::integer_sequence<int, I...>) { (f(std::integral_constant<int, I>{}), ...); }
  (std::make_integer_sequence<int, N>{});
}

}  // namespace osculate::core
