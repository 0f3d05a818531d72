#include "osculate/api/contact_evaluator.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>

#include "derivative_check.hpp"
#include "osculate/core/error.hpp"

namespace osculate::api {
namespace {

using contact::Status;

/// What is said when the changed sample is made.
template <class Sample>
std::string refusal_of(const std::function<void(Sample&)>& change) {
  Sample s;
  change(s);
  try {
    (void)s.make();
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

template <class Sample>
void expect_other_coordinates_refused() {
  Sample s;
  auto contact = s.make();
  s.x.pop_back();
  EXPECT_THROW((void)contact.evaluate(s.x, false), core::InputError);
  s.x.push_back(std::numeric_limits<double>::infinity());
  EXPECT_THROW((void)contact.evaluate(s.x, true), core::InputError);
}

/// All points are in the branch, and the tangent is the derivative of the forces.
template <class Evaluator>
void expect_tangent(Evaluator& contact, const std::vector<double>& at, contact::Status status) {
  const auto n = static_cast<Eigen::Index>(at.size());
  const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(at.data(), n);
  Eigen::VectorXd d(n), df = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) d[i] = std::sin(3.0 * static_cast<double>(i) + 1);
  const auto force = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
    const auto r = contact.evaluate({y.data(), static_cast<std::size_t>(n)}, false);
    return Eigen::Map<const Eigen::VectorXd>(r.force.data(), n);
  };
  const auto here = contact.evaluate(at, true);
  for (const auto& p : here.points) ASSERT_EQ(p.status, status);
  for (const TangentEntry& e : here.tangent) df[e.row] += e.value * d[e.column];
  const auto report = testing::check_derivative(force, df, x, d, 1e-3);
  EXPECT_NEAR(report.order, 2.0, 0.1) << report.error;
}

// ---- the plane ---------------------------------------------------------------------------------

/// Master 0-1-2 along the x axis, normal up; slave facet 3 -> 4 above it, 0.1 inside.
struct Sample {
  ContactOptions options{.normal_penalty = 100, .friction = contact::coulomb(0.3, 200)};
  std::vector<Index> master{0, 1, 1, 2}, slave{3, 4};
  int master_nodes = 2, slave_nodes = 2;
  std::vector<double> x{0, 0, 2, 0, 4, 0, 3, -0.1, 1, -0.1};

