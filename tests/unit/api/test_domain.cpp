// The survey of a projection domain: table, JSON, ParaView file, page.
#include "osculate/api/domain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "osculate/core/error.hpp"
#include "sample_targets.hpp"

namespace osculate::api {
namespace {

using result::DomainPart;
using result::DomainReport;

deck::AnyTarget cube() { return projection::Target<3>(testing::box(Vec3(1, 1, 1))); }

deck::AnyTarget roof() {
  return projection::Target<2>(testing::polyline({Vec2(0, 0), Vec2(1, 1), Vec2(2, 0)}));
}

int cells_of_part(const result::DomainPicture& picture, DomainPart part) {
  int count = 0;
  for (const auto& parts : picture.parts)
    count += static_cast<int>(std::count(parts.begin(), parts.end(), part));
  return count;
}

TEST(Domain, CubeHasRidgesAndCones) {
  const DomainReport r = survey_domain(cube(), "cube");
  EXPECT_EQ(r.dimension, 3);
  EXPECT_EQ(r.ridges.count, 12);
  EXPECT_NEAR(r.ridges.largest, 90, 1e-12);
  EXPECT_EQ(r.valleys.count, 0);
  EXPECT_EQ(r.borders, 0);
  ASSERT_EQ(r.classes.size(), 1u);
  EXPECT_EQ(r.classes[0].first, "planar");
  EXPECT_TRUE(std::isinf(r.above.reach.value));
  EXPECT_EQ(r.below.reach.limit, "kink");
  EXPECT_GT(cells_of_part(r.picture, DomainPart::edge_above), 0);
  EXPECT_EQ(cells_of_part(r.picture, DomainPart::edge_below), 0);
  EXPECT_EQ(cells_of_part(r.picture, DomainPart::corner_above), 8 * 3 * 8 * 2);
  EXPECT_EQ(cells_of_part(r.picture, DomainPart::sheet_above), 0);  // without end
  EXPECT_TRUE(r.warnings.empty());
}

TEST(Domain, SheetsStandAtTheCentresOfCurvature) {
  const geometry::Cylinder hole{.radius = 2, .inside = true, .length = 3};
  const DomainReport r = survey_domain(projection::Target<3>(geometry::Surface(hole)), "hole");
  int checked = 0;
  for (std::size_t b = 0; b < r.picture.blocks.size(); ++b)
    for (std::size_t c = 0; c < r.picture.parts[b].size(); ++c) {
      if (r.picture.parts[b][c] != DomainPart::sheet_above) continue;
      const Index node = r.picture.blocks[b].cell(static_cast<Index>(c))[0];
      EXPECT_LT(r.picture.points[static_cast<std::size_t>(node)].head<2>().norm(), 1e-12);
      EXPECT_NEAR(r.picture.places[static_cast<std::size_t>(node)].bound_above, 2, 1e-12);
      ++checked;
    }
  EXPECT_GT(checked, 10);
  EXPECT_EQ(r.borders, 2);
}

TEST(Domain, PlaneCurveHasWedgesAsLines) {
  const DomainReport r = survey_domain(roof(), "roof");
  EXPECT_EQ(r.dimension, 2);
  EXPECT_EQ(r.ridges.count, 1);
  EXPECT_NEAR(r.ridges.largest, 90, 1e-12);
  EXPECT_EQ(r.ridges.at, Vec3(1, 1, 0));
  ASSERT_EQ(r.picture.blocks.size(), 1u);
  EXPECT_EQ(r.picture.blocks[0].type, cell::CellType::line2);
  EXPECT_EQ(cells_of_part(r.picture, DomainPart::edge_above), 3 * 10);  // corner and both ends
  EXPECT_EQ(cells_of_part(r.picture, DomainPart::edge_below), 2 * 10);
}

TEST(Domain, WarnsOfDistortedAndTwistedFacets) {
  projection::FacetMesh<3> mesh;
  mesh.nodes = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0),
                Vec3(0, 1, 0), Vec3(2, 0, 0), Vec3(1e-3, 2, 0)};
  mesh.facets = {{cell::CellType::quad4, {0, 1, 2, 3}},
                 {cell::CellType::tri3, {1, 2, 4}},  // the other way round
                 {cell::CellType::tri3, {3, 5, 0}}};
  const DomainReport r = survey_domain(projection::Target<3>(mesh), "twisted");
  ASSERT_EQ(r.warnings.size(), 2u);
  EXPECT_NE(r.warnings[0].find("facets of opposite orientation"), std::string::npos);
  EXPECT_NE(r.warnings[1].find("det a is close to zero"), std::string::npos);
}

