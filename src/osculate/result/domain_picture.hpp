#pragma once
// Drawing of projection domains; for the survey in api/domain.cpp and the sources of
// domain_report.hpp.
#include "osculate/projection/reach.hpp"
#include "osculate/result/domain_report.hpp"

namespace osculate::result {

[[nodiscard]] inline Vec3 in_space(const Vec2& v) { return {v.x(), v.y(), 0}; }
[[nodiscard]] inline Vec3 in_space(const Vec3& v) { return v; }
[[nodiscard]] std::string text_of(const Vec3& place);

/// How to draw.
struct DomainPen {
  double kink = 0;    ///< radians
  double length = 0;  ///< where things without end are cut off
  int cells = 40;     ///< along a side of a piece, at most
};

/// `even`: smallest bounds below and above of the smooth part of each piece.
template <int Dim>
[[nodiscard]] DomainPicture draw_domain(const projection::Composed<Dim>& surface,
                                        const DomainPen& pen,
                                        const std::vector<std::array<double, 2>>& even);

}  // namespace osculate::result
