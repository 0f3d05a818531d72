#include "allocation_count.hpp"

#include <atomic>
#include <cstdlib>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer)
#define OSCULATE_OWN_MALLOC 0
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || !defined(__GLIBC__)
#define OSCULATE_OWN_MALLOC 0
#endif
#ifndef OSCULATE_OWN_MALLOC
#define OSCULATE_OWN_MALLOC 1
#endif

namespace {
std::atomic<std::size_t> calls{0};
}

#if OSCULATE_OWN_MALLOC
extern "C" void* __libc_malloc(std::size_t size);  // NOLINT: the C library's name
extern "C" void* malloc(std::size_t size) noexcept {
  ++calls;
  return __libc_malloc(size);
}
#endif

namespace osculate::testing {

std::size_t allocation_count() { return calls; }

}  // namespace osculate::testing
