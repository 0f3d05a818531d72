#include "osculate/model/loads.hpp"

#include <algorithm>
#include <cmath>

namespace osculate::model {
namespace {

void add_corners(const Ramp& ramp, std::vector<double>& out) {
  constexpr double sharp = 0.1;
  const Amplitude& table = ramp.amplitude;
  std::vector<double> slopes{0};  // constant before the first point and after the last
  for (std::size_t i = 1; i < table.size(); ++i)
    slopes.push_back((table[i].second - table[i - 1].second) /
                     (table[i].first - table[i - 1].first));
  slopes.push_back(0);
  double steepest = 0;
  for (const double slope : slopes) steepest = std::max(steepest, std::abs(slope));
  for (std::size_t i = 0; i < table.size(); ++i)
    if (std::abs(slopes[i + 1] - slopes[i]) > sharp * steepest) out.push_back(table[i].first);
}

}  // namespace

double Ramp::value(double fraction) const {
  if (amplitude.empty()) return start + (target - start) * fraction;
  if (fraction <= amplitude.front().first) return target * amplitude.front().second;
  for (std::size_t i = 1; i < amplitude.size(); ++i) {
    const auto& a = amplitude[i - 1];
    const auto& b = amplitude[i];
    if (fraction > b.first) continue;
    const double weight = (fraction - a.first) / (b.first - a.first);
    return target * (a.second + weight * (b.second - a.second));
  }
  return target * amplitude.back().second;
}

std::vector<double> corners(const Step& step) {
  std::vector<double> out;
  for (const PrescribedDof& p : step.prescribed) add_corners(p.ramp, out);
  for (const DeadLoad& load : step.dead) add_corners(load.ramp, out);
  for (const PressureLoad& load : step.pressure) add_corners(load.ramp, out);
  for (const CentrifugalLoad& load : step.centrifugal) add_corners(load.ramp, out);
  for (const Temperatures::Change& change : step.temperature.changes)
    add_corners({0, 0, change.amplitude}, out);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace osculate::model
