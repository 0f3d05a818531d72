#include "osculate/model/loads.hpp"

namespace osculate::model {

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

}  // namespace osculate::model
