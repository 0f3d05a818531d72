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
std::string block_on(const std::string& parts, const std::string& floor, const std::string& more,
                     const std::string& steps, const std::string& history) {
  return "osculate: 1\nmesh:\n  generate:\n    b: {box: {x: [0, 2], y: [0, 1], z: [0, 1], "
         "elements: [4, 2, 2]}}\n" +
         parts +
         "materials: {m: {linear_elastic: {E: 100, nu: 0.25}}}\n"
         "sections: [{on: b, material: m, element: solid}]\nrigid: {floor: " +
         floor + "}\ncontact: [{name: c, master: floor, slave: b.bottom, normal: {penalty: 1000}" +
         more + "}]\nsteps: [" + steps + "]\noutput: {history: [" + history + "]}\n";
}

/// Uniform compression: penetration p / 1000 below, strain p / 100 (no lateral restraint).
///
/// A top pushed down by d moves the block by p (1/100 + 1/1000), so p = d / 0.011.
TEST(SystemSpace, ABlockPressedOnAFloorIsInUniformCompression) {
  const std::string steps =
      "{name: s, increments: 1, prescribe: [{on: b.top, uz: -0.011}, {on: b.left, ux: 0}, {on: "
      "b.front, uy: 0}]}";
  const std::string history =
      "{on: c, of: normal_force}, {on: c, of: force_z}, {on: c, of: max_penetration}, {on: b.top, "
      "of: rfz}, {on: b.right, of: ux}, {on: floor, of: rfz}, {on: b.bottom, of: uz}";
  const std::vector<std::pair<std::string, std::string>> floors{
      {"", "{plane: {point: [0, 0, 0], normal: [0, 0, 3]}}"},
      {"", "{plane: {point: [5, -3, 0], normal: [0, 0, -1]}, flip: true}"},
      {"    g: {grid: {origin: [-1, -1, 0], u: [4, 0, 0], v: [0, 4, 0], elements: [3, 3]}}\n",
       "{set: g}"},
      {"    g: {grid: {origin: [-1, -1, 0], u: [0, 4, 0], v: [4, 0, 0], elements: [3, 3], type: "
       "tri3}}\n",
       "{set: g, flip: true}"},
  };
  for (const auto& floor : floors) {
    const Table t = run_space(build_space(block_on(floor.first, floor.second, "", steps, history)));
    ASSERT_EQ(t.result.outcome, solve::Outcome::converged) << floor.second << t.result.message;
    const std::vector<double>& v = t.rows.back();
    EXPECT_NEAR(v[0], 2, 1e-9) << floor.second;
    EXPECT_NEAR(v[1], 2, 1e-9);
    EXPECT_NEAR(v[2], 0.001, 1e-12);
    EXPECT_NEAR(v[3], -2, 1e-9);
    EXPECT_NEAR(v[4], 2 * 0.25 * 0.01, 1e-11);
    EXPECT_NEAR(v[5], 2, 1e-9);
    EXPECT_NEAR(v[6], -0.001, 1e-12);
  }
}

/// The other way round: the meshed surface is the slave.
TEST(SystemSpace, NodesOfARigidSurfaceAreSlaves) {
  const std::string swapped = edited(
      block_on("    g: {grid: {origin: [-0.5, -0.5, 0], u: [3, 0, 0], v: [0, 2, 0], elements: [12, "
               "8]}}\n",
               "{set: g}", ", weight: node",
               "{name: s, increments: 1, prescribe: [{on: b.top, ux: 0, uy: 0, uz: -0.01}]}",
               "{on: c, of: force_z}, {on: b.top, of: rfz}, {on: floor, of: rfz}"),
      "master: floor, slave: b.bottom", "master: b.bottom, slave: floor");
  const Table t = run_space(build_space(edited(swapped, "penalty: 1000", "penalty: 100")));
  ASSERT_EQ(t.result.outcome, solve::Outcome::converged) << t.result.message;
  const std::vector<double>& v = t.rows.back();
  EXPECT_LT(v[0], -0.1);  // on the slave, the floor
  EXPECT_NEAR(v[0], v[1], 1e-9);
  EXPECT_NEAR(v[2], -v[0], 1e-9);
}

/// A circular cylinder and a rational patch that is the same surface press the same way.
TEST(SystemSpace, ACylinderAndItsNurbsPatchPressAlike) {
  const std::string steps =
      "{name: s, increments: 2, prescribe: [{on: b.bottom, ux: 0, uy: 0, uz: 0}, {on: floor, uz: "
      "-0.05, ux: 0.03}]}";
  const std::string history =
      "{on: c, of: force_x}, {on: c, of: force_z}, {on: floor, of: rfx}, {on: floor, of: rfz}, "
      "{on: floor, of: rmy}";
  const auto run = [&](const std::string& shape) {
    const std::string text = edited(
        block_on("", shape, ", friction: {coulomb: {mu: 0.2, penalty: 200}}", steps, history),
        "slave: b.bottom", "slave: b.top");
    const Table t = run_space(build_space(text));
    EXPECT_EQ(t.result.outcome, solve::Outcome::converged) << t.result.message;
    return t.rows.back();
  };
  const std::vector<double> cylinder =
      run("{cylinder: {point: [1, 0, 4], axis: [0, 1, 0], radius: 3}, reference: [1, 0, 4]}");
  // The lower half: a quarter to each side of the lowest line, from x = 4 through z = 1 to x = -2.
  const std::string w = "0.70710678118654757";
  const auto row = [&](const std::string& xz, const std::string& weight) {
    const auto comma = xz.find(',');
    const std::string x = xz.substr(0, comma), z = xz.substr(comma + 1);
    return "[[" + x + ", -1, " + z + ", " + weight + "], [" + x + ", 2, " + z + ", " + weight +
           "]]";
  };
  const std::string patch =
      "nurbs_patch: {degree: [2, 1], knots: [[0, 0, 0, 1, 1, 2, 2, 2], [0, "
      "0, 1, 1]], control: [" +
      row("4, 4", "1") + ", " + row("4, 1", w) + ", " + row("1, 1", "1") + ", " + row("-2, 1", w) +
      ", " + row("-2, 4", "1") + "]}";
  const std::vector<double> nurbs = run("{" + patch + ", reference: [1, 0, 4]}");
  EXPECT_LT(cylinder[1], -0.01);
  EXPECT_GT(cylinder[0], 1e-4);
  for (std::size_t i = 0; i < nurbs.size(); ++i) EXPECT_NEAR(nurbs[i], cylinder[i], 1e-9) << i;
}

