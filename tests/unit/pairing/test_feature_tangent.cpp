// Derivative of the residual on edges and at corners by convergence order: plane and space,
// straight and curved, stick and slip, both residual forms, every weight, small and large gaps.
#include <gtest/gtest.h>

#include <random>

#include "pair_checks.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using contact::ResidualForm;
using contact::Status;
using pairing::Weight;
using projection::Feature;

/// Friction branch by its coefficient: none, too small to hold, large enough.
Status status_of(double mu) { return mu > 1 ? Status::stick : Status::slip; }

template <int Dim>
void set_pair(ContactSample<Dim>& s, double mu, ResidualForm form, Weight weight) {
  if (mu > 0) s.pair.friction = contact::coulomb(mu, 80.0);
  s.pair.residual = form;
  s.pair.weight = weight;
  pairing::prepare(s.pair, s.x);
}

class FeatureTangent
    : public ::testing::TestWithParam<std::tuple<double, double, ResidualForm, Weight>> {};

// The wedge of a re-entrant vertex, in the plane: nearest to the vertex between two facets.
TEST_P(FeatureTangent, CornerInThePlane) {
  const auto [mu, depth, form, weight] = GetParam();
  for (const int nodes : {2, 3}) {
    PairSample s = make_sample({.nodes_per_facet = nodes, .facets = 2, .angle = 0.0});
    const int per = nodes - 1;
    s.x[0] = {-1, 1};
    s.x[static_cast<std::size_t>(per)] = {0, 0};
    s.x[static_cast<std::size_t>(2 * per)] = {2, 1.5};
    if (nodes == 3) s.x[1] = {-0.52, 0.49}, s.x[3] = {1.02, 0.77};
    const std::size_t slave = s.x.size() - 2;
    s.x[slave] = depth * Vec2(0.18, -0.98).normalized();
    set_pair(s, mu, form, weight);
    s.committed.points[0] = remembered(true, 0, Feature::face, 0.9, -0.01, 5.0);
    expect_pair_tangent(s, status_of(mu), Feature::corner, 0.08 * depth);
  }
}

// The edge of a re-entrant vertex in space, straight and (quadratic facets) curved.
TEST_P(FeatureTangent, EdgeInSpace) {
  const auto [mu, depth, form, weight] = GetParam();
  for (const CellType type :
       {CellType::tri3, CellType::tri6, CellType::quad4, CellType::quad8, CellType::quad9}) {
    SCOPED_TRACE(cell::info(type).name);
    const bool curved = cell::info(type).nodes > 4;
    const SampleOptions3 o{.type = type, .bend = curved ? 0.03 : 0.0, .at = 2, .kink = 1.2};
    PairSample3 s = make_sample3(o);
    const double y = 0.3;
    const Vec3 foot(4, y, sample_height(o, 4, y));
    const Vec2 slope(o.bend * (5 - 8 + 0.7 * y), o.bend * (0.7 * 4 + y));
    const Vec3 first = Vec3(-slope.x(), -slope.y(), 1).normalized(),
               second = Vec3(-slope.x() - o.kink, -slope.y(), 1).normalized();
    const Vec3 normal = (0.6 * first + 0.4 * second).normalized();
    s.x[s.x.size() - 4] = foot - depth * normal;
    set_pair(s, mu, form, weight);
    const bool triangle = cell::is_triangle(type);
    s.committed.points[0] = remembered(
        triangle ? 3 : 1, triangle ? Vec2(0.1, 0.2) : Vec2(0.9, 0.25), -0.01, {2.0, 1.0});
    expect_pair_tangent(s, status_of(mu), Feature::edge, 0.08 * depth);
  }
}

// The corner of a room, from behind its three walls.
TEST_P(FeatureTangent, CornerInSpace) {
  const auto [mu, depth, form, weight] = GetParam();
  PairSample3 s = make_sample3({.type = CellType::quad4});
  s.pair.master = {};
  s.x = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  for (const std::array<Index, 4>& nodes :
       {std::array<Index, 4>{0, 1, 2, 3}, std::array<Index, 4>{0, 4, 5, 1},
        std::array<Index, 4>{0, 3, 6, 4}})
    s.pair.master.facets.push_back(pairing::surface_facet(CellType::quad4, nodes));
  pairing::connect(s.pair.master);
  const Vec3 slave = -depth * Vec3(0.3, 0.5, 0.4).normalized();
  s.x.push_back(slave);
  s.x.push_back(Vec3(0.4, 0, 2));
  s.x.push_back(Vec3(0.5, 0.5, 2.1));
  s.x.push_back(Vec3(0, 0.4, 2));
  pairing::FacetSurface facet;
  facet.facets.push_back(
      pairing::surface_facet(CellType::quad4, std::array<Index, 4>{7, 8, 9, 10}));
  pairing::connect(facet);
  s.pair.slave = pairing::make_slave_side(facet);
  set_pair(s, mu, form, weight);
  s.committed.points[0] = remembered(0, {-0.9, -0.95}, -0.01, {2.0, 1.0});
  expect_pair_tangent(s, status_of(mu), Feature::corner, 0.08 * depth);
}

INSTANTIATE_TEST_SUITE_P(
    AllForms, FeatureTangent,
    ::testing::Combine(::testing::Values(0.0, 1e-3, 1e3), ::testing::Values(2e-3, 0.15),
                       ::testing::Values(ResidualForm::surface, ResidualForm::full),
                       ::testing::Values(Weight::node, Weight::reference_area,
                                         Weight::current_area)));

}  // namespace
}  // namespace osculate::testing
