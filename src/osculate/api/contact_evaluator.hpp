#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "osculate/api/facet_list.hpp"
#include "osculate/core/types.hpp"
#include "osculate/pairing/pair.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::api {

/// Contact for another finite-element code: surfaces and coordinates in, forces, tangent and
/// history out. No mesh, no solver, no file format. Several evaluators may live at once.
///
/// Order of calls:   construct -> (evaluate ... evaluate -> commit) per increment
///
/// With another enforcement than the penalty the host carries the multipliers, as a value that it
/// hands to `evaluate`:
///   augmented_lagrange   multipliers() -> ((evaluate ...) -> corrected until its `violation` is
///                        small enough -> commit) per increment
///   lagrange_multiplier  they are unknowns of the host: multipliers_of(its unknowns) -> evaluate,
///                        whose result has the constraints, their rows and columns
struct ContactOptions {
  double normal_penalty = 0;  ///< eps_N > 0, unless there is a `normal`
  /// Empty: frictionless. A coefficient that depends on speed is not for this: it has no time.
  std::optional<contact::FrictionLaw> friction;
  pairing::Weight weight = pairing::Weight::reference_area;
  contact::ResidualForm residual = contact::ResidualForm::surface;
  contact::TangentForm tangent{};
  pairing::AreaRule area{};                    ///< thickness, or circumference (in the plane)
  std::optional<contact::NormalLaw> normal{};  ///< another law than the penalty
  /// Restitution only: viscous damping needs a time.
  std::optional<contact::DampingLaw> damping{};
  pairing::Separation separation = pairing::Separation::allowed;
  double tolerance = 0;          ///< of separation tied, tied_normal: gap of held points
  double offset = 0;             ///< half thicknesses of both sides, taken off the gap
  pairing::Sampling sampling{};  ///< nodes, or points of a rule on the slave's facets
  contact::Enforcement enforcement = contact::Enforcement::penalty;
};

/// One entry of the tangent (to be summed): d force[row] / d coordinate[column].
struct TangentEntry {
  Index row, column;
  double value;
};

/// Constraints of one evaluation whose tractions are unknowns of the host: one normal constraint a
/// point, and with friction Dim for its shear behind it. The unknowns stand in the same order: the
/// multipliers by their penalties, lambda / eps_N and t / eps_T, which have the unit of a length
/// and keep the symmetry of a frictionless problem.
///
/// Formula    see pairing::ConstraintBlock: in contact gap and elastic slip times area and penalty,
///            in the open the multipliers themselves; all vanish at the solution
struct ContactConstraints {
  std::vector<double> value;
  std::vector<TangentEntry> rows;     ///< d value[row] / d coordinate[column]
  std::vector<TangentEntry> columns;  ///< d force[row] / d unknown[column]
  std::vector<TangentEntry> own;      ///< d value[row] / d unknown[column]
};

/// Result of one evaluation. Row Dim n + i is direction i of node n.
template <int Dim>
struct BasicContactResult {
  std::vector<double> force;  ///< to be ADDED to the internal forces
  std::vector<TangentEntry> tangent;
  std::span<const pairing::PointResult<Dim>>
      points;                        ///< one per slave point, valid until the next call
  ContactConstraints constraints{};  ///< enforcement: lagrange_multiplier
};

/// In the plane (Dim = 2) or in space (Dim = 3); the same code but for the facets.
///
/// Tested by  tests/unit/api/test_contact_evaluator.cpp, test_contact_enforcement.cpp
template <int Dim>
class BasicContactEvaluator {
 public:
  /// `reference`: x0 y0 (z0) x1 y1 ... of all nodes that the lists name.
  /// Errors     core::InputError for a list or value that cannot be used
  BasicContactEvaluator(const ContactOptions& options, BasicFacetList<Dim> master,
                        BasicFacetList<Dim> slave, std::span<const double> reference);
  ~BasicContactEvaluator();
  BasicContactEvaluator(BasicContactEvaluator&&) noexcept;
  BasicContactEvaluator& operator=(BasicContactEvaluator&&) noexcept;

  /// Slave nodes, with `sampling` at nodes in the order of `BasicContactResult::points`.
  [[nodiscard]] std::span<const Index> slave_nodes() const;
  /// The slave's points in the order of `BasicContactResult::points`: nodes, their shares, and the
  /// place on the facet.
  [[nodiscard]] std::span<const pairing::SlavePoint<Dim>> slave_points() const;
  /// Forces (and tangent) at these coordinates, from the history of the last commit.
  [[nodiscard]] BasicContactResult<Dim> evaluate(std::span<const double> coordinates,
                                                 bool with_tangent);
  /// The same around multipliers, which every enforcement but the penalty needs.
  [[nodiscard]] BasicContactResult<Dim> evaluate(std::span<const double> coordinates,
                                                 bool with_tangent,
                                                 const pairing::PairMultipliers<Dim>& multipliers);
  /// Accepts the last evaluation as the new history (a converged increment).
  void commit();
  /// The same around multipliers; returns those that the next increment starts with.
  [[nodiscard]] pairing::PairMultipliers<Dim> commit(pairing::PairMultipliers<Dim> multipliers);

  /// Multipliers to start from: no traction.
  [[nodiscard]] pairing::PairMultipliers<Dim> multipliers() const;
  /// Those that the last evaluation, made around `used`, asks for (Uzawa). Its `violation` is the
  /// largest gap or elastic slip that is left; stiffer penalties come with it where it falls
  /// slowly.
  [[nodiscard]] pairing::PairMultipliers<Dim> corrected(
      const pairing::PairMultipliers<Dim>& used) const;
  /// Unknowns of one point: 1, with friction 1 + Dim.
  [[nodiscard]] Index unknowns_per_point() const;
  /// Multipliers from unknowns in the order of ContactConstraints.
  [[nodiscard]] pairing::PairMultipliers<Dim> multipliers_of(
      std::span<const double> unknowns) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

using ContactResult = BasicContactResult<2>;
using ContactResult3 = BasicContactResult<3>;
using ContactEvaluator = BasicContactEvaluator<2>;
using ContactEvaluator3 = BasicContactEvaluator<3>;

}  // namespace osculate::api
