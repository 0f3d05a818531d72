#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../cases.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/model/analysis.hpp"

namespace osculate::verification {
namespace {

constexpr double pressure = 2;  // of E = 100
constexpr int columns = 24;

deck::Description description(const std::string& sampling) {
  return deck::parse_model(fmt::format(R"(osculate: 1
title: Cells of different heights on a rigid floor
mesh:
  generate:
    low: {{line: {{points: [[-1, 0], [25, 0]], elements: 9}}}}
    high: {{box: {{x: [0, {0}], y: [0, 2], elements: [{0}, 2]}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: high, material: m, element: plane_strain}}]
rigid: {{floor: {{set: low}}}}
contact: [{{name: c, master: floor, slave: high.bottom, sampling: {1}}}]
steps: [{{name: press, increments: 1, pressure: [{{on: high.top, value: {2}}}],
  prescribe: [{{on: floor, ux: 0, uy: 0, rz: 0}}, {{on: high.left, ux: 0}}, {{on: high.right, ux: 0}}]}}]
solver: {{tolerance: {{residual: 1.0e-12}}}}
)",
                                       columns, sampling, pressure),
                           "graded.yaml");
}

struct Found {
  double share = 0;     ///< largest penetration by the height of the thinnest cell there
  double pressure = 0;  ///< largest deviation from the uniform one
  bool converged = false;
};

/// Height of the lowest row at its nodes.
using Heights = std::array<double, columns + 1>;

/// 1 on most of the length, then falling over 7 cells to the last one.
Heights graded(double least) {
  Heights h;
  for (std::size_t k = 0; k < h.size(); ++k)
    h[k] = std::pow(least, std::clamp((static_cast<double>(k) - 16) / 7, 0.0, 1.0));
  return h;
}

/// As in an ordinary mesh: cells of 1 and 0.5 in turn, with others between them.
Heights uneven() {
  Heights h;
  for (std::size_t k = 0; k < h.size(); ++k) h[k] = k % 4 < 2 ? 1 : 0.5;
  return h;
}

/// Which penalties the points have: as built, one for all, or each what is behind it to the full.
enum class Penalty { as_built, one, to_the_full };

/// What is behind each point by the mean, without any margin.
void set_to_the_full(const Heights& h, const std::vector<Vec2>& x,
                     pairing::PairDefinition<2>& pair) {
  std::array<double, columns> of_facet{};
  double mean = 0;
  for (std::size_t k = 0; k < columns; ++k) {
    of_facet[k] = 2 / (h[k] + h[k + 1]);
    mean += of_facet[k] / columns;
  }
  pair.relative_stiffness.clear();
  for (const pairing::SlavePoint<2>& point : pair.slave.points) {
    const double at = pairing::position<2>(point, x).x();
    const auto left = static_cast<std::size_t>(std::clamp(at - 1e-6, 0.0, columns - 1.0));
    const auto right = static_cast<std::size_t>(std::clamp(at + 1e-6, 0.0, columns - 1.0));
    pair.relative_stiffness.push_back({0.5 * (of_facet[left] + of_facet[right]) / mean, 1});
  }
}

Found pressed(const std::string& sampling, const Heights& h, Penalty penalty) {
  const deck::Description d = description(sampling);
  mesh::Mesh m = deck::load_mesh(d);
  for (const Index n : m.find_set("high")->nodes) {
    Vec3& x = m.nodes[static_cast<std::size_t>(n)];
    if (std::abs(x.y() - 1) < 1e-9) x.y() = h[static_cast<std::size_t>(std::lround(x.x()))];
  }
  deck::Built built = deck::build(d, m);
  model::ContactPair& pair = built.model.pairs.at(0);
  if (penalty == Penalty::one) pair.definition.relative_stiffness.clear();
  if (penalty == Penalty::to_the_full) set_to_the_full(h, built.model.reference, pair.definition);
  Found found;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System& system, const model::State&, const model::Progress&,
                           const solve::IncrementRecord* record) {
    if (!record) return true;
    const auto& points = system.contact()[0].points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double height = pair.heights.empty() ? pair.height : pair.heights[i];
      found.share = std::max(found.share, -points[i].gap / height);
      found.pressure =
          std::max(found.pressure, std::abs(-points[i].normal_traction / pressure - 1));
    }
    return true;
  };
  const model::AnalysisResult result = model::run(built.model, built.options, observer);
  found.converged = result.outcome == solve::Outcome::converged;
  if (!found.converged) found.share = found.pressure = 1;
  return found;
}

}  // namespace

CaseResult graded_cells(const CaseContext&) {
  CaseResult result;
  for (const std::string sampling : {"nodes", "{gauss: 2}", "mortar"}) {
    const Found own = pressed(sampling, graded(1e-3), Penalty::as_built),
                one = pressed(sampling, graded(1e-3), Penalty::one),
                even = pressed(sampling, uneven(), Penalty::as_built),
                full = pressed(sampling, uneven(), Penalty::to_the_full);
    const auto add = [&](const std::string& what, double value, double limit, Relation relation) {
      result.rows.push_back({fmt::format("{}: {}", sampling, what), value, limit, relation, 0,
                             relation == Relation::info ? "" : "uniform pressure"});
    };
    add("penetration by the height of the cells, 1 : 1000", own.share, model::penetration_target,
        Relation::at_most);
    add("the same with one penalty", one.share, model::penetration_target, Relation::at_least);
    add("deviation of the pressure, 1 : 1000", own.pressure, 0, Relation::info);
    add("deviation of the pressure, 1 : 2", even.pressure, 1e-10, Relation::at_most);
    add("the same, were the penalties as different as the cells", full.pressure, 0, Relation::info);
  }
  return result;
}

}  // namespace osculate::verification
