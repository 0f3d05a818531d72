// Every law of contact in every branch: derivative of the residual by convergence order, with
// nodes, Gauss points and mortar as contact points, in the plane and in space.
#include <gtest/gtest.h>

#include "derivative_check.hpp"
#include "mortar_sample.hpp"
#include "mortar_sample3.hpp"
#include "segment_sample.hpp"

namespace osculate::testing {
namespace {

using contact::Coulomb;
using contact::FrictionChange;
using contact::NormalExponential;
using contact::NormalPenalty;
using contact::NormalTable;
using contact::Rough;
using contact::Status;
using contact::Tresca;
using pairing::Separation;
using By = FrictionChange::By;

struct Law {
  const char* name;
  contact::NormalLaw normal;
  std::optional<contact::FrictionLaw> friction;
  Status status;
  double depth = 0.05;  ///< penetration
  double carried = 7;   ///< shear traction of the last increment
  Separation separation = Separation::allowed;
  double offset = 0, rest = 0;
};

Coulomb changing(double mu, double kinetic, By by, double scale) {
  return {mu, 80.0, std::numeric_limits<double>::infinity(), FrictionChange{kinetic, scale, by}};
}

const NormalTable table{{{-0.08, 0}, {-0.012, 20}, {0.2, 400}}};

const std::vector<Law>& laws() {
  static const std::vector<Law> all{
      {"exponential closed", NormalExponential{20, 0.04}, {}, Status::slip},
      {"exponential within the clearance", NormalExponential{20, 0.12}, {}, Status::slip, -0.04},
      {"exponential beyond 6 c0", NormalExponential{20, 0.003}, {}, Status::slip},
      {"exponential and stick", NormalExponential{20, 0.12}, Coulomb{10, 80}, Status::stick, -0.04},
      {"exponential and slip", NormalExponential{20, 0.12}, Coulomb{0.01, 80}, Status::slip, -0.04},
      {"table, first piece", table, {}, Status::slip, -0.06},
      {"table, last piece", table, Coulomb{0.01, 80}, Status::slip},
      {"capped, sticks", NormalPenalty{1000}, Coulomb{10, 80, 500}, Status::stick},
      {"capped, slips", NormalPenalty{1000}, Coulomb{10, 80, 0.5}, Status::slip},
      {"friction falls with distance", NormalPenalty{1000},
       changing(0.02, 0.005, By::distance, 0.1), Status::slip},
      {"friction grows with distance", NormalPenalty{1000}, changing(0.01, 0.05, By::distance, 0.3),
       Status::slip},
      {"friction falls with speed", NormalPenalty{1000}, changing(0.02, 0.005, By::speed, 0.2),
       Status::slip},
      {"Tresca sticks", NormalPenalty{1000}, Tresca{500, 80}, Status::stick},
      {"Tresca slips", NormalPenalty{1000}, Tresca{0.3, 80}, Status::slip, 0.05, -7},
      {"rough", NormalPenalty{1000}, Rough{80}, Status::stick},
      {"no separation, pulled",
       NormalPenalty{1000},
       {},
       Status::slip,
       -0.06,
       0,
       Separation::no_separation},
      {"no separation, pulled, Coulomb", NormalPenalty{1000}, Coulomb{0.3, 80}, Status::slip, -0.06,
       7, Separation::no_separation},
      {"no separation, pulled, rough", NormalPenalty{1000}, Rough{80}, Status::stick, -0.06, 7,
       Separation::no_separation},
      {"tied in the normal direction, pulled", NormalPenalty{1000}, Tresca{0.3, 80}, Status::slip,
       -0.06, 7, Separation::tied_normal, 0, 0.01},
      {"tied in the normal direction, pressed", NormalPenalty{1000}, Coulomb{0.01, 80},
       Status::slip, -0.02, 7, Separation::tied_normal, 0.01, 0.2},
      {"offset", NormalPenalty{1000}, Coulomb{0.01, 80}, Status::slip, -0.03, 7,
       Separation::allowed, 0.12},
      {"offset, sticks", NormalPenalty{1000}, Coulomb{10, 80}, Status::stick, -0.03, 7,
       Separation::allowed, 0.12},
  };
  return all;
}

template <class Sample>
inline constexpr int dimension = std::is_same_v<decltype(Sample::x), std::vector<Vec2>> ? 2 : 3;

template <class Sample, int Dim = dimension<Sample>>
pairing::PairEvaluation<Dim> evaluation(const Sample& s, const Eigen::VectorXd& v, bool tangent) {
  pairing::PairEvaluation<Dim> e;
  pairing::Assumed<Dim> assumed;
  assumed.duration = 0.5;
  pairing::evaluate<Dim>(s.pair, unflat<Dim>(v), s.committed, tangent, e, assumed);
  return e;
}

template <class Sample, int Dim = dimension<Sample>>
Eigen::VectorXd residual(const Sample& s, const Eigen::VectorXd& v) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(v.size());
  const pairing::PairEvaluation<Dim> e = evaluation(s, v, false);
  for (const pairing::ContactBlock<Dim>& b : e.blocks)
    for (int k = 0; k < b.count; ++k)
      r.segment<Dim>(Dim * b.nodes[static_cast<std::size_t>(k)]) +=
          b.force.template segment<Dim>(Dim * k);
  return r;
}

template <class Sample, int Dim = dimension<Sample>>
Eigen::MatrixXd tangent(const Sample& s, const Eigen::VectorXd& v) {
  const pairing::PairEvaluation<Dim> e = evaluation(s, v, true);
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(v.size(), v.size());
  for (const pairing::ContactBlock<Dim>& b : e.blocks)
    for (int i = 0; i < Dim * b.count; ++i) {
      const Eigen::Index row = Dim * b.nodes[static_cast<std::size_t>(i / Dim)] + i % Dim;
      for (int j = 0; b.tangent.size() > 0 && j < Dim * b.count; ++j)
        k(row, Dim * b.nodes[static_cast<std::size_t>(j / Dim)] + j % Dim) += b.tangent(i, j);
      for (const pairing::NodeMatrix<Dim>& g : b.path())
        k.block<1, Dim>(row, Dim * g.node) += b.path_rows.row(i) * g.value;
      for (const pairing::NodeGradient<Dim>& g : b.area)
        k.block<1, Dim>(row, Dim * g.node) += b.area_rows[i] * g.value.transpose();
    }
  return k;
}

/// What must not change between the probes: statuses, facets, pieces of the laws.
template <class Sample, int Dim = dimension<Sample>>
std::vector<int> branches(const Sample& s, const Law& law, const Eigen::VectorXd& v) {
  std::vector<int> out;
  const pairing::PairEvaluation<Dim> e = evaluation(s, v, false);
  for (const pairing::PointResult<Dim>& p : e.points) {
    int piece = p.normal_traction > 0 ? 100 : 0;
    const double gap = p.history.gap - s.pair.offset;
    if (const auto* const t = std::get_if<NormalTable>(&law.normal))
      for (const auto& point : t->points) piece += -gap > point[0] ? 1 : 0;
    if (const auto* const x = std::get_if<NormalExponential>(&law.normal))
      piece += gap < -6 * x->clearance ? 1 : 0;
    if (law.friction)
      if (const auto* const c = std::get_if<Coulomb>(&*law.friction))
        piece += p.shear_traction.norm() > (1 - 1e-9) * c->cap ? 10 : 0;
    out.insert(out.end(), {static_cast<int>(p.status), static_cast<int>(p.history.feature),
                           static_cast<int>(s.pair.mortar ? 0 : p.history.facet), piece});
  }
  return out;
}

/// Gives the pair its law, and a last place a little behind.
template <class Sample, int Dim = dimension<Sample>>
void set_law(const Law& law, Sample& s) {
  s.pair.normal = law.normal;
  s.pair.friction = law.friction;
  s.pair.separation = law.separation;
  s.pair.offset = law.offset;
  std::vector<Vec<Dim>> before = s.x;
  Vec<Dim> shift = Vec<Dim>::Constant(0.01);
  shift[0] = 0.04;
  for (const Index n : s.pair.slave.nodes) before[static_cast<std::size_t>(n)] -= shift;
  s.committed = pairing::initial_state<Dim>(s.pair, before);
  for (contact::PointHistory<Dim>& h : s.committed.points) {
    if (h.facet < 0) continue;
    h.active = true;
    h.traction.setZero();
    h.traction[0] = law.carried;
    h.slid = 0.03;
    h.held = law.separation == Separation::tied_normal;
    h.rest = law.rest;
  }
}

template <class Sample, int Dim = dimension<Sample>>
void expect_second_order(const Law& law, Sample s, double h) {
  SCOPED_TRACE(law.name);
  set_law(law, s);
  const Eigen::VectorXd v = flat<Dim>(s.x);
  const std::vector<int> here = branches(s, law, v);
  ASSERT_EQ(here.front(), static_cast<int>(law.status));
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd d(v.size());
  for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = uniform(generator);
  for (const double step : {h, -h})
    ASSERT_EQ(branches(s, law, Eigen::VectorXd(v + step * d)), here);
  const DerivativeReport r =
      check_derivative([&](const Eigen::VectorXd& y) { return residual(s, y); },
                       Eigen::VectorXd(tangent(s, v) * d), v, d, h);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2.0) < 0.15)
      << "order " << r.order << " error " << r.error;
}

