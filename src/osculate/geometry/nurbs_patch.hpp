#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/geometry/spline_basis.hpp"
#include "osculate/geometry/surfaces.hpp"

namespace osculate::geometry {

/// Spans of the two directions: u_i <= xi1 < u_{i+1} and v_j <= xi2 < v_{j+1}.
using PatchSpan = std::array<Index, 2>;

/// Rational tensor-product B-spline surface. Control points are not multiplied by their weights;
/// point (i, j), i along xi1, stands at i count[1] + j.
///
/// Formula    r = A/W ,  A = sum N_i M_j w_ij P_ij ,  W = sum N_i M_j w_ij ; derivatives by the
///            quotient rule (Leibniz on W r = A)
/// Requires   validate(patch).empty(); outside of lo..hi the end spans are continued
/// Tested by  tests/unit/geometry/test_surfaces.cpp
struct NurbsPatch {
  static constexpr std::string_view key = "nurbs";
  std::array<int, 2> degree{1, 1};
  std::array<std::vector<double>, 2> knots;
  std::array<int, 2> count{0, 0};  ///< control points along xi1 and xi2
  std::vector<Vec3> control;
  std::vector<double> weights;

  [[nodiscard]] SurfaceJet jet(const Vec2& xi) const { return jet_in_span(find_span(xi), xi); }
  [[nodiscard]] Vec2 lo() const;
  [[nodiscard]] Vec2 hi() const;
  [[nodiscard]] ClosedFlags closed() const;  ///< opposite borders coincide (1e-12 of the size)

  [[nodiscard]] PatchSpan find_span(const Vec2& xi) const;
  /// The analytic piece of one non-empty span, also at and beyond its ends; derivatives above
  /// `order` are left zero.
  [[nodiscard]] SurfaceJet jet_in_span(const PatchSpan& span, const Vec2& xi, int order = 3) const;
  [[nodiscard]] std::size_t index(Index i, Index j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(count[1]) +
           static_cast<std::size_t>(j);
  }
};

/// Empty, or what was expected of the degrees, knots, control net and weights.
[[nodiscard]] std::string validate(const NurbsPatch& patch);

/// The same patch with its two parameters exchanged: the normal points to the other side.
[[nodiscard]] NurbsPatch reversed(const NurbsPatch& patch);

}  // namespace osculate::geometry
