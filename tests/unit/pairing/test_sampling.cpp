// Contact points on slave facets: rules, areas, tangents by order, balance.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>
#include <random>

#include "expect_derivative.hpp"
#include "osculate/core/error.hpp"
#include "segment_sample.hpp"

namespace osculate::testing {
namespace {

using contact::ResidualForm;
using contact::Status;
using pairing::Sampling;
using pairing::Weight;
using Rule = pairing::Sampling::Rule;

// ---- rules ------------------------------------------------------------------------------------

std::vector<double> areas_of(const pairing::SlaveSide<2>& side, const std::vector<Vec2>& x,
                             const pairing::AreaRule& rule = {}) {
  std::vector<double> areas;
  pairing::point_areas<2>(side, x, rule, areas, nullptr);
  return areas;
}

TEST(Sampling, IntegratesAlongALine) {
  const std::vector<Vec2> x{{0, 0}, {3, 4}};
  pairing::Chain chain;
  chain.facets.push_back(pairing::lagrange_facet(std::array<Index, 2>{0, 1}));
  for (const Sampling& s : {Sampling{Rule::gauss, 3, 1}, Sampling{Rule::lobatto, 4, 1},
                            Sampling{Rule::gauss, 3, 2}, Sampling{Rule::lobatto, 4, 5}}) {
    pairing::SlaveSide<2> side = pairing::make_slave_side(chain);
    pairing::sample(side, s);
    const std::vector<double> areas = areas_of(side, x, {2.0, false});
    double moment = 0;  // int t^5 over 0..1, degree 2 n - 1 (2 n - 3 for Lobatto)
    for (std::size_t i = 0; i < areas.size(); ++i)
      moment += areas[i] * std::pow(pairing::position<2>(side.points[i], x).norm() / 5, 5);
    EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 10, 1e-13);
    EXPECT_NEAR(moment, 10.0 / 6, 1e-13);
  }
}

TEST(Sampling, PartsShareTheirBorderPoints) {
  pairing::Chain chain;
  chain.facets.push_back(pairing::lagrange_facet(std::array<Index, 2>{0, 1}));
  pairing::SlaveSide<2> side = pairing::make_slave_side(chain);
  pairing::sample(side, {Rule::lobatto, 2, 2});
  ASSERT_EQ(side.points.size(), 3u);
  EXPECT_DOUBLE_EQ(side.points[1].weight, 1.0);
  EXPECT_DOUBLE_EQ(side.points[0].weight, 0.5);
  pairing::sample(side, {Rule::gauss, 5, 3});
  EXPECT_EQ(side.points.size(), 15u);
  pairing::sample(side, {});
  EXPECT_EQ(side.points.size(), 2u);
  EXPECT_TRUE(pairing::sampled_at_nodes(side));
}

/// Exact integral of x^a y^b over the facet of the reference cell.
double monomial(bool triangle, int a, int b) {
  const auto factorial = [](int n) { return std::tgamma(n + 1.0); };
  if (triangle) return factorial(a) * factorial(b) / factorial(a + b + 2);
  const auto side = [](int n) { return n % 2 ? 0.0 : 2.0 / (n + 1); };
  return side(a) * side(b);
}

TEST(Sampling, IntegratesOverReferenceFacets) {
  struct Case {
    cell::CellType type;
    Sampling sampling;
    int degree;
  };
  using cell::CellType;
  for (const Case& c :
       {Case{CellType::quad4, {Rule::gauss, 2, 1}, 3},
        Case{CellType::quad9, {Rule::lobatto, 4, 2}, 5},
        Case{CellType::tri3, {Rule::gauss, 1, 1}, 1}, Case{CellType::tri3, {Rule::gauss, 2, 1}, 3},
        Case{CellType::tri6, {Rule::gauss, 3, 1}, 5}, Case{CellType::tri3, {Rule::gauss, 4, 1}, 6},
        Case{CellType::tri3, {Rule::lobatto, 2, 1}, 1},
        Case{CellType::tri6, {Rule::lobatto, 3, 1}, 3},
        Case{CellType::tri3, {Rule::lobatto, 3, 3}, 3},
        Case{CellType::tri3, {Rule::gauss, 2, 2}, 3}}) {
    std::vector<Vec3> x;
    std::vector<Index> nodes(static_cast<std::size_t>(cell::info(c.type).nodes));
    std::iota(nodes.begin(), nodes.end(), 0);
    for (const Index k : nodes) {
      const Vec2 xi = cell::area_node(c.type, k);
      x.emplace_back(xi.x(), xi.y(), 0);
    }
    pairing::FacetSurface surface;
    surface.facets.push_back(pairing::surface_facet(c.type, nodes));
    pairing::SlaveSide<3> side = pairing::make_slave_side(surface);
    pairing::sample(side, c.sampling);
    std::vector<double> areas;
    pairing::point_areas<3>(side, x, {}, areas, nullptr);
    for (int a = 0; a <= c.degree; ++a)
      for (int b = 0; a + b <= c.degree; ++b) {
        double sum = 0;
        for (std::size_t i = 0; i < areas.size(); ++i) {
          const Vec3 p = pairing::position<3>(side.points[i], x);
          sum += areas[i] * std::pow(p.x(), a) * std::pow(p.y(), b);
        }
        EXPECT_NEAR(sum, monomial(cell::is_triangle(c.type), a, b), 1e-14) << a << ' ' << b;
      }
  }
}

TEST(Sampling, RefusesWhatDoesNotExist) {
  PairSample3 s = segment_sample3({.type = cell::CellType::tri3});
  EXPECT_THROW(pairing::sample(s.pair.slave, {Rule::lobatto, 4, 1}), core::GeometryError);
  pairing::SlaveSide<2> points =
      pairing::make_slave_side(pairing::Chain{}, std::array<Index, 2>{0, 1});
  EXPECT_THROW(pairing::sample(points, {Rule::gauss, 2, 1}), core::GeometryError);
  PairSample own = segment_sample({});
  own.pair.filter.distance = 3;
  EXPECT_THROW(pairing::prepare(own.pair, own.x), core::GeometryError);
}

// ---- tangents ---------------------------------------------------------------------------------

/// All probes in one branch; the error falls with the square of the step.
template <int Dim>
void expect_second_order(const ContactSample<Dim>& s, Status expected, double step,
                         const std::string& what) {
  SCOPED_TRACE(what);
  const Eigen::VectorXd v = flatten(s.x);
  const std::vector<Status> here = pair_status(s, v);
  ASSERT_GE(std::count(here.begin(), here.end(), expected), 2);
  expect_derivative([&](const Eigen::VectorXd& y) { return pair_residual(s, y); },
                    pair_tangent(s, v), [&](const Eigen::VectorXd& y) { return pair_facts(s, y); },
                    v, step, 2);
}

struct Branch {
  Status status;
  double mu, carried;
};
constexpr std::array<Branch, 3> branches{Branch{Status::stick, 10.0, 7.0},
                                         Branch{Status::slip, 0.01, 7.0},
                                         Branch{Status::slip, 0.01, -7.0}};

TEST(SegmentTangent, IsTheDerivativeOfTheResidual) {
  for (const int nodes : {2, 3})
    for (const double bend : {0.0, 0.02})
      for (const Sampling& sampling : {Sampling{Rule::gauss, 3, 1}, Sampling{Rule::lobatto, 2, 2}})
        for (const ResidualForm form : {ResidualForm::surface, ResidualForm::full})
          for (const Weight weight : {Weight::reference_area, Weight::current_area})
            for (const Branch& b : branches) {
              PairSample s = segment_sample(
                  {.slave_nodes = nodes, .bend = bend, .depth = 0.1, .sampling = sampling});
              s.pair.residual = form;
              s.pair.weight = weight;
              s.pair.friction = contact::coulomb(b.mu, 80.0);
              remember_all<2>(s, Vec2(0.3, 0.1), b.carried);
              expect_second_order(
                  s, b.status, 1e-3,
                  "nodes " + std::to_string(nodes) + " bend " + std::to_string(bend) + " points " +
                      std::to_string(sampling.points) + " mu " + std::to_string(b.mu));
            }
}

TEST(SegmentTangent, IsTheDerivativeOfTheResidualInSpace) {
  using cell::CellType;
  for (const CellType slave : {CellType::tri3, CellType::quad4, CellType::tri6, CellType::quad8})
    for (const CellType master : {CellType::quad4, CellType::tri6})
      for (const Sampling& sampling : {Sampling{Rule::gauss, 2, 1}, Sampling{Rule::lobatto, 3, 1}})
        for (const Branch& b : branches) {
          PairSample3 s = segment_sample3(
              {.type = slave, .master = master, .bend = 0.01, .depth = 0.08, .sampling = sampling});
          s.pair.residual = b.carried > 0 ? ResidualForm::full : ResidualForm::surface;
          s.pair.weight = b.carried > 0 ? Weight::current_area : Weight::reference_area;
          s.pair.friction = contact::coulomb(b.mu, 80.0);
          remember_all<3>(s, Vec3(0.03, 0.02, 0.01), b.carried);
          expect_second_order(s, b.status, 2e-4,
                              std::string(cell::info(slave).name) + " on " +
                                  std::string(cell::info(master).name) + " points " +
                                  std::to_string(sampling.points) + " mu " + std::to_string(b.mu));
        }
}

// ---- identities -------------------------------------------------------------------------------

TEST(SegmentForces, BalanceWithMoments) {
  PairSample3 s = segment_sample3({.bend = 0.01, .sampling = {Rule::gauss, 3, 1}});
  s.pair.residual = ResidualForm::full;
  s.pair.friction = contact::coulomb(0.3, 80.0);
  remember_all<3>(s, Vec3(0.03, 0.02, 0.01), 4.0);
  const Eigen::VectorXd r = pair_residual(s, flatten(s.x));
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double size = 0;
  for (std::size_t n = 0; n < s.x.size(); ++n) {
    const Vec3 f = r.segment<3>(3 * static_cast<Eigen::Index>(n));
    force += f;
    moment += s.x[n].cross(f);
    size += f.norm();
  }
  ASSERT_GT(size, 1);
  EXPECT_LT(force.norm(), 1e-13 * size);
  EXPECT_LT(moment.norm(), 1e-13 * size);
}

TEST(SegmentForces, OfAUniformGapAreThoseOfAUniformPressure) {
  // A flat slave at constant depth: the force on node k is p int N_k, for every rule and facet.
  using cell::CellType;
  for (const CellType type : {CellType::tri3, CellType::tri6, CellType::quad4, CellType::quad8}) {
    PairSample3 s = segment_sample3({.type = type, .sampling = {Rule::gauss, 3, 1}});
    const double depth = 0.05;
    for (const Index node : s.pair.slave.nodes) s.x[static_cast<std::size_t>(node)].z() = -depth;
    pairing::prepare(s.pair, s.x);
    s.committed = pairing::initial_state<3>(s.pair, s.x);
    const Eigen::VectorXd r = pair_residual(s, flatten(s.x));
    const pairing::SurfaceFacet& facet = s.pair.slave.boundary.facets[0];
    double total = 0;
    for (const Index node : s.pair.slave.nodes) total -= r[3 * node + 2];
    EXPECT_NEAR(total, contact::penalty_of(s.pair.normal) * depth * 1.78,
                1e-12 * 1000);      // |along x across|
    if (type == CellType::quad8) {  // corners of a parallelogram: -A / 12, middles A / 3
      EXPECT_NEAR(r[3 * facet.nodes[0] + 2], 1000 * depth * 1.78 / 12, 1e-11);
      EXPECT_NEAR(r[3 * facet.nodes[4] + 2], -1000 * depth * 1.78 / 3, 1e-11);
    }
  }
}

/// Places from 2 % inside to 4 % beyond the end of the master: a Gauss point has left it at once, a
/// point of the slave's border, and one that is tied, is held a little longer.
TEST(Sampling, GaussPointsEndWithTheMaster) {
  const auto contacts = [](Rule rule, bool may_part, double beyond) {
    const std::vector<Vec2> x{{0, 0}, {1, 0}, {2 + beyond, -0.01}, {beyond, -0.01}};
    PairSample s;
    s.x = x;
    s.pair.master.facets.push_back(pairing::lagrange_facet(std::array<Index, 2>{0, 1}));
    pairing::connect(s.pair.master);
    pairing::Chain slave;
    slave.facets.push_back(pairing::lagrange_facet(std::array<Index, 2>{2, 3}));
    pairing::connect(slave);
    s.pair.slave = pairing::make_slave_side(slave);
    pairing::sample(s.pair.slave, {rule, rule == Rule::gauss ? 1 : 3, 1});  // middle at 1 + beyond
    if (!may_part) s.pair.separation = pairing::NeverPart{};
    pairing::prepare(s.pair, s.x);
    const pairing::PairState<2> state = pairing::initial_state<2>(s.pair, s.x);
    const std::size_t middle = rule == Rule::gauss ? 0 : 1;
    return state.points[middle].active;
  };
  EXPECT_TRUE(contacts(Rule::gauss, true, -0.02));
  EXPECT_FALSE(contacts(Rule::gauss, true, 0.001));
  EXPECT_TRUE(contacts(Rule::gauss, false, 0.04));
  EXPECT_TRUE(contacts(Rule::lobatto, true, 0.04));
}

TEST(SegmentForces, OfAPassAreItsShare) {
  PairSample s = segment_sample({});
  s.committed = pairing::initial_state<2>(s.pair, s.x);
  const Eigen::VectorXd whole = pair_residual(s, flatten(s.x));
  s.pair.pass_factor = 0.5;
  EXPECT_LT((pair_residual(s, flatten(s.x)) - 0.5 * whole).norm(), 1e-15 * whole.norm());
}

}  // namespace
}  // namespace osculate::testing
