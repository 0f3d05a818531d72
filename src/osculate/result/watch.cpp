#include "osculate/result/watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/model/beyond_slave.hpp"
#include "osculate/model/passed_through.hpp"
#include "osculate/result/initial_gaps.hpp"
#include "osculate/result/never_closed.hpp"
#include "osculate/result/penetration.hpp"
#include "osculate/result/pulling.hpp"
#include "osculate/result/soft_friction.hpp"
#include "osculate/result/without_clearance.hpp"
#include "osculate/result/without_force.hpp"

namespace osculate::result {
namespace {

void add(std::string text, std::vector<std::string>& texts) {
  if (!text.empty()) texts.push_back(std::move(text));
}

/// A warning where a step ends in an equilibrium that does not last; else empty.
std::string does_not_last(const std::string& step, const solve::IncrementRecord& record) {
  const int motions = record.precision.unstable;
  if (motions == 0) return {};
  return fmt::format(
      "warning: step '{}' ends in an unstable equilibrium: the least disturbance makes the bodies "
      "leave it in {} (negative pivots of the tangent), as above a buckling load or a critical "
      "speed; a step with `modes` after it shows them (negative frequencies)",
      step, motions == 1 ? "one way" : fmt::format("{} ways", motions));
}

}  // namespace

template <int Dim>
std::vector<std::string> Watch<Dim>::begin(const model::BasicSystem<Dim>& system,
                                           const model::BasicState<Dim>& state) {
  std::vector<std::string> texts;
  for (std::size_t p = 0; p < model.pairs.size(); ++p)
    if (const std::string deep = deep_overlap(model, model.pairs[p], state.pairs[p]); !deep.empty())
      texts.push_back("warning: " + deep);
  now = system.positions(state);
  for (const pairing::PairEvaluation<Dim>& contact : system.contact()) {
    Penetration first;
    measure_closing(contact, false, first);
    deepest.emplace_back().least_gap = first.least_gap;
  }
  remember_front(state);
  return texts;
}

template <int Dim>
void Watch<Dim>::resume(const WatchMemory& from, const model::BasicSystem<Dim>& system,
                        const model::BasicState<Dim>& state, bool first) {
  memory = from;
  now = system.positions(state);
  moved = !first;
  remember_front(state);
}

template <int Dim>
std::vector<std::string> Watch<Dim>::take(const model::BasicSystem<Dim>& system,
                                          const model::BasicState<Dim>& state,
                                          const model::Progress& progress,
                                          const solve::IncrementRecord& record) {
  std::vector<std::string> texts;
  now = system.positions(state);
  moved = true;
  const std::size_t pairs = model.pairs.size();
  deepest.resize(pairs);
  front.resize(pairs);
  told.resize(pairs);
  memory.passed.resize(pairs);
  for (std::size_t p = 0; p < pairs; ++p) {
    const model::BasicContactPair<Dim>& pair = model.pairs[p];
    const pairing::PairEvaluation<Dim>& contact = system.contact()[p];
    measure_penetration(pair, contact, deepest[p]);
    measure_closing(contact, system.touched()[p], deepest[p]);
    measure_sticking(pair, contact, deepest[p]);
    if (progress.fraction >= 1.0)
      add(pulling(pair, contact, model.steps[static_cast<std::size_t>(progress.step)].name), texts);
    if (!told[p]) {
      std::string bare = without_clearance(model, pair, contact, state.pairs[p]);
      told[p] = bare.empty() ? 0 : 1;
      add(std::move(bare), texts);
    }
    if (!memory.passed[p]) {
      const std::string through = model::passed_through(model, pair, front[p], contact, now);
      memory.passed[p] = through.empty() ? 0 : 1;
      if (!through.empty()) texts.push_back("warning: " + through);
    }
  }
  remember_front(state);
  small_strain.take(system.model(), progress.step, state, memory.small_strains);
  if (progress.fraction >= 1.0) model::measure_locking(system.model(), state, memory.locking);
  if (progress.fraction >= 1.0)
    add(does_not_last(model.steps[static_cast<std::size_t>(progress.step)].name, record), texts);
  measure_energy(system, state, record);
  return texts;
}

template <int Dim>
void Watch<Dim>::remember_front(const model::BasicState<Dim>& state) {
  front.resize(model.pairs.size());
  for (std::size_t p = 0; p < model.pairs.size(); ++p)
    front[p] = model::in_front(state.pairs[p], model.pairs[p].definition.offset);
}

/// Of explicit time integration, without what the ends of time steps borrow from their middles: the
/// work of h^2/8 a . M a (docs/dynamics.md).
template <int Dim>
void Watch<Dim>::measure_energy(const model::BasicSystem<Dim>& system,
                                const model::BasicState<Dim>& state,
                                const solve::IncrementRecord& record) {
  if (record.time_steps.count == 0) return;
  const model::Energies& e = state.rates.energies;
  const double h = record.time_steps.longest;
  const double borrowed = h * h / 8 * state.rates.acceleration.dot(system.forces().inertia);
  const double there = std::max({e.start, e.start + e.external, e.kinetic + e.strain});
  if (there > 0) memory.grown = (-e.numerical - std::max(0.0, borrowed)) / there;
}

template <int Dim>
std::vector<std::string> Watch<Dim>::end(bool open_matters) {
  std::vector<std::string> texts;
  deepest.resize(model.pairs.size());
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    add(missed_target(model, model.pairs[p], deepest[p]), texts);
    add(soft_friction(model.pairs[p], deepest[p]), texts);
    if (open_matters) add(without_force(model, model.pairs[p], deepest[p]), texts);
  }
  if (open_matters && !now.empty())
    for (std::string& text : never_closed(model, deepest, now)) add(std::move(text), texts);
  constexpr double deep = -0.05;  // of a cell
  if (open_matters && moved)
    for (const model::BeyondSlave& found : model::beyond_slave(model, now, deep))
      texts.push_back(fmt::format("warning: {}: {}", beyond_slave_text(model.mesh, found),
                                  beyond_slave_cure(found)));
  for (const model::Locking& found : memory.locking) add(model::locks(found), texts);
  for (const model::SmallStrain& found : memory.small_strains)
    add(model::left_small_strain(found), texts);
  bool damped = false;  // the onset of damped contact is not smoothed over a time step
  for (const model::BasicContactPair<Dim>& pair : model.pairs)
    damped = damped || pair.definition.damping.has_value();
  const double visible = damped ? 0.06 : 0.01;
  if (memory.grown > visible)
    add(fmt::format("warning: explicit time integration has made {:.2g} % of the energy out of "
                    "nothing: take shorter time steps (safety: or step: of central_differences)",
                    100 * memory.grown),
        texts);
  return texts;
}

template struct Watch<2>;
template struct Watch<3>;

}  // namespace osculate::result
