#pragma once
// Processes that work together, as threads of one process.
#include <algorithm>
#include <barrier>
#include <cstdlib>
#include <functional>
#include <span>
#include <thread>
#include <vector>

#include "osculate/core/ranks.hpp"

namespace osculate::testing {

/// What the threads have in common.
struct Meeting {
  explicit Meeting(int count)
      : doubles(static_cast<std::size_t>(count)), ints(doubles.size()), all_here(count) {}
  std::vector<std::span<const double>> doubles;
  std::vector<std::span<const int>> ints;
  std::barrier<> all_here;
};

/// One of these threads. Sums are made from the last one to the first, which is not the order of
/// MPI: what depends on it does so on the number of processes, too.
class ThreadRanks : public core::Ranks {
 public:
  ThreadRanks(Meeting& meeting, int rank) : meeting_(meeting), rank_(rank) {}
  using core::Ranks::largest;
  using core::Ranks::spread;
  using core::Ranks::sum;
  [[nodiscard]] int count() const override { return static_cast<int>(meeting_.doubles.size()); }
  [[nodiscard]] int rank() const override { return rank_; }
  void sum(std::span<double> values) const override {
    reduce(values, [](double a, double b) { return a + b; });
  }
  void largest(std::span<double> values) const override {
    reduce(values, [](double a, double b) { return std::max(a, b); });
  }
  void spread(std::span<double> values, int from) const override {
    take(meeting_.doubles, values, from);
  }
  void spread(std::span<int> values, int from) const override { take(meeting_.ints, values, from); }
  void gather(std::span<const int> mine, std::span<int> all) const override {
    meeting_.ints[me()] = mine;
    meeting_.all_here.arrive_and_wait();
    auto to = all.begin();
    for (const std::span<const int> of : meeting_.ints)
      if (rank_ == 0) to = std::copy(of.begin(), of.end(), to);
    meeting_.all_here.arrive_and_wait();
  }
  void exchange(std::span<const double> values, std::span<const int> to, std::span<double> received,
                std::span<const int> from) const override {
    meeting_.doubles[me()] = values;
    meeting_.ints[me()] = to;
    meeting_.all_here.arrive_and_wait();
    std::vector<double> taken;
    for (std::size_t r = 0; r < meeting_.doubles.size(); ++r) {
      std::size_t begin = 0;
      for (std::size_t p = 0; p < me(); ++p) begin += static_cast<std::size_t>(meeting_.ints[r][p]);
      if (meeting_.ints[r][me()] != from[r]) std::abort();
      const auto part = meeting_.doubles[r].subspan(begin, static_cast<std::size_t>(from[r]));
      taken.insert(taken.end(), part.begin(), part.end());
    }
    meeting_.all_here.arrive_and_wait();
    std::copy(taken.begin(), taken.end(), received.begin());
  }
  void finish() const override {}
  [[noreturn]] void end_all(int /*code*/) const override { std::abort(); }

 private:
  [[nodiscard]] std::size_t me() const { return static_cast<std::size_t>(rank_); }
  template <class Operation>
  void reduce(std::span<double> values, const Operation& operation) const {
    meeting_.doubles[me()] = values;
    meeting_.all_here.arrive_and_wait();
    std::vector<double> out(meeting_.doubles.back().begin(), meeting_.doubles.back().end());
    for (std::size_t r = meeting_.doubles.size() - 1; r-- > 0;)
      for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = operation(out[i], meeting_.doubles[r][i]);
    meeting_.all_here.arrive_and_wait();
    std::copy(out.begin(), out.end(), values.begin());
  }
  template <class Value>
  void take(std::vector<std::span<const Value>>& of_all, std::span<Value> values, int from) const {
    of_all[me()] = values;
    meeting_.all_here.arrive_and_wait();
    const std::span<const Value> source = of_all[static_cast<std::size_t>(from)];
    const std::vector<Value> copy(source.begin(), source.end());
    meeting_.all_here.arrive_and_wait();
    std::copy(copy.begin(), copy.end(), values.begin());
  }

  Meeting& meeting_;
  int rank_;
};

/// Calls work(ranks) on so many threads that work together.
inline void as_ranks(int count, const std::function<void(const core::Ranks&)>& work) {
  Meeting meeting(count);
  std::vector<std::thread> threads;
  for (int rank = 0; rank < count; ++rank)
    threads.emplace_back([&, rank] { work(ThreadRanks(meeting, rank)); });
  for (std::thread& thread : threads) thread.join();
}

}  // namespace osculate::testing
