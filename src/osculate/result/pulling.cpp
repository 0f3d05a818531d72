#include "osculate/result/pulling.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace osculate::result {

template <int Dim>
std::string pulling(const model::BasicContactPair<Dim>& pair,
                    const pairing::PairEvaluation<Dim>& contact, const std::string& step) {
  constexpr double visible = 0.01;
  if (!pairing::is<pairing::MayPart>(pair.definition.separation)) return {};
  double pulled = 0, pressed = 0;
  std::size_t points = 0;
  for (const pairing::PointResult<Dim>& point : contact.points) {
    if (point.status == contact::Status::open) continue;
    const double force = point.weight * point.normal_traction;
    pulled += std::max(force, 0.0);
    pressed += std::max(-force, 0.0);
    points += force > 0;
  }
  if (!(pulled > visible * pressed)) return {};
  return fmt::format(
      "warning: contact '{}': at the end of step '{}' its law pulls at {} points with {:.4g} in "
      "all, "
      "beside a pressure of {:.4g}: it holds what would be free. `normal: {{penalty: ...}}` does "
      "not pull",
      pair.name, step, points, pulled, pressed);
}

template std::string pulling(const model::ContactPair&, const pairing::PairEvaluation<2>&,
                             const std::string&);
template std::string pulling(const model::ContactPair3&, const pairing::PairEvaluation<3>&,
                             const std::string&);

}  // namespace osculate::result
