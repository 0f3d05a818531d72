// Tied points: what is kept, balance with moments, derivatives, for every kind of contact point.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "derivative_check.hpp"
#include "law_sample.hpp"
#include "mortar_sample.hpp"
#include "segment_sample.hpp"

namespace osculate::testing {
namespace {

using contact::Status;

constexpr double eps = 1000;

/// Ties what is near in the configuration of the sample.
template <int Dim>
ContactSample<Dim> tied(ContactSample<Dim> s, bool keep = true, double tolerance = 0.15) {
  s.pair.separation = pairing::Tied<Dim>{tolerance, keep};
  pairing::prepare<Dim>(s.pair, s.x);
  s.committed = pairing::initial_state<Dim>(s.pair, s.x);
  return s;
}

double moment(const Vec2& x, const Vec2& f) { return x.x() * f.y() - x.y() * f.x(); }
Vec3 moment(const Vec3& x, const Vec3& f) { return x.cross(f); }
Mat<2, 2> turned(double angle, const Vec2&) { return Eigen::Rotation2Dd(angle).toRotationMatrix(); }
Mat<3, 3> turned(double angle, const Vec3&) {
  return Eigen::AngleAxisd(angle, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
}

template <int Dim>
std::size_t ties_of(const ContactSample<Dim>& s) {
  return std::get<pairing::Tied<Dim>>(s.pair.separation).ties.size();
}

/// What holds for every pair that is tied with its gaps.
template <int Dim>
void expect_tie(const ContactSample<Dim>& s, const std::string& what) {
  SCOPED_TRACE(what);
  ASSERT_GT(ties_of(s), 0u);
  const Eigen::VectorXd start = flatten(s.x);
  EXPECT_LT(pair_residual(s, start).norm(), 1e-12 * eps);
  const Eigen::VectorXd v = start + 0.05 * random_direction(start.size(), 3);
  const Eigen::VectorXd r = pair_residual(s, v);
  ASSERT_GT(r.norm(), 1);
  // 1. forces and moments balance
  Vec<Dim> force = Vec<Dim>::Zero();
  auto turning = moment(Vec<Dim>(force), Vec<Dim>(force));
  for (Eigen::Index n = 0; n < v.size() / Dim; ++n) {
    const Vec<Dim> f = r.segment<Dim>(Dim * n), x = v.segment<Dim>(Dim * n);
    force += f;
    turning += moment(x, f);
  }
  EXPECT_LT(force.norm(), 1e-12 * r.norm());
  if constexpr (Dim == 2)
    EXPECT_LT(std::abs(turning), 1e-11 * r.norm());
  else
    EXPECT_LT(turning.norm(), 1e-11 * r.norm());
  // 2. a motion of both sides turns the forces
  const Mat<Dim, Dim> q = turned(2.1, Vec<Dim>(force));
  Eigen::VectorXd moved(v.size());
  for (Eigen::Index n = 0; n < v.size() / Dim; ++n)
    moved.segment<Dim>(Dim * n) = q * v.segment<Dim>(Dim * n) + Vec<Dim>::Constant(3);
  const Eigen::VectorXd after = pair_residual(s, moved);
  for (Eigen::Index n = 0; n < v.size() / Dim; ++n)
    EXPECT_LT((after.segment<Dim>(Dim * n) - q * r.segment<Dim>(Dim * n)).norm(), 1e-11 * r.norm());
  // 3. the tangent is symmetric, and the derivative
  const Eigen::MatrixXd k = pair_tangent(s, v);
  EXPECT_LT((k - k.transpose()).norm(), 1e-13 * k.norm());
  const Eigen::VectorXd d = random_direction(v.size(), 5);
  const DerivativeReport report =
      check_derivative([&](const Eigen::VectorXd& y) { return pair_residual(s, y); },
                       Eigen::VectorXd(k * d), v, d, 1e-2);
  EXPECT_TRUE(report.exact || std::abs(report.order - 2) < 0.15 || report.error < 1e-11)
      << "order " << report.order << " error " << report.error;
}

/// The same with a stiffness along the master of its own: a tenth, and ten times, that across it.
template <int Dim>
void expect_ties(const ContactSample<Dim>& s, const std::string& what) {
  expect_tie(s, what);
  for (const double along : {0.1 * eps, 10 * eps}) {
    ContactSample<Dim> other = s;
    other.pair.friction = rough(along);
    expect_tie(other, what + ", along it " + std::to_string(along));
  }
}

TEST(Tie, OfNodes) {
  for (const int nodes : {2, 3})
    for (const double depth : {0.0, 0.08, -0.08})
      expect_ties(tied(make_sample(
                      {.nodes_per_facet = nodes, .bend = nodes > 2 ? 0.02 : 0.0, .depth = depth})),
                  "line of " + std::to_string(nodes) + " depth " + std::to_string(depth));
}

TEST(Tie, OfNodesInSpace) {
  using cell::CellType;
  for (const CellType type : {CellType::tri3, CellType::tri6, CellType::quad4, CellType::quad9})
    for (const double depth : {0.0, 0.08, -0.08}) {
      SampleOptions3 o{.type = type, .bend = 0.03, .depth = depth};
      if (cell::is_triangle(type)) o.at = 2, o.xi = {0.3, 0.4};
      expect_ties(tied(make_sample3(o)), std::string(cell::info(type).name));
    }
}

TEST(Tie, OfGaussPoints) {
  const pairing::Sampling gauss{pairing::Sampling::Rule::gauss, 2, 1};
  expect_ties(tied(segment_sample({.slave_nodes = 3, .bend = 0.02, .sampling = gauss})), "plane");
  expect_ties(tied(segment_sample3({.bend = 0.01, .sampling = gauss})), "space");
}

TEST(Tie, OfMortar) {
  for (const int nodes : {2, 3})
    expect_ties(tied(make_mortar2({.slave_nodes = nodes, .bend = 0.02, .uneven = 0.2}), true, 0.3),
                "plane");
  for (const cell::CellType type : {cell::CellType::quad4, cell::CellType::tri6})
    expect_ties(tied(make_mortar3({.slave = type, .bend = 0.01}), true, 0.3), "space");
}

// A node of the slave lies over any number of facets then.
TEST(Tie, OfMortarOverAFineMaster) {
  expect_ties(tied(make_mortar2({.master_facets = 80}), true, 0.3), "plane");
  const ContactSample<3> space = tied(make_mortar3({.master_cells = 16}), true, 0.3);
  std::size_t most = 0;
  for (const auto& tie : std::get<pairing::Tied<3>>(space.pair.separation).ties)
    most = std::max(most, tie.nodes.size());
  ASSERT_GT(most, 100u);
  expect_ties(space, "space");
}

/// The whole slave moved by `by`.
template <int Dim>
Eigen::VectorXd lifted(const ContactSample<Dim>& s, const Vec<Dim>& by) {
  std::vector<Vec<Dim>> x = s.x;
  for (const Index n : s.pair.slave.nodes) x[static_cast<std::size_t>(n)] += by;
  return flatten(x);
}

// Pulled as stiff as pressed, along the surface as across it; uniform at every point.
TEST(Tie, CarriesTensionAndShear) {
  const ContactSample<3> mortar = tied(make_mortar3({.tilt = Vec3::Zero()}));
  const PairSample nodes = tied(make_sample({.depth = 0}));
  for (const double by : {0.02, -0.02}) {
    for (const auto& p : pair_evaluation(mortar, lifted(mortar, Vec3(0, 0, by))).points) {
      EXPECT_EQ(p.status, Status::stick);
      EXPECT_NEAR(std::abs(p.normal_traction), eps * std::abs(by), 1e-9);
      EXPECT_LT(p.shear_traction.norm(), 1e-9);
    }
    const Vec2 along(std::cos(0.3), std::sin(0.3));
    const auto pulled = pair_evaluation(nodes, lifted(nodes, turn(Vec2(by * along)))).points[0];
    EXPECT_NEAR(pulled.normal_traction, eps * by, 1e-9);
    EXPECT_NEAR(pulled.gap, by, 1e-12);
    const auto sheared = pair_evaluation(nodes, lifted(nodes, Vec2(by * along))).points[0];
    EXPECT_NEAR(sheared.shear_traction[0], eps * by, 1e-9);
    EXPECT_NEAR(sheared.normal_traction, 0, 1e-9);
  }
}

// Rough friction beside it: its penalty is the stiffness along the master, whatever pulls across
// it.
TEST(Tie, IsAsStiffAlongTheMasterAsItsFriction) {
  constexpr double along = 0.2 * eps, by = 0.02;
  PairSample s = tied(make_sample({.depth = 0}));
  s.pair.friction = rough(along);
  const Vec2 tangent(std::cos(0.3), std::sin(0.3));
  for (const double lift : {by, -by}) {
    const auto p =
        pair_evaluation(s, lifted(s, Vec2(by * tangent + lift * turn(tangent)))).points[0];
    EXPECT_NEAR(p.normal_traction, eps * lift, 1e-9);
    EXPECT_NEAR(p.shear_traction[0], along * by, 1e-9);
    EXPECT_EQ(p.status, Status::stick);
    EXPECT_NEAR(p.stored, 0.5 * (eps + along) * by * by, 1e-12);
  }
}

TEST(Tie, ClosesGapsOrKeepsThem) {
  const PairSample keep = tied(make_sample({.depth = -0.08}));
  EXPECT_NEAR(pair_evaluation(keep, flatten(keep.x)).points[0].normal_traction, 0, 1e-11);
  EXPECT_NEAR(pair_evaluation(keep, flatten(keep.x)).points[0].gap, 0.08, 1e-12);
  const PairSample close = tied(make_sample({.depth = -0.08}), false);
  EXPECT_NEAR(pair_evaluation(close, flatten(close.x)).points[0].normal_traction, 0.08 * eps, 1e-9);
}

TEST(Tie, LeavesFarPointsAlone) {
  PairSample s = tied(make_sample({.depth = -0.2}));
  EXPECT_EQ(ties_of(s), 0u);
  const auto point = pair_evaluation(s, lifted(s, Vec2(0, -0.5))).points[0];
  EXPECT_EQ(point.status, Status::open);
  EXPECT_FALSE(point.history.held);
  s = tied(make_sample({.depth = -0.2}), true, 0.25);
  EXPECT_EQ(ties_of(s), 1u);
  EXPECT_TRUE(s.committed.points[0].held);
  EXPECT_FALSE(s.committed.points[1].held);
}

// What is inside the master is let in by the share that counts; what is before it closes at once.
TEST(Tie, OverlapsAreLetInAndGapsClosed) {
  for (const double depth : {0.08, -0.08}) {
    PairSample s = make_sample({.depth = depth});
    s.pair.overlap = pairing::InitialOverlap::ramped;
    s = tied(s, false);
    for (const double relief : {1.0, 0.25, 0.0}) {
      pairing::ActiveSet<2> active_set;
      active_set.relief = relief;
      pairing::PairEvaluation<2> work;
      pairing::evaluate<2>(s.pair, s.x, s.committed, false, work, active_set);
      const double counts = depth > 0 ? (1 - relief) * -depth : -depth;
      EXPECT_NEAR(work.points[0].normal_traction, counts * eps, 1e-9) << depth << " " << relief;
    }
  }
}

// The gap is what is given, whatever the places are.
TEST(Tie, ClosesAClearance) {
  PairSample s = make_sample({.depth = 0.08});
  s.pair.overlap = pairing::InitialOverlap::given;
  s.pair.clearance = 0.03;
  s = tied(s, false);
  pairing::ActiveSet<2> active_set;
  active_set.relief = 1;
  pairing::PairEvaluation<2> work;
  pairing::evaluate<2>(s.pair, s.x, s.committed, false, work, active_set);
  EXPECT_NEAR(work.points[0].normal_traction, 0.03 * eps, 1e-9);
}

// Of any gap: those over the master that face it. The first point lies over it, the second does
// not.
TEST(Tie, OfAnyGapAreThoseOverTheMasterThatFaceIt) {
  PairSample s = make_sample({.angle = 0});
  const std::size_t first = s.x.size() - 2;
  const auto ties_with = [&](const Vec2& second, double tolerance) {
    s.x[first] = {3, 50};
    s.x[first + 1] = second;
    const PairSample t = tied(s, true, tolerance);
    return t.committed.points[0].held ? ties_of(t) : 0;
  };
  EXPECT_EQ(ties_with({-2, 50}, pairing::any_gap), 1u);  // looks down
  EXPECT_EQ(ties_with({-2, 50}, 100), 2u);
  EXPECT_EQ(ties_with({8, 50}, pairing::any_gap), 0u);  // looks up
  EXPECT_EQ(ties_with({8, 50}, 100), 2u);
}

// Shells that touch at the sum of their half thicknesses.
TEST(Tie, GapIsMeasuredFromTheOffset) {
  PairSample s = make_sample({.depth = -0.5});
  s.pair.offset = 0.45;
  s = tied(s, false);
  ASSERT_EQ(ties_of(s), 1u);
  EXPECT_NEAR(pair_evaluation(s, flatten(s.x)).points[0].normal_traction, 0.05 * eps, 1e-9);
  EXPECT_NEAR(pair_evaluation(s, flatten(s.x)).points[0].gap, 0.05, 1e-12);
}

}  // namespace
}  // namespace osculate::testing
