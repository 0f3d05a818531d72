#include <cmath>
#include <utility>

#include "osculate/model/changing_unknowns.hpp"
#include "osculate/model/system_impl.hpp"
#include "osculate/model/temperatures.hpp"

namespace osculate::model {
namespace {

/// Which cells evaluations are of, for a while.
class OfCells {
 public:
  OfCells(Cells& which, Cells now) : which_(which), before_(std::exchange(which, now)) {}
  ~OfCells() { which_ = before_; }
  OfCells(const OfCells&) = delete;
  OfCells& operator=(const OfCells&) = delete;

 private:
  Cells& which_;
  Cells before_;
};

}  // namespace

template <int Dim>
bool BasicSystem<Dim>::stays_linear() const {
  const Impl& s = *impl_;
  return !s.bulk.ranks && !s.motion && !s.with_stresses && s.resistance.share == 0 &&
         s.on(Term::bulk) && !s.bulk.constant.empty();
}

template <int Dim>
void BasicSystem<Dim>::leave_out_constant(bool on) {
  impl_->bulk.which = on ? Cells::others : Cells::all;
  if (on) impl_->builder.forget_values();
  if (on && impl_->changing.empty()) impl_->changing = changing_unknowns();
}

template <int Dim>
void BasicSystem<Dim>::assemble_constant(const State& committed, double fraction) {
  Impl& s = *impl_;
  if (s.changing.empty()) s.changing = changing_unknowns();
  s.builder.clear(s.changing);
  const std::vector<Vec<Dim>> x = s.positions(committed.u);
  s.assembler.set_configuration(x, committed.rigid);
  const OfCells constant(s.bulk.which, Cells::constant);
  Assembly<Dim> to = s.assembly(true);
  solve::Evaluation out;
  s.bulk.add(committed, committed, s.time_between(committed, fraction), nullptr, to, out);
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::constant_forces(const State& committed, const Trial& trial,
                                                  double fraction) {
  Impl& s = *impl_;
  const std::vector<Vec<Dim>> x = s.positions(trial.state.u);
  s.assembler.set_configuration(x, trial.state.rigid);
  s.last.forces.internal.setZero(s.dofs.dofs());
  warm(s.model, s.step.temperature, fraction, s.last.memory);
  const OfCells constant(s.bulk.which, Cells::constant);
  Assembly<Dim> to = s.assembly();
  solve::Evaluation out;
  const bool added =
      s.bulk.add(committed, trial.state, s.time_between(committed, fraction), nullptr, to, out);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(unknowns());
  if (!added) return Eigen::VectorXd::Constant(unknowns(), std::nan(""));
  forces.head(displacements()) = s.assembler.gather(s.last.forces.internal);
  return forces;
}

template bool BasicSystem<2>::stays_linear() const;
template bool BasicSystem<3>::stays_linear() const;
template void BasicSystem<2>::leave_out_constant(bool);
template void BasicSystem<3>::leave_out_constant(bool);
template void BasicSystem<2>::assemble_constant(const State&, double);
template void BasicSystem<3>::assemble_constant(const State3&, double);
template Eigen::VectorXd BasicSystem<2>::constant_forces(const State&, const Trial&, double);
template Eigen::VectorXd BasicSystem<3>::constant_forces(const State3&, const Trial3&, double);

}  // namespace osculate::model
