#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "osculate/core/types.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::api {

/// Contact for another finite-element code: surfaces and coordinates in, forces, tangent and
/// history out. No mesh, no solver, no file format. Several evaluators may live at once.
///
/// Order of calls:   construct -> (evaluate ... evaluate -> commit) per increment
struct ContactOptions {
  double normal_penalty = 0;                 ///< eps_N > 0
  std::optional<contact::Coulomb> friction;  ///< mu and eps_T; empty = frictionless
  pairing::Weight weight = pairing::Weight::reference_area;
  contact::ResidualForm residual = contact::ResidualForm::surface;
  contact::TangentForm tangent{};
  pairing::AreaRule area{};  ///< thickness, or circumference
};

/// A surface as a list of line facets with the same number of nodes each (2..8): end nodes first,
/// then the interior ones; the body is on the right of the direction of travel.
struct FacetList {
  int nodes_per_facet = 2;
  std::span<const Index> nodes;
};

/// One entry of the tangent (to be summed): d force[row] / d coordinate[column].
struct TangentEntry {
  Index row, column;
  double value;
};

/// Result of one evaluation. Row 2 n + i is direction i of node n.
struct ContactResult {
  std::vector<double> force;  ///< to be ADDED to the internal forces
  std::vector<TangentEntry> tangent;
  std::span<const pairing::PointResult<2>>
      points;  ///< one per slave node, valid until the next call
};

class ContactEvaluator {
 public:
  /// `reference`: x0 y0 x1 y1 ... of all nodes that the lists name.
  /// Errors     core::InputError for a list or value that cannot be used
  ContactEvaluator(const ContactOptions& options, FacetList master, FacetList slave,
                   std::span<const double> reference);
  ~ContactEvaluator();
  ContactEvaluator(ContactEvaluator&&) noexcept;
  ContactEvaluator& operator=(ContactEvaluator&&) noexcept;

  /// Slave nodes in the order of `ContactResult::points`.
  [[nodiscard]] std::span<const Index> slave_nodes() const;
  /// Forces (and tangent) at these coordinates, from the history of the last commit.
  [[nodiscard]] ContactResult evaluate(std::span<const double> coordinates, bool with_tangent);
  /// Accepts the last evaluation as the new history (a converged increment).
  void commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osculate::api
