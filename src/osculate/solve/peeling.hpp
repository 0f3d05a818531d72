#pragma once
#include <array>
#include <concepts>
#include <cstdint>
#include <optional>

#include "osculate/solve/iteration.hpp"

namespace osculate::solve {

/// Systems that can make their contact softer for a while.
template <class S>
concept Relaxes = requires(const S s, const typename S::Trial& state) {
  // softer than in the last evaluation, which was of `state`; none: nothing can be softer
  { s.relaxed(state) } -> std::same_as<std::optional<typename S::Trial>>;
  // as stiff as in `before`, but for a part (of the exponent) of what it became softer
  { s.restored(state, state, 0.0) } -> std::same_as<typename S::Trial>;
};

namespace detail {

/// Contact that peels: a body that is bent off another one opens point after point, since the next
/// one only pulls when the one before it is let go. Each needs an iteration. With a softer contact
/// many points share what one of them carries, so that iterations open many at once; where its
/// states stand still, the true contact goes on from there with few that are wrong.
///
/// The last solution is one of the true contact: nothing softer is left in it.
///
/// Decision   docs/decisions/041-softer-contact-that-peels.md
/// Tested by  tests/unit/solve/test_peeling.cpp, verification/heavy_beam
template <System S>
class Peeling {
 public:
  /// Iterations with the softer contact: they are no sign of divergence.
  [[nodiscard]] int iterations() const { return iterations_; }
  /// The contact has just become softer or stiffer: the residual before the next correction is no
  /// measure of the one behind it.
  [[nodiscard]] bool turned() const { return turned_; }

  /// After an iteration, the last one if `ended`: true if the contact became softer or stiffer, and
  /// the iterations go on from `result`.
  bool turns(S& system, const typename S::State& committed, double time, bool ended,
             NewtonResult<typename S::Trial>& result) {
    if constexpr (Relaxes<S>) {
      turned_ = false;
      const bool still = look_at(result.evaluation.counts);
      if (softer_) {
        const bool spent = ++iterations_ >= most;
        if (!ended && !still && !spent) return false;
        harden(system, spent, result);
      } else if (ended || !peels() || !soften(system, result)) {
        return false;
      }
      go_on(system, committed, time, result);
      return true;
    }
    return false;
  }

  /// The linear system of the softer contact could not be solved: back to the true one.
  bool gives_up(S& system, const typename S::State& committed, double time,
                NewtonResult<typename S::Trial>& result) {
    if (!softer_ || result.outcome == Outcome::stopped) return false;
    go_back(result);
    go_on(system, committed, time, result);
    return true;
  }

 private:
  static constexpr int most = 20, window = 5, long_enough = 10, stages = 2;

  /// True where the points in contact seem to stand: what friction does there comes later.
  bool look_at(const StateCounts& counts) {
    const auto at = [&](int ago) {
      return open_[static_cast<std::size_t>((seen_ - ago) % (window + 1))];
    };
    const bool same = seen_ > 0 && counts.signature == signature_;
    const bool still = same || (seen_ > 1 && counts.open == at(1) && counts.open == at(2));
    if (same) seen_ = 0;
    signature_ = counts.signature;
    open_[static_cast<std::size_t>(seen_++ % (window + 1))] = counts.open;
    return still;
  }

  /// States have changed in many iterations, one after the other, and a few more points are open;
  /// over an area many come and go, and what tells is that they find no end.
  [[nodiscard]] bool peels() const {
    if (used_ || seen_ <= window) return false;
    const int now = open_[static_cast<std::size_t>((seen_ - 1) % (window + 1))];
    const int before = open_[static_cast<std::size_t>(seen_ % (window + 1))];
    return seen_ >= long_enough || (now > before && now - before <= 2 * window);
  }

  bool soften(S& system, NewtonResult<typename S::Trial>& result) {
    std::optional<typename S::Trial> softer = system.relaxed(result.trial);
    if (!softer) return false;
    used_ = true;
    softer_ = {std::move(result.trial), result.total};
    result.trial = std::move(*softer);
    seen_ = stage_ = 0;
    return true;
  }

  /// To the next stage; to the last one where iterations are spent.
  void harden(S& system, bool spent, NewtonResult<typename S::Trial>& result) {
    if (!result.evaluation.ok || !result.evaluation.residual.allFinite()) return go_back(result);
    const bool last = spent || ++stage_ == stages;
    result.trial = system.restored(result.trial, softer_->trial, last ? 0 : 0.5);
    seen_ = 0;
    if (last) softer_.reset();
  }

  void go_back(NewtonResult<typename S::Trial>& result) {
    result.trial = std::move(softer_->trial);
    result.total = std::move(softer_->total);
    seen_ = 0;
    softer_.reset();
  }

  void go_on(S& system, const typename S::State& committed, double time,
             NewtonResult<typename S::Trial>& result) {
    turned_ = true;
    result.outcome = Outcome::not_converged;
    result.reason.clear();
    system.evaluate(committed, result.trial, time, true, result.evaluation);
  }

  struct Left {
    typename S::Trial trial;
    Eigen::VectorXd total;
  };
  std::optional<Left> softer_;  ///< where the true contact was left; set while it is softer
  std::array<int, window + 1> open_{};
  std::uint64_t signature_ = 0;
  bool used_ = false, turned_ = false;
  int seen_ = 0, stage_ = 0, iterations_ = 0;
};

}  // namespace detail

}  // namespace osculate::solve
