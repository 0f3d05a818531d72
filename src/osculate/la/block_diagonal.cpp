#include "osculate/la/block_diagonal.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace osculate::la {
namespace {

constexpr std::size_t blocks_at_least = 500;  // groups, while a thread is told of them

Eigen::MatrixXd inverse_of_block(Eigen::MatrixXd block) {
  constexpr double digits = 1e-7;
  const Eigen::Index size = block.rows();
  block = (0.5 * (block + block.transpose())).eval();
  const Eigen::LLT<Eigen::MatrixXd> factors(block);
  const Eigen::VectorXd pivots = factors.matrixLLT().diagonal();
  if (factors.info() != Eigen::Success || !(pivots.minCoeff() > digits * pivots.maxCoeff()))
    return Eigen::MatrixXd::Zero(size, size);
  return factors.solve(Eigen::MatrixXd::Identity(size, size));
}

template <int Size>
void apply_block(const double* block, const Eigen::VectorXd& r, Index first, Index size,
                 Eigen::VectorXd& y) {
  using Block = Eigen::Matrix<double, Size, Size>;
  y.segment<Size>(first, size).noalias() =
      Eigen::Map<const Block>(block, size, size) * r.segment<Size>(first, size);
}

}  // namespace

BlockDiagonal::BlockDiagonal(const GroupedRows& a, core::Crew& crew) : start_(a.groups()) {
  for (std::size_t g = 0; g + 1 < start_.size(); ++g) {
    const std::size_t size = as_size(start_[g + 1] - start_[g]);
    place_.push_back(place_[g] + size * size);
  }
  value_.resize(place_.back());
  update(a, nullptr, crew);
}

void BlockDiagonal::update(const GroupedRows& a, const std::vector<char>* groups,
                           core::Crew& crew) {
  crew.share_runs(start_.size() - 1, blocks_at_least, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      if (groups && (*groups)[g] == 0) continue;
      const Eigen::MatrixXd inverse = inverse_of_block(a.diagonal_block(g));
      std::copy_n(inverse.data(), inverse.size(), value_.data() + place_[g]);
    }
  });
}

void BlockDiagonal::apply(const Eigen::VectorXd& r, core::Crew& crew, Eigen::VectorXd& y) const {
  y.resize(r.size());
  crew.share_runs(start_.size() - 1, blocks_at_least, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      const Index first = start_[g], size = start_[g + 1] - first;
      const double* const block = value_.data() + place_[g];
      if (size == 3)
        apply_block<3>(block, r, first, size, y);
      else if (size == 6)
        apply_block<6>(block, r, first, size, y);
      else
        apply_block<Eigen::Dynamic>(block, r, first, size, y);
    }
  });
}

GroupedRows BlockDiagonal::as_matrix(core::Crew& crew) const {
  const Index n = start_.empty() ? 0 : start_.back();
  CompressedRows out(n, n);
  out.resizeNonZeros(static_cast<Index>(value_.size()));
  Index next = 0;
  for (std::size_t g = 0; g + 1 < start_.size(); ++g) {
    const Index first = start_[g], size = start_[g + 1] - first;
    for (Index i = 0; i < size; ++i) {
      out.outerIndexPtr()[first + i] = next;
      for (Index j = 0; j < size; ++j, ++next) {
        out.innerIndexPtr()[next] = first + j;
        out.valuePtr()[next] = value_[place_[g] + static_cast<std::size_t>(i + j * size)];
      }
    }
  }
  out.outerIndexPtr()[n] = next;
  return {out, start_, crew};
}

}  // namespace osculate::la
