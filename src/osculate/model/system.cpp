#include "osculate/model/system.hpp"

#include <algorithm>
#include <cmath>

#include "osculate/model/changing_unknowns.hpp"
#include "osculate/model/passed_through.hpp"
#include "osculate/model/penetration.hpp"
#include "osculate/model/system_motion.hpp"
#include "osculate/model/temperatures.hpp"
#include "osculate/model/unknown_places.hpp"

namespace osculate::model {

template <int Dim>
BasicSystem<Dim>::BasicSystem(const BasicModel<Dim>& model, int threads, const core::Ranks* ranks)
    : impl_(std::make_unique<Impl>(model, threads, ranks)) {}
template <int Dim>
BasicSystem<Dim>::~BasicSystem() = default;

template <int Dim>
BasicState<Dim> BasicSystem<Dim>::initial_state() {
  State state;
  const BasicModel<Dim>& model = impl_->model;
  state.u = Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(model.reference.size()));
  for (const BasicRigidBody<Dim>& body : model.rigid) {
    state.rigid.emplace_back();
    state.rigid.back().reference = body.reference;
    state.rigid.back().small = body.small;
  }
  for (const BasicContactPair<Dim>& pair : model.pairs)
    state.pairs.push_back(pairing::initial_state<Dim>(pair.definition, model.reference));
  for (std::size_t p = 0; p < model.pairs.size(); ++p)
    state.multipliers.push_back(
        pairing::initial_multipliers<Dim>(model.pairs[p].definition, state.pairs[p]));
  state.memory.assign(impl_->last.memory.size(), 0.0);
  warm(model, Temperatures{model.initial_temperature, {}}, 0, state.memory);
  state.constraint_forces.setZero(impl_->constraints.end - impl_->constraints.of_nodes);
  return state;
}

template <int Dim>
const BasicModel<Dim>& BasicSystem<Dim>::model() const {
  return impl_->model;
}

template <int Dim>
void BasicSystem<Dim>::build_anew() {
  auto next = std::make_unique<Impl>(impl_->model, impl_->bulk.threads, impl_->ranks);
  next->enabled = impl_->enabled;
  next->touched = impl_->touched;
  next->asked = impl_->asked;
  next->built = impl_->built + 1;
  next->assembly_seconds = impl_->assembly_seconds;
  next->bulk.seconds = impl_->bulk.seconds;
  next->contact.seconds = impl_->contact.seconds;
  impl_ = std::move(next);
}

template <int Dim>
void BasicSystem<Dim>::begin_step(const Step& step, const State& committed) {
  impl_->step = step;
  const std::vector<Step>& steps = impl_->model.steps;
  impl_->contact.beginning = steps.empty() || step.name == steps.front().name;
  std::vector<bool> flags(static_cast<std::size_t>(impl_->dofs.unknowns()), false);
  for (PrescribedDof& p : impl_->step.prescribed) {
    p.ramp.start = impl_->current_value(committed, p.dof);
    if (p.hold) {
      p.ramp.target = p.ramp.start;
      p.ramp.amplitude.clear();
    }
    if (p.further) p.ramp.target += p.ramp.start;
    const Index unknown = impl_->dofs.unknown_of(p.dof);
    if (unknown >= 0) flags[static_cast<std::size_t>(unknown)] = true;
  }
  impl_->prescribe(std::move(flags));
  if (step.dynamics) impl_->builder.forget_values();  // nothing is kept beside inertia
  impl_->constraints.forget_held();
  if (!impl_->model.pair_changes.empty())  // buffers of ties are no good for points that part
    for (pairing::PairEvaluation<Dim>& contact : impl_->last.contact) contact = {};
  impl_->begin_drivers();
  if (iterates(step))
    (void)impl_->share(committed.pairs);
  else
    impl_->share_no_more();
  // Explicit time integration says itself which cells are to keep a matrix.
  if (!step.dynamics || !step.dynamics->explicit_steps) impl_->bulk.keep_linear();
}

template <int Dim>
bool BasicSystem<Dim>::share_anew(const State& committed) {
  if (!impl_->bulk.ranks || !impl_->share(committed.pairs)) return false;
  impl_->bulk.keep_linear();
  return true;
}

