#include "osculate/io/scene.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>
#include <regex>
#include <stdexcept>

namespace osculate::io {
namespace {

/// A square of the plane z = height, seen from above or (turned) from below.
SceneFace square(double height, bool turned = false) {
  SceneFace face{{Vec3(0, 0, height), Vec3(2, 0, height), Vec3(2, 1, height), Vec3(0, 1, height)},
                 height,
                 true};
  if (turned) std::swap(face.corners[1], face.corners[3]);
  return face;
}

Scene from_above(std::vector<SceneFace> faces) {
  Scene scene;
  scene.title = "a < b";
  scene.label = "height";
  scene.towards_eye = {0, 0, 1};
  scene.up = {0, 1, 0};
  scene.panels.push_back({"state & more", std::move(faces)});
  return scene;
}

std::vector<std::string> polygons(const std::string& svg) {
  std::vector<std::string> found;
  const std::regex pattern("<polygon points=\"([^\"]*)\" fill=\"([^\"]*)\"");
  for (std::sregex_iterator i(svg.begin(), svg.end(), pattern), end; i != end; ++i)
    found.push_back((*i)[1].str() + " " + (*i)[2].str());
  return found;
}

TEST(Scene, SeesTheXAxisToTheRightAndTheYAxisUpwards) {
  const auto found = polygons(scene_svg(from_above({square(0)})));
  ASSERT_EQ(found.size(), 1u);
  double x[4], y[4];
  ASSERT_EQ(std::sscanf(found[0].c_str(), "%lf,%lf %lf,%lf %lf,%lf %lf,%lf", x, y, x + 1, y + 1,
                        x + 2, y + 2, x + 3, y + 3),
            8);
  EXPECT_NEAR(x[1] - x[0], 340, 0.11);  // two units fill the panel
  EXPECT_NEAR(y[2] - y[1], -170, 0.11);
  EXPECT_NEAR(y[0], y[1], 1e-9);
}

TEST(Scene, NearFacesAreDrawnOverFarOnes) {
  const auto far_first = polygons(scene_svg(from_above({square(1), square(-3), square(0)})));
  const auto same = polygons(scene_svg(from_above({square(-3), square(0), square(1)})));
  ASSERT_EQ(far_first.size(), 3u);
  EXPECT_EQ(far_first, same);
}

TEST(Scene, LeavesOutFacesTurnedAwayAndThoseThatAreNoNumbers) {
  SceneFace broken = square(0);
  broken.corners[2].x() = std::numeric_limits<double>::quiet_NaN();
  SceneFace infinite = square(0);
  infinite.value = std::numeric_limits<double>::infinity();
  const std::string svg = scene_svg(from_above({square(0), square(1, true), broken, infinite}));
  EXPECT_EQ(polygons(svg).size(), 1u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Scene, TextsAreEscaped) {
  const std::string svg = scene_svg(from_above({square(0)}));
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
  EXPECT_NE(svg.find("state &amp; more"), std::string::npos);
}

TEST(Scene, AnEmptySceneIsAPictureToo) {
  const std::string svg = scene_svg(from_above({}));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(Scene, RefusesAViewAlongItsUpwardDirection) {
  Scene scene = from_above({square(0)});
  scene.up = {0, 0, 2};
  EXPECT_THROW(static_cast<void>(scene_svg(scene)), std::invalid_argument);
  scene = from_above({square(0)});
  scene.columns = 0;
  EXPECT_THROW(static_cast<void>(scene_svg(scene)), std::invalid_argument);
}

}  // namespace
}  // namespace osculate::io
