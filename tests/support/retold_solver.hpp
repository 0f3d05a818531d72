#pragma once
// Mumps, whose report of a factorisation is changed before it is read.
#include <functional>
#include <memory>
#include <utility>

#include "osculate/la/mumps.hpp"

namespace osculate::support {

class RetoldSolver final : public la::LinearSolver {
 public:
  explicit RetoldSolver(std::function<void(la::FactorReport&)> change)
      : change_(std::move(change)) {}
  la::FactorReport factor(const la::SparseMatrix& k, std::uint64_t version,
                          la::Symmetry symmetry) override {
    la::FactorReport report = solver_.factor(k, version, symmetry);
    change_(report);
    return report;
  }
  la::SolveStatus solve(Eigen::VectorXd& x) override { return solver_.solve(x); }
  la::SolveStatus solve(Eigen::MatrixXd& x) override { return solver_.solve(x); }
  [[nodiscard]] double seconds() const override { return solver_.seconds(); }

 private:
  std::function<void(la::FactorReport&)> change_;
  la::Mumps solver_;
};

/// Does not say what its factors cost, so that they serve for one matrix.
[[nodiscard]] inline std::unique_ptr<la::LinearSolver> factors_that_serve_once() {
  return std::make_unique<RetoldSolver>([](la::FactorReport& report) { report.operations = 0; });
}

}  // namespace osculate::support
