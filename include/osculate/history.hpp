#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "osculate/types.hpp"

namespace osculate {

/// Private.
namespace embed {
struct Access;
template <int Dim>
struct HistoryState;
template <int Dim>
struct ActiveState;
template <int Dim>
struct Definition;
template <int Dim>
struct Evaluation;
}  // namespace embed

/// What all contact points remember of the last converged increment: where they were on the master,
/// their shear traction, what has been dissipated. A value: it never changes, copies share it, and
/// going back to an earlier one is going back in time.
///
/// Order  Evaluator::initial_history -> (evaluate ... evaluate -> Result::committed) an increment
template <int Dim>
class History {
 public:
  History() = default;  ///< of no contact; `evaluate` refuses it

  /// Number of points.
  [[nodiscard]] std::size_t size() const;
  /// All of it, for a restart file; Evaluator::history reads it, on any processor of the same byte
  /// order. The same history has the same bytes.
  [[nodiscard]] std::vector<std::byte> bytes() const;

 private:
  friend struct embed::Access;
  std::shared_ptr<const embed::HistoryState<Dim>> value_;
};

extern template class History<2>;
extern template class History<3>;

}  // namespace osculate
