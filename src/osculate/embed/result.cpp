#include "osculate/result.hpp"

#include "osculate/embed/collect.hpp"

namespace osculate {
namespace {

using embed::Access;

template <int Dim>
const embed::Evaluation<Dim>& made(const embed::Evaluation<Dim>& e) {
  if (!e.of) throw Refused("the result is of no evaluation yet");
  return e;
}

}  // namespace

template <int Dim>
Result<Dim>::Result() : value_(std::make_unique<embed::Evaluation<Dim>>()) {}
template <int Dim>
Result<Dim>::~Result() = default;
template <int Dim>
Result<Dim>::Result(Result&&) noexcept = default;
template <int Dim>
Result<Dim>& Result<Dim>::operator=(Result&&) noexcept = default;

template <int Dim>
std::span<const double> Result<Dim>::force() const {
  return value_->force;
}
template <int Dim>
bool Result<Dim>::branched() const {
  return value_->branched;
}
template <int Dim>
std::span<const double> Result<Dim>::branch_force() const {
  return value_->branch_force;
}
template <int Dim>
std::span<const Entry> Result<Dim>::tangent() const {
  return value_->tangent;
}
template <int Dim>
void Result<Dim>::visit_blocks(const BlockVisitor& visit) const {
  if (value_->tangent.empty()) return;
  std::vector<Index> nodes;
  std::vector<double> values;
  for (const pairing::ContactBlock<Dim>& block : value_->contact.blocks) {
    if (!block.active()) continue;
    const std::span<const Index> rows(block.nodes.data(), static_cast<std::size_t>(block.count));
    embed::for_rectangles(block, [&](int columns, const auto& node, const auto& value) {
      nodes.clear();
      values.clear();
      for (int k = 0; k < columns; ++k) nodes.push_back(node(k));
      for (int i = 0; i < Dim * block.count; ++i)
        for (int k = 0; k < columns; ++k)
          for (int d = 0; d < Dim; ++d) values.push_back(value(i, k, d));
      visit(rows, nodes, values);
    });
  }
}
template <int Dim>
std::span<const ContactPoint<Dim>> Result<Dim>::points() const {
  return value_->points;
}
template <int Dim>
const Constraints& Result<Dim>::constraints() const {
  return value_->constraints;
}

template <int Dim>
ActiveSet<Dim> Result<Dim>::next_active_set() const {
  const embed::Evaluation<Dim>& e = made(*value_);
  ActiveSet<Dim> out;
  Access::of(out) = std::make_shared<const embed::ActiveState<Dim>>(
      embed::ActiveState<Dim>{e.of->key, pairing::evaluated_active_set(e.contact, e.active_set)});
  return out;
}

template <int Dim>
Multipliers<Dim> Result<Dim>::multipliers() const {
  const embed::Evaluation<Dim>& e = made(*value_);
  return embed::from_pair<Dim>(pairing::taken_over(e.contact, e.used));
}

template <int Dim>
Multipliers<Dim> Result<Dim>::corrected_multipliers() const {
  const embed::Evaluation<Dim>& e = made(*value_);
  return embed::from_pair<Dim>(pairing::augmented(e.of->pair, e.contact, e.used));
}

/// What was left out because it was far away is remembered too.
template <int Dim>
History<Dim> Result<Dim>::committed() const {
  const embed::Evaluation<Dim>& e = made(*value_);
  embed::HistoryState<Dim> next{e.of->key, {}};
  if (e.contact.near && e.of->pair.filter.limited()) {
    pairing::PairEvaluation<Dim> whole = e.contact;
    pairing::look_far<Dim>(e.of->pair, e.x, e.committed->state, whole);
    next.state = pairing::commit(whole);
  } else {
    next.state = pairing::commit(e.contact);
  }
  next.state.overlap = e.committed->state.overlap;
  History<Dim> out;
  Access::of(out) = std::make_shared<const embed::HistoryState<Dim>>(std::move(next));
  return out;
}

template <int Dim>
Multipliers<Dim> Result<Dim>::committed_multipliers() const {
  const embed::Evaluation<Dim>& e = made(*value_);
  return embed::from_pair<Dim>(pairing::commit(e.contact, e.used));
}

template class Result<2>;
template class Result<3>;

}  // namespace osculate
