// Cells whose stiffness is kept say what they say when they are evaluated anew.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "osculate/model/linear_cells.hpp"
#include "space_test.hpp"

namespace osculate::deck {
namespace {

template <int Dim, class BuiltModel>
void expect_same(const BuiltModel& built, bool kept, bool multiplied) {
  const model::BasicModel<Dim>& m = built.model;
  model::LinearCells<Dim> cells;
  for (const auto& section : m.sections)
    for (const mesh::CellRef& cell : section.cells)
      cells.add(section, model::cell_nodes(m.mesh, cell).type);
  cells.reserve();
  std::size_t number = 0;
  for (const auto& section : m.sections)
    for (const mesh::CellRef& cell : section.cells) {
      model::BasicBulkBlock<Dim> anew, of_store;
      EXPECT_EQ(cells.kept(number), kept);
      for (const double size : {1e-3, 0.02, 0.0}) {
        Eigen::VectorXd u(Dim * static_cast<Eigen::Index>(m.reference.size()));
        for (Eigen::Index i = 0; i < u.size(); ++i)
          u[i] = size * std::sin(1.7 * static_cast<double>(i) + size);
        for (const bool with_tangent : {false, true}) {
          model::evaluate_cell(m, section, cell, u, {}, with_tangent, anew);
          cells.evaluate(number, m, section, cell, u, {}, with_tangent, of_store);
          ASSERT_TRUE(anew.ok && of_store.ok);
          EXPECT_EQ(of_store.dof_count, anew.dof_count);
          EXPECT_EQ(of_store.dofs, anew.dofs);
          EXPECT_LE((of_store.result.force - anew.result.force).norm(),
                    multiplied ? 1e-12 * anew.result.force.norm() : 0.0);
          if (with_tangent) {
            EXPECT_LT((of_store.result.tangent - anew.result.tangent).norm(),
                      1e-13 * anew.result.tangent.norm());
          }
        }
        cells.force(number, m, section, cell, u, {}, of_store);
        const double scale = kept ? 1e-12 * anew.result.force.norm() : 0.0;
        EXPECT_LE((of_store.result.force - anew.result.force).norm(), scale);
      }
      ++number;
    }
  EXPECT_GT(number, 0U);
}

std::string plane(const char* material, const char* more) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [1, 3], y: [0, 1], elements: [2, 2], angle: 0.4}}}}}}}}
materials: {{m: {{{}: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: b, material: m, {}}}]
steps: [{{name: s, increments: 1, prescribe: [{{on: b.left, ux: 0, uy: 0}}]}}]
)",
                     material, more);
}

TEST(LinearCells, SayTheSameInThePlane) {
  for (const char* const element :
       {"element: plane_strain", "element: plane_stress", "element: axisymmetric",
        "element: plane_strain, formulation: bbar", "element: plane_strain, formulation: full"}) {
    SCOPED_TRACE(element);
    const Description d = parse_model(plane("linear_elastic", element), "model.yaml");
    expect_same<2>(build(d, load_mesh(d)), true, true);
  }
  const Description d = parse_model(plane("neo_hooke", "element: plane_strain"), "model.yaml");
  expect_same<2>(build(d, load_mesh(d)), false, false);
}

Built3 block(const char* element, double height) {
  return built_from(fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [1, 3], y: [0, 1], z: [0, {}], elements: [2, 2, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: b, material: m, {}}}]
steps: [{{name: s, increments: 1, prescribe: [{{on: b.left, ux: 0, uy: 0, uz: 0}}]}}]
)",
                                height, element));
}

TEST(LinearCells, SayTheSameInSpace) {
  for (const char* const element : {"element: solid", "element: solid, formulation: bbar",
                                    "element: solid, formulation: full"}) {
    SCOPED_TRACE(element);
    expect_same<3>(block(element, 0.5), true, true);
  }
  expect_same<3>(block("element: solid_shell", 0.5), true, false);
}

TEST(LinearCells, ThinOnesAreEvaluatedByTheirStrains) {
  expect_same<3>(block("element: solid", 0.05), true, false);
}

}  // namespace
}  // namespace osculate::deck
