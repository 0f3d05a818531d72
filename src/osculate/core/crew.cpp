#include "osculate/core/crew.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace osculate::core {

/// The gate is odd while there is work. A thread that goes in counts itself first and looks at the
/// gate then; the one that shares shuts the gate first and looks at the count then. So either the
/// one sees that it is shut, or the other that somebody is inside. Who goes to sleep does so in the
/// same way: counted first. (A mutex and not the waiting of std::atomic, whose record of waiters is
/// one in each shared library: who wakes may be of another one than who sleeps.)
struct Crew::Impl {
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t line = 64;  // of the cache: what is written by turns is kept apart
  static constexpr int at_once = 1000;     // looks before others get the core
  alignas(line) std::atomic<unsigned> gate{0};
  alignas(line) std::atomic<int> inside{0};
  alignas(line) std::atomic<std::size_t> next{0};
  alignas(line) std::size_t pieces = 0;
  Work work;
  int alone = 0;         ///< loops that nobody is asked to help with
  int after_delay = 64;  ///< how many these are after the next delay
  std::atomic<bool> ends{false};
  std::atomic<int> asleep{0};
  std::mutex mutex;
  std::condition_variable awake;
  std::exception_ptr failure;
  std::vector<std::thread> others;

  void start(int count);
  void serve();
  void open_gate();
  void wait_for_others(Clock::time_point begun);
  void sleep(unsigned seen);
  void take_pieces();
  [[nodiscard]] bool changes_soon(unsigned seen) const;
};

void Crew::Impl::take_pieces() {
  for (std::size_t piece = next++; piece < pieces; piece = next++) try {
      work.call(work.of, piece);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
}

/// Whether the gate is another than `seen` before it is worth to sleep.
bool Crew::Impl::changes_soon(unsigned seen) const {
  constexpr std::chrono::microseconds patience{50};
  for (int i = 0; i < at_once; ++i)
    if (gate.load() != seen) return true;
  for (const auto until = Clock::now() + patience; Clock::now() < until;) {
    if (gate.load() != seen) return true;
    std::this_thread::yield();
  }
  return false;
}

void Crew::Impl::sleep(unsigned seen) {
  std::unique_lock lock(mutex);
  ++asleep;
  awake.wait(lock, [&] { return gate.load() != seen; });
  --asleep;
}

void Crew::Impl::open_gate() {
  ++gate;
  if (asleep == 0) return;
  { const std::lock_guard lock(mutex); }  // who has counted itself is waiting then
  awake.notify_all();
}

void Crew::Impl::serve() {
  for (unsigned seen = 0;;) {
    if (!changes_soon(seen)) sleep(seen);
    seen = gate.load();
    if (ends) return;
    if (seen % 2 == 0) continue;
    ++inside;
    if (gate.load() == seen) take_pieces();
    --inside;
  }
}

/// `begun`: the loop. Where the wait is longer than what there was to do, the others have no core
/// of their own: they are let alone for a while, twice as long each time.
void Crew::Impl::wait_for_others(Clock::time_point begun) {
  constexpr std::chrono::microseconds delay{300};
  constexpr int at_least = 64, at_most = 1 << 14;
  for (int i = 0; i < at_once; ++i)
    if (inside == 0) {
      after_delay = std::max(at_least, after_delay - 1);
      return;
    }
  const auto waits = Clock::now();
  while (inside != 0) std::this_thread::yield();
  if (Clock::now() - waits < std::max<Clock::duration>(delay, waits - begun)) return;
  alone = after_delay;
  after_delay = std::min(at_most, 2 * after_delay);
}

/// With fewer where the system gives no more.
void Crew::Impl::start(int count) {
  if (!others.empty()) return;
  others.reserve(static_cast<std::size_t>(count));
  try {
    for (int i = 0; i < count; ++i) others.emplace_back([this] { serve(); });
  } catch (const std::system_error&) {
    return;
  }
}

Crew::Crew(int threads) : threads_(std::max(1, threads)), impl_(std::make_unique<Impl>()) {}

Crew::~Crew() {
  impl_->ends = true;
  impl_->open_gate();
  for (std::thread& other : impl_->others) other.join();
}

void Crew::share(std::size_t pieces, Work work) {
  Impl& s = *impl_;
  s.work = work;
  s.pieces = pieces;
  s.next = 0;
  if (threads_ == 1 || pieces < 2 || s.alone > 0) {
    if (pieces > 1) s.alone = std::max(0, s.alone - 1);
    s.take_pieces();
  } else {
    s.start(threads_ - 1);
    const auto begun = Impl::Clock::now();
    s.open_gate();
    s.take_pieces();
    ++s.gate;
    s.wait_for_others(begun);
  }
  if (s.failure) std::rethrow_exception(std::exchange(s.failure, {}));
}

}  // namespace osculate::core
