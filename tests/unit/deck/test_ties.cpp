// Surfaces tied by equations.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "cube_nodes.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/to_inp.hpp"
#include "space_test.hpp"

namespace osculate::deck {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

template <int Dim>
struct Solved {
  BasicBuilt<Dim> built;
  std::vector<Vec<Dim>> u;
  [[nodiscard]] Vec<Dim> at(const Vec<Dim>& place) const {
    for (std::size_t n = 0; n < u.size(); ++n)
      if ((built.model.reference[n] - place).norm() < 1e-9) return u[n];
    throw std::runtime_error("no node there");
  }
};

template <int Dim>
Solved<Dim> solved(const std::string& text) {
  const Description description = parse_model(text, "model.yaml");
  Solved<Dim> out{std::get<BasicBuilt<Dim>>(build_any(description, load_mesh(description))), {}};
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](model::BasicSystem<Dim>&, const model::BasicState<Dim>& state,
                           const model::Progress&, const solve::IncrementRecord*) {
    out.u.clear();
    for (std::size_t n = 0; n < out.built.model.reference.size(); ++n)
      out.u.emplace_back(state.u.template segment<Dim>(Dim * static_cast<Eigen::Index>(n)));
    return true;
  };
  const auto result = model::run(out.built.model, out.built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  return out;
}

/// A beam along x of two parts or of one, held at its left and bent by a force at its right.
std::string beam(const std::string& type, bool tied, const std::string& extra = "") {
  const bool plane = type.starts_with("quad") || type.starts_with("tri");
  const std::string across = plane ? "y: [0, 1]" : "y: [0, 1], z: [0, 1]";
  const std::string n = plane ? "2" : "2, 2";
  const std::string box = "{{box: {{x: [{}, {}], {}, elements: [{}, {}], type: {}}}}}";
  const auto part = [&](int from, int to) {
    return fmt::format(fmt::runtime(box), from, to, across, 2 * (to - from), n, type);
  };
  const std::string hold = plane ? "ux: 0, uy: 0" : "ux: 0, uy: 0, uz: 0";
  const std::string section =
      fmt::format("material: m, element: {}, kinematics: finite", plane ? "plane_strain" : "solid");
  return fmt::format(
      "osculate: 1\nmesh: {{generate: {{a: {}{}}}}}\n"
      "materials: {{m: {{st_venant_kirchhoff: {{E: 100, nu: 0.3}}}}}}\n"
      "sections: [{{on: a, {}}}{}]\n{}{}"
      "steps:\n  - name: s\n    increments: 2\n    prescribe: [{{on: a.left, {}}}]\n"
      "    traction: [{{on: {}.right, ty: 0.05, tx: 0.02}}]\n"
      "solver: {{tolerance: {{residual: 1e-13, energy: 1e-26}}}}\n",
      part(0, tied ? 2 : 4), tied ? ", b: " + part(2, 4) : "", section,
      tied ? ", {on: b, " + section + "}" : "",
      tied ? "ties: [{slave: b.left, master: a.right}]\n" : "", extra, hold, tied ? "b" : "a");
}

template <int Dim>
void expect_as_whole(const std::string& type) {
  SCOPED_TRACE(type);
  const Solved<Dim> whole = solved<Dim>(beam(type, false)), split = solved<Dim>(beam(type, true));
  ASSERT_LT(whole.u.size(), split.u.size());
  double largest = 0, most = 0;
  for (std::size_t n = 0; n < split.u.size(); ++n) {
    largest = std::max(largest, split.u[n].norm());
    most = std::max(most, (split.u[n] - whole.at(split.built.model.reference[n])).norm());
  }
  EXPECT_GT(largest, 0.05);
  EXPECT_LT(most, 1e-10 * largest);
}

/// Bent far, to rounding, at both sides of the tie.
TEST(Ties, MatchingMeshesAreAsTheWhole) {
  for (const char* const type : {"quad4", "quad8", "tri3", "tri6"}) expect_as_whole<2>(type);
  for (const char* const type : {"hex8", "hex20"}) expect_as_whole<3>(type);
}

const std::string two = R"(osculate: 1
mesh:
  generate:
    a: {box: {x: [0, 2], y: [0, 1], elements: [2, 1], type: quad4}}
    b: {box: {x: [0, 2], y: [1.02, 2], elements: [5, 2], type: quad4}}
materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}
sections: [{on: a, material: m, element: plane_strain}, {on: b, material: m, element: plane_strain}]
ties: [{slave: b.bottom, master: a.top, tolerance: 0.03}]
steps: [{name: s, increments: 1, prescribe: [{on: a.bottom, ux: 0, uy: 0}], pressure: [{on: b.top, value: 1}]}]
)";

