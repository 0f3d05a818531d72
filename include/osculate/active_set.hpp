#pragma once
#include "osculate/history.hpp"

namespace osculate {

/// What the first iteration of an increment takes the friction of points in contact for.
///   as_before   what slid goes on sliding, all else sticks
///   sticking    all points stick: what can be solved where sliding points alone hold a body
///   sliding     what slid goes on sliding; points without shear slide without friction
enum class FrictionGuess : std::uint8_t { as_before, sticking, sliding };

/// Which state every contact point is linearised in: an iteration has one and leaves the next one
/// behind. Friction sticks in a narrow range; iterations that forget from one to the next on which
/// side of it they were jump over it for ever, and so do points between two facets at an angle
/// (docs/decisions/007-friction-branches.md).
///
/// Order  an increment:   Evaluator::predicted -> evaluate at the committed coordinates -> solve ->
///        each iteration: Result::next_active_set of the last evaluation -> evaluate -> solve ...
///        The default knows nothing: every point is taken as its traction says.
template <int Dim>
class ActiveSet {
 public:
  ActiveSet() = default;

  [[nodiscard]] std::size_t size() const;              ///< number of points; 0: it knows nothing
  [[nodiscard]] bool predicts() const;                 ///< made by Evaluator::predicted
  [[nodiscard]] std::vector<std::byte> bytes() const;  ///< as History::bytes

 private:
  friend struct embed::Access;
  std::shared_ptr<const embed::ActiveState<Dim>> value_;
};

extern template class ActiveSet<2>;
extern template class ActiveSet<3>;

}  // namespace osculate
