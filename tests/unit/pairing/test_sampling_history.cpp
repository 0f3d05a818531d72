// Friction over the borders of facets, for every sampling in the plane and in space.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <set>

#include "allocation_count.hpp"
#include "osculate/pairing/pair.hpp"
#include "osculate/pairing/sampling.hpp"
#include "osculate/pairing/smoothing.hpp"

namespace osculate::testing {
namespace {

using contact::Status;
using pairing::Sampling;
using Rule = pairing::Sampling::Rule;

struct Choice {
  const char* name;
  Sampling points;
  bool mortar;
};
const std::array<Choice, 4> choices{{{"nodes", {}, false},
                                     {"gauss", {Rule::gauss, 2, 1}, false},
                                     {"lobatto", {Rule::lobatto, 3, 2}, false},
                                     {"mortar", {}, true}}};

constexpr double depth = 0.02, eps_n = 1000, eps_t = 50;

/// A flat master cut at `cuts` and a slave of facets between `pieces` over it; the slave is moved
/// as a whole.
template <int Dim>
struct Carpet {
  pairing::PairDefinition<Dim> pair;
  std::vector<Vec<Dim>> x;
  std::size_t first = 0;  ///< node of the slave
  std::vector<Vec<Dim>> home;
  pairing::PairState<Dim> state;
  pairing::PairEvaluation<Dim> now;

