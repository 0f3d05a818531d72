#include "osculate/pairing/mortar_facet.hpp"

#include <gtest/gtest.h>

#include "mortar_checks.hpp"
#include "mortar_sample.hpp"
#include "osculate/pairing/mortar_basis.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using pairing::MortarCell;
using pairing::MortarFacet;

/// One slave facet over part of a master, with its cells.
template <int Dim>
struct OneFacet {
  ContactSample<Dim> s;
  std::vector<MortarCell<Dim>> cells;
  MortarFacet<Dim> facet;
};

template <int Dim>
void integrate(OneFacet<Dim>& out) {
  const pairing::PairEvaluation<Dim> e = pair_evaluation(out.s, flatten(out.s.x));
  const pairing::MortarSides<Dim> sides{
      &out.s.pair.slave.boundary,
      &out.s.pair.master,
      {false, {}, std::get<pairing::ByMortar<Dim>>(out.s.pair.sampler).reference},
      e.mortar.normals};
  for (const Index m : e.mortar.overlaps[0]) {
    out.cells.emplace_back();
    ASSERT_TRUE(
        pairing::mortar_cell(sides, 0, e.mortar.slots[0], m, out.s.x, false, out.cells.back()));
  }
  ASSERT_FALSE(out.cells.empty());
  double cover = 0;
  for (const MortarCell<Dim>& c : out.cells) cover += c.cover;
  pairing::mortar_facet<Dim>(
      out.cells, out.s.pair.master,
      pairing::multiplier_basis(out.s.pair.slave.boundary.facets[0], cover > 1 - 1e-6), false,
      out.facet);
}

template <int Dim>
void expect_dual(const OneFacet<Dim>& f) {
  // Rows of M and D sum up to d, and linear fields of the master come out exactly: sum_l M_jl x_l
  // is int Phi_j x dA, on flat faces over each other that of the slave up to the gap.
  EXPECT_GT(f.facet.d.minCoeff(), 0);
  EXPECT_LT((f.facet.m.view().rowwise().sum() - f.facet.d).norm(), 1e-13 * f.facet.d.norm());
  EXPECT_LT((f.facet.s.rowwise().sum() - f.facet.d).norm(), 1e-13 * f.facet.d.norm());
  const auto& nodes = f.s.pair.slave.boundary.facets[0].nodes;
  for (Eigen::Index j = 0; j < f.facet.d.size(); ++j) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (Eigen::Index k = 0; k < f.facet.s.cols(); ++k)
      sum += f.facet.s(j, k) * f.s.x[static_cast<std::size_t>(nodes[static_cast<std::size_t>(k)])];
    for (std::size_t l = 0; l < f.facet.masters.size(); ++l)
      sum -= f.facet.m.view()(j, static_cast<Eigen::Index>(l)) *
             f.s.x[static_cast<std::size_t>(f.facet.masters[l])];
    EXPECT_NEAR(sum.norm() / f.facet.d[j], 0.05, 1e-8) << j;
  }
}

TEST(MortarFacet, DualFunctionsReproduceLinearFieldsInThePlane) {
  for (const int nodes : {2, 3, 4})
    for (const double from : {0.3, -0.6}) {  // wholly and partly covered
      OneFacet<2> f;
      f.s = make_mortar2(
          {.slave_nodes = nodes, .slave_facets = 1, .from = from, .to = 1.7, .angle = 0.4});
      integrate(f);
      EXPECT_NEAR(f.facet.d.sum(), from < 0 ? 1.7 : 1.4, 1e-12);
      expect_dual(f);
    }
}

TEST(MortarFacet, DualFunctionsReproduceLinearFieldsInSpace) {
  for (const CellType type :
       {CellType::tri3, CellType::quad4, CellType::tri6, CellType::quad8, CellType::quad9})
    for (const double from : {0.3, -0.2}) {
      OneFacet<3> f;
      f.s = make_mortar3({.slave = type, .slave_cells = 1, .from = from, .to = 1.9});
      integrate(f);
      const double side = from < 0 ? 1.9 : 1.6;
      EXPECT_NEAR(f.facet.d.sum(), cell::is_triangle(type) ? 0.5 * side * side : side * side,
                  1e-12);
      expect_dual(f);
    }
}

TEST(MortarFacet, AreasOfQuadraticFacetsArePositive) {
  for (const CellType type : {CellType::tri6, CellType::quad8, CellType::quad9}) {
    OneFacet<3> f;
    f.s = make_mortar3({.slave = type, .slave_cells = 1, .skew = 0.1});
    integrate(f);
    EXPECT_GT(f.facet.d.minCoeff(), 0);
  }
}

// Eigen computes by packets from where these begin in memory: last bits are not to be the heap's.
TEST(MortarFacet, MatricesBeginWherePacketsBegin) {
  EXPECT_EQ(alignof(pairing::MortarCell<2>) % EIGEN_MAX_STATIC_ALIGN_BYTES, 0);
  EXPECT_EQ(alignof(pairing::MortarCell<3>) % EIGEN_MAX_STATIC_ALIGN_BYTES, 0);
  EXPECT_EQ(alignof(pairing::MortarFacet<2>) % EIGEN_MAX_STATIC_ALIGN_BYTES, 0);
  EXPECT_EQ(alignof(pairing::MortarFacet<3>) % EIGEN_MAX_STATIC_ALIGN_BYTES, 0);
}

}  // namespace
}  // namespace osculate::testing
