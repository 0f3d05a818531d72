#include "osculate/api/budget.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/error.hpp"
#include "osculate/core/text.hpp"

namespace osculate::api {

void check_until(const std::string& until, const std::vector<model::Step>& steps) {
  if (until.empty()) return;
  std::vector<std::string> names;
  for (const model::Step& step : steps) names.push_back(step.name);
  if (std::find(names.begin(), names.end(), until) == names.end())
    throw core::InputError({}, "--until: " + core::unknown_name_message("step", until, names));
}

bool Budget::begin_iteration() {
  if (iterations_ > 0 && begun_ >= iterations_)
    used_up_ =
        fmt::format("the {} iterations that --max-iterations allows are used up", iterations_);
  ++begun_;
  return !too_late();
}

bool Budget::too_late() {
  if (minutes_ > 0 && used_up_.empty() && seconds() > 60 * minutes_)
    used_up_ = fmt::format("the {:g} minutes that --max-minutes allows are over", minutes_);
  return !used_up_.empty();
}

bool Budget::passed(double interval) {
  const double now = seconds();
  if (now - told_ < interval) return false;
  told_ = now;
  return true;
}

double share_done(const std::vector<model::Step>& steps, const std::string& until,
                  const model::Progress& progress) {
  double done = 0, all = 0;
  const auto now = static_cast<std::size_t>(progress.step);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    if (s < now) done += steps[s].increments;
    if (s == now) done += progress.fraction * steps[s].increments;
    all += steps[s].increments;
    if (steps[s].name == until) break;
  }
  return all > 0 ? done / all : 1.0;
}

std::string outlook(double share, double before, double seconds) {
  if (!(share > before)) return {};
  const double left = seconds * (1 - share) / (share - before);
  return fmt::format("{:>3.0f} % {:<13} ", 100 * share,
                     left < 90     ? fmt::format("{:.0f} s left", left)
                     : left < 5400 ? fmt::format("{:.0f} min left", left / 60)
                                   : fmt::format("{:.1f} h left", left / 3600));
}

}  // namespace osculate::api
