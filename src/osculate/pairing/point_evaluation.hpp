#pragma once
// One contact point, from its place to forces, tangent and history; for sources of this layer.
#include <algorithm>
#include <optional>

#include "osculate/pairing/point_penalty.hpp"

namespace osculate::pairing {

/// The normal law's answer at the linearised gap of an open point that stays in contact for the
/// next correction, and how much farther than that gap the point is (keeps_contact).
struct KeptContact {
  contact::NormalResponse response;
  double farther = 0;
};

/// What is known of a point before the law is asked: its branch, and the multiplier its penalties
/// act around.
template <int Dim>
struct BranchHint {
  AssumedBranch<Dim> assumed{};
  bool predict = false;
  bool known = false;   ///< `assumed` is of an iteration (or predicted), not made up
  double duration = 0;  ///< of the increment
  double relieved = 0;  ///< part <= 0 of the gap that does not count (PairState::overlap)
  double way = 0;       ///< of the gap in the increment, with Assumed::mean_onset
  const contact::Multiplier<Dim>* multiplier = nullptr;
  double stiffening = 1;
  RelativeStiffness own{};  ///< factors of the point's penalties
  std::optional<KeptContact> kept{};
};

/// The hint of point i.
template <int Dim>
[[nodiscard]] BranchHint<Dim> hint_of(const PairDefinition<Dim>& pair, const Assumed<Dim>& assumed,
                                      const PairMultipliers<Dim>* multipliers, std::size_t i) {
  BranchHint<Dim> hint;
  hint.own = relative_stiffness(pair, i);
  if (!assumed.branch.empty()) {
    hint.assumed = assumed.branch[i];
    hint.predict = assumed.predict;
    hint.known = true;
  }
  hint.duration = assumed.duration;
  if (multipliers) {
    hint.stiffening = multipliers->stiffening;
    if (i < multipliers->points.size()) hint.multiplier = &multipliers->points[i];
  }
  return hint;
}

/// What a constraint is multiplied by: it does not change with the deformation.
template <int Dim>
[[nodiscard]] double constraint_weight(const PairDefinition<Dim>& pair, std::size_t i) {
  return pair.weight == Weight::node ? 1.0 : pair.reference_areas[i];
}

/// The nodes of a block: the slave's, then those of the facet it is placed on.
template <int Dim>
void set_nodes(ContactBlock<Dim>& block, const Boundary<Dim>& master, const Placed<Dim>& placed,
               const SlavePoint<Dim>& slave, int most) {
  const auto& facet = master.facets[static_cast<std::size_t>(placed.projection.facet)];
  block.reserve(most);
  block.count = slave.count + placed.count;
  block.slave_count = slave.count;
  std::copy_n(slave.nodes.begin(), slave.count, block.nodes.begin());
  std::copy_n(facet.nodes.begin(), placed.count, block.nodes.begin() + slave.count);
}

/// The block of a point that is not in contact.
template <int Dim>
void clear_block(ContactBlock<Dim>& block) {
  block.count = 0;
  block.branched = false;
  block.behind.path.clear();
  block.area.clear();
  block.constraint.on = false;
}

/// Whether the tractions of the point are unknowns; if so its constraint starts as that of an open
/// point.
template <int Dim>
bool start_constraint(const PairDefinition<Dim>& pair, const BranchHint<Dim>& hint, std::size_t i,
                      ContactBlock<Dim>& block) {
  if (pair.enforcement != contact::Enforcement::lagrange_multiplier || !hint.multiplier)
    return false;
  const PointPenalty penalty = point_penalty(pair, i);
  set_open(constraint_weight(pair, i), penalty.normal, penalty.shear, hint.multiplier->normal,
           hint.multiplier->shear, block.constraint);
  return true;
}

/// Values of the constraint of a point in contact: see ConstraintBlock.
template <int Dim>
void set_constraint_values(double area, double push, const Vec<Dim>& shear,
                           const Vec<Dim>& branch_shear, const contact::Multiplier<Dim>& multiplier,
                           ConstraintBlock<Dim>& c) {
  c.normal = c.branch_normal = area * (push - multiplier.normal);
  c.shear = area * (shear - multiplier.shear);
  c.branch_shear = area * (branch_shear - multiplier.shear);
}

/// Derivatives by the multipliers of a point in contact: of its forces, with `weight(n)` of node n
/// of the block, and of its constraint. dt = d_trial dLambda + d_push dlambda.
template <int Dim, class WeightOf>
void set_multiplier_terms(const PointPenalty& penalty, double area, const Vec<Dim>& normal,
                          const Mat<Dim, Dim>& d_trial, const Vec<Dim>& d_push,
                          const WeightOf& weight, ContactBlock<Dim>& block) {
  ConstraintBlock<Dim>& c = block.constraint;
  const double push = penalty.normal, shear = penalty.shear;
  if (c.columns.rows() < Dim * block.count) c.columns.resize(Dim * block.count, Dim + 1);
  for (int n = 0; n < block.count; ++n) {
    auto rows = c.columns.template middleRows<Dim>(Dim * n);
    rows.col(0) = (weight(n) * push) * (normal + d_push);
    rows.template rightCols<Dim>() = (weight(n) * shear) * d_trial;
  }
  c.own.setZero();
  c.own.template block<Dim, 1>(1, 0) = area * push * d_push;
  c.own.template bottomRightCorner<Dim, Dim>() =
      (area * shear) * (d_trial - Mat<Dim, Dim>::Identity());
}

/// Fills `out.points[i]` and `out.blocks[i]` of the slave point `i`, which is `placed` on the
/// master; `out` is refreshed at `x`.
template <int Dim>
void evaluate_point(const PairDefinition<Dim>& pair, Points<Dim> x,
                    const contact::PointHistory<Dim>& history, const Placed<Dim>& placed,
                    const BranchHint<Dim>& hint, bool with_tangent, std::size_t i,
                    PairEvaluation<Dim>& out);

/// What an open point `i` reports and remembers of the place it has been found far in front of.
template <int Dim>
void report_far(const PairDefinition<Dim>& pair, Points<Dim> x,
                const contact::PointHistory<Dim>& history, const Placed<Dim>& placed, std::size_t i,
                PairEvaluation<Dim>& out);

/// What a point remembers of a place at which it has not slipped.
template <int Dim>
[[nodiscard]] contact::PointHistory<Dim> history_at(const PairDefinition<Dim>& pair, Points<Dim> x,
                                                    const Placed<Dim>& placed);

/// Points and blocks of the crossings of edges, behind those of the slave's points.
void evaluate_crossings(const PairDefinition<3>& pair, Points<3> x, const PairState<3>& committed,
                        bool with_tangent, PairEvaluation<3>& out, const Assumed<3>& assumed);

/// Frame of a crossing's stored traction.
[[nodiscard]] Mat<3, 2> crossing_frame(const PairDefinition<3>& pair,
                                       const contact::PointHistory<3>& h, Points<3> x);

}  // namespace osculate::pairing
