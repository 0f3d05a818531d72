#include "solve.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace osculate::verification::shell {
namespace {

void add_end_moment(const ShellProblem& p, model::Model3& m, model::Step& step) {
  if (p.moment.pairs.empty()) return;
  model::RigidBody3 edge;
  edge.name = "end";
  double moment = 0;
  for (const EndMoment::Pair& pair : p.moment.pairs) {
    moment += pair.moment;
    for (const Index n : {pair.bottom, pair.top}) {
      edge.nodes.push_back(n);
      edge.reference += p.mesh.nodes[std::size_t(n)];
      m.body_of_node[std::size_t(n)] = 0;
    }
  }
  edge.reference /= double(edge.nodes.size());
  m.rigid.push_back(edge);
  const auto first = static_cast<model::Dof>(3 * p.mesh.nodes.size());
  for (const int out_of_plane : {1, 3, 5})
    step.prescribed.push_back({first + out_of_plane, {0, 0, {}}, false});
  step.dead.push_back({{{first + 4, moment}}, {0, 1, {}}});
}

}  // namespace

model::Model3 to_model(const ShellProblem& p, int increments) {
  model::Model3 m;
  m.title = "Shell";
  m.mesh.nodes = p.mesh.nodes;
  m.reference = p.mesh.nodes;
  m.body_of_node.assign(p.mesh.nodes.size(), -1);
  m.mesh.blocks.emplace_back();
  mesh::Block& block = m.mesh.blocks.back();
  block.type = p.mesh.type;
  model::BulkSection3 section;
  section.name = "shell";
  section.section = p.section;
  for (std::size_t c = 0; c < p.mesh.cells.size(); ++c) {
    block.connectivity.insert(block.connectivity.end(), p.mesh.cells[c].begin(),
                              p.mesh.cells[c].end());
    section.cells.push_back({0, static_cast<Index>(c)});
  }
  m.sections.push_back(section);
  model::Step step;
  step.name = "load";
  step.increments = increments;
  model::DeadLoad load{{}, {0, 1, {}}};
  for (Eigen::Index i = 0; i < p.load.size(); ++i) {
    const auto dof = static_cast<model::Dof>(i);
    if (p.fixed[std::size_t(i)]) step.prescribed.push_back({dof, {0, 0, {}}, false});
    if (p.load[i] != 0) load.unit.emplace_back(dof, p.load[i]);
  }
  if (!load.unit.empty()) step.dead.push_back(load);
  add_end_moment(p, m, step);
  m.steps.push_back(step);
  return m;
}

const Eigen::VectorXd& ShellPath::at(double wanted) const {
  for (std::size_t i = 0; i < fraction.size(); ++i)
    if (std::abs(fraction[i] - wanted) < 1e-9) return u[i];
  throw std::runtime_error(fmt::format("no increment ends at {}", wanted));
}

ShellPath solve(const ShellProblem& problem, int increments, const Workers& workers) {
  const model::Model3 m = to_model(problem, increments);
  model::AnalysisOptions options;
  workers.work_on(options);
  ShellPath path;
  model::AnalysisObserver3 observer;
  observer.converged = [&](model::System3&, const model::State3& state,
                           const model::Progress& progress, const solve::IncrementRecord* record) {
    if (!record) return true;
    path.iterations += static_cast<int>(record->iterations.size()) + record->wasted_iterations;
    path.cutbacks += record->cutbacks;
    path.fraction.push_back(progress.fraction);
    path.u.push_back(state.u);
    return true;
  };
  const model::AnalysisResult3 result = model::run(m, options, observer);
  path.converged = result.outcome == solve::Outcome::converged;
  path.message = result.message;
  if (!path.converged) throw std::runtime_error(path.message);
  return path;
}

}  // namespace osculate::verification::shell
