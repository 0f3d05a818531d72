#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "../run_space.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::verification {
namespace {

constexpr double radius = 3, thickness = 0.5, depth = 0.6, way = 4, mu = 0.2, penalty = 50;

struct Ironing {
  std::string sampling = "nodes", smoothing = "none";
  bool slab_is_slave = true;
  std::array<int, 3> slab{20, 6, 5};
  std::array<int, 2> punch{16, 5};  ///< cells round the half ring and along it
  int refine = 1;                   ///< increments are divided by it
};

/// The punch is a box of angle, length and depth under its surface, bent by `bend`.
std::string model_text(const Ironing& p) {
  return fmt::format(R"(osculate: 1
title: Ironing
mesh:
  generate:
    slab: {{box: {{x: [0, 10], y: [0, 4], z: [0, 3], elements: [{}, {}, {}]}}}}
    punch: {{box: {{x: [0, 1], y: [-0.5, 4.5], z: [0, 1], elements: [{}, {}, 1]}}}}
materials: {{soft: {{neo_hooke: {{E: 1, nu: 0.3}}}}, hard: {{neo_hooke: {{E: 1000, nu: 0.3}}}}}}
sections:
  - {{on: slab, material: soft, element: solid, kinematics: finite}}
  - {{on: punch, material: hard, element: solid, kinematics: finite, formulation: enhanced}}
contact: [{{name: c, master: {}, slave: {}, sampling: {}, smoothing: {}, normal: {{penalty: {}}},
  friction: {{coulomb: {{mu: {}, penalty: {}}}}}}}]
steps:
  - {{name: press, increments: {}, prescribe: [{{on: slab.bottom, ux: 0, uy: 0, uz: 0}},
    {{on: punch.left, ux: 0, uy: 0, uz: {}}}, {{on: punch.right, ux: 0, uy: 0, uz: {}}}]}}
  - {{name: drag, increments: {}, prescribe: [{{on: punch.left, ux: {}}}, {{on: punch.right, ux: {}}}]}}
)",
                     p.slab[0], p.slab[1], p.slab[2], p.punch[0], p.punch[1],
                     p.slab_is_slave ? "punch.bottom" : "slab.top",
                     p.slab_is_slave ? "slab.top" : "punch.bottom", p.sampling, p.smoothing,
                     penalty, mu, penalty, 10 * p.refine, -depth, -depth, 40 * p.refine, way, way);
}

/// Half a ring over the slab that touches it at x = 3.
void bend(mesh::Mesh& mesh) {
  for (const Index n : mesh.find_set("punch")->nodes) {
    Vec3& x = mesh.nodes[static_cast<std::size_t>(n)];
    const double angle = std::numbers::pi * (1 + x.x()), r = radius - thickness * x.z();
    x = {radius + r * std::cos(angle), x.y(), 3 + radius + r * std::sin(angle)};
  }
}

struct Outcome {
  bool finished = false;
  int iterations = 0;
  std::vector<double> at, tangential, normal;  ///< of the drag
};

Outcome run(const Ironing& p, const Workers& workers) {
  Outcome out;
  const auto look = [&](const Snapshot3& s) {
    if (!s.record) return;
    out.iterations += static_cast<int>(s.record->iterations.size()) + s.record->wasted_iterations;
    if (s.progress.step != 1) return;
    const auto reaction = [&](const char* quantity) {
      double sum = 0;
      for (const char* const set : {"punch.left", "punch.right"})
        sum += model::history_value(s.system, s.model, s.state,
                                    {"", model::HistoryRequest::Kind::nodes, 0,
                                     s.model.mesh.find_set(set)->nodes, quantity});
      return sum;
    };
    out.at.push_back(way * s.state.fraction);
    out.tangential.push_back(reaction("rfx"));
    out.normal.push_back(-reaction("rfz"));
  };
  const Edits3 edits{[](mesh::Mesh& m) { bend(m); }, {}};
  out.finished =
      run_text3(model_text(p), workers, look, edits).outcome == solve::Outcome::converged;
  return out;
}

