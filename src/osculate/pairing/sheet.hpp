#pragma once
#include <Eigen/Core>
#include <vector>

namespace osculate::pairing {

/// A matrix whose memory only grows, for buffers that are used again with another size: Eigen's own
/// gives it back whenever the size changes. It begins where packets of numbers begin: what is
/// computed in packets and what one by one, and so the last bits, does not depend on the heap.
class Sheet {
 public:
  using View = Eigen::Map<Eigen::MatrixXd>;
  using ConstView = Eigen::Map<const Eigen::MatrixXd>;

  void set_zero(Eigen::Index rows, Eigen::Index columns) {
    rows_ = rows;
    columns_ = columns;
    values_.assign(static_cast<std::size_t>(rows * columns), 0.0);
  }
  [[nodiscard]] View view() { return {values_.data(), rows_, columns_}; }
  [[nodiscard]] ConstView view() const { return {values_.data(), rows_, columns_}; }
  [[nodiscard]] Eigen::Index size() const { return rows_ * columns_; }

 private:
  Eigen::Index rows_ = 0, columns_ = 0;
  std::vector<double, Eigen::aligned_allocator<double>> values_;
};

}  // namespace osculate::pairing
