// Analyses in space from the text of a model file to forces and displacements.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"

namespace osculate::deck {
namespace {

using model::State3;
using model::System3;

Built3 build_space(const std::string& text) {
  const Description description = parse_model(text, "model.yaml");
  return build3(description, load_mesh(description));
}

/// Values of the columns of the history after every increment, the last row at the end.
struct Table {
  std::vector<std::vector<double>> rows;
  model::AnalysisResult3 result;
};

Table run_space(const Built3& built) {
  Table table;
  model::AnalysisObserver3 observer;
  observer.converged = [&](System3& system, const State3& state, const model::Progress&,
                           const solve::IncrementRecord* record) {
    if (!record) return true;
    std::vector<double> row;
    for (const model::HistoryRequest& request : built.history)
      row.push_back(model::history_value(system, built.model, state, request));
    table.rows.push_back(std::move(row));
    return true;
  };
  table.result = model::run(built.model, built.options, observer);
  return table;
}

/// A block on a floor, with what differs from test to test.
std::string block_on(const std::string& parts, const std::string& floor, const std::string& steps,
                     const std::string& history) {
  return "osculate: 1\nmesh:\n  generate:\n    b: {box: {x: [0, 2], y: [0, 1], z: [0, 1], "
         "elements: [4, 2, 2]}}\n" +
         parts +
         "materials: {m: {linear_elastic: {E: 100, nu: 0.25}}}\n"
         "sections: [{on: b, material: m, element: solid}]\nrigid: {floor: " +
         floor +
         "}\ncontact: [{name: c, master: floor, slave: b.bottom, normal: {penalty: 1000}}]\nsteps: "
         "[" +
         steps + "]\noutput: {history: [" + history + "]}\n";
}

/// Floors of every kind have their body below, and as slaves they have their own nodes.
TEST(SystemSpace, FloorsPointUpwards) {
  const std::string steps = "{name: s, increments: 1, prescribe: [{on: b.top, uz: -0.011}]}";
  const std::string grid = "    g: {grid: {origin: [-1, -1, 0], u: [";
  const std::vector<std::pair<std::string, std::string>> floors{
      {"", "{plane: {point: [0, 0, 0], normal: [0, 0, 3]}}"},
      {"", "{plane: {point: [5, -3, 0], normal: [0, 0, -1]}, flip: true}"},
      {grid + "4, 0, 0], v: [0, 4, 0], elements: [3, 3]}}\n", "{set: g}"},
      {grid + "0, 4, 0], v: [4, 0, 0], elements: [3, 3], type: tri3}}\n", "{set: g, flip: true}"},
  };
  for (const auto& floor : floors) {
    const model::Model3 m =
        build_space(block_on(floor.first, floor.second, steps, "{on: c, of: force_z}")).model;
    const pairing::FacetSurface& master = m.pairs[0].definition.master;
    EXPECT_EQ(master.facets.size(), floor.first.empty() ? 1u : m.mesh.find_set("g")->cells.size());
    for (const pairing::SurfaceFacet& facet : master.facets)
      EXPECT_LT((facet_normal(facet, Vec2(0.2, 0.3), m.reference) - Vec3(0, 0, 1)).norm(), 1e-15);
    EXPECT_EQ(m.steps[0].prescribed.size(), m.mesh.find_set("b.top")->nodes.size() + 6);
  }
  const std::string text = block_on(floors[2].first, floors[2].second, steps, "");
  const model::Model3 swapped =
      build_space(edited(text, "master: floor, slave: b.bottom", "master: b.bottom, slave: floor"))
          .model;
  std::vector<Index> slaves = swapped.pairs[0].definition.slave.nodes;
  std::sort(slaves.begin(), slaves.end());
  EXPECT_EQ(slaves, swapped.mesh.find_set("g")->nodes);
}

double column_of(const Built3& built, const std::vector<double>& row, const std::string& name) {
  for (std::size_t k = 0; k < built.history.size(); ++k)
    if (built.history[k].name == name) return row[k];
  throw std::runtime_error(name);
}

/// The example of a model in space runs, balances, and slides at Coulomb's limit.
TEST(SystemSpace, TheExampleSlidesAtTheLimit) {
  const std::string path = std::string(OSCULATE_SOURCE_DIR) + "/examples/block3d/block3d.yaml";
  const Built3 built = std::get<Built3>(build_any_file(path));
  EXPECT_EQ(built.warnings, std::vector<std::string>{});
  const Table t = run_space(built);
  ASSERT_EQ(t.result.outcome, solve::Outcome::converged) << t.result.message;
  const auto column = [&](const std::vector<double>& row, const std::string& name) {
    return column_of(built, row, name);
  };
  ASSERT_GE(t.rows.size(), 34u);  // one more where rounding leads to a cut-back
  for (const std::vector<double>& row : t.rows) {
    EXPECT_NEAR(column(row, "high.top.rfx"), -column(row, "joint.force_x"), 1e-6);
    EXPECT_GT(column(row, "joint.normal_force"), 0);
    EXPECT_LE(std::hypot(column(row, "joint.force_x"), column(row, "joint.force_y")),
              0.25 * column(row, "joint.normal_force"));
  }
  const auto farthest = std::max_element(  // the end of the second step
      t.rows.begin(), t.rows.end(), [&](const auto& a, const auto& b) {
        return column(a, "high.top.ux") < column(b, "high.top.ux");
      });
  EXPECT_LT(column(*farthest, "joint.force_x"), 0);
  EXPECT_GT(column(*farthest, "joint.slipping"), 0);
  EXPECT_GT(column(t.rows.back(), "joint.force_x"), 0);
  EXPECT_LT(column(t.rows.back(), "joint.force_y"), 0);
}

/// Beams across each other on their edges: held by the crossing alone, dragged at Coulomb's limit.
TEST(SystemSpace, TheExampleOfCrossedBeamsIsHeldByItsEdges) {
  const std::string path =
      std::string(OSCULATE_SOURCE_DIR) + "/examples/crossed_beams/crossed_beams.yaml";
  Built3 built = std::get<Built3>(build_any_file(path));
  EXPECT_EQ(built.warnings, std::vector<std::string>{});
  const Table t = run_space(built);
  ASSERT_EQ(t.result.outcome, solve::Outcome::converged) << t.result.message;
  const auto column = [&](const std::vector<double>& row, const std::string& name) {
    return column_of(built, row, name);
  };
  ASSERT_GE(t.rows.size(), 20u);
  for (const std::vector<double>& row : t.rows) {
    const double normal = column(row, "cross.normal_force");
    EXPECT_GT(normal, 0);
    EXPECT_NEAR(column(row, "high.front.rfx") + column(row, "high.back.rfx"),
                -column(row, "cross.force_x"), 1e-6 * normal);
    // the limit is 0.2 of a normal force that leans with the bent edges, by up to 0.06
    EXPECT_LE(std::abs(column(row, "cross.force_x")), 0.27 * normal);
  }
  EXPECT_EQ(column(t.rows.back(), "cross.slipping"), 1);  // one crossing, and it slides
  EXPECT_LT(column(t.rows.back(), "cross.force_x"),
            -0.15 * column(t.rows.back(), "cross.normal_force"));
  built.model.pairs[0].definition.sampler = pairing::AtPoints{};
  for (const std::vector<double>& row : run_space(built).rows)
    EXPECT_EQ(column(row, "cross.normal_force"), 0);  // nodes alone see nothing
}

/// Two single cells, each with an edge up: the edge of one falls on the edge of the other at a
/// right angle. Dead load, no friction: the crossing is a spring of one node's stiffness.
TEST(SystemSpace, ABoxFallsEdgeOnEdge) {
  const auto run = [](const char* edges) {
    return run_space(build_space(
        std::string(
            "osculate: 1\n"
            "mesh: {generate: {low: {box: {x: [-1, 1], y: [-1, 1], z: [-1, 1], elements: [1, 1, "
            "1], "
            "angle: 45, axis: [1, 0, 0], about: [0, 0, 0]}}, up: {box: {x: [-1, 1], y: [-1, 1], z: "
            "[1.828, 3.828], elements: [1, 1, 1], angle: 45, axis: [0, 1, 0], about: [0, 0, "
            "2.828]}}}}\n"
            "materials: {m: {linear_elastic: {E: 1e6, nu: 0}}}\n"
            "sections: [{on: low, material: m, element: solid}, {on: up, material: m, element: "
            "solid}]\n"
            "contact: [{name: c, master: low, slave: up, normal: {penalty: 100}, weight: node, "
            "edges: ") +
        edges +
        "}]\n"
        "steps: [{name: s, increments: 1, prescribe: [{on: low, ux: 0, uy: 0, uz: 0}, {on: up, "
        "ux: 0, uy: 0}], body_force: [{on: up, fz: -0.5}]}]\n"
        "output: {history: [{on: c, of: force_z}, {on: up, of: uz}]}\n"));
  };
  const Table held = run("true");
  ASSERT_EQ(held.result.outcome, solve::Outcome::converged) << held.result.message;
  const std::vector<double>& end = held.rows.back();
  EXPECT_NEAR(end[0], 4.0, 1e-9);  // its weight
  // the weight over the penalty is reached from the overlap of the start
  EXPECT_NEAR(end[1], -0.04 + (2 * std::sqrt(2.0) - 2.828), 1e-4);
  const Table falling = run("false");
  // Nodes alone see nothing of each other there: it falls on, for ever or until nodes meet faces.
  if (falling.result.outcome == solve::Outcome::converged) {
    EXPECT_LT(falling.rows.back()[1], -0.5);
  } else {
    EXPECT_NE(falling.result.message.find("free to"), std::string::npos) << falling.result.message;
  }
}

/// A cantilever of solid-shells, thin along x, y or z of its box: the same force bends it.
TEST(SystemSpace, AShellMayBeThinInAnyDirection) {
  struct Way {
    const char *box, *held, *moved;
  };
  const std::vector<Way> ways{{"x: [0, 10], y: [0, 1], z: [0, 0.1], elements: [8, 2, 1]", "left",
                               "{on: b.top_right, uz: 1}"},
                              {"y: [0, 10], z: [0, 1], x: [0, 0.1], elements: [1, 8, 2]", "front",
                               "{on: b.back_right, ux: 1}"},
                              {"z: [0, 10], x: [0, 1], y: [0, 0.1], elements: [2, 1, 8]", "bottom",
                               "{on: b.top_back, uy: 1}"}};
  std::vector<double> forces;
  for (const Way& way : ways) {
    const std::string moved = way.moved;
    const std::string set = moved.substr(5, moved.find(',') - 5);
    const std::string text =
        std::string("osculate: 1\nmesh: {generate: {b: {box: {") + way.box +
        "}}}}\nmaterials: {m: {st_venant_kirchhoff: {E: 1.2e6, nu: 0.3}}}\nsections: [{on: b, "
        "material: m, element: solid_shell}]\nsteps: [{name: s, increments: 2, prescribe: [{on: "
        "b." +
        way.held + ", ux: 0, uy: 0, uz: 0}, " + moved + "]}]\noutput: {history: [{on: " + set +
        ", of: rf" + moved.substr(moved.find(", u") + 3, 1) + "}]}\n";
    const Table t = run_space(build_space(text));
    ASSERT_EQ(t.result.outcome, solve::Outcome::converged) << t.result.message;
    forces.push_back(t.rows.back()[0]);
  }
  EXPECT_GT(forces[0], 0.2);  // 3 E I u / L^3 = 0.3 of a slender beam
  EXPECT_LT(forces[0], 0.4);
  EXPECT_NEAR(forces[1], forces[0], 1e-8 * forces[0]);
  EXPECT_NEAR(forces[2], forces[0], 1e-8 * forces[0]);
}

/// The dragged ball on a coarser block: friction follows the path around its corner.
TEST(SystemSpace, TheBallIsDraggedAroundACorner) {
  const std::string example = test_file("../../../examples/ball_dragged/ball_dragged.yaml");
  const std::string text = edited(example, "elements: [18, 12, 3]", "elements: [12, 8, 2]");
  const Built3 built = build_space(text);
  EXPECT_EQ(built.warnings, std::vector<std::string>{});
  const Table t = run_space(built);
  ASSERT_EQ(t.result.outcome, solve::Outcome::converged) << t.result.message;
  const auto force = [&](std::size_t back) {  // of the row so many before the last
    const std::vector<double>& row = t.rows[t.rows.size() - 1 - back];
    return Vec3(row[3], row[4], row[2]);  // along, across, normal
  };
  const Vec3 across = force(0), along = force(8);
  EXPECT_GT(along.x(), 0.25 * along.z());
  EXPECT_LT(std::abs(along.y()), 0.05 * along.z());
  EXPECT_GT(across.y(), 0.25 * across.z());
  EXPECT_LT(std::abs(across.x()), 0.05 * across.z());
}

}  // namespace
}  // namespace osculate::deck
