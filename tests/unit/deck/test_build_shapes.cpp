// Analytic shapes of models in space: what they are built to, and what is refused.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "space_test.hpp"

namespace osculate::deck {
namespace {

const std::string wall = "{plane: {point: [0, 0, 3], normal: [0, 0, -2]}}";

TEST(BuildShapes, AModelOfAllAnalyticShapes) {
  const Built3 built = built_from(test_file("shapes.yaml"));
  EXPECT_EQ(built.warnings, std::vector<std::string>{});
  EXPECT_EQ(built.model.rigid.size(), 6u);
  for (const auto& body : built.model.rigid) EXPECT_EQ(geometry::key(*body.shape), body.name);
}

/// Every analytic shape of space, and the other side of it.
TEST(BuildShapes, AnalyticShapes) {
  const auto shape = [&](const std::string& text, bool flip) {
    std::string rigid = "{" + text + (flip ? ", flip: true}" : "}");
    const Built3 built = built_from(edited(test_file("solid.yaml"), wall, rigid));
    const auto& body = *std::find_if(built.model.rigid.begin(), built.model.rigid.end(),
                                     [](const auto& b) { return b.name == "wall"; });
    return std::pair(*body.shape, body.reference);
  };
  for (const bool flip : {false, true}) {
    const auto [ball, ball_at] = shape("sphere: {center: [1, 1, 6], radius: 3}", flip);
    const auto& sphere = std::get<geometry::Sphere>(ball);
    EXPECT_EQ(sphere.center, Vec3(1, 1, 6));
    EXPECT_EQ(sphere.radius, 3);
    EXPECT_EQ(sphere.inside, flip);
    EXPECT_EQ(ball_at, Vec3(1, 1, 6));

    const auto [roll, roll_at] = shape(
        "cylinder: {point: [1, 0, 6], axis: [0, 4, 0], radius: 3, length: 2, inside: true}", flip);
    const auto& cylinder = std::get<geometry::Cylinder>(roll);
    EXPECT_EQ(cylinder.axis, Vec3(0, 1, 0));
    EXPECT_EQ(cylinder.length, 2);
    EXPECT_EQ(cylinder.inside, !flip);
    EXPECT_EQ(roll_at, Vec3(1, 0, 6));

    const auto [tip, tip_at] =
        shape("cone: {apex: [1, 1, 3], axis: [0, 0, 1], half_angle: 60, from: 0.5, to: 4}", flip);
    const auto& cone = std::get<geometry::Cone>(tip);
    EXPECT_NEAR(cone.half_angle, std::acos(0.5), 1e-15);
    EXPECT_EQ(cone.from, 0.5);
    EXPECT_EQ(cone.to, 4);
    EXPECT_EQ(cone.inside, flip);
    EXPECT_EQ(tip_at, Vec3(1, 1, 3));

    const auto [ring, ring_at] =
        shape("torus: {center: [1, 1, 4], axis: [0, 0, 1], radius: 2, tube_radius: 0.5}", flip);
    EXPECT_EQ(std::get<geometry::Torus>(ring).tube_radius, 0.5);
    EXPECT_EQ(std::get<geometry::Torus>(ring).inside, flip);
    EXPECT_EQ(ring_at, Vec3(1, 1, 4));

    const auto [patch, patch_at] = shape(
        "nurbs_patch: {degree: [1, 2], knots: [[0, 0, 1, 1], [0, 0, 0, 1, 1, 1]], control: "
        "[[[0, 0, 3, 1], [0, 1, 4, 0.5], [0, 2, 3, 1]], [[2, 0, 3, 1], [2, 1, 4, 0.5], [2, "
        "2, 3, 1]]]}",
        flip);
    const auto& nurbs = std::get<geometry::NurbsPatch>(patch);
    EXPECT_EQ(nurbs.degree, (flip ? std::array{2, 1} : std::array{1, 2}));
    const geometry::SurfaceJet jet = nurbs.jet({0.5, 0.5});
    EXPECT_NEAR((jet.r - Vec3(1, 1, 3 + 1.0 / 3)).norm(), 0, 1e-15);
    EXPECT_NEAR(jet.r1[0].cross(jet.r1[1]).normalized().z(), flip ? -1 : 1, 1e-15);
    EXPECT_NEAR((patch_at - Vec3(1, 1, 10.0 / 3)).norm(), 0, 1e-15);
  }
}

TEST(BuildShapes, Broken) {
  expect_refusals(
      test_file("solid.yaml"),
      {
          {wall, "{cylinder: {point: [0, 0, 5], axis: [0, 0, 0], radius: 1}}",
           "model.yaml:19: rigid.wall.cylinder.axis: must not be zero"},
          {wall, "{sphere: {center: [0, 0, 5], radius: 0}}",
           "model.yaml:19: rigid.wall.sphere.radius: must be > 0, got 0"},
          {wall, "{cone: {apex: [0, 0, 5], axis: [0, 0, 1], half_angle: 90}}",
           "model.yaml:19: rigid.wall.cone.half_angle: must be > 0 and < 90, got 90"},
          {wall, "{cone: {apex: [0, 0, 5], axis: [0, 0, 1], half_angle: 9, from: 2, to: 1}}",
           "model.yaml:19: rigid.wall.cone.to: must be above `from` (2), got 1"},
          {wall, "{torus: {center: [0, 0, 5], axis: [0, 0, 1], radius: 1, tube_radius: 1}}",
           "model.yaml:19: rigid.wall.torus.tube_radius: must be below `radius` (1), got 1"},
          {wall,
           "{nurbs_patch: {degree: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1]], control: [[[0, 0, 3, "
           "1], [0, 2, 3, 1]], [[2, 0, 3, 1], [2, 2, 3, 1]]]}}",
           "model.yaml:19: rigid.wall.nurbs_patch.knots[1]: expected at least 4 values, got 3"},
          {wall,
           "{nurbs_patch: {degree: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 0]], control: [[[0, 0, "
           "3, 1], [0, 2, 3, 1]], [[2, 0, 3, 1], [2, 2, 3, 1]]]}}",
           "model.yaml:19: rigid.wall.nurbs_patch.knots[1]: knots: expected nondecreasing numbers, "
           "knot 3 = 0 follows 1"},
          {wall,
           "{nurbs_patch: {degree: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 0, 1, 1, 1]], control: "
           "[[[0, 0, 3, 1], [0, 1, 3, 1], [0, 2, 3, 1]], [[2, 0, 3, 1], [2, 2, 3, 1]]]}}",
           "model.yaml:19: rigid.wall.nurbs_patch.control[1]: expected 3 points as in the first "
           "row, got 2"},
          {wall,
           "{nurbs_patch: {degree: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]], control: [[[0, 0, "
           "3, 1], [0, 2, 3, 0]], [[2, 0, 3, 1], [2, 2, 3, 1]]]}}",
           "model.yaml:19: rigid.wall.nurbs_patch.control[0][1][3]: a weight must be > 0, got 0"},
      });
}

}  // namespace
}  // namespace osculate::deck
