#include "osculate/core/crew.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <thread>
#include <vector>

namespace osculate::core {
namespace {

// Loops follow each other at once, after a while, and after the others have gone to sleep.
TEST(Crew, EveryPieceIsDoneOnceBeforeTheNextLoop) {
  for (const int threads : {1, 2, 5}) {
    Crew crew(threads);
    std::vector<int> done;
    for (int loop = 0; loop < 3000; ++loop) {
      done.assign(static_cast<std::size_t>(loop % 40), 0);
      crew.share(done.size(), [&](std::size_t piece) { done[piece] += loop; });
      for (const int times : done) ASSERT_EQ(times, loop);
      if (loop % 1000 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
}

TEST(Crew, RunsFollowEachOtherAndAreNotTooShort) {
  Crew crew(3);
  for (const std::size_t count : {0U, 1U, 9U, 10U, 19U, 20U, 239U, 10'007U}) {
    std::vector<std::size_t> run_of(count + 1);
    crew.share_runs(count, 10, [&](std::size_t begin, std::size_t end) {
      EXPECT_TRUE(end - begin >= std::min<std::size_t>(count, 10)) << count;
      for (std::size_t i = begin; i < end; ++i) run_of[i] += begin + 1;
    });
    for (std::size_t i = 0, begin = 0; i < count; ++i) {
      if (run_of[i] != begin + 1) begin = i;
      ASSERT_EQ(run_of[i], begin + 1) << count;
    }
  }
}

/// Pieces of the one that shares wait, at first, until another thread has taken one.
TEST(Crew, OneThatIsHeldUpDelaysOnlyWhatItIsAtAndIsLetAloneThen) {
  using Clock = std::chrono::steady_clock;
  Crew crew(2);
  const auto here = std::this_thread::get_id();
  const auto until = Clock::now() + std::chrono::seconds(20);
  std::atomic<int> of_the_other{0}, all{0};
  const auto loop = [&] {
    crew.share(100, [&, begun = Clock::now()](std::size_t) {
      ++all;
      if (std::this_thread::get_id() != here) {
        ++of_the_other;  // longer than it took to come
        std::this_thread::sleep_for(std::chrono::milliseconds(200) + 2 * (Clock::now() - begun));
      }
      while (of_the_other == 0 && Clock::now() < until) std::this_thread::yield();
    });
  };
  loop();
  EXPECT_GE(of_the_other, 1);
  EXPECT_LT(of_the_other, 10);
  const int before = of_the_other;
  for (int i = 0; i < 20; ++i) loop();
  EXPECT_EQ(of_the_other, before);
  EXPECT_EQ(all, 2100);
}

/// Who has helped for long is asked again after it was late for once. (Up to five times: on a
/// machine that does something else, too, it may be later than what it had gained.)
TEST(Crew, OneThatIsLateForOnceIsNotLetAlone) {
  using std::chrono::milliseconds;
  const auto here = std::this_thread::get_id();
  bool helps = false;
  for (int attempt = 0; attempt < 5 && !helps; ++attempt) {
    Crew crew(2);
    std::atomic<int> late{0}, of_the_other{0};
    crew.share(40, [](std::size_t) { std::this_thread::sleep_for(milliseconds(1)); });
    crew.share(2, [&, until = std::chrono::steady_clock::now() + milliseconds(1000)](std::size_t) {
      if (std::this_thread::get_id() != here) {
        ++late;
        std::this_thread::sleep_for(milliseconds(1));
      }
      while (late == 0 && std::chrono::steady_clock::now() < until) std::this_thread::yield();
    });
    crew.share(40, [&](std::size_t) {
      if (std::this_thread::get_id() != here) ++of_the_other;
      std::this_thread::sleep_for(milliseconds(1));
    });
    helps = late > 0 && of_the_other > 0;
  }
  EXPECT_TRUE(helps);
}

TEST(Crew, ThrowsWhatAPieceHasThrownAfterAllOfThem) {
  Crew crew(3);
  for (int loop = 0; loop < 100; ++loop) {
    std::atomic<int> done{0};
    EXPECT_THROW(crew.share(50,
                            [&](std::size_t piece) {
                              ++done;
                              if (piece % 20 == 7) throw std::bad_alloc();
                            }),
                 std::bad_alloc);
    EXPECT_EQ(done, 50);
    crew.share(50, [&](std::size_t) { ++done; });
    EXPECT_EQ(done, 100);
  }
}

// More threads than cores, and each of two crews is at work.
TEST(Crew, Several) {
  std::atomic<int> sum{0};
  const auto works = [&] {
    Crew crew(4);
    for (int loop = 0; loop < 500; ++loop) crew.share(7, [&](std::size_t) { ++sum; });
  };
  { const std::jthread one(works), two(works); }
  EXPECT_EQ(sum, 2 * 500 * 7);
}

}  // namespace
}  // namespace osculate::core
