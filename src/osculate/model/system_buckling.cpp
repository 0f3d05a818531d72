// Loads at which a state is no longer stable.
#include <algorithm>

#include "osculate/model/system_motion.hpp"
#include "osculate/model/temperatures.hpp"

namespace osculate::model {
namespace {

/// Contact points that are closed in an evaluation, but for those of ties.
template <int Dim>
int points_that_stay_closed(const BasicModel<Dim>& model, const Evaluated<Dim>& last) {
  std::ptrdiff_t closed = 0;
  for (std::size_t p = 0; p < last.contact.size(); ++p)
    if (!pairing::is_tied(model.pairs[p].definition))
      closed += std::ranges::count_if(last.contact[p].points, [](const auto& point) {
        return point.status != contact::Status::open;
      });
  return static_cast<int>(closed);
}

}  // namespace

/// Forces that cells of small strain have more after than before, on the nodes.
template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::added_internal(const Strained& before,
                                                       const Strained& after) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(dofs.dofs());
  BulkBlock block;
  for (const auto& job : bulk.jobs) {
    if (job.memory.removed) continue;
    for (const auto& [at, sign] : {std::pair{&after, 1.0}, std::pair{&before, -1.0}}) {
      evaluate_cell(model, *job.section, job.cell, at->u, job.memory.of(at->memory), false, block);
      for (int k = 0; k < block.dof_count; ++k)
        force[block.dofs[static_cast<std::size_t>(k)]] += sign * block.result.force[k];
    }
  }
  return force;
}

/// External forces of the running step at its end, beyond those at its beginning.
template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::added_external(const State& state) {
  Eigen::VectorXd before;
  for (const double fraction : {0.0, 1.0}) {
    last.clear(dofs.dofs(), constraints.count());
    Assembly<Dim> to = assembly();
    loads.add_following(step, state, fraction, LoadPlaces::strains, to);
    loads.add_dead_loads(step, fraction, last.forces);
    loads.add_gravity(step, fraction, nullptr, last.forces);
    if (fraction == 0) before = last.forces.external;
  }
  return last.forces.external - before;
}

namespace {

void take_factors(const la::CriticalFactors& found, Buckling& out) {
  out.failure = found.failure;
  out.factors = found.values;
  out.reversed = found.reversed;
  out.residual = found.residual;
  out.missing = found.missing;
}

}  // namespace

template <int Dim>
Buckling BasicSystem<Dim>::buckling(const State& state, int count, la::LinearSolver& solver) {
  Impl& s = *impl_;
  Buckling out;
  const std::vector<Vec<Dim>> x = s.positions(state.u);
  solve::Evaluation evaluation;
  s.predict_about(state, 1.0, false, evaluation);
  const Eigen::VectorXd with_loads = s.total_force() + s.last.predicted;
  const Eigen::VectorXd carried = s.prescribed_increment(state, x, 1.0);
  if (evaluation.ok) s.predict_about(state, 0.0, false, evaluation);
  if (!evaluation.ok) out.failure = evaluation.message;
  if (s.constraints.count() > 0 && !carried.isZero(0))
    out.failure = "supports move, and contacts have multipliers";
  if (!out.failure.empty()) return out;
  const la::SparseMatrix k = s.builder.finish();
  out.closed = points_that_stay_closed(s.model, s.last);
  s.assembler.set_configuration(x, state.rigid);
  Eigen::VectorXd rest = Eigen::VectorXd::Zero(unknowns());
  rest.head(displacements()) = -s.assembler.gather(with_loads - s.total_force());
  const la::FactorReport report = solver.factor(k, pattern_version(), symmetry());
  if (report.status != la::SolveStatus::ok || solver.solve(rest) != la::SolveStatus::ok) {
    out.failure = "something is free to move";
    return out;
  }
  const Eigen::VectorXd motion = carried + s.motion_of_all(x, state, rest);
  out.added = motion.head(state.u.size());
  const Eigen::VectorXd u = state.u + out.added;
  std::vector<double> before = state.memory, after = state.memory;
  warm(s.model, s.step.temperature, 0.0, before);
  warm(s.model, s.step.temperature, 1.0, after);
  const Strained then{state.u, before}, now{u, after};
  const Eigen::VectorXd external = s.added_external(state);
  s.last.clear(s.dofs.dofs(), s.constraints.count());
  s.builder.clear();
  Assembly<Dim> to = s.assembly(true);
  s.bulk.add_stresses(now, &then, to);
  for (const double fraction : {0.0, 1.0}) {
    to.share = fraction > 0 ? 1 : -1;
    s.loads.add_centrifugal(s.step, state, fraction, LoadPlaces::strains, to);
  }
  if (!s.model.rigid.empty()) {
    s.last.forces.external = external;
    turn_moments(s.model, state, true, to, SmallRotations::turn);
    add_rigid_geometry<Dim>(s.model, state, x, s.added_internal(then, now) - external, to,
                            SmallRotations::turn);
  }
  const la::SparseMatrix& added = s.builder.finish();
  if (std::ranges::all_of(added.value, [](double v) { return v == 0; })) {
    out.failure = "the loads of the step put no stress on any body";
    return out;
  }
  const la::CriticalFactors found =
      la::critical_factors(k, added, s.constraints.count(), count, solver);
  take_factors(found, out);
  out.shapes.resize(state.u.size(), found.values.size());
  for (Eigen::Index i = 0; i < found.values.size(); ++i)
    out.shapes.col(i) = s.motion_of_all(x, state, found.vectors.col(i)).head(state.u.size());
  return out;
}

template Eigen::VectorXd BasicSystem<2>::Impl::added_internal(const Strained&, const Strained&);
template Eigen::VectorXd BasicSystem<3>::Impl::added_internal(const Strained&, const Strained&);
template Eigen::VectorXd BasicSystem<2>::Impl::added_external(const State&);
template Eigen::VectorXd BasicSystem<3>::Impl::added_external(const State3&);
template Buckling BasicSystem<2>::buckling(const State&, int, la::LinearSolver&);
template Buckling BasicSystem<3>::buckling(const State3&, int, la::LinearSolver&);

}  // namespace osculate::model