template <int Dim>
void BasicSystem<Dim>::share_no_more() {
  impl_->share_no_more();
}

template <int Dim>
BasicState<Dim> BasicSystem<Dim>::begin_motion(const State& committed) {
  State state = committed;
  if (impl_->explicit_motion)
    state.rates = impl_->begin_explicit_rates(committed);
  else
    state.rates = impl_->motion ? impl_->motion->begin_rates(committed) : Rates{};
  if (impl_->motion && impl_->motion->settings.time_steps)
    impl_->motion->speeds = impl_->motion->speeds_of(state.rates);
  return state;
}

template <int Dim>
SystemMemory BasicSystem<Dim>::memory() const {
  SystemMemory memory;
  for (const PrescribedDof& p : impl_->step.prescribed) memory.starts.push_back(p.ramp.start);
  impl_->builder.finish();  // what the last evaluation has kept aside belongs to it
  memory.grown = impl_->builder.grown();
  memory.built = impl_->built;
  if (impl_->motion) memory.speeds = impl_->motion->speeds;
  return memory;
}

template <int Dim>
void BasicSystem<Dim>::resume_step(const Step& step, const State& committed,
                                   const SystemMemory& memory) {
  begin_step(step, committed);
  for (std::size_t i = 0; i < memory.starts.size(); ++i) {
    PrescribedDof& p = impl_->step.prescribed.at(i);
    p.ramp.start = memory.starts[i];
    if (p.hold) p.ramp.target = p.ramp.start;
    if (p.further) p.ramp.target = p.ramp.start + step.prescribed.at(i).ramp.target;
  }
  impl_->builder.grow_by(memory.grown);
  if (impl_->motion) impl_->motion->speeds = memory.speeds;
}

template <int Dim>
void BasicSystem<Dim>::predict(const State& committed, double fraction, solve::Evaluation& out,
                               Prediction friction) {
  impl_->contact.friction = friction;
  impl_->recent.clear();
  impl_->assemble(committed, {committed}, fraction, true, Impl::Pass::predict, out);
}

template <int Dim>
bool BasicSystem<Dim>::touches_without_shear(const State& state) const {
  const auto idle = [](const contact::PointHistory<Dim>& h) {
    return h.active && h.traction.isZero(0);
  };
  for (std::size_t p = 0; p < state.pairs.size(); ++p)
    if (impl_->model.pairs[p].definition.friction &&
        std::ranges::any_of(state.pairs[p].points, idle))
      return true;
  return false;
}

template <int Dim>
void BasicSystem<Dim>::evaluate(const State& committed, const Trial& trial, double fraction,
                                bool with_tangent, solve::Evaluation& out) {
  impl_->assemble(committed, trial, fraction, with_tangent, Impl::Pass::iterate, out);
}

template <int Dim>
void BasicSystem<Dim>::evaluate(const State& state, double fraction, bool with_tangent,
                                solve::Evaluation& out) {
  impl_->assemble(state, {state}, fraction, with_tangent, Impl::Pass::whole, out);
}

template <int Dim>
BasicTrial<Dim> BasicSystem<Dim>::apply(const State& committed, const Eigen::VectorXd& du,
                                        double fraction, double factor) const {
  return apply(Trial{committed}, du, fraction, factor);
}

template <int Dim>
BasicTrial<Dim> BasicSystem<Dim>::apply(const Trial& trial, const Eigen::VectorXd& du,
                                        double fraction, double factor) const {
  const BasicDofSpace<Dim>& dofs = impl_->dofs;
  Trial moved = trial;
  State& next = moved.state;
  next.fraction = fraction;
  for (Index u = 0; u < dofs.unknowns(); ++u)
    if (!impl_->assembler.prescribed(u))
      impl_->add_to(next, dofs.dof_of_unknown(u), factor * du[u]);
  impl_->constraints.move(next, du, factor);
  for (const PrescribedDof& p : impl_->step.prescribed)
    impl_->add_to(next, p.dof, p.ramp.value(fraction) - impl_->current_value(next, p.dof));
  for (Index node = 0; node < dofs.nodes(); ++node) {
    const Index b = dofs.body_of(node);
    if (b < 0) continue;
    const Vec<Dim>& material = impl_->model.reference[static_cast<std::size_t>(node)];
    next.u.template segment<Dim>(Dim * node) =
        next.rigid[static_cast<std::size_t>(b)].position(material) - material;
  }
  for (const Equation& equation : dofs.equations()) {
    double rest = impl_->equation_value(equation, fraction);
    for (std::size_t t = 1; t < equation.terms.size(); ++t)
      rest -= equation.terms[t].factor * impl_->current_value(next, equation.terms[t].dof);
    const Equation::Term& lead = equation.terms.front();
    impl_->add_to(next, lead.dof, rest / lead.factor - impl_->current_value(next, lead.dof));
  }
  return moved;
}

