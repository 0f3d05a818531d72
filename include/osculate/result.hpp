#pragma once
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "osculate/active_set.hpp"
#include "osculate/history.hpp"
#include "osculate/multipliers.hpp"

namespace osculate {

/// One contact point as an evaluation found it.
template <int Dim>
struct ContactPoint {
  Status status = Status::open;
  Feature feature = Feature::none;  ///< of the master, at the foot point
  Index facet = -1;                 ///< of the master in the order given; -1: no place found
  /// Of an edge-edge contact: number of the slave's, while `facet` is that of the master's.
  Index edge = -1;
  std::array<double, static_cast<std::size_t>(Dim) - 1> xi{};  ///< on the facet
  double gap = 0;                ///< negative: penetration; infinite: no place of the master found
  double normal_traction = 0;    ///< N, not positive but where a held point is pulled
  Vector<Dim> shear_traction{};  ///< in space; its negative acts on the slave
  Vector<Dim> slip{};            ///< along the master in this increment
  Vector<Dim> foot{}, normal{};
  double weight = 1;            ///< 1, or the area that the tractions act on
  double stored = 0;            ///< energy of the springs that penalties are, per weight
  double friction_work = 0;     ///< [energy] dissipated here so far
  double damping_work = 0;      ///< [energy] by damping
  bool outside_domain = false;  ///< too deep for the curvature there: no normal, and no force
};

/// Constraints of an evaluation whose tractions are unknowns of the host: one normal constraint a
/// point, and with friction Dim for its shear behind it. The unknowns stand in the same order: the
/// multipliers by their penalties, lambda / eps_N and t / eps_T, which have the unit of a length
/// and keep the symmetry of a frictionless problem.
///
/// Formula    in contact gap and elastic slip times area and penalty, in the open the multipliers
///            themselves; all vanish at the solution
struct Constraints {
  std::vector<double> value;
  std::vector<double> branch_value;  ///< as Result::branch_force
  std::vector<Entry> rows;           ///< d value[row] / d coordinate[column]
  std::vector<Entry> columns;        ///< d force[row] / d unknown[column]
  std::vector<Entry> own;            ///< d value[row] / d unknown[column]
};

/// What one evaluation found, and what follows from it. To be reused: an `evaluate` into the same
/// result allocates little. Coordinate Dim n + i is direction i of node n.
template <int Dim>
class Result {
 public:
  Result();
  ~Result();
  Result(Result&&) noexcept;
  Result& operator=(Result&&) noexcept;

  /// To be ADDED to the internal forces.
  [[nodiscard]] std::span<const double> force() const;
  /// Whether some points were linearised in another state than the one their traction is of.
  [[nodiscard]] bool branched() const;
  /// Forces of the states that the tangent belongs to: what a correction is computed from. The
  /// forces decide whether it was the last one. Both are the same unless `branched`; then a line
  /// search finds nothing, and the whole correction is taken.
  [[nodiscard]] std::span<const double> branch_force() const;
  /// d branch_force[row] / d coordinate[column]; empty unless it was asked for.
  [[nodiscard]] std::span<const Entry> tangent() const;
  /// The same as dense blocks, for hosts that assemble by elements: a visitor is called with nodes
  /// of rows, nodes of columns, and the derivatives of all forces of the former by all coordinates
  /// of the latter, one row after the other. Blocks overlap, and are to be summed.
  using BlockVisitor = std::function<void(
      std::span<const Index> rows, std::span<const Index> columns, std::span<const double> values)>;
  void visit_blocks(const BlockVisitor& visit) const;
  [[nodiscard]] std::span<const ContactPoint<Dim>> points()
      const;                                             ///< slave points, edge-edge contacts
  [[nodiscard]] const Constraints& constraints() const;  ///< with unknown tractions, else empty

  /// For the next iteration.
  [[nodiscard]] ActiveSet<Dim> next_active_set() const;
  /// The multipliers that it was made with, as the states that were found take them: for the next
  /// iteration too.
  [[nodiscard]] Multipliers<Dim> multipliers() const;
  /// The multipliers that a solution asks for (Uzawa): the tractions of its points. `violation` is
  /// what is left; stiffer penalties come with it where that falls slowly.
  [[nodiscard]] Multipliers<Dim> corrected_multipliers() const;

  /// After the last iteration: what the next increment begins with.
  [[nodiscard]] History<Dim> committed() const;
  [[nodiscard]] Multipliers<Dim> committed_multipliers() const;

 private:
  friend struct embed::Access;
  std::unique_ptr<embed::Evaluation<Dim>> value_;
};

extern template class Result<2>;
extern template class Result<3>;

}  // namespace osculate
