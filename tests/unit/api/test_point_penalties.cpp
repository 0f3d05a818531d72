// Penalties of single points in whole models: exact tangents, and what is reported.
#include <nlohmann/json.hpp>

#include "../deck/graded.hpp"
#include "osculate/api/tangent_check.hpp"
#include "osculate/result/penetration.hpp"
#include "osculate/result/summary.hpp"

namespace osculate::api {
namespace {

using deck::Graded;

/// Cells of heights 1 : 1000, on a rigid and on an elastic floor: every sampling, with and without
/// friction, and each way to meet the conditions.
TEST(PointPenaltiesOfAModel, HaveExactTangents) {
  for (const bool rigid : {true, false})
    for (const std::string sampling : {"nodes", "{gauss: 2}", "mortar"})
      for (const std::string friction : {"", ", friction: {coulomb: {mu: 0.3}}"})
        for (const std::string enforcement :
             {"penalty", "augmented_lagrange", "lagrange_multiplier"}) {
          if (sampling == "{gauss: 2}" && enforcement == "lagrange_multiplier") continue;
          const std::string keys =
              fmt::format(", sampling: {}{}, enforcement: {}", sampling, friction, enforcement);
          SCOPED_TRACE(keys + (rigid ? ", rigid" : ""));
          const deck::Built built =
              deck::build_graded({.keys = keys, .least = 1, .most = 1000, .rigid = rigid});
          EXPECT_EQ(built.model.pairs[0].definition.relative_stiffness.empty(), false);
          const TangentReport report = check_tangent(built.model, 1);
          EXPECT_GT(report.counts.touching(), 4);
          if (!friction.empty()) {
            EXPECT_GT(report.counts.slipping, 0);
          }
          for (const TangentRow& row : report.rows) {
            EXPECT_FALSE(row.skipped) << row.part << ": " << row.note;
            EXPECT_TRUE(row.passed()) << row.part << " order " << row.order;
          }
        }
}

/// Runs to the end and measures every increment.
result::Penetration reached(const deck::Built& built) {
  result::Penetration found;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System& system, const model::State&, const model::Progress&,
                           const solve::IncrementRecord* record) {
    if (record) result::measure_penetration(built.model.pairs[0], system.contact()[0], found);
    return true;
  };
  const model::AnalysisResult result = model::run(built.model, built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  return found;
}

/// One penalty for all: the thinnest cells are passed through, and the report says where, and which
/// penalty would do.
TEST(Penetration, IsHeldAgainstTheCellsBehindEachPoint) {
  deck::Built built = deck::build_graded({});
  EXPECT_EQ(result::missed_target(built.model, built.model.pairs[0], reached(built)), "");
  model::ContactPair& pair = built.model.pairs[0];
  pair.definition.relative_stiffness.clear();
  pair.automatic = false;  // or it would follow the pressure
  const result::Penetration soft = reached(built);
  EXPECT_GT(soft.share, model::penetration_target);
  const double x = built.model.reference[static_cast<std::size_t>(soft.node)].x();
  EXPECT_GT(x, 7.7);
  const std::string message = result::missed_target(built.model, pair, soft);
  EXPECT_NE(message.find("warning: contact 'c': penetration up to"), std::string::npos) << message;
  EXPECT_NE(message.find(fmt::format(" at {}", mesh::describe_node(built.model.mesh, soft.node))),
            std::string::npos)
      << message;
  const double penalty = contact::penalty_of(pair.definition.normal);
  EXPECT_NEAR(soft.needed, penalty * soft.share / model::penetration_target, 1e-9 * soft.needed);
  pair.definition.normal = contact::penalty(1.02 * soft.needed);
  EXPECT_LT(reached(built).share, model::penetration_target);
}

TEST(Penetration, WithoutCellsIsALength) {
  model::ContactPair pair;
  pair.definition.normal = contact::penalty(5);
  pairing::PairEvaluation<2> contact;
  contact.points.resize(2);
  contact.points[0].gap = -0.1;  // open: not in contact
  contact.points[1].gap = -0.02;
  contact.points[1].status = contact::Status::slip;
  result::Penetration found;
  result::measure_penetration(pair, contact, found);
  EXPECT_EQ(found.deepest, 0.02);
  EXPECT_EQ(found.share, 0);
  EXPECT_EQ(result::missed_target(model::Model{}, pair, found), "");
  pair.height = 0.5;
  result::measure_penetration(pair, contact, found);
  EXPECT_DOUBLE_EQ(found.share, 0.04);
  EXPECT_DOUBLE_EQ(found.needed, 20);
  pair.name = "c";
  EXPECT_EQ(result::missed_target(model::Model{}, pair, found),
            "warning: contact 'c': penetration up to 0.02, 0.04 of the height of the cells behind "
            "it (target 0.01); a penalty of 20 would reach the target");
}

TEST(PointPenaltiesOfAModel, AreReported) {
  const deck::Built built = deck::build_graded({.keys = ", friction: {coulomb: {mu: 0.3}}"});
  const auto& d = built.model.pairs[0].definition;
  const nlohmann::json json = result::penalty_json(d);
  const auto& points = json.at("penalty_of_points");
  EXPECT_EQ(json.at("penalty"), contact::penalty_of(d.normal));
  EXPECT_LT(points.at("smallest").get<double>(), 0.2 * points.at("mean").get<double>());
  EXPECT_LT(points.at("mean").get<double>(), points.at("largest").get<double>());
  EXPECT_NEAR(json.at("shear_penalty_of_points").at("largest").get<double>() * 2.5,
              points.at("largest").get<double>(), 1e-9 * points.at("largest").get<double>());
  std::string text;
  for (const result::ModelFact& fact : result::model_facts(built))
    if (fact.name == "c") text = fact.text;
  EXPECT_NE(text.find("(automatic), of its points "), std::string::npos) << text;
  EXPECT_NE(text.find(", of their friction "), std::string::npos) << text;
  const deck::Built even = deck::build_graded({.least = 1});
  for (const result::ModelFact& fact : result::model_facts(even))
    EXPECT_EQ(fact.text.find("of its points"), std::string::npos) << fact.text;
}

}  // namespace
}  // namespace osculate::api