template <int Dim>
BasicTrial<Dim> BasicSystem<Dim>::remember(const Trial& trial) const {
  Trial next{trial.state};
  std::vector<pairing::PairMultipliers<Dim>>& multipliers = next.state.multipliers;
  for (std::size_t p = 0; p < impl_->last.contact.size(); ++p)
    next.active_set.push_back(pairing::evaluated_active_set(
        impl_->last.contact[p],
        p < trial.active_set.size() ? trial.active_set[p] : pairing::ActiveSet<Dim>{}));
  for (std::size_t p = 0; p < multipliers.size(); ++p)
    multipliers[p] = pairing::taken_over(impl_->last.contact[p], std::move(multipliers[p]));
  constexpr std::size_t most = 8;
  if (impl_->recent.size() == most) impl_->recent.pop_front();
  impl_->recent.push_back(impl_->contact.states(impl_->last));
  return next;
}

template <int Dim>
std::vector<ContactStates> BasicSystem<Dim>::recent_contact() const {
  std::vector<ContactStates> states(impl_->recent.begin(), impl_->recent.end());
  states.push_back(impl_->contact.states(impl_->last));
  return states;
}

template <int Dim>
BasicState<Dim> BasicSystem<Dim>::commit(const Trial& trial, double fraction) const {
  if (const core::Ranks* const ranks = impl_->bulk.ranks)
    impl_->bulk.exchange_memory(*ranks, impl_->bulk.shares.own_cells, impl_->last.memory);
  State state = trial.state;
  if (impl_->timed()) {
    state.rates = impl_->motion->new_rates(trial.state);
    impl_->motion->rebase(state);
  }
  state.fraction = fraction;
  state.memory = impl_->last.memory;
  impl_->contact.look_far(trial.state, positions(trial.state), impl_->last);
  for (std::size_t p = 0; p < impl_->last.contact.size(); ++p) {
    std::vector<double> overlap = std::move(state.pairs[p].overlap);
    state.pairs[p] = pairing::commit(impl_->last.contact[p]);
    state.pairs[p].overlap = std::move(overlap);
  }
  for (std::size_t p = 0; p < state.multipliers.size(); ++p)
    state.multipliers[p] = pairing::commit(impl_->last.contact[p], std::move(state.multipliers[p]));
  if (impl_->motion) impl_->motion->forget_impulses(state.multipliers);
  return state;
}

template <int Dim>
std::optional<BasicTrial<Dim>> BasicSystem<Dim>::augment(const Trial& trial) const {
  Trial next{trial.state};
  bool missed = false;
  for (std::size_t p = 0; p < trial.state.multipliers.size(); ++p) {
    const BasicContactPair<Dim>& whole = impl_->model.pairs[p];
    const pairing::PairDefinition<Dim>& pair = whole.definition;
    if (adapts_penalty(impl_->model, whole)) {
      double& stiffening = next.state.multipliers[p].stiffening;
      const double more = wanted_stiffening(mean_share(whole, impl_->last.contact[p]), stiffening);
      stiffening *= more;
      missed = missed || more > 1;
    }
    const auto* const asked = std::get_if<pairing::ByAugmentedLagrange>(&pair.enforcement);
    if (!asked) continue;
    next.state.multipliers[p] =
        pairing::augmented(pair, impl_->last.contact[p], trial.state.multipliers[p]);
    if (next.state.multipliers[p].violation > asked->target) missed = true;
  }
  if (!missed) return std::nullopt;
  return next;
}

