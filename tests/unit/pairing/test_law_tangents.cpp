// Every law of contact in every branch: derivative of the residual by convergence order, with
// nodes, Gauss points and mortar as contact points, in the plane and in space.
#include <gtest/gtest.h>

#include "expect_derivative.hpp"
#include "law_sample.hpp"
#include "mortar_sample.hpp"
#include "mortar_sample3.hpp"
#include "segment_sample.hpp"

namespace osculate::testing {
namespace {

constexpr double duration = 0.5;

template <class Sample, int Dim = dimension<Sample>>
pairing::PairEvaluation<Dim> evaluation(const Sample& s, const Eigen::VectorXd& v, bool tangent) {
  pairing::PairEvaluation<Dim> e;
  pairing::Assumed<Dim> assumed;
  assumed.duration = duration;
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

template <class Sample, int Dim = dimension<Sample>>
void expect_second_order(const Law& law, Sample s, double h) {
  SCOPED_TRACE(law.name);
  set_law(law, s);
  const Eigen::VectorXd v = flat<Dim>(s.x);
  const auto branch = [&](const Eigen::VectorXd& y) {
    return branches<Dim>(s.pair, law, evaluation(s, y, false), duration);
  };
  ASSERT_EQ(branch(v).front(), static_cast<int>(law.status));
  expect_derivative([&](const Eigen::VectorXd& y) { return residual(s, y); }, tangent(s, v), branch,
                    v, h, 2);
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
