#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osculate/model/terms/bulk_term.hpp"
#include "osculate/solid/batch.hpp"

namespace osculate::model {

/// The cells of a model whose forces explicit time integration takes four at a time, and the
/// numbers that these keep. Cells go in the order of the model, section by section and type by
/// type; the last lanes of a kind repeat its last cell.
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
  /// Nodes of each of its cells.
  [[nodiscard]] std::size_t nodes(std::size_t four) const { return nodes_of(fours_[four]); }
  /// The jobs of a batch, each once.
  [[nodiscard]] std::span<const std::size_t> jobs(std::size_t four) const {
    return {fours_[four].job.data(), static_cast<std::size_t>(fours_[four].cells)};
  }
  static constexpr std::size_t most_dofs = std::size_t{Dim} << static_cast<unsigned>(Dim);
  using Values = std::array<core::Pack, most_dofs>;
  /// The forces of a batch at the nodal displacements, job l of it in lane l. False: a cell has no
  /// answer; which, its own evaluation says.
  ///
  /// Formula    f(u - u_0) , u_0 the displacement of the first node: what all nodes have in common
  ///            leaves no rounding in the sum of the forces
  [[nodiscard]] bool forces(std::size_t four, const Eigen::VectorXd& u, Values& out) const;
  /// Stored energy of a batch. False as above.
  [[nodiscard]] bool energy(std::size_t four, const Eigen::VectorXd& u, double& sum) const;
  /// Stiffness matrices of the last batch that was asked for.
  struct Stiffness {
    std::size_t four = static_cast<std::size_t>(-1);
    std::array<Eigen::MatrixXd, core::Pack::count> of_lane;
  };
  /// The stiffness of a job whose forces are linear, column by column from them; null: it is of
  /// another kind. It stands in `last`.
  [[nodiscard]] const Eigen::MatrixXd* stiffness(std::size_t job, Stiffness& last) const;

 private:
  static constexpr int lanes = core::Pack::count;
  struct Four {
    std::size_t kind = 0;     ///< of kinds_
    std::size_t numbers = 0;  ///< where they begin
    std::size_t nodes = 0;    ///< likewise; four of each place
    int cells = 0;
    std::array<std::size_t, lanes> job{};
  };
  /// Displacements of a batch less those of the first node.
  void gather(const Four& four, const Eigen::VectorXd& u, Values& out) const;
  [[nodiscard]] std::size_t nodes_of(const Four& four) const {
    return static_cast<std::size_t>(cell::info(kinds_[four.kind].type).nodes);
  }
  void take(const BulkTerm<Dim>& bulk, std::size_t kind, const std::vector<std::size_t>& jobs);

  std::vector<solid::Batch<Dim>> kinds_;
  std::vector<Four> fours_;
  std::vector<core::Pack> numbers_;
  std::vector<Index> nodes_;
  std::vector<std::size_t> others_;
  std::vector<char> taken_;
  std::vector<std::size_t> place_;  ///< of a taken job: lanes * its batch + its lane
};

extern template class ForceBatches<2>;
extern template class ForceBatches<3>;

}  // namespace osculate::model
