#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "osculate/options.hpp"
#include "osculate/pattern.hpp"
#include "osculate/result.hpp"

namespace osculate {

/// A place of the slave at which contact is looked for: sum_k shape[k] x[nodes[k]].
template <int Dim>
struct SlavePoint {
  std::vector<Index> nodes;
  std::vector<double> shape;
  Index facet = -1;  ///< of the slave in the order given; -1: a node
};

/// What an increment asks for.
struct Increment {
  bool tangent = true;
  double duration = 0;  ///< for laws that ask for a speed; 0: not known
  double relief = 0;    ///< InitialOverlap::ramped: share of the overlaps that does not count yet
  /// With a search distance: also report the gaps of points far in front of the master, which give
  /// no force.
  bool far = false;
};

/// Contact for another finite-element code: surfaces and coordinates in, forces, tangent and next
/// state out. It has no mesh, no solver and no file, and it changes nothing: everything that an
/// analysis remembers is a value of the host's. So several threads may ask one evaluator at once,
/// each with its own result, and an increment is taken back by forgetting its values. Copies share
/// what they are made of.
///
/// Order of calls   examples/embedding/host.cpp
///   history = initial_history(x)
///   an increment:   evaluate(x, history, predicted(history, x)) -> correction of x ->
///                   evaluate(x, history, last result's next_active_set()) -> correction ... ->
///                   history = last result's committed()
/// With prescribed motions the first correction comes from the committed coordinates, and the
/// motions enter through the tangent (residual + K du): whoever moves the border first leaves the
/// first iteration with cells that are torn.
///
/// Tested by  tests/unit/embed, tests/install/main.cpp
template <int Dim>
class Evaluator {
 public:
  /// `reference`: x0 y0 (z0) x1 y1 ... of all nodes there are.
  /// Errors     Refused for a list, value or combination that cannot be used
  Evaluator(const Contact<Dim>& contact, std::span<const double> reference);

  /// The state before the first increment, at these coordinates.
  [[nodiscard]] History<Dim> initial_history(std::span<const double> coordinates) const;
  /// For the first iteration of an increment, at the coordinates it begins with.
  [[nodiscard]] ActiveSet<Dim> predicted(const History<Dim>& committed,
                                         std::span<const double> coordinates,
                                         FrictionGuess guess = FrictionGuess::as_before) const;
  /// Multipliers to start from: no traction.
  [[nodiscard]] Multipliers<Dim> initial_multipliers() const;

  /// Errors     Refused where the values belong to another contact, or the multipliers that an
  ///            enforcement needs are missing
  void evaluate(std::span<const double> coordinates, const History<Dim>& committed,
                const ActiveSet<Dim>& active_set, Result<Dim>& out,
                const Increment& increment = {}) const;
  void evaluate(std::span<const double> coordinates, const History<Dim>& committed,
                const ActiveSet<Dim>& active_set, const Multipliers<Dim>& multipliers,
                Result<Dim>& out, const Increment& increment = {}) const;

  /// Places of the tangent that evaluations may need while no node is farther than `reach.motion`
  /// from these coordinates: more than they will, never fewer (pattern.hpp).
  /// Errors     Refused for a reach that is not >= 0, for mortar (unless tied) and for edge-edge
  ///            contacts
  [[nodiscard]] Pattern pattern(std::span<const double> coordinates, const History<Dim>& committed,
                                const Reach& reach) const;

  /// Slave points, in the order of Result::points (edge-edge contacts come behind them).
  [[nodiscard]] std::vector<SlavePoint<Dim>> slave_points() const;
  /// Unknowns of one point with Enforcement::lagrange_multiplier: 1, with friction 1 + Dim.
  [[nodiscard]] Index unknowns_per_point() const;
  /// Multipliers from unknowns in the order of Constraints, and back.
  [[nodiscard]] Multipliers<Dim> multipliers_of(std::span<const double> unknowns) const;
  [[nodiscard]] std::vector<double> unknowns_of(const Multipliers<Dim>& multipliers) const;

  /// From bytes, for a restart: it goes on with the same bits.
  /// Errors     Refused for bytes of another format, of another contact (other surfaces, sampling,
  ///            enforcement or reference coordinates; laws may differ), and for damaged ones
  [[nodiscard]] History<Dim> history(std::span<const std::byte> bytes) const;
  [[nodiscard]] ActiveSet<Dim> active_set(std::span<const std::byte> bytes) const;
  [[nodiscard]] Multipliers<Dim> multipliers(std::span<const std::byte> bytes) const;
  [[nodiscard]] std::vector<std::byte> bytes(const Multipliers<Dim>& multipliers) const;

 private:
  std::shared_ptr<const embed::Definition<Dim>> definition_;
};

extern template class Evaluator<2>;
extern template class Evaluator<3>;

}  // namespace osculate
