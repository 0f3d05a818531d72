// How far the places of a tangent reach: not farther than is said, and far enough where a point's
// history counts.
#include "pattern_scene.hpp"

namespace osculate {
namespace {

using testing::Found;
using testing::plane;
using testing::Scene;
using testing::space;
using testing::trials;
using testing::with;

/// A block whose lower side has short facets, and a slave deep inside it, nearer to the block's
/// left side: its first node keeps the lower side, through which it came.
Scene<2> corner_of_a_block() {
  Scene<2> s;
  Facets line{FacetType::line2, {}};
  std::vector<Index> nodes;
  for (int k = 40; k >= 0; --k) nodes.push_back(s.node({0.05 * k, 0.0}));
  for (const double up : {2.0, 4.0}) nodes.push_back(s.node({0.0, up}));
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
    line.nodes.insert(line.nodes.end(), {nodes[k], nodes[k + 1]});
  s.contact.master.facets = {line};
  s.contact.slave.emplace();
  const Index a = s.node({0.325, 2.5}), b = s.node({1.325, 2.5});
  s.contact.slave->facets = {{FacetType::line2, {a, b}}};
  s.contact.normal = Penalty{100};
  return s;
}

std::vector<double> shifted(const Scene<2>& s, const std::vector<Index>& nodes, double along,
                            double up) {
  std::vector<double> x = s.x;
  for (const Index n : nodes) {
    x[static_cast<std::size_t>(2 * n)] += along;
    x[static_cast<std::size_t>(2 * n + 1)] += up;
  }
  return x;
}

TEST(Pattern, FollowsAPointAlongTheSideThatItCameThrough) {
  const Scene<2> s = corner_of_a_block();
  const Evaluator<2> evaluator(s.contact, s.x);
  const std::vector<Index> slave = s.contact.slave->facets[0].nodes;
  const std::vector<double> outside = shifted(s, slave, 0, -2.6);
  History<2> history = evaluator.initial_history(outside);
  const double reach = 0.15;
  const Pattern p = evaluator.pattern(s.x, history, {.motion = reach});
  Result<2> r;
  std::set<Index> facets;
  int outside_pattern = 0;
  for (double along = 0; along < reach; along += 0.048) {
    evaluator.evaluate(shifted(s, slave, along, 0), history, {}, r);
    const ContactPoint<2>& point = r.points()[0];
    EXPECT_LT(point.normal_traction, 0);
    facets.insert(point.facet);
    for (const Entry& e : r.tangent())
      if (e.value != 0 && !testing::has<2>(p, e.row, e.column)) ++outside_pattern;
    history = r.committed();
  }
  EXPECT_EQ(facets.size(), 4u);  // one after the other: each is beside that of the history
  EXPECT_EQ(outside_pattern, 0);
}

}  // namespace
}  // namespace osculate
