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
void LoadTerm<Dim>::add_turning_pressure(const Step& step, double fraction,
                                         Assembly<Dim>& to) const {
  for (const PressureLoad& load : step.pressure) {
    const double pressure = load.ramp.value(fraction);
    if (pressure == 0.0) continue;
    for (const PressureLoad::Facet& facet : load.facets) {
      solid::Section<Dim> section = model.sections[static_cast<std::size_t>(facet.section)].section;
      if (section.kinematics != solid::Kinematics::small) continue;
      section.kinematics = solid::Kinematics::finite;
      BasicBulkBlock<Dim> block;
      set_dofs(std::span<const Index>(facet.nodes), block);
      const solid::Coordinates<Dim> reference = reference_of(model, facet.nodes);
      auto side = solid::side_pressure(section, facet.type, reference,
                                       solid::Coordinates<Dim>(0 * reference), pressure);
      side.tangent *= -to.share;
      to.add_stiffness(
          std::span<const Dof>(block.dofs.data(), static_cast<std::size_t>(block.dof_count)),
          side.tangent);
    }
  }
}

template <int Dim>
void LoadTerm<Dim>::add_centrifugal(const Step& step, const BasicState<Dim>& trial, double fraction,
                                    LoadPlaces places, Assembly<Dim>& to) const {
  BasicBulkBlock<Dim> block;
  for (const CentrifugalLoad& load : step.centrifugal) {
    const double speed_squared = load.ramp.value(fraction);
    if (speed_squared == 0.0) continue;
    for (const CentrifugalLoad::Cell& cell : *load.cells) {
      const bool moves = cell.moves || places == LoadPlaces::state;
      centrifugal_block(model, load, cell, moves ? &trial.u : nullptr, block);
      const std::span<const Dof> d(block.dofs.data(), static_cast<std::size_t>(block.dof_count));
      for (int k = 0; k < block.dof_count; ++k)
        to.into.forces.external[d[static_cast<std::size_t>(k)]] +=
            speed_squared * block.result.force[k];
      if (!to.with_tangent || !moves) continue;
      block.result.tangent *= -to.share * speed_squared;
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
