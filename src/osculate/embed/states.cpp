// The values of hosts as bytes.
#include <cmath>

#include "osculate/embed/state_bytes.hpp"
#include "osculate/evaluator.hpp"
#include "osculate/pairing/archive.hpp"

namespace osculate {
namespace {

using embed::Access;
using embed::Kind;

template <class... T>
std::string saved(const T&... values) {
  core::Saver saver;
  saver(values...);
  return saver.take();
}

}  // namespace

template <int Dim>
std::size_t History<Dim>::size() const {
  return value_ ? value_->state.points.size() : 0;
}

template <int Dim>
std::vector<std::byte> History<Dim>::bytes() const {
  if (!value_) throw Refused("history: there is none");
  return embed::packed(Kind::history, Dim, value_->key, saved(value_->state));
}

template <int Dim>
std::size_t ActiveSet<Dim>::size() const {
  return value_ ? value_->active_set.branch.size() : 0;
}

template <int Dim>
bool ActiveSet<Dim>::predicts() const {
  return value_ && value_->active_set.predict;
}

template <int Dim>
std::vector<std::byte> ActiveSet<Dim>::bytes() const {
  if (!value_) throw Refused("active set: there is none");
  return embed::packed(Kind::active_set, Dim, value_->key,
                       saved(value_->active_set.branch, value_->active_set.predict));
}

template <int Dim>
History<Dim> Evaluator<Dim>::history(std::span<const std::byte> bytes) const {
  embed::HistoryState<Dim> state{definition_->key, {}};
  embed::load(embed::unpacked(Kind::history, Dim, state.key, bytes), state.state);
  History<Dim> out;
  Access::of(out) = std::make_shared<const embed::HistoryState<Dim>>(std::move(state));
  return out;
}

template <int Dim>
ActiveSet<Dim> Evaluator<Dim>::active_set(std::span<const std::byte> bytes) const {
  embed::ActiveState<Dim> state{definition_->key, {}};
  embed::load(embed::unpacked(Kind::active_set, Dim, state.key, bytes), state.active_set.branch,
              state.active_set.predict);
  ActiveSet<Dim> out;
  Access::of(out) = std::make_shared<const embed::ActiveState<Dim>>(std::move(state));
  return out;
}

template <int Dim>
std::vector<std::byte> Evaluator<Dim>::bytes(const Multipliers<Dim>& multipliers) const {
  return embed::packed(Kind::multipliers, Dim, definition_->key,
                       saved(embed::to_pair<Dim>(multipliers)));
}

template <int Dim>
Multipliers<Dim> Evaluator<Dim>::multipliers(std::span<const std::byte> bytes) const {
  pairing::PairMultipliers<Dim> out;
  embed::load(embed::unpacked(Kind::multipliers, Dim, definition_->key, bytes), out);
  return embed::from_pair<Dim>(out);
}

template class History<2>;
template class History<3>;
template class ActiveSet<2>;
template class ActiveSet<3>;
template History<2> Evaluator<2>::history(std::span<const std::byte>) const;
template History<3> Evaluator<3>::history(std::span<const std::byte>) const;
template ActiveSet<2> Evaluator<2>::active_set(std::span<const std::byte>) const;
template ActiveSet<3> Evaluator<3>::active_set(std::span<const std::byte>) const;
template std::vector<std::byte> Evaluator<2>::bytes(const Multipliers<2>&) const;
template std::vector<std::byte> Evaluator<3>::bytes(const Multipliers<3>&) const;
template Multipliers<2> Evaluator<2>::multipliers(std::span<const std::byte>) const;
template Multipliers<3> Evaluator<3>::multipliers(std::span<const std::byte>) const;

}  // namespace osculate
