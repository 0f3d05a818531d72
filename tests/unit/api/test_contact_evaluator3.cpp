#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "derivative_check.hpp"
#include "osculate/api/contact_evaluator.hpp"
#include "osculate/contact/law/coulomb.hpp"
#include "osculate/core/error.hpp"

namespace osculate::api {
namespace {

/// Master: two quad4 side by side, 4 x 2 in the plane z = 0, normal up (nodes 0..5). Slave: one
/// quad4 of area 1 above them that looks down, 0.1 inside (nodes 6..9), all feet on the first
/// facet.
struct Sample3 {
  ContactOptions options{.normal_penalty = 100, .friction = contact::Coulomb{0.3, 200}};
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
  EXPECT_TRUE(result.tangent.empty());
  ASSERT_EQ(result.points.size(), 4u);
  for (const pairing::PointResult<3>& p : result.points) {
    EXPECT_NEAR(p.gap, -0.1, 1e-15);
    EXPECT_NEAR(p.normal_traction, -10, 1e-12);
    EXPECT_NEAR(p.weight, 0.25, 1e-15);
    EXPECT_EQ(p.status, contact::Status::stick);
  }
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
  EXPECT_NEAR(shear(0.01), 2, 1e-12);
  EXPECT_NEAR(shear(0.02), 3, 1e-12);
  EXPECT_NEAR(shear(0.01), 2, 1e-12) << "evaluations leave no trace";
  EXPECT_NEAR(shear(0.02), 3, 1e-12);
  contact.commit();
  EXPECT_NEAR(shear(0.02), 3, 1e-12);
  EXPECT_NEAR(shear(0.015), 2, 1e-12);
  (void)contact.evaluate(s.moved(0, 0, 1), false);
  contact.commit();
  EXPECT_NEAR(shear(0.0), 0, 1e-12) << "a point that opens forgets";
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
          const auto n = static_cast<Eigen::Index>(s.x.size());
          const Eigen::Map<const Eigen::VectorXd> x(s.x.data(), n);
          Eigen::VectorXd d(n);
          for (Eigen::Index i = 0; i < n; ++i) d[i] = std::sin(3.0 * static_cast<double>(i) + 1);
          const auto force = [&](const Eigen::VectorXd& at) {
            const ContactResult3 r =
                contact.evaluate({at.data(), static_cast<std::size_t>(n)}, false);
            return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(r.force.data(), n));
          };
          const ContactResult3 here = contact.evaluate(s.x, true);
          for (const pairing::PointResult<3>& p : here.points)
            ASSERT_EQ(p.status, shift < 0.1 ? contact::Status::stick : contact::Status::slip);
          Eigen::VectorXd df = Eigen::VectorXd::Zero(n);
          for (const TangentEntry& e : here.tangent) df[e.row] += e.value * d[e.column];
          const auto report = testing::check_derivative(force, df, Eigen::VectorXd(x), d, 1e-3);
          EXPECT_NEAR(report.order, 2.0, 0.1)
              << report.error << " " << cell::info(m.type).name << " shift " << shift << " weight "
              << static_cast<int>(weight);
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
  const auto refusal = [](const auto& change) {
    Sample3 s;
    change(s);
    try {
      (void)s.make();
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string{};
  };
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

TEST(ContactEvaluator3, RefusesCoordinatesItCannotUse) {
  Sample3 s;
  ContactEvaluator3 contact = s.make();
  s.x.pop_back();
  EXPECT_THROW((void)contact.evaluate(s.x, false), core::InputError);
  s.x.push_back(std::numeric_limits<double>::infinity());
  EXPECT_THROW((void)contact.evaluate(s.x, true), core::InputError);
}

}  // namespace
}  // namespace osculate::api
