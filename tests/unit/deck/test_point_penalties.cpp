// `penalty: auto` on surfaces with cells or bodies that differ: each point has its own.
#include "graded.hpp"
#include "osculate/deck/build_contact_parts.hpp"
#include "osculate/pairing/automatic_stiffness.hpp"
#include "osculate/pairing/point_penalty.hpp"
#include "space_test.hpp"

namespace osculate::deck {
namespace {

using pairing::own_factor;
using pairing::RelativeStiffness;

TEST(OwnFactor, IsOneInTheMiddleAndContinuous) {
  for (const double ratio : {1.0 / 3, 0.5, 1.0, 2.9, 3.0}) EXPECT_EQ(own_factor(ratio), 1) << ratio;
  EXPECT_DOUBLE_EQ(own_factor(300), 100);
  EXPECT_DOUBLE_EQ(own_factor(1.0 / 300), 1.0 / 100);
  for (const double border : {3.0, 1.0 / 3})
    for (const double beside : {1 - 1e-9, 1 + 1e-9})
      EXPECT_NEAR(own_factor(border * beside), 1, 2e-9);
}

/// Height of cell k of the lowest row, and its stiffness.
double height_of(const Graded& g, int k) {
  return 0.5 * (graded_height(g, k) + graded_height(g, k + 1));
}
double stiffness_of(const Graded& g, int k) {
  return (k < Graded::columns / 2 ? g.modulus_left : 100) / height_of(g, k);
}

/// That behind node k.
double stiffness_at(const Graded& g, int k) {
  if (k == 0) return stiffness_of(g, 0);
  if (k == Graded::columns) return stiffness_of(g, k - 1);
  return 0.5 * (stiffness_of(g, k - 1) + stiffness_of(g, k));
}

double mean_stiffness(const Graded& g) {
  double sum = 0;
  for (int k = 0; k < Graded::columns; ++k) sum += stiffness_of(g, k);
  return sum / Graded::columns;
}

/// Where a point of the slave is, in columns.
double column_of(const Graded& g, const Built& built, std::size_t i) {
  const auto& slave = built.model.pairs.at(0).definition.slave;
  return column_at(g, pairing::position<2>(slave.points[i], built.model.reference).x());
}

void expect_own_penalties(const Graded& g) {
  const Built built = build_graded(g);
  const pairing::PairDefinition<2>& pair = built.model.pairs.at(0).definition;
  const double mean = mean_stiffness(g);
  EXPECT_NEAR(contact::penalty_of(pair.normal), 10 * mean, 1e-9 * mean);
  ASSERT_EQ(pair.relative_stiffness.size(), 41u);
  for (std::size_t i = 0; i < 41; ++i) {
    const auto k = static_cast<int>(std::lround(column_of(g, built, i)));
    const double own = own_factor(stiffness_at(g, k) / mean);
    EXPECT_NEAR(pairing::relative_stiffness(pair, i).normal, own, 1e-9 * own) << k;
    EXPECT_NEAR(pairing::point_penalty(pair, i).normal, 10 * own * mean, 1e-8 * own * mean);
  }
}

TEST(PointPenalties, FollowTheCellsBehindEachNode) { expect_own_penalties({}); }

TEST(PointPenalties, FollowTheBodiesBehindEachNode) {
  expect_own_penalties({.least = 1, .modulus_left = 1e5});
  expect_own_penalties({.least = 1, .modulus_left = 0.1});
  expect_own_penalties({.modulus_left = 1e-2});
}

/// The same shape, whatever is behind it: no factors, not even ones.
TEST(PointPenalties, OfEqualCellsAreThePairs) {
  for (const double least : {1.0, 0.5}) {
    const Built built = build_graded({.least = least});
    EXPECT_TRUE(built.model.pairs.at(0).definition.relative_stiffness.empty()) << least;
    EXPECT_TRUE(built.model.pairs.at(0).heights.empty()) << least;
  }
}

TEST(PointPenalties, OnlyOfWhatIsLeftToTheProgram) {
  const Built given = build_graded({.keys = ", normal: {penalty: 7}"});
  EXPECT_TRUE(given.model.pairs.at(0).definition.relative_stiffness.empty());
  EXPECT_EQ(given.model.pairs.at(0).heights.size(), 41u);
  const Built shear =
      build_graded({.keys = ", normal: {penalty: 7}, friction: {coulomb: {mu: 0.3}}"});
  const auto& d = shear.model.pairs.at(0).definition;
  const Built both = build_graded({.keys = ", friction: {coulomb: {mu: 0.3}}"});
  ASSERT_EQ(d.relative_stiffness.size(), 41u);
  for (std::size_t i = 0; i < 41; ++i) {
    const RelativeStiffness of_both = both.model.pairs.at(0).definition.relative_stiffness[i];
    EXPECT_EQ(d.relative_stiffness[i].normal, 1);
    EXPECT_EQ(d.relative_stiffness[i].shear, of_both.shear);
    EXPECT_NEAR(of_both.shear, of_both.normal, 1e-12 * of_both.normal);  // one Poisson's ratio
  }
  const Built law = build_graded({.keys = ", normal: {table: [[0, 0], [1, 1]]}"});
  EXPECT_TRUE(law.model.pairs.at(0).definition.relative_stiffness.empty());
}

/// Points inside a facet have that of their facet alone.
TEST(PointPenalties, OfQuadraturePointsAreThoseOfTheirFacet) {
  const Graded g{.keys = ", sampling: {gauss: 2}"};
  const Built built = build_graded(g);
  const auto& d = built.model.pairs.at(0).definition;
  ASSERT_EQ(d.relative_stiffness.size(), 80u);
  for (std::size_t i = 0; i < 80; ++i) {
    const auto k = static_cast<int>(std::floor(column_of(g, built, i)));
    EXPECT_NEAR(d.relative_stiffness[i].normal, own_factor(stiffness_of(g, k) / mean_stiffness(g)),
                1e-9 * d.relative_stiffness[i].normal);
    EXPECT_NEAR(built.model.pairs.at(0).heights[i], height_of(g, k), 1e-12);
  }
}

/// A graded side against its mirror image: behind each point both are equally stiff.
TEST(PointPenalties, SeeTheNearestPlaceOfTheMaster) {
  for (const bool nodes : {true, false}) {
    const Graded g{.keys = nodes ? "" : ", sampling: {gauss: 2}", .rigid = false};
    const Description d = graded_description(g);
    mesh::Mesh m = graded_mesh(d, g);
    for (const Index n : m.find_set("low.bottom")->nodes) {
      Vec3& x = m.nodes[static_cast<std::size_t>(n)];
      x.y() = -graded_height(g, std::round(column_at(g, x.x())));
    }
    const Built built = build(d, m);
    const model::ContactPair& pair = built.model.pairs.at(0);
    const double eps = contact::penalty_of(pair.definition.normal);
    ASSERT_FALSE(pair.definition.relative_stiffness.empty());
    for (std::size_t i = 0; i < pair.definition.slave.points.size(); ++i) {
      const double column = column_of(g, built, i);
      if (nodes && std::lround(column) % 40 == 0) continue;  // the floor is longer
      const double own = nodes ? stiffness_at(g, static_cast<int>(std::lround(column)))
                               : stiffness_of(g, static_cast<int>(std::floor(column)));
      const double factor = own_factor(10 * own / 2 / eps);
      EXPECT_NEAR(pair.definition.relative_stiffness[i].normal, factor, 1e-9 * factor) << column;
      if (nodes) continue;
      EXPECT_NEAR(pair.heights[i], height_of(g, static_cast<int>(std::floor(column))), 1e-12);
    }
  }
}

/// Largest penetration, as a part of the height of the thinnest cell at its point.
double largest_share(const Graded& g, bool own) {
  Built built = build_graded(g);
  model::ContactPair& pair = built.model.pairs.at(0);
  if (!own) pair.definition.relative_stiffness.clear();
  double largest = 0;
  int open = 0;
  const model::AnalysisResult result =
      run_to_end(built, 1, [&](const model::System& system, const model::State&) {
        for (std::size_t i = 0; i < pair.heights.size(); ++i) {
          const auto& point = system.contact()[0].points[i];
          if (point.status == contact::Status::open) {
            ++open;
            continue;
          }
          largest = std::max(largest, -point.gap / pair.heights[i]);
        }
      });
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_LE(open, 2) << "the corner of the tall cells lifts off";
  return largest;
}

/// Cells of heights 1 : 1000 side by side: with one penalty the thinnest are passed through.
TEST(PointPenalties, KeepThePenetrationBelowItsTargetEverywhere) {
  for (const std::string keys : {"", ", sampling: {gauss: 2}", ", sampling: mortar"}) {
    const Graded g{.keys = keys, .slide = 0.1};
    EXPECT_LT(largest_share(g, true), model::penetration_target) << keys;
    EXPECT_GT(largest_share(g, false), 2 * model::penetration_target) << keys;
  }
}

Course course_of(const Graded& g) {
  const Built built = build_graded(g);
  EXPECT_FALSE(built.model.pairs.at(0).definition.relative_stiffness.empty());
  return course_of(built);
}

/// Millimetres and newtons, metres and newtons, centimetres and kilonewtons.
TEST(PointPenalties, UnitsDoNotMatter) {
  Graded g{.keys = ", friction: {coulomb: {mu: 0.3}}", .slide = 0.2};
  const Course reference = course_of(g);
  EXPECT_EQ(reference.iterations.size(), 5u);
  const double scales[][2] = {{1e-3, 1}, {0.1, 1e-3}};
  for (const auto& scale : scales) {
    g.length = scale[0];
    g.force = scale[1];
    EXPECT_EQ(course_of(g), reference) << g.length;
  }
}

/// Displacements, energies and stable steps of all increments.
struct Bits {
  std::vector<Eigen::VectorXd> u;
  std::vector<double> stable, energy, round_off;
  bool operator==(const Bits&) const = default;
};

/// All penalties times four (friction: a half): by factors of the points, or in the laws.
Bits bits_of(Built built, bool by_factors) {
  for (model::ContactPair& pair : built.model.pairs) {
    pairing::PairDefinition<2>& d = pair.definition;
    if (!contact::holds(d.normal)) continue;
    if (by_factors) {
      d.relative_stiffness.assign(d.slave.points.size(), {4, 0.5});
      continue;
    }
    d.normal = contact::penalty(4 * contact::penalty_of(d.normal));
    if (d.friction) d.friction = d.friction->stiffened(0.5);
  }
  Bits bits;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System& system, const model::State& state, const model::Progress&,
                           const solve::IncrementRecord* record) {
    bits.u.push_back(state.u);
    bits.energy.push_back(state.rates.energies.contact);
    if (record) bits.stable.push_back(record->time_steps.stable);
    solve::Evaluation e;
    if (!record || record->time_steps.count > 0) return true;
    system.evaluate(state, 1, false, e);
    bits.round_off.push_back(e.round_off);
    return true;
  };
  (void)model::run(built.model, built.options, observer);
  return bits;
}

/// Whatever a model does with a penalty, it does with that of its points.
TEST(PointPenalties, AModelOfStifferPointsIsAStifferModel) {
  std::vector<Built> models{build_text(test_file("explicit.yaml")),
                            build_text(test_file("dynamics.yaml"))};
  for (const std::string enforcement : {"penalty", "augmented_lagrange", "lagrange_multiplier"})
    models.push_back(
        build_graded({.keys = ", friction: {coulomb: {mu: 0.3}}, enforcement: " + enforcement,
                      .least = 1,
                      .slide = 0.1}));
  for (const Built& built : models) {
    const Bits stiffer = bits_of(built, false);
    EXPECT_GT(stiffer.u.size(), 1u) << built.model.title;
    EXPECT_TRUE(bits_of(built, true) == stiffer) << built.model.title;
  }
}

double stable_step(const Built& built) {
  model::AnalysisObserver observer;
  double stable = 0;
  observer.converged = [&](model::System&, const model::State&, const model::Progress&,
                           const solve::IncrementRecord* record) {
    if (record) stable = record->time_steps.stable;
    return !record;
  };
  (void)model::run(built.model, built.options, observer);
  return stable;
}

/// In explicit time integration the stiffest point counts.
TEST(PointPenalties, TheStableStepIsThatOfTheStiffestPoint) {
  Built built = build_text(test_file("explicit.yaml"));
  const double usual = stable_step(built);
  pairing::PairDefinition<2>& d = built.model.pairs.at(0).definition;
  d.relative_stiffness.assign(d.slave.points.size(), {});
  d.relative_stiffness[4].normal = 500;
  const double one = stable_step(built);
  d.relative_stiffness.assign(d.slave.points.size(), {500, 1});
  const double all = stable_step(built);
  EXPECT_GT(one, 0);
  EXPECT_LT(one, 0.2 * usual);
  EXPECT_GE(one, all);
}

TEST(PointPenalties, InSpaceTheyAreTheSame) {
  const std::string text = R"(osculate: 1
mesh:
  generate:
    low: {grid: {origin: [-1, -1, 0], u: [6, 0, 0], v: [0, 3, 0], elements: [3, 3]}}
    high: {box: {x: [0, 4], y: [0, 1], z: [0, 2], elements: [4, 1, 2]}}
materials: {a: {linear_elastic: {E: 100, nu: 0.25}}}
sections: [{on: high, material: a, element: solid}]
rigid: {floor: {set: low}}
contact: [{name: c, master: floor, slave: high.bottom, sampling: nodes}]
steps: [{name: s, increments: 1, prescribe: [{on: high.top, ux: 0, uy: 0, uz: -0.01}]}]
)";
  const Description description = parse_model(text, "model.yaml");
  mesh::Mesh m = load_mesh(description);
  const auto height = [](double x) { return std::pow(1e-3, x / 4); };
  for (const Index n : m.find_set("high")->nodes) {
    Vec3& x = m.nodes[static_cast<std::size_t>(n)];
    if (x.z() == 1) x.z() = height(x.x());
  }
  const Built3 built = build3(description, m);
  const auto& d = built.model.pairs.at(0).definition;
  ASSERT_EQ(d.relative_stiffness.size(), 10u);
  const auto cell = [&](double x) { return 100 / (0.5 * (height(x) + height(x + 1))); };
  const double mean = (cell(0) + cell(1) + cell(2) + cell(3)) / 4;
  for (std::size_t i = 0; i < 10; ++i) {
    const double x = built.model.reference[static_cast<std::size_t>(d.slave.nodes[i])].x();
    const double own = x == 0 ? cell(0) : x == 4 ? cell(3) : 0.5 * (cell(x - 1) + cell(x));
    EXPECT_NEAR(d.relative_stiffness[i].normal, own_factor(own / mean),
                1e-9 * d.relative_stiffness[i].normal)
        << x;
  }
}

}  // namespace
}  // namespace osculate::deck
