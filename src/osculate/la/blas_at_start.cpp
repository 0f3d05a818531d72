#include "osculate/la/blas_at_start.hpp"

#include <cstdlib>
#include <string_view>

#include "osculate/core/processor.hpp"

extern "C" {
void openblas_set_num_threads(int);
// What the library calls before a fork. Not every build of it has threads.
[[gnu::weak]] int blas_thread_shutdown_(void);
// Not every build of it has routines for several processors.
[[gnu::weak]] char* openblas_get_corename(void);
[[gnu::weak]] void gotoblas_dynamic_init(void);
[[gnu::weak]] void gotoblas_dynamic_quit(void);
}

namespace osculate::la {
namespace {

/// The processor, among those that the library knows, that has the registers of this one; null:
/// none that is better than what it takes by itself.
const char* like_this_one() {
  if (core::has_avx512()) return "SkylakeX";
  if (core::has_avx2()) return "Haswell";
  return nullptr;
}

void take_routines_of_processor() {
  constexpr const char* choice = "OPENBLAS_CORETYPE";
  if (openblas_get_corename == nullptr || gotoblas_dynamic_init == nullptr ||
      gotoblas_dynamic_quit == nullptr || std::getenv(choice) != nullptr)
    return;
  const std::string_view taken = openblas_get_corename();
  const bool unknown = taken == "Prescott" || taken == "Barcelona";  // of Intel, of AMD
  const char* const better = like_this_one();
  if (!unknown || better == nullptr) return;
  (void)setenv(choice, better, 1);
  gotoblas_dynamic_quit();
  gotoblas_dynamic_init();
  (void)unsetenv(choice);
}

}  // namespace

void prepare_blas() {
  openblas_set_num_threads(1);
  if (blas_thread_shutdown_ != nullptr) blas_thread_shutdown_();
  take_routines_of_processor();
}

}  // namespace osculate::la
