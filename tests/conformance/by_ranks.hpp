#pragma once
// Whole analyses by several processes, as threads: to the last bit what one does, whoever owns
// which node. Only factors round differently in parts; here the first one has those of all.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "osculate/deck/build.hpp"
#include "osculate/la/dealt_mumps.hpp"
#include "osculate/model/quantities.hpp"
#include "ranks.hpp"

namespace osculate::testing {

/// A thread among others that counts how often nodes are dealt out. With `by_chance` chance says
/// who owns which node, not METIS: no two nodes of a cell need have the same owner.
class DealtRanks final : public ThreadRanks {
 public:
  DealtRanks(Meeting& meeting, int rank, std::size_t nodes, bool by_chance)
      : ThreadRanks(meeting, rank), nodes_(nodes), by_chance_(by_chance) {}
  using ThreadRanks::spread;
  /// Nothing else that is told has a number for each node (of models of more than ten).
  void spread(std::span<int> values, int from) const override {
    constexpr unsigned seed = 7;
    if (values.size() != nodes_ || !by_chance_) ThreadRanks::spread(values, from);
    if (values.size() != nodes_) return;
    std::mt19937 random(seed + static_cast<unsigned>(dealt_++));
    if (!by_chance_) return;
    for (int& owner : values) owner = static_cast<int>(random() % static_cast<unsigned>(count()));
  }
  [[nodiscard]] int dealt() const { return dealt_; }

 private:
  std::size_t nodes_;
  bool by_chance_;
  mutable int dealt_ = 0;
};

/// What is to be the same.
struct Outcome {
  solve::Outcome outcome{};
  std::string message;
  std::vector<int> counts;      ///< of each increment: iterations, cutbacks, states of its points
  std::vector<double> numbers;  ///< residuals of the iterations, history, and the last state
};

/// The largest difference over the largest number.
[[nodiscard]] inline double difference(const Outcome& a, const Outcome& b) {
  if (a.numbers.size() != b.numbers.size()) return std::numeric_limits<double>::infinity();
  double worst = 0, size = 0;
  for (std::size_t i = 0; i < a.numbers.size(); ++i) {
    if (!(std::isfinite(a.numbers[i]) && std::isfinite(b.numbers[i])))
      return std::numeric_limits<double>::infinity();
    worst = std::max(worst, std::abs(a.numbers[i] - b.numbers[i]));
    size = std::max(size, std::abs(b.numbers[i]));
  }
  return worst > 0 ? worst / size : 0;
}

template <int Dim>
void append_state(const model::BasicState<Dim>& state, std::vector<double>& to) {
  to.insert(to.end(), state.u.begin(), state.u.end());
  for (const body::BasicRigidMotion<Dim>& body : state.rigid)
    for (int i = 0; i < body::motions<Dim>; ++i) to.push_back(body.component(i));
  to.insert(to.end(), state.memory.begin(), state.memory.end());
  to.insert(to.end(), state.constraint_forces.begin(), state.constraint_forces.end());
  if (state.rates.empty()) return;
  to.insert(to.end(), state.rates.velocity.begin(), state.rates.velocity.end());
  to.insert(to.end(), state.rates.contact.begin(), state.rates.contact.end());
}

template <int Dim>
Outcome analysed(const deck::BasicBuilt<Dim>& built, const core::Ranks* ranks) {
  model::AnalysisOptions options = built.options;
  options.ranks = ranks;
  options.linear_solver = [] {
    constexpr double any = std::numeric_limits<double>::infinity();
    return std::make_unique<la::DealtMumps>(la::MumpsOptions{.shared = {.fewest_entries = any}});
  };
  Outcome out;
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                           const model::Progress&, const solve::IncrementRecord* record) {
    for (const auto& request : built.history)
      out.numbers.push_back(model::history_value(system, built.model, state, request));
    if (!record) return true;
    out.counts.push_back(record->cutbacks);
    out.counts.push_back(static_cast<int>(record->iterations.size()));
    for (const solve::IterationRecord& iteration : record->iterations) {
      const solve::StateCounts& counts = iteration.counts;
      out.counts.insert(out.counts.end(),
                        {counts.open, counts.stick, counts.slipping, counts.closed});
      out.numbers.push_back(iteration.residual);
    }
    return true;
  };
  const auto result = model::run(built.model, options, observer);
  out.outcome = result.outcome;
  out.message = result.message;
  append_state<Dim>(result.state, out.numbers);
  return out;
}

/// The analysis by `count` processes, with METIS' owners and with others. `within`: 0 for every
/// bit. Nodes are dealt out `dealt` times or more.
template <int Dim>
void expect_the_same_by(int count, const deck::BasicBuilt<Dim>& built, const Outcome& alone,
                        double within = 0, int dealt = 1) {
  ASSERT_GT(built.model.reference.size(), 10U);
  for (const bool random : {false, true}) {
    SCOPED_TRACE(::testing::Message() << count << (random ? " at random" : " by METIS"));
    Meeting meeting(count);
    std::vector<Outcome> outcomes(static_cast<std::size_t>(count));
    std::vector<std::thread> threads;
    std::atomic<int> seen{0};
    for (int rank = 0; rank < count; ++rank)
      threads.emplace_back([&, rank] {
        const DealtRanks ranks(meeting, rank, built.model.reference.size(), random);
        outcomes[static_cast<std::size_t>(rank)] = analysed<Dim>(built, &ranks);
        seen += ranks.dealt();
      });
    for (std::thread& thread : threads) thread.join();
    EXPECT_GE(seen, dealt * count);
    for (const Outcome& of : outcomes) {
      EXPECT_EQ(of.outcome, alone.outcome);
      EXPECT_EQ(of.message, alone.message);
      EXPECT_EQ(of.counts, alone.counts);
      EXPECT_LE(difference(of, alone), within);
    }
  }
}

}  // namespace osculate::testing