/// u = sum N u_k with N of the first order: nodes of the finer side lie on the coarser one's edge.
TEST(Ties, NodesFollowFacets) {
  const Solved<2> run = solved<2>(two);
  for (const double x : {0.0, 0.4, 0.8, 1.2, 2.0}) {
    const double left = std::floor(std::min(x, 1.9)), share = x - left;
    const auto master = [&](double at) {
      for (std::size_t n = 0; n < run.u.size(); ++n)
        if ((run.built.model.reference[n] - Vec2(at, 1)).norm() < 1e-9 && n < 6) return run.u[n];
      throw std::runtime_error("no node there");
    };
    const Vec2 expected = (1 - share) * master(left) + share * master(left + 1);
    const auto& nodes = run.built.model.mesh.find_set("b.bottom")->nodes;
    int found = 0;
    for (const Index n : nodes) {
      const auto k = static_cast<std::size_t>(n);
      if (std::abs(run.built.model.reference[k].x() - x) > 1e-9) continue;
      EXPECT_LT((run.u[k] - expected).norm(), 1e-13);
      EXPECT_NEAR(run.built.model.reference[k].y(), 1, 1e-13) << "moved onto the master";
      ++found;
    }
    EXPECT_EQ(found, 1);
  }
  EXPECT_THAT(run.built.notes, Contains(HasSubstr("6 slave nodes moved onto the master before the "
                                                  "first step, by up to 0.02")));
  EXPECT_THAT(run.built.notes,
              Contains("tie of 'b.bottom' to 'a.top': 6 of 6 nodes are tied (within 0.03)"));
  EXPECT_THAT(run.built.warnings, IsEmpty());
}

TEST(Ties, ACoarseSlaveIsToldOf) {
  const Solved<2> run =
      solved<2>(edited(two, "slave: b.bottom, master: a.top", "slave: a.top, master: b.bottom"));
  EXPECT_THAT(run.built.warnings,
              Contains(HasSubstr("the facets of the slave are 2.5 times as long as those of the "
                                 "master, whose nodes between the slave's are free")));
}

TEST(Ties, NodesStayWhereTheyAreWithoutAdjust) {
  const Solved<2> run = solved<2>(edited(two, "0.03}", "0.03, adjust: false}"));
  for (const Index n : run.built.model.mesh.find_set("b.bottom")->nodes)
    EXPECT_NEAR(run.built.model.reference[static_cast<std::size_t>(n)].y(), 1.02, 1e-13);
  EXPECT_THAT(run.built.notes, Not(Contains(HasSubstr("moved onto"))));
}

/// A support counts, the tie does not, and where the master goes on without it that is told of.
TEST(Ties, WhatIsPrescribedIsNotTied) {
  const Solved<2> run = solved<2>(edited(two, "uy: 0}]", "uy: 0}, {on: b.left, ux: 0.01}]"));
  EXPECT_GT(std::abs(run.at({0, 1}).x() - 0.01), 1e-3) << "the master goes on";
  EXPECT_THAT(run.built.notes, Contains(HasSubstr("1 of their displacements are prescribed and not "
                                                  "tied")));
  EXPECT_THAT(run.built.warnings, Contains(HasSubstr("so that the surfaces part there")));
  // where the master is held as well there is nothing to say
  const Solved<2> held =
      solved<2>(edited(two, "uy: 0}]", "uy: 0}, {on: b.left, ux: 0}, {on: a.left, ux: 0}]"));
  EXPECT_THAT(held.built.warnings, IsEmpty());
}

