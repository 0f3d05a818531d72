#pragma once
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "osculate/cell/line_shape.hpp"
#include "osculate/core/types.hpp"
#include "osculate/geometry/catalogue.hpp"
#include "osculate/pairing/node_terms.hpp"
#include "osculate/pairing/smoothing.hpp"

namespace osculate::pairing {

/// One piece of a boundary curve: a Lagrange line through its nodes, a smoothed line that depends
/// on its neighbours' nodes too (behind its own two), or an analytic curve carried by a rigid
/// frame.
///
/// The frame is three nodes (origin, tip of e1, tip of e2): a material point with frame
/// coordinates X has the weights (1 - X1 - X2, X1, X2), so an analytic shape is a facet with three
/// nodes like any other and no contact formula knows the difference.
struct Facet {
  int count = 0;
  std::array<Index, cell::max_line_nodes> nodes{};
  std::shared_ptr<const geometry::Curve> shape;  ///< null for a Lagrange or smoothed line
  std::shared_ptr<const BezierWeights> bezier;   ///< of a smoothed line (pairing/smoothing.hpp)
  double lo = -1, hi = 1;
  bool closed = false;         ///< the analytic curve joins itself
  Index prev = -1, next = -1;  ///< neighbours in the direction of travel, -1 = the chain ends
  [[nodiscard]] bool straight() const { return !shape && !bezier && count == 2; }
};

/// A boundary made of facets; nu = k x rho_xi points out of the body (body on the right of travel).
struct Chain {
  std::vector<Facet> facets;
  /// By facet: the vertex behind it may be a re-entrant vertex; empty: any may. Set by
  /// `mark_reentrant_vertices`.
  std::vector<char> sharp_behind{};
};

/// A place on a chain.
struct Location {
  Index facet = -1;
  double xi = 0;
};

/// Lagrange facet through `nodes` (ends first, then interior, left to right).
[[nodiscard]] Facet lagrange_facet(std::span<const Index> nodes);
/// Facet of an analytic curve on the frame nodes (origin, tip 1, tip 2).
[[nodiscard]] Facet shape_facet(geometry::Curve curve, const std::array<Index, 3>& frame);
/// Facets of the curves on one frame, neighbours in their order (and the last with the first when
/// `closed`).
void add_curves(const std::vector<geometry::Curve>& curves, bool closed,
                const std::array<Index, 3>& frame, Chain& chain);
/// Sets prev/next from shared end nodes (and closes a closed analytic curve on itself).
void connect(Chain& chain);

[[nodiscard]] cell::LineShape facet_shape(const Facet& facet, double xi);
[[nodiscard]] geometry::CurveJet<2> facet_jet(const Facet& facet, const cell::LineShape& shape,
                                              std::span<const Vec2> x);
/// The present curve of a Lagrange line.
[[nodiscard]] geometry::LagrangeCurve facet_curve(const Facet& facet, std::span<const Vec2> x);
/// The present curve of a smoothed line by its powers.
struct SmoothCurve {
  std::size_t degree = 3;
  std::array<Vec2, most_control_points> power;
  SmoothCurve(const Facet& facet, std::span<const Vec2> x);
  [[nodiscard]] geometry::CurveJet<2> jet(double xi) const {
    const std::array<Vec2, 4> t = taylor_at(std::span(power).first(degree + 1), xi);
    return {t[0], t[1], 2 * t[2], 6 * t[3]};
  }
};
[[nodiscard]] inline geometry::CurveJet<2> facet_jet(const Facet& facet, double xi,
                                                     std::span<const Vec2> x) {
  return facet_jet(facet, facet_shape(facet, xi), x);
}

/// A vertex at which a chain bends towards its outside: both facets are an obstacle to a point
/// there, and their forces together hold it.
struct ReentrantVertex {
  std::array<Index, 2> facets{-1, -1};  ///< before and behind the vertex
  double end = 0;                       ///< coordinate of the vertex on the first one
  Vec2 point = Vec2::Zero();
  std::array<Vec2, 2> normal, along;  ///< unit normals and directions of travel there
  Vec2 bisector = Vec2::UnitY();      ///< of the normals
};

/// The re-entrant vertex behind a facet, if there is one.
[[nodiscard]] std::optional<ReentrantVertex> reentrant_vertex_after(const Chain& chain, Index facet,
                                                                    std::span<const Vec2> x);

/// Lets re-entrant vertices be at those vertices alone whose normals enclose more than `angle` at
/// `x`; whether there are any (a pair's `reentrant_vertices` cost unknowns).
bool mark_reentrant_vertices(Chain& chain, std::span<const Vec2> x, double angle);

/// Signed arc length along the chain from `from` to `to` in the current configuration, over all
/// borders on the way, and its derivative with respect to the node positions at fixed xi.
///
/// Formula    s = sum over pieces of int sqrt(a11) dxi ; ds/dx_k = int N_k' tau dxi
/// Source     KS2D:19 over the borders of KS2D:86-89 (docs/errata.md: arc length, not the chord)
/// Returns    nothing when the two places are not connected
/// Tested by  tests/unit/pairing/test_chain.cpp
[[nodiscard]] std::optional<double> path_length(const Chain& chain, std::span<const Vec2> x,
                                                const Location& from, const Location& to,
                                                std::vector<NodeGradient<2>>* gradient);

}  // namespace osculate::pairing
