#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "../cases.hpp"
#include "../run_space.hpp"
#include "osculate/model/quantities.hpp"
#include "over_borders.hpp"
#include "tractrix.hpp"

namespace osculate::verification {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double depth = 0.01, eps_n = 1000, eps_t = 30, mu = 0.3, side = 0.8;
constexpr double area = side * side, force = eps_n * depth * area;
constexpr double rod = mu * eps_n * depth / eps_t;  ///< largest elastic displacement: 0.1
constexpr double loop_radius = 0.5, loop_side = 1.0;

enum class Floor { plane, facets, elastic };

/// One step of a loop: where the block is at the end of each increment.
struct Way {
  std::string name;
  std::vector<Vec2> at;  ///< `at[0]` is the start
};

Way circle(const std::string& name, int increments) {
  Way way{name, {}};
  for (int i = 0; i <= increments; ++i) {
    const double angle = 2 * pi * i / increments;
    way.at.push_back(loop_radius * Vec2(std::sin(angle), 1 - std::cos(angle)));
  }
  way.at.back().setZero();
  return way;
}

/// The sides of a square in turn, to the left or to the right.
std::vector<Way> square(int increments, bool left) {
  const std::array<Vec2, 5> corners{Vec2(0, 0), Vec2(loop_side, 0), Vec2(loop_side, loop_side),
                                    Vec2(0, loop_side), Vec2(0, 0)};
  std::vector<Way> ways;
  for (std::size_t k = 0; k < 4; ++k) {
    Way way{fmt::format("side{}", k + 1), {}};
    for (int i = 0; i <= increments; ++i) {
      const double part = static_cast<double>(i) / increments;
      Vec2 x = (1 - part) * corners[k] + part * corners[k + 1];
      if (!left) std::swap(x.x(), x.y());
      way.at.push_back(x);
    }
    ways.push_back(std::move(way));
  }
  return ways;
}

std::string amplitude(const Way& way, int direction) {
  std::string text;
  const auto n = static_cast<double>(way.at.size() - 1);
  for (std::size_t i = 0; i < way.at.size(); ++i)
    text += fmt::format("{}[{:.17g}, {:.17g}]", i ? ", " : "", static_cast<double>(i) / n,
                        way.at[i][direction]);
  return text;
}

/// A block that moves as a whole (or, on an elastic floor, is led by its top): pressed, dragged
/// along the ways, and let go at the end.
std::string model_text(Floor floor, const std::vector<Way>& ways, bool let_go,
                       const std::string& sampling) {
  const bool elastic = floor == Floor::elastic;
  const char* const led = elastic ? "block.top" : "block";
  std::string amplitudes, steps;
  for (const Way& way : ways) {
    amplitudes += fmt::format("  {}x: [{}]\n  {}y: [{}]\n", way.name, amplitude(way, 0), way.name,
                              amplitude(way, 1));
    steps += fmt::format(
        "  - {{name: {0}, increments: {1}, prescribe: [{{on: {2}, ux: 1, amplitude: {0}x}}, "
        "{{on: {2}, uy: 1, amplitude: {0}y}}]}}\n",
        way.name, way.at.size() - 1, led);
  }
  if (let_go)
    steps += fmt::format("  - {{name: free, increments: 1, release: [{{on: {}, of: [ux, uy]}}]}}\n",
                         led);
  const std::string parts =
      elastic
          ? "    ground: {box: {x: [-1.1, 1.9], y: [-1.1, 1.9], z: [-1, 0], elements: [7, 7, 2]}}"
          : "    ground: {grid: {origin: [-1.13, -1.21, 0], u: [3.1, 0, 0], v: [0, 3.1, 0], "
            "elements: [9, 11]}}";
  const std::string rigid = floor == Floor::plane
                                ? "rigid: {floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}}"
                            : floor == Floor::facets ? "rigid: {floor: {set: ground}}"
                                                     : "";
  return fmt::format(R"(osculate: 1
title: A block dragged in a closed loop
mesh:
  generate:
    block: {{box: {{x: [-0.4, 0.4], y: [-0.4, 0.4], z: [0, 0.4], elements: [{0}, {0}, {1}]}}}}
{2}
materials: {{m: {{linear_elastic: {{E: 1000, nu: 0}}}}}}
sections: [{{on: block, material: m, element: solid}}{3}]
{4}
contact:
  - {{name: c, master: {5}, slave: block.bottom, sampling: {14}, normal: {{penalty: {6}}},
     friction: {{coulomb: {{mu: {7}, penalty: {8}}}}}}}
amplitudes:
{9}
steps:
  - {{name: press, increments: 1, prescribe: [{{on: {10}, ux: 0, uy: 0, uz: {11}}}{12}]}}
{13})",
                     elastic ? 3 : 2, elastic ? 2 : 1, parts,
                     elastic ? ", {on: ground, material: m, element: solid}" : "", rigid,
                     elastic ? "ground.top" : "floor", eps_n, mu, eps_t, amplitudes, led, -depth,
                     elastic ? ", {on: ground.bottom, ux: 0, uy: 0, uz: 0}" : "", steps, sampling);
}

