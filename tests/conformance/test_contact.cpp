// Everything that can be a slave against everything that can be hit, with every law, weight and
// form of the residual: the model file is accepted, the assembled tangent is the derivative, and
// the increment converges with forces in balance.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "effort.hpp"
#include "expectations.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate {
namespace {

struct Named {
  std::string name;
  std::string mesh;     ///< parts for mesh: generate:
  std::string section;  ///< of a deformable one
  std::string rigid;    ///< shape of a rigid one
};

// ---- the other two axes -------------------------------------------------------------------------

const std::vector<std::string> laws{"", "friction: {coulomb: {mu: 0.3, penalty: 40}}, ",
                                    "friction: {coulomb: {mu: 1, penalty: 40}}, "};
const std::vector<std::string> weights{"node", "reference_area", "current_area"};
const std::vector<std::string> residuals{"surface", "full"};

/// Law, weight and residual number `i`, all together 18.
std::string variant(std::size_t i) {
  return fmt::format("{}weight: {}, residual: {}", laws[i % 3], weights[i / 3 % 3],
                     residuals[i / 9 % 2]);
}
constexpr std::size_t variants = 18;
/// So many of them with each slave on each target, one after the other.
constexpr int each = testing::sanitized ? 1 : 3;

// ---- models -------------------------------------------------------------------------------------

std::string model_text(const Named& slave, const Named& target, const std::string& on,
                       const std::string& variant_text, const std::string& material,
                       const std::string& steps, const std::string& normal_force) {
  const bool rigid = !target.rigid.empty();
  return fmt::format(
      "osculate: 1\nmesh:\n  generate:\n{}{}materials: {{m: {}}}\nsections:\n{}{}{}"
      "contact: [{{name: c, master: {}, slave: {}, normal: {{penalty: 60}}, {}}}]\n"
      "steps: [{{name: press, increments: 1, prescribe: [{}{}]}}]\n"
      "output: {{history: [{{on: c, of: {}}}, {{on: block.top, of: {}}}]}}\n",
      slave.mesh, target.mesh, material, slave.section, target.section,
      rigid ? fmt::format("rigid: {{target: {}}}\n", target.rigid) : "",
      rigid ? "target" : "base.top", on, variant_text, steps,
      rigid ? ""
            : (material.find("nu: 0.31") != std::string::npos
                   ? ", {on: base.bottom, ux: 0, uy: 0, uz: 0}"
                   : ", {on: base.bottom, ux: 0, uy: 0}"),
      normal_force, normal_force == "force_z" ? "rfz" : "rfy");
}

template <int Dim>
void expect_conforming(const std::string& text, bool scatters = false) {
  SCOPED_TRACE(text);
  const deck::Description description = deck::parse_model(text, "generated.yaml");
  const auto built =
      std::get<deck::BasicBuilt<Dim>>(deck::build_any(description, deck::load_mesh(description)));
  EXPECT_EQ(built.warnings.size(), scatters ? 1u : 0u);
  testing::expect_tangent(api::check_tangent(built.model, 1));
  testing::expect_increment<Dim>(built);
}

// ---- space --------------------------------------------------------------------------------------

std::vector<Named> slaves_in_space() {
  std::vector<Named> all;
  for (const char* type : {"hex8", "hex20", "hex27", "tet4", "tet10", "wedge6", "wedge15"})
    all.push_back({type,
                   fmt::format("    block: {{box: {{x: [0, 2], y: [0, 1.4], z: [0, 0.8], elements: "
                               "[2, 2, 1], type: {}, angle: 7, about: [1, 0.7, 0]}}}}\n",
                               type),
                   "  - {on: block, material: m, element: solid}\n", ""});
  for (const char* type : {"hex8", "shell18"})
    all.push_back({fmt::format("solid_shell_{}", type),
                   fmt::format("    block: {{box: {{x: [0, 2], y: [0, 1.4], z: [0, 0.2], elements: "
                               "[2, 2, 1], type: {}, angle: 7, about: [1, 0.7, 0]}}}}\n",
                               type),
                   "  - {on: block, material: m, element: solid_shell}\n", ""});
  return all;
}

std::vector<Named> targets_in_space() {
  std::vector<Named> all{
      {"plane", "", "", "{plane: {point: [0, 0, 0], normal: [0, 0, 1]}}"},
      {"sphere", "", "", "{sphere: {center: [1, 0.7, -6], radius: 6}}"},
      {"hole", "", "", "{sphere: {center: [1, 0.7, 20], radius: 20, inside: true}}"},
      {"cylinder", "", "", "{cylinder: {point: [1, 0, -6], axis: [0, 1, 0], radius: 6}}"},
      {"cone", "", "",
       "{cone: {apex: [-9, 0.7, 0], axis: [0.5, 0, -0.8660254037844387], half_angle: 60}}"},
      {"torus", "", "",
       "{torus: {center: [1, 0.7, -7], axis: [1, 0, 0], radius: 4, tube_radius: 3}}"},
      {"nurbs_patch", "", "",
       "{nurbs_patch: {degree: [2, 2], knots: [[0, 0, 0, 1, 1, 1], [0, 0, 0, 1, 1, 1]], control: "
       "[[[-2, -2, -0.9, 1], [-2, 0.7, -0.2, 0.9], [-2, 3.4, -0.9, 1]], [[1, -2, -0.2, 0.9], [1, "
       "0.7, 1.6, 0.8], [1, 3.4, -0.2, 0.9]], [[4, -2, -0.9, 1], [4, 0.7, -0.2, 0.9], [4, 3.4, "
       "-0.9, 1]]]}}"}};
  for (const char* type : {"tri3", "tri6", "quad4", "quad8", "quad9"})
    all.push_back({fmt::format("rigid_{}", type),
                   fmt::format("    floor: {{grid: {{origin: [-1, -1, 0], u: [4, 0, 0], v: [0, "
                               "3.5, 0], elements: [5, 3], type: {}}}}}\n",
                               type),
                   "", "{set: floor}"});
  for (const char* type : {"hex8", "hex20", "hex27", "tet4", "tet10"})
    all.push_back({type,
                   fmt::format("    base: {{box: {{x: [-1, 3], y: [-1, 2.4], z: [-1, 0], elements: "
                               "[3, 3, 1], type: {}}}}}\n",
                               type),
                   "  - {on: base, material: m, element: solid}\n", ""});
  return all;
}

TEST(ContactInSpace, EverySlaveOnEveryTarget) {
  const std::set<std::string> scatter{"hex20", "tet10", "wedge15"};  // a warning says so
  std::size_t i = 0;
  for (const Named& slave : slaves_in_space())
    for (const Named& target : targets_in_space())
      for (int some = 0; some < each; ++some)
        expect_conforming<3>(
            model_text(slave, target, "block.bottom", variant(5 * i++ % variants),
                       "{neo_hooke: {E: 100, nu: 0.31}}",
                       "{on: block.top, ux: 0.01, uy: 0.01, uz: -0.03}", "force_z"),
            scatter.contains(slave.name));
}

// ---- the plane ----------------------------------------------------------------------------------

std::vector<Named> slaves_in_the_plane() {
  std::vector<Named> all;
  for (const char* type : {"tri3", "tri6", "quad4", "quad8", "quad9"})
    all.push_back({type,
                   fmt::format("    block: {{box: {{x: [0, 2], y: [0, 1], elements: [3, 2], type: "
                               "{}}}}}\n",
                               type),
                   "  - {on: block, material: m, element: plane_strain}\n", ""});
  return all;
}

std::vector<Named> targets_in_the_plane() {
  std::vector<Named> all{
      {"line", "", "", "{line: {point: [0, 0], normal: [0, 1]}}"},
      {"circle", "", "", "{circle: {center: [1, -8], radius: 8}}"},
      {"hole", "", "", "{circle: {center: [1, 20], radius: 20, inside: true}}"},
      {"arc", "", "", "{arc: {center: [1, -8], radius: 8, from: 45, to: 135}}"},
      {"polyline", "", "", "{polyline: {points: [[-1, -0.05], [1.1, 0], [3, -0.1]]}}"},
      {"nurbs", "", "",
       "{nurbs: {degree: 2, knots: [0, 0, 0, 1, 1, 1], control: [[-2, -0.3, 1], [1, 0.4, 0.8], [4, "
       "-0.3, 1]]}}"}};
  for (const char* type : {"line2", "line3"})
    all.push_back({fmt::format("rigid_{}", type),
                   fmt::format("    floor: {{line: {{points: [[-1, 0], [3, 0]], elements: 5, type: "
                               "{}}}}}\n",
                               type),
                   "", "{set: floor}"});
  for (const char* type : {"tri3", "tri6", "quad4", "quad8", "quad9"})
    all.push_back({type,
                   fmt::format("    base: {{box: {{x: [-1, 3], y: [-1, 0], elements: [5, 2], type: "
                               "{}}}}}\n",
                               type),
                   "  - {on: base, material: m, element: plane_strain}\n", ""});
  return all;
}

TEST(ContactInThePlane, EverySlaveOnEveryTarget) {
  std::size_t i = 0;
  for (const Named& slave : slaves_in_the_plane())
    for (const Named& target : targets_in_the_plane())
      for (int some = 0; some < each; ++some)
        expect_conforming<2>(model_text(slave, target, "block.bottom", variant(5 * i++ % variants),
                                        "{neo_hooke: {E: 100, nu: 0.3}}",
                                        "{on: block.top, ux: 0.01, uy: -0.03}", "force_y"));
}

}  // namespace
}  // namespace osculate
