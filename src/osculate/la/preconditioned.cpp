#include "osculate/la/preconditioned.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "osculate/la/long_vectors.hpp"

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
  const double own = la::norm(v, crew_);
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

/// Of all processes.
Eigen::VectorXd PreconditionedSolutions::in_all(Eigen::VectorXd sums) const {
  if (ranks_) ranks_->sum({sums.data(), static_cast<std::size_t>(sums.size())});
  return sums;
}

void PreconditionedSolutions::take(std::size_t along, Running& to) const {
  const Eigen::VectorXd &image = image_[along], &direction = along_[along];
  const double part = in_all(
      sum_over_pieces(image.size(), 1, crew_, [&](Eigen::Index first, Eigen::Index size, auto sum) {
        sum[0] = image.segment(first, size).dot(to.rest.segment(first, size));
      }))[0];
  for_vector_pieces(image.size(), crew_, [&](Eigen::Index first, Eigen::Index size) {
    to.x.segment(first, size) += part * direction.segment(first, size);
    to.rest.segment(first, size) -= part * image.segment(first, size);
  });
}

/// False: nothing new.
bool PreconditionedSolutions::look_along(Eigen::VectorXd z) {
  constexpr double nothing = 1e-12;
  Eigen::VectorXd v;
  a_(z, v);
  const double whole = norm(v);
  const auto count = static_cast<Eigen::Index>(image_.size());
  // Piece by piece, so that what is subtracted from v is in the cache for the next sums.
  const auto less = [&](const Eigen::VectorXd& parts, const std::vector<Eigen::VectorXd>& of,
                        Eigen::Index first, Eigen::Index size, Eigen::VectorXd& from) {
    for (std::size_t j = 0; j < of.size(); ++j)
      from.segment(first, size) -= parts[static_cast<Eigen::Index>(j)] * of[j].segment(first, size);
  };
  const auto parts_after = [&](const Eigen::VectorXd* subtracted) {
    return in_all(sum_over_pieces(
        v.size(), count, crew_, [&](Eigen::Index first, Eigen::Index size, auto sum) {
          if (subtracted) less(*subtracted, image_, first, size, v);
          for (std::size_t j = 0; j < image_.size(); ++j)
            sum[static_cast<Eigen::Index>(j)] =
                image_[j].segment(first, size).dot(v.segment(first, size));
        }));
  };
  if (count > 0) {
    const Eigen::VectorXd once = parts_after(nullptr), again = parts_after(&once);
    const Eigen::VectorXd both = once + again;
    for_vector_pieces(v.size(), crew_, [&](Eigen::Index first, Eigen::Index size) {
      less(again, image_, first, size, v);
      less(both, along_, first, size, z);
    });
  }
  const double size = norm(v);
  if (!(size > nothing * whole) || !std::isfinite(size)) return false;
  for_vector_pieces(v.size(), crew_, [&](Eigen::Index first, Eigen::Index length) {
    v.segment(first, length) /= size;
    z.segment(first, length) /= size;
  });
  image_.push_back(std::move(v));
  along_.push_back(std::move(z));
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
