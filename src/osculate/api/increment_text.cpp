#include "osculate/api/increment_text.hpp"

#include <fmt/format.h>

namespace osculate::api {
namespace {

std::string time_step_text(const solve::TimeStepTaken& taken) {
  if (!(taken.length > 0)) return {};
  return fmt::format("  step {:.3g} error {:.1e}{}", taken.length, taken.error,
                     taken.refused ? fmt::format(" ({} refused)", taken.refused) : "");
}

/// Digits that were lost.
std::string precision_text(const solve::Precision& precision) {
  return (precision.condition > 0
              ? fmt::format("  (condition of the tangent {:.0e})", precision.condition)
              : std::string{}) +
         (precision.round_off ? "  (residual at round-off)" : "");
}

}  // namespace

std::string increment_text(const std::string& step, const model::Progress& p,
                           const solve::IncrementRecord& record) {
  const solve::IterationRecord& last = record.iterations.back();
  return fmt::format(
      "{:<12} {:>4}  time {:<9.5g} {:>3} iterations  residual {:.1e}  energy {:.1e}  open {} "
      "stick {} slip {}{}",
      step, p.increment, p.time, record.iterations.size(), last.residual, last.energy,
      last.counts.open, last.counts.stick, last.counts.slip,
      (record.cutbacks ? fmt::format("  ({} cut-backs)", record.cutbacks) : std::string{}) +
          (record.resisted ? "  (free motions resisted on the way)" : "") +
          (record.on_path ? "  (on the path)" : "") + precision_text(record.precision) +
          time_step_text(record.time_step));
}

std::string time_steps_text(const std::string& step, const model::Progress& p,
                            const solve::IncrementRecord& record) {
  const solve::TimeSteps& steps = record.time_steps;
  const solve::StateCounts& counts = record.iterations.back().counts;
  return fmt::format(
      "{:<12} {:>4}  time {:<9.5g} {:>6} time steps of {:.3g}  open {} stick {} slip {}", step,
      p.increment, p.time, steps.count, steps.longest, counts.open, counts.stick, counts.slip);
}

}  // namespace osculate::api