/// A weight on a rigid plate sinks until the block carries it; its moment turns it.
TEST(SystemSpace, ALoadedRigidPlaneFindsItsPlace) {
  const std::string text = edited(
      block_on(
          "", "{plane: {point: [0, 0, 1], normal: [0, 0, -1]}, reference: [1, 0.5, 1]}", "",
          "{name: s, increments: 1, prescribe: [{on: b.bottom, ux: 0, uy: 0, uz: 0}], release: "
          "[{on: floor, of: [rx, ry]}], forces: [{on: floor, fz: -3, mx: 0.02, my: -0.05}]}",
          "{on: floor, of: rfz}, {on: floor, of: rmx}, {on: floor, of: rmy}, {on: c, of: "
          "force_z}, {on: floor, of: uz}, {on: floor, of: rx}, {on: floor, of: ry}, {on: "
          "b.bottom, of: rfz}"),
      "slave: b.bottom", "slave: b.top");
  const Table t = run_space(build_space(text));
  ASSERT_EQ(t.result.outcome, solve::Outcome::converged) << t.result.message;
  const std::vector<double>& v = t.rows.back();
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(v[static_cast<std::size_t>(i)], 0, 1e-7) << i;
  EXPECT_NEAR(v[3], -3, 1e-7);
  EXPECT_LT(v[4], 0);
  EXPECT_GT(v[5], 0);
  EXPECT_LT(v[6], 0);
  EXPECT_NEAR(v[7], 3, 1e-7);
}

TEST(SystemSpace, PressureTractionAndBodyForceAreCarriedByTheSupport) {
  const std::string text =
      "osculate: 1\nmesh: {generate: {b: {box: {x: [0, 2], y: [0, 1], z: [0, 3], elements: [2, 1, "
      "3], type: hex20}}}}\nmaterials: {m: {linear_elastic: {E: 100, nu: 0.3}}}\n"
      "sections: [{on: b, material: m, element: solid}]\n"
      "steps: [{name: s, increments: 1, prescribe: [{on: b.bottom, ux: 0, uy: 0, uz: 0}], "
      "pressure: "
      "[{on: b.top, value: 5}], traction: [{on: b.left, tx: 1, ty: 2, tz: 3}], body_force: [{on: "
      "b, "
      "bx: 0.1, by: 0.2, bz: -0.3}]}]\n"
      "output: {history: [{on: b.bottom, of: rfx}, {on: b.bottom, of: rfy}, {on: b.bottom, of: "
      "rfz}]}\n";
  const Table t = run_space(build_space(text));
  ASSERT_EQ(t.result.outcome, solve::Outcome::converged) << t.result.message;
  const std::vector<double>& v = t.rows.back();
  EXPECT_NEAR(v[0], -(3 * 1 + 6 * 0.1), 1e-9);
  EXPECT_NEAR(v[1], -(3 * 2 + 6 * 0.2), 1e-9);
  EXPECT_NEAR(v[2], -(3 * 3 - 6 * 0.3 - 2 * 5), 1e-9);
}

/// The example of a model in space runs, balances, and slides at Coulomb's limit.
TEST(SystemSpace, TheExampleSlidesAtTheLimit) {
  const std::string path = std::string(OSCULATE_SOURCE_DIR) + "/examples/block3d/block3d.yaml";
  const Built3 built = std::get<Built3>(build_any_file(path));
  EXPECT_EQ(built.warnings, std::vector<std::string>{});
  const Table t = run_space(built);
  ASSERT_EQ(t.result.outcome, solve::Outcome::converged) << t.result.message;
  const auto column = [&](const std::vector<double>& row, const std::string& name) {
    for (std::size_t k = 0; k < built.history.size(); ++k)
      if (built.history[k].name == name) return row[k];
    throw std::runtime_error(name);
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
  EXPECT_GT(column(*farthest, "joint.slip"), 0);
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
    for (std::size_t k = 0; k < built.history.size(); ++k)
      if (built.history[k].name == name) return row[k];
    throw std::runtime_error(name);
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
  EXPECT_EQ(column(t.rows.back(), "cross.slip"), 1);  // one crossing, and it slides
  EXPECT_LT(column(t.rows.back(), "cross.force_x"),
            -0.15 * column(t.rows.back(), "cross.normal_force"));
  built.model.pairs[0].definition.edges.on = false;
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
        "ux: 0, uy: 0}], body_force: [{on: up, bz: -0.5}]}]\n"
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