template <int Dim>
std::optional<BasicTrial<Dim>> BasicSystem<Dim>::relaxed(const Trial& trial) const {
  constexpr double sunk = 0.05, much = 1.0 / 32, pressed = 1e-9;
  double softer = std::ldexp(1.0, -13);
  bool any = false;
  const auto yields = [&](const BasicContactPair<Dim>& pair) {
    return !pairing::by_multipliers(pair.definition) &&
           pairing::is<pairing::MayPart>(pair.definition.separation);
  };
  for (std::size_t p = 0; p < trial.state.multipliers.size(); ++p) {
    const BasicContactPair<Dim>& pair = impl_->model.pairs[p];
    const double before = committed_share(pair, trial.state.pairs[p]);
    if (!yields(pair) || !(before > pressed)) continue;
    any = any || mean_share(pair, impl_->last.contact[p]) > 0;
    softer = std::max(softer, before / sunk);
  }
  if (!any || impl_->timed() || !(softer <= much)) return std::nullopt;
  Trial next{trial.state};
  for (std::size_t p = 0; p < next.state.multipliers.size(); ++p)
    if (yields(impl_->model.pairs[p])) next.state.multipliers[p].stiffening *= softer;
  return next;
}

template <int Dim>
BasicTrial<Dim> BasicSystem<Dim>::restored(const Trial& trial, const Trial& before,
                                           double part) const {
  Trial next{trial.state};
  for (std::size_t p = 0; p < next.state.multipliers.size(); ++p)
    next.state.multipliers[p].stiffening =
        before.state.multipliers[p].stiffening *
        std::pow(trial.state.multipliers[p].stiffening / before.state.multipliers[p].stiffening,
                 part);
  return next;
}

template <int Dim>
bool BasicSystem<Dim>::augments_often() const {
  return std::ranges::any_of(impl_->model.pairs, [](const BasicContactPair<Dim>& pair) {
    const auto* const asked =
        std::get_if<pairing::ByAugmentedLagrange>(&pair.definition.enforcement);
    return asked && asked->every_iteration;
  });
}

template <int Dim>
bool BasicSystem<Dim>::may_stay() const {
  return std::ranges::none_of(impl_->model.pairs, [](const BasicContactPair<Dim>& pair) {
    return pairing::is<pairing::ByAugmentedLagrange>(pair.definition.enforcement);
  });
}

template <int Dim>
std::string BasicSystem<Dim>::refused(const State& committed, const Trial& trial) const {
  std::vector<Vec<Dim>> x;
  for (std::size_t p = 0; p < impl_->model.pairs.size(); ++p) {
    const BasicContactPair<Dim>& pair = impl_->model.pairs[p];
    if (pair.definition.filter.limited()) continue;
    if (x.empty()) x = positions(trial.state);
    std::string text =
        passed_through(impl_->model, pair, in_front(committed.pairs[p], pair.definition.offset),
                       impl_->last.contact[p], x);
    if (!text.empty()) return text;
  }
  return {};
}

template <int Dim>
std::vector<Index> BasicSystem<Dim>::changing_unknowns() const {
  // Multipliers make the small matrix indefinite, which only its unsymmetric factors bear.
  if (impl_->constraints.count() > 0 && impl_->symmetry != la::Symmetry::unsymmetric) return {};
  return model::changing_unknowns(impl_->model, impl_->dofs, impl_->constraints.count());
}

template <int Dim>
la::Places BasicSystem<Dim>::unknown_places() const {
  return model::unknown_places(impl_->model, impl_->dofs, impl_->constraints.count());
}

template <int Dim>
Index BasicSystem<Dim>::displacements() const {
  return impl_->dofs.unknowns();
}

template <int Dim>
Index BasicSystem<Dim>::unknowns() const {
  return impl_->constraints.end;
}

