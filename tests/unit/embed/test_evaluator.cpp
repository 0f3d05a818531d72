// The evaluator by hand: plain arrays in, plain numbers out.
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "samples.hpp"

namespace osculate {
namespace {

using testing::Carrier;
using testing::Sample;

void expect_forces(std::span<const double> force, const std::vector<double>& expected) {
  ASSERT_EQ(force.size(), expected.size());
  for (std::size_t i = 0; i < force.size(); ++i) EXPECT_NEAR(force[i], expected[i], 1e-12) << i;
}

/// 0.1 inside at the penalty 100, without a tangent.
template <int Dim>
void expect_points_by_hand(const Result<Dim>& result, std::size_t count, double weight) {
  EXPECT_TRUE(result.tangent().empty());
  ASSERT_EQ(result.points().size(), count);
  for (const ContactPoint<Dim>& p : result.points()) {
    EXPECT_NEAR(p.gap, -0.1, 1e-15);
    EXPECT_NEAR(p.normal_traction, -10, 1e-12);
    EXPECT_NEAR(p.weight, weight, 1e-15);
    EXPECT_EQ(p.status, Status::stick);
    EXPECT_EQ(p.feature, Feature::face);
    EXPECT_NEAR(p.normal[Dim - 1], 1, 1e-15);
  }
}

TEST(Evaluator, ForcesInThePlaneByHand) {
  const Sample<2> s;
  Carrier<2> host(s);
  ASSERT_EQ(host.evaluator.slave_points().size(), 2u);
  EXPECT_EQ(host.evaluator.slave_points()[0].nodes, (std::vector<Index>{3}));
  // N = 100 * (-0.1) on an area of 1 each; both feet in the middle of a facet.
  expect_forces(host.at(s.x).force(), {0, 5, 0, 10, 0, 5, 0, -10, 0, -10});
  expect_points_by_hand(host.result, 2, 1.0);
  EXPECT_FALSE(host.result.branched());
  expect_forces(host.result.branch_force(), {0, 5, 0, 10, 0, 5, 0, -10, 0, -10});
  expect_forces(host.at(s.moved(0, 0.2)).force(), std::vector<double>(10, 0.0));
}

TEST(Evaluator, WeightsByHand) {
  Sample<2> s;
  s.x[6] = 3.5;  // the slave facet is 2.5 long: areas 1.25
  s.contact.area.thickness = 2;
  const auto slave_force = [&](Weight weight, double stretch) {
    Sample<2> copy = s;
    copy.contact.weight = weight;
    Carrier<2> host(copy);
    copy.x[6] += stretch;
    return host.at(copy.x).force()[7];
  };
  EXPECT_NEAR(slave_force(Weight::node, 0.25), -10, 1e-12);
  EXPECT_NEAR(slave_force(Weight::reference_area, 0.25), -25, 1e-12);
  EXPECT_NEAR(slave_force(Weight::current_area, 0.25), -27.5, 1e-12);
}

double sum(std::span<const double> force, std::size_t from, std::size_t to, std::size_t i) {
  double total = 0;
  for (std::size_t n = from; n < to; ++n) total += force[3 * n + i];
  return total;
}

/// N = 100 * (-0.1) on an area of 1/4 each; the feet at xi = +-1/2 give the corners of the first
/// facet 9/16, 3/16, 3/16 and 1/16 of a node's force, which add up to one node's force a corner.
TEST(Evaluator, ForcesInSpaceByHand) {
  const Sample<3> s;
  Carrier<3> host(s);
  const std::span<const double> f = host.at(s.x).force();
  for (const std::size_t n : {0u, 1u, 3u, 4u}) EXPECT_NEAR(f[3 * n + 2], 2.5, 1e-12);
  for (const std::size_t n : {2u, 5u}) EXPECT_NEAR(f[3 * n + 2], 0, 1e-12);
  for (std::size_t n = 6; n < 10; ++n) EXPECT_NEAR(f[3 * n + 2], -2.5, 1e-12);
  for (std::size_t n = 0; n < 10; ++n)
    for (const std::size_t i : {0u, 1u}) EXPECT_NEAR(f[3 * n + i], 0, 1e-12);
  expect_points_by_hand(host.result, 4, 0.25);
  for (const double force : host.at(s.moved(0, 0.2)).force()) EXPECT_EQ(force, 0.0);
}

/// The same pressure at Gauss points: the same forces on the slave, their sum on the master.
TEST(Evaluator, SampledAtGaussPoints) {
  Sample<3> s;
  s.contact.sampling = {Sampling::Rule::gauss, 2, 1};
  Carrier<3> host(s);
  ASSERT_EQ(host.evaluator.slave_points().size(), 4u);
  EXPECT_EQ(host.evaluator.slave_points()[0].nodes.size(), 4u);
  EXPECT_EQ(host.evaluator.slave_points()[0].facet, 0);
  const std::span<const double> f = host.at(s.x).force();
  for (std::size_t n = 6; n < 10; ++n) EXPECT_NEAR(f[3 * n + 2], -2.5, 1e-12);
  EXPECT_NEAR(sum(f, 0, 6, 2), 10, 1e-12);
}

/// Stick to 0.01, slip at 0.02 (limit 0.3 * 10), and back by 0.005 and far from there; what opens
/// forgets.
template <int Dim>
void expect_history_of_the_last_commit() {
  const Sample<Dim> s;
  Carrier<Dim> host(s);
  const auto shear = [&](double along) {
    const std::span<const double> f = host.at(s.moved(along, 0)).force();
    double total = 0;
    for (const Index n : s.slave_nodes) total += f[static_cast<std::size_t>(Dim * n)];
    return total / (Dim == 2 ? 2 : 1);  // areas: 1 + 1, or 1
  };
  const History<Dim> before = host.history;
  EXPECT_NEAR(shear(0.01), 2, 1e-12);
  EXPECT_NEAR(shear(0.02), 3, 1e-12);
  EXPECT_NEAR(shear(0.01), 2, 1e-12) << "evaluations leave no trace";
  EXPECT_NEAR(shear(0.02), 3, 1e-12);
  host.commit();
  EXPECT_NEAR(shear(0.02), 3, 1e-12);
  EXPECT_NEAR(shear(0.015), 2, 1e-12);
  host.commit();
  EXPECT_NEAR(shear(-0.3), -3, 1e-12);
  (void)host.at(s.moved(0, 1));
  host.commit();
  EXPECT_NEAR(shear(0.0), 0, 1e-12) << "a point that opens forgets";
  host.history = before;
  EXPECT_NEAR(shear(0.01), 2, 1e-12) << "an earlier history is an earlier time";
}

TEST(Evaluator, HistoryIsTheHosts) {
  expect_history_of_the_last_commit<2>();
  expect_history_of_the_last_commit<3>();
}

TEST(Evaluator, CopiesAndResultsOutliveIt) {
  const Sample<2> s;
  Result<2> result;
  History<2> history;
  {
    const Evaluator<2> first = s.make();
    const Evaluator<2> copy = first;
    history = first.initial_history(s.x);
    copy.evaluate(s.moved(0.02, 0), history, {}, result);
  }
  const History<2> next = result.committed();
  const Evaluator<2> again = s.make();  // of the same contact: the values are its own
  again.evaluate(s.moved(0.015, 0), next, {}, result);
  EXPECT_NEAR(result.force()[6], 2, 1e-12);
}

/// A point that slipped forward and would now slip back jumps over its sticking range: the next
/// iteration takes it for sticking, without a limit.
TEST(Evaluator, ActiveSetKeepsAPointFromJumping) {
  const Sample<2> s;
  Carrier<2> host(s);
  host.at(s.moved(0.05, 0), true);
  const ActiveSet<2> slid = host.result.next_active_set();
  EXPECT_EQ(slid.size(), 2u);
  EXPECT_FALSE(slid.predicts());
  Result<2> back;
  host.evaluator.evaluate(s.moved(-0.05, 0), host.history, slid, back);
  EXPECT_TRUE(back.branched());
  EXPECT_NEAR(back.force()[6], -3, 1e-12) << "the traction is that of sliding back";
  EXPECT_NEAR(back.branch_force()[6], -10, 1e-12) << "linearised in stick: 200 (-0.05)";
  EXPECT_FALSE(host.at(s.moved(-0.05, 0)).branched()) << "without an active set it jumps";
  EXPECT_TRUE(host.evaluator.predicted(host.history, s.x).predicts());
}

// ---- tangents -----------------------------------------------------------------------------------

/// All points are in the state, and the tangent is the derivative of the forces.
template <int Dim>
void expect_tangent(const Sample<Dim>& s, const std::vector<double>& at, Status status) {
  Carrier<Dim> host(s);
  for (const ContactPoint<Dim>& p : host.at(at).points()) ASSERT_EQ(p.status, status);
  const DerivativeCheck check = check_derivative<Dim>(host.evaluator, at, host.history, {},
                                                      host.evaluator.initial_multipliers(), 1e-3);
  EXPECT_TRUE(check.same_states);
  EXPECT_NEAR(check.order, 2.0, 0.1) << check.error;
}

/// Curved master of quadratic facets, in stick and in slip, with every weight and form.
TEST(Evaluator, TangentInThePlaneIsTheDerivative) {
  for (const double shift : {0.004, 0.2})
    for (const Weight weight : {Weight::node, Weight::reference_area, Weight::current_area})
      for (const ResidualForm form : {ResidualForm::surface, ResidualForm::full}) {
        Sample<2> s;
        s.contact.master.facets = {{FacetType::line3, {0, 1, 2, 1, 5, 6}}};
        s.x = {0, 0, 2, 0.1, 1, 0.2, 3.2, -0.1, 0.8, 0.05, 4, 0, 3.1, 0.15};
        s.contact.weight = weight;
        s.contact.residual = form;
        SCOPED_TRACE(::testing::Message()
                     << "shift " << shift << " weight " << static_cast<int>(weight));
        expect_tangent(s, s.moved(shift, -0.01), shift < 0.1 ? Status::stick : Status::slip);
      }
}

/// Curved master facets of every kind in the square (0..2)^2.
struct Master {
  FacetType type;
  std::vector<Index> nodes;
  std::vector<double> x;
};

std::vector<Master> curved_masters() {
  const std::vector<double> nine{0,   0, 0, 2,   0, 0.1, 2,   2, -0.1, 0,    2, 0.05, 1,   0,
                                 0.2, 2, 1, 0.1, 1, 2,   0.1, 0, 1,    0.15, 1, 1,    0.25};
  const std::vector<double> six{-1,  -1, 0,   4,   -1,  0.1, -1, 4,   -0.1,
                                1.5, -1, 0.2, 1.5, 1.5, 0.1, -1, 1.5, 0.15};
  const auto first = [](const std::vector<double>& x, std::ptrdiff_t nodes) {
    return std::vector<double>(x.begin(), x.begin() + 3 * nodes);
  };
  return {{FacetType::quad4, {0, 1, 2, 3}, first(nine, 4)},
          {FacetType::quad8, {0, 1, 2, 3, 4, 5, 6, 7}, first(nine, 8)},
          {FacetType::quad9, {0, 1, 2, 3, 4, 5, 6, 7, 8}, nine},
          {FacetType::tri3, {0, 1, 2}, first(six, 3)},
          {FacetType::tri6, {0, 1, 2, 3, 4, 5}, six}};
}

/// The master with a quad4 slave half a unit wide that has sunk in.
Sample<3> over(const Master& m) {
  Sample<3> s;
  s.contact.master.facets = {{m.type, m.nodes}};
  s.x = m.x;
  const auto first = static_cast<Index>(m.nodes.size());
  s.contact.slave->facets = {{FacetType::quad4, {first, first + 3, first + 2, first + 1}}};
  s.slave_nodes = {first, first + 1, first + 2, first + 3};
  for (const double v : {0.8, 0.7, -0.2, 1.3, 0.75, -0.22, 1.25, 1.2, -0.18, 0.7, 1.3, -0.21})
    s.x.push_back(v);
  return s;
}

TEST(Evaluator, TangentInSpaceIsTheDerivative) {
  for (const Master& m : curved_masters())
    for (const double shift : {0.0002, 0.2})
      for (const Weight weight : {Weight::node, Weight::reference_area, Weight::current_area})
        for (const ResidualForm form : {ResidualForm::surface, ResidualForm::full}) {
          Sample<3> s = over(m);
          s.contact.weight = weight;
          s.contact.residual = form;
          SCOPED_TRACE(::testing::Message() << "type " << static_cast<int>(m.type) << " shift "
                                            << shift << " weight " << static_cast<int>(weight));
          expect_tangent(s, s.moved(shift, 0), shift < 0.1 ? Status::stick : Status::slip);
        }
}

/// Points on the border between two states have no order, and a tangent that is wrong by a
/// thousandth part has order 0.
TEST(Evaluator, DerivativeCheckSeesStatesThatChange) {
  Sample<2> s;
  Carrier<2> host(s);
  const DerivativeCheck over_the_edge =
      check_derivative<2>(host.evaluator, s.moved(0, 0.0995), host.history, {}, {}, 1e-2);
  EXPECT_FALSE(over_the_edge.same_states);
  EXPECT_FALSE(over_the_edge.passed());
  EXPECT_FALSE((DerivativeCheck{.error = 1e-3, .order = 0.01}.passed()));
}

/// Rotating everything rotates the forces.
TEST(Evaluator, ForcesTurnWithTheBodies) {
  const Eigen::Matrix3d r =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const Master& m : curved_masters()) {
    const Sample<3> s = over(m);
    Sample<3> turned = s;
    const auto turn_all = [&](std::vector<double>& values) {
      for (std::size_t k = 0; k < values.size(); k += 3)
        Eigen::Map<Eigen::Vector3d>(values.data() + k) =
            (r * Eigen::Map<Eigen::Vector3d>(values.data() + k)).eval();
    };
    turn_all(turned.x);
    Carrier<3> here(s), there(turned);
    const std::span<const double> force = here.at(s.x).force();
    std::vector<double> f(force.begin(), force.end());
    turn_all(f);
    const std::span<const double> g = there.at(turned.x).force();
    for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f[i], g[i], 1e-11) << i;
  }
}

}  // namespace
}  // namespace osculate
