#pragma once

namespace osculate::core {

/// Whether this processor has registers of 256 bits, and products fused with sums (x86-64-v3).
[[nodiscard]] inline bool has_avx2() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

/// Whether it has registers of 512 bits (x86-64-v4).
[[nodiscard]] inline bool has_avx512() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd");
#else
  return false;
#endif
}

}  // namespace osculate::core