/// One converged increment.
struct Moment {
  Index step = 0;
  Vec2 at = Vec2::Zero();     ///< of the block (mean displacement of what is led)
  Vec2 shear = Vec2::Zero();  ///< force of the block on the floor
  double normal = 0, work = 0, pair_work = 0;
  double supply = 0;  ///< work of the leading forces so far, trapezoidal
  int crossed = 0;    ///< points that changed their facet
};

struct Run {
  std::vector<Moment> moments;
  int iterations = 0;
};

Run drag(Floor floor, const std::vector<Way>& ways, bool let_go, const Workers& workers,
         const std::string& sampling = "nodes") {
  Run run;
  std::vector<Index> facets;
  Vec2 led_force = Vec2::Zero();
  const auto look = [&](const Snapshot3& s) {
    const auto value = [&](model::HistoryRequest::Kind kind, const std::vector<Index>& nodes,
                           const char* quantity) {
      return model::history_value(s.system, s.model, s.state, {"", kind, 0, nodes, quantity});
    };
    using Kind = model::HistoryRequest::Kind;
    const std::vector<Index>& led =
        s.model.mesh.find_set(floor == Floor::elastic ? "block.top" : "block")->nodes;
    Moment m;
    m.step = s.progress.step;
    m.at = {value(Kind::nodes, led, "ux"), value(Kind::nodes, led, "uy")};
    m.shear = -Vec2(value(Kind::pair, {}, "force_x"), value(Kind::pair, {}, "force_y"));
    m.normal = value(Kind::pair, {}, "normal_force");
    m.pair_work = value(Kind::pair, {}, "friction_work");
    const Vec2 pull(value(Kind::nodes, led, "rfx"), value(Kind::nodes, led, "rfy"));
    std::vector<Index> now;
    for (const auto& p : s.system.contact()[0].points) {
      now.push_back(p.history.facet);
    }
    for (std::size_t k = 0; k < facets.size(); ++k) m.crossed += facets[k] != now[k] ? 1 : 0;
    if (s.record) {
      m.work = s.record->iterations.back().counts.friction_work;
      run.iterations += static_cast<int>(s.record->iterations.size());
      const Moment& last = run.moments.back();
      m.supply = last.supply + 0.5 * (pull + led_force).dot(m.at - last.at);
    }
    led_force = pull;
    facets = std::move(now);
    run.moments.push_back(m);
  };
  const model::AnalysisResult3 result =
      run_text3(model_text(floor, ways, let_go, sampling), workers, look);
  if (result.outcome != solve::Outcome::converged) throw std::runtime_error(result.message);
  return run;
}

constexpr std::array<const char*, 4> samplings{"nodes", "{gauss: 2}", "{lobatto: 3, subdomains: 2}",
                                               "mortar"};
constexpr const char* string_law = "stone on a string";
constexpr const char* mapping_law = "return mapping";

void add(CaseResult& out, std::string quantity, double computed, double reference,
         Relation relation, double tolerance, const char* source) {
  out.rows.push_back({std::move(quantity), computed, reference, relation, tolerance, source});
}

/// Two rounds of a circle against the return mapping of one point and against the exact motion.
struct Rounds {
  double shear_gap = 0, work_gap = 0;      ///< from the return mapping, largest
  double shear_error = 0, work_error = 0;  ///< of the exact motion, at the end
  double second_round = 0, second_supply = 0;
  Moment last;
  int crossed = 0, iterations = 0;
  Curve curve;
};

Rounds rounds(Floor floor, int increments, const Workers& workers,
              const std::string& sampling = "nodes") {
  const std::vector<Way> ways{circle("first", increments), circle("second", increments)};
  const Run run = drag(floor, ways, false, workers, sampling);
  Rounds out;
  out.curve = {fmt::format("circle_{}", increments), {"x", "y", "shear_x", "shear_y", "work"}, {}};
  Slider stone;
  std::size_t k = 2;  // after the initial state and the press
  for (const Way& way : ways)
    for (std::size_t i = 1; i < way.at.size(); ++i, ++k) {
      const Moment& m = run.moments[k];
      step_to(stone, way.at[i], rod);
      out.shear_gap = std::max(out.shear_gap, (m.shear / (mu * force) - stone.lag / rod).norm());
      out.work_gap =
          std::max(out.work_gap, std::abs(m.work - mu * force * stone.slid) / (mu * force * rod));
      out.crossed += m.crossed;
      out.curve.rows.push_back({m.at.x(), m.at.y(), m.shear.x(), m.shear.y(), m.work});
    }
  const Slider exact = around_circle(loop_radius, 4 * pi, rod);
  const Moment& half = run.moments[static_cast<std::size_t>(increments) + 1];
  out.last = run.moments.back();
  out.shear_error = (out.last.shear / (mu * force) - exact.lag / rod).norm();
  out.work_error = std::abs(out.last.work / (mu * force * exact.slid) - 1);
  out.second_round = out.last.work - half.work;
  out.second_supply = out.last.supply - half.supply;
  out.iterations = run.iterations;
  return out;
}

