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
struct ContactOptions {
  double normal_penalty = 0;  ///< eps_N > 0, unless there is a `normal`
  /// Empty: frictionless. A coefficient that depends on speed is not for this: it has no time.
  std::optional<contact::FrictionLaw> friction;
  pairing::Weight weight = pairing::Weight::reference_area;
  contact::ResidualForm residual = contact::ResidualForm::surface;
  contact::TangentForm tangent{};
  pairing::AreaRule area{};                    ///< thickness, or circumference (in the plane)
  std::optional<contact::NormalLaw> normal{};  ///< another law than the penalty
  pairing::Separation separation = pairing::Separation::allowed;
  double tolerance = 0;          ///< of separation tied, tied_normal: gap of held points
  double offset = 0;             ///< half thicknesses of both sides, taken off the gap
  pairing::Sampling sampling{};  ///< nodes, or points of a rule on the slave's facets
};

/// One entry of the tangent (to be summed): d force[row] / d coordinate[column].
struct TangentEntry {
  Index row, column;
  double value;
};

/// Result of one evaluation. Row Dim n + i is direction i of node n.
template <int Dim>
struct BasicContactResult {
  std::vector<double> force;  ///< to be ADDED to the internal forces
  std::vector<TangentEntry> tangent;
  std::span<const pairing::PointResult<Dim>>
      points;  ///< one per slave point, valid until the next call
};

/// In the plane (Dim = 2) or in space (Dim = 3); the same code but for the facets.
///
/// Tested by  tests/unit/api/test_contact_evaluator.cpp, test_contact_evaluator3.cpp
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
  /// Accepts the last evaluation as the new history (a converged increment).
  void commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

using ContactResult = BasicContactResult<2>;
using ContactResult3 = BasicContactResult<3>;
using ContactEvaluator = BasicContactEvaluator<2>;
using ContactEvaluator3 = BasicContactEvaluator<3>;

}  // namespace osculate::api
