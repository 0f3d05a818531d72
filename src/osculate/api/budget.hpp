#pragma once
#include <chrono>
#include <string>

#include "osculate/model/analysis.hpp"

namespace osculate::api {

/// How long a run may take.
///
/// Tested by  tests/unit/api/test_run.cpp
class Budget {
 public:
  using Clock = std::chrono::steady_clock;
  /// Zeros are no limits.
  Budget(int iterations, double minutes, Clock::time_point start)
      : iterations_(iterations), minutes_(minutes), start_(start) {}

  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }
  /// So many seconds have passed since this was last true, or since the start.
  bool passed(double interval);
  /// False where one more iteration is too much.
  bool begin_iteration();
  /// The time is over.
  bool too_late();
  /// Which limit was met, in plain words; empty: none.
  [[nodiscard]] const std::string& used_up() const { return used_up_; }

 private:
  int iterations_, begun_ = 0;
  double minutes_, told_ = 0;
  Clock::time_point start_;
  std::string used_up_;
};

/// Throws core::InputError if there is no step of this name (empty: all are wanted).
void check_until(const std::string& until, const std::vector<model::Step>& steps);

/// Share of the increments up to a step (empty: all) that are done.
[[nodiscard]] double share_done(const std::vector<model::Step>& steps, const std::string& until,
                                const model::Progress& progress);

/// ` 40 % 3 min left    `: the share that is done, and how long the rest takes if it takes as long
/// as what has been done in `seconds` since the share `before`.
[[nodiscard]] std::string outlook(double share, double before, double seconds);

}  // namespace osculate::api
