// Motions along vibrations: what acts on them, and the state that they make.
#include "osculate/model/system_motion.hpp"

namespace osculate::model {

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::forces_on(const Vibrations& modes, const State& about,
                                            double fraction) {
  Impl& s = *impl_;
  s.last.clear(s.dofs.dofs(), s.constraints.count());
  const std::vector<Vec<Dim>> x = s.positions(about.u);
  s.assembler.set_configuration(x, about.rigid);
  Assembly<Dim> to = s.assembly();
  s.loads.add_following(s.step, about, fraction, LoadPlaces::state, to);
  s.loads.add_dead_loads(s.step, fraction, s.last.forces);
  s.loads.add_gravity(s.step, fraction, nullptr, s.last.forces);
  turn_moments(s.model, about, false, to);
  const Eigen::VectorXd force = s.assembler.gather(s.last.forces.external);
  return modes.vectors.topRows(force.size()).transpose() * force;
}

template <int Dim>
double BasicSystem<Dim>::value(const State& state, Dof dof) const {
  return impl_->current_value(state, dof);
}

template <int Dim>
Eigen::MatrixXd BasicSystem<Dim>::dampers_on(const Vibrations& modes, const State& about) const {
  const Eigen::Index count = modes.omega_squared.size();
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(count, count);
  const std::vector<Vec<Dim>> x = positions(about);
  for (const auto& damper : impl_->springs.dampers(about, x)) {
    Eigen::VectorXd rate = Eigen::VectorXd::Zero(count);
    for (std::size_t i = 0; i < damper.motion.dofs.size(); ++i)
      rate += damper.motion.gradient[static_cast<Eigen::Index>(i)] *
              modes.motions.row(damper.motion.dofs[i]).transpose();
    c += damper.coefficient * rate * rate.transpose();
  }
  return c;
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::drag_along(const Vibrations& modes, const State& about,
                                             const Eigen::VectorXd& motion) const {
  Eigen::VectorXd drag = Eigen::VectorXd::Zero(modes.omega_squared.size());
  const std::vector<Vec<Dim>> x = positions(about);
  for (const auto& damper : impl_->springs.dampers(about, x))
    for (std::size_t i = 0; i < damper.motion.dofs.size(); ++i) {
      double rate = 0;
      for (std::size_t k = 0; k < damper.motion.dofs.size(); ++k)
        rate +=
            damper.motion.gradient[static_cast<Eigen::Index>(k)] * motion[damper.motion.dofs[k]];
      drag += damper.coefficient * damper.motion.gradient[static_cast<Eigen::Index>(i)] * rate *
              modes.motions.row(damper.motion.dofs[i]).transpose();
    }
  return drag;
}

template <int Dim>
BasicState<Dim> BasicSystem<Dim>::moved_along(const Vibrations& modes, const State& about,
                                              const VibrationMotion& by, double fraction) const {
  const BasicDofSpace<Dim>& dofs = impl_->dofs;
  State state = about;
  state.fraction = fraction;
  Eigen::VectorXd moved = modes.motions * by.place;
  if (by.carried.size() > 0) moved += by.carried;
  state.u += moved.head(state.u.size());
  for (std::size_t b = 0; b < state.rigid.size(); ++b)
    for (int i = 0; i < body::motions<Dim>; ++i)
      state.rigid[b].component(i) += moved[dofs.body_dof(static_cast<Index>(b), i)];
  state.rates = {};
  state.rates.velocity = modes.motions * by.rate;
  if (by.carried.size() > 0) state.rates.velocity += by.carried_rate;
  state.rates.acceleration = modes.motions * by.acceleration;
  if (by.carried_acceleration.size() > 0) state.rates.acceleration += by.carried_acceleration;
  if constexpr (Dim == 3)
    for (std::size_t b = 0; b < state.rigid.size(); ++b) {
      auto turning =
          state.rates.velocity.template segment<3>(dofs.body_dof(static_cast<Index>(b), Dim));
      turning = (body::spin_tangent(about.rigid[b]) * turning).eval();
    }
  return state;
}

template <int Dim>
void BasicSystem<Dim>::add_inertia_of(const State& state) {
  std::optional<BasicInertia<Dim>>& inertia = impl_->loads.resting;
  if (!inertia) inertia.emplace(impl_->model, false);
  impl_->last.forces.inertia = inertia->multiply(state.rates.acceleration);
}

template Eigen::VectorXd BasicSystem<2>::forces_on(const Vibrations&, const State&, double);
template Eigen::VectorXd BasicSystem<3>::forces_on(const Vibrations&, const State3&, double);
template double BasicSystem<2>::value(const State&, Dof) const;
template double BasicSystem<3>::value(const State3&, Dof) const;
template Eigen::MatrixXd BasicSystem<2>::dampers_on(const Vibrations&, const State&) const;
template Eigen::MatrixXd BasicSystem<3>::dampers_on(const Vibrations&, const State3&) const;
template Eigen::VectorXd BasicSystem<2>::drag_along(const Vibrations&, const State&,
                                                    const Eigen::VectorXd&) const;
template Eigen::VectorXd BasicSystem<3>::drag_along(const Vibrations&, const State3&,
                                                    const Eigen::VectorXd&) const;
template State BasicSystem<2>::moved_along(const Vibrations&, const State&, const VibrationMotion&,
                                           double) const;
template State3 BasicSystem<3>::moved_along(const Vibrations&, const State3&,
                                            const VibrationMotion&, double) const;
template void BasicSystem<2>::add_inertia_of(const State&);
template void BasicSystem<3>::add_inertia_of(const State3&);

}  // namespace osculate::model
