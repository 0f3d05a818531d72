#include "osculate/la/blas_at_start.hpp"

#include <array>
#include <cstddef>
#include <cstdlib>
#include <string_view>

#include "osculate/core/memory.hpp"
#include "osculate/core/processor.hpp"

extern "C" {
void openblas_set_num_threads(int);
void dsyrk_(const char* uplo, const char* trans, const int* n, const int* k, const double* alpha,
            const double* a, const int* lda, const double* beta, double* c, const int* ldc,
            std::size_t, std::size_t);
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

bool take_blas_buffer() {
  constexpr std::size_t buffers = std::size_t{256} << 20U;
  if (!core::can_allocate(buffers)) return false;
  constexpr int n = 2;  // the smallest product that is made in the buffer
  constexpr double one = 1, zero = 0;
  const std::array<double, 4> a{1, 0, 0, 1};
  std::array<double, 4> square{};
  dsyrk_("U", "N", &n, &n, &one, a.data(), &n, &zero, square.data(), &n, 1, 1);
  return true;
}

}  // namespace osculate::la
