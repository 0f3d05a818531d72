#include "osculate/api/contact_evaluator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "derivative_check.hpp"
#include "osculate/contact/law/coulomb.hpp"
#include "osculate/core/error.hpp"

namespace osculate::api {
namespace {

/// Master 0-1-2 along the x axis, normal up; slave facet 3 -> 4 above it, 0.1 inside.
struct Sample {
  ContactOptions options{.normal_penalty = 100, .friction = contact::Coulomb{0.3, 200}};
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

TEST(ContactEvaluator, ForcesByHand) {
  const Sample s;
  ContactEvaluator contact = s.make();
  EXPECT_EQ(std::vector<Index>(contact.slave_nodes().begin(), contact.slave_nodes().end()),
            (std::vector<Index>{3, 4}));
  // N = 100 * (-0.1) on an area of 1 each; both feet in the middle of a facet.
  const ContactResult result = contact.evaluate(s.x, false);
  expect_forces(result.force, {0, 5, 0, 10, 0, 5, 0, -10, 0, -10});
  EXPECT_TRUE(result.tangent.empty());
  ASSERT_EQ(result.points.size(), 2u);
  for (const pairing::PointResult<2>& p : result.points) {
    EXPECT_NEAR(p.gap, -0.1, 1e-15);
    EXPECT_NEAR(p.normal_traction, -10, 1e-12);
    EXPECT_NEAR(p.weight, 1.0, 1e-15);
    EXPECT_EQ(p.status, contact::Status::stick);
  }
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

/// Stick to 0.01, slip at 0.02 (limit 0.3 * 10), and back by 0.005 from there.
TEST(ContactEvaluator, HistoryIsThatOfTheLastCommit) {
  const Sample s;
  ContactEvaluator contact = s.make();
  const auto shear = [&](double dx) { return contact.evaluate(s.moved(dx, 0), false).force[6]; };
  EXPECT_NEAR(shear(0.01), 2, 1e-12);
  EXPECT_NEAR(shear(0.02), 3, 1e-12);
  EXPECT_NEAR(shear(0.01), 2, 1e-12) << "evaluations leave no trace";
  EXPECT_NEAR(shear(0.02), 3, 1e-12);
  contact.commit();
  EXPECT_NEAR(shear(0.02), 3, 1e-12);
  EXPECT_NEAR(shear(0.015), 2, 1e-12);
  contact.commit();
  EXPECT_NEAR(shear(-1.0), -3, 1e-12);
  // A point that opens forgets.
  (void)contact.evaluate(s.moved(0, 1), false);
  contact.commit();
  EXPECT_NEAR(shear(0.0), 0, 1e-12);
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
        const auto n = static_cast<Eigen::Index>(s.x.size());
        const Eigen::Map<const Eigen::VectorXd> x(s.x.data(), n);
        Eigen::VectorXd d(n);
        for (Eigen::Index i = 0; i < n; ++i) d[i] = std::sin(3.0 * static_cast<double>(i) + 1);
        const auto force = [&](const Eigen::VectorXd& at) {
          const ContactResult r = contact.evaluate({at.data(), static_cast<std::size_t>(n)}, false);
          return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(r.force.data(), n));
        };
        const ContactResult here = contact.evaluate(s.x, true);
        for (const pairing::PointResult<2>& p : here.points)
          ASSERT_EQ(p.status, shift < 0.1 ? contact::Status::stick : contact::Status::slip);
        Eigen::VectorXd df = Eigen::VectorXd::Zero(n);
        for (const TangentEntry& e : here.tangent) df[e.row] += e.value * d[e.column];
        const auto report = testing::check_derivative(force, df, Eigen::VectorXd(x), d, 1e-3);
        EXPECT_NEAR(report.order, 2.0, 0.1)
            << report.error << " shift " << shift << " weight " << static_cast<int>(weight);
      }
}

TEST(ContactEvaluator, RefusesWhatItCannotUse) {
  const auto refusal = [](const auto& change) {
    Sample s;
    change(s);
    try {
      (void)s.make();
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string{};
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal([](Sample&) {}), "");
  EXPECT_EQ(refusal([](Sample& s) { s.options.normal_penalty = 0; }),
            "normal_penalty must be > 0, got 0");
  EXPECT_EQ(refusal([](Sample& s) { s.options.normal_penalty = nan; }),
            "normal_penalty must be > 0, got nan");
  EXPECT_EQ(refusal([](Sample& s) {
              s.options.friction = contact::Coulomb{-0.1, 200};
            }),
            "friction needs mu >= 0 and a stiffness > 0, got -0.1 and 200");
  EXPECT_EQ(refusal([](Sample& s) {
              s.options.friction = contact::Coulomb{0.3, INFINITY};
            }),
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

TEST(ContactEvaluator, RefusesCoordinatesItCannotUse) {
  Sample s;
  ContactEvaluator contact = s.make();
  s.x.pop_back();
  EXPECT_THROW((void)contact.evaluate(s.x, false), core::InputError);
  s.x.push_back(std::numeric_limits<double>::infinity());
  EXPECT_THROW((void)contact.evaluate(s.x, true), core::InputError);
}

}  // namespace
}  // namespace osculate::api
