// Cells that explicit time integration takes four at a time: their forces in whole models.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "osculate/model/force_batches.hpp"
#include "space_test.hpp"

namespace osculate::deck {
namespace {

/// Every cell of a model is in a batch or among the others, and says the same there as by itself.
template <int Dim, class BuiltModel>
void expect_same(const BuiltModel& built, std::size_t alone) {
  const model::BasicModel<Dim>& m = built.model;
  const model::BulkTerm<Dim> bulk(m, 2);
  const model::ForceBatches<Dim> batches(bulk);
  EXPECT_EQ(batches.others().size(), alone);
  Eigen::VectorXd u(Dim * static_cast<Eigen::Index>(m.reference.size()));
  for (Eigen::Index i = 0; i < u.size(); ++i)
    u[i] = 0.002 * std::sin(1.7 * static_cast<double>(i)) + 0.3;
  std::vector<int> seen(bulk.jobs.size(), 0);
  for (const std::size_t job : batches.others()) ++seen[job];
  for (std::size_t four = 0; four < batches.count(); ++four) {
    typename model::ForceBatches<Dim>::Values forces;
    ASSERT_TRUE(batches.forces(four, u, forces));
    int lane = 0;
    for (const std::size_t job : batches.jobs(four)) {
      ++seen[job];
      model::BasicBulkBlock<Dim> block;
      model::evaluate_cell(m, *bulk.jobs[job].section, bulk.jobs[job].cell, u, {}, false, block);
      ASSERT_TRUE(block.ok);
      typename model::ForceBatches<Dim>::Stiffness last;
      const Eigen::MatrixXd* const stiffness = batches.stiffness(job, last);
      const bool small = bulk.jobs[job].section->section.kinematics == solid::Kinematics::small;
      ASSERT_EQ(stiffness != nullptr, small);
      if (small) {
        model::evaluate_cell(m, *bulk.jobs[job].section, bulk.jobs[job].cell, u, {}, true, block);
        EXPECT_LT((*stiffness - block.result.tangent).norm(), 1e-12 * stiffness->norm());
      }
      for (int d = 0; d < block.dof_count; ++d)
        EXPECT_NEAR(forces[static_cast<std::size_t>(d)][lane], block.result.force[d],
                    1e-12 * block.result.force.norm());
      ++lane;
    }
  }
  for (const int times : seen) EXPECT_EQ(times, 1);
}

/// Nine cells: two whole batches and one with three lanes that repeat.
std::string plane(const char* section) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [1, 3], y: [0, 1], elements: [3, 3], angle: 0.4}}}}}}}}
materials: {{soft: {{neo_hooke: {{E: 100, nu: 0.3}}}}, hooke: {{linear_elastic: {{E: 100, nu: 0.3}}}},
  flows: {{elastoplastic: {{E: 100, nu: 0.3, yield: 1}}}}}}
sections: [{{on: b, {}}}]
steps: [{{name: s, increments: 1, prescribe: [{{on: b.left, ux: 0, uy: 0}}]}}]
)",
                     section);
}

TEST(ForceBatches, SayTheSameInThePlane) {
  for (const char* const section :
       {"material: soft, element: plane_strain", "material: hooke, element: plane_strain",
        "material: hooke, element: plane_stress",
        "material: soft, element: plane_strain, formulation: reduced"}) {
    SCOPED_TRACE(section);
    const Description d = parse_model(plane(section), "model.yaml");
    expect_same<2>(build(d, load_mesh(d)), 0);
  }
  for (const char* const section :
       {"material: flows, element: plane_strain", "material: hooke, element: axisymmetric"}) {
    SCOPED_TRACE(section);
    const Description d = parse_model(plane(section), "model.yaml");
    expect_same<2>(build(d, load_mesh(d)), 9);
  }
}

TEST(ForceBatches, SayTheSameInSpace) {
  for (const char* const section :
       {"material: hooke", "material: hooke, formulation: bbar", "material: soft",
        "material: soft, formulation: full", "material: hooke, formulation: reduced"}) {
    SCOPED_TRACE(section);
    expect_same<3>(built_from(fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [1, 3], y: [0, 1], z: [0, 0.5], elements: [3, 2, 1]}}}}}}}}
materials: {{soft: {{neo_hooke: {{E: 100, nu: 0.3}}}}, hooke: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: b, element: solid, {}}}]
steps: [{{name: s, increments: 1, prescribe: [{{on: b.left, ux: 0, uy: 0, uz: 0}}]}}]
)",
                                          section)),
                   0);
  }
}

}  // namespace
}  // namespace osculate::deck
