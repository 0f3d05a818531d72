// What does not go together, and what cannot be, is refused with one sentence.
#include <limits>

#include "samples.hpp"

namespace osculate {
namespace {

using testing::refusal_of;
using testing::refused;
using testing::Sample;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <int Dim>
void expect_refusals(
    std::initializer_list<std::pair<std::function<void(Sample<Dim>&)>, const char*>> all) {
  EXPECT_EQ(refusal_of<Dim>([](Sample<Dim>&) {}), "");
  for (const auto& [change, why] : all) EXPECT_EQ(refusal_of<Dim>(change), why);
}

TEST(Refusals, ListsAndCoordinates) {
  using S = Sample<2>;
  expect_refusals<2>({
      {[](S& s) { s.contact.master.facets[0].nodes.pop_back(); },
       "master: 3 node numbers are no whole number of facets of 2"},
      {[](S& s) { s.contact.master.facets.clear(); }, "master: it has neither facets nor a shape"},
      {[](S& s) { s.contact.slave->facets.clear(); }, "slave: it has neither facets nor points"},
      {[](S& s) { s.contact.slave->facets[0].type = FacetType::tri3; },
       "slave: facets are lines, not tri3"},
      {[](S& s) { s.contact.master.facets[0].nodes[3] = 5; }, "master: node 5 does not exist"},
      {[](S& s) { s.contact.slave->facets[0].nodes[0] = -1; }, "slave: node -1 does not exist"},
      {[](S& s) { s.contact.master.facets[0].nodes[1] = 0; }, "master: facet 0 names node 0 twice"},
      {[](S& s) { s.contact.slave->facets[0].nodes[0] = 2; }, "node 2 is on master and slave"},
      {[](S& s) { s.x[5] = nan; }, "the coordinates of node 2 are not finite"},
      {[](S& s) { s.x.push_back(1); }, "11 coordinates are no pairs of x and y"},
      {[](S& s) { s.x[6] = s.x[8], s.x[7] = s.x[9]; },
       "slave: a slave node has no positive tributary area; use weight: node"},
      {[](S& s) {
         s.contact.factors = {{1, 1}};
       },
       "factors: 1 given, and the slave has 2 points"},
  });
  using T = Sample<3>;
  expect_refusals<3>({
      {[](T& s) { s.contact.master.facets[0].type = FacetType::line2; },
       "master: facets are tri3, tri6, quad4, quad8 or quad9, not line2"},
      {[](T& s) { s.contact.slave->facets[0].nodes[2] = 6; }, "slave: facet 0 names node 6 twice"},
      {[](T& s) { s.x.push_back(1); }, "31 coordinates are no triples of x, y, z"},
  });
}

TEST(Refusals, Shapes) {
  using S = Sample<2>;
  const auto framed = [](S& s, const CurveShape& shape) {
    s.contact.master.facets.clear();
    s.contact.master.framed = {{shape}, false, {0, 1, 2}};
  };
  expect_refusals<2>({
      {[&](S& s) { framed(s, Circle{.radius = 0}); },
       "master: circle: radius: expected a number > 0, found 0"},
      {[&](S& s) { framed(s, Circle{}), s.contact.master.framed.frame[1] = 0; },
       "master: the frame names node 0 twice"},
      {[&](S& s) {
         framed(s, Circle{}), s.contact.master.facets = {{FacetType::line2, {0, 1}}};
       },
       "master: facets and shapes are surfaces of two contacts"},
      {[&](S& s) { framed(s, Circle{}), s.contact.slave.reset(); },
       "a shape has no points to touch itself with"},
      {[&](S& s) { framed(s, Circle{}), s.contact.sampling.rule = Sampling::Rule::mortar; },
       "mortar takes sides with nodes, and other samplings any master"},
      {[&](S& s) { framed(s, Circle{}), s.contact.smoothing.kind = Smoothing::Kind::hermite; },
       "an analytic shape needs no smoothing"},
      {[&](S& s) {
         s.contact.slave->framed = {{Circle{}}, false, {0, 1, 2}};
       },
       "slave: a shape has no points to be a slave"},
  });
}

TEST(Refusals, NumbersAndLaws) {
  using S = Sample<2>;
  expect_refusals<2>({
      {[](S& s) { s.contact.normal = Penalty{}; }, "normal_penalty must be > 0, got 0"},
      {[](S& s) { s.contact.normal = Penalty{nan}; }, "normal_penalty must be > 0, got nan"},
      {[](S& s) {
         s.contact.friction = Coulomb{-0.1, 200};
       },
       "friction_coulomb: mu must be >= 0, got -0.1"},
      {[](S& s) { s.contact.damping = Restitution{2}; },
       "damping_restitution must be >= 0 and <= 1, got 2"},
      {[](S& s) { s.contact.area.thickness = 0; }, "area.thickness must be > 0, got 0"},
      {[](S& s) { s.contact.offset = -1; }, "offset must be >= 0, got -1"},
      {[](S& s) { s.contact.part = nan; }, "part must be > 0, got nan"},
      {[](S& s) {
         s.contact.factors = {{1, 1}, {0, 1}};
       },
       "factors must be > 0, got 0 and 1"},
      {[](S& s) {
         s.contact.sampling = {Sampling::Rule::gauss, 21, 1};
       },
       "sampling needs 1 to 20 Gauss or 2 to 20 Lobatto points and subdomains >= 1, got 21 and 1"},
      {[](S& s) {
         s.contact.normal = Exponential{1, 1}, s.contact.separation = Separation::no_separation;
       },
       "holding points needs a stiffness in tension: it goes with penalty only"},
      {[](S& s) {
         s.contact.damping = Restitution{}, s.contact.separation = Separation::no_separation;
       },
       "points that are held do not part, and an impact of theirs has no end: damping goes with "
       "separation: allowed only"},
      {[](S& s) { s.contact.separation = Separation::tied; },
       "tied points do not slide: leave out friction, or use rough, whose penalty is their "
       "stiffness along the master"},
  });
}

TEST(Refusals, LawsByName) {
  using S = Sample<2>;
  const auto friction = [](NamedLaw law) { return [law](S& s) { s.contact.friction = law; }; };
  expect_refusals<2>({
      {friction({"colomb", {}}), "unknown law 'colomb'; did you mean 'coulomb'?"},
      {friction({"tresca", {{"limit", 1}}}), "tresca: penalty is missing"},
      {friction({"tresca", {{"limit", 1}, {"penalty", 1}, {"mu", 1}}}),
       "tresca: unknown number 'mu'; known: limit, penalty"},
      {friction({"tresca", {{"limit", -1}, {"penalty", 1}}}),
       "friction_tresca: limit must be >= 0, got -1"},
      {friction({"rough", {{"penalty", 1}}, {{0, 0}}}),
       "rough: it is no table, points mean nothing"},
      {[](S& s) {
         s.contact.normal = NamedLaw{"table", {}};
       },
       "table: points are missing"},
  });
}

TEST(Refusals, Enforcements) {
  using S = Sample<3>;
  const auto unknown = [](S& s) { s.contact.enforcement = Enforcement::lagrange_multiplier; };
  expect_refusals<3>({
      {[&](S& s) {
         unknown(s), s.contact.normal = Exponential{1, 1};
       },
       "a law that gives the pressure as a function of the gap is met by itself: use penalty"},
      {[&](S& s) { unknown(s), s.contact.damping = Viscous{1}; },
       "damping is a part of the spring that a penalty is, and corrected or unknown tractions have "
       "none: use penalty, or leave out damping"},
      {[&](S& s) { unknown(s), s.contact.slave.reset(); },
       "with both sides as slaves there are more unknown tractions than nodes that could carry "
       "them: use penalty or augmented_lagrange"},
      {[&](S& s) { unknown(s), s.contact.sampling.rule = Sampling::Rule::gauss; },
       "facets have more quadrature points than nodes, so their tractions cannot all be unknown: "
       "use sampling: nodes or mortar, or augmented_lagrange"},
      {[&](S& s) { unknown(s), s.contact.residual = ResidualForm::full; },
       "unknown tractions have the form surface only: without penetration there is no other"},
      {[&](S& s) { unknown(s), s.contact.tangent.consistent = false; },
       "unknown tractions have the consistent tangent only"},
      {[&](S& s) { unknown(s), s.contact.edge_angle = 1; },
       "edge-edge contacts come and go: they are enforced by penalty only"},
      {[&](S& s) { unknown(s), s.contact.reentrant_vertices = true, s.contact.offset = 0.1; },
       "re-entrant vertices and edges hold points at nodes whose tractions are unknown, and "
       "without separation, offset or overlaps that do not count"},
      {[&](S& s) { s.contact.reentrant_vertices = true; },
       "re-entrant vertices and edges hold points at nodes whose tractions are unknown, and "
       "without separation, offset or overlaps that do not count"},
  });
}

TEST(Refusals, Samplings) {
  using S = Sample<3>;
  const auto mortar = [](S& s) { s.contact.sampling.rule = Sampling::Rule::mortar; };
  const auto gauss = [](S& s) { s.contact.sampling.rule = Sampling::Rule::gauss; };
  expect_refusals<3>({
      {[&](S& s) { gauss(s), s.contact.slave.reset(); },
       "contact of a surface with itself is sampled at nodes only"},
      {[&](S& s) { gauss(s), s.contact.search_distance = 1; },
       "a search distance goes with sampling at nodes only"},
      {[&](S& s) { gauss(s), s.contact.edge_angle = 1; },
       "contact of edges goes with sampling: nodes only"},
      {[&](S& s) { s.contact.edge_angle = 1, s.contact.smoothing.kind = Smoothing::Kind::hermite; },
       "edges and smoothing exclude each other"},
      {[&](S& s) { s.contact.smoothing.kind = Smoothing::Kind::nurbs; },
       "smoothing by nurbs is for the plane: in space take hermite"},
      {[&](S& s) { mortar(s), s.contact.weight = Weight::node; },
       "mortar integrates over areas: use reference_area or current_area"},
      {[&](S& s) { mortar(s), s.contact.residual = ResidualForm::full; },
       "mortar has its own form of the forces: use surface"},
      {[&](S& s) { mortar(s), s.contact.tangent.consistent = false; },
       "mortar has the consistent tangent only"},
      {[&](S& s) { mortar(s), s.contact.history = HistoryRule::chord; },
       "mortar has its own history, without borders: use continuous"},
      {[&](S& s) { mortar(s), s.contact.overlap = InitialOverlap::kept; },
       "mortar knows initial overlaps only as they are: use adjust"},
      {[&](S& s) { mortar(s), s.contact.slave->points = {6}; },
       "mortar integrates over facets, and the slave is a set of points"},
  });
}

TEST(Refusals, Calls) {
  Sample<2> s;
  s.contact.damping = Viscous{1};
  const Evaluator<2> contact = s.make();
  const History<2> history = contact.initial_history(s.x);
  Result<2> r;
  const auto call = [&](const std::vector<double>& x, const Increment& increment) {
    return refused([&] { contact.evaluate(x, history, {}, r, increment); });
  };
  EXPECT_EQ(call(s.x, {.duration = 1}), "");
  EXPECT_EQ(call(s.x, {}), "a law by speed asks for the duration of the increment");
  EXPECT_EQ(call(s.x, {.duration = -1}), "duration must be >= 0, got -1");
  EXPECT_EQ(call(s.x, {.duration = 1, .relief = 2}), "relief lies between 0 and 1, got 2");
  std::vector<double> x = s.x;
  x.pop_back();
  EXPECT_EQ(call(x, {.duration = 1}), "9 coordinates given, 10 expected");
  x.push_back(std::numeric_limits<double>::infinity());
  EXPECT_EQ(call(x, {.duration = 1}), "the coordinates of node 4 are not finite");
}

}  // namespace
}  // namespace osculate
