#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>

#include "osculate/solve/newton.hpp"

namespace osculate::solve {

/// What the extrapolation knows of the last two increments.
struct ExtrapolationMemory {
  Eigen::VectorXd last, before;  ///< their corrections
  double last_size = 0, before_size = 0;
  double residual = 0, energy = 0;  ///< per size, of the last start by the tangent
  std::uint64_t signature = 0;
  int known = 0;
  bool smooth = false, worth = false;
};

/// The last increments, for a guess of the next one.
///
/// Formula    du = h v_1 + h (h + h_1) (v_1 - v_2) / (h_1 + h_2), v_i = du_i / h_i: the parabola
///            through the last three converged states
/// Used       where the last two increments ended with the same states of all contact points and
///            the last one took at least three iterations (otherwise there is nothing to save)
/// Tested by  tests/unit/solve/test_increments.cpp
class Extrapolation {
 public:
  Extrapolation() = default;
  explicit Extrapolation(ExtrapolationMemory memory) : m_(std::move(memory)) {}
  [[nodiscard]] const ExtrapolationMemory& memory() const { return m_; }
  void reset() { m_ = {}; }

  /// Takes note of a converged increment of size `h`.
  template <class Trial>
  void add(const NewtonResult<Trial>& converged, double h) {
    m_.smooth = m_.known > 0 && converged.evaluation.counts.signature == m_.signature;
    m_.signature = converged.evaluation.counts.signature;
    m_.before = std::move(m_.last);
    m_.before_size = m_.last_size;
    m_.last = converged.total;
    m_.last_size = h;
    m_.known = std::min(m_.known + 1, 2);
    m_.worth = converged.iterations.size() >= 3 || (converged.extrapolated && m_.worth);
    if (!converged.extrapolated) {
      m_.residual = converged.first_residual / h;
      m_.energy = converged.first_energy / (h * h);
    }
  }

  [[nodiscard]] Guess guess(double h) const {
    if (m_.known < 2 || !m_.smooth || !m_.worth) return {};
    const Eigen::VectorXd v1 = m_.last / m_.last_size, v2 = m_.before / m_.before_size;
    const double bend = h * (h + m_.last_size) / (m_.last_size + m_.before_size);
    return {h * v1 + bend * (v1 - v2), m_.residual * h, m_.energy * h * h};
  }

 private:
  ExtrapolationMemory m_;
};

}  // namespace osculate::solve
