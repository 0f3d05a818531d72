#include <algorithm>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"

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
  const std::string text = edited(
      test_file("heat.yaml"), ", expansion: {alpha: [[0, 3e-5], [100, 4e-5]], reference: 20}", "");
  const Description d = parse_model(text, "model.yaml");
  const Built b = build(d, load_mesh(d));
  EXPECT_EQ(std::count(b.warnings.begin(), b.warnings.end(),
                       "temperatures have no effect: no material has an `expansion`"),
            1);
}

TEST(Temperatures, OfATableIncrease) {
  EXPECT_EQ(refusal(edited(test_file("heat.yaml"), "[100, 4e-5]", "[0, 4e-5]")),
            "model.yaml:6: materials.lead.expansion.alpha[1]: temperatures must increase");
}

}  // namespace
}  // namespace osculate::deck
