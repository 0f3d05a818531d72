#include "osculate/la/blas_threads.hpp"

extern "C" {
void openblas_set_num_threads(int);
// What the library calls before a fork. Not every build of it has threads.
[[gnu::weak]] int blas_thread_shutdown_(void);
}

namespace osculate::la {

void end_idle_blas_threads() {
  openblas_set_num_threads(1);
  if (blas_thread_shutdown_ != nullptr) blas_thread_shutdown_();
}

}  // namespace osculate::la