TEST(Domain, TextAndJsonAgree) {
  const DomainReport r = survey_domain(cube(), "cube");
  const std::string text = to_text(r);
  EXPECT_NE(text.find("reach         0, kink at"), std::string::npos) << text;
  EXPECT_NE(text.find("reach         without end"), std::string::npos) << text;
  EXPECT_NE(text.find("convex edges 12 (largest angle 90 degrees at"), std::string::npos) << text;
  const nlohmann::json json = nlohmann::json::parse(to_json(r));
  EXPECT_EQ(json["below"]["reach"]["value"], 0);
  EXPECT_TRUE(json["above"]["reach"]["value"].is_null());
  EXPECT_EQ(json["convex"]["count"], 12);
  EXPECT_EQ(json["classes"]["planar"], r.places);
}

TEST(Domain, TellsWhatIsProvedOfTheReach) {
  const geometry::NurbsCurve ellipse{
      2,
      {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4},
      {Vec2(3, 0), Vec2(3, 0.5), Vec2(0, 0.5), Vec2(-3, 0.5), Vec2(-3, 0), Vec2(-3, -0.5),
       Vec2(0, -0.5), Vec2(3, -0.5), Vec2(3, 0)},
      {1, std::sqrt(0.5), 1, std::sqrt(0.5), 1, std::sqrt(0.5), 1, std::sqrt(0.5), 1}};
  const projection::Target<2> target = geometry::Curve(ellipse);
  const DomainReport r = survey_domain(target, "ellipse", {.tolerance = 0.02});
  EXPECT_LE(r.above.proved, 0.25 / 3);
  EXPECT_GE(r.above.proved, 0.98 * 0.25 / 3);
  EXPECT_EQ(r.above.unproved, "");
  EXPECT_TRUE(std::isinf(r.below.proved));
  const std::string text = to_text(r);
  EXPECT_NE(text.find("reach between 0.0816667 and 0.0833333 (within 2 %)"), std::string::npos)
      << text;
  EXPECT_NE(text.find("proved        reach is without end"), std::string::npos) << text;
  EXPECT_TRUE(nlohmann::json::parse(to_json(r))["below"]["proved"].is_null());
  const std::string corners = to_text(survey_domain(cube(), "cube"));
  EXPECT_NE(corners.find("reach is 0: an edge or corner opens to the other side"),
            std::string::npos)
      << corners;
  const geometry::Cone cone{.half_angle = 0.6, .from = 0.8, .to = 3};
  const std::string none =
      to_text(survey_domain(projection::Target<3>(geometry::Surface(cone)), "cone"));
  EXPECT_NE(none.find("no reach: not for this analytic shape"), std::string::npos) << none;
}

TEST(Domain, FilesAreWritten) {
  const DomainReport r = survey_domain(cube(), "cube");
  const std::string path = ::testing::TempDir() + "/domain.vtu";
  write_domain(path, r.picture);
  std::ifstream file(path);
  std::stringstream content;
  content << file.rdbuf();
  for (const char* name : {"PART", "PIECE", "K1", "GAUSS", "CLASS", "EVEN_BELOW", "SINE"})
    EXPECT_NE(content.str().find(std::string("Name=\"") + name + "\""), std::string::npos) << name;
  const std::string page = domain_html(r);
  EXPECT_NE(page.find("Projection domain of cube"), std::string::npos);
  EXPECT_NE(domain_html(survey_domain(roof(), "roof")).find("EVEN_ABOVE"), std::string::npos);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace osculate::api
