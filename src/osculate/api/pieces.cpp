#include "osculate/api/pieces.hpp"

#include <algorithm>
#include <exception>
#include <vector>

namespace osculate::api {

void for_pieces(std::size_t count, std::size_t piece, int threads,
                const std::function<void(std::size_t, std::size_t)>& work) {
  const auto pieces = static_cast<std::ptrdiff_t>((count + piece - 1) / piece);
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(pieces));
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
  for (std::ptrdiff_t p = 0; p < pieces; ++p) {
    const auto at = static_cast<std::size_t>(p);
    try {
      work(at * piece, std::min(count, (at + 1) * piece));
    } catch (...) {
      failures[at] = std::current_exception();
    }
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace osculate::api