/// Work of a round in the steady state: the stone goes round a smaller circle.
double steady_work(double normal) {
  return mu * normal * 2 * pi * std::sqrt(loop_radius * loop_radius - rod * rod);
}

/// Errors of shear and work at the end of two rounds over the number of increments.
Picture error_picture(const Curve& errors) {
  Picture picture{"circle_errors", {}};
  io::LinePlot& plot = picture.plot;
  plot.title = "Two rounds of a circle with friction";
  plot.x = {"increments per round", true, {32, 64, 128, 256}};
  plot.y = {"error", true, {}};
  plot.curves = {{"shear / mu N", {}, {}}, {"work, relative", {}, {}}};
  for (const std::vector<double>& row : errors.rows)
    for (std::size_t k = 0; k < 2; ++k) {
      plot.curves[k].x.push_back(row[0]);
      plot.curves[k].y.push_back(row[k + 1]);
    }
  return picture;
}

void add_circle(CaseResult& out, const Workers& workers) {
  Rounds coarse, fine;
  double shear_gap = 0, work_gap = 0, books = 0;
  Curve errors{"circle_errors", {"increments", "shear", "work"}, {}};
  for (const int n : {32, 64, 128, 256}) {
    coarse = std::move(fine);
    fine = rounds(Floor::plane, n, workers);
    shear_gap = std::max(shear_gap, fine.shear_gap);
    work_gap = std::max(work_gap, fine.work_gap);
    books = std::max(books, std::abs(fine.last.work - fine.last.pair_work));
    errors.rows.push_back({static_cast<double>(n), fine.shear_error, fine.work_error});
  }
  using enum Relation;
  add(out, "circle: shear of every increment / mu N, off by", shear_gap, 1e-10, at_most, 0,
      mapping_law);
  add(out, "circle: work of every increment / (mu N l), off by", work_gap, 1e-10, at_most, 0,
      mapping_law);
  add(out, "circle: work in summary.json and of the pair, off by", books, 0, equal, 0, "");
  for (const std::string sampling : samplings) {
    const Rounds facets = rounds(Floor::facets, 64, workers, sampling);
    const std::string name = fmt::format("circle over facets, {}: ", sampling);
    add(out, name + "shear of every increment / mu N, off by", facets.shear_gap, 1e-10, at_most, 0,
        mapping_law);
    add(out, name + "work of every increment / (mu N l), off by", facets.work_gap, 1e-10, at_most,
        0, mapping_law);
    add(out, name + "borders crossed", facets.crossed, 1, at_least, 0, "");
  }
  add(out, "circle, 256 increments: error of shear / mu N", fine.shear_error, 0, info, 0,
      string_law);
  add(out, "circle, 256 increments: relative error of work", fine.work_error, 0, info, 0,
      string_law);
  add(out, "circle: order of the shear's error, 128 to 256",
      std::log2(coarse.shear_error / fine.shear_error), 1, equal, 0.1, "backward Euler");
  add(out, "circle: order of the work's error, 128 to 256",
      std::log2(coarse.work_error / fine.work_error), 1, equal, 0.1, "backward Euler");
  add(out, "circle: work of a steady round / (mu N 2 pi sqrt(r^2 - l^2)), extrapolated",
      (2 * fine.second_round - coarse.second_round) / steady_work(force), 1, equal, 1e-3,
      string_law);
  out.curves.push_back(std::move(fine.curve));
  out.pictures.push_back(error_picture(errors));
  out.curves.push_back(std::move(errors));
}

/// A square, one way and the other, and let go at the end.
struct Square {
  Moment end, free;
  Slider exact;
};

Square run_square(Floor floor, int increments, bool left, const Workers& workers) {
  const std::vector<Way> ways = square(increments, left);
  const Run run = drag(floor, ways, true, workers);
  Square out{run.moments[run.moments.size() - 2], run.moments.back(), {}};
  for (const Way& way : ways) pull_straight(out.exact, way.at.back(), rod);
  return out;
}

double degrees_between(const Vec2& a, const Vec2& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b))) * 180 / pi;
}

