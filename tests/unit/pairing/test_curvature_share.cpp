// What the rotational and curvature parts of the normal tangent weigh beside the main part.
#include <gtest/gtest.h>

#include "osculate/pairing/tangent_parts.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;

double share_of(const PairSample3& s) {
  pairing::PairEvaluation<3> e;
  pairing::evaluate<3>(s.pair, s.x, s.committed, false, e);
  return pairing::curvature_share<3>(s.pair, s.x, e);
}

// [eq:KSVD:61]
TEST(RowSumNorm, IsThatOfTheLargestRow) {
  Mat<2, 3> k;
  k << 1, -2, 0.5, -4, 1, 1;
  EXPECT_EQ(pairing::row_sum_norm(k), 6.0);
}

// [eq:KSVD:60] [eq:KSVD:61] by hand: over the middle of a square facet of side 2 (a_ij = 1) the
// largest row of the main part is 2 eps_N (slave, normal), that of the rotational part eps_N |gap|.
TEST(CurvatureShare, OfASquareFacetIsHalfThePenetration) {
  PairSample3 s;
  s.x = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, -0.02}};
  s.pair.master.facets = {
      pairing::surface_facet(CellType::quad4, std::array<Index, 4>{0, 1, 2, 3})};
  make_last_node_slave(s);
  EXPECT_NEAR(share_of(s), 0.01, 1e-15);
  s.x[4].z() = 0.02;  // open
  EXPECT_EQ(share_of(s), 0.0);
}

// The same by hand over a straight segment of length 2.
TEST(CurvatureShare, InThePlane) {
  pairing::PairDefinition<2> pair;
  std::vector<Vec2> x{{-1, 0}, {1, 0}, {0, -0.02}};
  pair.master.facets = {pairing::lagrange_facet(std::array<Index, 2>{1, 0})};
  pairing::connect(pair.master);
  pair.slave = pairing::make_slave_side(pairing::Chain{}, std::array<Index, 1>{2});
  pair.weight = pairing::Weight::node;
  pair.normal = contact::penalty(1000);
  pairing::prepare(pair, x);
  const auto share = [&] {
    pairing::PairState<2> committed;
    committed.points.resize(1);
    pairing::PairEvaluation<2> e;
    pairing::evaluate<2>(pair, x, committed, false, e);
    return pairing::curvature_share<2>(pair, x, e);
  };
  const double below = share();
  x[2].y() = 0.02;
  const double above = share();
  EXPECT_NEAR(std::max(below, above), 0.01, 1e-15);
  EXPECT_EQ(std::min(below, above), 0.0);
}

Eigen::MatrixXd tangent_with(PairSample3 s, bool rotational, bool curvature) {
  s.pair.tangent = {false, true, rotational, curvature};
  return pair_tangent(s, flatten(s.x));
}

// On curved facets it is what the tangents of the pair say; neither friction nor the tangent that
// the iteration uses changes it.
TEST(CurvatureShare, IsThatOfThePairsTangents) {
  const auto norm = [](const Eigen::MatrixXd& k) {
    return k.cwiseAbs().rowwise().sum().maxCoeff();
  };
  for (const CellType type : {CellType::quad4, CellType::quad8, CellType::quad9}) {
    PairSample3 s = make_sample3({.type = type, .bend = 0.05, .depth = 0.05});
    s.pair.slave = pairing::make_slave_side(
        pairing::FacetSurface{}, std::array<Index, 1>{static_cast<Index>(s.x.size()) - 4});
    s.pair.weight = pairing::Weight::node;
    pairing::prepare(s.pair, s.x);
    const Eigen::MatrixXd full = tangent_with(s, true, true), main = tangent_with(s, false, false);
    const double expected = norm(full - main) / norm(main);
    pairing::PairEvaluation<3> e;
    pairing::evaluate<3>(s.pair, s.x, s.committed, false, e);
    EXPECT_NEAR(pairing::curvature_share<3>(s.pair, s.x, e, {false, true, false, true}),
                norm(tangent_with(s, false, true) - main) / norm(main), 1e-12);
    ASSERT_GT(expected, 1e-4);
    EXPECT_NEAR(share_of(s), expected, 1e-12) << cell::info(type).name;
    s.pair.friction = contact::coulomb(0.3, 80.0);
    EXPECT_NEAR(share_of(s), expected, 1e-12) << cell::info(type).name;
  }
}

}  // namespace
}  // namespace osculate::testing
