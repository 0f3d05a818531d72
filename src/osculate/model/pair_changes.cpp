#include "osculate/model/pair_changes.hpp"

#include <limits>

namespace osculate::model {
namespace {

constexpr double nowhere = -std::numeric_limits<double>::infinity();

template <int Dim>
bool is_active(const pairing::PairDefinition<Dim>& pair) {
  return pair.depth != nowhere;
}

/// How a pair is in a step; -1: before the first one.
template <int Dim>
pairing::PairDefinition<Dim> pair_in(const BasicModel<Dim>& original, std::size_t pair,
                                     std::ptrdiff_t step) {
  pairing::PairDefinition<Dim> now = original.pairs[pair].definition;
  for (const BasicPairChange<Dim>& change : original.pair_changes) {
    if (change.pair != pair || static_cast<std::ptrdiff_t>(change.step) > step) continue;
    now.normal = change.normal;
    now.friction = change.friction;
    now.damping = change.damping;
    now.separation = change.active ? change.separation : pairing::Separation<Dim>{};
    now.depth = change.active ? original.pairs[pair].definition.depth : nowhere;
  }
  return now;
}

}  // namespace

template <int Dim>
void change_pairs(const BasicModel<Dim>& original, std::size_t step, BasicModel<Dim>& now) {
  for (const BasicPairChange<Dim>& change : original.pair_changes)
    now.pairs[change.pair].definition =
        pair_in(original, change.pair, static_cast<std::ptrdiff_t>(step));
}

template <int Dim>
BasicState<Dim> begin_anew(const BasicModel<Dim>& original, std::size_t step,
                           const BasicModel<Dim>& now, BasicState<Dim> state) {
  std::vector<Vec<Dim>> x = original.reference;
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] += state.u.template segment<Dim>(Dim * static_cast<Eigen::Index>(n));
  for (const BasicPairChange<Dim>& change : original.pair_changes) {
    if (change.step != step) continue;
    const pairing::PairDefinition<Dim>& pair = now.pairs[change.pair].definition;
    const pairing::PairDefinition<Dim> before =
        pair_in(original, change.pair, static_cast<std::ptrdiff_t>(step) - 1);
    if (is_active(before) == is_active(pair) &&
        before.separation.index() == pair.separation.index())
      continue;
    state.pairs[change.pair] = pairing::initial_state<Dim>(pair, x);
  }
  return state;
}

template void change_pairs(const Model&, std::size_t, Model&);
template void change_pairs(const Model3&, std::size_t, Model3&);
template State begin_anew(const Model&, std::size_t, const Model&, State);
template State3 begin_anew(const Model3&, std::size_t, const Model3&, State3);

}  // namespace osculate::model