  [[nodiscard]] ContactEvaluator make() const {
    return {options, {master_nodes, master}, {slave_nodes, slave}, x};
  }
  /// With both slave nodes moved.
  [[nodiscard]] std::vector<double> moved(double dx, double dy) const {
    std::vector<double> y = x;
    for (const std::size_t n : {3u, 4u}) {
      y[2 * n] += dx;
      y[2 * n + 1] += dy;
    }
    return y;
  }
};

void expect_forces(const std::vector<double>& force, const std::vector<double>& expected) {
  ASSERT_EQ(force.size(), expected.size());
  for (std::size_t i = 0; i < force.size(); ++i) EXPECT_NEAR(force[i], expected[i], 1e-12) << i;
}

/// 0.1 inside at the penalty 100, without a tangent.
template <int Dim>
void expect_points_by_hand(const BasicContactResult<Dim>& result, std::size_t count,
                           double weight) {
  EXPECT_TRUE(result.tangent.empty());
  ASSERT_EQ(result.points.size(), count);
  for (const pairing::PointResult<Dim>& p : result.points) {
    EXPECT_NEAR(p.gap, -0.1, 1e-15);
    EXPECT_NEAR(p.normal_traction, -10, 1e-12);
    EXPECT_NEAR(p.weight, weight, 1e-15);
    EXPECT_EQ(p.status, Status::stick);
  }
}

TEST(ContactEvaluator, ForcesByHand) {
  const Sample s;
  ContactEvaluator contact = s.make();
  EXPECT_EQ(std::vector<Index>(contact.slave_nodes().begin(), contact.slave_nodes().end()),
            (std::vector<Index>{3, 4}));
  // N = 100 * (-0.1) on an area of 1 each; both feet in the middle of a facet.
  const ContactResult result = contact.evaluate(s.x, false);
  expect_forces(result.force, {0, 5, 0, 10, 0, 5, 0, -10, 0, -10});
  expect_points_by_hand(result, 2, 1.0);
  expect_forces(contact.evaluate(s.moved(0, 0.2), false).force, std::vector<double>(10, 0.0));
}

TEST(ContactEvaluator, WeightsByHand) {
  Sample s;
  s.x[6] = 3.5;  // the slave facet is 2.5 long: areas 1.25
  s.options.area.thickness = 2;
  const auto slave_force = [&](pairing::Weight weight, double stretch) {
    Sample copy = s;
    copy.options.weight = weight;
    ContactEvaluator contact = copy.make();
    copy.x[6] += stretch;
    return contact.evaluate(copy.x, false).force[7];
  };
  EXPECT_NEAR(slave_force(pairing::Weight::node, 0.25), -10, 1e-12);
  EXPECT_NEAR(slave_force(pairing::Weight::reference_area, 0.25), -25, 1e-12);
  EXPECT_NEAR(slave_force(pairing::Weight::current_area, 0.25), -27.5, 1e-12);
}

/// Stick to 0.01, slip at 0.02 (limit 0.3 * 10), and back by 0.005 and far from there; what `open`
/// takes out of contact forgets.
void expect_history_of_the_last_commit(auto& contact, const auto& shear, double back,
                                       const auto& open) {
  EXPECT_NEAR(shear(0.01), 2, 1e-12);
  EXPECT_NEAR(shear(0.02), 3, 1e-12);
  EXPECT_NEAR(shear(0.01), 2, 1e-12) << "evaluations leave no trace";
  EXPECT_NEAR(shear(0.02), 3, 1e-12);
  contact.commit();
  EXPECT_NEAR(shear(0.02), 3, 1e-12);
  EXPECT_NEAR(shear(0.015), 2, 1e-12);
  contact.commit();
  EXPECT_NEAR(shear(-back), -3, 1e-12);
  (void)contact.evaluate(open, false);
  contact.commit();
  EXPECT_NEAR(shear(0.0), 0, 1e-12) << "a point that opens forgets";
}

TEST(ContactEvaluator, HistoryIsThatOfTheLastCommit) {
  const Sample s;
  ContactEvaluator contact = s.make();
  const auto shear = [&](double dx) { return contact.evaluate(s.moved(dx, 0), false).force[6]; };
  expect_history_of_the_last_commit(contact, shear, 1.0, s.moved(0, 1));
}

TEST(ContactEvaluator, SeveralLiveAtOnceAndMove) {
  const Sample s;
  ContactEvaluator first = s.make();
  ContactEvaluator second = s.make();
  (void)first.evaluate(s.moved(0.02, 0), false);
  first.commit();
  EXPECT_NEAR(second.evaluate(s.moved(0.01, 0), false).force[6], 2, 1e-12);
  ContactEvaluator third = std::move(first);
  EXPECT_NEAR(third.evaluate(s.moved(0.015, 0), false).force[6], 2, 1e-12);
}

TEST(ContactEvaluator, CommitBeforeAnyEvaluationChangesNothing) {
  const Sample s;
  ContactEvaluator contact = s.make();
  contact.commit();
  EXPECT_NEAR(contact.evaluate(s.moved(0.01, 0), false).force[6], 2, 1e-12);
}

/// Curved master of quadratic facets, in stick and in slip, with every weight and form.
TEST(ContactEvaluator, TangentIsTheDerivativeOfTheForces) {
  for (const double shift : {0.004, 0.2})
    for (const pairing::Weight weight :
         {pairing::Weight::node, pairing::Weight::reference_area, pairing::Weight::current_area})
      for (const contact::ResidualForm form :
           {contact::ResidualForm::surface, contact::ResidualForm::full}) {
        Sample s;
        s.master_nodes = 3;
        s.master = {0, 1, 2, 1, 5, 6};
        s.x = {0, 0, 2, 0.1, 1, 0.2, 3.2, -0.1, 0.8, 0.05, 4, 0, 3.1, 0.15};
        s.options.weight = weight;
        s.options.residual = form;
        ContactEvaluator contact = s.make();
        s.x = s.moved(shift, -0.01);
        SCOPED_TRACE("shift " + std::to_string(shift) + " weight " +
                     std::to_string(static_cast<int>(weight)));
        expect_tangent(contact, s.x, shift < 0.1 ? Status::stick : Status::slip);
      }
}

TEST(ContactEvaluator, RefusesWhatItCannotUse) {
  const auto refusal = refusal_of<Sample>;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal([](Sample&) {}), "");
  EXPECT_EQ(refusal([](Sample& s) { s.options.normal_penalty = 0; }),
            "normal_penalty must be > 0, got 0");
  EXPECT_EQ(refusal([](Sample& s) { s.options.normal_penalty = nan; }),
            "normal_penalty must be > 0, got nan");
  EXPECT_EQ(refusal([](Sample& s) { s.options.friction = contact::coulomb(-0.1, 200); }),
            "friction needs mu >= 0 and a stiffness > 0, got -0.1 and 200");
  EXPECT_EQ(refusal([](Sample& s) { s.options.friction = contact::coulomb(0.3, INFINITY); }),
            "friction needs mu >= 0 and a stiffness > 0, got 0.3 and inf");
  EXPECT_EQ(refusal([](Sample& s) { s.options.area.thickness = 0; }),
            "area.thickness must be > 0, got 0");
  EXPECT_EQ(refusal([](Sample& s) { s.master.clear(); }),
            "master: 0 node numbers are no whole number of facets of 2");
  EXPECT_EQ(refusal([](Sample& s) { s.slave.pop_back(); }),
            "slave: 1 node numbers are no whole number of facets of 2");
  EXPECT_EQ(refusal([](Sample& s) { s.slave_nodes = 1; }),
            "slave: nodes_per_facet must be 2 to 8, got 1");
  EXPECT_EQ(refusal([](Sample& s) { s.master_nodes = 9; }),
            "master: nodes_per_facet must be 2 to 8, got 9");
  EXPECT_EQ(refusal([](Sample& s) { s.master[3] = 5; }), "master: node 5 does not exist");
  EXPECT_EQ(refusal([](Sample& s) { s.slave[0] = -1; }), "slave: node -1 does not exist");
  EXPECT_EQ(refusal([](Sample& s) { s.master[1] = 0; }), "master: facet 0 names node 0 twice");
  EXPECT_EQ(refusal([](Sample& s) { s.slave[0] = 2; }), "node 2 is on master and slave");
  EXPECT_EQ(refusal([](Sample& s) { s.x[5] = nan; }), "the coordinates of node 2 are not finite");
  EXPECT_EQ(refusal([](Sample& s) { s.x.push_back(1); }), "11 coordinates are no pairs of x and y");
  EXPECT_EQ(refusal([](Sample& s) {
              s.x[6] = s.x[8];
              s.x[7] = s.x[9];
            }),
            "slave: a slave node has no positive tributary area; use weight: node");
}

// ---- space -------------------------------------------------------------------------------------

/// Master: two quad4 side by side, 4 x 2 in the plane z = 0, normal up (nodes 0..5). Slave: one
/// quad4 of area 1 above them that looks down, 0.1 inside (nodes 6..9), all feet on the first
/// facet.
struct Sample3 {
  ContactOptions options{.normal_penalty = 100, .friction = contact::coulomb(0.3, 200)};
  cell::CellType master_type = cell::CellType::quad4, slave_type = cell::CellType::quad4;
  std::vector<Index> master{0, 1, 4, 3, 1, 2, 5, 4}, slave{6, 9, 8, 7};
  std::vector<double> x{0, 0, 0, 2,   0,   0,    4,   0,   0,    0,   2,   0,    2,   2,   0,
                        4, 2, 0, 0.5, 0.5, -0.1, 1.5, 0.5, -0.1, 1.5, 1.5, -0.1, 0.5, 1.5, -0.1};

