// Cells that explicit time integration takes four at a time: their forces in whole models.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "osculate/material/pointwise.hpp"
#include "osculate/model/force_batches.hpp"
#include "space_test.hpp"

namespace osculate::deck {
namespace {

/// The stiffness of a cell, in a lane of that of its batch.
template <int Dim>
void expect_stiffness(const typename model::ForceBatches<Dim>::Matrix& of_batch, int lane,
                      const Eigen::MatrixXd& expected, double tolerance) {
  Eigen::MatrixXd stiffness(expected.rows(), expected.cols());
  for (Eigen::Index e = 0; e < stiffness.size(); ++e)
    stiffness.data()[e] = of_batch[static_cast<std::size_t>(e)][lane];
  EXPECT_LT((stiffness - expected).norm(), tolerance * expected.norm());
}

/// Forces of the cells of a part, batches lane by lane; sums of all at their nodes.
template <int Dim>
void expect_same_in_part(const model::BasicModel<Dim>& m, const model::BulkTerm<Dim>& bulk,
                         const model::ForceBatches<Dim>& batches, std::size_t part,
                         const Eigen::VectorXd& u, std::vector<int>& seen, Eigen::VectorXd& summed,
                         Eigen::VectorXd& one_by_one) {
  typename model::ForceBatches<Dim>::Nodal along, sum;
  batches.gather(part, u, along);
  sum.assign(along.size(), core::Pack::Zero());
  model::BasicBulkBlock<Dim> block;
  const auto evaluate = [&](std::size_t job) {
    ++seen[job];
    model::evaluate_cell(m, *bulk.jobs[job].section, bulk.jobs[job].cell, u, {}, false, block);
    ASSERT_TRUE(block.ok);
    const auto nodes = model::cell_nodes(m.mesh, bulk.jobs[job].cell).nodes;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      one_by_one.segment<Dim>(Dim * nodes[k]) +=
          block.result.force.template segment<Dim>(Dim * static_cast<Eigen::Index>(k));
  };
  const auto others = batches.alone(part), fours = batches.fours(part);
  for (std::size_t i = others.begin; i < others.end; ++i) {
    const std::size_t job = batches.others()[i];
    if (bulk.jobs[job].memory.count > 0) {
      ++seen[job];
      continue;
    }
    evaluate(job);
    batches.add_alone(job, block.result.force, sum);
  }
  for (std::size_t four = fours.begin; four < fours.end; ++four) {
    typename model::ForceBatches<Dim>::Values forces;
    ASSERT_TRUE(batches.forces(four, along, forces));
    batches.add(four, forces, sum);
    typename model::ForceBatches<Dim>::Matrix matrix;
    const solid::Section<Dim>& section = bulk.jobs[batches.jobs(four).front()].section->section;
    const bool has_stiffness = batches.stiffness(four, along, matrix);
    ASSERT_EQ(has_stiffness, material::at_once(section.law));
    int lane = 0;
    for (const std::size_t job : batches.jobs(four)) {
      evaluate(job);
      for (int d = 0; d < block.dof_count; ++d)
        EXPECT_NEAR(forces[static_cast<std::size_t>(d)][lane], block.result.force[d],
                    1e-12 * block.result.force.norm());
      if (has_stiffness) {
        model::evaluate_cell(m, *bulk.jobs[job].section, bulk.jobs[job].cell, u, {}, true, block);
        ASSERT_EQ(static_cast<Eigen::Index>(batches.dofs(four)), block.result.tangent.rows());
        const bool small = section.kinematics == solid::Kinematics::small;
        expect_stiffness<Dim>(matrix, lane, block.result.tangent, small ? 1e-12 : 3e-7);
      }
      ++lane;
    }
  }
  for (std::size_t n = 0; n < sum.size(); ++n)
    for (int i = 0; i < Dim; ++i) summed[Dim * batches.nodes(part)[n] + i] += sum[n][i];
}

/// Every cell of a model is in a batch or among the others, and says the same there as by itself.
template <int Dim, class BuiltModel>
void expect_same(const BuiltModel& built, std::size_t alone) {
  const model::BasicModel<Dim>& m = built.model;
  const model::BulkTerm<Dim> bulk(m, model::dof_space(m), 2);
  const model::ForceBatches<Dim> batches(bulk);
  EXPECT_EQ(batches.others().size(), alone);
  Eigen::VectorXd u(Dim * static_cast<Eigen::Index>(m.reference.size()));
  for (Eigen::Index i = 0; i < u.size(); ++i)
    u[i] = 0.002 * std::sin(1.7 * static_cast<double>(i)) + 0.3;
  std::vector<int> seen(bulk.jobs.size(), 0);
  Eigen::VectorXd summed = Eigen::VectorXd::Zero(u.size()), one_by_one = summed;
  for (std::size_t part = 0; part < batches.parts(); ++part)
    expect_same_in_part<Dim>(m, bulk, batches, part, u, seen, summed, one_by_one);
  EXPECT_LE((summed - one_by_one).norm(), 1e-12 * one_by_one.norm());
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
  for (const char* const section : {"material: hooke", "material: hooke, formulation: bbar",
                                    "material: soft", "material: soft, formulation: full",
                                    "material: hooke, formulation: reduced", "material: gum"}) {
    SCOPED_TRACE(section);
    expect_same<3>(built_from(fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [1, 3], y: [0, 1], z: [0, 0.5], elements: [3, 2, 1]}}}}}}}}
materials: {{soft: {{neo_hooke: {{E: 100, nu: 0.3}}}}, hooke: {{linear_elastic: {{E: 100, nu: 0.3}}}}, gum: {{ogden: {{mu1: 40, alpha1: 1.5, d1: 0.02}}}}}}
sections: [{{on: b, element: solid, {}}}]
steps: [{{name: s, increments: 1, prescribe: [{{on: b.left, ux: 0, uy: 0, uz: 0}}]}}]
)",
                                          section)),
                   0);
  }
}

TEST(ForceBatches, SayTheSameInSeveralParts) {
  const char* const text = R"(osculate: 1
mesh: {generate: {b: {box: {x: [1, 3], y: [0, 1], z: [0, 0.5], elements: [14, 13, 13]}}}}
materials: {soft: {neo_hooke: {E: 100, nu: 0.3}}}
sections: [{on: b, element: solid, material: soft}]
steps: [{name: s, increments: 1, prescribe: [{on: b.left, ux: 0, uy: 0, uz: 0}]}]
)";
  const auto built = built_from(text);
  EXPECT_GE(
      model::ForceBatches<3>(model::BulkTerm<3>(built.model, model::dof_space(built.model), 1))
          .parts(),
      2u);
  expect_same<3>(built, 0);
}

}  // namespace
}  // namespace osculate::deck
