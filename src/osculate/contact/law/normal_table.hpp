#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "osculate/contact/law/normal_response.hpp"
#include "osculate/core/param.hpp"

namespace osculate::contact {

/// Pressure as a piecewise linear function of the overclosure.
///
/// Formula    p(h) by interpolation between the points (h_i, p_i), h = -zeta; no contact below the
///            first point (p_1 = 0 there), the last slope goes on beyond the last one. At a point
///            of the table the derivative is that of the piece with the larger overclosure
/// Requires   at least two points, h_i strictly increasing, p_i not decreasing, p_1 = 0
/// Units      h: length; p: force per area (force with weight node)
/// Tested by  tests/unit/contact/test_normal_laws.cpp
struct NormalTable {
  static constexpr std::string_view key = "table", words = "table of {} points";
  static constexpr core::PointWords point_words{"One point [overclosure, pressure].",
                                                "Length, or pressure.", "[0.01, 12]"};
  core::Table points;  ///< overclosure, pressure

  static constexpr auto params() {
    return std::array<core::Param<NormalTable>, 1>{
        {{.key = "",
          .unit = "1",
          .doc = "Pressure over overclosure, straight between the points and beyond the last one; "
                 "the first pressure is 0.",
          .slot = &NormalTable::points,
          .example = "[[0, 0], [0.01, 12], [0.02, 40]]",
          .points = &point_words}}};
  }
  /// What is required of the points above, one by one.
  [[nodiscard]] std::optional<core::Fault> fault() const;

  [[nodiscard]] double onset_gap() const { return -points.front()[0]; }
  [[nodiscard]] NormalResponse response(double gap, bool = false) const {
    const double h = -gap;
    if (h < points.front()[0]) return {};
    const auto above = std::upper_bound(
        points.begin(), points.end(), h,
        [](double value, const std::array<double, 2>& point) { return value < point[0]; });
    const std::size_t i =
        std::min(static_cast<std::size_t>(above - points.begin()), points.size() - 1);
    const std::array<double, 2>&a = points[i - 1], &b = points[i];
    const double slope = (b[1] - a[1]) / (b[0] - a[0]);
    return {true, -(a[1] + slope * (h - a[0])), slope};
  }
  /// Work that the traction has taken up, per weight.
  [[nodiscard]] double energy(double gap, bool = false) const {
    const double h = -gap;
    double sum = 0;
    for (std::size_t i = 1; i < points.size() && h > points[i - 1][0]; ++i) {
      const bool inside = i + 1 == points.size() || h < points[i][0];
      const double to = inside ? h : points[i][0];
      sum += 0.5 * (points[i - 1][1] - response(-to).traction) * (to - points[i - 1][0]);
    }
    return sum;
  }
};

}  // namespace osculate::contact
