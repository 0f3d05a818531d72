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
  static constexpr double least_patience = 8, most_patience = 128;
  alignas(line) std::atomic<unsigned> gate{0};
  alignas(line) std::atomic<int> inside{0};
  alignas(line) std::atomic<std::size_t> next{0};
  alignas(line) std::size_t pieces = 0;
  Work work;
  double gained = 0;                ///< [s] by the others, less what was waited for them
  Clock::time_point alone_until{};  ///< nobody is asked to help before
  double patience = least_patience;
  std::atomic<bool> ends{false};
  std::atomic<int> asleep{0};
  std::mutex mutex;
  std::condition_variable awake;
  std::exception_ptr failure;
  std::vector<std::thread> others;

  void start(int count);
  void share();
  void serve();
  void open_gate();
  void wait_for_others(Clock::time_point begun, std::size_t own);
  void sleep(unsigned seen);
  std::size_t take_pieces();
  [[nodiscard]] bool changes_soon(unsigned seen) const;
};

/// How many it were.
std::size_t Crew::Impl::take_pieces() {
  std::size_t taken = 0;
  for (std::size_t piece = next++; piece < pieces; piece = next++, ++taken) try {
      work.call(work.of, piece);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  return taken;
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

/// `begun`: the loop, of which this thread has done `own` pieces. Where others have no core of
/// their own, who waits for them loses more than they do for it: they are let alone then, many
/// times as long as what was lost, but no longer than a second (the program may have been stopped).
/// A delay now and then, of a core that does something else for once, is made up for by what they
/// did before.
void Crew::Impl::wait_for_others(Clock::time_point begun, std::size_t own) {
  constexpr double reserve = 5e-3, longest = 1;
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  const auto waits = Clock::now();
  auto now = waits;
  for (int i = 0; inside != 0; ++i) {
    if (i >= at_once) std::this_thread::yield();
    now = Clock::now();
  }
  const double by_others =
      static_cast<double>(pieces - own) / static_cast<double>(std::max<std::size_t>(1, own));
  gained = std::min(reserve, gained + by_others * seconds(waits - begun) - seconds(now - waits));
  if (gained == reserve) patience = least_patience;
  if (gained >= 0) return;
  alone_until = now + std::chrono::duration_cast<Clock::duration>(
                          std::chrono::duration<double>(std::min(longest, -patience * gained)));
  patience = std::min(most_patience, 2 * patience);
  gained = 0;
}

void Crew::Impl::share() {
  const auto begun = Clock::now();
  if (begun < alone_until) {
    take_pieces();
    return;
  }
  open_gate();
  const std::size_t own = take_pieces();
  ++gate;
  wait_for_others(begun, own);
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
  if (threads_ == 1 || pieces < 2) {
    s.take_pieces();
  } else {
    s.start(threads_ - 1);
    s.share();
  }
  if (s.failure) std::rethrow_exception(std::exchange(s.failure, {}));
}

}  // namespace osculate::core
