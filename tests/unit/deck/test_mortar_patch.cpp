// Two blocks with other meshes on each side of their common face pass a uniform pressure on
// exactly.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "osculate/cell/volume_shape.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/model/analysis.hpp"
#include "osculate/model/fields.hpp"

namespace osculate::deck {
namespace {

/// Largest deviation of contact pressures and stresses from the uniform state; 1 if not converged.
template <int Dim>
double deviation(const model::BasicModel<Dim>& m, const model::AnalysisOptions& options,
                 double lateral) {
  double worst = 1;
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                           const model::Progress&, const solve::IncrementRecord* record) {
    if (!record) return true;
    worst = 0;
    for (const auto& p : system.contact()[0].points)
      worst = std::max(worst, std::abs(p.normal_traction + 1));
    const auto fields = model::nodal_fields(system, m, state);
    for (const auto& stress : fields.stress) {
      worst = std::max(worst, std::abs(stress[0] - lateral));
      worst = std::max(worst, std::abs(stress[Dim == 2 ? 1 : 2] + 1));
    }
    return true;
  };
  const auto result = model::run(m, options, observer);
  return result.outcome == solve::Outcome::converged ? worst : 1.0;
}

TEST(MortarPatch, PassesInThePlane) {
  for (const std::string type : {"quad4", "quad8", "quad9", "tri6"})
    for (const bool upper : {true, false})
      for (const std::string weight : {"reference_area", "current_area"}) {
        const std::string text = fmt::format(R"(osculate: 1
title: Patch
mesh:
  generate:
    low: {{box: {{x: [0, 0.7, 1.9, 3], y: [0, 1], elements: [[1, 2, 2], 2], type: {0}}}}}
    up: {{box: {{x: [0, 1.3, 3], y: [1, 2], elements: [[3, 1], 2], type: {0}}}}}
materials: {{s: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: low, material: s, element: plane_strain}}, {{on: up, material: s, element: plane_strain}}]
contact: [{{name: c, master: {1}, slave: {2}, sampling: mortar, weight: {3}, normal: {{penalty: 1.0e4}}}}]
steps: [{{name: press, increments: 1, pressure: [{{on: up.top, value: 1}}],
  prescribe: [{{on: low.bottom, uy: 0}}, {{on: low.left, ux: 0}}, {{on: up.left, ux: 0}},
  {{on: low.right, ux: 0}}, {{on: up.right, ux: 0}}]}}]
solver: {{tolerance: {{residual: 1.0e-13}}}}
)",
                                             type, upper ? "low.top" : "up.bottom",
                                             upper ? "up.bottom" : "low.top", weight);
        const Description d = parse_model(text, "patch.yaml");
        const Built b = build(d, load_mesh(d));
        EXPECT_LT(deviation<2>(b.model, b.options, -0.3 / 0.7), 1e-10) << type << upper << weight;
      }
}

/// Turns the square's inside about its centre by an angle that vanishes on the sides; edges stay
/// straight.
void distort(mesh::Mesh& m) {
  std::vector<bool> upper(m.nodes.size(), false);
  for (const Index n : m.find_set("up")->nodes) upper[static_cast<std::size_t>(n)] = true;
  for (std::size_t n = 0; n < m.nodes.size(); ++n) {
    Vec3& x = m.nodes[n];
    const double a = 2 * x.x() / 3 - 1, b = 2 * x.y() / 3 - 1;
    const double turn = (upper[n] ? -0.4 : 0.4) * (1 - a * a) * (1 - b * b);
    const double c = std::cos(turn), s = std::sin(turn);
    x = {1.5 * (1 + c * a - s * b), 1.5 * (1 + s * a + c * b), x.z()};
  }
  for (const mesh::Block& block : m.blocks) {
    const cell::CellInfo& info = cell::info(block.type);
    if (info.dimension != 3 || info.order == 1) continue;
    const cell::CellType straight = info.corners == 8   ? cell::CellType::hex8
                                    : info.corners == 4 ? cell::CellType::tet4
                                                        : cell::CellType::wedge6;
    for (Index e = 0; e < block.size(); ++e)
      for (int k = info.corners; k < info.nodes; ++k) {
        const cell::VolumeShape shape =
            cell::volume_shape(straight, cell::volume_node(block.type, k));
        Vec3 x = Vec3::Zero();
        for (int l = 0; l < info.corners; ++l)
          x += shape.n[l] * m.nodes[static_cast<std::size_t>(block.cell(e)[l])];
        m.nodes[static_cast<std::size_t>(block.cell(e)[k])] = x;
      }
  }
}

double space_deviation(const std::string& low, const std::string& up, bool upper,
                       const std::string& weight) {
  const std::string text = fmt::format(R"(osculate: 1
title: Patch in space
mesh:
  generate:
    low: {{box: {{x: [0, 3], y: [0, 3], z: [0, 1], elements: [2, 2, 1], type: {0}}}}}
    up: {{box: {{x: [0, 3], y: [0, 3], z: [1, 2], elements: [3, 3, 1], type: {1}}}}}
materials: {{s: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: low, material: s, element: solid}}, {{on: up, material: s, element: solid}}]
contact: [{{name: c, master: {2}, slave: {3}, sampling: mortar, weight: {4}, normal: {{penalty: 1000}}}}]
steps: [{{name: press, increments: 1, pressure: [{{on: up.top, value: 1}}],
  prescribe: [{{on: low.bottom, uz: 0}}, {{on: low.left, ux: 0}}, {{on: up.left, ux: 0}},
  {{on: low.front, uy: 0}}, {{on: up.front, uy: 0}}, {{on: low.right, ux: 0}},
  {{on: up.right, ux: 0}}, {{on: low.back, uy: 0}}, {{on: up.back, uy: 0}}]}}]
solver: {{tolerance: {{residual: 1.0e-13}}}}
)",
                                       low, up, upper ? "low.top" : "up.bottom",
                                       upper ? "up.bottom" : "low.top", weight);
  const Description d = parse_model(text, "patch.yaml");
  mesh::Mesh mesh = load_mesh(d);
  distort(mesh);
  const Built3 b = build3(d, std::move(mesh));
  return deviation<3>(b.model, b.options, -0.3 / 0.7);
}

TEST(MortarPatch, PassesInSpace) {
  using Types = std::pair<std::string, std::string>;
  for (const Types& types : {Types{"hex8", "hex8"}, Types{"tet4", "tet4"}, Types{"hex8", "tet4"},
                             Types{"hex20", "hex20"}, Types{"hex27", "hex27"},
                             Types{"tet10", "tet10"}, Types{"hex20", "tet10"}})
    for (const bool upper : {true, false})
      EXPECT_LT(space_deviation(types.first, types.second, upper, "reference_area"), 1e-10)
          << types.first << ' ' << types.second << ' ' << upper;
  EXPECT_LT(space_deviation("hex8", "tet4", true, "current_area"), 1e-10);
}

}  // namespace
}  // namespace osculate::deck
