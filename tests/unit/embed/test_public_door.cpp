// Every choice on every axis through the public library, in the plane.
#include "public_door.hpp"

namespace osculate {
namespace {

using namespace testing;

/// A slab and a block above it that has sunk in by 0.01; `contact` goes into the pair, `rigid`
/// stands for a master that is no slab.
std::string plane_model(const std::string& contact, const std::string& rigid = "",
                        const std::string& step = "") {
  return R"(osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 4], y: [-1, 0], elements: [5, 1], type: quad4}}
    high: {box: {x: [1.13, 2.97], y: [-0.01, 1], elements: [3, 1], type: quad4}}
sets: {skin: {union: [low.top, high.bottom]}}
materials: {m: {linear_elastic: {E: 1000, nu: 0.3}}}
sections: [{on: low, material: m, element: plane_strain}, {on: high, material: m, element: plane_strain}]
)" + (rigid.empty() ? "" : "rigid: {tool: {" + rigid + "}}\n") +
         "contact: [{name: c, master: " + (rigid.empty() ? "low.top" : "tool") +
         ", slave: high.bottom, sampling: nodes, normal: {penalty: 1000}, friction: {coulomb: {mu: "
         "0.3, penalty: 1000}}" +
         contact + "}]\nsteps: [{name: s, increments: 1, " + step +
         "prescribe: [{on: low.bottom, ux: 0, uy: 0}]}]\n";
}

TEST(PublicDoor, SamplingsInThePlane) {
  using Rule = Sampling::Rule;
  const auto model = [](const char* sampling) {
    return edited(plane_model(""), at_nodes, sampling);
  };
  expect_doors<2>({
      {"nodes", plane_model(""), [](Contact<2>&) {}},
      {"gauss", model("sampling: {gauss: 3}"),
       [](Contact<2>& c) {
         c.sampling = {Rule::gauss, 3, 1};
       }},
      {"lobatto", model("sampling: {lobatto: 2, subdomains: 2}"),
       [](Contact<2>& c) {
         c.sampling = {Rule::lobatto, 2, 2};
       }},
      {"mortar", model("sampling: mortar"), [](Contact<2>& c) { c.sampling.rule = Rule::mortar; }},
  });
}

TEST(PublicDoor, MastersInThePlane) {
  const NurbsCurve hump{.degree = 2,
                        .knots = {0, 0, 0, 1, 1, 1},
                        .control = {{0, 0}, {2, 0.02}, {4, 0}},
                        .weights = {1, 1, 1}};
  expect_doors<2>({
      {"hermite", plane_model(", smoothing: hermite"),
       [](Contact<2>& c) { c.smoothing.kind = Smoothing::Kind::hermite; }},
      {"nurbs spline", plane_model(", smoothing: nurbs"),
       [](Contact<2>& c) { c.smoothing.kind = Smoothing::Kind::nurbs; }},
      {"line",
       plane_model("", "line: {point: [0, 0], normal: [0, 1]}"),
       [](Contact<2>&) {},
       {Line{}},
       {},
       false},
      {"circle",
       plane_model("", "circle: {center: [2, -30], radius: 30}"),
       [](Contact<2>&) {},
       {Circle{{2, -30}, 30}},
       {},
       false},
      {"arc",
       plane_model("", "arc: {center: [2, -30], radius: 30, from: 45, to: 135}"),
       [](Contact<2>&) {},
       {Arc{{2, -30}, 30, std::numbers::pi / 4, 3 * std::numbers::pi / 4}},
       {},
       false},
      {"nurbs curve",
       plane_model(
           "",
           "nurbs: {degree: 2, knots: [0, 0, 0, 1, 1, 1], control: [[0, 0, 1], [2, 0.02, 1], "
           "[4, 0, 1]]}"),
       [](Contact<2>&) {},
       {hump},
       {},
       false},
  });
}

TEST(PublicDoor, OwnSurfaceAndReentrantVertices) {
  const std::string own = edited(edited(edited(plane_model(""), "y: [-0.01, 1]", "y: [0.01, 1]"),
                                        "master: low.top", "master: skin"),
                                 "slave: high.bottom", "slave: skin");
  expect_doors<2>({{"own surface", own, [](Contact<2>&) {}}});
  const std::string groove =
      edited(plane_model(", enforcement: lagrange_multiplier",
                         "polyline: {points: [[0, 0.5], [1.13, -0.005], [4, 0.05]]}"),
             "friction: {" + coulomb + "}", "friction: none");
  expect_doors<2>({{"groove",
                    groove,
                    [](Contact<2>& c) {
                      c.friction.reset();
                      c.enforcement = Enforcement::lagrange_multiplier;
                      c.reentrant_vertices = true;
                    },
                    {},
                    {},
                    false}},
                  false);
}

TEST(PublicDoor, Enforcements) {
  const auto model = [](const char* enforcement) {
    return plane_model(std::string(", enforcement: ") + enforcement);
  };
  const std::string mortar = edited(model("lagrange_multiplier"), at_nodes, "sampling: mortar");
  expect_doors<2>({
      {"augmented", model("augmented_lagrange"),
       [](Contact<2>& c) { c.enforcement = Enforcement::augmented_lagrange; }},
  });
  const auto unknown = [](Contact<2>& c) { c.enforcement = Enforcement::lagrange_multiplier; };
  expect_doors<2>({{"unknown", model("lagrange_multiplier"), unknown},
                   {"unknown by mortar", mortar,
                    [&](Contact<2>& c) {
                      unknown(c);
                      c.sampling.rule = Sampling::Rule::mortar;
                    }}},
                  false);
}

TEST(PublicDoor, FormsAndHistories) {
  expect_doors<2>({
      {"current area", plane_model(", weight: current_area"),
       [](Contact<2>& c) { c.weight = Weight::current_area; }},
      {"weight of a node", plane_model(", weight: node"),
       [](Contact<2>& c) { c.weight = Weight::node; }},
      {"full residual", plane_model(", residual: full"),
       [](Contact<2>& c) { c.residual = ResidualForm::full; }},
      {"chord",
       plane_model(", history: chord"),
       [](Contact<2>& c) { c.history = HistoryRule::chord; },
       {},
       {},
       false},
      {"per facet",
       plane_model(", history: per_facet"),
       [](Contact<2>& c) { c.history = HistoryRule::per_facet; },
       {},
       {},
       false},
      {"the papers' tangent",
       plane_model(", tangent: covariant"),
       [](Contact<2>& c) { c.tangent.consistent = false; },
       {},
       {},
       false},
      {"offset", plane_model(", offset: {master: 0.001, slave: 0.001}"),
       [](Contact<2>& c) { c.offset = 0.002; }},
      {"overlaps let in",
       plane_model(", initial: ramp"),
       [](Contact<2>& c) { c.overlap = InitialOverlap::ramped; },
       {},
       {.relief = 0.4}},
      {"overlaps kept", plane_model(", initial: keep"),
       [](Contact<2>& c) { c.overlap = InitialOverlap::kept; }},
  });
}

TEST(PublicDoor, Laws) {
  const auto normal = [](const std::string& law) {
    return edited(plane_model("", "", "duration: 0.5, "), penalty, "normal: {" + law + "}");
  };
  const auto friction = [](const std::string& law) {
    return edited(plane_model("", "", "duration: 0.5, "), coulomb, law);
  };
  const Increment timed{.duration = 0.5};
  expect_doors<2>({
      {"exponential", normal("exponential: {pressure: 1, clearance: 0.01}"),
       [](Contact<2>& c) {
         c.normal = Exponential{1, 0.01};
       }},
      {"table", normal("table: [[0, 0], [0.01, 5], [0.02, 20]]"),
       [](Contact<2>& c) {
         c.normal = Table{{{0, 0}, {0.01, 5}, {0.02, 20}}};
       }},
      {"restitution", normal("penalty: 1000, damping: {restitution: 0.5}"),
       [](Contact<2>& c) { c.damping = Restitution{0.5}; }},
      {"viscous",
       normal("penalty: 1000, damping: {viscous: 2}"),
       [](Contact<2>& c) { c.damping = Viscous{2}; },
       {},
       timed},
      {"tresca", friction("tresca: {limit: 3, penalty: 1000}"),
       [](Contact<2>& c) {
         c.friction = Tresca{3, 1000};
       }},
      {"by rate and state",
       friction("rate_and_state: {mu: 0.3, a: 0.01, b: 0.02, penalty: 1000, speed: 0.2, distance: "
                "0.01}"),
       [](Contact<2>& c) {
         c.friction = NamedLaw{"rate_and_state",
                               {{"mu", 0.3},
                                {"a", 0.01},
                                {"b", 0.02},
                                {"penalty", 1000},
                                {"speed", 0.2},
                                {"distance", 0.01}}};
       },
       {},
       timed},
      {"laws by name", normal("penalty: 2000, damping: {restitution: 0.7}"),
       [](Contact<2>& c) {
         c.normal = NamedLaw{"penalty", {{"penalty", 2000}}};
         c.damping = NamedLaw{"restitution", {{"restitution", 0.7}}};
       }},
      {"capped", friction("coulomb: {mu: 0.3, penalty: 1000, cap: 2}"),
       [](Contact<2>& c) {
         c.friction = Coulomb{0.3, 1000, 2};
       }},
      {"weakening by the distance",
       friction("coulomb: {mu: 0.3, penalty: 1000, kinetic: 0.1, decay: {distance: 0.02}}"),
       [](Contact<2>& c) {
         c.friction = Coulomb{.mu = 0.3, .stiffness = 1000, .change = FrictionChange{0.1, 0.02}};
       }},
      {"weakening by the speed",
       friction("coulomb: {mu: 0.3, penalty: 1000, kinetic: 0.1, decay: {speed: 0.2}}"),
       [](Contact<2>& c) {
         c.friction =
             Coulomb{.mu = 0.3, .stiffness = 1000, .change = FrictionChange{0.1, 0.2, true}};
       },
       {},
       timed},
  });
  expect_doors<2>({{"rough", friction("rough: {penalty: 1000}"),
                    [](Contact<2>& c) { c.friction = Rough{1000}; }}},
                  false);
}

TEST(PublicDoor, HeldAndTied) {
  const auto model = [](const std::string& separation) {
    return edited(plane_model(""), penalty,
                  "normal: {penalty: 1000, separation: " + separation + "}");
  };
  expect_doors<2>({
      {"no separation", model("no_separation"),
       [](Contact<2>& c) { c.separation = Separation::no_separation; }},
      {"held in the normal direction", model("tied_normal, tolerance: 0.05"),
       [](Contact<2>& c) {
         c.separation = Separation::tied_normal;
         c.tolerance = 0.05;
       }},
  });
  const std::string tied = edited(model("tied, tolerance: 0.05, initial_gap: close"),
                                  ", friction: {" + coulomb + "}", "");
  const auto tie = [](Contact<2>& c) {
    c.friction.reset();
    c.separation = Separation::tied;
    c.tolerance = 0.05;
    c.keep_gap = false;
  };
  expect_doors<2>({{"tied", tied, tie},
                   {"tied by mortar", edited(tied, at_nodes, "sampling: mortar"),
                    [&](Contact<2>& c) {
                      tie(c);
                      c.sampling.rule = Sampling::Rule::mortar;
                    }}},
                  false);
}

/// A point that slides forward and then back within an increment is linearised in stick: the active
/// set takes part in what is compared above.
TEST(PublicDoor, TheActiveSetTakesPart) {
  const Seen seen = drive<2>({"nodes", plane_model(""), [](Contact<2>&) {}});
  EXPECT_GT(seen.branched, 0);
}

}  // namespace
}  // namespace osculate
