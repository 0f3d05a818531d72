// The longest stable step with springs of contacts, beside the largest eigenvalue of the system.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "osculate/model/inertia.hpp"
#include "space_test.hpp"

namespace osculate::deck {
namespace {

constexpr const char* explicitly =
    "increments: 1, duration: 1e-9, dynamics: {scheme: central_differences}";

/// Two plane blocks of which the upper, with more cells, is pressed 0.001 into the lower.
std::string blocks(const std::string& contact, const std::string& more = "", int upper = 8,
                   const std::string& held = "low.bottom") {
  return fmt::format(R"(osculate: 1
mesh:
  generate:
    low: {{box: {{x: [0, 2], y: [-1, 0], elements: [3, 1]}}}}
    high: {{box: {{x: [0.1, 1.9], y: [-0.001, 1], elements: [{}, 1]}}}}
materials: {{m: {{linear_elastic: {{E: 1, nu: 0.3, density: 1}}}}}}
sections: [{{on: low, material: m, element: plane_strain}}, {{on: high, material: m, element: plane_strain}}]
contact: [{{name: c, master: low.top, slave: high.bottom, {}}}]
{}
steps: [{{name: s, {}, prescribe: [{{on: {}, ux: 0, uy: 0}}]}}]
)",
                     upper, contact, more, explicitly, held);
}

/// A rigid body, mass 2, that is pressed 0.001 into an elastic block with its top at y = 0.
std::string body_on_block(const std::string& body, const std::string& contact) {
  return fmt::format(R"(osculate: 1
mesh:
  generate:
    low: {{box: {{x: [-1, 1], y: [-1, 0], elements: [2, 1]}}}}
    lump: {{box: {{x: [-0.5, 0.5], y: [-0.001, 0.3], elements: [3, 2]}}}}
materials: {{m: {{linear_elastic: {{E: 1, nu: 0.3, density: 1}}}}}}
sections: [{{on: low, material: m, element: plane_strain}}]
rigid: {{body: {}}}
contact: [{{name: c, {}}}]
steps: [{{name: s, {}, prescribe: [{{on: low, ux: 0, uy: 0}}]}}]
)",
                     body, contact, explicitly);
}

/// Two square rods whose edges cross in the middle, 0.001 deep.
std::string crossed(const std::string& edges) {
  return fmt::format(R"(osculate: 1
mesh:
  generate:
    low: {{box: {{x: [-2, 2], y: [-0.3, 0.3], z: [-0.3, 0.3], elements: [3, 1, 1], angle: 45, axis: [1, 0, 0], about: [0, 0, 0]}}}}
    high: {{box: {{x: [-0.3, 0.3], y: [-2, 2], z: [0.5475, 1.1475], elements: [1, 3, 1], angle: 45, axis: [0, 1, 0], about: [0, 0, 0.8475]}}}}
materials: {{m: {{linear_elastic: {{E: 1, nu: 0.3, density: 1}}}}}}
sections: [{{on: low, material: m, element: solid}}, {{on: high, material: m, element: solid}}]
contact: [{{name: c, master: low, slave: high, weight: node, normal: {{penalty: 1e4}}, edges: {}, search: {{depth: 0.2}}}}]
steps: [{{name: s, {}}}]
)",
                     edges, explicitly);
}

template <int Dim>
struct Frequencies {
  double of_system = 0, estimated = 0;  ///< squared
  std::size_t closed = 0;
};

template <int Dim>
Eigen::VectorXd masses_of(const model::BasicModel<Dim>& model) {
  const model::BasicInertia<Dim> inertia(model, true);
  Eigen::VectorXd mass = inertia.multiply(
      Eigen::VectorXd::Ones(Dim * static_cast<Eigen::Index>(model.reference.size()) +
                            body::motions<Dim> * static_cast<Eigen::Index>(model.rigid.size())));
  if constexpr (Dim == 3)
    for (std::size_t b = 0; b < model.rigid.size(); ++b)
      mass.segment<3>(Dim * static_cast<Eigen::Index>(model.reference.size()) +
                      6 * static_cast<Eigen::Index>(b) + 3) = model.rigid[b].inertia.diagonal();
  return mass;
}

