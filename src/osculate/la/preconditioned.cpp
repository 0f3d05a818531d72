#include "osculate/la/preconditioned.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace osculate::la {
namespace {

constexpr double rounding = 1 + 1e-6;  ///< between residuals as summed up and as K says

}  // namespace

/// One solution on its way.
struct PreconditionedSolutions::Running {
  const Eigen::VectorXd& b;
  Eigen::VectorXd x, rest;
  double left = 0;   ///< |rest|
  double begun = 0;  ///< of the residual, when the directions that are kept began
  double seen = 0;   ///< likewise, when the matrix was asked last
  bool stagnates = false;
};

double PreconditionedSolutions::norm(const Eigen::VectorXd& v) const {
  const double own = v.stableNorm();
  return ranks_ ? std::sqrt(ranks_->sum(own * own)) : own;
}

bool PreconditionedSolutions::all_finite(const Eigen::VectorXd& v) const {
  return ranks_ ? ranks_->all(v.allFinite()) : v.allFinite();
}

void PreconditionedSolutions::find_true_residual(Running& to) const {
  Eigen::VectorXd product;
  a_(to.x, product);
  to.rest = to.b - product;
  to.left = norm(to.rest);
}

void PreconditionedSolutions::take(std::size_t along, Running& to) const {
  double part = image_[along].dot(to.rest);
  if (ranks_) part = ranks_->sum(part);
  to.x += part * along_[along];
  to.rest -= part * image_[along];
}

/// False: nothing new.
bool PreconditionedSolutions::look_along(Eigen::VectorXd z) {
  constexpr double nothing = 1e-12;
  Eigen::VectorXd v;
  a_(z, v);
  const double whole = norm(v);
  std::vector<double> parts(image_.size()), both(image_.size(), 0.0);
  for (int twice = 0; twice < 2 && !parts.empty(); ++twice) {
    for (std::size_t j = 0; j < parts.size(); ++j) parts[j] = image_[j].dot(v);
    if (ranks_) ranks_->sum(parts);
    for (std::size_t j = 0; j < parts.size(); ++j) {
      v -= parts[j] * image_[j];
      both[j] += parts[j];
    }
  }
  for (std::size_t j = 0; j < both.size(); ++j) z -= both[j] * along_[j];
  const double size = norm(v);
  if (!(size > nothing * whole) || !std::isfinite(size)) return false;
  image_.push_back(v / size);
  along_.push_back(z / size);
  return true;
}

/// False: there is no direction to take.
bool PreconditionedSolutions::step(Running& to, int& iterations) {
  constexpr double hardly = 0.5;
  Eigen::VectorXd z = to.stagnates ? image_.back() : to.rest;
  ++iterations;
  if (!precondition_(z) || !look_along(std::move(z))) return false;
  take(along_.size() - 1, to);
  const double then = norm(to.rest);
  to.stagnates = then > hardly * to.left;
  to.left = then;
  return true;
}

bool PreconditionedSolutions::goes_on(const PreconditionedLimits& limits, Running& to) {
  if (along_.size() < static_cast<std::size_t>(limits.restart)) return true;
  find_true_residual(to);
  if (!(to.left <= limits.enough * to.begun)) return false;
  along_.clear();
  image_.clear();
  to.begun = to.left;
  to.stagnates = false;
  return true;
}

Nearby PreconditionedSolutions::solve(const PreconditionedLimits& limits,
                                      Eigen::VectorXd& rhs_in_solution_out) {
  const Eigen::VectorXd& b = rhs_in_solution_out;
  Nearby result;
  const double size = norm(b), wanted = limits.tolerance * size;
  if (!all_finite(b) || !std::isfinite(size)) return result;
  Running to{b,    Eigen::VectorXd::Zero(b.size()),        b, size,
             size, std::numeric_limits<double>::infinity()};
  for (std::size_t j = 0; j < along_.size(); ++j) take(j, to);
  to.left = norm(to.rest);
  while (true) {
    if (to.left <= wanted) {  // as summed up: what does the matrix say?
      find_true_residual(to);
      result.solved = to.left <= rounding * wanted;
      if (result.solved || !(to.left <= limits.enough * to.seen)) break;
      to.seen = to.left;
    }
    if (result.iterations >= limits.iterations || !goes_on(limits, to) ||
        !step(to, result.iterations))
      break;
  }
  if (!result.solved) {
    find_true_residual(to);
    result.solved = to.left <= rounding * std::max(limits.tolerance, limits.good_enough) * size;
  }
  result.solved = result.solved && all_finite(to.x);
  if (result.solved) rhs_in_solution_out = std::move(to.x);
  return result;
}

Eigen::VectorXd noise(Eigen::Index n) {
  Eigen::VectorXd values(n);
  std::uint32_t bits = 1;
  for (double& value : values) {
    bits = 1664525U * bits + 1013904223U;
    value = static_cast<double>(bits >> 8U) / (1U << 23U) - 1;
  }
  return values;
}

}  // namespace osculate::la
