#include "osculate/core/pieces.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace osculate::core {

void for_pieces(std::size_t count, std::size_t piece, int threads,
                const std::function<void(std::size_t, std::size_t)>& work) {
  const std::size_t pieces = (count + piece - 1) / piece;
  std::vector<std::exception_ptr> failures(pieces);
  std::atomic<std::size_t> next{0};
  const auto take = [&] {
    for (std::size_t p = next++; p < pieces; p = next++) try {
        work(p * piece, std::min(count, (p + 1) * piece));
      } catch (...) {
        failures[p] = std::current_exception();
      }
  };
  {
    std::vector<std::jthread> others;
    const std::size_t wanted = std::min(pieces, static_cast<std::size_t>(std::max(threads, 1)));
    try {
      for (std::size_t t = 1; t < wanted; ++t) others.emplace_back(take);
    } catch (const std::system_error&) {  // with fewer where the system gives no more
    }
    take();
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace osculate::core