  void place(const std::function<Vec<Dim>(const Vec<Dim>&)>& at) {
    for (std::size_t k = 0; k < home.size(); ++k) x[first + k] = at(home[k]);
  }
  void place(const Vec<Dim>& by) {
    place([&](const Vec<Dim>& h) { return Vec<Dim>(h + by); });
  }
  void start() { state = pairing::initial_state<Dim>(pair, x); }
  void step() {
    pairing::evaluate<Dim>(pair, x, state, false, now);
    state = pairing::commit(now);
  }
  [[nodiscard]] Vec<Dim> force() const {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (const auto& p : now.points)
      if (p.status != Status::open) sum += p.weight * (p.normal_traction * p.normal + p.shear());
    return sum;
  }
  [[nodiscard]] double largest_shear() const {
    double largest = 0;
    for (const auto& p : now.points)
      if (p.status != Status::open) largest = std::max(largest, p.shear_traction.norm());
    return largest;
  }
  [[nodiscard]] double work() const {
    double sum = 0;
    for (const auto& p : now.points) sum += p.history.friction_work;
    return sum;
  }
};

using Cuts = std::vector<double>;

void add_sides(Carpet<2>& c, const Cuts& cuts, const Cuts& pieces, pairing::Chain& slave) {
  const auto line = [](pairing::Chain& chain, Index from, Index to) {
    chain.facets.push_back(pairing::lagrange_facet(std::array<Index, 2>{from, to}));
  };
  for (const double at : cuts) c.x.emplace_back(at, 0);
  for (Index i = 0; i + 1 < static_cast<Index>(cuts.size()); ++i) line(c.pair.master, i, i + 1);
  c.first = c.x.size();
  const auto base = static_cast<Index>(c.first);
  for (const double at : pieces) c.home.emplace_back(at, -depth);
  for (Index i = static_cast<Index>(pieces.size()) - 1; i > 0; --i)
    line(slave, base + i, base + i - 1);  // seen from its body
}

void add_grid(std::vector<Vec3>& x, pairing::FacetSurface& surface, Index base, const Cuts& u,
              const Cuts& v, double z, bool upwards) {
  for (const double a : u)
    for (const double b : v) x.emplace_back(a, b, z);
  const auto node = [&](std::size_t i, std::size_t j) {
    return base + static_cast<Index>(i * v.size() + j);
  };
  for (std::size_t i = 0; i + 1 < u.size(); ++i)
    for (std::size_t j = 0; j + 1 < v.size(); ++j) {
      std::array<Index, 4> q{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
      if (!upwards) std::swap(q[1], q[3]);
      surface.facets.push_back(pairing::surface_facet(cell::CellType::quad4, q));
    }
}

void add_sides(Carpet<3>& c, const Cuts& cuts, const Cuts& pieces, pairing::FacetSurface& slave) {
  add_grid(c.x, c.pair.master, 0, cuts, {-1.0, 0.3, 2.5}, 0, true);
  c.first = c.x.size();
  add_grid(c.home, slave, static_cast<Index>(c.first), pieces, {-0.5, 0.1, 0.4}, -depth, false);
}

template <int Dim>
void finish(Carpet<Dim>& c, pairing::Boundary<Dim> slave, const Choice& choice, double mu) {
  c.x.insert(c.x.end(), c.home.begin(), c.home.end());
  pairing::connect(c.pair.master);
  pairing::connect(slave);
  c.pair.slave = pairing::make_slave_side(std::move(slave));
  if (!choice.mortar) pairing::sample(c.pair.slave, choice.points);
  if (choice.mortar) c.pair.sampler = pairing::ByMortar<Dim>{};
  c.pair.normal = contact::penalty(eps_n);
  c.pair.friction = contact::coulomb(mu, eps_t);
  pairing::prepare<Dim>(c.pair, c.x);
}

template <int Dim>
Carpet<Dim> carpet(const Choice& choice, double mu, const Cuts& cuts,
                   const Cuts& pieces = {0.2, 0.65, 1.3}) {
  Carpet<Dim> c;
  pairing::Boundary<Dim> slave;
  add_sides(c, cuts, pieces, slave);
  finish<Dim>(c, std::move(slave), choice, mu);
  return c;
}

/// Along x, in space askew.
template <int Dim>
Vec<Dim> along(double way) {
  Vec<Dim> v = Vec<Dim>::Zero();
  v[0] = way;
  if (Dim == 3) v[1] = 0.2 * way;
  return v;
}

const Cuts five{0, 1, 4, 5, 8, 9};  // 1 : 3 : 1 : 3 : 1

template <int Dim>
void stick_over_five(const Choice& choice) {
  SCOPED_TRACE(choice.name);
  Carpet<Dim> c = carpet<Dim>(choice, 1e6, five);
  c.start();
  constexpr int steps = 29;
  double largest = 0;
  std::set<Index> visited;
  for (int i = 1; i <= 2 * steps; ++i) {
    c.place(along<Dim>(7.6 * (i <= steps ? i : 2 * steps - i) / steps));
    c.step();
    largest = std::max(largest, c.largest_shear());
    for (const auto& p : c.now.points) {
      ASSERT_EQ(p.status, Status::stick);
      visited.insert(p.history.facet);
    }
  }
  EXPECT_GE(visited.size(), 5u);
  EXPECT_NEAR(largest, eps_t * along<Dim>(7.6).norm(), 1e-10 * largest);
  EXPECT_LT(c.largest_shear(), 1e-12 * largest);
}

TEST(SamplingHistory, StickOverFiveFacetsAndBackLeavesNothing) {
  for (const Choice& choice : choices) {
    stick_over_five<2>(choice);
    stick_over_five<3>(choice);
  }
}

// In the plane also over kinks, inwards and outwards: the way is the arc length, whatever it is.
TEST(SamplingHistory, StickOverKinksAndBackLeavesNothingInThePlane) {
  for (const Choice& choice : choices) {
    SCOPED_TRACE(choice.name);
    Carpet<2> c = carpet<2>(choice, 1e6, five);
    for (std::size_t k = 1; k < 6; k += 2) c.x[k].y() = 0.1;
    if (auto* const mortar = std::get_if<pairing::ByMortar<2>>(&c.pair.sampler))
      mortar->reference.assign(c.x.begin(), c.x.end());
    const auto put = [&](double way) { c.place(Vec2(way, -0.1)); };
    put(0);
    c.start();
    constexpr int steps = 31;
    double largest = 0;
    for (int i = 1; i <= 2 * steps; ++i) {
      put(7.6 * (i <= steps ? i : 2 * steps - i) / steps);
      c.step();
      largest = std::max(largest, c.largest_shear());
      for (const auto& p : c.now.points) ASSERT_EQ(p.status, Status::stick);
    }
    EXPECT_GT(largest, 7.5 * eps_t);
    EXPECT_LT(c.largest_shear(), 1e-12 * largest);
  }
}

/// z = 0.15 x^2 - 0.1 x y + 0.05 y^2 as quad9 facets, which hold it exactly.
Vec3 on_bowl(double u, double v) { return {u, v, 0.15 * u * u - 0.1 * u * v + 0.05 * v * v}; }
Vec3 bowl_normal(double u, double v) {
  return Vec3(-(0.3 * u - 0.1 * v), -(-0.1 * u + 0.1 * v), 1).normalized();
}

Carpet<3> bowl(const Choice& choice) {
  Carpet<3> c;
  constexpr int n = 5;
  const auto node = [](int i, int j) { return static_cast<Index>(i * (2 * n + 1) + j); };
  for (int i = 0; i <= 2 * n; ++i)
    for (int j = 0; j <= 2 * n; ++j) c.x.push_back(on_bowl(0.5 * (i - n), 0.5 * (j - n)));
  for (int i = 0; i < 2 * n; i += 2)
    for (int j = 0; j < 2 * n; j += 2)
      c.pair.master.facets.push_back(pairing::surface_facet(
          cell::CellType::quad9,
          std::array<Index, 9>{node(i, j), node(i + 2, j), node(i + 2, j + 2), node(i, j + 2),
                               node(i + 1, j), node(i + 2, j + 1), node(i + 1, j + 2),
                               node(i, j + 1), node(i + 1, j + 1)}));
  c.first = c.x.size();
  pairing::FacetSurface slave;
  add_grid(c.home, slave, static_cast<Index>(c.first), {-0.15, 0.15}, {-0.1, 0.1}, 0, false);
  finish<3>(c, std::move(slave), choice, 1e6);
  return c;
}

/// Traction left after a way out in `steps` increments and back in half as many, over the largest.
double left_on_bowl(const Choice& choice, int steps) {
  Carpet<3> c = bowl(choice);
  const auto put = [&](double t) {
    const double a = -1.8 + 3.6 * t, b = 1.2 * std::sin(2.5 * t) - 0.6;
    c.place([&](const Vec3& h) {
      const double u = a + h.x(), v = b + h.y();
      return Vec3(on_bowl(u, v) - 0.1 * bowl_normal(u, v));
    });
  };
  put(0);
  c.start();
  double largest = 0;
  const auto go = [&](double t) {
    put(t);
    c.step();
    largest = std::max(largest, c.largest_shear());
  };
  for (int i = 1; i <= steps; ++i) go(static_cast<double>(i) / steps);
  for (int i = 1; i <= steps / 2; ++i) go(1 - static_cast<double>(i) / (steps / 2));
  for (const auto& p : c.now.points) EXPECT_EQ(p.status, Status::stick);
  return c.largest_shear() / largest;
}

// On curved surfaces in space the way is a chain of chords: of second order in the increment for
// points, of first order for mortar, which takes its components in the frame at the end.
TEST(SamplingHistory, StickIsReversibleToItsOrderOnCurvedSurfaces) {
  for (const Choice& choice : choices) {
    SCOPED_TRACE(choice.name);
    const double order = choice.mortar ? 1.0 : 2.0;
    const double coarse = left_on_bowl(choice, 40), fine = left_on_bowl(choice, 80),
                 finest = left_on_bowl(choice, 160);
    EXPECT_LT(finest, choice.mortar ? 1e-3 : 1e-4);
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.25);
    EXPECT_NEAR(std::log2(fine / finest), order, 0.15);
  }
}

/// Slides over two cuts of the same flat sides; what differs, and what jumps, over mu N or N.
template <int Dim>
void slide_over_cuts(const Choice& choice) {
  SCOPED_TRACE(choice.name);
  constexpr double mu = 0.3;
  Carpet<Dim> whole = carpet<Dim>(choice, mu, {0, 9}), cut = carpet<Dim>(choice, mu, five),
              pieces = carpet<Dim>(choice, mu, five, {0.2, 0.2 + 1.1 / 4, 1.3}),
              one = carpet<Dim>(choice, mu, five, {0.2, 1.3});
  const std::array<Carpet<Dim>*, 4> all{&whole, &cut, &pieces, &one};
  for (Carpet<Dim>* const c : all) c->start();
  constexpr int steps = 151;
  Vec<Dim> before = Vec<Dim>::Zero();
  for (int i = 1; i <= steps; ++i) {
    for (Carpet<Dim>* const c : all) {
      c->place(along<Dim>(7.6 * i / steps));
      c->step();
    }
    const Vec<Dim> force = cut.force();
    const double normal = std::abs(force[Dim - 1]);
    ASSERT_GT(normal, 1.0);
    EXPECT_LT((whole.force() - force).norm(), 1e-11 * normal);
    EXPECT_LT((pieces.force() - force).norm(), 1e-11 * normal);
    EXPECT_LT((one.force() - force).norm(), 1e-11 * normal);
    for (std::size_t k = 0; k < cut.now.points.size(); ++k)
      EXPECT_NEAR(whole.now.points[k].shear_traction.norm(),
                  cut.now.points[k].shear_traction.norm(), 1e-11 * eps_n * depth);
    if (i > 20) {  // it slides: nothing changes any more, and 1e-3 is what is asked for
      ASSERT_EQ(cut.now.points[0].status, Status::slip);
      EXPECT_LT((force - before).norm(), 1e-11 * normal);
    }
    before = force;
  }
}

TEST(SamplingHistory, CutsOfEitherSideChangeNothingAndNothingJumps) {
  for (const Choice& choice : choices) {
    slide_over_cuts<2>(choice);
    slide_over_cuts<3>(choice);
  }
}

/// There and back again: each turn costs 2 l of sliding, l = mu p / eps_T.
template <int Dim>
void slide_in_a_loop(const Choice& choice) {
  SCOPED_TRACE(choice.name);
  constexpr double mu = 0.3, way = 6.4;
  Carpet<Dim> c = carpet<Dim>(choice, mu, five);
  c.start();
  const auto round = [&] {
    constexpr int steps = 37;
    for (int i = 1; i <= 2 * steps; ++i) {
      c.place(along<Dim>(way * (i <= steps ? i : 2 * steps - i) / steps));
      c.step();
    }
  };
  round();
  const double before = c.work();
  round();
  const double normal = std::abs(c.force()[Dim - 1]), rod = mu * eps_n * depth / eps_t;
  const double expected = mu * normal * (2 * along<Dim>(way).norm() - 4 * rod);
  EXPECT_NEAR(c.work() - before, expected, 1e-11 * expected);
}

TEST(SamplingHistory, AClosedLoopDissipatesTheFrictionTimesTheWay) {
  for (const Choice& choice : choices) {
    slide_in_a_loop<2>(choice);
    slide_in_a_loop<3>(choice);
  }
}

/// Allocations of an evaluation with tangent, the second one with the same buffers. `taken`: blocks
/// are handed over.
template <int Dim>
std::size_t allocations(const Choice& choice, double mu, bool taken) {
  Carpet<Dim> c = carpet<Dim>(choice, mu, five);
  pairing::BlockTaker<Dim> take;
  if (taken) take = [](std::span<const pairing::ContactBlock<Dim>>) {};
  c.start();
  c.place(along<Dim>(0.1));
  c.step();
  c.place(along<Dim>(0.15));
  pairing::evaluate<Dim>(c.pair, c.x, c.state, true, c.now, {}, nullptr, take);
  c.place(along<Dim>(0.16));
  const std::size_t before = allocation_count();
  pairing::evaluate<Dim>(c.pair, c.x, c.state, true, c.now, {}, nullptr, take);
  const std::size_t after = allocation_count();
  EXPECT_EQ(c.now.points[0].status, mu > 1 ? Status::stick : Status::slip);
  return after - before;
}

TEST(SamplingHistory, NothingIsAllocatedAfterTheFirstCall) {
  for (const Choice& choice : choices)
    for (const double mu : {1e6, 0.05})
      for (const bool taken : {false, true}) {
        EXPECT_EQ(allocations<2>(choice, mu, taken), 0u) << choice.name;
        EXPECT_EQ(allocations<3>(choice, mu, taken), 0u) << choice.name;
      }
}

/// Returns    how many have a tangent
template <int Dim>
std::size_t expect_same_bits(const std::vector<pairing::ContactBlock<Dim>>& blocks,
                             const std::vector<pairing::ContactBlock<Dim>>& expected) {
  EXPECT_EQ(blocks.size(), expected.size());
  std::size_t with_tangent = 0;
  for (std::size_t i = 0; i < std::min(blocks.size(), expected.size()); ++i) {
    const pairing::ContactBlock<Dim>&a = blocks[i], &b = expected[i];
    EXPECT_EQ(a.count, b.count);
    if (!a.active() || a.count != b.count) continue;
    const Eigen::Index rows = Dim * a.count;
    EXPECT_EQ(a.nodes, b.nodes);
    EXPECT_EQ(a.force.head(rows), b.force.head(rows));
    EXPECT_EQ(a.has_tangent(), b.has_tangent());
    if (!a.has_tangent() || !b.has_tangent()) continue;
    EXPECT_EQ(a.tangent.topLeftCorner(rows, rows), b.tangent.topLeftCorner(rows, rows));
    ++with_tangent;
  }
  return with_tangent;
}

/// Blocks that are handed over have the bits of those that stay, by any number of threads.
template <int Dim>
void expect_the_same_blocks(const Choice& choice, int threads) {
  core::Crew crew(threads);
  SCOPED_TRACE(choice.name);
  Cuts pieces;
  for (int i = 0; i < 220; ++i) pieces.push_back(0.0127 * i + 0.1);
  Carpet<Dim> c = carpet<Dim>(choice, 0.05, five, pieces);
  c.start();
  c.place(along<Dim>(0.1));
  c.step();
  pairing::PairEvaluation<Dim> handing;
  for (const double way : {0.15, 0.4, 0.41}) {
    c.place(along<Dim>(way));
    pairing::evaluate<Dim>(c.pair, c.x, c.state, true, c.now);
    pairing::PairEvaluation<Dim> taken;
    pairing::evaluate<Dim>(c.pair, c.x, c.state, true, handing, {}, nullptr,
                           [&](std::span<const pairing::ContactBlock<Dim>> blocks) {
                             taken.blocks.insert(taken.blocks.end(), blocks.begin(), blocks.end());
                           },
                           {.crew = &crew});
    const std::size_t with_tangent = expect_same_bits<Dim>(taken.blocks, c.now.blocks);
    if (choice.mortar) continue;  // their terms are of other nodes
    EXPECT_GT(with_tangent, 100u);
    for (const pairing::ContactBlock<Dim>& block : handing.blocks)
      EXPECT_EQ(block.tangent.size(), 0);
    EXPECT_GE(c.now.blocks.size(), 220u);
    if (threads == 1) {
      EXPECT_LT(handing.spare.size(), 26u);  // few tangents
    }
    pairing::PairEvaluation<Dim> staying;
    pairing::evaluate<Dim>(c.pair, c.x, c.state, true, staying, {}, nullptr, {}, {.crew = &crew});
    expect_same_bits<Dim>(staying.blocks, c.now.blocks);
  }
}

TEST(SamplingHistory, BlocksMayBeTakenAsSoonAsTheyAreComplete) {
  for (const Choice& choice : choices)
    for (const int threads : {1, 3}) {
      expect_the_same_blocks<2>(choice, threads);
      expect_the_same_blocks<3>(choice, threads);
    }
}

// On smooth facets what belongs to the master's nodes is zero, behind so many nodes of the slave:
// tangents are lent to points with other numbers of them.
TEST(SamplingHistory, LentTangentsOfSmoothMastersKeepTheirZeros) {
  Carpet<3> c;
  pairing::FacetSurface slave;
  Cuts pieces;
  for (int i = 0; i < 40; ++i) pieces.push_back(0.07 * i + 0.1);
  add_sides(c, five, pieces, slave);
  const std::vector<pairing::SurfaceFacet> quads = slave.facets;
  slave.facets.resize(quads.size() / 2);
  for (std::size_t f = quads.size() / 2; f < quads.size(); ++f)
    for (const std::size_t second : {1u, 2u})
      slave.facets.push_back(pairing::surface_facet(
          cell::CellType::tri3, std::array<Index, 3>{quads[f].nodes[0], quads[f].nodes[second],
                                                     quads[f].nodes[second + 1]}));
  pairing::connect(c.pair.master);
  pairing::smooth(c.pair.master, c.x, {pairing::SmoothingKind::hermite, 0.5});
  finish<3>(c, std::move(slave), choices[1], 0.05);
  c.start();
  c.place(along<3>(0.1));
  c.step();
  c.place(along<3>(0.15));
  pairing::evaluate<3>(c.pair, c.x, c.state, true, c.now);
  std::set<int> slave_counts;
  for (const pairing::ContactBlock<3>& block : c.now.blocks)
    if (block.active() && block.without_master) slave_counts.insert(block.slave_count);
  EXPECT_EQ(slave_counts, (std::set<int>{3, 4}));
  pairing::PairEvaluation<3> taken, handing;
  pairing::evaluate<3>(c.pair, c.x, c.state, true, handing, {}, nullptr,
                       [&](std::span<const pairing::ContactBlock<3>> blocks) {
                         taken.blocks.insert(taken.blocks.end(), blocks.begin(), blocks.end());
                       });
  EXPECT_GT(expect_same_bits<3>(taken.blocks, c.now.blocks), 50u);
}

}  // namespace
}  // namespace osculate::testing
