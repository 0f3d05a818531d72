#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "history_checks.hpp"
#include "osculate/pairing/smoothing.hpp"
#include "pair_sample.hpp"
#include "ranks.hpp"

namespace osculate::testing {
namespace {

using contact::Status;

template <int Dim>
void expect_same_point(const pairing::PointResult<Dim>& a, const pairing::PointResult<Dim>& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.gap, b.gap);
  EXPECT_EQ(a.normal_traction, b.normal_traction);
  EXPECT_EQ(a.shear_traction, b.shear_traction);
  EXPECT_EQ(a.foot, b.foot);
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.weight, b.weight);
  EXPECT_EQ(a.stored, b.stored);
  EXPECT_EQ(a.slip_increment, b.slip_increment);
  EXPECT_EQ(a.branch.branch, b.branch.branch);
  EXPECT_EQ(a.branch.direction, b.branch.direction);
  expect_same_history<Dim>(a.history, b.history);
}

/// Blocks with a tangent, which are those that have the node `seen`. Of a smooth master's facets
/// those that do not have it may lack some points.
template <int Dim>
int expect_parts(const pairing::PairEvaluation<Dim>& here, const pairing::PairEvaluation<Dim>& all,
                 Index seen) {
  int tangents = 0;
  EXPECT_EQ(here.points.size(), all.points.size());
  for (std::size_t i = 0; i < all.points.size(); ++i)
    expect_same_point<Dim>(here.points[i], all.points[i]);
  EXPECT_EQ(here.blocks.size(), all.blocks.size());
  for (std::size_t i = 0; i < all.blocks.size(); ++i) {
    const pairing::ContactBlock<Dim>&a = here.blocks[i], &b = all.blocks[i];
    const auto end = b.nodes.begin() + b.count;
    const bool sees = std::find(b.nodes.begin(), end, seen) != end;
    if (!b.active() || (i >= all.points.size() && !sees)) continue;
    EXPECT_EQ(a.count, b.count);
    const Eigen::Index rows = Dim * b.count;
    EXPECT_EQ(a.force.head(rows), b.force.head(rows));
    EXPECT_EQ(a.has_tangent(), sees && b.has_tangent());
    if (!a.has_tangent()) continue;
    EXPECT_EQ(a.tangent.topLeftCorner(rows, rows), b.tangent.topLeftCorner(rows, rows));
    ++tangents;
  }
  return tangents;
}

/// Three processes look for the places of a third of the points each, and see one node.
template <int Dim>
void expect_the_bits_of_one(const ContactSample<Dim>& s) {
  const pairing::PairEvaluation<Dim> alone = pair_evaluation(s, flatten(s.x), true);
  int touching = 0, tangents = 0;
  for (const auto& point : alone.points) touching += point.status != Status::open ? 1 : 0;
  EXPECT_GT(touching, 0);
  for (std::size_t seen = 0; seen < s.x.size(); ++seen)
    as_ranks(3, [&](const core::Ranks& ranks) {
      std::vector<char> sees(s.x.size(), 0);
      sees[seen] = 1;
      core::Crew crew(2);
      pairing::PairEvaluation<Dim> here;
      for (int twice = 0; twice < 2; ++twice) {  // with the buffers of one that saw all of them
        const std::span<const char> of = twice == 0 ? std::span<const char>() : sees;
        pairing::evaluate<Dim>(s.pair, s.x, s.committed, true, here, {}, nullptr, {},
                               {&crew, &ranks, of});
      }
      const int found = expect_parts<Dim>(here, alone, static_cast<Index>(seen));
      if (ranks.rank() == 0) tangents += found;
    });
  EXPECT_GT(tangents, touching);
}

/// Dragged a little since the last increment, with friction.
template <int Dim>
ContactSample<Dim> dragged(ContactSample<Dim> s) {
  s.pair.friction = contact::coulomb(0.3, 80);
  s.committed = pairing::commit(pair_evaluation(s, flatten(s.x)));
  for (const auto& point : s.pair.slave.points)
    if (point.is_node()) s.x[static_cast<std::size_t>(point.nodes[0])][0] += 0.03;
  return s;
}

TEST(Workers, SeveralProcessesHaveTheBitsOfOneAndTheTangentsTheySee) {
  for (const double xi : {0.2, 0.999}) {
    SampleOptions plane;
    plane.bend = 0.1;
    plane.xi = xi;
    expect_the_bits_of_one<2>(make_sample(plane));
    expect_the_bits_of_one<2>(dragged<2>(make_sample(plane)));
    SampleOptions3 space;
    space.bend = 0.1;
    space.xi[0] = xi;
    expect_the_bits_of_one<3>(make_sample3(space));
    expect_the_bits_of_one<3>(dragged<3>(make_sample3(space)));
    PairSample3 smooth = make_sample3(space);
    pairing::smooth(smooth.pair.master, smooth.x, {pairing::SmoothingKind::hermite, 30});
    for (const auto form : {contact::ResidualForm::surface, contact::ResidualForm::full}) {
      smooth.pair.residual = form;
      expect_the_bits_of_one<3>(dragged<3>(smooth));
    }
  }
}

// What is far in front of a point is looked for by one of them, too.
TEST(Workers, SeveralProcessesLookFar) {
  PairSample3 s = make_sample3({.depth = -0.8});
  s.pair.filter.distance = 1;
  pairing::prepare<3>(s.pair, s.x);
  const auto gaps = [&](const pairing::Workers& workers) {
    pairing::PairEvaluation<3> e;
    pairing::ActiveSet<3> near;
    near.near = true;
    pairing::evaluate<3>(s.pair, s.x,
                         {std::vector<contact::PointHistory<3>>(s.committed.points.size()), {}, {}},
                         false, e, near, nullptr, {}, workers);
    std::vector<double> found;
    for (const auto& point : e.points) found.push_back(point.gap);
    pairing::look_far<3>(s.pair, s.x, s.committed, e, workers);
    for (const auto& point : e.points) found.push_back(point.gap);
    return found;
  };
  const std::vector<double> alone = gaps({});
  EXPECT_EQ(alone.front(), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(alone[s.pair.slave.points.size()], 0.8, 1e-12);
  for (const int count : {2, 3, 5})
    as_ranks(count, [&](const core::Ranks& ranks) {
      EXPECT_EQ(gaps({nullptr, &ranks, {}}), alone);
    });
}

}  // namespace
}  // namespace osculate::testing
