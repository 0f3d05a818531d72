#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "osculate/core/crew.hpp"

namespace osculate::la {

// Work on long vectors by several threads (null: by this one alone), in pieces whose length depends
// on nothing, so that the bits of sums do not, either. Tested by
// tests/unit/la/test_long_vectors.cpp.

inline constexpr Eigen::Index vector_piece = 4096;

/// work(first, size) for all pieces of a vector of n numbers.
template <class Work>
void for_vector_pieces(Eigen::Index n, core::Crew* crew, const Work& work) {
  constexpr std::size_t worth_it = 2;
  const auto some = [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const Eigen::Index first = static_cast<Eigen::Index>(p) * vector_piece;
      work(first, std::min(vector_piece, n - first));
    }
  };
  const auto pieces = static_cast<std::size_t>((n + vector_piece - 1) / vector_piece);
  if (crew)
    crew->share_runs(pieces, worth_it, some);
  else
    some(0, pieces);
}

/// Sums over all pieces of so many numbers each, which sum_of_piece(first, size, to) sets.
template <class SumOfPiece>
[[nodiscard]] Eigen::VectorXd sum_over_pieces(Eigen::Index n, Eigen::Index numbers,
                                              core::Crew* crew, const SumOfPiece& sum_of_piece) {
  Eigen::MatrixXd of_piece(numbers, (n + vector_piece - 1) / vector_piece);
  for_vector_pieces(n, crew, [&](Eigen::Index first, Eigen::Index size) {
    sum_of_piece(first, size, of_piece.col(first / vector_piece));
  });
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(numbers);
  for (Eigen::Index p = 0; p < of_piece.cols(); ++p) sum += of_piece.col(p);
  return sum;
}

/// |v| , by a slower way where squares are not numbers any more.
[[nodiscard]] inline double norm(const Eigen::VectorXd& v, core::Crew* crew) {
  constexpr double smallest = 1e-250, largest = 1e250;
  const double squared =
      sum_over_pieces(v.size(), 1, crew, [&](Eigen::Index first, Eigen::Index size, auto to) {
        to[0] = v.segment(first, size).squaredNorm();
      })[0];
  return squared > smallest && squared < largest ? std::sqrt(squared) : v.stableNorm();
}

}  // namespace osculate::la
