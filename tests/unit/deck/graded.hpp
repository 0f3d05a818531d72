#pragma once
// A block whose lowest row of cells is graded along its contact surface, and what it is pressed on.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "system_test.hpp"

namespace osculate::deck {

struct Graded {
  static constexpr int columns = 40;
  std::string keys = "";          ///< of the contact
  double least = 1e-3, most = 1;  ///< heights of the row
  double length = 1, force = 1;   ///< units
  double push = -0.03;            ///< of the top
  double slide = 0;               ///< of the top, in a second step
  bool rigid = true;              ///< the floor
  double modulus_left = 100;      ///< of the left half
};

/// 0 <= x <= 8, the lowest row `most` high at the left and `least` at the right end; the whole is
/// twice as high as `most`. The floor's columns are as wide as the block's.
inline Description graded_description(const Graded& g) {
  const double stress = g.force / (g.length * g.length);
  const double from = -g.length, to = 9 * g.length, bottom = -2 * g.length;
  const std::string low =
      g.rigid
          ? fmt::format("line: {{points: [[{}, 0], [{}, 0]], elements: 50}}", from, to)
          : fmt::format("box: {{x: [{}, {}], y: [{}, 0], elements: [50, 1]}}", from, to, bottom);
  const bool named = g.keys.find("sampling") != std::string::npos;
  const std::string keys = named ? g.keys : g.keys + ", sampling: nodes";
  const std::string elastic = "  - {on: low, material: a, element: plane_strain}\n";
  return parse_model(fmt::format(R"(osculate: 1
mesh:
  generate:
    low: {{{0}}}
    high: {{box: {{x: [0, {1}], y: [0, {2}], elements: [40, 2]}}}}
materials: {{a: {{linear_elastic: {{E: {3}, nu: 0.25}}}}, b: {{linear_elastic: {{E: {4}, nu: 0.25}}}}}}
sections:
  - {{on: right, material: a, element: plane_strain, thickness: {5}}}
  - {{on: left, material: b, element: plane_strain, thickness: {5}}}
{6}rigid: {{floor: {{set: {7}}}}}
contact: [{{name: c, master: {8}, slave: high.bottom{9}}}]
steps:
  - {{name: press, increments: 1, prescribe: [{{on: floor, ux: 0, uy: 0, rz: 0}}, {{on: high.top, ux: 0, uy: {10}}}]}}
  - {{name: slide, increments: 4, prescribe: [{{on: high.top, ux: {11}}}]}}
)",
                                 low, 8 * g.length, 2 * g.most * g.length, 100 * stress,
                                 g.modulus_left * stress, g.length, g.rigid ? "" : elastic,
                                 g.rigid ? "low" : "low.bottom", g.rigid ? "floor" : "low.top",
                                 keys, g.push * g.most * g.length, g.slide * g.length),
                     "model.yaml");
}

/// Height of the lowest row behind node `k` of the bottom: it falls over 6 cells, the last one is
/// `least` high.
inline double graded_height(const Graded& g, double k) {
  return g.most * std::pow(g.least / g.most, std::clamp((k - 33) / 6, 0.0, 1.0));
}

/// Its nodes by their place.
inline double column_at(const Graded& g, double x) { return x / (8 * g.length) * Graded::columns; }

/// Grades the generated block, and names its halves.
inline mesh::Mesh graded_mesh(const Description& d, const Graded& g) {
  mesh::Mesh m = load_mesh(d);
  mesh::Set left{"left", 2, {}, {}}, right{"right", 2, {}, {}};
  const mesh::Set high = *m.find_set("high");
  for (const mesh::CellRef& ref : high.cells) {
    const Index* const nodes = m.blocks[static_cast<std::size_t>(ref.block)].cell(ref.cell);
    double middle = 0;
    for (int k = 0; k < 4; ++k) middle += m.nodes[static_cast<std::size_t>(nodes[k])].x() / 4;
    mesh::Set& half = middle < 4 * g.length ? left : right;
    half.cells.push_back(ref);
    half.nodes.insert(half.nodes.end(), nodes, nodes + 4);
  }
  for (mesh::Set* const half : {&left, &right}) {
    std::sort(half->nodes.begin(), half->nodes.end());
    half->nodes.erase(std::unique(half->nodes.begin(), half->nodes.end()), half->nodes.end());
    m.sets.push_back(*half);
  }
  for (const Index n : high.nodes) {
    Vec3& x = m.nodes[static_cast<std::size_t>(n)];
    if (std::abs(x.y() - g.most * g.length) < 1e-6 * g.most * g.length)
      x.y() = g.length * graded_height(g, std::round(column_at(g, x.x())));
  }
  return m;
}

inline Built build_graded(const Graded& g) {
  const Description d = graded_description(g);
  return build(d, graded_mesh(d, g));
}

}  // namespace osculate::deck
