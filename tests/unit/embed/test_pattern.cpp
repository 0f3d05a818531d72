// Places of a tangent that is not evaluated yet: whatever the nodes do within the reach, its
// entries are among them.
#include "pattern_scene.hpp"

namespace osculate {
namespace {

using testing::expect_covered;
using testing::Found;
using testing::made;
using testing::plane;
using testing::refused;
using testing::Sample;
using testing::Scene;
using testing::space;
using testing::trials;
using testing::Way;
using testing::with;

TEST(Pattern, HasAllEntriesWithinTheReachInThePlane) {
  using C = Contact<2>;
  for (const double reach : {0.01, 0.04, 0.15, 0.9}) {
    const double most = reach > 0.01 ? 1 : 0.6;
    expect_covered("line2", plane(1), reach, most);
    expect_covered("line3", plane(2), reach, most);
    expect_covered("line4", plane(3), reach, most);
    expect_covered("gauss",
                   with<2>(plane(1),
                           [](C& c) {
                             c.sampling = {Sampling::Rule::gauss, 3, 1};
                           }),
                   reach, most);
    expect_covered("current area", with<2>(plane(1), [](C& c) { c.weight = Weight::current_area; }),
                   reach, most);
    expect_covered("without friction", with<2>(plane(1), [](C& c) { c.friction.reset(); }), reach,
                   most);
    for (const auto kind : {Smoothing::Kind::hermite, Smoothing::Kind::nurbs})
      expect_covered("smooth", with<2>(plane(1), [&](C& c) { c.smoothing.kind = kind; }), reach,
                     most);
    expect_covered("held",
                   with<2>(plane(1), [](C& c) { c.separation = Separation::no_separation; }), reach,
                   1);
    expect_covered(
        "unknown tractions",
        with<2>(plane(1), [](C& c) { c.enforcement = Enforcement::lagrange_multiplier; }), reach,
        1);
    expect_covered("nodes without facets",
                   with<2>(plane(1),
                           [](C& c) {
                             std::vector<Index>& n = c.slave->points;
                             n = c.slave->facets[0].nodes;
                             std::ranges::sort(n);
                             n.erase(std::unique(n.begin(), n.end()), n.end());
                             c.slave->facets.clear();
                             c.weight = Weight::node;
                             c.friction.reset();
                           }),
                   reach, 1);
    expect_covered("chord", with<2>(plane(1), [](C& c) { c.history = HistoryRule::chord; }), reach,
                   most);
  }
}

TEST(Pattern, HasAllEntriesWithinTheReachInSpace) {
  using C = Contact<3>;
  for (const double reach : {0.01, 0.03, 0.1, 0.7}) {
    const double most = reach > 0.01 ? 1 : 0.5;
    for (const FacetType type :
         {FacetType::tri3, FacetType::tri6, FacetType::quad4, FacetType::quad8, FacetType::quad9})
      expect_covered("facets", space(type), reach, most);
    expect_covered("lobatto",
                   with<3>(space(FacetType::quad4),
                           [](C& c) {
                             c.sampling = {Sampling::Rule::lobatto, 2, 1};
                           }),
                   reach, most);
    expect_covered(
        "hermite",
        with<3>(space(FacetType::quad4), [](C& c) { c.smoothing.kind = Smoothing::Kind::hermite; }),
        reach, 1);
    expect_covered("current area",
                   with<3>(space(FacetType::quad4), [](C& c) { c.weight = Weight::current_area; }),
                   reach, most);
    expect_covered(
        "held",
        with<3>(space(FacetType::quad4), [](C& c) { c.separation = Separation::no_separation; }),
        reach, 1);
  }
}

/// Nodes may move so far that facets turn over, and bounds of normals say nothing.
TEST(Pattern, OfALargeReachIsAsFarAsTheHostPromises) {
  const Scene<2> s = plane(1);
  const Found all = trials(s, Way<2>{{.motion = 0.9}}),
              promised = trials(s, Way<2>{{.motion = 0.9, .distance = 0.5}});
  EXPECT_EQ(all.couplings, all.all);
  EXPECT_GT(promised.entries, 1000u);
  EXPECT_LT(promised.entries, all.entries);
  EXPECT_EQ(promised.outside, 0);
  EXPECT_LT(static_cast<double>(promised.couplings), 0.75 * static_cast<double>(promised.all));
}

TEST(Pattern, OfTiesIsExact) {
  for (const auto rule : {Sampling::Rule::nodes, Sampling::Rule::mortar}) {
    const auto tied = with<3>(space(FacetType::quad4), [&](Contact<3>& c) {
      c.friction.reset();
      c.sampling.rule = rule;
      c.separation = Separation::tied;
      c.tolerance = 0.1;
    });
    const Found found =
        trials(tied, Way<3>{.within = {.motion = 0.2}, .commits = false, .count = 5});
    EXPECT_EQ(found.outside, 0);
    EXPECT_GT(found.entries, 100u);
    EXPECT_LT(found.couplings, found.all / 4);
  }
}

/// Contact with itself: the lips of a slit.
TEST(Pattern, OfASurfaceThatTouchesItself) {
  Scene<2> s;
  Facets line{FacetType::line2, {}};
  std::vector<Index> nodes;
  for (int k = 0; k <= 8; ++k) nodes.push_back(s.node({0.5 * k, -0.02 + 0.01 * k}));
  nodes.push_back(s.node({4.6, 0.1}));
  for (int k = 8; k >= 0; --k) nodes.push_back(s.node({0.5 * k + 0.1, 0.03 - 0.01 * k + 0.1}));
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
    line.nodes.insert(line.nodes.end(), {nodes[k], nodes[k + 1]});
  s.contact.master.facets = {line};
  s.contact.normal = Penalty{100};
  s.contact.friction = Coulomb{.mu = 0.3, .stiffness = 200};
  expect_covered("slit", s, 0.05, 0.8, false);
  s.contact.search_distance = 0.3;
  expect_covered("near", s, 0.08, 0.5, false);
}

TEST(Pattern, OfAShapeIsItsFrame) {
  Scene<3> s = space(FacetType::quad4);
  Scene<3> out;
  for (const std::array<double, 3>& p :
       {std::array{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}})
    out.node({p[0], p[1], p[2]});
  const auto shift = static_cast<Index>(4);
  out.x.insert(out.x.end(), s.x.begin(), s.x.end());
  out.contact = s.contact;
  for (Facets& f : out.contact.slave->facets)
    for (Index& n : f.nodes) n += shift;
  out.contact.master = {};
  out.contact.master.framed.shapes = {Plane{.point = {0, 0, 0.1}, .normal = {0, 0, 1}}};
  out.contact.master.framed.frame = {0, 1, 2, 3};
  expect_covered("plane", out, 0.1, 1);
}

TEST(Pattern, LeavesOutPointsThatStayInFront) {
  Scene<2> s = plane(1);
  for (const Index n : s.contact.slave->facets[0].nodes)
    s.x[static_cast<std::size_t>(2 * n + 1)] = 1.0;
  const Evaluator<2> evaluator(s.contact, s.x);
  const History<2> history = evaluator.initial_history(s.x);
  const auto couplings = [&](double motion, double distance) {
    return evaluator.pattern(s.x, history, {motion, distance}).couplings.size();
  };
  const double all = std::numeric_limits<double>::infinity();
  EXPECT_EQ(couplings(0.05, all), 0u);
  EXPECT_GT(couplings(0.9, all), 0u);
  EXPECT_LT(couplings(0.9, 0.1), couplings(0.9, all));  // a promise of the host's
}

TEST(Pattern, IsRefusedWhereItIsNotKnown) {
  Sample<3> s;
  const auto refusal = [](const Sample<3>& sample, const Reach& reach) {
    const Evaluator<3> e = sample.make();
    const History<3> h = e.initial_history(sample.x);
    return refused([&] { (void)e.pattern(sample.x, h, reach); });
  };
  EXPECT_EQ(refusal(s, {.motion = -1}), "reach: motion must be >= 0, got -1");
  EXPECT_EQ(refusal(s, {.motion = std::nan("")}), "reach: motion must be >= 0, got nan");
  EXPECT_EQ(refusal(s, {.motion = 0, .distance = -1}), "reach: distance must be >= 0, got -1");
  s.contact.sampling.rule = Sampling::Rule::mortar;
  EXPECT_EQ(refusal(s, {.motion = 1}),
            "pattern: what mortar's integrals may reach is not known beforehand");
}

// ---- in a matrix of the host's, and in C --------------------------------------------------------

TEST(Pattern, TakesTheEntriesAsAMatrix) {
  const Sample<2> s;
  const Evaluator<2> e = s.make();
  const History<2> history = e.initial_history(s.x);
  const Pattern p = e.pattern(s.x, history, {.motion = 0.3});
  std::vector<std::int64_t> of(10);
  std::iota(of.begin(), of.end(), 0);
  of[0] = of[1] = 0;  // below the base: held
  const CsrPattern<std::int64_t> places = csr_pattern<std::int64_t>(p, of, of, 9, 1);
  EXPECT_EQ(places.row_start.front(), 1);
  EXPECT_EQ(places.row_start.back() - 1, static_cast<std::int64_t>(places.columns.size()));
  std::vector<double> values(places.columns.size(), 0.0);
  Result<2> r;
  e.evaluate(s.moved(0.29, 0.01), history, {}, r);
  ASSERT_GT(r.tangent().size(), 0u);
  add_entries<std::int64_t>(r.tangent(), {places.row_start, places.columns, values, of, of, 1});
  double sum = 0, expected = 0;
  for (const double v : values) sum += v;
  for (const Entry& entry : r.tangent())
    if (entry.row > 1 && entry.column > 1) expected += entry.value;
  EXPECT_NEAR(sum, expected, 1e-12 * std::abs(expected) + 1e-12);
  EXPECT_EQ(refused([&] { (void)csr_pattern<std::int64_t>(p, of, of, 3, 1); }),
            "the matrix has no row 4");
  EXPECT_EQ(refused([&] { (void)csr_pattern<std::int64_t>(p, std::span(of).first(3), of, 9, 1); }),
            "the maps have 3 and 10 numbers, and there are 10 coordinates");
}

TEST(Pattern, IsTheSameInC) {
  const Sample<2> s;
  const Evaluator<2> e = s.make();
  const Pattern p = e.pattern(s.x, e.initial_history(s.x), {.motion = 0.3, .distance = 5});
  const testing::CHost host(testing::c_sample(s).get(), s.x);
  using CPattern = testing::Handle<osculate_pattern, osculate_pattern_free>;
  const CPattern c = made<CPattern>(osculate_pattern_create, host.evaluator.get(), s.x.data(),
                                    s.x.size(), host.history.get(), 0.3, 5.0);
  const osculate_coupling* couplings = nullptr;
  const std::int32_t *start = nullptr, *list = nullptr;
  std::size_t count = 0;
  ASSERT_EQ(osculate_pattern_couplings(c.get(), &couplings, &count), osculate_ok);
  ASSERT_EQ(count, p.couplings.size());
  ASSERT_GT(count, 0u);
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_EQ(couplings[k].point, p.couplings[k].point);
    EXPECT_EQ(couplings[k].facet, p.couplings[k].facet);
  }
  ASSERT_EQ(osculate_pattern_nodes(c.get(), &start, &list, &count), osculate_ok);
  EXPECT_EQ(std::vector<Index>(start, start + count + 1), p.row_start);
  EXPECT_EQ(std::vector<Index>(list, list + start[count]), p.columns);
  ASSERT_EQ(osculate_pattern_points(c.get(), &start, &list, &count), osculate_ok);
  EXPECT_EQ(std::vector<Index>(start, start + count + 1), p.point_start);
  EXPECT_EQ(std::vector<Index>(list, list + start[count]), p.point_nodes);
  std::vector<std::int32_t> of(10), row_start(11);
  std::iota(of.begin(), of.end(), 0);
  const CsrPattern<std::int32_t> wanted = csr_pattern<std::int32_t>(p, of, of, 10, 0);
  const auto fill = [&](std::int32_t* columns, std::size_t& size) {
    return osculate_pattern_csr(c.get(), of.data(), 10, of.data(), 10, 10, 0, row_start.data(),
                                columns, &size);
  };
  std::size_t size = 0;
  ASSERT_EQ(fill(nullptr, size), osculate_ok);
  std::vector<std::int32_t> columns(size);
  size -= 1;
  EXPECT_EQ(fill(columns.data(), size), osculate_too_small);
  ASSERT_EQ(fill(columns.data(), size), osculate_ok);
  EXPECT_EQ(columns, wanted.columns);
  EXPECT_EQ(row_start, wanted.row_start);
}

}  // namespace
}  // namespace osculate