template <int Dim>
const la::SparseMatrix& BasicSystem<Dim>::matrix() {
  const Stopwatch watch;
  impl_->reserve_pattern();
  const la::SparseMatrix& k = impl_->builder.finish();
  impl_->assembly_seconds += watch.seconds();
  return k;
}
template <int Dim>
std::uint64_t BasicSystem<Dim>::pattern_version() const {
  impl_->reserve_pattern();
  return impl_->builder.pattern_version();
}
template <int Dim>
la::Symmetry BasicSystem<Dim>::symmetry() const {
  return impl_->symmetry;
}
template <int Dim>
bool BasicSystem<Dim>::nearly_symmetric() const {
  return impl_->nearly_symmetric;
}
template <int Dim>
const BasicDofSpace<Dim>& BasicSystem<Dim>::dofs() const {
  return impl_->dofs;
}
template <int Dim>
const Forces& BasicSystem<Dim>::forces() const {
  return impl_->last.forces;
}
template <int Dim>
const std::vector<pairing::PairEvaluation<Dim>>& BasicSystem<Dim>::contact() const {
  return impl_->last.contact;
}
template <int Dim>
const std::vector<double>& BasicSystem<Dim>::material_memory() const {
  return impl_->last.memory;
}
template <int Dim>
const std::vector<bool>& BasicSystem<Dim>::touched() const {
  return impl_->touched;
}
template <int Dim>
std::vector<Vec<Dim>> BasicSystem<Dim>::positions(const State& state) const {
  return impl_->positions(state.u);
}
template <int Dim>
bool BasicSystem<Dim>::prescribed(Index unknown) const {
  return unknown < impl_->dofs.unknowns() && impl_->assembler.prescribed(unknown);
}
template <int Dim>
SystemSeconds BasicSystem<Dim>::seconds() const {
  SystemSeconds out;
  out.contact = impl_->contact.seconds;
  out.bulk = impl_->bulk.seconds;
  out.assembly = impl_->assembly_seconds;
  for (const pairing::PairEvaluation<Dim>& pair : impl_->last.contact) {
    out.contact_parts.search += pair.seconds.search;
    out.contact_parts.projection += pair.seconds.projection;
    out.contact_parts.evaluation += pair.seconds.evaluation;
  }
  return out;
}
template <int Dim>
void BasicSystem<Dim>::interrupt_by(std::function<bool()> asked) {
  impl_->asked = std::move(asked);
}
template <int Dim>
bool BasicSystem<Dim>::interrupted() const {
  return impl_->asked && impl_->asked();
}
template <int Dim>
bool BasicSystem<Dim>::soften() {
  if (impl_->constraints.count() == 0) return false;
  impl_->constraints.soften(impl_->builder);
  return true;
}
template <int Dim>
bool BasicSystem<Dim>::at_rest() const {
  return !impl_->timed();
}
template <int Dim>
void BasicSystem<Dim>::resist(double share) {
  Resistance<Dim>& resistance = impl_->resistance;
  if (share == resistance.share) return;
  if (resistance.diagonal.size() == 0) resistance.measure(impl_->bulk, impl_->dofs);
  resistance.add(share - resistance.share, impl_->assembler, impl_->builder);
  resistance.share = share;
}
template <int Dim>
double BasicSystem<Dim>::stride(const Eigen::VectorXd& du) const {
  const BasicDofSpace<Dim>& dofs = impl_->dofs;
  const Dof first = Dim * dofs.nodes();
  double largest = 0, height = 0;
  for (Index u = 0; u < dofs.unknowns(); ++u) {
    if (impl_->assembler.prescribed(u)) continue;
    const Dof dof = dofs.dof_of_unknown(u);
    const bool turns = dof >= first && (dof - first) % body::motions<Dim> >= Dim;
    largest = std::max(largest, std::abs(du[u]) * (turns ? impl_->resistance.extent : 1.0));
  }
  for (const BasicContactPair<Dim>& pair : impl_->model.pairs)
    if (pair.height > 0) height = height > 0 ? std::min(height, pair.height) : pair.height;
  if (!(height > 0)) height = 0.01 * impl_->resistance.extent;
  return largest / std::max(height, impl_->last.carried);
}
template <int Dim>
void BasicSystem<Dim>::enable(Term term, bool on) {
  impl_->enabled[static_cast<std::size_t>(term)] = on;
}

template class BasicSystem<2>;
template class BasicSystem<3>;

}  // namespace osculate::model