void add_square(CaseResult& out, const Workers& workers) {
  using enum Relation;
  const Square left = run_square(Floor::plane, 256, true, workers);
  const Square coarse = run_square(Floor::plane, 128, true, workers);
  const Square right = run_square(Floor::plane, 256, false, workers);
  const double full = mu * force;
  // friction on the block, against its last way (0, -1) or (-1, 0)
  add(out, "square to the left: friction on the block along y / mu N", -left.end.shear.y() / full,
      -left.exact.lag.y() / rod, equal, 1e-3, string_law);
  add(out, "square to the left: friction on the block along x / mu N", -left.end.shear.x() / full,
      -left.exact.lag.x() / rod, info, 0, string_law);
  add(out, "square to the right: friction on the block along x / mu N", -right.end.shear.x() / full,
      -right.exact.lag.x() / rod, equal, 1e-3, string_law);
  add(out, "path dependence: degrees between the two at the same place",
      degrees_between(left.end.shear, right.end.shear),
      degrees_between(left.exact.lag, right.exact.lag), equal, 1e-3, string_law);
  add(out, "square: work both ways, difference", std::abs(left.end.work - right.end.work) / full,
      1e-10, at_most, 0, "symmetry");
  const double work = full * left.exact.slid;
  const double error = std::abs(left.end.work / work - 1);
  add(out, "square, 256 increments a side: work / exact", left.end.work / work, 1, info, 0,
      string_law);
  add(out, "square: work / exact, extrapolated", (2 * left.end.work - coarse.end.work) / work, 1,
      equal, 1e-3, string_law);
  add(out, "square: order of the work's error, 128 to 256",
      std::log2(std::abs(coarse.end.work / work - 1) / error), 1, equal, 0.1, "backward Euler");
  add(out, "let go: way back to rest / l", (left.free.at - left.end.at).norm() / rod, 1, equal,
      1e-9, "l = mu p / eps_T");
  add(out, "let go: distance of rest from the start / l", left.free.at.norm() / rod, 1, equal, 1e-9,
      "l = mu p / eps_T");
  add(out, "let go: friction left / mu N", left.free.shear.norm() / full, 1e-9, at_most, 0,
      "equilibrium");
  add(out, "let go: work added / (mu N l)", std::abs(left.free.work - left.end.work) / (full * rod),
      1e-12, at_most, 0, "it sticks");
}

/// An elastic block led by its top round the circle over an elastic block.
void add_elastic(CaseResult& out, const Workers& workers) {
  using enum Relation;
  std::vector<double> unbalance;
  for (const int n : {64, 128}) {
    const Rounds r = rounds(Floor::elastic, n, workers);
    unbalance.push_back(std::abs(r.second_supply / r.second_round - 1));
    const std::string name = fmt::format("elastic, {} increments: ", n);
    add(out, name + "work of the leading forces / work of friction, second round",
        r.second_supply / r.second_round, 1, n == 128 ? equal : info, 0.02, "energy");
    if (n < 128) continue;
    add(out, name + "shear force / mu N at the end", r.last.shear.norm() / (mu * r.last.normal), 1,
        equal, 0.01, "Coulomb");
    add(out, name + "borders crossed", r.crossed, 1, at_least, 0, "");
    add(out, name + "work of the second round / that of a rigid block",
        r.second_round / steady_work(r.last.normal), 1, info, 0, string_law);
    add(out, name + "iterations", r.iterations, 0, info, 0, "");
  }
  add(out, "elastic: order of the energy balance, 64 to 128",
      std::log2(unbalance[0] / unbalance[1]), 2, info, 0, "trapezoidal rule");
}

/// Straight over five unequal facets and back, with every sampling in the plane and in space.
void add_over_borders(CaseResult& out, const Workers& workers) {
  using enum Relation;
  for (const int dimension : {2, 3})
    for (const char* const sampling : samplings) {
      const BorderNumbers n =
          numbers_over_borders({.dimension = dimension, .sampling = sampling, .workers = workers});
      const std::string name =
          fmt::format("five facets, {}, {}: ", dimension == 2 ? "plane" : "space", sampling);
      add(out, name + "shear left of sticking there and back / largest", n.left, 1e-12, at_most, 0,
          "nothing is forgotten");
      add(out, name + "largest change of the force at a border / N", n.jump, 1e-3, at_most, 0,
          "flat floor");
      add(out, name + "difference to a floor of one facet / N", n.uneven, 1e-10, at_most, 0,
          "flat floor");
      add(out, name + "work of a closed loop / (mu N way of the stone)", n.loop, 1, equal, 1e-10,
          string_law);
    }
}

}  // namespace

CaseResult closed_loop(const CaseContext& context) {
  CaseResult out;
  add_circle(out, context.workers);
  add_over_borders(out, context.workers);
  add_square(out, context.workers);
  add_elastic(out, context.workers);
  return out;
}

}  // namespace osculate::verification
