#include "osculate/evaluator.hpp"

#include <fmt/format.h>

#include <cmath>

#include "osculate/embed/collect.hpp"
#include "osculate/embed/definition.hpp"
#include "osculate/pairing/point_penalty.hpp"

namespace osculate {
namespace {

using embed::Access;
using embed::Definition;

template <int Dim>
const embed::HistoryState<Dim>& state_of(const Definition<Dim>& d, const History<Dim>& history) {
  const auto& value = Access::of(history);
  if (!value) throw Refused("history: there is none; ask for initial_history first");
  if (value->key != d.key) throw Refused("history: it belongs to another contact");
  return *value;
}

/// Nothing assumed, or what belongs to this contact.
template <int Dim>
pairing::ActiveSet<Dim> active_set_of(const Definition<Dim>& d, const ActiveSet<Dim>& active) {
  const auto& value = Access::of(active);
  if (!value) return {};
  if (value->key != d.key) throw Refused("active set: it belongs to another contact");
  return value->active_set;
}

template <int Dim>
void check(const Definition<Dim>& d, const Multipliers<Dim>& m) {
  const bool needed = !pairing::is<pairing::ByPenalty>(d.pair.enforcement);
  const std::size_t expected = needed ? d.pair.slave.points.size() : 0;
  if (m.points.size() != expected)
    throw Refused(
        fmt::format("multipliers: {} points given, {} expected", m.points.size(), expected));
  for (std::size_t i = 0; i < m.points.size(); ++i)
    if (!std::isfinite(m.points[i].normal) || !embed::to_vec<Dim>(m.points[i].shear).allFinite())
      throw Refused(fmt::format("multipliers: those of point {} are not finite", i));
  if (!(m.stiffening > 0) || !std::isfinite(m.stiffening))
    throw Refused(fmt::format("multipliers: stiffening must be > 0, got {:g}", m.stiffening));
}

template <int Dim>
void check(const Definition<Dim>& d, const Increment& increment) {
  const auto timed = [](const auto& law) { return law && contact::needs_duration(*law); };
  if (!(increment.duration >= 0) || !std::isfinite(increment.duration))
    throw Refused(fmt::format("duration must be >= 0, got {:g}", increment.duration));
  if (increment.duration == 0 && (timed(d.pair.friction) || timed(d.pair.damping)))
    throw Refused("a law by speed asks for the duration of the increment");
  if (!(increment.relief >= 0 && increment.relief <= 1))
    throw Refused(fmt::format("relief lies between 0 and 1, got {:g}", increment.relief));
}

template <int Dim>
double relief_of(const Definition<Dim>& d, const Increment& increment) {
  using pairing::InitialOverlap;
  if (d.pair.overlap == InitialOverlap::kept) return 1;
  return d.pair.overlap == InitialOverlap::ramped ? increment.relief : 0;
}

}  // namespace

template <int Dim>
Evaluator<Dim>::Evaluator(const Contact<Dim>& contact, std::span<const double> reference)
    : definition_(std::make_shared<const Definition<Dim>>(embed::define<Dim>(contact, reference))) {
}

template <int Dim>
History<Dim> Evaluator<Dim>::initial_history(std::span<const double> coordinates) const {
  std::vector<Vec<Dim>> x;
  embed::read_points<Dim>(coordinates, definition_->nodes, x);
  History<Dim> out;
  Access::of(out) = std::make_shared<const embed::HistoryState<Dim>>(embed::HistoryState<Dim>{
      definition_->key, pairing::initial_state<Dim>(definition_->pair, x)});
  return out;
}

template <int Dim>
ActiveSet<Dim> Evaluator<Dim>::predicted(const History<Dim>& committed,
                                         std::span<const double> coordinates,
                                         FrictionGuess guess) const {
  static_assert(static_cast<Prediction>(FrictionGuess::sliding) == Prediction::sliding &&
                static_cast<Prediction>(FrictionGuess::sticking) == Prediction::sticking);
  std::vector<Vec<Dim>> x;
  embed::read_points<Dim>(coordinates, definition_->nodes, x);
  ActiveSet<Dim> out;
  Access::of(out) = std::make_shared<const embed::ActiveState<Dim>>(embed::ActiveState<Dim>{
      definition_->key,
      pairing::committed_active_set<Dim>(definition_->pair, state_of(*definition_, committed).state,
                                         x, static_cast<Prediction>(guess))});
  return out;
}

template <int Dim>
Multipliers<Dim> Evaluator<Dim>::initial_multipliers() const {
  Multipliers<Dim> out;
  if (!pairing::is<pairing::ByPenalty>(definition_->pair.enforcement))
    out.points.resize(definition_->pair.slave.points.size());
  return out;
}

template <int Dim>
void Evaluator<Dim>::evaluate(std::span<const double> coordinates, const History<Dim>& committed,
                              const ActiveSet<Dim>& active_set, Result<Dim>& out,
                              const Increment& increment) const {
  if (!pairing::is<pairing::ByPenalty>(definition_->pair.enforcement))
    throw Refused("this enforcement is around multipliers: none are given");
  evaluate(coordinates, committed, active_set, Multipliers<Dim>{}, out, increment);
}

template <int Dim>
void Evaluator<Dim>::evaluate(std::span<const double> coordinates, const History<Dim>& committed,
                              const ActiveSet<Dim>& active_set, const Multipliers<Dim>& multipliers,
                              Result<Dim>& out, const Increment& increment) const {
  const Definition<Dim>& d = *definition_;
  check(d, multipliers);
  check(d, increment);
  state_of(d, committed);
  pairing::ActiveSet<Dim> from = active_set_of(d, active_set);
  from.duration = increment.duration;
  from.relief = relief_of(d, increment);
  from.near = !from.predict && !increment.far;
  embed::Evaluation<Dim>& e = *Access::of(out);
  embed::read_points<Dim>(coordinates, d.nodes, e.x);
  if (e.of != definition_) e.contact = {};  // buffers are of one contact
  e.of = definition_;
  e.committed = Access::of(committed);
  e.active_set = std::move(from);
  e.used = embed::to_pair<Dim>(multipliers);
  pairing::evaluate<Dim>(d.pair, e.x, e.committed->state, increment.tangent, e.contact,
                         e.active_set, &e.used);
  embed::collect(increment.tangent, e);
}

template <int Dim>
std::vector<SlavePoint<Dim>> Evaluator<Dim>::slave_points() const {
  std::vector<SlavePoint<Dim>> out;
  for (const pairing::SlavePoint<Dim>& p : definition_->pair.slave.points)
    out.push_back({{p.nodes.begin(), p.nodes.begin() + p.count},
                   {p.shape.begin(), p.shape.begin() + p.count},
                   p.facet});
  return out;
}

template <int Dim>
Index Evaluator<Dim>::unknowns_per_point() const {
  return embed::unknowns_per_point(definition_->pair);
}

template <int Dim>
Multipliers<Dim> Evaluator<Dim>::multipliers_of(std::span<const double> unknowns) const {
  const pairing::PairDefinition<Dim>& pair = definition_->pair;
  const auto per = static_cast<std::size_t>(unknowns_per_point());
  Multipliers<Dim> out = initial_multipliers();
  if (unknowns.size() != per * out.points.size())
    throw Refused(fmt::format("multipliers: {} unknowns given, {} expected", unknowns.size(),
                              per * out.points.size()));
  for (std::size_t i = 0; i < out.points.size(); ++i) {
    const pairing::PointPenalty penalty = pairing::point_penalty(pair, i);
    out.points[i].normal = penalty.normal * unknowns[per * i];
    for (std::size_t k = 1; k < per; ++k)
      out.points[i].shear[k - 1] = penalty.shear * unknowns[per * i + k];
  }
  return out;
}

template <int Dim>
std::vector<double> Evaluator<Dim>::unknowns_of(const Multipliers<Dim>& multipliers) const {
  check(*definition_, multipliers);
  const auto per = static_cast<std::size_t>(unknowns_per_point());
  std::vector<double> out;
  for (std::size_t i = 0; i < multipliers.points.size(); ++i) {
    const pairing::PointPenalty penalty = pairing::point_penalty(definition_->pair, i);
    out.push_back(multipliers.points[i].normal / penalty.normal);
    for (std::size_t k = 1; k < per; ++k)
      out.push_back(multipliers.points[i].shear[k - 1] / penalty.shear);
  }
  return out;
}

template class Evaluator<2>;
template class Evaluator<3>;

}  // namespace osculate
