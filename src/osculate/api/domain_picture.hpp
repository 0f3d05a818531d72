#pragma once
// Drawing of projection domains; included by the sources of api/domain.hpp only.
#include "osculate/api/domain.hpp"
#include "osculate/projection/reach.hpp"

namespace osculate::api {

[[nodiscard]] inline Vec3 in_space(const Vec2& v) { return {v.x(), v.y(), 0}; }
[[nodiscard]] inline Vec3 in_space(const Vec3& v) { return v; }
[[nodiscard]] std::string text_of(const Vec3& place);

/// `length`: where things without end are cut off; `even`: smallest bounds below and above of the
/// smooth part of each piece.
template <int Dim>
[[nodiscard]] DomainPicture draw_domain(const projection::Composed<Dim>& surface, double kink,
                                        double length,
                                        const std::vector<std::array<double, 2>>& even);

}  // namespace osculate::api
