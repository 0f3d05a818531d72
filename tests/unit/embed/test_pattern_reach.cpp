// How far the places of a tangent reach: not farther than is said, and far enough where a point's
// history counts.
#include "pattern_scene.hpp"

namespace osculate {
namespace {

using testing::compare;
using testing::expect_covered;
using testing::Found;
using testing::moved;
using testing::plane;
using testing::Scene;
using testing::space;
using testing::trials;
using testing::Way;
using testing::with;

// ---- not farther --------------------------------------------------------------------------------

/// Distance of a point from the box of a facet's nodes.
template <int Dim>
double distance(const std::vector<double>& x, std::span<const Index> facet,
                const std::array<double, Dim>& point) {
  double sum = 0;
  for (std::size_t i = 0; i < Dim; ++i) {
    double lo = std::numeric_limits<double>::infinity(), hi = -lo;
    for (const Index n : facet) {
      lo = std::min(lo, x[Dim * static_cast<std::size_t>(n) + i]);
      hi = std::max(hi, x[Dim * static_cast<std::size_t>(n) + i]);
    }
    const double out = std::max({lo - point[i], point[i] - hi, 0.0});
    sum += out * out;
  }
  return std::sqrt(sum);
}

/// At least the distance of a point from a line or a square: that of the nearest of some places.
template <int Dim>
double sampled_distance(const std::vector<double>& x, std::span<const Index> facet,
                        const std::array<double, Dim>& point) {
  constexpr int steps = 10;
  double least = std::numeric_limits<double>::infinity();
  for (int a = 0; a <= steps; ++a)
    for (int b = 0; b <= (Dim == 3 ? steps : 0); ++b) {
      const double u = a / double(steps), v = b / double(steps);
      const std::array<double, 4> line{1 - u, u, 0, 0},
          square{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
      double sum = 0;
      for (std::size_t i = 0; i < Dim; ++i) {
        double at = -point[i];
        for (std::size_t k = 0; k < facet.size(); ++k)
          at += (Dim == 3 ? square : line)[k] * x[Dim * static_cast<std::size_t>(facet[k]) + i];
        sum += at * at;
      }
      least = std::min(least, std::sqrt(sum));
    }
  return least;
}

/// All couplings are with facets within `D + 4 d` of the point now, or that share a node with one
/// of those; D: the promise, or where normals are bounded the distance of the nearest facet and 3
/// d more. So is every node that a point may depend on.
///
/// 4 d: the point moves by d, and a facet's places by up to 1.44 d, in each direction of a box.
/// That is continued by a tenth of the facet beyond its borders.
template <int Dim>
double facets_a_point(const Scene<Dim>& s, const Reach& within, std::size_t per_facet) {
  const Evaluator<Dim> evaluator(s.contact, s.x);
  const Pattern p = evaluator.pattern(s.x, evaluator.initial_history(s.x), within);
  const std::vector<Index>& all = s.contact.master.facets[0].nodes;
  const std::size_t facets = all.size() / per_facet;
  const auto nodes = [&](std::size_t f) {
    return std::span(all).subspan(per_facet * f, per_facet);
  };
  const auto points = evaluator.slave_points();
  std::vector<std::set<Index>> allowed(points.size()), allowed_nodes(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<double, Dim> at{};
    for (std::size_t k = 0; k < points[i].nodes.size(); ++k)
      for (std::size_t j = 0; j < Dim; ++j)
        at[j] += points[i].shape[k] * s.x[Dim * static_cast<std::size_t>(points[i].nodes[k]) + j];
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < facets; ++f)
      nearest = std::min(nearest, sampled_distance<Dim>(s.x, nodes(f), at));
    const double most =
        std::min(within.distance, nearest + 3 * within.motion) + 4 * within.motion + 0.15 * s.facet;
    std::set<Index> near;
    for (std::size_t f = 0; f < facets; ++f)
      if (distance<Dim>(s.x, nodes(f), at) <= most) near.insert(nodes(f).begin(), nodes(f).end());
    for (std::size_t f = 0; f < facets; ++f) {
      if (std::ranges::none_of(nodes(f), [&](Index n) { return near.contains(n); })) continue;
      allowed[i].insert(static_cast<Index>(f));
      allowed_nodes[i].insert(nodes(f).begin(), nodes(f).end());
    }
    allowed_nodes[i].insert(points[i].nodes.begin(), points[i].nodes.end());
    EXPECT_LT(allowed[i].size(), facets);  // so that the bound says something
  }
  for (const Coupling& c : p.couplings)
    EXPECT_TRUE(allowed[static_cast<std::size_t>(c.point)].contains(c.facet))
        << "point " << c.point << ", facet " << c.facet;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (Index k = p.point_start[i]; k < p.point_start[i + 1]; ++k) {
      const Index n = p.point_nodes[static_cast<std::size_t>(k)];
      EXPECT_TRUE(allowed_nodes[i].contains(n)) << "point " << i << ", node " << n;
    }
  return static_cast<double>(p.couplings.size()) / static_cast<double>(points.size());
}

TEST(Pattern, OfALargeReachIsNotAllToAll) {
  const auto gauss = [](auto& c) { c.sampling = {Sampling::Rule::gauss, 2, 1}; };
  for (const double reach : {0.9, 2.5}) {
    SCOPED_TRACE(reach);
    const Reach within{.motion = reach, .distance = 0.2};
    EXPECT_LT(facets_a_point(plane(1, 60), within, 2), 2 * (0.2 + 4 * reach) + 5);
    EXPECT_LT(facets_a_point(with<2>(plane(1, 60), gauss), within, 2), 2 * (0.2 + 4 * reach) + 5);
  }
  const Reach half{.motion = 0.5, .distance = 0.1};
  EXPECT_LT(facets_a_point(space(FacetType::quad4, 14), half, 4), 0.5 * 14 * 14);
  EXPECT_LT(facets_a_point(with<3>(space(FacetType::quad4, 14), gauss), half, 4), 0.5 * 14 * 14);
}

TEST(Pattern, IsAsFarAsTheNearestFacetWhereNormalsAreBounded) {
  for (const double reach : {0.02, 0.1}) {
    SCOPED_TRACE(reach);
    EXPECT_LT(facets_a_point(plane(1), {.motion = reach}, 2), 6);
    EXPECT_LT(facets_a_point(space(FacetType::quad4), {.motion = reach / 2}, 4), 18);
  }
}

// ---- far enough ---------------------------------------------------------------------------------

/// A block whose lower side has nodes at these places, descending to its left corner, and a slave
/// deep inside it, nearer to the block's left side: its first node keeps the lower side, through
/// which it came.
Scene<2> corner_of_a_block(const std::vector<double>& lower, double at) {
  Scene<2> s;
  Facets line{FacetType::line2, {}};
  std::vector<Index> nodes;
  for (const double x : lower) nodes.push_back(s.node({x, 0.0}));
  for (const double up : {2.0, 4.0}) nodes.push_back(s.node({0.0, up}));
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
    line.nodes.insert(line.nodes.end(), {nodes[k], nodes[k + 1]});
  s.contact.master.facets = {line};
  s.contact.slave.emplace();
  const Index a = s.node({at, 2.5}), b = s.node({at + 1, 2.5});
  s.contact.slave->facets = {{FacetType::line2, {a, b}}};
  s.contact.normal = Penalty{100};
  return s;
}
/// Short ones.
Scene<2> corner_of_a_block() {
  std::vector<double> lower;
  for (int k = 40; k >= 0; --k) lower.push_back(0.05 * k);
  return corner_of_a_block(lower, 0.325);
}

/// With the slave moved along the first axis and another one.
template <int Dim>
std::vector<double> shifted(const Scene<Dim>& s, double along, double up, int axis = 1) {
  std::vector<double> x = s.x;
  const std::vector<Index>& facets = s.contact.slave->facets[0].nodes;
  for (const Index n : std::set<Index>(facets.begin(), facets.end())) {
    x[static_cast<std::size_t>(Dim * n)] += along;
    x[static_cast<std::size_t>(Dim * n + axis)] += up;
  }
  return x;
}

/// Layers of a scene in the plane, `height` apart: lines become squares.
Scene<3> extruded(const Scene<2>& flat, int layers, double height) {
  Scene<3> s;
  const auto nodes = static_cast<Index>(flat.x.size() / 2);
  for (int k = 0; k <= layers; ++k)
    for (std::size_t n = 0; n < flat.x.size(); n += 2)
      s.node({flat.x[n], flat.x[n + 1], height * k});
  const auto sheet = [&](const Facets& line) {
    Facets out{FacetType::quad4, {}};
    for (Index k = 0; k < layers; ++k)
      for (std::size_t l = 0; l < line.nodes.size(); l += 2) {
        const Index a = line.nodes[l] + k * nodes, b = line.nodes[l + 1] + k * nodes;
        out.nodes.insert(out.nodes.end(), {a, a + nodes, b + nodes, b});
      }
    return out;
  };
  s.contact.master.facets = {sheet(flat.contact.master.facets[0])};
  s.contact.slave.emplace();
  s.contact.slave->facets = {sheet(flat.contact.slave->facets[0])};
  s.contact.normal = flat.contact.normal;
  return s;
}

/// Slides over `count` facets, one after the other: each is beside that of the history.
void expect_kept(const Scene<2>& s, double reach, double step, std::size_t count) {
  const Evaluator<2> evaluator(s.contact, s.x);
  History<2> history = evaluator.initial_history(shifted(s, 0, -2.6));
  const Pattern p = evaluator.pattern(s.x, history, {.motion = reach});
  Found found;
  Result<2> r;
  for (double along = 0; along < reach; along += step) {
    evaluator.evaluate(shifted(s, along, 0), history, {}, r);
    EXPECT_LT(r.points()[0].normal_traction, 0);
    compare(evaluator, p, std::numeric_limits<double>::infinity(), r, found);
    history = r.committed();
  }
  EXPECT_EQ(found.outside, 0) << "of " << found.entries;
  std::set<Index> facets;
  for (const auto& [point, facet] : found.facets)
    if (point == 0) facets.insert(facet);
  EXPECT_EQ(facets.size(), count);
}
TEST(Pattern, FollowsAPointAlongTheSideThatItCameThrough) {
  expect_kept(corner_of_a_block(), 0.15, 0.048, 4);
}
TEST(Pattern, FollowsAPointOverAShortFacetToALongOne) {
  expect_kept(corner_of_a_block({2.0, 1.0, 0.402, 0.4, 0.0}, 0.3995), 0.004, 0.0015, 3);
}

/// Nodes that each go their own way turn the short facets, and move feet on them by far more.
/// Committed is what leaves the first point on the lower side.
template <int Dim>
void expect_followed(Scene<Dim> s, int lower, int count) {
  for (const bool friction : {false, true}) {
    SCOPED_TRACE(friction);
    if (friction) s.contact.friction = Coulomb{.mu = 0.3, .stiffness = 200};
    const Evaluator<Dim> evaluator(s.contact, s.x);
    History<Dim> history = evaluator.initial_history(shifted(s, 0, -2.6));
    const Pattern p = evaluator.pattern(s.x, history, {.motion = 0.005});
    Found found;
    Result<Dim> r;
    testing::Random random;
    std::set<Index> facets;
    for (int t = 0; t < count; ++t) {
      const std::vector<double> x = moved(s, s.x, 0.005, random, false);
      evaluator.evaluate(x, history, evaluator.predicted(history, x), {}, r);
      compare(evaluator, p, std::numeric_limits<double>::infinity(), r, found);
      if (r.points()[0].facet >= lower) continue;
      history = r.committed();
      facets.insert(r.points()[0].facet);
    }
    EXPECT_EQ(found.outside, 0) << "of " << found.entries;
    EXPECT_GT(found.entries, 1000u);
    EXPECT_GT(facets.size(), 5u);  // more than the one it began on and those beside it
    EXPECT_LT(10 * p.couplings.size(),
              9 * evaluator.slave_points().size() * testing::facet_count(s.contact.master));
  }
}
TEST(Pattern, FollowsAPointOverFacetsThatTurn) { expect_followed(corner_of_a_block(), 40, 600); }
TEST(Pattern, FollowsAPointOverFacetsThatTurnInSpace) {
  expect_followed(extruded(corner_of_a_block(), 1, 0.8), 40, 600);
}

/// Some are deeper than they may be, some not.
template <int Dim>
void expect_shallow(Scene<Dim> s, double reach, double most) {
  s.contact.depth = 0.2;
  s.x = shifted(s, 0, -0.16, Dim - 1);
  for (const bool friction : {true, false}) {
    SCOPED_TRACE(friction);
    if (!friction) s.contact.friction.reset();
    expect_covered("shallow", s, reach, most);
  }
}
TEST(Pattern, OfPointsThatMayNotBeDeep) {
  for (const double reach : {0.01, 0.04, 0.15}) {
    SCOPED_TRACE(reach);
    expect_shallow(plane(1), reach, reach > 0.04 ? 1 : 0.6);
    expect_shallow(space(FacetType::quad4), 0.6 * reach, reach > 0.04 ? 1 : 0.6);
  }
}

/// By a search distance a pattern is of one history: the host asks anew after each commit. Points
/// have a place at first, or come from where they see none.
template <int Dim>
void expect_near(Scene<Dim> s, double reach) {
  s.contact.search_distance = 0.4;
  for (const bool placed : {true, false}) {
    SCOPED_TRACE(placed);
    const std::vector<double> from = shifted(s, 0, placed ? 0.0 : 1.0, Dim - 1);
    if (!placed) s.x = shifted(s, 0, -0.07, Dim - 1);
    const Found found =
        trials(s, Way<Dim>{.within = {.motion = reach}, .renewed = true, .from = from});
    EXPECT_EQ(found.outside, 0) << "of " << found.entries;
    EXPECT_GT(found.entries, 1000u);
    EXPECT_LT(4 * found.couplings, 3 * found.all);
  }
}
TEST(Pattern, ByASearchDistanceIsAskedForAfterEachCommit) {
  for (const double reach : {0.01, 0.02, 0.1, 0.3}) {
    SCOPED_TRACE(reach);
    for (const bool friction : {true, false}) {
      const auto chosen = [&](auto& c) {
        if (!friction) c.friction.reset();
      };
      expect_near(with<2>(plane(1, 30), chosen), reach);
      expect_near(with<3>(space(FacetType::quad4, 14), chosen), reach);
    }
  }
}

/// A flat master of facets of one length, and a slave line behind it.
Scene<2> flat(double facet, double deep) {
  Scene<2> s;
  s.facet = facet;
  Facets line{FacetType::line2, {}};
  for (Index k = 0; k <= 40; ++k) s.node({facet * (k - 20), 0.0});
  for (Index k = 0; k < 40; ++k) line.nodes.insert(line.nodes.end(), {k, k + 1});
  s.contact.master.facets = {line};
  s.contact.slave.emplace();
  const Index a = s.node({5.4 * facet, -deep}), b = s.node({-5.4 * facet, -deep});
  s.contact.slave->facets = {{FacetType::line2, {a, b}}};
  s.contact.normal = Penalty{100};
  return s;
}

/// Both sides go the whole reach, in opposite directions.
void expect_apart(const Scene<2>& s, const Reach& within) {
  const Evaluator<2> evaluator(s.contact, s.x);
  const History<2> history = evaluator.initial_history(s.x);
  const Pattern p = evaluator.pattern(s.x, history, within);
  const double d = 0.999 * within.motion;
  Result<2> at_rest, r;
  evaluator.evaluate(s.x, history, {}, at_rest);
  for (const double way : {-d, d}) {
    std::vector<double> x = shifted(s, 2 * way, 0);
    for (std::size_t k = 0; k < x.size(); k += 2) x[k] -= way;
    evaluator.evaluate(x, history, {}, r);
    Found found;
    compare(evaluator, p, within.distance, r, found);
    EXPECT_EQ(found.contacts, 2);
    EXPECT_EQ(found.outside, 0) << "of " << found.entries;
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_EQ(std::abs(r.points()[i].facet - at_rest.points()[i].facet),
                std::lround(2 * within.motion / s.facet));
  }
  const double place = std::min(within.distance, s.contact.depth) + 2 * within.motion;
  EXPECT_LE(static_cast<double>(p.couplings.size()), 2 * (2 * (place / s.facet + 0.1) + 4));
}
TEST(Pattern, OfSidesThatGoApart) {
  expect_apart(flat(0.025, 0.01), {.motion = 0.1, .distance = 0.02});
  Scene<2> deep = flat(0.05, 0.15);
  deep.contact.depth = 0.2;
  expect_apart(deep, {.motion = 0.1});
}
/// Facets far shorter than the point is deep.
TEST(Pattern, OfSidesThatGoApartDeep) {
  Scene<2> s = flat(0.01, 0.07);
  s.contact.depth = 0.08;
  expect_apart(s, {.motion = 0.02});
}

/// A promise of the host's holds for points in contact: they may have been farther away before.
TEST(Pattern, OfPointsThatComeFromAfar) {
  for (const double reach : {0.3, 0.9}) {
    SCOPED_TRACE(reach);
    Scene<2> s = plane(1, 60);
    s.x = shifted(s, 0, 0.6 * reach);
    const Found found =
        trials(s, Way<2>{.within = {.motion = reach, .distance = 0.1}, .count = 400});
    EXPECT_EQ(found.outside, 0) << "of " << found.entries;
    EXPECT_GT(found.entries, 1000u);
  }
}

/// Teeth, and a slave whose nodes are in the valleys between them.
Scene<2> teeth() {
  Scene<2> s;
  Facets line{FacetType::line2, {}}, slave{FacetType::line2, {}};
  for (int k = 0; k <= 12; ++k) s.node({0.5 * k, k % 2 == 1 ? 0.3 : 0.0});
  for (Index k = 0; k < 12; ++k) line.nodes.insert(line.nodes.end(), {k, k + 1});
  Index last = s.node({4.0, 0.01});
  for (const double at : {3.02, 2.0}) {
    const Index next = s.node({at, -0.005});
    slave.nodes.insert(slave.nodes.end(), {last, next});
    last = next;
  }
  s.contact.master.facets = {line};
  s.contact.slave.emplace();
  s.contact.slave->facets = {slave};
  s.contact.normal = Penalty{100};
  return s;
}

template <int Dim>
void expect_held_in_valleys(Scene<Dim> s, double reach, double most) {
  s.contact.enforcement = Enforcement::lagrange_multiplier;
  s.contact.reentrant_vertices = true;
  for (const bool friction : {false, true}) {
    SCOPED_TRACE(friction);
    if (friction) s.contact.friction = Coulomb{.mu = 0.3, .stiffness = 200};
    const Found found = trials(s, Way<Dim>{.within = {.motion = reach}, .count = 60});
    EXPECT_EQ(found.outside, 0) << "of " << found.entries;
    EXPECT_GT(found.entries, 1000u);
    EXPECT_GT(found.at_borders, 20);
    EXPECT_LE(static_cast<double>(found.couplings), most * static_cast<double>(found.all));
  }
}
TEST(Pattern, OfValleys) {
  for (const double reach : {0.01, 0.05, 0.2})
    expect_held_in_valleys(teeth(), reach, reach > 0.05 ? 1 : 0.6);
}
/// Edges of 0.1: within a reach a point slides over several.
TEST(Pattern, OfValleysInSpace) {
  for (const double reach : {0.01, 0.05, 0.2})
    expect_held_in_valleys(extruded(teeth(), 6, 0.1), reach, 1);
}

}  // namespace
}  // namespace osculate
