// Every law of contact in every branch: derivative of the residual by convergence order, with
// nodes, Gauss points and mortar as contact points, in the plane and in space.
#include <gtest/gtest.h>

#include "expect_derivative.hpp"
#include "law_sample.hpp"
#include "mortar_sample.hpp"
#include "segment_sample.hpp"

namespace osculate::testing {
namespace {

constexpr double duration = 0.5;

template <int Dim>
pairing::PairEvaluation<Dim> evaluation(const ContactSample<Dim>& s, const Eigen::VectorXd& v,
                                        bool tangent) {
  pairing::PairEvaluation<Dim> e;
  pairing::ActiveSet<Dim> active_set;
  active_set.duration = duration;
  pairing::evaluate<Dim>(s.pair, unflatten<Dim>(v), s.committed, tangent, e, active_set);
  return e;
}

template <int Dim>
void expect_second_order(const Law& law, ContactSample<Dim> s, double h) {
  SCOPED_TRACE(law.name);
  set_law(law, s);
  const auto residual = [&](const Eigen::VectorXd& y) {
    return assembled_force(evaluation(s, y, false), y.size());
  };
  const auto branch = [&](const Eigen::VectorXd& y) {
    return branches<Dim>(s.pair, law, evaluation(s, y, false), duration);
  };
  const Eigen::VectorXd v = flatten(s.x);
  ASSERT_EQ(branch(v).front(), static_cast<int>(law.status));
  expect_derivative(residual, assembled_tangent(evaluation(s, v, true), v.size()), branch, v, h, 2);
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
