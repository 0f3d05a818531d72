#pragma once
// A slave point with unknown tractions in a concave corner of a master in the plane; for sources of
// this layer.
#include "osculate/pairing/point_context.hpp"

namespace osculate::pairing {

/// Whether a point in contact was held in a re-entrant vertex at the end of the last increment.
[[nodiscard]] bool rests_in_reentrant_vertex(const PairDefinition<2>& pair,
                                             const contact::PointHistory<2>& history, Points<2> x);

/// What becomes of a point near a re-entrant vertex. The force on a point in the re-entrant vertex
/// may have any direction between the Coulomb cones of both facets, one multiplier along one normal
/// cannot: so there, the multiplier is the whole traction as a vector in space, and the point is
/// tied to the vertex. This is the third state of the active set beside both facets:
///   facet -> re-entrant vertex  a point that is pressed on a facet has come into the other one as
///   well open -> re-entrant vertex   the nearest place of the master is the vertex re-entrant
///   vertex -> facet  the facet's law lets the traction slide away from the vertex, or pulls; there
///                    it has the point with what the traction is along its normal, or lets it go
/// Otherwise the point is where it was placed.
///
/// Formula    T = Lambda + eps_T (x - v) ; held while for both facets not |T . tau_i| > L_i(T .
///            n_i) on the side that leads away from the vertex. With Coulomb's law that is the sum
///            of the two cones, in the plane a cone of Coulomb about the bisector with the
///            coefficient tan(alpha/2 + atan mu), alpha between the normals. In the increment in
///            which the point has slid to the vertex along facet i, held only while that facet
///            does not hold it before: |T . tau_i| > L_i against the way it came
/// Source     docs/decisions/029-re-entrant vertices.md ; Moreau's decomposition of Lambda + eps (x
/// - v) by
///            the cone of the normals where there is no friction
/// Returns    the re-entrant vertex that holds the point. `context.multiplier` becomes `taken`:
/// the same
///            traction as the state that is found takes it, and `projected` its place
/// Tested by  tests/unit/pairing/test_reentrant_vertex.cpp
[[nodiscard]] std::optional<ReentrantVertex> find_reentrant_vertex(
    const PairDefinition<2>& pair, Points<2> x, const contact::PointHistory<2>& history,
    std::size_t i, const PairEvaluation<2>& work, contact::Multiplier<2>& taken,
    PointContext<2>& context, ProjectedPoint<2>& projected);

/// Fills `out.points[i]` and `out.blocks[i]` of a point that is held in a re-entrant vertex.
///
/// Formula    T as above; the constraint is eps_T (x - v) = 0, and the normal multiplier vanishes
/// Sign       T is the traction on the residual (as N n + t), the force on the point is -T
/// Returns    N and t are reported along the bisector and across it, the gap is the lesser one of
///            both facets
/// Tested by  tests/unit/pairing/test_reentrant_vertex.cpp
void evaluate_reentrant_vertex(const PairDefinition<2>& pair, Points<2> x,
                               const contact::PointHistory<2>& history,
                               const ReentrantVertex& reentrant, const PointContext<2>& context,
                               bool with_tangent, std::size_t i, PairEvaluation<2>& out);

}  // namespace osculate::pairing