class LawTangent : public ::testing::TestWithParam<std::size_t> {
 protected:
  [[nodiscard]] const Law& law() const { return laws()[GetParam()]; }
};

TEST_P(LawTangent, AtANode) {
  for (const auto form : {contact::ResidualForm::surface, contact::ResidualForm::full})
    for (const double bend : {0.0, 0.02}) {
      PairSample s =
          make_sample({.nodes_per_facet = bend > 0 ? 3 : 2, .bend = bend, .depth = law().depth});
      s.pair.residual = form;
      s.pair.weight = pairing::Weight::current_area;
      expect_second_order(law(), s, 1e-3);
    }
}

TEST_P(LawTangent, AtANodeInSpace) {
  for (const auto form : {contact::ResidualForm::surface, contact::ResidualForm::full}) {
    PairSample3 s = make_sample3({.bend = 0.03, .depth = law().depth});
    s.pair.residual = form;
    s.pair.weight = pairing::Weight::current_area;
    expect_second_order(law(), s, 1e-3);
  }
}

TEST_P(LawTangent, AtGaussPoints) {
  const pairing::Sampling gauss{pairing::Sampling::Rule::gauss, 2, 1};
  expect_second_order(
      law(), segment_sample({.bend = 0.02, .depth = law().depth, .sampling = gauss}), 5e-4);
  expect_second_order(
      law(), segment_sample3({.bend = 0.01, .depth = law().depth, .sampling = gauss}), 2e-4);
}

TEST_P(LawTangent, OfMortar) {
  expect_second_order(law(), make_mortar2({.depth = law().depth, .bend = 0.01, .uneven = 0.2}),
                      2e-4);
}

TEST_P(LawTangent, OfMortarInSpace) {
  expect_second_order(law(), make_mortar3({.depth = law().depth}), 2e-4);
}

INSTANTIATE_TEST_SUITE_P(All, LawTangent, ::testing::Range(std::size_t{0}, laws().size()));

}  // namespace
}  // namespace osculate::testing
