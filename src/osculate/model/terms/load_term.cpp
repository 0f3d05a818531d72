#include "osculate/model/terms/load_term.hpp"

namespace osculate::model {

template <int Dim>
void LoadTerm<Dim>::add_pressure(const Step& step, const BasicState<Dim>& trial, double fraction,
                                 Assembly<Dim>& to) const {
  BasicBulkBlock<Dim> block;
  for (const PressureLoad& load : step.pressure) {
    const double pressure = load.ramp.value(fraction);
    if (pressure == 0.0) continue;
    for (const PressureLoad::Facet& facet : load.facets) {
      pressure_block(model, facet, trial.u, pressure, block);
      const std::span<const Dof> d(block.dofs.data(), static_cast<std::size_t>(block.dof_count));
      for (int k = 0; k < block.dof_count; ++k)
        to.into.forces.external[d[static_cast<std::size_t>(k)]] += block.result.force[k];
      if (!to.with_tangent) continue;
      block.result.tangent *= -to.share;  // external force moves to the left-hand side
      to.add_stiffness(d, block.result.tangent);
    }
  }
}

template <int Dim>
void LoadTerm<Dim>::add_dead_loads(const Step& step, double fraction, Forces& forces) const {
  for (const DeadLoad& load : step.dead) {
    const double factor = load.ramp.value(fraction);
    for (const auto& entry : load.unit) forces.external[entry.first] += factor * entry.second;
  }
}

template <int Dim>
void LoadTerm<Dim>::add_gravity(const Step& step, double fraction, const BasicInertia<Dim>* inertia,
                                Forces& forces) {
  if (step.gravity.empty()) return;
  Vec<Dim> g;
  for (int i = 0; i < Dim; ++i) g[i] = step.gravity[static_cast<std::size_t>(i)].value(fraction);
  if (g.isZero(0)) return;
  if (!inertia && !resting) resting.emplace(model, false);
  forces.external += (inertia ? *inertia : *resting).times(g);
}

template struct LoadTerm<2>;
template struct LoadTerm<3>;

}  // namespace osculate::model