/// A later step moves the master by its slave, and both are tied before it and in it.
TEST(Ties, WhatALaterStepPrescribesMovesTheMaster) {
  const std::string later = edited(two, "value: 1}]}]",
                                   "value: 1}]}, {name: later, increments: 1, prescribe: [{on: "
                                   "b.bottom_left, uy: 0.01}]}]");
  const Solved<2> before = solved<2>(two), after = solved<2>(later);
  EXPECT_THAT(after.built.notes, Contains("tie of 'b.bottom' to 'a.top': 6 of 6 nodes are tied "
                                          "(within 0.03)"));
  EXPECT_THAT(after.built.warnings, IsEmpty());
  const auto corner = [](const Solved<2>& run, bool slave) {
    const std::vector<Index>& nodes =
        run.built.model.mesh.find_set(slave ? "b.bottom_left" : "a.top_left")->nodes;
    return run.u[static_cast<std::size_t>(nodes.at(0))];
  };
  EXPECT_NEAR(corner(after, true).y(), 0.01, 1e-14);
  for (const Solved<2>* const run : {&before, &after})
    EXPECT_LT((corner(*run, true) - corner(*run, false)).norm(), 1e-13);
  // until then all is as without it
  model::BasicAnalysisObserver<2> observer;
  Eigen::VectorXd first;
  observer.converged = [&](model::System&, const model::State& state, const model::Progress& p,
                           const solve::IncrementRecord* record) {
    if (record && p.step == 0) first = state.u;
    return true;
  };
  (void)model::run(after.built.model, after.built.options, observer);
  for (std::size_t n = 0; n < before.u.size(); ++n)
    EXPECT_LT((first.segment<2>(2 * static_cast<Eigen::Index>(n)) - before.u[n]).norm(), 1e-13);
}

/// Of two ties of a node, or a tie and an equation, the first counts.
TEST(Ties, WhatFollowsAlreadyIsNotTiedAgain) {
  const Solved<2> once = solved<2>(two),
                  twice =
                      solved<2>(edited(two, "0.03}", "0.03}, {slave: b.bottom, master: a.top}"));
  EXPECT_THAT(twice.built.notes, Contains(HasSubstr("12 follow from a rigid body or another "
                                                    "equation and are not tied")));
  EXPECT_EQ(once.built.model.equations.size(), twice.built.model.equations.size());
  const Solved<2> equal = solved<2>(edited(two, "ties:", "equal: [{on: b.bottom, of: uy}]\nties:"));
  const double level = equal.at({0.4, 1}).y();
  for (const Index n : equal.built.model.mesh.find_set("b.bottom")->nodes)
    EXPECT_NEAR(equal.u[static_cast<std::size_t>(n)].y(), level, 1e-13);
}

TEST(Ties, WhatCannotBeTiedIsRefused) {
  expect_refusals(
      two,
      {{"tolerance: 0.03", "tolerance: 0.01",
        "model.yaml:8: ties[0].slave: no node of the slave 'b.bottom' is within 0.01 of the master "
        "'a.top', the nearest is 0.02 away: nothing is tied"},
       {"master: a.top", "master: a.tip",
        "model.yaml:8: ties[0].master: unknown set 'a.tip'; did you mean 'a.top'?"},
       {"master: a.top", "master: b.bottom",
        "model.yaml:8: ties[0]: a surface cannot be tied to itself"},
       {"tolerance: 0.03", "tolerance: -1",
        "model.yaml:8: ties[0].tolerance: must be >= 0, got -1"},
       {"ties:", "rigid: {r: {set: a.top, reference: [0, 1]}}\nties:",
        "model.yaml:9: ties[0].master: the master 'a.top' has nodes of a rigid body: name the "
        "slave's nodes in the set of that body, or use `contact` with `separation: tied`"}});
}

