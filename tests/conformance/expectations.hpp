#pragma once
// What every combination of the axes must do.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "by_ranks.hpp"
#include "osculate/api/tangent_check.hpp"
#include "osculate/deck/build.hpp"

namespace osculate::testing {

/// Order two or round-off in every part, unless the tangent is none by choice; contact must have
/// been there to check.
inline void expect_tangent(const api::TangentReport& report) {
  EXPECT_GT(report.counts.touching(), 0);
  for (const api::TangentRow& row : report.rows) {
    if (!row.expected) continue;
    EXPECT_FALSE(row.skipped) << row.part << ": " << row.note;
    EXPECT_TRUE(row.exact || std::abs(row.order - 2) < 0.15)
        << row.part << ": order " << row.order << ", error " << row.error;
  }
}

/// The increment by as many processes as OSCULATE_TEST_RANKS in the environment of the tests says.
/// Products with symmetric matrices are sums over the processes, whose last bits differ; where
/// matrices are unsymmetric (friction) there is no difference.
template <int Dim>
void expect_the_same_by_ranks(const deck::BasicBuilt<Dim>& built) {
  constexpr double last_bits = 1e-12;
  const char* const wanted = std::getenv("OSCULATE_TEST_RANKS");
  if (!wanted) return;
  expect_the_same_by<Dim>(std::atoi(wanted), built, analysed<Dim>(built, nullptr),
                          model::needs_unsymmetric(built.model) ? 0.0 : last_bits);
}

/// The first increment converges; its two columns of history are a force and its reaction.
template <int Dim>
void expect_increment(const deck::BasicBuilt<Dim>& built) {
  std::vector<double> row;
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                           const model::Progress&, const solve::IncrementRecord*) {
    row.clear();
    for (const auto& request : built.history)
      row.push_back(model::history_value(system, built.model, state, request));
    return true;
  };
  const auto result = model::run(built.model, built.options, observer);
  ASSERT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_GT(row[0], 1e-3);
  EXPECT_NEAR(row[0], -row[1], 1e-7 * row[0]);
  expect_the_same_by_ranks<Dim>(built);
}

/// A contact pair in its model, moved from where it was built.
template <int Dim>
struct Moved {
  const pairing::PairDefinition<Dim>& pair;
  std::vector<Vec<Dim>> start, x;

  /// The slave pressed by `depth`, and everything a little wavy.
  Moved(const model::BasicModel<Dim>& model, const Vec<Dim>& motion)
      : pair(model.pairs[0].definition), start(model.reference), x(model.reference) {
    for (const Index n : pair.slave.nodes) x[static_cast<std::size_t>(n)] += motion;
    for (std::size_t n = 0; n < x.size(); ++n)
      for (int i = 0; i < Dim; ++i)
        x[n][i] += 1e-3 * std::sin(3.7 * static_cast<double>(n) + 1.9 * i);
  }
  [[nodiscard]] pairing::PairState<Dim> initial() const {
    return pairing::initial_state<Dim>(pair, start);
  }
  /// Forces on all nodes; `next` (may be null) is what would be committed.
  [[nodiscard]] std::vector<Vec<Dim>> forces(const pairing::PairState<Dim>& committed,
                                             pairing::PairState<Dim>* next = nullptr) const {
    pairing::PairEvaluation<Dim> e;
    const auto multipliers = pairing::initial_multipliers<Dim>(pair, committed);
    const bool corrected = !pairing::is<pairing::ByPenalty>(pair.enforcement);
    pairing::evaluate<Dim>(pair, x, committed, false, e, {}, corrected ? &multipliers : nullptr);
    std::vector<Vec<Dim>> sum(x.size(), Vec<Dim>::Zero());
    for (const pairing::ContactBlock<Dim>& block : e.blocks)
      for (int k = 0; k < block.count; ++k)
        sum[static_cast<std::size_t>(block.nodes[static_cast<std::size_t>(k)])] +=
            block.force.template segment<Dim>(Dim * k);
    if (next) *next = pairing::commit<Dim>(e);
    return sum;
  }
};

template <int Dim>
double largest(const std::vector<Vec<Dim>>& forces) {
  double size = 0;
  for (const Vec<Dim>& f : forces) size = std::max(size, f.norm());
  return size;
}

/// A rotation about an axis that is none of the frame's.
template <int Dim>
Mat<Dim, Dim> some_rotation() {
  const double angle = 0.7;
  if constexpr (Dim == 2)
    return Mat<2, 2>{{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}};
  else
    return Eigen::AngleAxisd(angle, Vec3(1, -2, 3).normalized()).toRotationMatrix();
}

/// Into the master, or along it.
template <int Dim>
Vec<Dim> motion(double along, double into) {
  Vec<Dim> v = Vec<Dim>::Zero();
  v[0] = along;
  v[Dim - 1] = -into;
  return v;
}

/// Forces that a contact gives sum up to nothing, and turn with everything.
template <int Dim>
void expect_balance_and_indifference(const model::BasicModel<Dim>& model) {
  Moved<Dim> here(model, motion<Dim>(0.004, 0.03));
  const std::vector<Vec<Dim>> f = here.forces(here.initial());
  const double size = largest<Dim>(f);
  ASSERT_GT(size, 1e-3);
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const Vec<Dim>& one : f) sum += one;
  EXPECT_LT(sum.norm(), 1e-12 * size);
  const Mat<Dim, Dim> turned = some_rotation<Dim>();
  Moved<Dim> there = here;
  for (std::vector<Vec<Dim>>* const all : {&there.start, &there.x})
    for (Vec<Dim>& x : *all) x = turned * x + Vec<Dim>::Constant(5);
  const std::vector<Vec<Dim>> g = there.forces(there.initial());
  for (std::size_t n = 0; n < f.size(); ++n)
    EXPECT_LT((g[n] - turned * f[n]).norm(), 1e-10 * size) << "node " << n;
}

/// A way along the master while all points stick, and back: the forces are those of before.
template <int Dim>
void expect_reversibility(const model::BasicModel<Dim>& model) {
  Moved<Dim> here(model, motion<Dim>(0, 0.03));
  pairing::PairState<Dim> pressed, dragged;
  (void)here.forces(here.initial(), &pressed);
  const std::vector<Vec<Dim>> before = here.forces(pressed);
  Moved<Dim> away = here;
  for (const Index n : here.pair.slave.nodes)
    away.x[static_cast<std::size_t>(n)] += motion<Dim>(5e-4, 0);
  const std::vector<Vec<Dim>> there = away.forces(pressed, &dragged);
  for (const contact::PointHistory<Dim>& h : dragged.points) ASSERT_FALSE(h.slipping);
  const std::vector<Vec<Dim>> after = here.forces(dragged);
  double change = 0;
  for (std::size_t n = 0; n < after.size(); ++n) {
    change = std::max(change, (there[n] - before[n]).norm());
    EXPECT_LT((after[n] - before[n]).norm(), 1e-10 * largest<Dim>(before)) << "node " << n;
  }
  EXPECT_GT(change, 1e-4);
}

}  // namespace osculate::testing
