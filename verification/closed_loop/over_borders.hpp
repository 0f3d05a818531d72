#pragma once
// A block that is dragged straight over five flat facets and back, in the plane and in space.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "../run_model.hpp"
#include "../run_space.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::verification {

/// A block over a rigid floor of facets with the lengths 1.5 : 3 : 1 : 3 : 2, or of one facet.
struct OverBorders {
  int dimension = 2;
  std::string sampling = "nodes";
  bool cut = true;
  double mu = 0.3;
  int rounds = 1;
  Workers workers = 1;

  static constexpr double depth = 0.01, eps_n = 1000, eps_t = 30, way = 7.6;
  static constexpr int increments = 19;
  [[nodiscard]] double rod() const { return mu * eps_n * depth / eps_t; }
};

/// Where the floor is cut.
inline std::vector<double> cuts_of(const OverBorders& o) {
  if (!o.cut) return {-0.5, 10};
  return {-0.5, 1, 4, 5, 8, 10};
}

inline std::string over_borders_text(const OverBorders& o) {
  const std::vector<double> cuts = cuts_of(o);
  std::string block, ground, points, steps;
  for (const double at : cuts) points += fmt::format("{}[{}, 0]", points.empty() ? "" : ", ", at);
  if (o.dimension == 2) {
    block = "{x: [0.2, 1.3], y: [0, 0.4], elements: [2, 1]}";
    ground = fmt::format("line: {{points: [{}], elements: 1}}", points);
  } else {
    block = "{x: [0.2, 1.3], y: [0, 0.8], z: [0, 0.4], elements: [2, 2, 1]}";
    ground = fmt::format(
        "grid: {{origin: [0, -1, 0], u: [{0}, 0, 0], v: [0, 4, 0], elements: "
        "[{0}, 1]}}",
        cuts.size() - 1);
  }
  const std::string side = o.dimension == 2 ? "" : fmt::format(", uy: {}", 0.2 * o.way);
  const std::string home = o.dimension == 2 ? "" : ", uy: 0";
  for (int r = 0; r < o.rounds; ++r)
    steps += fmt::format(
        "  - {{name: there{0}, increments: {1}, prescribe: [{{on: block, ux: {2}{3}}}]}}\n"
        "  - {{name: back{0}, increments: {1}, prescribe: [{{on: block, ux: 0{4}}}]}}\n",
        r, o.increments, o.way, side, home);
  return fmt::format(R"(osculate: 1
title: A block dragged over borders and back
mesh:
  generate:
    block: {{box: {0}}}
    ground: {{{1}}}
materials: {{m: {{linear_elastic: {{E: 1000, nu: 0}}}}}}
sections: [{{on: block, material: m, element: {2}}}]
rigid: {{floor: {{set: ground}}}}
contact:
  - {{name: c, master: floor, slave: block.bottom, sampling: {3}, normal: {{penalty: {4}}},
     friction: {{coulomb: {{mu: {5}, penalty: {6}}}}}}}
steps:
  - {{name: press, increments: 1, prescribe: [{{on: block, ux: 0, {7}: {8}}}]}}
{9})",
                     block, ground, o.dimension == 2 ? "plane_strain" : "solid", o.sampling,
                     o.eps_n, o.mu, o.eps_t, o.dimension == 2 ? "uy" : "uy: 0, uz", -o.depth,
                     steps);
}

/// One converged increment of the drag.
struct BorderMoment {
  Vec3 force = Vec3::Zero();  ///< of the floor on the block, the last one normal to the floor
  double work = 0;
};

/// All increments of the drag; the moment before it comes first.
inline std::vector<BorderMoment> drag_over_borders(const OverBorders& o) {
  std::vector<BorderMoment> out;
  const auto look = [&](const auto& system, const auto& model, const auto& state, int step) {
    if (step < 0) return;
    const auto value = [&](const char* quantity) {
      return model::history_value(system, model, state,
                                  {"", model::HistoryRequest::Kind::pair, 0, {}, quantity});
    };
    BorderMoment m;
    m.force = {value("force_x"), o.dimension == 2 ? 0.0 : value("force_y"),
               value(o.dimension == 2 ? "force_y" : "force_z")};
    m.work = value("friction_work");
    out.push_back(m);
  };
  const auto check = [](const auto& result) {
    if (result.outcome != solve::Outcome::converged) throw std::runtime_error(result.message);
  };
  const std::string text = over_borders_text(o);
  if (o.dimension == 2) {
    const deck::Description d = deck::parse_model(text, "generated.yaml");
    const deck::Built built = deck::build(d, deck::load_mesh(d));
    model::AnalysisObserver observer;
    observer.converged = [&](model::System& system, const model::State& state,
                             const model::Progress&, const solve::IncrementRecord* record) {
      look(system, built.model, state, record ? 0 : -1);
      return true;
    };
    check(model::run(built.model, built.options, observer));
    return out;
  }
  const std::vector<double> cuts = cuts_of(o);
  const Edits3 edits{[&](mesh::Mesh& mesh) {
                       for (const Index n : mesh.find_set("ground")->nodes) {
                         double& at = mesh.nodes[static_cast<std::size_t>(n)].x();
                         at = cuts[static_cast<std::size_t>(std::lround(at))];
                       }
                     },
                     {}};
  check(run_text3(
      text, o.workers,
      [&](const Snapshot3& s) { look(s.system, s.model, s.state, s.record ? 0 : -1); }, edits));
  return out;
}

/// What a drag over borders shows; in exact arithmetic everything is zero, and `loop` one.
struct BorderNumbers {
  double left = 0;  ///< sticking: shear left after the way back, over the largest
  double jump = 0;  ///< sliding: largest change of the force from one increment to the next, over N
  double uneven = 0;  ///< sliding: largest difference to a floor of one facet, over N
  double loop = 0;    ///< work of the second round over mu N times the way that is slid
};

inline BorderNumbers numbers_over_borders(OverBorders o) {
  BorderNumbers out;
  o.mu = 1e6;
  const std::vector<BorderMoment> stick = drag_over_borders(o);
  double largest = 0;
  for (const BorderMoment& m : stick) largest = std::max(largest, m.force.head<2>().norm());
  out.left = stick.back().force.head<2>().norm() / largest;
  o.mu = 0.3;
  o.rounds = 2;
  const std::vector<BorderMoment> cut = drag_over_borders(o);
  o.cut = false;
  const std::vector<BorderMoment> whole = drag_over_borders(o);
  const double normal = std::abs(whole[0].force.z());
  const std::size_t leg = OverBorders::increments;
  for (std::size_t k = 0; k < cut.size(); ++k) {
    out.uneven = std::max(out.uneven, (cut[k].force - whole[k].force).norm() / normal);
    if (k > 0 && (k - 1) % leg >= 2)  // it slides again from the second increment of a leg on
      out.jump = std::max(out.jump, (cut[k].force - cut[k - 1].force).norm() / normal);
  }
  const double length = o.dimension == 2 ? o.way : o.way * std::hypot(1, 0.2);
  out.loop = (cut[4 * leg].work - cut[2 * leg].work) / (o.mu * normal * (2 * length - 4 * o.rod()));
  return out;
}

}  // namespace osculate::verification
