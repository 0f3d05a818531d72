#include <algorithm>
#include <cstdio>
#include <fstream>

#include "system_test.hpp"

namespace osculate::deck {
namespace {

TEST(Temperatures, GoOnFromStepToStep) {
  const Description d = parse_model(test_file("heat.yaml"), "model.yaml");
  const Built b = build(d, load_mesh(d));
  const model::Model& m = b.model;
  EXPECT_EQ(m.initial_temperature, std::vector<double>(m.reference.size(), 20.0));
  EXPECT_EQ(m.sections[0].section.expansion.table.size(), 2U);
  EXPECT_EQ(m.sections[0].section.expansion.reference, 20);
  const auto most = [](const std::vector<double>& t) {
    return *std::max_element(t.begin(), t.end());
  };
  EXPECT_EQ(most(m.steps[0].temperature.at(0.5)), 25);  // the top waits, at nothing
  EXPECT_EQ(m.steps[0].temperature.at(1), m.steps[1].temperature.at(0));
  EXPECT_EQ(most(m.steps[1].temperature.at(0.5)), 55);
  EXPECT_EQ(
      *std::min_element(m.steps[1].temperature.start.begin(), m.steps[1].temperature.start.end()),
      30);
}

TEST(Temperatures, WithoutEffectAreToldOf) {
  const std::string text =
      edited(edited(test_file("heat.yaml"),
                    ", expansion: {alpha: [[0, 3e-5], [100, 4e-5]], reference: 20}", ""),
             "E: [[0, 100], [100, 60]]", "E: 100");
  const Description d = parse_model(text, "model.yaml");
  const Built b = build(d, load_mesh(d));
  EXPECT_EQ(std::count(b.warnings.begin(), b.warnings.end(),
                       "temperatures have no effect: no material has an `expansion` or a table "
                       "over the temperature"),
            1);
}

TEST(Temperatures, OfATableIncrease) {
  EXPECT_EQ(refusal(edited(test_file("heat.yaml"), "[100, 4e-5]", "[0, 4e-5]")),
            "model.yaml:6: materials.lead.expansion.alpha[1]: temperatures must increase");
}

TEST(Temperatures, ExpandByDirections) {
  const std::string text = test_file("heat.yaml");
  const auto with = [&](const std::string& alpha) {
    return edited(text, "alpha: [[0, 3e-5], [100, 4e-5]]", "alpha: " + alpha);
  };
  const auto expansion = [&](const std::string& alpha) {
    return parse_model(with(alpha), "model.yaml").find_material("lead")->expansion;
  };
  const material::Expansion three = expansion("[1, 2, 3]");
  EXPECT_TRUE(three.table.empty());
  ASSERT_EQ(three.directions.size(), 1U);
  EXPECT_EQ(three.directions[0].coefficients, material::Strain3(1, 2, 3, 0, 0, 0));
  // 11, 22, 33, 12, 13, 23 of a tensor; here twice the shears, 12, 23, 13
  const material::Expansion six = expansion("[[0, 1, 2, 3, 4, 5, 6], [9, 1, 1, 1, 0, 0, 0]]");
  ASSERT_EQ(six.directions.size(), 2U);
  EXPECT_EQ(six.directions[0].coefficients, material::Strain3(1, 2, 3, 8, 12, 10));
  EXPECT_EQ(six.directions[1].temperature, 9);
  EXPECT_EQ(refusal(with("[1, 2, 3, 4]")),
            "model.yaml:6: materials.lead.expansion.alpha: expected 3 coefficients along the axes, "
            "or 6 of a tensor");
  EXPECT_EQ(refusal(with("[[0, 1], [2, 1, 2, 3]]")),
            "model.yaml:6: materials.lead.expansion.alpha[1]: expected a temperature and 1, 3 or 6 "
            "coefficients, in all rows the same");
  EXPECT_EQ(refusal(with("[[0, 1, 2, 3], [0, 1, 2, 3]]")),
            "model.yaml:6: materials.lead.expansion.alpha[1]: temperatures must increase");
  EXPECT_EQ(build_refusal(with("[1, 2, 3]")), "");
  EXPECT_NE(build_refusal(with("[1, 2, 3, 0, 1, 0]")).find("shears, as it expands, across it"),
            std::string::npos);
}

TEST(Temperatures, ElasticConstantsAreTablesOverThem) {
  const std::string text = test_file("heat.yaml");
  const Description d = parse_model(text, "model.yaml");
  const auto law = std::get<material::LinearElastic>(d.find_material("lead")->law.value);
  EXPECT_EQ(law.young, 100);
  EXPECT_EQ(law.young_over, (core::Table{{0, 100}, {100, 60}}));
  EXPECT_TRUE(law.poisson_over.empty());
  EXPECT_FALSE(material::linear(law));
  EXPECT_EQ(refusal(edited(text, "[100, 60]", "[0, 60]")),
            "model.yaml:6: materials.lead.linear_elastic.E[1]: temperatures must increase");
  EXPECT_EQ(refusal(edited(text, "[100, 60]", "[100, -60]")),
            "model.yaml:6: materials.lead.linear_elastic.E[1][1]: E = -60, but E > 0 is needed");
}

// Points know their temperature before the first step (which may look for vibrations), and then
// that of the moment; beside it stands the strain.
TEST(Temperatures, OfPointsAreRememberedFromTheStartOn) {
  Probe probe(test_file("heat.yaml"));  // one point a cell
  const std::vector<double>& at_first = probe.start.memory;
  ASSERT_EQ(at_first.size(), 16U);
  for (std::size_t cell = 0; cell < 8; ++cell) {
    EXPECT_EQ(at_first[2 * cell], 0.0);
    EXPECT_EQ(at_first[2 * cell + 1], 20.0);
  }
  (void)probe.at(probe.base, false, 1.0);
  const std::vector<double>& now = probe.system.material_memory();
  // the top of the upper row is at 50, all else at 30
  for (std::size_t cell = 0; cell < 8; ++cell)
    EXPECT_NEAR(now[2 * cell + 1], cell < 4 ? 30 : 40, 1e-12) << cell;
  EXPECT_NEAR(now[0], (3e-5 + 0.3 * 1e-5) * 10, 1e-18);
}

TEST(Temperatures, AreNeededWhereConstantsDependOnThem) {
  EXPECT_EQ(
      build_refusal(
          "osculate: 1\nmesh: {generate: {b: {box: {x: [0, 1], y: [0, 1], elements: [1, 1]}}}}\n"
          "materials: {m: {linear_elastic: {E: [[0, 1], [1, 2]], nu: 0.3}}}\n"
          "sections: [{on: b, material: m, element: plane_strain}]\n"
          "steps: [{name: s, increments: 1, prescribe: [{on: b, ux: 0, uy: 0}]}]\n"),
      "model.yaml:3: materials.m.linear_elastic: material 'm' depends on the temperature, which "
      "is given nowhere: add `initial_temperature`");
}

/// A beam of an input file along x, its section 0.2 along y times 0.4 along z.
TEST(Temperatures, OfBeamsAreThoseOfWhatTheyAreExpandedTo) {
  const std::string path = ::testing::TempDir() + "osculate_thin.inp";
  std::ofstream(path)
      << "*NODE, NSET=N\n1, 0, 0, 0\n2, 1, 0, 0\n*ELEMENT, TYPE=B31, ELSET=E\n1, 1, 2\n"
         "*BEAM SECTION, ELSET=E, MATERIAL=m, SECTION=RECT\n0.2, 0.4\n0, 1, 0\n";
  const std::string text = edited(test_file("thin.yaml"), "thin.inp", path);
  const Description d = parse_model(text, "model.yaml");
  const Built3 b = build3(d, load_mesh(d));
  const model::Model3& m = b.model;
  ASSERT_EQ(m.reference.size(), 10U);
  const std::vector<double> after = m.steps[0].temperature.at(1);
  for (std::size_t n = 0; n < m.reference.size(); ++n) {
    EXPECT_EQ(m.initial_temperature[n], 20.0);
    const Vec3& x = m.reference[n];
    EXPECT_NEAR(after[n], 80 + 50 * x[2] - 7 * x[1], 1e-12) << n;
  }
  EXPECT_EQ(m.steps[1].temperature.at(1), std::vector<double>(10, 60.0));
  const std::vector<double> of_cells = m.steps[2].temperature.at(1);  // their nodes, named so
  for (std::size_t n = 0; n < m.reference.size(); ++n)
    EXPECT_NEAR(of_cells[n], 60 - 50 * m.reference[n][2], 1e-12) << n;
  EXPECT_EQ(build_refusal(edited(test_file("heat.yaml"), "{on: low, value: 30}",
                                 "{on: low, value: 30, gradient: 5}")),
            "model.yaml:18: steps[0].temperature[0]: gradients of the temperature are for nodes of "
            "shells and beams of an input file: 'low' has none");
  std::remove(path.c_str());
}

}  // namespace
}  // namespace osculate::deck