  [[nodiscard]] ContactEvaluator3 make() const {
    return {options, {master_type, master}, {slave_type, slave}, x};
  }
  /// With the slave moved.
  [[nodiscard]] std::vector<double> moved(double dx, double dy, double dz) const {
    std::vector<double> y = x;
    for (std::size_t n = 6; n < y.size() / 3; ++n) {
      y[3 * n] += dx;
      y[3 * n + 1] += dy;
      y[3 * n + 2] += dz;
    }
    return y;
  }
};

double sum(const std::vector<double>& force, std::size_t from, std::size_t to, std::size_t i) {
  double total = 0;
  for (std::size_t n = from; n < to; ++n) total += force[3 * n + i];
  return total;
}

/// N = 100 * (-0.1) on an area of 1/4 each; the feet at xi = +-1/2 give the corners of the first
/// facet 9/16, 3/16, 3/16 and 1/16 of a node's force, which add up to one node's force a corner.
TEST(ContactEvaluator3, ForcesByHand) {
  const Sample3 s;
  ContactEvaluator3 contact = s.make();
  ASSERT_EQ(contact.slave_nodes().size(), 4u);
  const ContactResult3 result = contact.evaluate(s.x, false);
  for (const std::size_t n : {0u, 1u, 3u, 4u}) EXPECT_NEAR(result.force[3 * n + 2], 2.5, 1e-12);
  for (const std::size_t n : {2u, 5u}) EXPECT_NEAR(result.force[3 * n + 2], 0, 1e-12);
  for (std::size_t n = 6; n < 10; ++n) EXPECT_NEAR(result.force[3 * n + 2], -2.5, 1e-12);
  for (std::size_t n = 0; n < 10; ++n)
    for (const std::size_t i : {0u, 1u}) EXPECT_NEAR(result.force[3 * n + i], 0, 1e-12);
  expect_points_by_hand(result, 4, 0.25);
  for (const double f : contact.evaluate(s.moved(0, 0, 0.2), false).force) EXPECT_EQ(f, 0.0);
}

/// The same pressure at Gauss points: the same forces on the slave, their sum on the master.
TEST(ContactEvaluator3, SampledAtGaussPoints) {
  Sample3 s;
  s.options.sampling = {pairing::Sampling::Rule::gauss, 2, 1};
  ContactEvaluator3 contact = s.make();
  ASSERT_EQ(contact.slave_nodes().size(), 4u);
  ASSERT_EQ(contact.slave_points().size(), 4u);
  EXPECT_EQ(contact.slave_points()[0].count, 4);
  const ContactResult3 result = contact.evaluate(s.x, true);
  for (std::size_t n = 6; n < 10; ++n) EXPECT_NEAR(result.force[3 * n + 2], -2.5, 1e-12);
  EXPECT_NEAR(sum(result.force, 0, 6, 2), 10, 1e-12);
  for (const TangentEntry& e : result.tangent) EXPECT_TRUE(std::isfinite(e.value));
  s.options.sampling.points = 0;
  EXPECT_THROW((void)s.make(), core::InputError);
}

/// Stick along (3, 4)/5 to 0.01, slip at 0.02 (limit 0.3 * 10), back by 0.005 from there.
TEST(ContactEvaluator3, HistoryIsThatOfTheLastCommit) {
  const Sample3 s;
  ContactEvaluator3 contact = s.make();
  const auto shear = [&](double d) {
    const std::vector<double> f = contact.evaluate(s.moved(0.6 * d, 0.8 * d, 0), false).force;
    const double x = sum(f, 6, 10, 0), y = sum(f, 6, 10, 1);
    EXPECT_NEAR(0.8 * x, 0.6 * y, 1e-12) << "the force is along the motion";
    return 0.6 * x + 0.8 * y;
  };
  expect_history_of_the_last_commit(contact, shear, 0.3, s.moved(0, 0, 1));
}

TEST(ContactEvaluator3, SeveralLiveAtOnceAndMove) {
  const Sample3 s;
  ContactEvaluator3 first = s.make();
  ContactEvaluator3 second = s.make();
  (void)first.evaluate(s.moved(0.02, 0, 0), false);
  first.commit();
  const auto shear = [&](ContactEvaluator3& e, double dx) {
    return sum(e.evaluate(s.moved(dx, 0, 0), false).force, 6, 10, 0);
  };
  EXPECT_NEAR(shear(second, 0.01), 2, 1e-12);
  ContactEvaluator3 third = std::move(first);
  EXPECT_NEAR(shear(third, 0.015), 2, 1e-12);
}

/// Curved master facets of every kind in the square (0..2)^2, in stick and in slip.
struct Master {
  cell::CellType type;
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
  return {{cell::CellType::quad4, {0, 1, 2, 3}, first(nine, 4)},
          {cell::CellType::quad8, {0, 1, 2, 3, 4, 5, 6, 7}, first(nine, 8)},
          {cell::CellType::quad9, {0, 1, 2, 3, 4, 5, 6, 7, 8}, nine},
          {cell::CellType::tri3, {0, 1, 2}, first(six, 3)},
          {cell::CellType::tri6, {0, 1, 2, 3, 4, 5}, six}};
}

/// The master with a quad4 slave half a unit wide that has sunk in.
Sample3 over(const Master& m) {
  Sample3 s;
  s.master_type = m.type;
  s.master = m.nodes;
  s.x = m.x;
  const auto first = static_cast<Index>(m.nodes.size());
  s.slave = {first, first + 3, first + 2, first + 1};
  for (const double v : {0.8, 0.7, -0.2, 1.3, 0.75, -0.22, 1.25, 1.2, -0.18, 0.7, 1.3, -0.21})
    s.x.push_back(v);
  return s;
}

TEST(ContactEvaluator3, TangentIsTheDerivativeOfTheForces) {
  for (const Master& m : curved_masters())
    for (const double shift : {0.0002, 0.2})
      for (const pairing::Weight weight :
           {pairing::Weight::node, pairing::Weight::reference_area, pairing::Weight::current_area})
        for (const contact::ResidualForm form :
             {contact::ResidualForm::surface, contact::ResidualForm::full}) {
          Sample3 s = over(m);
          s.options.weight = weight;
          s.options.residual = form;
          ContactEvaluator3 contact = s.make();
          for (std::size_t k = m.x.size(); k < s.x.size(); k += 3) s.x[k] += shift;
          SCOPED_TRACE(std::string(cell::info(m.type).name) + " shift " + std::to_string(shift) +
                       " weight " + std::to_string(static_cast<int>(weight)));
          expect_tangent(contact, s.x, shift < 0.1 ? Status::stick : Status::slip);
        }
}

/// Rotating everything rotates the forces.
TEST(ContactEvaluator3, ForcesTurnWithTheBodies) {
  const Mat<3, 3> r = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const Master& m : curved_masters()) {
    const Sample3 s = over(m);
    Sample3 turned = s;
    const auto turn_all = [&](std::vector<double>& values) {
      for (std::size_t k = 0; k < values.size(); k += 3) {
        const Vec3 v = r * Vec3(values[k], values[k + 1], values[k + 2]);
        for (std::size_t i = 0; i < 3; ++i) values[k + i] = v[static_cast<Eigen::Index>(i)];
      }
    };
    turn_all(turned.x);
    ContactEvaluator3 here = s.make(), there = turned.make();
    std::vector<double> f = here.evaluate(s.x, false).force;
    turn_all(f);
    const std::vector<double> g = there.evaluate(turned.x, false).force;
    for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f[i], g[i], 1e-11) << i;
  }
}

