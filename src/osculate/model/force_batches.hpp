#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osculate/model/terms/bulk_term.hpp"
#include "osculate/solid/batch.hpp"
#include "osculate/solid/batch_wide.hpp"

namespace osculate::model {

/// The cells of a model as explicit time integration takes them: in parts of fixed size, whose
/// nodes have numbers of their own, so that what a part works with stays in the caches. Where the
/// forces of four cells come about at once, they are a batch, which keeps the numbers that these
/// need; section by section and type by type, cells near each other behind each other; the last
/// lanes of a kind repeat its last cell. Behind the parts of batches stand those of all other
/// cells.
///
/// Tested by  tests/unit/deck/test_force_batches.cpp
template <int Dim>
class ForceBatches {
 public:
  explicit ForceBatches(const BulkTerm<Dim>& bulk);

  [[nodiscard]] std::size_t count() const { return fours_.size(); }
  /// Jobs that are evaluated one by one, rising.
  [[nodiscard]] const std::vector<std::size_t>& others() const { return others_; }
  /// Whether a job is one of a batch.
  [[nodiscard]] bool takes(std::size_t job) const { return taken_[job] != 0; }
  /// The jobs of a batch, each once.
  [[nodiscard]] std::span<const std::size_t> jobs(std::size_t four) const {
    return {fours_[four].job.data(), static_cast<std::size_t>(fours_[four].cells)};
  }

  struct Range {
    std::size_t begin, end;
  };
  [[nodiscard]] std::size_t parts() const { return begin_.size() - 1; }
  /// The batches of a part; none: it has others.
  [[nodiscard]] Range fours(std::size_t part) const;
  /// Places in `others`; none: it has batches.
  [[nodiscard]] Range alone(std::size_t part) const;
  /// The nodes of a part, rising.
  [[nodiscard]] std::span<const Index> nodes(std::size_t part) const {
    return {&nodes_[begin_[part]], begin_[part + 1] - begin_[part]};
  }
  /// Values at the nodes of a part: x, y, (z,) and what nobody looks at.
  using Nodal = std::vector<core::Pack>;
  void gather(std::size_t part, const Eigen::VectorXd& u, Nodal& out) const;
  /// Adds forces of a job, node by node, to those of its part.
  template <class Force>
  void add_alone(std::size_t job, const Force& force, Nodal& sum) const {
    const std::uint16_t* at = &local_[takes(job) ? first_of(job) : place_[job]];
    for (Eigen::Index k = 0; k < force.size() / Dim; ++k, at += takes(job) ? lanes : 1)
      sum[*at] += core::Pack(force[Dim * k], force[Dim * k + 1],
                             Dim == 3 ? force[Dim * k + Dim - 1] : 0.0, 0.0);
  }

  static constexpr std::size_t most_dofs = std::size_t{Dim} << static_cast<unsigned>(Dim);
  using Values = std::array<core::Pack, most_dofs>;
  /// The forces of a batch at the displacements of its part, job l of it in lane l. False: a cell
  /// has no answer; which, its own evaluation says.
  ///
  /// Formula    f(u - u_0) , u_0 the displacement of the first node: what all nodes have in common
  ///            leaves no rounding in the sum of the forces
  [[nodiscard]] bool forces(std::size_t four, const Nodal& u, Values& out) const;
  /// Whether this batch and the next one can be taken at once (batch_wide.hpp).
  [[nodiscard]] bool goes_with_next(std::size_t four) const;
  /// Those of both, with the same bits.
  [[nodiscard]] bool forces(std::size_t four, const Nodal& u, Values& out, Values& of_next) const;
  /// Adds them to those of the part.
  void add(std::size_t four, const Values& forces, Nodal& sum) const;
  /// Stored energy of a batch. False as above.
  [[nodiscard]] bool energy(std::size_t four, const Nodal& u, double& sum) const;
  [[nodiscard]] std::size_t dofs(std::size_t four) const {
    return static_cast<std::size_t>(Dim * nodes_of(fours_[four]));
  }
  using Matrix = std::array<core::Pack, most_dofs * most_dofs>;
  /// The stiffness of a batch (solid::batch_stiffness), dofs x dofs, column by column. False as
  /// above.
  [[nodiscard]] bool stiffness(std::size_t four, const Nodal& u, Matrix& out) const;

 private:
  static constexpr int lanes = core::Pack::count;
  struct Four {
    std::size_t kind = 0;     ///< of kinds_
    std::size_t numbers = 0;  ///< where they begin
    std::size_t nodes = 0;    ///< likewise in local_; four of each place
    int cells = 0;
    std::array<std::size_t, lanes> job{};
  };
  void gather(const Four& four, const Nodal& u, Values& out) const;
  [[nodiscard]] int nodes_of(const Four& four) const {
    return kinds_[four.kind].kind == solid::BatchKind::simplex ? Dim + 1 : 1 << Dim;
  }
  [[nodiscard]] std::size_t first_of(std::size_t job) const {
    return fours_[place_[job] / lanes].nodes + place_[job] % lanes;
  }
  void take(const BulkTerm<Dim>& bulk, std::size_t kind, const std::vector<std::size_t>& jobs);
  void make_parts(const BulkTerm<Dim>& bulk);

  std::vector<solid::Batch<Dim>> kinds_;
  std::vector<std::optional<solid::EightCells>> eights_;  ///< likewise
  std::vector<Four> fours_;
  std::vector<core::Pack> numbers_;
  std::vector<std::size_t> others_;
  std::vector<char> taken_;
  std::vector<std::size_t> place_;  ///< taken: lanes * batch + lane; others: of the first in local_
  std::size_t of_fours_ = 0;        ///< parts
  std::vector<std::size_t> begin_;  ///< of the parts in nodes_
  std::vector<Index> nodes_;        ///< of the parts
  std::vector<std::uint16_t> local_;  ///< numbers of the cells' nodes in their part
};

extern template class ForceBatches<2>;
extern template class ForceBatches<3>;

}  // namespace osculate::model
