// Rigid shapes made of several curves: what they are built to, and what is refused.
#include <algorithm>

#include "osculate/deck/build.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

const model::RigidBody& body_of(const Built& built, const std::string& name) {
  return *std::find_if(built.model.rigid.begin(), built.model.rigid.end(),
                       [&](const auto& body) { return body.name == name; });
}

Vec2 begin_of(const geometry::Curve& c) { return geometry::jet(c, geometry::lo(c)).r; }
Vec2 end_of(const geometry::Curve& c) { return geometry::jet(c, geometry::hi(c)).r; }

TEST(Composite, PartsFollowEachOther) {
  const Built built = build_text(test_file("channel.yaml"));
  const model::RigidBody& channel = body_of(built, "channel");
  ASSERT_EQ(channel.parts.size(), 6u);  // the last polyline has two segments
  EXPECT_FALSE(channel.closed);
  EXPECT_EQ(channel.nodes.size(), 3u);  // one frame carries all of them
  for (std::size_t i = 1; i < channel.parts.size(); ++i)
    EXPECT_LT((begin_of(channel.parts[i]) - end_of(channel.parts[i - 1])).norm(), 1e-14) << i;
  EXPECT_EQ(begin_of(channel.parts.front()), Vec2(-3, -1));
  EXPECT_EQ(end_of(channel.parts.back()), Vec2(8, -1));
  const pairing::Chain& chain = built.model.pairs[0].definition.master;
  ASSERT_EQ(chain.facets.size(), 6u);
  for (Index f = 0; f < 6; ++f) {
    EXPECT_EQ(chain.facets[static_cast<std::size_t>(f)].prev, f - 1);
    EXPECT_EQ(chain.facets[static_cast<std::size_t>(f)].next, f < 5 ? f + 1 : -1);
  }
}

TEST(Composite, ClosesWhereTheLastEndsAtTheFirst) {
  const Built built = build_text(test_file("channel.yaml"));
  const model::RigidBody& loop = body_of(built, "loop");
  ASSERT_EQ(loop.parts.size(), 4u);
  EXPECT_TRUE(loop.closed);
  EXPECT_LT((loop.reference - Vec2(11, 0.5)).norm(), 1e-14);  // the mean of its four corners
  const pairing::Chain& chain = built.model.pairs[1].definition.master;
  EXPECT_EQ(chain.facets[3].next, 0);
  EXPECT_EQ(chain.facets[0].prev, 3);
}

TEST(Composite, FlippedTravelsBackwards) {
  const std::string text =
      edited(test_file("channel.yaml"), "  loop:\n", "    flip: true\n  loop:\n");
  const model::RigidBody there = body_of(build_text(test_file("channel.yaml")), "channel"),
                         back = body_of(build_text(text), "channel");
  ASSERT_EQ(back.parts.size(), there.parts.size());
  for (std::size_t i = 0; i < back.parts.size(); ++i) {
    const geometry::Curve &a = back.parts[i], &b = there.parts[back.parts.size() - 1 - i];
    EXPECT_LT((begin_of(a) - end_of(b)).norm() + (end_of(a) - begin_of(b)).norm(), 1e-14);
    const Vec2 ta = geometry::jet(a, 0.5 * (geometry::lo(a) + geometry::hi(a))).r1,
               tb = geometry::jet(b, 0.5 * (geometry::lo(b) + geometry::hi(b))).r1;
    EXPECT_LT((ta + tb).norm(), 1e-14 * ta.norm());
  }
  EXPECT_LT((back.reference - there.reference).norm(), 1e-14);
}

TEST(Composite, Broken) {
  const auto refused = [](const std::string& from, const std::string& to) {
    return refusal(edited(test_file("channel.yaml"), from, to));
  };
  EXPECT_EQ(refused("center: [-1, -2]", "center: [-1, -2.5]"),
            "model.yaml:10: rigid.channel.composite[1]: begins at (-1, -1.5), but the part before "
            "ends at (-1, -1)");
  EXPECT_EQ(refused("x: [1, 2, 3, 4, 5]", "x: [1, 2, 3, 3, 5]"),
            "model.yaml:15: rigid.channel.composite[3].function.x[3]: x must only increase or only "
            "decrease, got 3 after 3");
  EXPECT_EQ(refused("x: [1, 2, 3, 4, 5]", "x: [1, 2, 3, 5]"),
            "model.yaml:15: rigid.channel.composite[3].function.y: expected 4 values as in `x`, "
            "got 5");
  EXPECT_EQ(
      refused("[[-3, -1], [-1, -1]], closed: false", "[[-3, -1], [-1, -1], [0, 0]], closed: true"),
      "model.yaml:9: rigid.channel.composite[0]: a part has two ends: leave out `closed` and "
      "repeat the first point at the end");
  EXPECT_EQ(refused("from: 0, to: 90", "from: 0, to: 360"),
            "model.yaml:10: rigid.channel.composite[1]: a part needs two different ends");
  EXPECT_EQ(refused("- function: {x: [12, 11, 10], y: [0, -0.5, 0]}", "- circle: {}"),
            "model.yaml:20: rigid.loop.composite[1]: unknown key 'circle'; known: arc, polyline, "
            "nurbs, function");
}

}  // namespace
}  // namespace osculate::deck
