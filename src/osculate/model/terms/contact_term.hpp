#pragma once
#include <span>
#include <vector>

#include "osculate/core/prediction.hpp"
#include "osculate/model/point_state.hpp"
#include "osculate/model/terms/constraint_term.hpp"
#include "osculate/solve/newton.hpp"

namespace osculate::model {

/// The contact pairs: forces and tangent of all points, and the rows of those with multipliers.
///
/// Tested by  tests/unit/model/test_contact.cpp, test_contact_tangent.cpp
template <int Dim>
struct ContactTerm {
  using State = BasicState<Dim>;
  using Trial = BasicTrial<Dim>;

  const BasicModel<Dim>& model;
  Prediction friction = Prediction::as_before;
  bool beginning = true;  ///< the first step: initial overlaps are let in
  double seconds = 0;
  pairing::Workers workers{};

  /// Share of the initial overlaps of a pair that does not count at a fraction of the step.
  [[nodiscard]] double relief(const pairing::PairDefinition<Dim>& pair, double fraction) const {
    if (pair.overlap == pairing::InitialOverlap::kept ||
        pair.overlap == pairing::InitialOverlap::given)
      return 1;
    return pair.overlap == pairing::InitialOverlap::ramped && beginning ? 1 - fraction : 0;
  }
  /// `near`: places far from the master are not needed (ActiveSet::near).
  void add(const State& committed, const Trial& trial, double fraction, double duration,
           std::span<const Vec<Dim>> x, bool near, const ConstraintTerm<Dim>& constraints,
           Assembly<Dim>& to, solve::Evaluation& out);
  /// The last evaluation, at `trial`, in whole: see pairing::look_far.
  void look_far(const State& trial, std::span<const Vec<Dim>> x, Evaluated<Dim>& last);
  [[nodiscard]] ContactStates states(const Evaluated<Dim>& last) const;
};

extern template struct ContactTerm<2>;
extern template struct ContactTerm<3>;

}  // namespace osculate::model