TEST(ContactEvaluator3, RefusesWhatItCannotUse) {
  const auto refusal = refusal_of<Sample3>;
  EXPECT_EQ(refusal([](Sample3&) {}), "");
  EXPECT_EQ(refusal([](Sample3& s) { s.master_type = cell::CellType::line2; }),
            "master: a facet is tri3, tri6, quad4, quad8 or quad9, not line2");
  EXPECT_EQ(refusal([](Sample3& s) { s.slave_type = cell::CellType::hex8; }),
            "slave: a facet is tri3, tri6, quad4, quad8 or quad9, not hex8");
  EXPECT_EQ(refusal([](Sample3& s) { s.master.pop_back(); }),
            "master: 7 node numbers are no whole number of facets of 4");
  EXPECT_EQ(refusal([](Sample3& s) { s.slave_type = cell::CellType::quad8; }),
            "slave: 4 node numbers are no whole number of facets of 8");
  EXPECT_EQ(refusal([](Sample3& s) { s.master[3] = 10; }), "master: node 10 does not exist");
  EXPECT_EQ(refusal([](Sample3& s) { s.slave[2] = 6; }), "slave: facet 0 names node 6 twice");
  EXPECT_EQ(refusal([](Sample3& s) { s.slave[0] = 2; }), "node 2 is on master and slave");
  EXPECT_EQ(refusal([](Sample3& s) { s.x[8] = std::numeric_limits<double>::quiet_NaN(); }),
            "the coordinates of node 2 are not finite");
  EXPECT_EQ(refusal([](Sample3& s) { s.x.push_back(1); }),
            "31 coordinates are no triples of x, y, z");
}

TEST(ContactEvaluator, RefusesCoordinatesItCannotUse) {
  expect_other_coordinates_refused<Sample>();
  expect_other_coordinates_refused<Sample3>();
}

}  // namespace
}  // namespace osculate::api