const std::string deck = R"(*NODE
)" + cube_nodes(1, {0, 0, 0}) +
                         cube_nodes(11, {0, 0, 1}) + R"(*ELEMENT, TYPE=C3D8, ELSET=LOW
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=UP
2, 11, 12, 13, 14, 15, 16, 17, 18
*SURFACE, NAME=MASTER
LOW, S2
*SURFACE, NAME=SLAVE
UP, S1
*TIE, NAME=T, POSITION TOLERANCE=0.01, ADJUST=NO
SLAVE, MASTER
*MATERIAL, NAME=M
*ELASTIC
100, 0
*DENSITY
1
*SOLID SECTION, ELSET=LOW, MATERIAL=M
*SOLID SECTION, ELSET=UP, MATERIAL=M
*STEP
*STATIC
*BOUNDARY
1, 1, 3
*END STEP
)";

std::string deck_refusal(const std::string& from, const std::string& to) {
  try {
    (void)translate_deck(edited(deck, from, to), "d.inp");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Ties, OfADeck) {
  const Description d = parse_model(translate_deck(deck, "d.inp").root, "d.inp");
  ASSERT_EQ(d.ties.size(), 1U);
  EXPECT_EQ(d.ties[0].slave.value, "SLAVE");
  EXPECT_EQ(d.ties[0].master.value, "MASTER");
  EXPECT_EQ(d.ties[0].tolerance->value, 0.01);
  EXPECT_FALSE(d.ties[0].adjust);
  const Description usual =
      parse_model(translate_deck(edited(deck, "0.01, ADJUST=NO", "1e-12"), "d.inp").root, "d.inp");
  EXPECT_FALSE(usual.ties[0].tolerance);
  EXPECT_TRUE(usual.ties[0].adjust);
  EXPECT_THAT(deck_refusal("ADJUST=NO", "MULTISTAGE"), HasSubstr("MULTISTAGE is not supported"));
  EXPECT_THAT(deck_refusal("ADJUST=NO", "ADJUST=MAYBE"),
              HasSubstr("expected ADJUST=YES or NO, found MAYBE"));
  EXPECT_THAT(deck_refusal("SLAVE, MASTER", "SLAVE"),
              HasSubstr("*TIE: expected two surfaces, slave and master"));
}

/// Explicit steps know no equations of many displacements: a penalty.
TEST(Ties, OfAnExplicitDeck) {
  const Description d = parse_model(
      translate_deck(edited(deck, "*STATIC\n", "*DYNAMIC, EXPLICIT\n1e-3, 1e-2\n"), "d.inp").root,
      "d.inp");
  EXPECT_TRUE(d.ties.empty());
  ASSERT_EQ(d.contact.size(), 1U);
  EXPECT_EQ(d.contact[0].normal.separation.value, SeparationWord::tied);
}

TEST(Ties, AreWrittenAsCards) {
  const auto written = [](const std::string& text) {
    const Description description = parse_model(text, "model.yaml");
    return write_deck(description, build_any(description, load_mesh(description))).text;
  };
  EXPECT_THAT(written(edited(two, ", pressure: [{on: b.top, value: 1}]", "")),
              HasSubstr("*TIE, NAME=tie_1, POSITION TOLERANCE=0.03\nb.bottom, a.top\n"));
  EXPECT_THAT(written(edited(edited(two, ", pressure: [{on: b.top, value: 1}]", ""), "0.03}",
                             "0.03, adjust: false}")),
              HasSubstr("*TIE, NAME=tie_1, POSITION TOLERANCE=0.03, ADJUST=NO\n"));
}

}  // namespace
}  // namespace osculate::deck