/// What is left of y over x after its quadratic trend: standard deviation over mean. The first
/// quarter, in which the punch begins to slide, does not count.
double oscillation(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t first = x.size() / 4;
  const auto n = static_cast<Eigen::Index>(x.size() - first);
  Eigen::MatrixXd powers(n, 3);
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = x[first + static_cast<std::size_t>(i)] / way;
    powers.row(i) << 1, t, t * t;
    values[i] = y[first + static_cast<std::size_t>(i)];
  }
  const Eigen::VectorXd trend =
      (powers.transpose() * powers).ldlt().solve(powers.transpose() * values);
  const Eigen::VectorXd rest = values - powers * trend;
  return std::sqrt(rest.squaredNorm() / static_cast<double>(n)) / std::abs(values.mean());
}

/// Mean ratio of both forces, without the first quarter.
double ratio(const Outcome& o) {
  double tangential = 0, normal = 0;
  for (std::size_t i = o.at.size() / 4; i < o.at.size(); ++i) {
    tangential += o.tangential[i];
    normal += o.normal[i];
  }
  return tangential / normal;
}

void add(CaseResult& out, std::string quantity, double computed, double reference,
         Relation relation, double tolerance, const char* source) {
  out.rows.push_back({std::move(quantity), computed, reference, relation, tolerance, source});
}

Outcome add_run(CaseResult& out, const std::string& name, const Ironing& p, const Workers& workers,
                Relation end = Relation::equal) {
  using enum Relation;
  Outcome o = run(p, workers);
  add(out, name + ": runs to the end", o.finished ? 1 : 0, 1, end, 0, "");
  if (!o.finished) return o;
  add(out, name + ": iterations", o.iterations, 0, info, 0, "");
  add(out, name + ": tangential / normal force", ratio(o), 0, info, 0,
      "other codes: 0.201 to 0.207");
  add(out, name + ": oscillation of the tangential force", oscillation(o.at, o.tangential), 0, info,
      0, "");
  add(out, name + ": oscillation of the normal force", oscillation(o.at, o.normal), 0, info, 0, "");
  return o;
}

/// Points of a sampling on smooth masters: the stiff punch under the slab's points, and the slab
/// under the punch's, where flat facets let points flip between two of them for ever.
void add_smoothed(CaseResult& out, const Workers& workers) {
  add_run(out, "20 x 6 x 5 cells, {gauss: 2}, smoothed punch",
          {.sampling = "{gauss: 2}", .smoothing = "hermite"}, workers);
  Ironing p{.sampling = "{gauss: 3}", .slab_is_slave = false, .slab = {80, 2, 5}, .punch = {60, 2}};
  add_run(out, "80 x 2 x 5 cells, {gauss: 3}, punch slave", p, workers, Relation::info);
  p.smoothing = "hermite";
  add_run(out, "80 x 2 x 5 cells, {gauss: 3}, punch slave, smoothed slab", p, workers);
}

}  // namespace

CaseResult ironing(const CaseContext& context) {
  using enum Relation;
  CaseResult out;
  for (const char* const sampling : {"nodes", "{gauss: 2}", "{lobatto: 3}", "mortar"})
    add_run(out, fmt::format("20 x 6 x 5 cells, {}", sampling), {.sampling = sampling},
            context.workers);
  add_run(out, "20 x 6 x 5 cells, mortar, punch slave",
          {.sampling = "mortar", .slab_is_slave = false}, context.workers);
  add_smoothed(out, context.workers);
  Ironing best{.sampling = "mortar", .slab = {40, 4, 5}, .punch = {32, 4}};
  const Outcome whole = add_run(out, "40 x 4 x 5 cells, mortar", best, context.workers);
  best.refine = 2;
  const Outcome half =
      add_run(out, "40 x 4 x 5 cells, mortar, half increments", best, context.workers);
  if (!whole.finished || !half.finished) return out;
  add(out, "40 x 4 x 5 cells, mortar: oscillation of the tangential force",
      oscillation(whole.at, whole.tangential), 0.003, at_most, 0, "required");
  add(out, "40 x 4 x 5 cells, mortar: ratio of the forces with half increments / with whole ones",
      ratio(half) / ratio(whole), 1, equal, 0.01, "required");
  Curve curve{"mortar", {"way", "tangential", "normal"}, {}};
  for (std::size_t i = 0; i < whole.at.size(); ++i)
    curve.rows.push_back({whole.at[i], whole.tangential[i], whole.normal[i]});
  out.curves.push_back(std::move(curve));
  return out;
}

}  // namespace osculate::verification
