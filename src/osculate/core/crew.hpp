#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>

namespace osculate::core {

/// Threads for many short loops. Pieces of a loop are taken in turn by whoever is free, so that a
/// thread whose core another program has taken delays no more than the piece it is at, and one that
/// sleeps delays nothing. Between loops they spin for 50 microseconds, then sleep.
///
/// Requires   one thread at a time shares; pieces have nothing to do with each other
/// Errors     one of the exceptions of the pieces, after all of them
/// Tested by  tests/unit/core/test_crew.cpp
class Crew {
 public:
  /// The one that shares is among them; the others start with the first loop that they can help in.
  explicit Crew(int threads);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  [[nodiscard]] int threads() const { return threads_; }
  /// work(piece) for 0 ... pieces - 1; all are done when it returns.
  template <class Work>
  void share(std::size_t pieces, const Work& work) {
    share(pieces, {&work, [](const void* of, std::size_t piece) {
                     (*static_cast<const Work*>(of))(piece);
                   }});
  }
  /// work(begin, end) for consecutive runs of 0 ... count - 1 , none of them shorter than `least`
  /// unless it is all there is.
  template <class Work>
  void share_runs(std::size_t count, std::size_t least, const Work& work) {
    constexpr std::size_t each = 8;  // so that the last ones end at about the same time
    const std::size_t most = threads_ > 1 ? each * static_cast<std::size_t>(threads_) : 1;
    const std::size_t runs = std::clamp<std::size_t>(count / least, 1, most);
    share(runs, [&](std::size_t run) { work(count * run / runs, count * (run + 1) / runs); });
  }

 private:
  struct Work {
    const void* of = nullptr;
    void (*call)(const void*, std::size_t) = nullptr;
  };
  struct Impl;
  void share(std::size_t pieces, Work work);

  int threads_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osculate::core