/// The tangent of all springs and cells where the step begins, and what its time steps are
/// estimated from.
template <int Dim, class BuiltModel>
Frequencies<Dim> frequencies_of(const BuiltModel& built) {
  Frequencies<Dim> out;
  model::Step still = built.model.steps.front();
  still.dynamics.reset();
  model::BasicSystem<Dim> system(built.model, 1);
  const model::BasicState<Dim> start = system.initial_state();
  system.begin_step(still, start);
  solve::Evaluation e;
  system.evaluate(start, 1.0, true, e);
  for (const auto& point : system.contact().front().points)
    if (point.status != contact::Status::open) ++out.closed;
  const Index n = system.unknowns();
  const Eigen::VectorXd mass = masses_of<Dim>(built.model);
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n), k = Eigen::MatrixXd::Zero(n, n);
  const std::vector<Vec<Dim>> x = system.positions(start);
  for (Eigen::Index d = 0; d < mass.size(); ++d) {
    std::vector<model::Expansion> terms;
    system.dofs().expand(d, 1.0, x, start.rigid, terms);
    for (const model::Expansion& a : terms)
      for (const model::Expansion& b : terms)
        m(a.unknown, b.unknown) += a.factor * b.factor * mass[d];
  }
  const la::SparseMatrix& sparse = system.matrix();
  for (Index row = 0; row < n; ++row)
    for (Index at = sparse.row_start[static_cast<std::size_t>(row)];
         at < sparse.row_start[static_cast<std::size_t>(row) + 1]; ++at)
      k(row, sparse.column[static_cast<std::size_t>(at)]) =
          sparse.value[static_cast<std::size_t>(at)];
  for (Index u = 0; u < n; ++u)
    if (system.prescribed(u)) {
      m.row(u).setZero(), m.col(u).setZero(), k.row(u).setZero(), k.col(u).setZero();
      m(u, u) = 1;
    }
  const Eigen::MatrixXd symmetric = 0.5 * (k + k.transpose());
  out.of_system = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, m)
                      .eigenvalues()
                      .maxCoeff();
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](auto&, const auto&, const model::Progress&,
                           const solve::IncrementRecord* record) {
    if (record) out.estimated = std::pow(2 / record->time_steps.stable, 2);
    return true;
  };
  (void)model::run(built.model, {}, observer);
  return out;
}

/// The estimate is a bound, and not more than `most` times what there is.
template <int Dim>
void expect_bound(const std::string& text, std::size_t closed, double most) {
  const Frequencies<Dim> f = [&] {
    if constexpr (Dim == 2) {
      const Description d = parse_model(text, "model.yaml");
      return frequencies_of<2>(build(d, load_mesh(d)));
    } else {
      return frequencies_of<3>(built_from(text));
    }
  }();
  EXPECT_EQ(f.closed, closed) << text;
  EXPECT_GT(f.of_system, 1000) << "the springs do not govern";
  EXPECT_GE(f.estimated, f.of_system * (1 - 1e-12)) << text;
  EXPECT_LE(f.estimated, f.of_system * most) << text;
}

TEST(ExplicitContactStep, OfNodesByAreaAndByNode) {
  expect_bound<2>(blocks("normal: {penalty: 1e4}"), 9, 2);
  expect_bound<2>(blocks("weight: node, normal: {penalty: 1e4}"), 9, 2);
  expect_bound<2>(blocks("weight: node, normal: {penalty: 1e4}", "", 40), 41, 2);
}

TEST(ExplicitContactStep, OfFriction) {
  expect_bound<2>(blocks("normal: {penalty: 1e4}, friction: {coulomb: {mu: 5, penalty: 3e4}}"), 9,
                  2);
}

TEST(ExplicitContactStep, OfNodesThatFollowByEquations) {
  expect_bound<2>(blocks("weight: node, normal: {penalty: 1e4}",
                         "equal: [{on: high.bottom, of: ux}, {on: high.bottom, of: uy}]", 8, "low"),
                  9, 2);
  expect_bound<2>(
      blocks("weight: node, normal: {penalty: 1e4}", "equal: [{on: high.bottom, of: uy}]"), 9, 2);
}

TEST(ExplicitContactStep, OfRigidBodies) {
  const std::string onto =
      "master: low.top, slave: lump.bottom, weight: node, "
      "normal: {penalty: 1e4}, friction: {coulomb: {mu: 5, penalty: 1e4}}";
  expect_bound<2>(body_on_block("{set: lump, mass: 2, inertia: 0.02}", onto), 4, 2);
  const std::string under =
      "master: body, slave: low.top, weight: node, normal: {penalty: 1e4}, "
      "friction: {coulomb: {mu: 5, penalty: 1e4}}";
  for (const double inertia : {1.0, 0.01})
    expect_bound<2>(body_on_block(fmt::format("{{circle: {{center: [0, 0.999], radius: 1}}, mass: "
                                              "2, inertia: {}}}",
                                              inertia),
                                  under),
                    1, 4);
}

/// At the ends of the edges the crossing would be four times as fast, and so would each of the four
/// others that these nodes may have.
TEST(ExplicitContactStep, OfCrossingEdges) {
  expect_bound<3>(crossed("true"), 1, 16.001);
  const double seen = frequencies_of<3>(built_from(crossed("true"))).estimated;
  EXPECT_GT(seen, 3 * frequencies_of<3>(built_from(crossed("false"))).estimated);
}

}  // namespace
}  // namespace osculate::deck
